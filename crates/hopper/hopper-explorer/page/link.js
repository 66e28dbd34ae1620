// The address of a view. Doubles are written with all their digits, so that a link gives the same bits.
import { DEEPEST } from "./deep.js";
import { HOPS, layers, state } from "./state.js";
import { isView } from "./view.js";

export function write({ view, layer, pin, other, hops, depth }) {
  const parts = [`${view.logarithmic ? "log" : "lin"}=${[...view.x, ...view.alpha].join(",")}`];
  // What every view begins with is left out.
  if (layers[layer].kind !== "shares") parts.push(`layer=${layers[layer].key}`);
  if (pin) parts.push(`pin=${pin.m},${pin.alpha}`);
  if (pin && hops !== HOPS) parts.push(`hops=${hops}`);
  if (other) parts.push(`with=${other.m},${other.alpha}`);
  if (document.body.classList.contains("embedded")) parts.push("embed");
  if (depth) parts.push(`depth=${depth.m},${depth.alpha},${depth.depth}`);
  return `#${parts.join("&")}`;
}

/** The address of what is shown now. */
export const address = () => `${location.href.split("#")[0]}${write(state)}`;

const doubles = (text, count) => {
  const all = text.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
  return all.length === count && all.every(Number.isFinite) ? all : null;
};

/** The fields of an address, and the parts that make no sense. */
export function read(hash) {
  const fields = {};
  const wrong = [];
  for (const part of hash.replace(/^#/, "").split("&").filter(Boolean)) {
    const [name, value = ""] = part.split("=", 2);
    let good = false;
    if (name === "lin" || name === "log") {
      const all = doubles(value, 4);
      const [left, right, bottom, top] = all ?? [];
      const view = { logarithmic: name === "log", x: [left, right], alpha: [bottom, top] };
      good = all !== null && isView(view);
      if (good) fields.view = view;
    } else if (name === "layer") {
      const found = layers.findIndex(({ key, otherKey }) => key === value || otherKey === value);
      good = found >= 0;
      if (good) fields.layer = found;
    } else if (name === "pin" || name === "with") {
      const all = doubles(value, 2);
      good = all !== null && all[0] > 0 && all[1] > 0;
      if (good) fields[name === "pin" ? "pin" : "other"] = { m: all[0], alpha: all[1] };
    } else if (name === "hops") {
      good = /^\d{1,2}$/.test(value) && Number(value) >= 1;
      if (good) fields.hops = Number(value);
    } else if (name === "embed") {
      good = value === "";
      if (good) fields.embedded = true;
    } else if (name === "depth") {
      const all = doubles(value, 3);
      good = all !== null && all[0] > 0 && all[1] > 0 && all[2] >= 0 && all[2] <= DEEPEST;
      if (good) fields.depth = { m: all[0], alpha: all[1], depth: all[2] };
    }
    if (!good) wrong.push(part.slice(0, 40));
  }
  return { fields, wrong };
}
