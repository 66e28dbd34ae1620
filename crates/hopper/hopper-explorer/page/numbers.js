// Numbers as people write and read them. A double is shown with all its digits where it is an input.

/** A number in any of the usual ways: 0.2, 0,2, 1e-3, 1,5·10^-3, ².  Null for anything else. */
export function parse(text) {
  const plain = text
    .trim()
    .replace(/\s|_/g, "")
    .replace("−", "-")
    .replace(/[·×*]10\^?/, "e")
    .replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) && Number.isFinite(Number(plain)) ? Number(plain) : null;
}

/** Some digits for reading, with a true minus and powers of ten. */
export function show(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const text = Number(value.toPrecision(digits)).toString();
  const [mantissa, power] = text.split("e");
  return (power ? `${mantissa}·10${superscript(Number(power))}` : mantissa).replace("-", "−");
}

const SUPER = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
export const superscript = (value) => String(value).replace(/[-\d]/g, (digit) => SUPER[digit]);
const SUB = "₀₁₂₃₄₅₆₇₈₉";
export const star = (n) => `α*${String(n).replace(/\d/g, (digit) => SUB[digit])}`;

/** A name of the library, with its index set low. */
export const pretty = (name) => name.replace(/α\*_(\d+)/, (_, n) => star(n));

/** Round places of an axis, with labels. If the labels would be long, they count from a round number in a power of ten. */
export function ticks([low, high], most) {
  const raw = (high - low) / most;
  const power = Math.floor(Math.log10(raw));
  const unit = 10 ** power;
  const step = [1, 2, 5, 10].find((factor) => factor * unit >= raw * 0.999) * unit;
  const first = Math.ceil(low / step);
  const places = [];
  for (let k = first; k * step <= high && places.length < 50; k++) places.push(k * step);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (decimals <= 6)
    return { base: null, marks: places.map((at) => ({ at, label: at.toFixed(decimals).replace("-", "−") })) };
  const base = places[0] ?? low;
  const marks = places.map((at) => ({ at, label: `${Math.round((at - base) / unit)}` }));
  return { base: `${base.toFixed(Math.min(decimals, 17))} + … · 10${superscript(power)}`, marks };
}
