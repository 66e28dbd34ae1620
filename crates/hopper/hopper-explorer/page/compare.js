// A point that is kept beside the pinned one: both in a table.
import { show } from "./numbers.js";
import { change, state } from "./state.js";

const numbers = ({ orbit: [hop] }) => [
  ["sudden lift-offs", hop?.sudden],
  ["time of flight", hop && show(hop.flightTime, 7)],
  ["energy lost", hop && show(hop.energyLoss, 5)],
  ["∂α′/∂α", hop && hop.slope !== null ? show(hop.slope, 5) : "–"],
];

const rows = (one, other) => {
  const swatch = ({ fate }) => `<i class="swatch" style="background:${fate.color}"></i>${fate.plain}`;
  const next = ({ speeds }) => (speeds[1] === undefined ? "grounded" : show(speeds[1], 9));
  const known = [one, other].map(numbers);
  return [
    ["<i>M</i>", show(one.m, 9), show(other.m, 9)],
    ["<i>α</i>", show(one.speeds[0], 10), show(other.speeds[0], 10)],
    ["fate", swatch(one), swatch(other)],
    ["known after", `${one.hops} hops`, `${other.hops} hops`],
    ["next speed α′", next(one), next(other)],
    ...known[0].map(([name, value], k) => [name, value ?? "–", known[1][k][1] ?? "–"]),
  ];
};

/** Shows the kept point beside the pinned one, or how to keep one. */
export function showCompared(box, kept, pinned) {
  const button = document.createElement("button");
  if (!kept) {
    button.textContent = "Keep this point to compare";
    button.disabled = !state.pin;
    button.onclick = () => change({ other: { ...state.pin } });
    box.replaceChildren(button);
    return;
  }
  const cells = rows(kept, pinned).map(([name, one, other]) => `<tr><th scope="row">${name}</th><td>${one}</td><td>${other}</td></tr>`);
  box.innerHTML = `<div class="wide" tabindex="0" role="region" aria-label="Two points compared"><table><thead><tr><td></td><th scope="col">□ kept</th><th scope="col">○ pinned</th></tr></thead><tbody>${cells.join("")}</tbody></table></div>`;
  button.textContent = "Forget the kept point";
  button.onclick = () => change({ other: null });
  box.append(button);
}

/** Hops of the kept point's orbit that are asked for. */
const HOPS = 4;
export const asked = async (desk, { m, alpha }) => ({ m, ...(await desk.ask("point", m, alpha, HOPS)) });
