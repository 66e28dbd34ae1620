// Every action has a key. Keys are not taken from inputs.

export const KEYS = [
  ["arrows", "move by a tenth of the window"],
  ["+ −", "zoom both axes"],
  ["X x", "zoom M in, out"],
  ["A a", "zoom α in, out"],
  ["Enter", "pin the middle"],
  ["H", "the whole window"],
  ["L", "M linear or logarithmic"],
  ["1 2 …", "the layers, in the order of their buttons"],
  ["D", "deep zoom to the nearest edge"],
  ["Esc", "leave the deep zoom, the tour"],
  ["space", "play or pause"],
  [", .", "one frame back, on"],
  ["T", "tour; N and P: next and previous stop"],
  ["S", "save"],
  ["C", "link"],
  ["?", "this help"],
];

export function keys(actions) {
  addEventListener("keydown", (event) => {
    // A dialog that was just closed can still have the focus, for a frame.
    const typing = event.target.closest("input, select, textarea, dialog[open]");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    // Space and Enter belong to a focused button.
    if (event.target.closest("button, summary") && [" ", "Enter"].includes(event.key)) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
