// The deep view: the chart of a boundary point, at any scale. The boundary point may be moved to the edge of the picture.
import { MARGIN, deepAxes, powerOfTen } from "./axes.js";
import { change, layers, say, state } from "./state.js";
import { pretty, show } from "./numbers.js";
import { MARK, dim, hatch, outlined } from "./plane.js";

/** Pixels of the first frame and of the fine one, each way; behind it comes one with the pixels of the screen, up to the largest. */
const QUICK = 48;
const FINE = 256;
const LARGEST = 1536;
/** Depths from which a frame of the screen takes longer than a second: the fine one is the last. */
const SLOW = 300;
/** A frame of twice the size shows what is there when the point is not in the middle. */
const TWICE = Math.log10(2);
/** Frames that are kept. */
const KEPT = 48;
/** The layer that the deep view shows: that of the plane, or the exact shares if that layer is nothing there. */
export function deepLayer() {
  if (layers[state.layer].besideEdges !== "nothing") return state.layer;
  return layers.findIndex(({ kind }) => kind === "shares");
}
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
    change({ depth: { m, alpha: about.alpha, depth, about, shift: [0, 0] } });
  }

  /** Moves the point away from the middle, up to the edge of the picture: in half widths and half heights. */
  move(right, up) {
    const [x, y] = state.depth.shift;
    const within = (place) => Math.min(Math.max(place, -1), 1);
    change({ depth: { ...state.depth, shift: [within(x + right), within(y + up)] } });
  }

  /** The fate at a place of the canvas, in words. */
  async at({ left, top }, { width, height }) {
    const { depth, about, shift } = state.depth;
    const [x, y] = [(2 * left) / width - 1 - shift[0], 1 - (2 * top) / height - shift[1]];
    const layer = deepLayer();
    const fate = await this.desk.ask("depthLabel", layer, depth, x, y, about.massRatio, about.alpha);
    const number = fate.number === undefined ? "" : `; ${layers[layer].legend}: ${show(fate.number, 6)}`;
    const times = (place, exponent) => `${show(place, 3)}·${powerOfTen(exponent)}`;
    return `α − p = ${times(y, -depth)}, M − M₀ = ${times(x, Math.log10(about.slant) - depth)}: ${fate.plain}${number}`;
  }

  /** Pixels of the best frame each way. */
  #most() {
    const { width, height } = this.plane.box;
    const ratio = window.devicePixelRatio || 1;
    return state.depth.depth > SLOW ? FINE : Math.min(Math.max(FINE, Math.round(ratio * Math.max(width, height))), LARGEST);
  }

  /** The next frame that is wanted: its depth and its pixels. */
  #next() {
    const { depth, shift } = state.depth;
    const layer = deepLayer();
    const has = (own, pixels) => this.frames.some((frame) => frame.layer === layer && frame.depth === own && frame.pixels >= pixels);
    const most = this.#most();
    const wanted = [[depth, QUICK]];
    if (shift.some((place) => place !== 0)) wanted.push([depth - TWICE, FINE]);
    wanted.push([depth, FINE], [depth, most]);
    if (shift.some((place) => place !== 0)) wanted.push([depth - TWICE, Math.min(2 * most, LARGEST)]);
    return wanted.find(([own, pixels]) => !has(own, pixels));
  }

  /** Zooms by a factor about the boundary point; true if the plane is to be shown again. */
  zoom(factor) {
    const depth = Math.min(state.depth.depth - Math.log10(factor), DEEPEST);
    change({ depth: { ...state.depth, depth, shift: [0, 0] } });
    return depth < SHALLOWEST;
  }

  /** Asks for the frames of the present depth: a quick one, then finer ones. */
  async request() {
    if (this.busy || !state.depth) return;
    const { about } = state.depth;
    const next = this.#next();
    if (!next) {
      this.plane.canvas.dispatchEvent(new Event("complete"));
      return;
    }
    const [depth, pixels] = next;
    const layer = deepLayer();
    this.busy = true;
    if (pixels === QUICK) await this.#findPhase(depth, about);
    try {
      const data = await this.desk.ask("depthFrame", layer, depth, pixels, pixels, about.massRatio, about.alpha);
      const bitmap = await createImageBitmap(new ImageData(data, pixels, pixels));
      if (state.depth?.about === about) this.frames.push({ layer, depth, pixels, bitmap });
      while (this.frames.length > KEPT) this.frames.shift().bitmap?.close();
    } catch (error) {
      say(`No picture at this depth: ${error.message}`);
      if (state.depth?.about === about) this.frames.push({ layer, depth, pixels: LARGEST, bitmap: null });
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

  /** What changes with the depth. */
  #phaseInWords({ depth, about }) {
    const { phase } = this;
    if (phase?.about !== about || phase.depth !== depth) return "";
    if (about.kind === "grounding") return `, which is ${powerOfTen(phase.lastSpeedExponent)} at the ${about.side === "above" ? "upper" : "lower"} end`;
    const exponent = phase.more + phase.turns.length - 1;
    const hops = exponent < 3 ? phase.turns : `${phase.turns[0]}.${phase.turns.slice(1)}·${powerOfTen(exponent)}`;
    // From some 10⁻⁴⁵ on the fraction is not known.
    const place = phase.error < 0.005 ? `phase ${phase.fraction.toFixed(2)} of the circle` : "a phase that is not known";
    return `. The window ends at ${place}: an orbit from there lingers for ${hops} hops`;
  }

  /** The quick frame and the fine one of the present depth: both, those that are there, and those that failed. */
  get parts() {
    const layer = deepLayer();
    const here = this.frames.filter((frame) => frame.layer === layer && frame.depth === state.depth.depth);
    const failed = here.some(({ bitmap }) => !bitmap);
    const fine = here.some(({ pixels, bitmap }) => bitmap && pixels >= FINE);
    return { all: 2, there: fine ? 2 : here.filter(({ bitmap }) => bitmap).length, failed: failed ? 1 : 0 };
  }

  paint(context, box) {
    const { depth, shift } = state.depth;
    hatch(context, MARGIN.left, MARGIN.top, box.width, box.height);
    const middle = {
      left: MARGIN.left + ((1 + shift[0]) * box.width) / 2,
      top: MARGIN.top + ((1 - shift[1]) * box.height) / 2,
    };
    // The wider a frame, the earlier it is drawn; a fine one after a quick one of the same depth.
    const layer = deepLayer();
    const sorted = this.frames.filter((frame) => frame.layer === layer).sort((a, b) => a.depth - b.depth || a.pixels - b.pixels);
    for (const frame of sorted) {
      const size = 10 ** (depth - frame.depth);
      if (!frame.bitmap || size < 0.02 || size > 1000) continue;
      context.imageSmoothingEnabled = false;
      const [width, height] = [box.width * size, box.height * size];
      context.drawImage(frame.bitmap, middle.left - width / 2, middle.top - height / 2, width, height);
    }
    dim(context, MARGIN.left, MARGIN.top, box.width, box.height);
    if (this.parts.failed) hatch(context, MARGIN.left, MARGIN.top, box.width, box.height, true);
    outlined(context, MARK, () => context.arc(middle.left, middle.top, 7, 0, 2 * Math.PI));
  }

  axes(size) {
    return deepAxes(state.depth.depth, state.depth.about.slant, size, state.depth.shift);
  }

  /** The view in words. */
  words() {
    const { name, besideEdges } = layers[state.layer];
    return besideEdges === "nothing" ? `${this.#words()}. The layer “${name}” is nothing here: the fates are shown` : this.#words();
  }

  #words() {
    const { depth, about } = state.depth;
    if (about.kind === "grounding")
      return (
        `Half height ${powerOfTen(-depth)} about p = ${show(about.alpha, 12)} at M = ${show(about.massRatio, 8)}: an edge of grounding, ` +
        `where hop ${about.hops} just uses up the energy. The picture is the same at every depth: ${about.side} p the hopper lifts off ` +
        `once more, at α′ = √(${show(about.growth, 4)} |α − p|), and hops ever lower. Only this speed changes${this.#phaseInWords(state.depth)}`
      );
    return (
      `Half height ${powerOfTen(-depth)} about p = ${show(about.alpha, 12)} at M = ${show(about.massRatio, 8)}: a boundary point that ` +
      `comes to the fixed point ${pretty(`α*_${about.n}`)} in ${about.hops} hops${this.#phaseInWords(state.depth)}`
    );
  }
}
