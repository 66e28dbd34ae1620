// A picture of the plane with more pixels than the screen: computed in strips by all workers, with the axes of the screen's picture.
import { planeAxes } from "./axes.js";
import { paint } from "./plane.js";
import { state } from "./state.js";
import { stripOf } from "./tiles.js";

/** Pixels of the picture across; the core makes at most 4096 each way. */
export const WIDE = 4000;
const MOST = 4096;
/** Columns of a strip: one answer of a worker. */
const STRIP = 40;

/** The picture on a canvas. `wait` shows a text, and says whether the picture is still wanted. */
export async function large(plane, pool, wait) {
  const { view, layer } = state;
  const { size, box } = plane;
  const ratio = Math.min(WIDE / size.width, MOST / size.height);
  // The model has no M and no α below 0.
  const [left, bottom] = [view.logarithmic ? view.x[0] : Math.max(view.x[0], 0), Math.max(view.alpha[0], 0)];
  const part = ([low, high], from) => (high - from) / (high - low);
  const columns = Math.max(Math.round(box.width * ratio * part(view.x, left)), 1);
  const rows = Math.max(Math.round(box.height * ratio * part(view.alpha, bottom)), 1);
  const picture = new OffscreenCanvas(columns, rows);
  const context = picture.getContext("2d");
  const strips = Math.ceil(columns / STRIP);
  const at = (column) => left + ((view.x[1] - left) * column) / columns;
  let [there, given] = [0, false];
  const asked = Array.from({ length: strips }, async (_, k) => {
    const [from, to] = [k * STRIP, Math.min((k + 1) * STRIP, columns)];
    const job = { layer, logarithmic: view.logarithmic, x: [at(from), at(to)], alpha: [bottom, view.alpha[1]] };
    const promise = pool.ask("tile", { ...job, columns: to - from, rows, strip: stripOf(layer) });
    const { bitmap, stopped } = await promise;
    if (stopped || given) return;
    context.drawImage(bitmap, from, 0);
    bitmap.close();
    there += 1;
    given ||= !wait(`${there} of ${strips} parts of ${columns} × ${rows} pixels …`);
  });
  await Promise.all(asked);
  if (given) throw new Error("given up");
  const [right, up] = [view.x, view.alpha].map((side, k) => 1 - part(side, [left, bottom][k]));
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [size.width, size.height].map((side) => Math.round(side * ratio));
  const painted = {
    size,
    box,
    overlay: {
      paint: (to, { width, height }) => {
        const [x, y] = [painted.corner.left + right * width, painted.corner.top];
        to.imageSmoothingEnabled = false;
        to.drawImage(picture, x, y, width * (1 - right), height * (1 - up));
      },
      axes: () => planeAxes(view, size, plane.legend.fixedPoints),
    },
    corner: plane.corner,
  };
  paint(canvas.getContext("2d"), painted, ratio);
  return canvas;
}
