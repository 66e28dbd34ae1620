// The line M = const through the pinned point: dashed in the plane, and beside it the column of pixels at exactly this M.
import { MARGIN } from "./axes.js";
import { dim } from "./plane.js";
import { state } from "./state.js";
import { place, toX } from "./view.js";

/** Milliseconds for which a view must stand still. */
const STILL = 200;
/** The width of the column and its distance from the plane, in the room beside it. */
const [WIDE, APART] = [10, 5];
/** Half of the width of the column's window in M, as a part of M. */
const NARROW = 1e-12;
/** Most pixels of the column. */
const TALLEST = 2048;

export class Column {
  constructor(plane, desk) {
    this.plane = plane;
    this.desk = desk;
    this.shown = null; // { view, m, layer, bitmap }
    this.waits = 0;
  }

  #fits({ view, m, layer }) {
    return view === state.view && m === state.pin?.m && layer === state.layer;
  }

  /** Asks for the column of the pinned point, when the view stands still. */
  request() {
    clearTimeout(this.waits);
    if (!state.pin || state.depth || (this.shown && this.#fits(this.shown))) return;
    this.waits = setTimeout(() => this.#ask(), STILL);
  }

  async #ask() {
    const wanted = { view: state.view, m: state.pin?.m, layer: state.layer };
    const { m, layer, view } = wanted;
    if (!m || state.depth) return;
    const rows = Math.min(Math.round(this.plane.box.height * (window.devicePixelRatio || 1)), TALLEST);
    const alpha = [Math.max(view.alpha[0], 0), view.alpha[1]];
    const job = { layer, logarithmic: false, x: [m * (1 - NARROW), m * (1 + NARROW)], alpha, columns: 1, rows, strip: 1 };
    try {
      const { bitmap } = await this.desk.ask("tile", job);
      if (!this.#fits(wanted)) return bitmap?.close();
      this.shown?.bitmap?.close();
      this.shown = { ...wanted, alpha, bitmap };
      this.plane.refresh();
    } catch {
      // The plane has said why; the column stays empty.
    }
  }

  paint(context, box, ink) {
    if (!state.pin || state.depth) return;
    const { left } = place(state.view, toX(state.view, state.pin.m), 0, box);
    if (left < 0 || left > box.width) return;
    context.save();
    context.strokeStyle = "#000";
    context.setLineDash([2, 4]);
    context.beginPath();
    context.moveTo(MARGIN.left + left, MARGIN.top);
    context.lineTo(MARGIN.left + left, MARGIN.top + box.height);
    context.stroke();
    context.restore();
    if (!this.shown || !this.#fits(this.shown)) return;
    const [x, y] = [MARGIN.left + box.width + APART, MARGIN.top];
    const top = place(state.view, 0, this.shown.alpha[1], box).top;
    const bottom = place(state.view, 0, this.shown.alpha[0], box).top;
    context.imageSmoothingEnabled = false;
    context.drawImage(this.shown.bitmap, x, y + top, WIDE, bottom - top);
    dim(context, x, y + top, WIDE, bottom - top);
    context.strokeStyle = ink;
    context.strokeRect(x - 0.5, y - 0.5, WIDE + 1, box.height + 1);
  }
}
