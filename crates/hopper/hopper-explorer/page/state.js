// What the page shows, in one place. A change tells all who listen, once a frame.

/** Hops of the motion, until the reader chooses. */
export const HOPS = 6;

export const state = {
  view: { logarithmic: false, x: [0, 1], alpha: [4.4, 20.5] },
  layer: 0,
  pin: null, // { m, alpha }
  other: null, // the same: a point kept to compare
  hops: HOPS, // hops of the motion
  depth: null, // { m, alpha, depth, about }: the deep view
};

/** The layers, as the libraries list them: key, name, kind, cost. The core fills it before anything is drawn. */
export const layers = [];

const listeners = [];
let waiting = new Set();

/** Calls back with the names of the fields that changed. */
export const listen = (callback) => listeners.push(callback);

export function change(fields) {
  Object.assign(state, fields);
  const first = waiting.size === 0;
  Object.keys(fields).forEach((name) => waiting.add(name));
  if (first)
    queueMicrotask(() => {
      const names = waiting;
      waiting = new Set();
      listeners.forEach((callback) => callback(names));
    });
}

const said = document.getElementById("say");
/** A line for everyone, also for screen readers. */
export const say = (text) => {
  if (said.textContent !== text) said.textContent = text;
};
