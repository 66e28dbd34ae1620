// Other systems in the page: a picture of their basins, which the crates for any system compute here, in a dialog.
import { Pool } from "./pool.js";
import { show } from "./numbers.js";

const dialog = document.getElementById("dialog");

/** Pixels of the first picture and of the fine one each way, and columns of a strip of it: an orbit takes a tenth of a millisecond or more. */
const [COARSE, FINE, STRIP] = [32, 240, 8];
/** A turn of the wheel by a usual step zooms by this factor. */
const ZOOM = 0.8;

let pool = null;
let list = null;

/** Loads the module at the first use. */
async function loaded(compiled) {
  pool ??= new Pool(() => compiled, Math.max((navigator.hardwareConcurrency || 2) - 1, 1));
  return (list ??= await pool.ask("systems"));
}

class View {
  constructor(canvas, say) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.say = say;
    this.round = 0;
  }

  open(number, { window, fates }) {
    [this.number, this.window, this.home, this.fates] = [number, window, window, fates];
    this.draw();
  }

  /** A coarse picture, then the fine one in strips from the left; what is no longer wanted is given up. */
  async draw() {
    const mine = ++this.round;
    const { width, height } = this.canvas;
    const at = (columns, rows, from, to) => pool.ask("systemStrip", this.number, this.window, columns, rows, from, to);
    try {
      this.say("Computing …");
      const coarse = new ImageData(await at(COARSE, COARSE, 0, COARSE), COARSE, COARSE);
      if (mine !== this.round) return;
      const picture = await createImageBitmap(coarse);
      this.context.imageSmoothingEnabled = false;
      this.context.drawImage(picture, 0, 0, width, height);
      let there = 0;
      const strips = Array.from({ length: Math.ceil(width / STRIP) }, (_, k) => k * STRIP);
      const one = async (from) => {
        if (mine !== this.round) return;
        const to = Math.min(from + STRIP, width);
        const data = await at(width, height, from, to);
        if (mine !== this.round) return;
        this.context.putImageData(new ImageData(data, to - from, height), from, 0);
        there += 1;
        this.say(there < strips.length ? `${there} of ${strips.length} parts` : this.words());
      };
      // Two in work for each worker, so that a newer picture does not wait long.
      const lanes = Array.from({ length: 2 * pool.members.length }, async () => {
        while (strips.length > there && mine === this.round) {
          const from = this.queue(mine, strips);
          if (from === undefined) return;
          await one(from);
        }
      });
      await Promise.all(lanes);
      if (mine === this.round) this.canvas.dispatchEvent(new Event("complete"));
    } catch (error) {
      this.say(error.message);
    }
  }

  /** The next strip of a picture. */
  queue(mine, strips) {
    if (this.asked?.mine !== mine) this.asked = { mine, next: 0 };
    return strips[this.asked.next++];
  }

  words() {
    const [left, right, bottom, top] = this.window.map((x) => show(x, 6));
    return `${left} to ${right}, ${bottom} to ${top}`;
  }

  /** A zoom to a place, in parts of the picture from the left and from the top. */
  zoom([x, y], factor) {
    const [left, right, bottom, top] = this.window;
    const [cx, cy] = [left + x * (right - left), top - y * (top - bottom)];
    this.window = [cx + (left - cx) * factor, cx + (right - cx) * factor, cy + (bottom - cy) * factor, cy + (top - cy) * factor];
    this.draw();
  }

  move(x, y) {
    const [left, right, bottom, top] = this.window;
    const [dx, dy] = [x * (right - left), y * (top - bottom)];
    this.window = [left - dx, right - dx, bottom + dy, top + dy];
    this.draw();
  }
}

function listen(view) {
  const { canvas } = view;
  const place = ({ offsetX, offsetY }) => [offsetX / canvas.clientWidth, offsetY / canvas.clientHeight];
  canvas.onwheel = (event) => {
    event.preventDefault();
    view.zoom(place(event), event.deltaY < 0 ? ZOOM : 1 / ZOOM);
  };
  canvas.ondblclick = (event) => view.zoom(place(event), ZOOM ** 3);
  let from = null;
  canvas.onpointerdown = (event) => {
    from = place(event);
    canvas.setPointerCapture(event.pointerId);
  };
  canvas.onpointerup = (event) => {
    const to = place(event);
    if (from && Math.hypot(to[0] - from[0], to[1] - from[1]) > 0.01) view.move(to[0] - from[0], to[1] - from[1]);
    from = null;
  };
  const moves = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
  canvas.onkeydown = (event) => {
    if (event.key === "+" || event.key === "-") view.zoom([0.5, 0.5], event.key === "+" ? ZOOM : 1 / ZOOM);
    else if (moves[event.key]) view.move(...moves[event.key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}

/** Opens the dialog with the systems. `compiled` is the promise of their module. */
export async function others(compiled) {
  dialog.innerHTML = `<h2 id="dialog-title">Other systems</h2><p id="other-say" aria-live="polite">Loading …</p>
    <div class="row"><button id="close" autofocus>Close</button></div>`;
  dialog.querySelector("#close").onclick = () => dialog.close();
  if (!dialog.open) dialog.showModal();
  const systems = await loaded(compiled).catch((error) => {
    const here = location.protocol === "file:" ? "they are not in this file, and need the folder of the page and a web server" : error.message;
    dialog.querySelector("#other-say").textContent = `No other systems: ${here}.`;
  });
  if (!systems) return;
  const side = Math.max(Math.min(480, window.innerWidth - 80, window.innerHeight - 340), 120);
  dialog.querySelector("#other-say").insertAdjacentHTML(
    "beforebegin",
    `<label>Show <select id="other">${systems.map(({ name }, k) => `<option value="${k}">${name}</option>`).join("")}</select></label>
    <p id="other-about"></p><p id="other-legend"></p>
    <canvas id="other-canvas" tabindex="0" role="img" width="${FINE}" height="${FINE}" style="width:${side}px;image-rendering:pixelated" aria-label="Basins of the system"></canvas>`,
  );
  const find = (id) => dialog.querySelector(`#other${id}`);
  const view = new View(find("-canvas"), (text) => (find("-say").textContent = text));
  const open = () => {
    const system = systems[find("").value];
    find("-about").textContent = `${system.about} ${system.x} to the right, ${system.y} upwards; pale colours take longer. The wheel, + and − zoom, dragging and arrows move.`;
    find("-legend").innerHTML = system.fates.map(({ name, color }) => `<i class="swatch" style="background:${color}"></i>${name}`).join(" &nbsp; ");
    view.open(Number(find("").value), system);
  };
  find("").onchange = open;
  listen(view);
  open();
  // What the dialog does not show any more is not computed.
  dialog.addEventListener("close", () => (view.round += 1), { once: true });
}
