// The canvas: tiles of the plane, axes, the pin. It asks for coarse tiles first, then for fine ones, and gives up what
// is out of view.
import { MARGIN, fitLetters, inner, paintAxes, planeAxes } from "./axes.js";
import { state, say } from "./state.js";
import { COARSE, FEW, QUICK, SIZE, TileStore, coarsePixels, isShares, keyOf, needed, towers, windowOf } from "./tiles.js";
import { place, toX } from "./view.js";

export class Plane {
  constructor(canvas, pool, legend) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.pool = pool;
    this.legend = legend;
    this.store = new TileStore();
    this.asked = new Map(); // keys of tiles in work
    this.focus = null; // where the next tile is wanted first
    this.frames = 0;
    this.overlay = null; // what draws instead of the plane
    this.orbit = null; // { m, speeds } of the pinned point
    this.hovered = null; // the same of the point under the cursor
    new ResizeObserver(() => this.refresh()).observe(canvas);
  }

  /** Size in CSS pixels. */
  get size() {
    return { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }
  get box() {
    return inner(this.size);
  }
  /** Where the picture begins within the canvas. */
  get corner() {
    return { left: MARGIN.left, top: MARGIN.top };
  }

  refresh() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
      if (!this.overlay) this.#request();
    });
  }

  #pixels() {
    const ratio = window.devicePixelRatio || 1;
    return { width: this.box.width * ratio, height: this.box.height * ratio };
  }

  /** The parts of the picture: all, those that are there, and those that failed. */
  get parts() {
    if (this.overlay) return this.overlay.parts;
    const all = needed(state.view, state.layer, this.#pixels(), { x: 0, alpha: 0 });
    const failed = all.filter((tile) => this.store.hasFailed(tile)).length;
    return { all: all.length, there: all.filter((tile) => this.store.isFine(tile)).length - failed, failed };
  }

  #request() {
    const centre = {
      x: (state.view.x[0] + state.view.x[1]) / 2,
      alpha: (state.view.alpha[0] + state.view.alpha[1]) / 2,
    };
    const focus = this.focus ?? centre;
    const pixels = this.#pixels();
    const missing = needed(state.view, state.layer, pixels, focus).filter((tile) => !this.store.isFine(tile));
    const shares = isShares(state.layer);
    // Before shares, which take long, points: coarse ones, then fine ones.
    const first = shares
      ? missing.map((tile) => ({ ...tile, layer: QUICK, part: 1 })).filter((tile) => !this.store.isFine(tile))
      : missing;
    const coarse = first
      .filter((tile) => !this.store.isCoarse(tile))
      .map((tile) => ({ ...tile, pixels: shares ? COARSE : coarsePixels(tile.layer) }));
    const fine = first.map((tile) => ({ ...tile, pixels: SIZE }));
    const few = missing.filter((tile) => !this.store.has(tile));
    const wanted = [...coarse, ...fine, ...(shares ? [...towers(few, FEW), ...towers(missing, SIZE)] : [])];
    const nameOf = (tile) => `${keyOf(tile)}/${tile.columns ?? tile.pixels}/${tile.floors ?? 1}/${tile.part}`;
    const keys = new Set(wanted.map(nameOf));
    for (const [key, id] of this.asked) {
      if (!keys.has(key)) {
        this.asked.delete(key);
        this.pool.stop(id);
      }
    }
    // Two in work for each worker: the queue stays short, and follows the view.
    const free = 2 * this.pool.members.length - this.asked.size;
    const fresh = wanted.filter((tile) => !this.asked.has(nameOf(tile)));
    fresh.slice(0, Math.max(free, 0)).forEach((tile) => this.#ask(tile, nameOf(tile)));
    this.drawable = coarse.length === 0;
    this.idle = wanted.length === 0;
    if (this.idle) this.canvas.dispatchEvent(new Event("complete"));
  }

  async #ask(tile, key) {
    const promise = this.pool.ask("tile", windowOf(tile, tile.pixels));
    this.asked.set(key, promise.id);
    try {
      const found = await promise;
      const floors = tile.floors ?? 1;
      for (let floor = 0; floor < floors && !found.stopped; floor++) {
        const [part, whole] = [floor === floors - 1 ? (tile.part ?? 1) : 1, !tile.columns];
        // What is above the part stays transparent.
        const above = (floors - 2 + (tile.part ?? 1) - floor) * SIZE;
        const own = { ...tile, j: tile.j + floor, part };
        // A tower begins below the tiles that are wanted: a finer picture stays, and is not computed again.
        if (tile.columns === FEW && this.store.isFine(own)) continue;
        this.store.put(own, { bitmap: whole ? found.bitmap : cut(found.bitmap, above), part });
      }
      if (tile.columns) found.bitmap?.close();
    } catch (error) {
      // A tile without a picture is marked; it is not asked for again.
      for (let floor = 0; floor < (tile.floors ?? 1); floor++)
        this.store.put({ ...tile, j: tile.j + floor }, { bitmap: null, error: error.message });
      say(`A part of the picture is missing: ${error.message}`);
    }
    if (this.asked.get(key) === promise.id) this.asked.delete(key);
    this.refresh();
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = this.size;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    this.frames += 1;
    fitLetters();
    paint(this.context, this, ratio);
    const { all, there, failed } = this.parts;
    const progress = document.getElementById("progress");
    progress.hidden = there === all;
    progress.textContent = `${there} of ${all} parts${failed ? `; red: ${failed} failed` : ""}`;
  }
}

/** The rows of a tile, from one on; above the first row nothing. */
function cut(bitmap, from) {
  const canvas = new OffscreenCanvas(bitmap.width, SIZE);
  canvas.getContext("2d").drawImage(bitmap, 0, -from);
  return canvas.transferToImageBitmap();
}

/** Marks a part that is not computed, or red one that failed: no fate is drawn in lines. */
export function hatch(context, left, top, width, height, failed = false) {
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  context.beginPath();
  for (let x = left - height; x < left + width; x += 8) {
    context.moveTo(x, failed ? top : top + height);
    context.lineTo(x + height, failed ? top + height : top);
  }
  context.lineWidth = 1;
  context.strokeStyle = failed ? "#d03a2b" : "#888";
  context.stroke();
  context.restore();
}

/** Draws all into a context of the canvas's size. */
export function paint(context, plane, ratio) {
  const style = getComputedStyle(document.documentElement);
  const [ink, paper] = [style.getPropertyValue("--ink"), style.getPropertyValue("--paper")];
  const { size, box } = plane;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = paper;
  context.fillRect(0, 0, size.width, size.height);
  context.save();
  context.beginPath();
  context.rect(MARGIN.left, MARGIN.top, box.width, box.height);
  context.clip();
  if (plane.overlay) plane.overlay.paint(context, box);
  else paintTiles(context, plane, box);
  if (!plane.overlay) {
    if (state.other) paintKept(context, box);
    if (plane.hovered) paintOrbit(context, box, plane.hovered, 0.5);
    if (plane.orbit && state.pin) paintOrbit(context, box, plane.orbit, 1);
    if (state.pin) paintPin(context, box);
  }
  context.restore();
  context.strokeStyle = ink;
  context.lineWidth = 1;
  context.strokeRect(MARGIN.left - 0.5, MARGIN.top - 0.5, box.width + 1, box.height + 1);
  plane.column?.paint(context, box, ink);
  paintAxes(context, axesOf(plane), ink);
}

export const axesOf = (plane) =>
  plane.overlay ? plane.overlay.axes(plane.size) : planeAxes(state.view, plane.size, plane.legend.fixedPoints);

/** In the dark the colours are dimmed: a large light area would dazzle. Once for all pictures, which may lie over each other. */
const dark = matchMedia("(prefers-color-scheme: dark)");
export function dim(context, left, top, width, height) {
  if (!dark.matches) return;
  context.globalAlpha = 0.3;
  context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--paper");
  context.fillRect(left, top, width, height);
  context.globalAlpha = 1;
}

function paintTiles(context, plane, box) {
  const ratio = window.devicePixelRatio || 1;
  const pixels = { width: box.width * ratio, height: box.height * ratio };
  const snap = (value) => Math.round(value * ratio) / ratio;
  const hatched = [];
  for (const tile of needed(state.view, state.layer, pixels, { x: 0, alpha: 0 })) {
    const pictures = plane.store.best(tile);
    const { x, alpha } = windowOf({ ...tile, part: 1 });
    const from = place(state.view, x[0], alpha[1], box);
    const to = place(state.view, x[1], alpha[0], box);
    const [left, top] = [snap(MARGIN.left + from.left), snap(MARGIN.top + from.top)];
    const [right, bottom] = [snap(MARGIN.left + to.left), snap(MARGIN.top + to.top)];
    context.imageSmoothingEnabled = (right - left) * ratio < SIZE;
    for (const picture of pictures)
      context.drawImage(
        picture.bitmap,
        picture.left,
        picture.top,
        picture.width,
        picture.height,
        left,
        top,
        right - left,
        bottom - top,
      );
    const failed = plane.store.hasFailed(tile);
    if (failed || pictures.length === 0) hatched.push([left, top, right - left, bottom - top, failed]);
  }
  dim(context, MARGIN.left, MARGIN.top, box.width, box.height);
  // What is missing is marked as brightly as in the light.
  hatched.forEach((part) => hatch(context, ...part));
}

/** Draws a path in black with a white border, which is seen on every colour: lines of these two widths. */
export function outlined(context, [border, line], path) {
  for (const [color, width] of [
    ["#fff", border],
    ["#000", line],
  ]) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.beginPath();
    path();
    context.stroke();
  }
}

/** The widths of the mark of a point. */
export const MARK = [4, 1.6];

/** The speeds of an orbit, one above or below the other at its mass ratio: a ring for each, smaller from hop to hop. */
function paintOrbit(context, box, { m, speeds }, strength) {
  const places = speeds.map((alpha) => place(state.view, toX(state.view, m), alpha, box));
  context.globalAlpha = strength;
  outlined(context, [3, 1.2], () =>
    places.forEach(({ left, top }, k) => {
      const radius = Math.max(5 - 0.4 * k, 1.5);
      context.moveTo(MARGIN.left + left + radius, MARGIN.top + top);
      context.arc(MARGIN.left + left, MARGIN.top + top, radius, 0, 2 * Math.PI);
    }),
  );
  context.globalAlpha = 1;
}

/** The point that is kept to compare: a square. */
function paintKept(context, box) {
  const { left, top } = place(state.view, toX(state.view, state.other.m), state.other.alpha, box);
  outlined(context, MARK, () => context.rect(MARGIN.left + left - 6, MARGIN.top + top - 6, 12, 12));
}

function paintPin(context, box) {
  const { left, top } = place(state.view, toX(state.view, state.pin.m), state.pin.alpha, box);
  outlined(context, MARK, () => {
    context.arc(MARGIN.left + left, MARGIN.top + top, 7, 0, 2 * Math.PI);
    context.moveTo(MARGIN.left + left - 12, MARGIN.top + top);
    context.lineTo(MARGIN.left + left - 4, MARGIN.top + top);
    context.moveTo(MARGIN.left + left + 4, MARGIN.top + top);
    context.lineTo(MARGIN.left + left + 12, MARGIN.top + top);
  });
}
