// Every action has a key. Keys are not taken from inputs.

export const KEYS = [
  ["arrows", "move by a tenth of the window"],
  ["+ −", "zoom both axes"],
  ["X x", "zoom M in, out"],
  ["A a", "zoom α in, out"],
  ["Enter", "pin the middle"],
  ["H", "the whole window"],
  ["Z Y", "the view before, the next one"],
  ["G", "places with names"],
  ["L", "M linear or logarithmic"],
  ["1 2 … 9 0", "the layers, in the order of the list"],
  ["D", "deep zoom to the nearest edge"],
  ["Esc", "leave the deep zoom, the tour"],
  ["space", "play or pause"],
  [", .", "one frame back, on"],
  ["T", "tour; N and P: next and previous stop"],
  ["S", "save"],
  ["C", "link"],
  ["?", "this help"],
];

const SWITCH = "hopper-explorer letters";
const stored = () => {
  try {
    return localStorage.getItem(SWITCH);
  } catch {
    return null;
  }
};
let on = stored() !== "off";

/** Whether single letters are keys: a person who dictates, or whose hand trembles, may not want them. */
export const letters = () => on;
export const useLetters = (wanted) => {
  on = wanted;
  try {
    localStorage.setItem(SWITCH, on ? "on" : "off");
  } catch {
    // It holds until the page is closed.
  }
};

export function keys(actions) {
  addEventListener("keydown", (event) => {
    // A dialog that was just closed can still have the focus, for a frame.
    const typing = event.target.closest("input, select, textarea, dialog[open]");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    // Space and Enter belong to a focused button.
    if (event.target.closest("button, summary") && [" ", "Enter"].includes(event.key)) return;
    if (!on && event.key.length === 1 && !["+", "-", " "].includes(event.key)) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
