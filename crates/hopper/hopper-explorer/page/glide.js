// Changes of the view that the eye can follow: zooms and flights glide, a plane that is thrown goes on for a while.
import { change, state } from "./state.js";
import { moved } from "./view.js";

/** Milliseconds of a zoom by a key, and of a flight. */
export const [ZOOM, FLIGHT] = [160, 700];
/** The part of its speed that a thrown plane keeps in a millisecond, and the speed in pixels a millisecond below which it stands. */
const [KEPT, LEAST] = [0.994, 0.02];

const still = matchMedia("(prefers-reduced-motion: reduce)");
let running = 0;

/** Ends what glides: a new wish comes first. */
export const halt = () => {
  running += 1;
};

/** Calls `frame(part, milliseconds)` until it returns false, once a frame. */
function run(frame) {
  halt();
  const mine = running;
  const begin = performance.now();
  let last = begin;
  const next = (now) => {
    if (mine !== running || !frame(now - begin, now - last)) return;
    last = now;
    requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
}

/** Between two intervals: the middle moves and the width changes by equal factors in equal times. */
function between([a, b], [c, d], part) {
  if (part >= 1) return [c, d];
  const width = (b - a) * ((d - c) / (b - a)) ** part;
  // The point that stays where it is, if the two are of different widths.
  const far = Math.abs(Math.log((d - c) / (b - a)));
  const share = far < 1e-9 ? part : (width - (b - a)) / (d - c - (b - a));
  const middle = (a + b) / 2 + share * ((c + d) / 2 - (a + b) / 2);
  return [middle - width / 2, middle + width / 2];
}

/** The view goes to another one. The promise is true when it is there, and false if something else came first. */
export function glide(view, time = FLIGHT) {
  const from = state.view;
  if (still.matches || from.logarithmic !== view.logarithmic) {
    halt();
    change({ view });
    return Promise.resolve(true);
  }
  return new Promise((done) => {
    run((passed) => {
      const part = Math.min(passed / time, 1);
      const eased = part * part * (3 - 2 * part);
      change({ view: { ...view, x: between(from.x, view.x, eased), alpha: between(from.alpha, view.alpha, eased) } });
      if (part >= 1) done(true);
      return part < 1;
    });
    const mine = running;
    const given = () => (mine === running ? setTimeout(given, time) : done(false));
    setTimeout(given, time);
  });
}

/** A plane of this size, in pixels, that is let go with a speed in pixels a millisecond. */
export function thrown(byLeft, byTop, box) {
  if (still.matches) return;
  let speed = [byLeft, byTop];
  run((_, passed) => {
    const { view } = state;
    const [x, alpha] = [view.x, view.alpha].map(([low, high]) => high - low);
    change({ view: moved(view, (-speed[0] * passed * x) / box.width, (speed[1] * passed * alpha) / box.height) });
    speed = speed.map((part) => part * KEPT ** passed);
    return Math.hypot(...speed) > LEAST;
  });
}
