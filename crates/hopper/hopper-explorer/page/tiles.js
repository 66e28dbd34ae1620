// Which tiles a view needs, and the tiles that are there. A tile is a dyadic part of the plane: its ends are exact
// doubles.

import { layers } from "./state.js";

export const SIZE = 256;
/** Pixels of the first, coarse picture of a tile each way: a sixteenth of the work. */
export const COARSE = 64;
/** The same where a pixel takes many times as long as a fate; and the columns of a strip, some milliseconds of work. */
const [COARSE_DEAR, DEAR, STRIP, STRIP_DEAR] = [16, 10, 32, 2];
/** Columns of the first picture of a tower. */
export const FEW = 64;
/** Tiles of a tower, at most: what the core makes at once. */
const HIGHEST = 16;
/** The number of the layer that is shown until one of shares is there. */
export const QUICK = 0;

const isDear = (layer) => layers[layer].cost > DEAR;
export const coarsePixels = (layer) => (isDear(layer) ? COARSE_DEAR : COARSE);
export const stripOf = (layer) => (isDear(layer) ? STRIP_DEAR : STRIP);
export const isShares = (layer) => layers[layer].kind === "shares";
/** A coarser tile whose picture is as good as the first one. */
const AS_GOOD = 2;
/** Tiles that are kept: 256 kB each. A view of 4K has 160. */
const KEPT = 320;
/** Levels above its own in which a picture for a missing tile is looked for. */
const ANCESTORS = 7;

/** The level at which a pixel of a tile is as wide as one of the screen, to the nearest power of two. */
export const level = ([low, high], pixels) => Math.round(Math.log2((SIZE ** -1 * pixels) / (high - low)));

export const keyOf = (tile) => `${tile.layer}${tile.logarithmic ? "l" : ""}/${tile.lx}/${tile.la}/${tile.i}/${tile.j}`;

/** The window of a tile, or of a tower. */
export function windowOf({ layer, logarithmic, lx, la, i, j, columns, floors = 1, part = 1 }, pixels = SIZE) {
  const high = floors - 1 + part;
  const x = [i * 2 ** -lx, (i + 1) * 2 ** -lx];
  const alpha = [j * 2 ** -la, (j + high) * 2 ** -la];
  return { layer, logarithmic, x, alpha, columns: columns ?? pixels, rows: pixels * high, strip: stripOf(layer) };
}

/**
 * Tiles of shares as towers, each from α = 0 to its highest tile: shares are found upwards from there, so that the lower tiles cost nothing more, and their
 * pixels are the same however high the tower is. Tiles beyond its greatest height are alone.
 */
export function towers(tiles, columns) {
  const found = new Map();
  for (const tile of tiles) {
    const alone = tile.j >= HIGHEST;
    const key = alone ? `${tile.i}/${tile.j}` : `${tile.i}`;
    const known = found.get(key);
    const far = Math.min(known?.far ?? Infinity, tile.far);
    if (known && known.floors > tile.j) known.far = far;
    else if (alone) found.set(key, { ...tile, columns, pixels: SIZE, floors: 1 });
    else found.set(key, { ...tile, j: 0, columns, pixels: SIZE, floors: tile.j + 1, far });
  }
  return [...found.values()].sort((a, b) => a.far - b.far);
}

/** The tiles of a view, the nearest to a point first. */
export function needed(view, layer, { width, height }, focus) {
  const lx = level(view.x, width);
  const la = level(view.alpha, height);
  const range = ([low, high], l) => [Math.floor(low * 2 ** l), Math.ceil(high * 2 ** l) - 1];
  const [i0, i1] = range(view.x, lx);
  const [j0, j1] = range(view.alpha, la);
  const tiles = [];
  for (let j = Math.max(j0, 0); j <= j1; j++) {
    for (let i = view.logarithmic ? i0 : Math.max(i0, 0); i <= i1; i++) {
      const far = Math.hypot((i + 0.5) * 2 ** -lx - focus.x, ((j + 0.5) * 2 ** -la - focus.alpha) * 2 ** (la - lx));
      // Shares are dear where α is large: of the highest tile there is what the view shows, in eighths.
      const seen = Math.ceil((view.alpha[1] * 2 ** la - j) * 8) / 8;
      const part = isShares(layer) ? Math.min(seen, 1) : 1;
      tiles.push({ layer, logarithmic: view.logarithmic, lx, la, i, j, far, part });
    }
  }
  return tiles.sort((a, b) => a.far - b.far);
}

export class TileStore {
  constructor() {
    this.tiles = new Map();
  }

  get(tile) {
    const key = keyOf(tile);
    const found = this.tiles.get(key);
    if (found) {
      this.tiles.delete(key);
      this.tiles.set(key, found);
    } // the last used is the last
    return found;
  }

  /** Whether the fine picture is there, or none can be had. */
  isFine(tile) {
    const found = this.tiles.get(keyOf(tile));
    return found !== undefined && (!found.bitmap || (found.bitmap.width === SIZE && !(found.part < tile.part)));
  }

  /** Whether there is a picture of its own. */
  has(tile) {
    const found = this.tiles.get(keyOf(tile));
    return found !== undefined && !(found.part < tile.part);
  }

  /** Whether no picture can be had. */
  hasFailed(tile) {
    return this.tiles.get(keyOf(tile))?.bitmap === null;
  }

  /** Whether there is something of this layer to show until the fine picture comes. */
  isCoarse(tile) {
    const { up } = this.#best(tile) ?? { up: Infinity };
    return up <= AS_GOOD;
  }

  put(tile, picture) {
    const before = this.tiles.get(keyOf(tile));
    before?.bitmap?.close();
    this.tiles.delete(keyOf(tile));
    this.tiles.set(keyOf(tile), picture);
    for (const [key, oldest] of this.tiles) {
      if (this.tiles.size <= KEPT) break;
      oldest.bitmap?.close();
      this.tiles.delete(key);
    }
  }

  /** The pictures of a tile, or the parts of coarser ones that cover it, one over the other. Shares, which take longer, have finer fates until they come. */
  best(tile) {
    const own = this.#best(tile);
    const quick = isShares(tile.layer) ? this.#best({ ...tile, layer: QUICK }) : null;
    if (quick && !(own?.height >= quick.height)) return [quick];
    // A picture of a part leaves the rest to the one below.
    return [own?.part < 1 ? quick : null, own].filter(Boolean);
  }

  #best(tile) {
    for (let up = 0; up <= ANCESTORS; up++) {
      const part = 2 ** -up;
      const parent = {
        ...tile,
        lx: tile.lx - up,
        la: tile.la - up,
        i: Math.floor(tile.i * part),
        j: Math.floor(tile.j * part),
      };
      const found = this.get(parent);
      if (!found?.bitmap) continue;
      const [width, height] = [found.bitmap.width * part, found.bitmap.height * part];
      const left = (tile.i * part - parent.i) * found.bitmap.width;
      const top = (parent.j + 1 - (tile.j + 1) * part) * found.bitmap.height;
      return { bitmap: found.bitmap, left, top, width, height, up, part: found.part ?? 1 };
    }
    return null;
  }
}
