// The page as a person would use it, in a headless Chromium.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { test } from "node:test";
import { DIGEST, READY, open, pages, ready, settled, url, view } from "./browser.mjs";

const native = JSON.parse(readFileSync(process.env.EXPLORER_NATIVE, "utf8"));
const { onPage, browser } = pages();
const said = (page) => page.textContent("#say");
const span = ([low, high]) => high - low;
/** A change, and the picture that it asks for. `settled` alone would see the picture before. */
const complete = (page, fields) =>
  page.evaluate(
    (fields) =>
      new Promise((done) => {
        explorer.plane.canvas.addEventListener("complete", done, { once: true });
        explorer.change(fields);
      }).then(() => null),
    fields,
  );

onPage("the first picture has several colours", "", async (page) => {
  const colors = await page.evaluate(() => {
    const { canvas, context } = explorer.plane;
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
  });
  assert.ok(colors > 5, `${colors} colours`);
});

onPage("tiles have the bits of the native ones", "", async (page) => {
  for (const { values, colors, pixels, milliseconds, ...window } of native.tiles) {
    const job = { ...window, columns: pixels, rows: pixels, values: window.layer !== 2 };
    const found = await page.evaluate(
      async ({ job, digest }) => {
        const hash = eval(digest);
        const { values, bitmap } = await explorer.pool.ask("tile", job);
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        return { values: values && hash(new Uint8Array(values.buffer)), colors: hash(data) };
      },
      { job, digest: DIGEST },
    );
    if (job.values) assert.equal(found.values, values, JSON.stringify(window));
    assert.equal(found.colors, colors, JSON.stringify(window));
  }
});

onPage("wheel zooms both axes, Shift only α, Alt only M", "", async (page) => {
  const turn = async (key) => {
    const from = await view(page);
    if (key) await page.keyboard.down(key);
    await page.mouse.move(400, 300);
    await page.mouse.wheel(0, -300);
    if (key) await page.keyboard.up(key);
    await page.waitForFunction((old) => JSON.stringify(explorer.state.view) !== old, JSON.stringify(from));
    const to = await view(page);
    return [span(to.x) / span(from.x), span(to.alpha) / span(from.alpha)];
  };
  const [m, alpha] = await turn();
  // Views are rounded to what no screen shows.
  assert.ok(m < 0.8 && Math.abs(m - alpha) < 1e-4, `${m} ${alpha}`);
  const [fixed, zoomed] = await turn("Shift");
  assert.ok(Math.abs(fixed - 1) < 1e-12 && zoomed < 0.8);
  const [narrow, same] = await turn("Alt");
  assert.ok(narrow < 0.8 && Math.abs(same - 1) < 1e-12);
  await settled(page);
});

onPage("a wheel keeps the point under the cursor", "", async (page) => {
  await page.mouse.move(500, 350);
  const at = () =>
    page.evaluate(() => {
      const { left, top } = explorer.plane.canvas.getBoundingClientRect();
      const { box } = explorer.plane,
        { view } = explorer.state;
      return [
        view.x[0] + ((500 - left - 62) / box.width) * (view.x[1] - view.x[0]),
        view.alpha[1] - ((350 - top - 8) / box.height) * (view.alpha[1] - view.alpha[0]),
      ];
    });
  const from = await at();
  for (let k = 0; k < 5; k++) await page.mouse.wheel(0, -200);
  await page.waitForFunction(() => explorer.state.view.x[1] - explorer.state.view.x[0] < 0.3);
  const to = await at();
  // To a tenth of a pixel.
  const { x, alpha } = await view(page);
  assert.ok(Math.abs(from[0] - to[0]) < 1e-4 * span(x) && Math.abs(from[1] - to[1]) < 1e-4 * span(alpha), `${from} ${to}`);
});

onPage(
  "two fingers pinch",
  "",
  async (page) => {
    const from = await view(page);
    const client = await page.context().newCDPSession(page);
    const touch = (type, points) =>
      client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await touch("touchStart", [
      [300, 300],
      [380, 380],
    ]);
    for (let k = 1; k <= 8; k++)
      await touch("touchMove", [
        [300 - 8 * k, 300 - 8 * k],
        [380 + 8 * k, 380 + 8 * k],
      ]);
    await touch("touchEnd", []);
    // The browser hands movements on with its frames.
    await page.waitForFunction(
      ([width, height]) => {
        const { x, alpha } = explorer.state.view;
        return x[1] - x[0] < 0.6 * width && alpha[1] - alpha[0] < 0.6 * height;
      },
      [span(from.x), span(from.alpha)],
    );
  },
  { hasTouch: true },
);

onPage("ten points have their native fates", "", async (page) => {
  for (const known of native.points) {
    await page.fill("#pin-m", String(known.massRatio));
    await page.fill("#pin-alpha", String(known.alpha));
    await page.press("#pin-alpha", "Enter");
    await page.waitForFunction(
      ([m, alpha]) => explorer.state.pin?.m === m && explorer.state.pin?.alpha === alpha,
      [known.massRatio, known.alpha],
    );
    const name = known.fate.name.replace(/_(\d)/, (_, digit) => "₀₁₂₃₄₅₆₇₈₉"[digit]);
    await page.waitForFunction((name) => document.getElementById("verdict").textContent.endsWith(name), name);
    const found = await page.evaluate(
      ({ massRatio, alpha }) => explorer.desk.ask("point", massRatio, alpha, 60),
      known,
    );
    assert.deepEqual(found, known);
  }
});

onPage("a click pins the point under the cursor", "", async (page) => {
  await page.mouse.click(400, 300);
  await page.waitForSelector("#verdict .swatch");
  const pin = await page.evaluate(() => explorer.state.pin);
  const fate = await page.evaluate(({ m, alpha }) => explorer.desk.ask("point", m, alpha, 0), pin);
  assert.ok((await page.textContent("#verdict")).toLowerCase().includes(fate.fate.plain));
  assert.ok((await page.inputValue("#pin-m")) === String(pin.m) && pin.m > 0.5 && pin.m < 0.8);
});

onPage("a pinned point says whether its fate is proved", "#pin=0.2,4.55", async (page) => {
  const words = (pattern) =>
    page.waitForFunction(
      (pattern) => new RegExp(pattern).test(document.getElementById("proof")?.textContent),
      pattern,
      READY,
    );
  await words("^Proved, by enclosures");
  // Enclosures do not tell on which side of α*₁ its double lies.
  await page.evaluate(() => explorer.change({ pin: { m: 0.2, alpha: 4.493409457909064 } }));
  await words("^Computed, not proved");
});

onPage(
  "a point shows its fate although its map or motion is too long, and nothing of the point before",
  "#pin=0.2,7",
  async (page) => {
    await page.waitForSelector("#map svg");
    const pin = (m, alpha) =>
      page.evaluate(
        (pin) =>
          new Promise((done) => {
            explorer.plane.canvas.addEventListener("panels", done, { once: true });
            explorer.change({ pin });
          }).then(() => document.getElementById("verdict").textContent),
        { m, alpha },
      );
    assert.match(await pin(0.2, 1e5), /to α\*|decaying|grounded/);
    assert.match(await page.textContent("#map"), /No map: .* humps/);
    assert.match(await pin(1e-300, 7), /to α\*₁/);
    assert.match(await said(page), /No motion: the motion lasts/);
    assert.equal(await page.$("#stage svg"), null);
    // Beyond the model.
    await page.evaluate(() => explorer.change({ pin: { m: 0.2, alpha: 1e300 } }));
    await page.waitForFunction(() => /does not resolve/.test(document.getElementById("fate").textContent), null, READY);
    assert.deepEqual([await page.textContent("#map"), await page.textContent("#orbit div")], ["", ""]);
  },
);

onPage("the layer of proofs has its legend, table and key", "#lin=0.1,0.3,8,10", async (page) => {
  await page.keyboard.press("4");
  await page.waitForFunction(() => document.getElementById("legend").textContent.includes("computed, not proved"));
  assert.match(
    await page.evaluate(() => new Promise((done) => setTimeout(() => done(location.hash), 400))),
    /layer=proof/,
  );
  const csv = (await saved(page, "CSV")).toString().trim().split("\n");
  assert.equal(csv[2], "M,alpha,label,proved");
  assert.ok(csv.slice(3).every((line) => line.endsWith(",1")));
  await page.keyboard.press("1");
  await page.waitForFunction(() => !document.getElementById("legend").textContent.includes("computed, not proved"));
});

onPage("dragging along the map moves α", "#pin=0.2,7", async (page) => {
  await page.waitForSelector("#map svg");
  await page.evaluate(() => document.querySelector("#map svg").scrollIntoView({ block: "center" }));
  const { x, y, width, height } = await page.evaluate(() =>
    document.querySelector("#map svg").getBoundingClientRect().toJSON(),
  );
  const alpha = () => page.evaluate(() => explorer.state.pin.alpha);
  const [middle, right] = [x + 0.5 * width, x + 0.7 * width];
  await page.mouse.move(middle, y + 0.5 * height);
  await page.mouse.down();
  const pressed = await alpha();
  await page.mouse.move(right, y + 0.4 * height, { steps: 8 });
  const dragged = await alpha();
  // The axis stays while the button is held: equal steps of the mouse are equal steps of α.
  await page.mouse.move(middle, y + 0.5 * height);
  assert.equal(await alpha(), pressed);
  await page.mouse.move(right, y + 0.4 * height);
  assert.equal(await alpha(), dragged);
  await page.mouse.up();
  assert.ok(pressed < dragged && dragged < 10 && pressed > 2, `${pressed} ${dragged}`);
  // The panels follow, and a movement without a button moves nothing.
  await page.waitForFunction(
    (alpha) => document.querySelector("#map svg title")?.textContent.includes(`orbit from ${alpha}`),
    dragged,
    READY,
  );
  await page.mouse.move(middle, y + 0.5 * height);
  assert.equal(await alpha(), dragged);
});

onPage("the motion has the heights of the library", "#pin=0.2,7&hops=6", async (page) => {
  await page.waitForSelector("#stage svg");
  const found = await page.evaluate(() => explorer.desk.ask("motion", 0.2, 7, 6).then((all) => [...all]));
  assert.deepEqual(found, native.samples);
  // The drawn hopper is where a sample is.
  const k = 40;
  const [time, , , upper, , lower] = native.samples.slice(1 + 7 * k, 8 + 7 * k);
  const shown = await page.evaluate((time) => explorer.stateAt(time), time);
  assert.ok(Math.abs(shown.upper - upper) < 1e-12 && Math.abs(shown.lower - lower) < 1e-12);
  await page.click("#play");
  const before = await page.inputValue("#time");
  await page.waitForFunction((before) => document.getElementById("time").value > Number(before) + 1, before);
  await page.click("#play");
  const still = await page.inputValue("#time");
  await page.click("#forth");
  assert.ok(Number(await page.inputValue("#time")) > Number(still));
});

onPage("a link gives the same bits", "", async (page) => {
  const fields = {
    view: { logarithmic: true, x: [-3.0000000000000004, 0.1 + 0.2], alpha: [4.493409457909064, 7.725251836937707] },
    layer: 1,
    pin: { m: 0.1 + 0.2, alpha: Math.PI * 2 },
    hops: 7,
  };
  await page.evaluate((fields) => explorer.change(fields), fields);
  await page.waitForFunction(() => location.hash.includes("hops=7"));
  const hash = new URL(page.url()).hash;
  const other = await open(browser(), hash);
  const state = await other.evaluate(() => explorer.state);
  for (const [name, value] of Object.entries(fields)) assert.deepEqual(state[name], value, name);
  await other.context().close();
});

for (const garbage of [
  "#lin=1,2,3",
  "#lin=NaN,1,2,3&pin=-1,x",
  "#%E0%A4%A&depth=a,b,c",
  "#layer=<script>",
  "#pin=1e400,7&lin=1,0,5,4",
  "#lin=0,1e308,0,1e308",
  "#depth=0.12,11.92,1e9",
]) {
  onPage(`garbage in the address survives: ${garbage}`, garbage, async (page) => {
    assert.ok((await view(page)).alpha[1] > 4);
    assert.match(await said(page), /makes no sense|M from/);
    await page.keyboard.press("h");
    await settled(page);
  });
}

onPage("deep zoom to 10⁻¹⁰⁰ and on", "#depth=0.12,11.920553918335775,100", async (page) => {
  await page.waitForFunction(() => explorer.deep.frames.some(({ pixels }) => pixels === 256), null, READY);
  assert.match(await said(page), /10⁻¹⁰⁰ about p = 11\.92055391/);
  const hash = await page.evaluate(async (digest) => {
    const about = explorer.state.depth.about;
    const data = await explorer.deep.desk.ask("depthFrame", 2, 100, 64, 64);
    return [eval(digest)(data), about];
  }, DIGEST);
  assert.deepEqual(hash, [native.frame, native.depth]);
  // A worker that dies is replaced, and its chart is opened again.
  await page.evaluate(() => {
    explorer.deep.desk.ask("none").catch(() => {});
    explorer.change({ depth: { ...explorer.state.depth, depth: 100.05 } });
  });
  await page.waitForFunction(
    () => explorer.deep.frames.some(({ depth, pixels }) => depth === 100.05 && pixels === 256),
    null,
    READY,
  );
  for (let k = 0; k < 4; k++) await page.keyboard.press("+");
  const deeper = await page.evaluate(() => explorer.state.depth.depth);
  assert.ok(deeper > 100.5, `${deeper}`);
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => explorer.state.depth === null);
  await settled(page);
});

onPage(
  "a wheel at an edge goes over to its chart",
  "#lin=0.11999999,0.12000001,11.92055391,11.92055393",
  async (page) => {
    const target = await page.evaluate(() => {
      const { left, top } = explorer.plane.canvas.getBoundingClientRect();
      const { box } = explorer.plane,
        { view } = explorer.state;
      return {
        x: left + 62 + ((0.12 - view.x[0]) / (view.x[1] - view.x[0])) * box.width,
        y: top + 8 + ((view.alpha[1] - 11.920553918335775) / (view.alpha[1] - view.alpha[0])) * box.height,
      };
    });
    await page.mouse.move(target.x, target.y);
    for (let k = 0; k < 6; k++) await page.mouse.wheel(0, -200);
    await page.waitForFunction(() => explorer.state.depth !== null, null, READY);
    const depth = await page.evaluate(() => explorer.state.depth);
    assert.ok(Math.abs(depth.alpha - 11.9205539183) < 1e-6 && depth.depth > 8, JSON.stringify(depth));
    for (let k = 0; k < 3; k++) await page.mouse.wheel(0, 3000);
    await page.waitForFunction(() => explorer.state.depth === null);
  },
);

onPage("keyboard only", "", async (page) => {
  const home = await view(page);
  await page.keyboard.press("+");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("X");
  await page.keyboard.press("A");
  const there = await view(page);
  assert.ok(there.x[0] > 0.1 && span(there.x) < 0.5 * span(home.x));
  await page.keyboard.press("Enter");
  await page.waitForSelector("#verdict .swatch");
  // Every layer of the table has its key, its name and its legend.
  const names = await page.evaluate(() =>
    [...document.querySelectorAll("#layer option")].map(({ textContent }) => textContent),
  );
  assert.deepEqual(names, native.layers);
  for (const [key, layer] of [
    ["2", 1],
    ["3", 2],
    ["4", 3],
    ["0", 9],
    ["1", 0],
  ]) {
    await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => explorer.state.layer), layer);
  }
  await page.keyboard.press("l");
  assert.equal((await view(page)).logarithmic, true);
  await page.keyboard.press("t");
  for (let k = 0; k < 7; k++) await page.keyboard.press("n");
  await page.waitForFunction(() => /^8 of 8/.test(document.getElementById("stop").textContent), null, READY);
  await page.keyboard.press("n");
  await page.waitForSelector("#stop", { state: "hidden" });
  await page.keyboard.press("Escape");
  await page.keyboard.press("h");
  await page.keyboard.press("?");
  await page.waitForSelector("#dialog[open]");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !document.getElementById("dialog").open);
  // Tab comes to every button and input.
  const reached = new Set();
  for (let k = 0; k < 60; k++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  for (const id of [
    "layer",
    "logarithmic",
    "home",
    "deep",
    "tour",
    "share",
    "save",
    "help",
    "canvas",
    "pin-m",
    "pin-alpha",
    "play",
    "hops",
    "hopper",
  ]) {
    assert.ok(reached.has(id), `Tab does not come to ${id}`);
  }
});

onPage(
  "German and other numbers",
  "",
  async (page) => {
    const read = (text) => page.evaluate((text) => explorer.parse(text), text);
    for (const [text, value] of [
      ["0,2", 0.2],
      ["0.2", 0.2],
      [" 1e-3 ", 0.001],
      ["1,5·10^-3", 0.0015],
      ["−2", -2],
      ["", null],
      ["1,2,3", null],
      ["NaN", null],
      ["0x10", null],
      ["1e999", null],
    ]) {
      assert.equal(await read(text), value, text);
    }
    await page.fill("#pin-m", "0,25");
    await page.fill("#pin-alpha", "7,5");
    await page.press("#pin-alpha", "Enter");
    await page.waitForFunction(() => explorer.state.pin?.m === 0.25 && explorer.state.pin?.alpha === 7.5);
    await page.fill("#pin-m", "many");
    await page.press("#pin-m", "Enter");
    assert.match(await said(page), /not a positive number/);
  },
  { locale: "de-DE" },
);

/** Saves a file by its button in the dialog. */
async function saved(page, name) {
  await page.keyboard.press("s");
  const [download] = await Promise.all([
    page.waitForEvent("download", READY),
    page.click(`#dialog button:text-is("${name}")`),
  ]);
  await page.keyboard.press("Escape");
  // The browser closes a dialog some time after the key. A dialog that is opened before would be closed by it.
  await page.waitForFunction(() => !document.getElementById("dialog").open);
  return readFileSync(await download.path());
}

onPage("a text that is typed is not written over by an answer", "#pin=0.2,7", async (page) => {
  await page.waitForSelector("#map svg");
  await page.fill("#pin-alpha", "9");
  // Another pin comes while α is typed.
  await page.evaluate(() =>
    new Promise((done) => {
      explorer.plane.canvas.addEventListener("panels", done, { once: true });
      explorer.change({ pin: { m: 0.3, alpha: 7 } });
    }).then(() => null),
  );
  assert.deepEqual([await page.inputValue("#pin-m"), await page.inputValue("#pin-alpha")], ["0.3", "9"]);
  await page.press("#pin-alpha", "Enter");
  await page.waitForFunction(() => explorer.state.pin.m === 0.3 && explorer.state.pin.alpha === 9);
});

onPage("a deep view that was given up does not come back", "", async (page) => {
  await page.evaluate(() =>
    new Promise((done) => {
      // The answer waits until the key was pressed.
      const { ask } = explorer.deep.desk;
      explorer.deep.desk.ask = async function (...question) {
        const found = await ask.apply(this, question);
        document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "h", bubbles: true }));
        setTimeout(done, 0);
        return found;
      };
      location.hash = "#depth=0.12,11.920553918335775,20";
    }).then(() => null),
  );
  await settled(page);
  assert.equal(await page.evaluate(() => explorer.state.depth), null);
});

onPage("files hold the picture and its parameters", "#lin=0.1,0.3,4.5,9&pin=0.2,7", async (page) => {
  await page.waitForSelector("#map svg");
  const take = (name) => saved(page, name);
  const png = await take("PNG");
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  assert.ok(png.includes("iTXtDescription") && png.includes("M from 0.1 to 0.3") && png.includes("#lin=0.1,0.3,4.5,9"));
  // The browser reads the file with its texts, and sees the canvas.
  const same = await page.evaluate(
    async (bytes) => {
      const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
      const { canvas, context } = explorer.plane;
      const other = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      other.drawImage(bitmap, 0, 0);
      const [a, b] = [context, other].map((one) => one.getImageData(0, 0, canvas.width, canvas.height).data);
      return a.length === b.length && a.every((byte, k) => byte === b[k]);
    },
    [...png],
  );
  assert.ok(same);
  const svg = (await take("SVG")).toString();
  assert.ok(
    svg.startsWith("<svg") &&
      svg.includes("<desc>") &&
      svg.includes("M from 0.1 to 0.3") &&
      svg.includes("data:image/png"),
  );
  const parsed = await page.evaluate(
    (svg) => new DOMParser().parseFromString(svg, "image/svg+xml").querySelector("parsererror")?.textContent ?? "",
    svg,
  );
  assert.equal(parsed, "");
  const orbit = (await take("the orbit as CSV")).toString().split("\n");
  assert.equal(Number(orbit[4].split(",")[1]), native.points[0].speeds[1]);
  const map = (await take("the map as SVG")).toString();
  assert.ok(map.includes("<desc>") && !map.includes("var(--"));
});

// On a page of its own: a browser asks before the second file that is saved long after a click.
onPage("a table holds the labels of its places", "#lin=0.1,0.3,4.5,9", async (page) => {
  const csv = (await saved(page, "CSV")).toString().trim().split("\n");
  assert.equal(csv.length, 3 + 256 * 256);
  const [m, alpha, label] = csv[3 + 1000].split(",").map(Number);
  const { fate } = await page.evaluate(([m, alpha]) => explorer.desk.ask("point", m, alpha, 0), [m, alpha]);
  assert.equal(fate.label, label);
});

/** From now on questions of a kind wait until `answer` is called in the page, or fail for a reason. */
const hold = (page, pool, kind, reason = null) =>
  page.evaluate(
    ([name, kind, reason]) => {
      const pool = { pool: explorer.pool, desk: explorer.desk, well: explorer.deep.desk }[name];
      const ask = Object.getPrototypeOf(pool).ask.bind(pool);
      const gate = new Promise((open) => {
        window.answer = () => {
          delete pool.ask;
          open();
        };
      });
      pool.ask = (asked, ...question) => {
        if (asked !== kind) return ask(asked, ...question);
        return Object.assign(reason ? Promise.reject(new Error(reason)) : gate.then(() => ask(asked, ...question)), {
          id: -1,
        });
      };
    },
    [pool, kind, reason],
  );
/** The colours in the middle of the picture. */
const middle = (page) =>
  page.evaluate(() => {
    const { canvas, context } = explorer.plane;
    const { data } = context.getImageData(canvas.width / 2 - 40, canvas.height / 2 - 40, 80, 80);
    return [...new Set(new Uint32Array(data.buffer))].map((color) => [
      color & 255,
      (color >> 8) & 255,
      (color >> 16) & 255,
    ]);
  });
const isGray = ([red, green, blue]) => Math.max(red, green, blue) - Math.min(red, green, blue) < 10;
const isRed = ([red, green]) => red > 180 && green < 110;
const progressIs = (page, pattern) =>
  page.waitForFunction(
    (source) => new RegExp(source).test(document.getElementById("progress").textContent),
    pattern.source,
    READY,
  );
/** Windows of one fate, decaying: white, as light paper is. No other test asks for them. */
const WHITE = { logarithmic: false, x: [0.2, 0.201], alpha: [2, 2.01] };
const OTHER = { logarithmic: false, x: [0.3, 0.301], alpha: [2, 2.01] };

for (const colorScheme of ["light", "dark"]) {
  onPage(
    `a part without its tile is hatched, and one that failed is red (${colorScheme})`,
    "",
    async (page) => {
      assert.ok(await page.isHidden("#progress"));
      await hold(page, "pool", "tile");
      await page.evaluate((view) => explorer.change({ view }), WHITE);
      await progressIs(page, /^0 of \d+ parts$/);
      const waiting = await middle(page);
      assert.ok(waiting.length > 1 && waiting.every(isGray), JSON.stringify(waiting));
      await page.evaluate(() => answer());
      await page.waitForSelector("#progress", { state: "hidden", ...READY });
      // In the dark it is dimmed: 0.7 of white over the paper.
      const white = colorScheme === "dark" ? [185, 186, 187] : [255, 255, 255];
      const [shown, ...others] = await middle(page);
      assert.ok(others.length === 0 && shown.every((part, k) => Math.abs(part - white[k]) < 2), `${shown}`);
      await hold(page, "pool", "tile", "no worker");
      await page.evaluate((view) => explorer.change({ view }), OTHER);
      await progressIs(page, /^0 of (\d+) parts; red: \1 failed$/);
      assert.ok((await middle(page)).some(isRed));
      assert.match(await said(page), /A part of the picture is missing: no worker/);
    },
    { colorScheme },
  );
}

onPage("a deep view is hatched until its frame comes, and red if it failed", "", async (page) => {
  await hold(page, "well", "depthFrame");
  await page.evaluate(() => explorer.deep.open(0.12, 11.920553918335775, 20));
  await progressIs(page, /^0 of 2 parts$/);
  assert.ok((await middle(page)).some(([red, green, blue]) => red === 0x88 && green === 0x88 && blue === 0x88));
  await page.evaluate(() => answer());
  await page.waitForSelector("#progress", { state: "hidden", ...READY });
  await hold(page, "well", "depthFrame", "no frame");
  await page.evaluate(() => explorer.deep.open(0.12, 11.920553918335775, 30));
  await progressIs(page, /red: 1 failed/);
  assert.ok((await middle(page)).some(isRed));
});

onPage("a saved picture waits for its parts, and names those that failed", "", async (page) => {
  await hold(page, "pool", "tile");
  await page.evaluate((view) => explorer.change({ view }), WHITE);
  const file = saved(page, "PNG");
  await page.waitForFunction(() =>
    /^Waiting for the picture: 0 of \d+ parts/.test(document.getElementById("saved")?.textContent),
  );
  await page.evaluate(() => answer());
  const png = await file;
  assert.ok(png.includes("M from 0.2 to 0.201") && !png.includes("unfinished"));
  assert.deepEqual(await page.evaluate(() => explorer.plane.parts.there === explorer.plane.parts.all), true);
  await hold(page, "pool", "tile", "no worker");
  await page.evaluate((view) => explorer.change({ view }), OTHER);
  await progressIs(page, /failed/);
  assert.match(
    (await saved(page, "SVG")).toString(),
    /<title>.*M from 0\.3 to 0\.301.*; unfinished: (\d+) of \1 parts failed<\/title>/,
  );
});

onPage("a picture that waits is given up with its dialog", "", async (page) => {
  await hold(page, "pool", "tile");
  await page.evaluate((view) => explorer.change({ view }), WHITE);
  let downloads = 0;
  page.on("download", () => {
    downloads += 1;
  });
  await page.keyboard.press("s");
  await page.click('#dialog button:text-is("PNG")');
  await page.waitForFunction(() => /^Waiting/.test(document.getElementById("saved").textContent));
  await page.keyboard.press("Escape");
  await page.evaluate(() => answer());
  await settled(page);
  await page.waitForTimeout(500);
  assert.equal(downloads, 0);
});

onPage("a table has the words of its numbers, although the view moved on", "#lin=0.1,0.3,4.5,9", async (page) => {
  await hold(page, "desk", "places");
  const file = saved(page, "CSV");
  await page.waitForFunction(() => document.getElementById("saved")?.textContent === "Computing …");
  await page.evaluate(() => {
    explorer.change({ view: { logarithmic: false, x: [0.5, 0.6], alpha: [5, 6] }, layer: 1 });
    answer();
  });
  const lines = (await file).toString().split("\n");
  assert.match(lines[0], /fate: M from 0\.1 to 0\.3/);
  assert.match(lines[1], /#lin=0\.1,0\.3,4\.5,9/);
  assert.equal(lines[2], "M,alpha,label");
});

onPage("a motion of many samples is drawn with its extremes, beside its fate", "#pin=0.2,5000", async (page) => {
  await page.waitForSelector("#stage svg", READY);
  assert.match(await page.textContent("#verdict"), /Ever lower/);
  const { samples, highest, drawn, top } = await page.evaluate(async () => {
    const motion = await explorer.desk.ask("motion", 0.2, 5000, explorer.state.hops);
    let highest = 0;
    for (let k = 4; k < motion.length; k += 7) highest = Math.max(highest, motion[k]);
    const path = document.querySelector("#stage path[stroke='var(--upper)']").getAttribute("d");
    const heights = path
      .slice(1)
      .split("L")
      .map((point) => Number(point.split(" ")[1]));
    return { samples: (motion.length - 1) / 7, highest, drawn: heights.length, top: Math.min(...heights) };
  });
  assert.ok(samples > 100_000 && drawn > 1000 && drawn <= 2000, `${samples} ${drawn}`);
  // The frame reaches 8 % of the span above the highest sample.
  assert.ok(highest > 1000 && top > 12 && top < 40, `${highest} ${top}`);
});

onPage("beside new numbers stands no old fate", "#pin=0.2,7", async (page) => {
  await page.evaluate(() => {
    document.getElementById("circle").open = true;
    document.getElementById("orbit").open = true;
  });
  await page.waitForSelector("#circle svg", READY);
  await hold(page, "desk", "pinned");
  await page.evaluate(() => explorer.change({ pin: { m: 0.3, alpha: 8 } }));
  await page.waitForFunction(() => document.getElementById("fate").textContent === "Computing …");
  assert.deepEqual([await page.inputValue("#pin-m"), await page.inputValue("#pin-alpha")], ["0.3", "8"]);
  for (const part of ["#stage svg", "#map svg", "#orbit table", "#circle svg"])
    assert.equal(await page.$(part), null, part);
  // The answer about a point is not shown when another is pinned before it comes.
  await page.evaluate(() => {
    window.seen = [];
    explorer.plane.canvas.addEventListener("panels", ({ detail }) => seen.push(detail.alpha));
    explorer.change({ pin: { m: 0.4, alpha: 4.55 } });
  });
  await page.waitForFunction(() => document.getElementById("pin-m").value === "0.4");
  await page.evaluate(() => answer());
  await page.waitForSelector("#map svg", READY);
  assert.deepEqual(await page.evaluate(() => seen), [4.55]);
  await page.waitForSelector("#circle svg", READY);
});

/** What a page says that cannot start. */
async function refusal(address, { init, missing, javaScriptEnabled = true }) {
  const context = await browser().newContext({ javaScriptEnabled, serviceWorkers: "block" });
  const page = await context.newPage();
  if (init) await page.addInitScript(init);
  if (missing) await context.route(`**/${missing}`, (route) => route.fulfill({ status: 404 }));
  await page.goto(address);
  for (let k = 0; k < 100 && (await said(page)).startsWith("Loading"); k++) await page.waitForTimeout(100);
  const text = await said(page);
  await context.close();
  return text;
}
const oneFile = String(pathToFileURL(process.env.EXPLORER_FILE));
const folder = String(pathToFileURL(join(process.env.EXPLORER_SITE, "index.html")));
for (const [name, address, how, sentence] of [
  ["WebAssembly", url, { init: "delete window.WebAssembly" }, /cannot start: .*WebAssembly/],
  ["WebAssembly, as one file", oneFile, { init: "delete window.WebAssembly" }, /cannot start: .*WebAssembly/],
  ["JavaScript", url, { javaScriptEnabled: false }, /needs JavaScript/],
  ["a server", folder, {}, /cannot start: .*cannot be loaded.*explorer\.html/],
  ["core.wasm", url, { missing: "core.wasm" }, /core cannot be loaded/],
  ["main.js", url, { missing: "main.js" }, /cannot start: .*main\.js.*cannot be loaded/],
  ["tiles.js", url, { missing: "tiles.js" }, /cannot start: .*cannot be loaded/],
]) {
  test(`without ${name} the page says what it needs`, { timeout: 60_000 }, async () => {
    assert.match(await refusal(address, how), sentence);
  });
}

test(
  "without the script of its workers the picture is red, and no worker starts for ever",
  { timeout: 60_000 },
  async () => {
    const context = await browser().newContext({ serviceWorkers: "block" });
    let asked = 0;
    await context.route("**/worker.js", (route) => {
      asked += 1;
      return route.fulfill({ status: 404 });
    });
    const page = await context.newPage();
    await page.goto(url);
    await progressIs(page, /^0 of (\d+) parts; red: \1 failed$/);
    assert.match(await said(page), /worker\.js cannot be loaded/);
    const before = asked;
    await page.waitForTimeout(1000);
    assert.equal(asked, before);
    await context.close();
  },
);

onPage("it works offline", "", async (page) => {
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(async () => (await (await caches.open("hopper-explorer")).keys()).length > 20);
  await page.context().setOffline(true);
  await page.reload();
  await settled(page);
  await page.keyboard.press("Enter");
  await page.waitForSelector("#verdict .swatch");
});

onPage("a resized window has its picture", "", async (page) => {
  for (const size of [
    { width: 390, height: 844 },
    { width: 1600, height: 900 },
  ]) {
    await page.setViewportSize(size);
    await page.waitForFunction(
      () => explorer.plane.canvas.width === Math.round(explorer.plane.size.width * devicePixelRatio),
    );
    await settled(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= size.width, `the page is ${wide} wide in a window of ${size.width}`);
  }
});

onPage("a worker that dies is replaced", "", async (page) => {
  await page.evaluate(() => {
    // A job of no kind is an error that is no refusal: the worker closes itself.
    explorer.pool.ask("none").catch((error) => {
      window.failed = error.message;
    });
  });
  await page.waitForFunction(() => window.failed !== undefined);
  await complete(page, { view: { logarithmic: false, x: [0.3, 0.5], alpha: [5, 6] } });
  // One that is killed without a word.
  await page.evaluate(() => explorer.pool.members.forEach(({ worker }) => worker.terminate()));
  await complete(page, { view: { logarithmic: false, x: [0.6, 0.7], alpha: [5, 6] } });
});

onPage(
  "reduced motion and the dark page",
  "",
  async (page) => {
    const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.notEqual(paper, "rgb(255, 255, 255)");
  },
  { colorScheme: "dark", reducedMotion: "reduce" },
);

/** Sizes of a phone, a laptop and a large screen. */
const SCREENS = [
  { width: 360, height: 740 },
  { width: 1366, height: 768 },
  { width: 3840, height: 2160 },
];
for (const viewport of SCREENS) {
  onPage(
    `the parts of the page have room on ${viewport.width} × ${viewport.height}`,
    "#pin=0.2,7",
    async (page) => {
      await page.waitForSelector("#map table");
      const wrong = await page.evaluate(() => {
        const found = [];
        const wide = document.documentElement.scrollWidth;
        if (wide > innerWidth) found.push(`the page is ${wide} wide`);
        const boxes = (selector) =>
          [...document.querySelectorAll(selector)].map((part) => [part, part.getBoundingClientRect()]);
        const name = (part) => part.id || part.textContent.trim().slice(0, 20) || part.tagName;
        const apart = (all) =>
          all.forEach(([one, a], k) =>
            all.slice(k + 1).forEach(([other, b]) => {
              const [across, down] = [
                Math.min(a.right, b.right) - Math.max(a.left, b.left),
                Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top),
              ];
              if (across > 1 && down > 1) found.push(`${name(one)} lies on ${name(other)}`);
            }),
          );
        apart(boxes("h1, header label, header button"));
        apart(boxes("header, #legend, #view, #say, aside"));
        apart(boxes("aside > section, aside > details"));
        apart(boxes("#motion button, #motion label, #time, #now, #stage"));
        for (const [part, { left, right, width }] of boxes(
          "header *, #legend *, #say, aside button, aside input, aside select, aside svg, aside p",
        )) {
          if (width > 0 && (left < -1 || right > innerWidth + 1))
            found.push(`${name(part)} goes from ${left} to ${right}`);
        }
        for (const [part] of boxes("button, #legend > span, #say, aside p, summary")) {
          if (part.scrollWidth > part.clientWidth + 1 && part.clientWidth > 0) found.push(`${name(part)} is cut off`);
        }
        const { width, height } = document.getElementById("canvas").getBoundingClientRect();
        if (width < 0.6 * Math.min(innerWidth, innerHeight) || height < 250)
          found.push(`the picture has ${width} × ${height}`);
        const table = document.querySelector("#map .wide");
        if (innerWidth > 800 && table.scrollWidth > table.clientWidth) found.push("the table of the map is cut off");
        return found;
      });
      assert.deepEqual(wrong, []);
    },
    { viewport },
  );
}

onPage("a screen reader finds names, roles and what is said", "#pin=0.2,7", async (page) => {
  await page.waitForSelector("#map svg");
  const client = await page.context().newCDPSession(page);
  const tree = async () => {
    const { nodes } = await client.send("Accessibility.getFullAXTree");
    return nodes
      .filter(({ ignored }) => !ignored)
      .map(({ role, name, properties = [] }) => ({
        role: role?.value,
        name: name?.value ?? "",
        ...Object.fromEntries(properties.map(({ name, value }) => [name, value.value])),
      }));
  };
  const nodes = await tree();
  const nameless = nodes.filter(({ role, name, focusable }) => focusable && name === "" && role !== "RootWebArea");
  assert.deepEqual(nameless, []);
  const has = (role, pattern) =>
    assert.ok(
      nodes.some((node) => node.role === role && pattern.test(node.name)),
      `${role} ${pattern}`,
    );
  has("RootWebArea", /Hopper explorer/);
  has("application", /Basins of attraction.*Arrow keys/);
  has("heading", /The hopper hops/);
  has("combobox", /Show/);
  has("checkbox", /log M/);
  has("textbox", /^mass ratio M$/);
  has("textbox", /^lift-off speed α$/);
  has("slider", /Time/);
  for (const name of ["Home", "Nearest edge", "Tour", "Places", "Link", "Save", "Help", "Play", "One frame back", "One frame on"])
    has("button", new RegExp(`^${name}$`));
  has("image", /Heights of both masses over 6 hops/);
  has("image", /The map at M = 0.2 with the orbit from 7: decaying/);
  has("main", /^/);
  has("complementary", /The pinned point/);
  assert.ok(nodes.some(({ role, live }) => role === "status" && live === "polite"));
  await page.keyboard.press("?");
  await page.waitForFunction(() => document.getElementById("dialog").open);
  const dialog = (await tree()).find(({ role }) => role === "dialog");
  assert.match(dialog.name, /Keys and gestures/);
  assert.equal(dialog.modal, true);
});

/** The lines of a snippet as they run. */
const commands = (text) => text.split("\n").map((line) => line.split(" "));

onPage("the same on the command line and in Rust", "#pin=0.2,7", async (page) => {
  const shown = await page.evaluate(() => explorer.same().then(({ snippets }) => snippets()));
  const example = readFileSync(new URL("../../examples/same.rs", import.meta.url), "utf8");
  const body = example.split(/fn main.*\n/)[1].split("    Ok(())")[0];
  assert.equal(body.replace(/^ {4}/gm, "").trim(), shown.Rust);
  const folder = mkdtempSync(join(tmpdir(), "explorer-"));
  const run = (line) => execFileSync(process.env.EXPLORER_HOPPER, line.slice(1), { cwd: folder, encoding: "utf8" });
  const [orbit, basins] = commands(shown["Command line"]);
  assert.deepEqual([orbit[0], basins[0]], ["hopper", "hopper"]);
  // A table shows the digits that are certain, CSV shows all.
  const table = run([...orbit, "--csv"]);
  for (const speed of native.points[0].speeds.slice(0, 7))
    assert.ok(table.includes(String(speed)), `${speed}\n${table}`);
  assert.match(readFileSync(join(folder, "motion.csv"), "utf8"), /^time,hop,phase/);
  run([...basins, "--pixels", "16", "16"]);
  assert.ok(existsSync(join(folder, "basins", "basin.png")));
  // In the deep view the picture is a zoom; two of its frames show that the call is right.
  await page.evaluate(() => explorer.deep.open(0.12, 11.920553918335775, 8));
  const [, zoom] = commands((await page.evaluate(() => explorer.same().then(({ snippets }) => snippets())))["Command line"]);
  await page.evaluate(() => explorer.change({ depth: null }));
  zoom[zoom.indexOf("--frames") + 1] = "2";
  run([...zoom, "--pixels", "16", "16"]);
  assert.ok(existsSync(join(folder, "zoom", "zoom_0000.png")));
  rmSync(folder, { recursive: true });
});

test("one file works without a server", { timeout: 180_000 }, async () => {
  const context = await browser().newContext({ offline: true });
  context.setDefaultTimeout(READY.timeout);
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  await page.goto(`${pathToFileURL(process.env.EXPLORER_FILE)}#layer=label&pin=0.2,7`);
  await page.waitForFunction(ready);
  await page.waitForSelector("#map svg");
  assert.ok((await page.textContent("#verdict")).toLowerCase().includes(native.points[0].fate.plain));
  await page.keyboard.press("c");
  assert.match(await page.inputValue("#dialog .link"), /^file:.*explorer\.html#lin=0,1,.*&pin=0\.2,7/);
  assert.deepEqual(problems, []);
  await context.close();
});

test("it is found under its address", async () => {
  assert.equal((await fetch(url)).status, 200);
});
