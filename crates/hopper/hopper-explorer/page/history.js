// The views before: an entry of the browser's history for each view that was looked at, so that its buttons, gestures and
// ours go back and forth through them.
import { write } from "./link.js";
import { state } from "./state.js";

/** Milliseconds after which the address follows, and for which a view must stay to be an entry. */
const [FOLLOWS, STAYS] = [200, 900];

let timers = [];
let entry = null; // the address of the last view that stayed; null until there is one
let moves = false; // whether the present entry is of a view that has not stayed yet

/** An address is followed: what is shown now is the present entry; or what is shown next, if a part of it is still looked for. */
export const begin = (waits) => {
  timers.forEach(clearTimeout);
  [entry, moves] = [waits ? null : write(state), false];
};

/** Keeps the address up to date some times a second. A change begins an entry, which is that of the view that stays. */
export function keep() {
  timers.forEach(clearTimeout);
  const follow = () => {
    const address = write(state);
    if (entry !== null && entry !== address && !moves) {
      history.pushState(null, "", address);
      moves = true;
    } else history.replaceState(null, "", address);
  };
  const settle = () => ([entry, moves] = [write(state), false]);
  timers = [setTimeout(follow, FOLLOWS), setTimeout(settle, STAYS)];
}
