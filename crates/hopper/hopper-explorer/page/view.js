// A window of the plane: M (or log₂ M) to the right, α upwards. Each axis has its own scale. Pure functions on plain
// objects.

/** The smallest height of a window of doubles: below it, neighbouring pixels would be the same double. */
const ULPS_A_PIXEL = 8;
const SMALLEST_M = 2 ** -30;

export const toX = (view, m) => (view.logarithmic ? Math.log2(m) : m);
export const toM = (view, x) => (view.logarithmic ? 2 ** x : x);

/** The place of (x, α) in a box of the size, in pixels from the left and from the top. */
export function place(view, x, alpha, { width, height }) {
  return {
    left: ((x - view.x[0]) / (view.x[1] - view.x[0])) * width,
    top: ((view.alpha[1] - alpha) / (view.alpha[1] - view.alpha[0])) * height,
  };
}

/** The point of the plane at a place in the box. */
export function at(view, left, top, { width, height }) {
  return {
    x: view.x[0] + (left / width) * (view.x[1] - view.x[0]),
    alpha: view.alpha[1] - (top / height) * (view.alpha[1] - view.alpha[0]),
  };
}

/** The view with its scales multiplied by the factors; the point stays where it is. */
export function zoomed(view, { x, alpha }, factorX, factorAlpha) {
  const around = ([low, high], centre, factor) => [centre - (centre - low) * factor, centre + (high - centre) * factor];
  return bounded(rounded({ ...view, x: around(view.x, x, factorX), alpha: around(view.alpha, alpha, factorAlpha) }), view);
}

export function moved(view, byX, byAlpha) {
  return bounded(rounded({ ...view, x: view.x.map((end) => end + byX), alpha: view.alpha.map((end) => end + byAlpha) }), view);
}

/** A part of a window that no screen shows: what is rounded to it has a short link. */
const UNSEEN = 1e-5;

/** A number with few decimals, not farther away than a part of a window of this width that no screen shows. */
export function short(number, width) {
  const decimals = Math.ceil(-Math.log10(width * UNSEEN));
  return decimals >= 0 && decimals <= 100 ? Number(number.toFixed(decimals)) : number;
}

/** The point of the plane to pin, with few decimals. */
export function toPin(view, { x, alpha }) {
  const [m, width] = [toM(view, x), view.x[1] - view.x[0]];
  // On the logarithmic axis a step has another width at each M.
  return { m: short(m, view.logarithmic ? m * Math.LN2 * width : width), alpha: short(alpha, view.alpha[1] - view.alpha[0]) };
}

/** The same window with ends that have few decimals. */
export function rounded(view) {
  const ends = ([low, high]) => [short(low, high - low), short(high, high - low)];
  return { ...view, x: ends(view.x), alpha: ends(view.alpha) };
}

/** Whether the pixels of an axis are too fine for doubles. */
export function tooFine([low, high], pixels = 1000) {
  return high - low < ULPS_A_PIXEL * pixels * 2 ** -52 * Math.max(Math.abs(low), Math.abs(high));
}

/** The view, or what of it is in the model; an axis that would be too fine or too wide stays as it was. */
export function bounded(view, before) {
  const { x, alpha } = limits(view);
  return { ...view, x: axis(view.x, before.x, x), alpha: axis(view.alpha, before.alpha, alpha) };
}

// For larger M a hop has thousands of sudden lift-offs, and a tile takes minutes.
const limits = ({ logarithmic }) => ({ x: logarithmic ? [-30, 14] : [0, 2 ** 14], alpha: [0, 2e5] });

/** Whether a view is in the model, and not too fine. */
export function isView(view) {
  const { x, alpha } = limits(view);
  const good = ([low, high], [least, most]) => low >= least && low < high && high <= most && !tooFine([low, high]);
  return good(view.x, x) && good(view.alpha, alpha);
}

function axis([low, high], before, [least, most]) {
  if (!(high > low) || tooFine([low, high])) return before;
  const length = Math.min(high - low, most - least);
  const start = Math.min(Math.max(low, least), most - length);
  return start === low && length === high - low ? [low, high] : [start, start + length];
}

/** The same window with the other scale of M. A window from 0 on begins at a thousandth of its end. */
export function withLogarithm(view, logarithmic) {
  if (view.logarithmic === logarithmic) return view;
  const [low, high] = view.x;
  const x = logarithmic
    ? [Math.log2(Math.max(low, high / 1000, SMALLEST_M)), Math.log2(high)]
    : [low, high].map((end) => 2 ** end);
  return { ...view, logarithmic, x };
}
