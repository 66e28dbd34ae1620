// The legend: the colours of fates in plain words, or the bar of a layer of numbers; and the number of the layer at a point.
import { pretty, show } from "./numbers.js";
import { layers, state } from "./state.js";

const square = ({ color }) => `<i class="swatch" style="background:${color}"></i>`;
const swatch = (fate) => `<span title="${pretty(fate.name ?? "")}">${square(fate)}${fate.plain}</span>`;

/** Numbers beside a bar. */
const MARKS = [0, 0.5, 1];

const bar = ({ scale, legend }) => {
  const mark = (part) => `<span>${show(scale[Math.round(part * (scale.length - 1))].value, 3)}</span>`;
  const colors = scale.map((step) => step.color).join(",");
  return `<span class="scale">${legend} <span class="bar"><i style="background:linear-gradient(90deg,${colors})"></i><b>${MARKS.map(mark).join("")}</b></span></span>`;
};

export function paintLegend({ fates }, layer) {
  const { kind, color, legend: words } = layer;
  const box = document.getElementById("legend");
  if (kind === "numbers" || kind === "reals") {
    box.innerHTML = bar(layer) + (kind === "reals" ? swatch({ color: fates.at(-2).color, plain: "no number" }) : "");
    return;
  }
  const heights = fates.filter(({ label }) => label > 0 && label < 65000);
  const height = (fate, k) =>
    `<b title="${pretty(fate.name)}">${square(fate)}${fate.label}${k === heights.length - 1 ? " and more" : ""}</b>`;
  box.innerHTML =
    `<span>hops for ever, height ${heights.map(height).join("")}</span>` +
    fates
      .filter((fate) => !heights.includes(fate))
      .map(swatch)
      .join("") +
    (kind === "shares" ? `<span>${words}</span>` : color ? swatch({ color, plain: words }) : "");
}

/** What the values of a tile are: those of a layer of real numbers are bits of floats. */
export const numbersOf = (values, { kind }) => (kind === "reals" ? new Float32Array(values.buffer) : values);

/** Half of the width of the window of a point's pixel, as a part of the point. */
const NARROW = 1e-12;

/** The number of the layer at a point, in words; nothing for layers of fates. */
export async function numberAt(desk, { m, alpha }) {
  const layer = layers[state.layer];
  if (layer.kind !== "reals" && layer.kind !== "numbers") return "";
  const about = (x) => [x * (1 - NARROW), x * (1 + NARROW)];
  const window = { layer: state.layer, logarithmic: false, x: about(m), alpha: about(alpha), columns: 1, rows: 1 };
  const { values } = await desk.ask("tile", { ...window, values: true, strip: 1 });
  const [number] = numbersOf(values, layer);
  return `; ${layer.legend}: ${Number.isNaN(number) ? "none" : show(number, 6)}`;
}
