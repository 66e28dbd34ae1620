// Eight stops. Each is a view and some sentences, in a small dialog beside the plane.
import { change } from "./state.js";

const plane = (x, alpha, more = {}) => ({
  view: { logarithmic: false, x, alpha },
  layer: 0,
  depth: null,
  pin: null,
  ...more,
});

/** The stops; `legend` has the fixed points and the windows of the paper. */
export const stops = ({ fixedPoints, home, figure9, layers }) => [
  {
    title: "A lossless hop",
    text: "At α* the hopper lands with the spring exactly as it was at lift-off, and no energy is lost. This hop repeats for ever. Press Play.",
    fields: plane([0, 1], [home[2] - 0.3, home[3]], { pin: { m: 0.2, alpha: fixedPoints[1] }, hops: 3 }),
  },
  {
    title: "Stable from one side",
    text: "A start a little above α*₁ approaches it, ever more slowly. A start a little below leaves it. The cobweb shows the curve, which touches the diagonal.",
    fields: plane([0.19, 0.21], [4.35, 4.65], { pin: { m: 0.2, alpha: 4.56 }, hops: 6 }),
  },
  {
    title: "Humps",
    text: "The map has a hump between any two fixed points. A sudden lift-off makes its left leg: the stretched spring pulls the lower mass up at once.",
    fields: plane([0.1, 0.3], [home[2], 11.2], { pin: { m: 0.2, alpha: 10.2 }, hops: 5 }),
  },
  {
    title: "The crisis",
    text: "At M = 0.1035 the minimum of the first hump touches the fixed point. For larger M orbits escape below it, and the green basin breaks up.",
    fields: plane([0.08, 0.14], [home[2] - 0.1, 7.9], { pin: { m: 0.1035, alpha: 6.0 }, hops: 6 }),
  },
  {
    title: "Needles",
    text: "The basins are long along M and thin along α. The layer of exact coverage shows needles that are thinner than a pixel. M and α zoom separately: hold Shift or Alt.",
    fields: plane(figure9.slice(0, 2), figure9.slice(2), { layer: layers.findIndex(({ key }) => key === "coverage") }),
  },
  {
    title: "What is no Cantor set",
    text: "It looks fractal at any scale. But every boundary point falls onto a fixed point after finitely many hops: the boundary is countable, and its points gather only beside others.",
    fields: plane([0.1745, 0.1755], [17.38, 17.42], { pin: { m: 0.175, alpha: 17.399 }, hops: 6 }),
  },
  {
    title: "The circle",
    text: "Left of a fixed point an orbit leaves slowly, and only the fraction of a hop decides. The fates lie on a circle that is passed once a hop: the same shares at every scale. Open the circle of fates.",
    fields: plane([0.1, 0.14], [7.2, 8.1], { pin: { m: 0.12, alpha: 7.72 }, hops: 6 }),
    open: "circle",
  },
  {
    title: "The largest zoom",
    text: "A window of height 10⁻¹⁰⁰ about a boundary point. Doubles end at 10⁻¹⁵; the chart of the point goes on. Turn the wheel: above, the basin of α*; below, the circle, turn after turn.",
    fields: plane([0.1, 0.14], [11.8, 12.0], { pin: { m: 0.12, alpha: 11.920553918335775 }, hops: 4 }),
    depth: { m: 0.12, alpha: 11.920553918335775, depth: 100 },
  },
];

const box = document.getElementById("stop");

/** The tour. `openDepth` flies to an edge, `giveUp` ends what was asked for before. */
export class Tour {
  constructor(legend, openDepth, giveUp) {
    [this.stops, this.openDepth, this.giveUp, this.at] = [stops(legend), openDepth, giveUp, -1];
  }

  get runs() {
    return this.at >= 0;
  }

  /** Goes to a stop; any other number ends the tour. */
  go(next) {
    if (next < 0 && !this.runs) return;
    const before = this.runs ? null : document.activeElement;
    this.giveUp();
    this.opener ??= before;
    this.at = next >= 0 && next < this.stops.length ? next : -1;
    box.hidden = !this.runs;
    if (!this.runs) {
      this.opener?.focus();
      this.opener = null;
      return;
    }
    const { title, text, fields, open, depth } = this.stops[this.at];
    const [first, last] = [this.at === 0, this.at === this.stops.length - 1];
    box.innerHTML = `<h2 id="stop-title" tabindex="-1">${this.at + 1} of ${this.stops.length}. ${title}</h2><p>${text}</p><div class="row">
      <button data-go="-1"${first ? " disabled" : ""}>Previous</button><button data-go="1">${last ? "End" : "Next"}</button><button data-go="end">Close</button></div>`;
    box.querySelectorAll("[data-go]").forEach((button) => {
      button.onclick = () => this.go(button.dataset.go === "end" ? -1 : this.at + Number(button.dataset.go));
    });
    // The heading is read, and the buttons come next; keys of the page still work.
    box.querySelector("h2").focus({ preventScroll: true });
    if (open) document.getElementById(open).open = true;
    change(fields);
    if (depth) this.openDepth(depth.m, depth.alpha, depth.depth);
  }
}
