// A worker: answers one job after the other. A tile is computed in strips, so that a newer wish can stop it between two
// of them.
import { Core, Refusal } from "./core.js";

let core = null;
let wanted = null; // the tile in work; another value stops it

const pause = () =>
  new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port2.onmessage = () => {
      port1.close();
      resolve();
    };
    port1.postMessage(null);
  });

async function tile(id, job) {
  wanted = id;
  const { columns, rows } = job;
  const image = new ImageData(columns, rows);
  const values = job.values ? new Uint32Array(columns * rows) : null;
  const wide = job.strip ?? columns;
  for (let from = 0; from < columns; from += wide) {
    const to = Math.min(from + wide, columns);
    const strip = core.tile(job, from, to);
    const width = 4 * (to - from);
    for (let row = 0; row < rows; row++) {
      image.data.set(strip.pixels.subarray(row * width, (row + 1) * width), 4 * (row * columns + from));
    }
    values?.set(strip.values, from * rows);
    postMessage({ id, progress: to });
    await pause();
    if (wanted !== id) return { stopped: true };
  }
  return { bitmap: await createImageBitmap(image), values };
}

/** The window of speeds about an orbit. */
function windowOf({ speeds, grounded }) {
  const [low, high] = [Math.min(...speeds), Math.max(...speeds)];
  const from = low - 0.15 * Math.max(high - low, 1e-6 * high);
  return [grounded || from < 0.3 * high ? 0 : from, high + 0.1 * Math.max(high - low, 1e-3 * high)];
}

/** All that the panels of a point show at once. `kept` is the window of the map, if it is to stay. */
function pinned(m, alpha, orbit, hops, points, kept) {
  const point = core.point(m, alpha, orbit);
  const window = kept ?? windowOf(point);
  // A point with a fate may have a map or a motion too long to be shown.
  const tried = (make) => {
    try {
      return make();
    } catch (error) {
      if (error instanceof Refusal) return { refused: error.message };
      throw error;
    }
  };
  return {
    point,
    window,
    map: tried(() => core.map(m, ...window, points)),
    motion: tried(() => core.motion(m, alpha, hops)),
  };
}

async function answer({ id, kind, args }) {
  try {
    const found = kind === "tile" ? await tile(id, args[0]) : kind === "pinned" ? pinned(...args) : core[kind](...args);
    const moved = found.bitmap ? [found.bitmap] : found.buffer ? [found.buffer] : [];
    postMessage({ id, found }, moved);
  } catch (error) {
    postMessage({ id, error: error.message, refused: error instanceof Refusal });
    // After a trap the memory of the core is in an unknown state.
    if (!(error instanceof Refusal)) close();
  }
}

onmessage = ({ data }) => {
  if (data.module) core = new Core(new WebAssembly.Instance(data.module, {}));
  else if (data.stop !== undefined) {
    if (wanted === data.stop) wanted = null;
  } else answer(data);
};
