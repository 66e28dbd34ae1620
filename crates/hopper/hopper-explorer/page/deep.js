// The deep view: the chart of a boundary point, at any scale. The boundary point stays in the middle.
import { MARGIN, deepAxes, powerOfTen } from "./axes.js";
import { change, say, state } from "./state.js";
import { pretty, show } from "./numbers.js";
import { MARK, dimmed, hatch, outlined } from "./plane.js";

/** Pixels of the first and of the last frame, each way. */
const QUICK = 48;
const FINE = 256;
/** Frames that are kept. */
const KEPT = 48;
/** Depths at which the chart is left for the plane, and the deepest one: there a fine frame takes seconds, and at 2000 half a minute. */
export const SHALLOWEST = 5.5;
export const DEEPEST = 1000;

export class Deep {
  constructor(plane, desk) {
    this.plane = plane;
    this.desk = desk;
    this.frames = [];
    this.busy = false;
  }

  /** Opens the boundary point next to a speed, if it is still wanted when it is found: `wanted` may fly there first. */
  async open(m, alpha, depth, wanted = () => true) {
    const about = await this.desk.ask("openDepth", m, alpha);
    if (!(await wanted(about))) return;
    this.frames.forEach(({ bitmap }) => bitmap?.close());
    this.frames = [];
    change({ depth: { m, alpha: about.alpha, depth, about } });
  }

  /** Zooms by a factor about the boundary point; true if the plane is to be shown again. */
  zoom(factor) {
    const depth = Math.min(state.depth.depth - Math.log10(factor), DEEPEST);
    change({ depth: { ...state.depth, depth } });
    return depth < SHALLOWEST;
  }

  /** Asks for the frames of the present depth: a quick one, then a fine one. */
  async request() {
    if (this.busy || !state.depth) return;
    const { depth, about } = state.depth;
    const here = this.frames.filter((frame) => frame.depth === depth);
    const pixels = here.length === 0 ? QUICK : here.some((frame) => frame.pixels === FINE) ? 0 : FINE;
    if (pixels === 0) {
      this.plane.canvas.dispatchEvent(new Event("complete"));
      return;
    }
    this.busy = true;
    if (pixels === QUICK) await this.#findPhase(depth, about);
    try {
      const data = await this.desk.ask("depthFrame", depth, pixels, pixels, about.massRatio, about.alpha);
      const bitmap = await createImageBitmap(new ImageData(data, pixels, pixels));
      if (state.depth?.about === about) this.frames.push({ depth, pixels, bitmap });
      while (this.frames.length > KEPT) this.frames.shift().bitmap?.close();
    } catch (error) {
      say(`No picture at this depth: ${error.message}`);
      if (state.depth?.about === about) this.frames.push({ depth, pixels: FINE, bitmap: null });
    }
    this.busy = false;
    this.plane.refresh();
    this.request();
  }

  /** The place on the circle with which a window ends: what changes with the depth. */
  async #findPhase(depth, about) {
    try {
      const found = await this.desk.ask("depthPhase", depth, about.massRatio, about.alpha);
      this.phase = { depth, about, ...found };
    } catch (error) {
      this.phase = null;
    }
    if (state.depth) say(this.words());
  }

  #phaseInWords({ depth, about }) {
    const { phase } = this;
    if (phase?.about !== about || phase.depth !== depth) return "";
    const exponent = phase.more + phase.turns.length - 1;
    const hops = exponent < 3 ? phase.turns : `${phase.turns[0]}.${phase.turns.slice(1)}·${powerOfTen(exponent)}`;
    // From some 10⁻⁴⁵ on the fraction is not known.
    const place = phase.error < 0.005 ? `phase ${phase.fraction.toFixed(2)} of the circle` : "a phase that is not known";
    return `. The window ends at ${place}: an orbit from there lingers for ${hops} hops`;
  }

  /** The quick frame and the fine one of the present depth: both, those that are there, and those that failed. */
  get parts() {
    const here = this.frames.filter(({ depth }) => depth === state.depth.depth);
    const failed = here.some(({ bitmap }) => !bitmap);
    const fine = here.some(({ pixels, bitmap }) => bitmap && pixels === FINE);
    return { all: 2, there: fine ? 2 : here.filter(({ bitmap }) => bitmap).length, failed: failed ? 1 : 0 };
  }

  paint(context, box) {
    const { depth } = state.depth;
    hatch(context, MARGIN.left, MARGIN.top, box.width, box.height);
    const middle = { left: MARGIN.left + box.width / 2, top: MARGIN.top + box.height / 2 };
    // The wider a frame, the earlier it is drawn; a fine one after a quick one of the same depth.
    const sorted = [...this.frames].sort((a, b) => a.depth - b.depth || a.pixels - b.pixels);
    for (const frame of sorted) {
      const size = 10 ** (depth - frame.depth);
      if (!frame.bitmap || size < 0.02 || size > 1000) continue;
      context.globalAlpha = dimmed();
      context.imageSmoothingEnabled = false;
      const [width, height] = [box.width * size, box.height * size];
      context.drawImage(frame.bitmap, middle.left - width / 2, middle.top - height / 2, width, height);
    }
    context.globalAlpha = 1;
    if (this.parts.failed) hatch(context, MARGIN.left, MARGIN.top, box.width, box.height, true);
    outlined(context, MARK, () => context.arc(middle.left, middle.top, 7, 0, 2 * Math.PI));
  }

  axes(size) {
    return deepAxes(state.depth.depth, state.depth.about.slant, size);
  }

  /** The view in words. */
  words() {
    const { depth, about } = state.depth;
    return (
      `Half height ${powerOfTen(-depth)} about p = ${show(about.alpha, 12)} at M = ${show(about.massRatio, 8)}: a boundary point that ` +
      `comes to the fixed point ${pretty(`α*_${about.n}`)} in ${about.hops} hops${this.#phaseInWords(state.depth)}`
    );
  }
}
