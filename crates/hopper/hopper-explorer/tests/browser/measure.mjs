// The figures of docs/explorer.md, measured in this Chromium.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { availableParallelism } from "node:os";
import { gzipSync } from "node:zlib";
import { READY, launch, open, ready, url } from "./browser.mjs";

const native = JSON.parse(readFileSync(process.env.EXPLORER_NATIVE, "utf8"));
const site = process.env.EXPLORER_SITE;
const say = (name, value) => console.log(`${name.padEnd(58)} ${value}`);
const browser = await launch();
say("browser", `Chromium ${browser.version()}, ${availableParallelism()} cores`);

const sizes = readdirSync(site).map((name) => [name, gzipSync(readFileSync(`${site}/${name}`), { level: 9 }).length]);
const sizeOf = new Map(sizes);

// First picture: all of the window in coarse points; complete: in fine ones. The best of three, each with an empty
// cache.
const first = [];
let fetched = [];
for (let k = 0; k < 3; k++) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.goto(`${url}#layer=fate`);
  const coarse = await page.waitForFunction(() => window.explorer?.plane.drawable && performance.now(), null, {
    ...READY,
    polling: "raf",
  });
  const fine = await page.waitForFunction(() => window.explorer?.plane.idle && performance.now(), null, {
    ...READY,
    polling: "raf",
  });
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0].startTime);
  first.push([paint, await coarse.jsonValue(), await fine.jsonValue()]);
  fetched = await page.evaluate(() => ["index.html", ...performance.getEntriesByType("resource").map(({ name }) => name.split("/").at(-1))]);
  await context.close();
}
first.sort((a, b) => a[1] - b[1]);
// A worker's scripts are no entries of the page.
const before = new Set([...fetched, "worker.js"]);
const kilobytes = (names) => ([...names].reduce((sum, name) => sum + (sizeOf.get(name) ?? 0), 0) / 1000).toFixed(1);
say("fetched before the complete picture, by gzip -9", `${kilobytes(before)} kB, of which the core has ${kilobytes(["core.wasm"])} kB`);
for (const [name] of sizes.filter(([name]) => !before.has(name) && name !== "explorer.html"))
  say(`fetched when it is first used: ${name}`, `${kilobytes([name])} kB`);
say(
  "first paint, first picture, complete picture of points",
  `${first[0].map((time) => time.toFixed(0)).join(" ms, ")} ms`,
);

const page = await open(browser, "#pin=0.2,7", { viewport: { width: 1280, height: 800 } });
for (const tile of native.tiles.filter(({ pixels }) => pixels === 256)) {
  const job = {
    layer: tile.layer,
    logarithmic: tile.logarithmic,
    x: tile.x,
    alpha: tile.alpha,
    columns: 256,
    rows: 256,
  };
  const best = await page.evaluate(async (job) => {
    let best = Infinity;
    for (let k = 0; k < 7; k++) {
      const begin = performance.now();
      await explorer.pool.ask("tile", job);
      best = Math.min(best, performance.now() - begin);
    }
    return best;
  }, job);
  const where = `M ${tile.x.join("–")}, α ${tile.alpha.join("–")}`;
  say(
    `256² tile in a worker, ${where}`,
    `${best.toFixed(1)} ms; native ${tile.milliseconds.toFixed(1)} ms: ${(best / tile.milliseconds).toFixed(2)} ×`,
  );
}

// Exact shares of the home view: a fourth of the columns, then all of them.
{
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.goto(url);
  const shares = (test) => page.waitForFunction(test, null, { timeout: 240_000, polling: 200 }).then(() => page.evaluate(() => performance.now()));
  const few = await shares(() => {
    const { plane, state } = window.explorer ?? {};
    return plane?.drawable && ![...plane.asked.keys()].some((key) => !key.startsWith(`${state.layer}/`) || key.includes("/64/")) && plane.asked.size > 0;
  });
  const all = await shares(() => window.explorer.plane.idle);
  const workers = await page.evaluate(() => explorer.pool.members.length);
  say(`exact shares at home, a fourth of the columns, all: ${workers} worker(s)`, `${(few / 1000).toFixed(0)} s, ${(all / 1000).toFixed(0)} s`);
  await context.close();
}

// The panels of a pinned point: from the click to the last drawing.
const panels = await page.evaluate(async () => {
  const times = [];
  for (const [m, alpha] of [
    [0.2, 7.1],
    [0.15, 9.3],
    [0.4, 12.1],
    [0.1, 18.2],
    [1, 6.2],
  ]) {
    const begin = performance.now();
    explorer.change({ pin: { m, alpha } });
    await new Promise((done) => explorer.plane.canvas.addEventListener("panels", done, { once: true }));
    times.push(performance.now() - begin);
  }
  return times.sort((a, b) => a - b);
});
say("panels of a pinned point", `median ${panels[2].toFixed(0)} ms, largest ${panels.at(-1).toFixed(0)} ms`);

// Frames while tiles come: a zoom in and out for some seconds, a step for each frame.
const frames = await page.evaluate(async () => {
  const gaps = [];
  const end = performance.now() + 5000;
  let last = performance.now();
  for (let k = 0; last < end; k++) {
    const factor = Math.floor(k / 100) % 2 ? 1.02 : 1 / 1.02;
    const { view } = explorer.state;
    const zoom = ([low, high], centre) => [centre - (centre - low) * factor, centre + (high - centre) * factor];
    explorer.change({ view: { ...view, x: zoom(view.x, 0.15), alpha: zoom(view.alpha, 11.92) } });
    await new Promise(requestAnimationFrame);
    gaps.push(performance.now() - last);
    last = performance.now();
  }
  return gaps.sort((a, b) => a - b);
});
const mean = frames.reduce((sum, gap) => sum + gap, 0) / frames.length;
say(
  "frames while zooming",
  `${(1000 / mean).toFixed(0)} a second; 95 of 100 come within ${frames[Math.floor(0.95 * frames.length)].toFixed(0)} ms`,
);

// Memory of this browser's pages under random zooming; other browsers may run beside it.
const session = await browser.newBrowserCDPSession();
const memory = async () => {
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const pages = processInfo.filter(({ type }) => type === "renderer").map(({ id }) => id);
  const out = execFileSync("ps", ["-o", "rss=", "-p", pages.join(",")], { encoding: "utf8" });
  return (
    out
      .trim()
      .split(/\s+/)
      .reduce((sum, size) => sum + Number(size), 0) / 1000
  );
};
const minutes = Number(process.env.EXPLORER_MINUTES ?? 6);
const points = [];
let seed = 1;
const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
const begin = Date.now();
while (Date.now() - begin < minutes * 60_000) {
  const width = 10 ** (-4 * random());
  const height = 14 * 10 ** (-4 * random());
  const [left, low] = [random() * (1 - width), 4 + random() * (16 - height)];
  await page.evaluate((view) => explorer.change({ view }), {
    logarithmic: false,
    x: [left, left + width],
    alpha: [Math.max(low, 1), Math.max(low, 1) + height],
  });
  await page.waitForTimeout(300);
  points.push([(Date.now() - begin) / 60_000, await memory()]);
}
// The slope over the second half, when the store of tiles is full.
const late = points.filter(([time]) => time > minutes / 2);
const [tm, mm] = [0, 1].map((k) => late.reduce((sum, point) => sum + point[k], 0) / late.length);
const slope =
  late.reduce((sum, [t, m]) => sum + (t - tm) * (m - mm), 0) / late.reduce((sum, [t]) => sum + (t - tm) ** 2, 0);
say(
  `memory of the page in ${minutes} minutes of random zooming`,
  `largest ${Math.max(...points.map(([, m]) => m)).toFixed(0)} MB; in the second half ${slope.toFixed(1)} MB a minute`,
);
await page.evaluate(() => explorer.change({ view: { logarithmic: false, x: [0, 1], alpha: [4.3, 20.4] } }));
await page.waitForFunction(ready, null, READY);
await browser.close();
