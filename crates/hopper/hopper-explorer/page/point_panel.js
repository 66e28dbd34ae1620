// The pinned point: its numbers, its fate and why, and its orbit hop by hop.
import { parse, pretty, show, star } from "./numbers.js";
import { change, say, state } from "./state.js";

const panel = document.getElementById("point");
panel.innerHTML = `<h2 class="verdict" id="verdict" aria-live="polite">A start</h2>
  <div class="numbers"><label for="pin-m">mass ratio <i>M</i></label><input id="pin-m" inputmode="decimal" autocomplete="off">
  <label for="pin-alpha">lift-off speed <i>α</i></label><input id="pin-alpha" inputmode="decimal" autocomplete="off"></div>
  <div id="fate"></div>`;
const verdict = document.getElementById("verdict");
const [m, alpha] = ["pin-m", "pin-alpha"].map((id) => document.getElementById(id));

const typed = new Set(); // inputs whose text is not read yet
for (const input of [m, alpha]) {
  input.addEventListener("input", () => typed.add(input));
  input.addEventListener("change", () => {
    typed.delete(input);
    const numbers = [m, alpha].map(({ value }) => parse(value));
    if (numbers.every((number) => number > 0)) change({ pin: { m: numbers[0], alpha: numbers[1] }, depth: null });
    else if (input.value.trim() && !(parse(input.value) > 0))
      say(`“${input.value}” is not a positive number. Examples: 0.2 or 0,2 or 2e-1.`);
  });
}

/** Writes the pinned numbers, but not over a text that someone is typing. */
export function showPin() {
  const show = (input, number) => {
    if (!typed.has(input)) input.value = number === undefined ? "" : String(number);
  };
  show(m, state.pin?.m);
  show(alpha, state.pin?.alpha);
}

/** Why the fate is known, in words. */
function reason({ fate, hops, trap, reason: unknown, grounded, arithmetic, errors }) {
  const after = hops === 0 ? "The start is already" : `After ${hops} hop${hops === 1 ? "" : "s"} the speed is`;
  const sure =
    `Every decision is larger than its error bound; the orbit shown has ${arithmetic} and an error of at most ` +
    `${show(Math.max(...errors), 2)}.`;
  if (unknown) return `Undecided: ${unknown}.`;
  if (!trap)
    return `${hops === 1 ? "The first hop" : `Hop ${hops}`} is the last one: too little energy is left to lift off again. ${sure}`;
  const inside =
    trap.n === 0
      ? `${after} in the trap of 0, up to ${show(trap.right)}: the hops become lower and lower but never stop.`
      : `${after} in the trap of ${star(trap.n)}, from ${show(trap.left, 9)} to ${show(trap.right, 9)}. No orbit leaves it: the hopper hops for ever.`;
  return `${inside} ${grounded ? "" : sure}`;
}

export function showFate(found) {
  const { fate, orbit } = found;
  const [first] = orbit;
  const slopes =
    first?.slope === null || !first
      ? ""
      : `<p class="soft">∂α′/∂α = ${show(first.slope)}, ∂α′/∂M = ${show(first.massRatioSlope)}</p>`;
  const words = fate.plain[0].toUpperCase() + fate.plain.slice(1);
  verdict.innerHTML = `<i class="swatch" style="background:${fate.color}"></i> ${words} <span class="soft">${pretty(fate.name)}</span>`;
  document.getElementById("fate").innerHTML =
    `<p>${reason(found)}</p><p id="proof"></p>${slopes}`;
}

/** Whether the fate is proved. */
export function showProof({ fate }, { fate: proved }) {
  const text = !proved
    ? fate.label < 65533
      ? "Computed, not proved: enclosures of the orbit do not lead into a proved trap."
      : ""
    : `Proved${proved.label === fate.label ? "" : `: ${pretty(proved.name)}`}, by enclosures of the whole orbit with rounding outwards.`;
  document.getElementById("proof").textContent = text;
}

/** A sentence in place of a fate. */
export function showSentence(text) {
  verdict.textContent = "A start";
  const line = document.createElement("p");
  line.textContent = text;
  document.getElementById("fate").replaceChildren(line);
  document.querySelector("#orbit div").replaceChildren();
}

/** Hops that are listed after the fate is known. */
const AFTER = 4;

export function showOrbit({ orbit, errors, grounded, hops }) {
  const listed = orbit.slice(0, Math.max(hops, 1) + AFTER);
  const row = (hop, k) =>
    `<tr><td>${k}</td><td>${show(hop.speed, 10)}</td><td>${k < errors.length ? show(errors[k], 2) : "–"}</td>` +
    `<td>${hop.sudden}</td><td>${show(hop.energyLoss, 5)}</td><td>${show(hop.slope, 5)}</td></tr>` +
    (hop.sudden > 0
      ? hop.landings
          .map(
            (landing, at) =>
              `<tr class="soft"><td></td><td>landing ${at + 1}${landing.sudden ? ", sudden lift-off" : ""}</td><td></td><td></td>` +
              `<td>${show(landing.energyLoss, 5)}</td><td></td></tr>`,
          )
          .join("")
      : "");
  document.querySelector("#orbit div").innerHTML =
    `<div class="wide" tabindex="0" role="region" aria-label="The orbit hop by hop"><table><thead><tr><th>hop</th><th>α</th><th>error ≤</th><th>sudden</th><th>energy lost</th><th>∂α′/∂α</th></tr></thead>` +
    `<tbody>${listed.map(row).join("")}</tbody></table></div>${grounded ? "<p>The last hop ends on the ground.</p>" : '<p class="soft">And so on.</p>'}`;
}
