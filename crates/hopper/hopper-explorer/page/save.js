// Files of what is seen: PNG, SVG, CSV. Each holds its parameters and the address of the view.
import { MARGIN, letterSize, svgAxes } from "./axes.js";
import { deepLayer } from "./deep.js";
import { address } from "./link.js";
import { axesOf, paint } from "./plane.js";
import { withTexts } from "./png_text.js";
import { numbersOf } from "./legend.js";
import { layers, state } from "./state.js";
import { QUICK, isShares, stripOf } from "./tiles.js";
import { toM } from "./view.js";

/** Pixels of a table each way. */
const TABLE = 256;

/** The parameters in words. */
export function parameters(deep, layer = state.layer) {
  const { view, pin, depth } = state;
  const window = depth
    ? deep.words()
    : `M from ${toM(view, view.x[0])} to ${toM(view, view.x[1])}${view.logarithmic ? " (logarithmic)" : ""}, alpha from ${view.alpha[0]} to ${view.alpha[1]}`;
  const point = pin ? `; pinned: M = ${pin.m}, alpha = ${pin.alpha}` : "";
  return `Passive hopper, ${depth ? `${layers[deepLayer()].name} about an edge` : layers[layer].name}: ${window}${point}`;
}

/** Waits for the parts of the picture, as long as `wait` says so. The texts are those of the picture that is painted next. */
async function complete(plane, deep, wait) {
  for (;;) {
    const { all, there, failed } = plane.parts;
    if (there + failed >= all)
      return {
        words: parameters(deep) + (failed ? `; unfinished: ${failed} of ${all} parts failed` : ""),
        source: address(),
      };
    if (!wait(`Waiting for the picture: ${there} of ${all} parts …`)) throw new Error("given up");
    await new Promise((done) => setTimeout(done, 100));
  }
}

export async function png(plane, deep, wait) {
  const { words, source } = await complete(plane, deep, wait);
  const canvas = document.createElement("canvas");
  const ratio = plane.canvas.width / plane.size.width;
  [canvas.width, canvas.height] = [plane.canvas.width, plane.canvas.height];
  paint(canvas.getContext("2d"), plane, ratio);
  const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  return withTexts(blob, { Description: words, Source: source });
}

export async function svg(plane, deep, wait) {
  const { words, source } = await complete(plane, deep, wait);
  plane.draw();
  const { size, box } = plane;
  const ratio = plane.canvas.width / size.width;
  const inside = document.createElement("canvas");
  [inside.width, inside.height] = [box.width * ratio, box.height * ratio].map(Math.round);
  inside
    .getContext("2d")
    .drawImage(
      plane.canvas,
      MARGIN.left * ratio,
      MARGIN.top * ratio,
      inside.width,
      inside.height,
      0,
      0,
      inside.width,
      inside.height,
    );
  const escape = (text) => text.replace(/[&<>]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[sign]);
  const text = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${size.width} ${size.height}" font-family="sans-serif" font-size="${letterSize()}">
<title>${escape(words)}</title><desc>${escape(source)}</desc><rect width="100%" height="100%" fill="#fff"/>
<image x="${MARGIN.left}" y="${MARGIN.top}" width="${box.width}" height="${box.height}" preserveAspectRatio="none" style="image-rendering:pixelated" href="${inside.toDataURL("image/png")}"/>
<rect x="${MARGIN.left}" y="${MARGIN.top}" width="${box.width}" height="${box.height}" fill="none" stroke="#000"/>
${svgAxes(axesOf(plane))}
</svg>`;
  return new Blob([text], { type: "image/svg+xml" });
}

/** A table of pixels' middles with their values, computed for exactly this window. */
export async function csv(pool, desk, deep) {
  if (state.depth) throw new Error("the deep view has shares, no table; save it as PNG or SVG");
  const {
    view: { x, alpha, logarithmic },
  } = state;
  // Shares have no table of one number a pixel: the fates of the middles have.
  const layer = isShares(state.layer) ? QUICK : state.layer;
  // Now: the view may have changed when the answers come.
  const lines = [`# ${parameters(deep, layer)}`, `# ${address()}`, `M,alpha,${layers[layer].columns}`];
  const job = { layer, logarithmic, x, alpha, columns: TABLE, rows: TABLE, values: true, strip: stripOf(layer) };
  const places = await desk.ask("places", job);
  const { values } = await pool.ask("tile", job);
  // A label with a flag has a bit above its code.
  const numbers = numbersOf(values, layers[layer]);
  const valueOf = layers[layer].columns.includes(",") ? (value) => `${value & 0xffff},${value >> 16}` : String;
  for (let column = 0; column < TABLE; column++) {
    for (let row = 0; row < TABLE; row++)
      lines.push(`${places[column]},${places[TABLE + row]},${valueOf(numbers[column * TABLE + row])}`);
  }
  return new Blob([lines.join("\n"), "\n"], { type: "text/csv" });
}

/** The orbit of the pinned point, hop by hop. */
export function orbitCsv(found, deep) {
  if (!state.pin || !found) throw new Error("pin a point first");
  const rows = found.orbit.map((hop, k) =>
    [
      k,
      hop.speed,
      found.errors[k] ?? "",
      hop.sudden,
      hop.flightTime,
      hop.energyLoss,
      hop.slope ?? "",
      hop.massRatioSlope ?? "",
    ].join(","),
  );
  const head = "hop,speed,error,sudden_lift_offs,flight_time,energy_loss,slope,mass_ratio_slope";
  return new Blob([[`# ${parameters(deep)}`, `# ${address()}`, head, ...rows].join("\n"), "\n"], { type: "text/csv" });
}

function panel(id, deep) {
  const drawing = document.getElementById(id).querySelector("svg");
  if (!drawing) throw new Error("pin a point first");
  const style = getComputedStyle(document.documentElement);
  const colored = drawing.outerHTML
    .replace(/var\((--\w+)\)/g, (_, name) => style.getPropertyValue(name))
    .replace("<svg ", `<svg color="#000" `)
    .replace("</title>", `</title><desc>${parameters(deep)}</desc>`);
  return new Blob([colored], { type: "image/svg+xml" });
}

/** The files that are offered: pairs of a name and a function that saves. */
export const offers = ({ plane, deep, pool, desk, shown, home }) => [
  ["PNG", async (wait) => download(await png(plane, deep, wait), "hopper.png")],
  [
    "a large PNG",
    async (wait) => {
      if (state.depth) throw new Error("the deep view has the pixels of the screen; save it as PNG");
      const words = { Description: parameters(deep), Source: address() };
      const { large } = await import("./large.js");
      const canvas = await large(plane, pool, wait);
      const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
      download(await withTexts(blob, words), "hopper-large.png");
    },
  ],
  [
    "a zoom as video",
    async (wait) => {
      const { film } = await import("./film.js");
      const video = await film(plane, home, wait);
      download(video, video.type.includes("mp4") ? "hopper-zoom.mp4" : "hopper-zoom.webm");
    },
  ],
  ["SVG", async (wait) => download(await svg(plane, deep, wait), "hopper.svg")],
  ["CSV", async () => download(await csv(pool, desk, deep), "hopper.csv")],
  ["the orbit as CSV", async () => download(orbitCsv(shown(), deep), "hopper-orbit.csv")],
  ["the map as SVG", async () => download(panel("map", deep), "hopper-map.svg")],
  ["the motion as SVG", async () => download(panel("stage", deep), "hopper-stage.svg")],
];

/** Hands a file to the reader. */
export function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
