// The core: numbers in, bytes or JSON out.

/** A question that the libraries refuse, with their text. */
export class Refusal extends Error {}

export class Core {
  constructor({ exports }) {
    this.exports = exports;
  }

  #answer(status) {
    const { memory, answer_place, answer_length } = this.exports;
    // A view of the memory is valid until it grows: the bytes are copied.
    const bytes = new Uint8Array(memory.buffer, answer_place(), answer_length()).slice();
    if (status === 0) return bytes;
    throw new Refusal(new TextDecoder().decode(bytes));
  }

  #json(status) {
    return JSON.parse(new TextDecoder().decode(this.#answer(status)));
  }

  /** Columns from..to of a tile: pixels for an image, and one value for each pixel. */
  tile({ layer, logarithmic, x, alpha, columns, rows }, from, to) {
    const status = this.exports.tile(layer, Number(logarithmic), ...x, ...alpha, columns, rows, from, to);
    const bytes = this.#answer(status);
    const size = 4 * (to - from) * rows;
    return { pixels: new Uint8ClampedArray(bytes.buffer, 0, size), values: new Uint32Array(bytes.buffer, size) };
  }

  /** The mass ratios of the columns of a tile, then the speeds of its rows from below. */
  places({ logarithmic, x, alpha, columns, rows }) {
    return new Float64Array(
      this.#answer(this.exports.places(Number(logarithmic), ...x, ...alpha, columns, rows)).buffer,
    );
  }

  legend() {
    return this.#json(this.exports.legend());
  }
  point(m, alpha, hops) {
    return this.#json(this.exports.point(m, alpha, hops));
  }
  proof(m, alpha) {
    return this.#json(this.exports.proof(m, alpha));
  }
  map(m, from, to, points) {
    return this.#json(this.exports.map(m, from, to, points));
  }
  motion(m, alpha, hops) {
    return new Float64Array(this.#answer(this.exports.motion(m, alpha, hops)).buffer);
  }
  units(m, mass, stiffness, gravity) {
    return this.#json(this.exports.units(m, mass, stiffness, gravity));
  }
  circle(m, n) {
    return this.#json(this.exports.circle(m, n));
  }
  intervals(m, first, last) {
    return this.#json(this.exports.intervals(m, first, last));
  }
  openDepth(m, alpha) {
    return this.#json(this.exports.open_depth(m, alpha));
  }
  /** The place on the circle at the end of such a frame. */
  depthPhase(depth, m, alpha) {
    this.openDepth(m, alpha);
    return this.#json(this.exports.depth_phase(depth));
  }
  /** The fate at a point of such a frame, in half widths and half heights from its middle. */
  depthLabel(layer, depth, x, y, m, alpha) {
    this.openDepth(m, alpha);
    return this.#json(this.exports.depth_label(layer, depth, x, y));
  }
  systems() {
    return this.#json(this.exports.systems()).systems;
  }
  /** Columns of a picture of another system. */
  systemStrip(number, [left, right, bottom, top], columns, rows, from, to) {
    const status = this.exports.system_strip(number, left, right, bottom, top, columns, rows, from, to);
    return new Uint8ClampedArray(this.#answer(status).buffer);
  }
  /** The frame about the opened boundary point, or about the one at (m, alpha): a worker that replaces a dead one opens it again. */
  depthFrame(layer, depth, columns, rows, m, alpha) {
    if (m !== undefined) this.openDepth(m, alpha);
    return new Uint8ClampedArray(this.#answer(this.exports.depth_frame(layer, depth, columns, rows)).buffer);
  }
}
