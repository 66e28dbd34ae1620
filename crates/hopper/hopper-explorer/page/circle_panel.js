// The circle of fates left of a fixed point, and the basins at one M as a line of intervals.
import { pretty, show, star } from "./numbers.js";
import { Drawing } from "./svg.js";

const shares = (fractions) =>
  `<p>${fractions
    .map(
      ({ name, color, lower, upper }) =>
        `<i class="swatch" style="background:${color}"></i>${pretty(name)} ${show(100 * lower, 5)}${upper - lower > 1e-6 ? `…${show(100 * upper, 5)}` : ""} %`,
    )
    .join("<br>")}</p>`;

const triples = (parts) => Array.from({ length: parts.length / 3 }, (_, k) => parts.slice(3 * k, 3 * k + 3));

export function showCircle({ n, parts, boundary, undecided, fractions, ground }, colorOf) {
  const at = (phase, radius) => {
    const angle = 2 * Math.PI * phase - Math.PI / 2;
    return `${(200 + radius * Math.cos(angle)).toFixed(2)} ${(130 + radius * Math.sin(angle)).toFixed(2)}`;
  };
  const wedge = ([from, to, label]) => {
    const color = colorOf(label);
    if (to - from >= 1 - 1e-12)
      return `<circle cx="200" cy="130" r="95" fill="none" stroke="${color}" stroke-width="50"/>`;
    const large = to - from > 0.5 ? 1 : 0;
    return `<path d="M${at(from, 120)}A120 120 0 ${large} 1 ${at(to, 120)}L${at(to, 70)}A70 70 0 ${large} 0 ${at(from, 70)}Z" fill="${color}"/>`;
  };
  const seen = triples(parts).filter(([from, to]) => to - from > 1e-4);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 260" role="img"><title>The circle of fates left of α*_${n}</title>
    ${seen.map(wedge).join("")}<circle cx="200" cy="130" r="120" fill="none" stroke="currentColor" stroke-width=".6"/>
    <circle cx="200" cy="130" r="70" fill="none" stroke="currentColor" stroke-width=".6"/>
    <text x="200" y="128" text-anchor="middle">left of ${star(n)}</text><text x="200" y="144" text-anchor="middle">one turn: one hop</text></svg>
    ${shares(fractions)}<p class="soft">These shares hold at every scale left of ${star(n)} and of its preimages. ${boundary} boundary points on the circle,
    ${undecided} limit points of more. The labels stand on ${ground === "branches" ? "the branches of the map" : "samples: thin basins may be missed"}.</p>`;
}

export function showIntervals({ from, to, parts, ground, undecided, compared, wrong, fractions }, m, colorOf) {
  const drawing = new Drawing({
    x: [from, to],
    y: [0, 1],
    height: 110,
    xName: "α",
    yName: "",
    title: `The basins at M = ${m}`,
    margin: [12, 34],
  });
  for (const [left, right, label] of triples(parts)) drawing.band(left, right, colorOf(label));
  drawing.axes = drawing.axes.filter((axis) => !axis.includes('text-anchor="end"'));
  return `${drawing.markup()}<p class="soft">${parts.length / 3} intervals; the length ${show(undecided, 3)} is undecided. ${ground === "proved" ? "The branches of the map are proved" : "The sudden windows stay undecided at this M"};
    ${compared} random speeds were compared, ${wrong} differ.</p>${shares(fractions)}`;
}
