// Puts the parts together: state in, pictures and panels out.
import { MARGIN } from "./axes.js";
import { Column } from "./column.js";
import { Core } from "./core.js";
import { Deep, SHALLOWEST, deepLayer } from "./deep.js";
import { gestures } from "./gestures.js";
import { ZOOM, glide, halt, thrown } from "./glide.js";
import { begin, keep } from "./history.js";
import { keys } from "./keys.js";
import { numberAt, paintLegend } from "./legend.js";
import { read } from "./link.js";
import { hideMap, isHeld, showMap } from "./map_panel.js";
import { GENTLE, measure, play, showMotion, start as startMotion, stateAt, step } from "./motion_panel.js";
import { parse, pretty, show } from "./numbers.js";
import { Plane } from "./plane.js";
import { showFate, showOrbit, showPin, showProof, showSentence } from "./point_panel.js";
import { Pool } from "./pool.js";
import { HOPS, change, layers, listen, say, state } from "./state.js";
import { at, moved, rounded, toM, toPin, tooFine, withLogarithm, zoomed } from "./view.js";

/** Hops of the orbit in the panels. */
const ORBIT = 60;
/** Hops of the orbit of the point under the cursor. */
const HOVERED = 12;
/** Points of a piece of the map. */
const PIECE = 120;
/** Milliseconds after which the panels of the point before are emptied. */
const LATE = 150;
/** Below this height of the window an edge inside it is looked for, to change to its chart. */
const EDGE_HEIGHT = 1e-8;

/** A point that hops for ever: what a first visitor sees. */
const FIRST = { m: 0.08, alpha: 6 };

// Parts that are loaded when they are first used.
const dialogs = () => import("./dialogs.js");
const files = () => import("./save.js");
const same = () => import("./same.js");
const circles = () => import("./circle_panel.js");
const comparing = () => import("./compare.js");
let systems = null; // the module of other systems
const others = async () => (await import("./others.js")).others((systems ??= compiled("systems.wasm")));

// A host that does not know the type of the file is no reason to stop.
const compiled = (name) => WebAssembly.compileStreaming(fetch(name)).catch(async () => WebAssembly.compile(await (await fetch(name)).arrayBuffer()));
const module = compiled("core.wasm");
let deepModule = null;
const workers = Math.max((navigator.hardwareConcurrency || 2) - 1, 1);
const pool = new Pool(() => module, Math.min(workers, 16)).warm();
const desk = new Pool(() => module, 1);  // panels
const well = new Pool(() => (deepModule ??= compiled("deep.wasm").catch((error) => { deepModule = null; throw error; })), 1);  // the deep view and slow panels
const legend = await module.then((found) => WebAssembly.instantiate(found, {})).then((instance) => new Core(instance).legend(), (error) => {
  say(`The core cannot be loaded: ${error.message}. The page needs a web server and a browser of 2023 or newer.`);
  throw error;
});
layers.push(...legend.layers);
/** The layer of exact shares: needles that are thinner than a pixel are lines in it. */
const usual = layers.findIndex(({ kind }) => kind === "shares");
document.getElementById("layer").replaceChildren(...layers.map(({ name }, k) => new Option(name, k)));
const canvas = document.getElementById("canvas");
const plane = new Plane(canvas, pool, legend);
// After the first picture, so that they do not take its time.
canvas.addEventListener("complete", () => desk.warm(), { once: true });
const deep = new Deep(plane, well);
const column = (plane.column = new Column(plane, desk));
const [left, right, bottom, top] = legend.home;
const home = { logarithmic: false, x: [left, right], alpha: [bottom - 0.2, top] };
const colors = new Map();
legend.fates.forEach(({ label, color }) => colors.set(label, color));
const lastColor = legend.fates.filter(({ label }) => label < 100).at(-1).color;
const colorOf = (label) => colors.get(label) ?? (label < 65000 ? lastColor : colors.get(65535));

const byId = (id) => document.getElementById(id);
const centre = () => ({ left: plane.box.width / 2, top: plane.box.height / 2 });
const pointAt = (where) => at(state.view, where.left, where.top, plane.box);
const pinHere = (where) => { const pin = toPin(state.view, pointAt(where)); if (pin.m > 0 && pin.alpha > 0) change({ pin }); };

function zoom(where, factorX, factorAlpha) {
  halt();
  plane.focus = null;
  if (state.depth) { if (deep.zoom(factorAlpha === 1 ? factorX : factorAlpha)) leaveDepth(); return; }
  const focus = pointAt(where);
  plane.focus = focus;
  const next = zoomed(state.view, focus, factorX, factorAlpha);
  change({ view: next });
  const height = next.alpha[1] - next.alpha[0];
  if (factorAlpha <= 1 && (height < EDGE_HEIGHT || tooFine(next.alpha))) lookForEdge(focus);
}

/** A zoom that the eye can follow. */
function zoomGently(where, factorX, factorAlpha) {
  if (state.depth) return zoom(where, factorX, factorAlpha);
  const focus = pointAt(where);
  plane.focus = focus;
  glide(zoomed(state.view, focus, factorX, factorAlpha), ZOOM).then((there) => { if (there) zoom(where, 1, 1); });
}

let looking = 0;
/** In a small window: the boundary point nearest to the cursor. If it is inside, the view changes to its chart. */
function lookForEdge(focus) {
  clearTimeout(looking);
  looking = setTimeout(async () => {
    const { view } = state;
    const height = view.alpha[1] - view.alpha[0];
    try {
      const about = await well.ask("openDepth", toM(view, focus.x), focus.alpha);
      if (state.view !== view) return;
      if (Math.abs(about.alpha - focus.alpha) > height) {
        if (tooFine(view.alpha)) say(`The zoom ends where doubles do. The nearest edge is at α = ${show(about.alpha, 12)}.`);
        return;
      }
      await deep.open(about.massRatio, about.alpha, -Math.log10(height / 2));
    } catch (error) { say(`The zoom ends where doubles do: ${error.message}`); }
  }, 150);
}

let wish = 0; // counts the deep views that were asked for, and given up before they came
async function openDepth(m, alpha, depth, fly = null) {
  const mine = ++wish;
  say("Looking for the edge …");
  try { await deep.open(m, alpha, depth, async (about) => mine === wish && (!fly || (await fly(about))) && mine === wish); } catch (error) { say(error.message); }
}

function deepHere() {
  if (state.depth) return leaveDepth();
  const focus = state.pin ?? { m: toM(state.view, pointAt(centre()).x), alpha: pointAt(centre()).alpha };
  openDepth(focus.m, focus.alpha, Math.max(-Math.log10((state.view.alpha[1] - state.view.alpha[0]) / 2), SHALLOWEST + 0.5), (about) => glide(windowAbout(about, 1e-5)));
}

/** The window of this half height about an edge. */
function windowAbout({ massRatio, alpha }, half) {
  const view = { logarithmic: false, x: [massRatio - half, massRatio + half], alpha: [alpha - half, alpha + half] };
  return withLogarithm(view, state.view.logarithmic);
}

function leaveDepth() {
  const { about, depth } = state.depth;
  const view = windowAbout(about, 10 ** -Math.min(Math.max(depth, 2), 7));
  change({ depth: null, view });
}

// Panels. An answer that is no longer wanted is not shown.
let round = 0;
let [busy, again] = [false, false];
/** One point at a time: while α is dragged, the points between two answers are passed over. */
async function showPoint() {
  if (busy) {
    again = true;
    if (!isHeld()) showPin();
    return;
  }
  busy = true;
  try { await showPointNow(++round); } finally {
    busy = false;
    if (again) { again = false; showPoint(); }
  }
}

/** A sentence, and nothing of any point. A map that is dragged stays under the hand. */
function empty(text) {
  shown = plane.orbit = null;
  showSentence(text);
  showMotion(null);
  if (!isHeld()) hideMap();
  ["circle", "intervals"].forEach((id) => byId(id).querySelector("div").replaceChildren());
}

async function showPointNow(mine) {
  showPin();
  if (!state.pin) return empty("Click the plane, or press Enter, to pin a point.");
  const { m, alpha } = state.pin;
  const late = setTimeout(() => empty("Computing …"), LATE);
  let answer;
  try {
    answer = await desk.ask("pinned", m, alpha, ORBIT, state.hops, PIECE, isHeld() ? shownWindow : null);
  } catch (error) {
    say(error.message);
    return empty(error.message);
  } finally { clearTimeout(late); }
  if (again && !isHeld()) return; // another point is pinned
  const { point: found, window, map, motion } = answer;
  [shown, shownWindow] = [found, window];
  plane.orbit = { m, speeds: found.speeds };
  plane.refresh();
  showFate(found);
  showOrbit(found);
  if (map.refused) hideMap(`No map: ${map.refused}.`); else showMap(map, found, window);
  showMotion(motion.refused ? null : motion);
  if (motion.refused) say(`No motion: ${motion.refused}.`);
  await measure();
  canvas.dispatchEvent(new CustomEvent("panels", { detail: found }));
  showKept();
  const isWanted = () => mine === round && shown === found;
  desk.ask("proof", m, alpha).then((proof) => { if (isWanted()) showProof(found, proof); }, (error) => { if (isWanted()) byId("proof").textContent = `No proof: ${error.message}.`; });
  slowPanels(isWanted, m, state.depth?.about.n ?? Math.max(found.trap?.n ?? 1, found.below, 1));
}
let shownWindow = null;
let shown = null; // the last answer about a point

let chosen = null; // the fixed point of the circle, if the reader chose one
byId("circle-n").onchange = ({ target }) => {
  const n = parse(target.value);
  chosen = Number.isInteger(n) && n >= 1 ? n : null;
  showPoint();
};

function slowPanels(isWanted, m, n) {
  if (isHeld()) return; // the end of the drag asks again
  byId("circle-n").value = chosen ?? n;
  const fill = async (id, show, ...question) => {
    const box = byId(id).querySelector("div");
    box.textContent = byId(id).open ? "Computing …" : "";
    if (!byId(id).open) return;
    try {
      const [panel, found] = await Promise.all([circles(), well.ask(id, m, ...question)]);
      if (isWanted()) box.innerHTML = show(panel, found);
    } catch (error) { if (isWanted()) box.textContent = error.message; }
  };
  fill("circle", ({ showCircle }, found) => showCircle(found, colorOf), chosen ?? n);
  fill("intervals", ({ showIntervals }, found) => showIntervals(found, m, colorOf), 1, Math.min(Math.max(n, 5) + 1, 12));
}

/** The kept point beside the pinned one. */
async function showKept() {
  const box = byId("compare").querySelector("div");
  if (state.other) byId("compare").open = true;
  if (!byId("compare").open) return;
  try {
    const { asked, showCompared } = await comparing();
    showCompared(box, state.other && (await asked(desk, state.other)), shown && { m: state.pin?.m, ...shown });
  } catch (error) { box.textContent = error.message; }
}

const showSame = async () => (await same()).fill(byId("same").querySelector("div"));

const showLegend = () => paintLegend(legend, layers[state.depth ? deepLayer() : state.layer]);

// The tour, which is loaded when it begins.
let touring = null;
const goTo = (next) => {
  touring ??= import("./tour.js").then(({ Tour }) => new Tour(legend, openDepth, () => { wish += 1; halt(); }));
  return touring.then((tour) => tour.go(next(tour)));
};

async function saveDialog() {
  const [{ save }, { offers }] = await Promise.all([dialogs(), files()]);
  save(offers({ plane, deep, pool, desk, home, shown: () => shown }));
}
const share = async () => (await dialogs()).share();
const help = async () => (await dialogs()).help();
const places = async () => (await dialogs()).places(follow, legend, openDepth);

const pan = (x, alpha) => {
  const { view } = state;
  if (state.depth) return deep.move(-2 * x, -2 * alpha);
  halt();
  change({ view: moved(view, x * (view.x[1] - view.x[0]), alpha * (view.alpha[1] - view.alpha[0])) });
};
const goHome = () => {
  wish += 1;
  if (state.depth) change({ depth: null });
  glide(withLogarithm(home, state.view.logarithmic));
};
const setLayer = (layer) => () => change({ layer });
const setLogarithmic = (logarithmic) => change({ view: withLogarithm(state.view, logarithmic) });
const pinCentre = () => pinHere(centre());
const scale = (x, alpha) => () => zoomGently(centre(), x, alpha);

gestures(canvas, {
  zoom,
  move: (byLeft, byTop) => pan(-byLeft / plane.box.width, byTop / plane.box.height),
  click: (where) => {
    if (state.depth) return change({ pin: { m: state.depth.about.massRatio, alpha: state.depth.about.alpha } });
    pinHere(where);
  },
  hover,
  twice: (where) => zoomGently(where, 0.4, 0.4),
  thrown: (byLeft, byTop) => { if (!state.depth) thrown(byLeft, byTop, plane.box); },
  box: (from, to, done, large) => {
    plane.draw();
    if (state.depth) return;
    if (!done) return plane.context.strokeRect(MARGIN.left + from.left, MARGIN.top + from.top, to.left - from.left, to.top - from.top);
    if (!large) return;
    const [a, b] = [pointAt(from), pointAt(to)];
    const sorted = (one, other) => [Math.min(one, other), Math.max(one, other)];
    change({ view: rounded({ ...state.view, x: sorted(a.x, b.x), alpha: sorted(a.alpha, b.alpha) }) });
  },
});

let hovering = false;
/** The fate under the cursor. */
async function hover(where) {
  if (hovering) return;
  if (state.depth) {
    hovering = true;
    try { say(await deep.at(where, plane.box)); } catch (error) { say(error.message); }
    hovering = false;
    return;
  }
  const { x, alpha } = pointAt(where);
  const m = toM(state.view, x);
  if (!(m > 0 && alpha > 0)) return;
  hovering = true;
  try {
    const { fate, hops, speeds } = await desk.ask("point", m, alpha, HOVERED);
    plane.hovered = { m, speeds };
    plane.refresh();
    const number = await numberAt(desk, { m, alpha });
    say(`M = ${show(m, 8)}, α = ${show(alpha, 10)}: ${fate.plain}, ${pretty(fate.name)} after ${hops} hops${number}`);
  } catch (error) { say(error.message); }
  hovering = false;
}

keys({
  ArrowLeft: () => pan(-0.1, 0), ArrowRight: () => pan(0.1, 0), ArrowUp: () => pan(0, 0.1), ArrowDown: () => pan(0, -0.1),
  "+": scale(1 / 1.5, 1 / 1.5), "=": scale(1 / 1.5, 1 / 1.5), "-": scale(1.5, 1.5), "−": scale(1.5, 1.5),
  X: scale(1 / 1.5, 1), x: scale(1.5, 1), A: scale(1, 1 / 1.5), a: scale(1, 1.5),
  Enter: pinCentre, h: goHome, l: () => setLogarithmic(!state.view.logarithmic), ...Object.fromEntries(layers.slice(0, 10).map((_, k) => [(k + 1) % 10, setLayer(k)])),
  d: deepHere, t: () => goTo(() => 0), n: () => touring && goTo(({ runs, at }) => (runs ? at + 1 : -1)), p: () => touring && goTo(({ at }) => (at > 0 ? at - 1 : at)),
  Escape: () => { if (state.depth) leaveDepth(); if (touring) goTo(() => -1); }, z: () => history.back(), y: () => history.forward(), g: places,
  " ": () => play(), ",": () => step(-1), ".": () => step(1), s: saveDialog, c: share, "?": help,
});
byId("home").onclick = goHome;
byId("deep").onclick = deepHere;
byId("tour").onclick = () => goTo(({ runs }) => (runs ? -1 : 0));
byId("places").onclick = places;
byId("others").onclick = others;
byId("back-view").onclick = () => history.back();
byId("forth-view").onclick = () => history.forward();
byId("share").onclick = share;
byId("save").onclick = saveDialog;
byId("help").onclick = help;
byId("layer").onchange = ({ target }) => change({ layer: Number(target.value) });
byId("logarithmic").onchange = ({ target }) => setLogarithmic(target.checked);
const opened = { circle: showPoint, intervals: showPoint, same: showSame, compare: showKept };
Object.entries(opened).forEach(([id, fill]) => byId(id).addEventListener("toggle", fill));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plane.refresh());

listen((names) => {
  const has = (...some) => some.some((name) => names.has(name));
  if (has("view", "layer", "depth", "pin")) {
    plane.overlay = state.depth ? deep : null;
    if (state.depth) { say(deep.words()); deep.request(); }
    plane.refresh();
    column.request();
    keep();
  }
  if (has("other")) { plane.refresh(); keep(); showKept(); }
  if (has("layer", "depth")) showLegend();
  if (has("view")) {
    const { view } = state;
    if (!state.depth) say(`M from ${show(toM(view, view.x[0]), 8)} to ${show(toM(view, view.x[1]), 8)}, α from ${show(view.alpha[0], 10)} to ${show(view.alpha[1], 10)}`);
  }
  byId("layer").value = state.layer;
  byId("logarithmic").checked = state.view.logarithmic;
  byId("deep").setAttribute("aria-pressed", state.depth !== null);
  byId("hops").value = state.hops;
  if (has("pin", "hops")) showPoint();
  if (byId("same").open) showSame();
});

function follow(hash) {
  wish += 1;
  halt();
  const { fields, wrong } = read(hash);
  const { depth, embedded, ...rest } = fields;
  if (embedded) embed();
  change({ view: home, layer: usual, pin: null, other: null, hops: HOPS, depth: null, ...rest });
  begin(depth !== undefined);
  if (depth) openDepth(depth.m, depth.alpha, depth.depth);
  if (wrong.length > 0) queueMicrotask(() => say(`A part of the address makes no sense and is left out: ${wrong.join(", ")}`));
}
/** The picture alone, within another page. */
function embed() {
  if (document.body.classList.contains("embedded")) return;
  document.body.classList.add("embedded");
  const link = document.createElement("a");
  Object.assign(link, { id: "whole", textContent: "Open the explorer", target: "_blank", rel: "noopener" });
  link.onpointerenter = link.onfocus = () => { link.href = location.href.replace("&embed", ""); };
  link.href = location.href.replace("&embed", "");
  byId("view").append(link);
}

startMotion(desk);
showLegend();
follow(location.hash);
addEventListener("hashchange", () => follow(location.hash));
// Afterwards: it fetches all files.
if (location.protocol !== "file:" && "serviceWorker" in navigator)
  canvas.addEventListener("complete", () => navigator.serviceWorker.register("sw.js").catch(() => say("Offline use is not possible here.")), { once: true });

// A first visitor sees a hopper that hops for ever, gently; with reduced motion it stands still.
if (location.hash === "") {
  change({ pin: FIRST });
  canvas.addEventListener("panels", () => { if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play(true, GENTLE); }, { once: true });
}

// For tests.
window.explorer = { state, pool, desk, plane, deep, change, parse, stateAt, files, same };
