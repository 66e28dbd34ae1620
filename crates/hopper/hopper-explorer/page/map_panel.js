// The map at the pinned M with the cobweb of the orbit. Dragging along the picture moves α.
import { show, star } from "./numbers.js";
import { change, state } from "./state.js";
import { Drawing } from "./svg.js";

const panel = document.getElementById("map");
let drawing = null;

export const hideMap = (why = "") => {
  drawing = null;
  panel.textContent = why;
};

export function showMap({ pieces, stars, undecided }, { massRatio, speeds, grounded, fate }, window) {
  drawing = new Drawing({
    x: window,
    y: window,
    height: 400,
    xName: "α",
    yName: "f(α; M)",
    title: `The map at M = ${massRatio} with the orbit from ${speeds[0]}: ${fate.name}`,
  });
  for (const { trap, light } of stars) drawing.band(trap.left, trap.right, light);
  drawing.curve(
    [
      [window[0], window[0]],
      [window[1], window[1]],
    ],
    "currentColor",
    0.6,
    'stroke-dasharray="2 3"',
  );
  for (const { points } of pieces) {
    drawing.curve(
      Array.from({ length: points.length / 2 }, (_, k) => [points[2 * k], points[2 * k + 1]]),
      "currentColor",
    );
  }
  const corners = [[speeds[0], window[0]]];
  for (let k = 1; k < speeds.length; k++) corners.push([speeds[k - 1], speeds[k]], [speeds[k], speeds[k]]);
  if (grounded) corners.push([speeds.at(-1), window[0]]);
  drawing.curve(corners, "var(--lower)", 1.1).dot(speeds[0], window[0], "var(--lower)", 4);
  for (const { n, trap } of stars) {
    if (n > 0 && trap.left > window[0] && trap.left < window[1])
      drawing.dot(trap.left, trap.left, "currentColor").text(trap.left, trap.left, `${star(n)}\u2002`, "end");
  }
  const rows = stars
    .map(
      ({ n, trap, crisis, grounding }) =>
        `<tr><td>${star(n)}</td><td>${show(trap.left, 6)}</td><td>${show(trap.length, 4)}</td><td>${trap.edge}</td>` +
        `<td>${crisis ? show(crisis.massRatio, 5) : "–"}</td><td>${show(grounding.massRatio, 5)}</td></tr>`,
    )
    .join("");
  panel.innerHTML = `<h2>The map at <i>M</i> = ${show(massRatio)}</h2><div class="picture">${drawing.markup()}</div>
    <p class="soft">Red: the orbit. Bands: the traps, with their lengths below. Drag along the picture to move α.${undecided ? ` ${undecided} points of the curve are not decided and left out.` : ""}</p>
    <div class="wide" tabindex="0" role="region" aria-label="Fixed points and their traps"><table><thead><tr><td></td><th>α*</th><th>trap</th><th>ends at</th><th>crisis <i>M</i></th><th>grounding <i>M</i></th></tr></thead><tbody>${rows}</tbody></table></div>`;
}

let held = false;
const drag = (event) => {
  const svg = event.target.closest?.("svg") ?? panel.querySelector("svg");
  if (!svg || !drawing || !state.pin) return;
  const box = svg.getBoundingClientRect();
  const px = ((event.clientX - box.left) / box.width) * 400;
  const part = Math.min(Math.max((px - drawing.left) / (drawing.right - drawing.left), 0.001), 0.999);
  change({ pin: { ...state.pin, alpha: drawing.x[0] + part * (drawing.x[1] - drawing.x[0]) } });
};
panel.addEventListener("pointerdown", (event) => {
  if (event.target.closest("svg")) {
    held = true;
    drag(event);
    event.preventDefault();
  }
});
addEventListener("pointermove", (event) => {
  if (held) drag(event);
});
addEventListener("pointerup", () => {
  if (held) {
    held = false;
    change({ pin: { ...state.pin } });
  }
});
export const isHeld = () => held;
