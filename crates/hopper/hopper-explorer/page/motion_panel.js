// The hopper in motion: both masses and the spring, with both heights against time. Units are the model's, or metres
// and seconds.
import { parse, show } from "./numbers.js";
import { change, say, state } from "./state.js";
import { Drawing } from "./svg.js";

/** Numbers of a sample: time, hop, flight, y₁, ẏ₁, y₂, ẏ₂. */
const FIELDS = 7;
/** Time steps of a frame at full speed: a period of the spring lasts 1.2 s. */
const RATE = (2 * Math.PI) / 1.2;
/** The part of the full speed at which the first hopper hops. */
export const GENTLE = 0.5;
/** Within this time of a landing or a lift-off the slow motion is a fifth. */
const NEAR = 0.35;
const SLOW = 0.2;
const FRAME = 1 / 24;
/** Parts of a drawn curve: more than it has pixels. */
const PARTS = 1000;

const HOPPERS = {
  none: null,
  "a toy of 100 g": [0.1, 120, 9.80665],
  "the toy on the Moon": [0.1, 120, 1.625],
  "a child on a pogo stick": [35, 8000, 9.80665],
  "a lander of 500 kg on the Moon": [500, 20000, 1.625],
};

const panel = document.getElementById("motion");
panel.innerHTML = `<h2>The hopper hops</h2>
  <div id="stage"></div>
  <div class="row"><button id="play" aria-pressed="false" title="Space">Play</button>
    <button id="back" title="One frame back (,)" aria-label="One frame back">◂</button><button id="forth" title="One frame on (.)" aria-label="One frame on">▸</button>
    <input id="time" type="range" min="0" max="1" step="any" value="0" aria-label="Time">
    <label>hops <input id="hops" type="number" min="1" max="99" class="short"></label></div>
  <div class="row"><label><input id="slow" type="checkbox" checked> slow near the ground</label>
    <label>units <select id="hopper">${Object.keys(HOPPERS)
      .map((name) => `<option>${name}</option>`)
      .join("")}<option>my own</option></select></label></div>
  <div class="row" id="own" hidden><label>kg <input class="short" id="mass" value="0.1" inputmode="decimal"></label>
    <label>N/m <input class="short" id="stiffness" value="120" inputmode="decimal"></label>
    <label>m/s² <input class="short" id="gravity" value="9.80665" inputmode="decimal"></label></div>
  <p class="soft" id="now"></p>`;
const part = (id) => document.getElementById(id);

let samples = null;
let units = null;
let desk = null;
let time = 0;
let playing = false;
let last = 0;
let pace = 1;
let stage = null;

const count = () => (samples ? (samples.length - 1) / FIELDS : 0);
const field = (k, which) => samples[1 + FIELDS * k + which];

/** The samples of a motion, as they came from the core; null for none. `measure` draws them. */
export function showMotion(found) {
  samples = found;
  if (!samples) {
    play(false);
    stage = null;
    ["stage", "now"].forEach((id) => part(id).replaceChildren());
    return;
  }
  time = Math.min(time, field(count() - 1, 0));
}

export function start(asked) {
  desk = asked;
  part("hops").value = state.hops;
}

/** The sample before a time, and the part of the way to the next one. */
function at(when) {
  let [low, high] = [0, count() - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (field(middle, 0) <= when) low = middle;
    else high = middle;
  }
  const length = field(high, 0) - field(low, 0);
  const along = length > 0 ? Math.min((when - field(low, 0)) / length, 1) : 0;
  const between = (which) => field(low, which) + along * (field(high, which) - field(low, which));
  return { low, upper: between(3), lower: between(5), flies: field(low, 2) === 1 };
}

/** Times of landings, sudden or not, and of lift-offs. */
function events() {
  const found = [];
  for (let k = 1; k < count(); k++) {
    const lands = field(k, 0) === field(k - 1, 0) && field(k - 1, 5) <= 1e-9 && field(k - 1, 6) < 0;
    if (lands) found.push({ time: field(k, 0), upper: field(k, 3), sudden: field(k, 2) === 1 && field(k, 3) > 1 });
    else if (field(k, 2) !== field(k - 1, 2)) found.push({ time: field(k, 0), upper: field(k, 3), sudden: false });
  }
  return found;
}

/** The samples of a curve: all, or of many the lowest and the highest of each part. */
function extremes(value) {
  const found = [];
  const wide = Math.ceil(count() / PARTS);
  for (let from = 0; from < count(); from += wide) {
    let [low, high] = [from, from];
    for (let k = from; k < Math.min(from + wide, count()); k++) {
      if (value(k) < value(low)) low = k;
      if (value(k) > value(high)) high = k;
    }
    found.push(Math.min(low, high));
    if (low !== high) found.push(Math.max(low, high));
  }
  return found;
}

function draw() {
  if (!samples) return;
  const [length, second] = units ? [units.length, units.time] : [1, 1];
  const curve = (which) =>
    extremes((k) => field(k, which)).map((k) => [field(k, 0) * second, field(k, which) * length]);
  const [upper, lower] = [curve(3), curve(5)];
  const values = [...upper, ...lower].map(([, y]) => y);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const end = field(count() - 1, 0) * second;
  const drawing = new Drawing({
    x: [0, end || 1],
    y: [low - 0.06 * (high - low), high + 0.08 * (high - low)],
    height: 300,
    margin: [170, 34],
    xName: units ? "time (s)" : "time τ (1/ω)",
    yName: "",
    title: `Heights of both masses over ${state.hops} hops`,
  });
  drawing
    .curve(
      [
        [0, 0],
        [end, 0],
      ],
      "currentColor",
      0.5,
    )
    .curve(upper, "var(--upper)")
    .curve(lower, "var(--lower)");
  const all = events();
  for (const event of all) if (event.sudden) drawing.dot(event.time * second, 0, "var(--lower)", 4);
  // The spring keeps a part of its length where it is shortest; the relaxed length is not a number of the model.
  const stretch = (k) => field(k, 3) - field(k, 5);
  stage = {
    drawing,
    second,
    length,
    shortest: Math.min(...extremes(stretch).map(stretch)),
    highest: Math.max(...upper.map(([, y]) => y / length)),
    events: all,
  };
  const cursor = `<line id="cursor" y1="${drawing.top}" y2="${drawing.bottom}" stroke="currentColor" stroke-opacity=".6"/>`;
  const machine = `<g stroke="currentColor" fill="none"><path d="M10 282h110M14 290l8-8m4 8l8-8m4 8l8-8m4 8l8-8m4 8l8-8m4 8l8-8m4 8l8-8m4 8l8-8"/>
    <path id="spring" stroke-width="1.6"/><rect id="lower" width="52" rx="2" fill="var(--lower)"/><rect id="upper" width="52" rx="2" fill="var(--upper)"/></g>
    <text id="height-name" x="176" y="24">${units ? "m" : "m₂g/k"}</text>`;
  part("stage").innerHTML = drawing.markup(cursor).replace("</svg>", `${machine}</svg>`);
  part("time").max = field(count() - 1, 0);
  place();
}

/** Puts the hopper and the cursor where they are now. */
function place() {
  if (!stage) return;
  const now = at(time);
  const m = state.pin?.m ?? 1;
  const kappa = m / (1 + m);
  const blocks = 70;
  const heightOf = (share) => blocks * Math.min(Math.max(share, 0.25), 0.75);
  const [lowerBlock, upperBlock] = [heightOf(kappa), heightOf(1 - kappa)];
  const room = 282 - 14 - blocks;
  const scale = (0.88 * room) / Math.max(stage.highest - stage.shortest, 1e-9);
  const relaxed = 0.12 * room - scale * stage.shortest;
  const lowerTop = 282 - scale * now.lower - lowerBlock;
  const upperBottom = 282 - lowerBlock - relaxed - scale * now.upper;
  const set = (id, values) => Object.entries(values).forEach(([name, value]) => part(id)?.setAttribute(name, value));
  set("lower", { x: 39, y: lowerTop, height: lowerBlock });
  set("upper", { x: 39, y: upperBottom - upperBlock, height: upperBlock });
  const turns = 9;
  const zigzag = Array.from(
    { length: turns },
    (_, k) => `${65 + (k % 2 ? 9 : -9)} ${upperBottom + ((lowerTop - upperBottom) * (k + 0.5)) / turns}`,
  );
  set("spring", { d: `M65 ${upperBottom}L${zigzag.join("L")}L65 ${lowerTop}` });
  const [x] = stage.drawing.at(time * stage.second, 0);
  set("cursor", { x1: x, x2: x });
  part("time").value = time;
  const hop = field(now.low, 1) + 1;
  const unit = units ? [" s", " m"] : ["", ""];
  const sudden = stage.events.filter((event) => event.sudden).length;
  part("now").textContent =
    `${now.flies ? "In the air" : "On the ground"}, hop ${hop}. Time ${show(time * stage.second, 4)}${unit[0]}, upper mass at ` +
    `${show(now.upper * stage.length, 4)}${unit[1]}, lower mass at ${show(now.lower * stage.length, 4)}${unit[1]}. ` +
    `${sudden === 0 ? "No sudden lift-off" : `${sudden} sudden lift-off${sudden === 1 ? "" : "s"} (red dots)`}${samples[0] ? "; the hopper stays on the ground" : ""}.` +
    (units
      ? ` Lift-off at ${show(state.pin.alpha * units.speed, 4)} m/s; masses ${show(units.upperMass, 3)} kg above, ${show(units.lowerMass, 3)} kg below.`
      : "");
}

/** What the panel shows at a time, for tests. */
export const stateAt = (when) => at(when);

function tick(now) {
  if (!playing) return;
  const passed = Math.min((now - last) / 1000, 0.1);
  last = now;
  const near = part("slow").checked && stage.events.some((event) => Math.abs(event.time - time) < NEAR);
  time += passed * RATE * pace * (near ? SLOW : 1);
  if (time > field(count() - 1, 0)) time = 0;
  place();
  requestAnimationFrame(tick);
}

export function play(on = !playing, rate = 1) {
  pace = rate;
  playing = on && samples !== null;
  part("play").textContent = playing ? "Pause" : "Play";
  part("play").setAttribute("aria-pressed", playing);
  last = performance.now();
  if (playing) requestAnimationFrame(tick);
}

export function step(frames) {
  if (!samples) return;
  play(false);
  time = Math.min(Math.max(time + frames * RATE * FRAME, 0), field(count() - 1, 0));
  place();
}

part("play").onclick = () => play();
part("back").onclick = () => step(-1);
part("forth").onclick = () => step(1);
part("time").oninput = ({ target }) => {
  play(false);
  time = Number(target.value);
  place();
};
part("hops").onchange = ({ target }) => {
  const hops = parse(target.value);
  if (Number.isInteger(hops) && hops >= 1 && hops <= 99) change({ hops });
  else say("The motion shows 1 to 99 hops.");
};

/** Finds the units, and draws. */
export async function measure() {
  const chosen = part("hopper").value;
  part("own").hidden = chosen !== "my own";
  const numbers =
    chosen === "my own" ? ["mass", "stiffness", "gravity"].map((id) => parse(part(id).value)) : HOPPERS[chosen];
  units = null;
  if (numbers && state.pin) {
    if (numbers.some((number) => number === null)) say("Mass, stiffness and gravity are positive numbers.");
    else
      try {
        units = await desk.ask("units", state.pin.m, ...numbers);
      } catch (error) {
        say(error.message);
      }
  }
  draw();
}
["hopper", "mass", "stiffness", "gravity"].forEach((id) => {
  part(id).onchange = measure;
});
