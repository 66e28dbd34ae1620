// The axes of a picture as a list of lines and texts, which a canvas and an SVG file draw alike.
import { superscript, star, ticks } from "./numbers.js";
import { place } from "./view.js";

/** Room for labels, in CSS pixels at the usual size of letters. */
const ROOM = { left: 62, bottom: 44, right: 20, top: 8 };
export const MARGIN = { ...ROOM };
/** The size of letters against the usual one: the style sheet has larger ones on large screens. */
let unit = 1;

export const letterSize = () => 12 * unit;

/** Takes the size of letters of the page. */
export function fitLetters() {
  unit = parseFloat(getComputedStyle(document.documentElement).fontSize) / 15;
  for (const [side, room] of Object.entries(ROOM)) MARGIN[side] = room * unit;
}

export const inner = ({ width, height }) => ({
  width: Math.max(width - MARGIN.left - MARGIN.right, 1),
  height: Math.max(height - MARGIN.top - MARGIN.bottom, 1),
});

/** Lines and texts of the plane. */
export function planeAxes(view, size, fixedPoints) {
  const box = inner(size);
  const parts = [];
  const bottom = MARGIN.top + box.height;
  const horizontal = view.logarithmic
    ? logTicks(view.x, box.width / (80 * unit))
    : ticks(view.x, box.width / (90 * unit));
  for (const { at, label } of horizontal.marks) {
    const x = MARGIN.left + place(view, at, 0, box).left;
    parts.push(
      { line: [x, bottom, x, bottom + 5 * unit] },
      { text: label, x, y: bottom + 18 * unit, anchor: "middle" },
    );
  }
  const vertical = ticks(view.alpha, box.height / (60 * unit));
  for (const { at, label } of vertical.marks) {
    const y = MARGIN.top + place(view, 0, at, box).top;
    parts.push(
      { line: [MARGIN.left - 5 * unit, y, MARGIN.left, y] },
      { text: label, x: MARGIN.left - 8 * unit, y: y + 4 * unit, anchor: "end" },
    );
  }
  fixedPoints.forEach((alpha, n) => {
    if (n === 0 || !(alpha > view.alpha[0] && alpha < view.alpha[1])) return;
    const y = MARGIN.top + place(view, 0, alpha, box).top;
    parts.push({ line: [size.width - MARGIN.right - 9 * unit, y, size.width - MARGIN.right, y], inside: true });
    parts.push({
      text: star(n),
      x: size.width - MARGIN.right - 12 * unit,
      y: y - 3 * unit,
      anchor: "end",
      inside: true,
    });
  });
  const m = horizontal.base ? `mass ratio M = ${horizontal.base}` : "mass ratio M = m₂/m₁";
  const alpha = vertical.base ? `lift-off speed α = ${vertical.base}` : "lift-off speed α (m₂gω/k)";
  parts.push({ text: m, x: MARGIN.left + box.width / 2, y: bottom + 36 * unit, anchor: "middle" });
  parts.push({ text: alpha, x: 14 * unit, y: MARGIN.top + box.height / 2, anchor: "middle", turned: true });
  return parts;
}

/** Powers of two, or of ten if they are many. */
function logTicks([low, high], most) {
  if (high - low < 2) {
    const plain = ticks([2 ** low, 2 ** high], most);
    return { ...plain, marks: plain.marks.map(({ at, label }) => ({ at: Math.log2(at), label })) };
  }
  const step = Math.ceil((high - low) / most);
  const marks = [];
  for (let k = Math.ceil(low / step) * step; k <= high; k += step) {
    marks.push({ at: k, label: k >= -3 && k <= 10 ? String(2 ** k) : `2${superscript(k)}` });
  }
  return { base: null, marks };
}

/** Lines and texts about a boundary point: places in half heights. The point is this far from the middle. */
export function deepAxes(depth, slant, size, [right, up]) {
  const box = inner(size);
  const bottom = MARGIN.top + box.height;
  const parts = [];
  for (const part of [-2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2]) {
    const label = part === 0 ? "0" : `${part < 0 ? "−" : "+"}${Math.abs(part)}`;
    const x = MARGIN.left + ((part + right + 1) / 2) * box.width;
    const y = MARGIN.top + ((1 - part - up) / 2) * box.height;
    if (Math.abs(part + right) <= 1)
      parts.push(
        { line: [x, bottom, x, bottom + 5 * unit] },
        { text: label, x, y: bottom + 18 * unit, anchor: "middle" },
      );
    if (Math.abs(part + up) <= 1)
      parts.push(
        { line: [MARGIN.left - 5 * unit, y, MARGIN.left, y] },
        { text: label, x: MARGIN.left - 8 * unit, y: y + 4 * unit, anchor: "end" },
      );
  }
  const scale = powerOfTen(-depth);
  parts.push({
    text: `M − M₀ in units of ${powerOfTen(-depth + Math.log10(slant))}`,
    x: MARGIN.left + box.width / 2,
    y: bottom + 36 * unit,
    anchor: "middle",
  });
  parts.push({
    text: `α − p in units of ${scale}`,
    x: 14 * unit,
    y: MARGIN.top + box.height / 2,
    anchor: "middle",
    turned: true,
  });
  return parts;
}

/** 10^exponent for any exponent, as 3.2·10⁻¹⁰⁰. */
export function powerOfTen(exponent) {
  const whole = Math.floor(exponent + 1e-9);
  const mantissa = 10 ** (exponent - whole);
  const digits = mantissa.toPrecision(2);
  return digits === "1.0" ? `10${superscript(whole)}` : `${digits}·10${superscript(whole)}`;
}

export function paintAxes(context, parts, pageInk) {
  context.font = `${letterSize()}px system-ui, sans-serif`;
  for (const part of parts) {
    // The colours of fates are the same on a dark page.
    const ink = part.inside ? "#000" : pageInk;
    context.strokeStyle = ink;
    context.fillStyle = ink;
    if (part.line) {
      const [x0, y0, x1, y1] = part.line;
      context.lineWidth = (part.inside ? 2 : 1) * unit;
      context.beginPath();
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
      context.stroke();
      continue;
    }
    context.save();
    context.translate(part.x, part.y);
    if (part.turned) context.rotate(-Math.PI / 2);
    context.textAlign = part.anchor === "middle" ? "center" : part.anchor;
    if (part.inside) {
      context.strokeStyle = "#fff";
      context.lineWidth = 3 * unit;
      context.strokeText(part.text, 0, 0);
    }
    context.fillText(part.text, 0, 0);
    context.restore();
  }
}

export function svgAxes(parts) {
  const escape = (text) => text.replace(/[&<>]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[sign]);
  return parts
    .map((part) => {
      if (part.line) {
        const [x1, y1, x2, y2] = part.line;
        return `<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}" stroke="#000"/>`;
      }
      const turn = part.turned ? ` transform="rotate(-90 ${part.x} ${part.y})"` : "";
      return `<text x="${part.x}" y="${part.y}" text-anchor="${part.anchor}"${turn}>${escape(part.text)}</text>`;
    })
    .join("\n");
}
