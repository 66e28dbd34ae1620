// What a first visitor sees, and the ways through the plane: history, places, edges, for every hand and eye.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { DIGEST, READY, open, pages, settled, view } from "./browser.mjs";

const axe = createRequire(process.env.EXPLORER_MODULES).resolve("axe-core");
const { browser, onPage } = pages();
/** A first visit. */
const FIRST = " ";
const time = (page) => page.inputValue("#time").then(Number);
const MOVING = { reducedMotion: "no-preference" };

onPage(
  "a first visitor reads what it is, and sees a hopper that hops for ever",
  FIRST,
  async (page) => {
    assert.match(await page.textContent("#what"), /Two masses, a spring, .* no motor.* Click one/);
    await page.waitForFunction(() => document.getElementById("verdict").textContent.startsWith(" Hops for ever"), null, READY);
    await page.waitForFunction(() => Number(document.getElementById("time").value) > 0.5, null, READY);
    const legend = await page.textContent("#legend");
    for (const words of ["hops for ever, height 1", "ever lower", "comes to rest", "undecided"])
      assert.ok(legend.includes(words), legend);
    // Exact shares, with points until they come.
    assert.equal(await page.inputValue("#layer"), await page.evaluate(() => String(explorer.state.layer)));
    assert.match(await page.evaluate(() => document.getElementById("layer").selectedOptions[0].textContent), /exact/);
    await page.waitForFunction(() => explorer.plane.drawable, null, READY);
  },
  MOVING,
);

onPage("with reduced motion the hopper stands still", FIRST, async (page) => {
  await page.waitForSelector("#stage svg");
  await page.waitForTimeout(400);
  assert.equal(await time(page), 0);
  assert.equal(await page.textContent("#play"), "Play");
});

onPage("the pixels of shares are the same however high the tower is", "#layer=coverage&lin=0.26,0.28,6,9.5", async (page) => {
  await settled(page);
  const layer = await page.evaluate(() => explorer.state.layer);
  const found = await page.evaluate(
    async ([layer, digest]) => {
      const hash = eval(digest);
      const bytes = (bitmap, top) => {
        const context = new OffscreenCanvas(bitmap.width, 256).getContext("2d");
        context.drawImage(bitmap, 0, -top);
        return hash(context.getImageData(0, 0, bitmap.width, 256).data);
      };
      const job = (j) => ({ layer, logarithmic: false, x: [0.25, 0.3125], alpha: [0, 4 * j], columns: 16, rows: 256 * j });
      const [low, high] = await Promise.all([2, 3].map((j) => explorer.pool.ask("tile", job(j))));
      return [bytes(low.bitmap, 0), bytes(high.bitmap, 256)];
    },
    [layer, DIGEST],
  );
  assert.equal(found[0], found[1]);
  // Some of a tile, and the whole of it later.
  const parts = await page.evaluate(() => explorer.plane.parts);
  assert.deepEqual([parts.there, parts.failed], [parts.all, 0]);
});

onPage("views go back and forth", "", async (page) => {
  const first = await view(page);
  const go = async (alpha) => {
    await page.evaluate((alpha) => explorer.change({ view: { ...explorer.state.view, alpha } }), alpha);
    await page.waitForTimeout(1200);
  };
  await page.waitForTimeout(1200);
  await go([8, 9]);
  await go([8.2, 8.4]);
  const is = (alpha) =>
    page.waitForFunction((alpha) => JSON.stringify(explorer.state.view.alpha) === JSON.stringify(alpha), alpha, READY);
  await page.keyboard.press("z");
  await is([8, 9]);
  await page.click("#back-view");
  await is(first.alpha);
  await page.keyboard.press("y");
  await is([8, 9]);
  // A quick series of changes is one entry.
  for (const top of [9.5, 9.6, 9.7]) await page.evaluate((top) => explorer.change({ view: { ...explorer.state.view, alpha: [8, top] } }), top);
  await page.waitForTimeout(1200);
  await page.keyboard.press("z");
  await is([8, 9]);
});

onPage("places are kept by name, shown again, and removed", "#lin=0.1,0.2,7,8", async (page) => {
  await page.keyboard.press("g");
  await page.fill("#place", "my needle");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".places").textContent.includes("my needle"));
  await page.keyboard.press("Escape");
  await page.keyboard.press("h");
  await settled(page);
  await page.keyboard.press("g");
  await page.click("text=my needle");
  await page.waitForFunction(() => explorer.state.view.x[0] === 0.1 && explorer.state.view.alpha[1] === 8);
  await page.keyboard.press("g");
  await page.click("[aria-label='Remove my needle']");
  assert.ok(!(await page.textContent(".places")).includes("my needle"));
  await page.click("text=The crisis");
  await page.waitForFunction(() => explorer.state.pin?.m === 0.1035);
});

for (const [m, alpha] of [
  [0.05, 6],
  [0.2, 2],
  [0.5, 5.2],
  [2, 9],
]) {
  onPage(`the nearest edge is found from M = ${m}, α = ${alpha}`, `#pin=${m},${alpha}`, async (page) => {
    await page.keyboard.press("d");
    await page.waitForFunction(() => explorer.state.depth !== null, null, READY);
    const found = await page.evaluate(() => explorer.state.depth.about);
    assert.equal(found.massRatio, m);
    await page.waitForFunction(() => explorer.deep.frames.some(({ pixels, bitmap }) => pixels === 256 && bitmap), null, READY);
    // Two colours: it is an edge.
    const colors = await page.evaluate(() => {
      const { canvas, context } = explorer.plane;
      const { data } = context.getImageData(canvas.width / 2, 40, 1, canvas.height - 120);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colors > 1);
  });
}

onPage("at a deep edge the phase is written and moves", "#depth=0.12,11.920553918335775,30", async (page) => {
  const phase = async () => {
    await page.waitForFunction(() => /phase \d\.\d\d of the circle: .* lingers/.test(document.getElementById("say").textContent), null, READY);
    return /phase (\d\.\d\d) of the circle: .* for (\S+) hops/.exec(await page.textContent("#say")).slice(1);
  };
  const [first, turns] = await phase();
  assert.match(turns, /^\d\.\d\d·10(⁹|¹⁰)$/);
  await page.evaluate(() => explorer.change({ depth: { ...explorer.state.depth, depth: 30.2 } }));
  await page.waitForFunction((first) => {
    const found = /phase (\d\.\d\d) of/.exec(document.getElementById("say").textContent);
    return found && found[1] !== first;
  }, first, READY);
  await page.evaluate(() => explorer.change({ depth: { ...explorer.state.depth, depth: 100 } }));
  await page.waitForFunction(() => /a phase that is not known: .* for \d\.\d\d·10³/.test(document.getElementById("say").textContent), null, READY);
});

onPage(
  "a double click zooms, a zoom glides, and a plane that is thrown goes on",
  "",
  async (page) => {
    const from = await view(page);
    await page.mouse.dblclick(400, 300);
    await page.waitForFunction((width) => explorer.state.view.x[1] - explorer.state.view.x[0] < 0.45 * width, from.x[1] - from.x[0]);
    await settled(page);
    const frames = await page.evaluate(
      () =>
        new Promise((done) => {
          const widths = [];
          const look = () => {
            widths.push(explorer.state.view.x[1] - explorer.state.view.x[0]);
            if (widths.length < 20) requestAnimationFrame(look);
            else done(new Set(widths).size);
          };
          document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "+", bubbles: true }));
          look();
        }),
    );
    assert.ok(frames > 3, `${frames} widths`);
    await settled(page);
    await page.mouse.move(400, 300);
    await page.mouse.down();
    for (let k = 1; k <= 6; k++) await page.mouse.move(400 - 12 * k, 300);
    const held = await view(page);
    await page.mouse.up();
    await page.waitForFunction((left) => explorer.state.view.x[0] > left, held.x[0]);
  },
  MOVING,
);

onPage("single letters can be switched off", "", async (page) => {
  await page.keyboard.press("?");
  await page.uncheck("#letters");
  await page.keyboard.press("Escape");
  const from = await view(page);
  await page.keyboard.press("l");
  await page.keyboard.press("x");
  assert.deepEqual(await view(page), from);
  await page.keyboard.press("ArrowRight");
  assert.notDeepEqual(await view(page), from);
  await page.keyboard.press("Tab");
  await page.click("#help");
  await page.check("#letters");
  await page.keyboard.press("Escape");
  await page.keyboard.press("l");
  await page.waitForFunction(() => explorer.state.view.logarithmic);
});

onPage("within another page there is the picture alone, and a way to the whole", "#lin=0.1,0.3,8,10&embed", async (page) => {
  assert.ok((await page.isHidden("header")) && (await page.isHidden("aside")) && (await page.isVisible("#legend")));
  await page.hover("#whole");
  assert.match(await page.getAttribute("#whole", "href"), /#lin=0\.1,0\.3,8,10(?!.*embed)/);
  await page.waitForTimeout(400);
  assert.match(page.url(), /&embed/);
});

onPage("a link is ready to be copied, embedded and cited", "#lin=0.1,0.3,8,10", async (page) => {
  await page.keyboard.press("c");
  assert.match(await page.inputValue("#link"), /#lin=0\.1,0\.3,8,10/);
  assert.match(await page.inputValue("#frame"), /^<iframe src="http.*&embed" title=/);
  assert.match(await page.inputValue("#citation"), /Hopper explorer .*http/);
});

onPage("the orbit of the pinned point is drawn in the plane", "#lin=0.05,0.2,4,9&pin=0.1,8", async (page) => {
  await page.waitForSelector("#verdict .swatch");
  const speeds = await page.evaluate(() => explorer.plane.orbit.speeds);
  const { orbit } = await page.evaluate(() => explorer.desk.ask("point", 0.1, 8, 3));
  assert.equal(speeds[1], orbit[1].speed);
  await page.mouse.move(500, 300);
  await page.waitForFunction(() => explorer.plane.hovered?.speeds.length > 1, null, READY);
});

for (const [name, viewport] of [
  ["on a phone", { width: 390, height: 844 }],
  ["at 200 % of a desk", { width: 640, height: 400 }],
]) {
  onPage(
    `${name} the plot keeps half the height and the verdict is in the first screen`,
    "#pin=0.08,6&layer=fate",
    async (page) => {
      await page.waitForSelector("#verdict .swatch");
      const [plot, verdict] = await page.evaluate(() =>
        ["canvas", "verdict"].map((id) => document.getElementById(id).getBoundingClientRect().toJSON()),
      );
      assert.ok(plot.height >= viewport.height / 2, `${plot.height} of ${viewport.height}`);
      assert.ok(verdict.bottom <= viewport.height, `${verdict.bottom} of ${viewport.height}`);
    },
    { viewport },
  );
}

onPage("what is touched is 24 pixels large", "#pin=0.08,6", async (page) => {
  await page.waitForSelector("#stage svg");
  const small = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, summary, input")]
      .map((element) => [element.id || element.textContent, (element.closest("label") ?? element).getBoundingClientRect()])
      .filter(([, { width, height }]) => height > 0 && (height < 23.9 || width < 23.9))
      .map(([name, { width, height }]) => `${name}: ${width} × ${height}`),
  );
  assert.deepEqual(small, []);
});

for (const options of [{}, { colorScheme: "dark" }]) {
  onPage(
    `axe finds nothing with all panels open (${options.colorScheme ?? "light"})`,
    "#pin=0.12,7.72&with=0.08,6",
    async (page) => {
      await page.addScriptTag({ path: axe });
      const check = async (name) => {
        const found = await page.evaluate(() =>
          axe.run().then(({ violations }) => violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 90))}`)),
        );
        assert.deepEqual(found, [], name);
      };
      await page.waitForSelector("#stage svg");
      for (const id of ["orbit", "circle", "intervals", "same"]) await page.click(`#${id} summary`);
      await page.waitForSelector("#circle svg", READY);
      await page.waitForSelector("#compare table", READY);
      await page.keyboard.press("t");
      await page.waitForSelector("#stop h2");
      await check("panels");
      await page.keyboard.press("Escape");
      for (const id of ["others", "places", "save", "share", "help"]) {
        await page.click(`#${id}`);
        await page.waitForSelector("#dialog[open]", READY);
        await check(id);
        await page.keyboard.press("Escape");
        await page.waitForSelector("#dialog:not([open])", { state: "attached" });
      }
    },
    options,
  );
}

onPage(
  "forced colours keep the colours of the fates",
  "#pin=0.08,6",
  async (page) => {
    await page.waitForSelector("#legend .swatch");
    const [swatch, color] = await page.evaluate(() => {
      const [first] = document.querySelectorAll("#legend .swatch");
      return [getComputedStyle(first).backgroundColor, first.style.background];
    });
    assert.equal(swatch, color);
  },
  { forcedColors: "active" },
);

onPage(
  "in the dark large light areas are dimmed",
  "#lin=0.2,0.201,2,2.01",
  async (page) => {
    const middle = await page.evaluate(() => {
      const { canvas, context } = explorer.plane;
      return [...context.getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data].slice(0, 3);
    });
    assert.ok(middle.every((part) => part > 150 && part < 200), `${middle}`);
  },
  { colorScheme: "dark" },
);

onPage("a link of a view and a point that a hand has chosen is short, and gives them back", "", async (page) => {
  await page.mouse.move(420, 310);
  for (let k = 0; k < 4; k++) await page.mouse.wheel(0, -240);
  await page.mouse.click(433, 287);
  await page.waitForFunction(() => location.hash.includes("pin="), null, READY);
  const hash = new URL(page.url()).hash.replace("&layer=label", "");
  assert.ok(hash.length < 80, hash);
  const other = await open(browser(), hash);
  const [one, two] = await Promise.all([page, other].map((own) => own.evaluate(() => JSON.stringify([explorer.state.view, explorer.state.pin]))));
  assert.equal(one, two);
  await other.context().close();
});

onPage("within another page the wheel scrolls that page until the picture is clicked", "#embed", async (page) => {
  const view = () => page.evaluate(() => JSON.stringify(explorer.state.view));
  const before = await view();
  await page.mouse.move(420, 310);
  await page.mouse.wheel(0, -240);
  await page.waitForTimeout(100);
  assert.equal(await view(), before);
  await page.mouse.click(420, 310);
  await page.mouse.wheel(0, -240);
  await page.waitForFunction((before) => JSON.stringify(explorer.state.view) !== before, before);
});

onPage(
  "in the dark each fate has one colour, also where pictures lie over each other",
  "#lin=0.2,0.5,5,7",
  async (page) => {
    const found = await page.evaluate(() => {
      const { canvas, context, legend } = explorer.plane;
      const rgb = (color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
      const probe = document.createElement("canvas").getContext("2d");
      probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--paper");
      const paper = rgb(probe.fillStyle);
      const wanted = legend.fates.map(({ color }) => rgb(color).map((part, k) => 0.7 * part + 0.3 * paper[k]));
      const ratio = devicePixelRatio;
      const { left, top } = explorer.plane.corner;
      const { width, height } = explorer.plane.box;
      const { data } = context.getImageData((left + 20) * ratio, (top + 20) * ratio, (width - 40) * ratio, (height - 40) * ratio);
      let other = 0;
      for (let at = 0; at < data.length; at += 4)
        if (!wanted.some((color) => color.every((part, k) => Math.abs(part - data[at + k]) <= 2))) other += 1;
      return other / (data.length / 4);
    });
    // Rings of an orbit, and edges between fates where a tile is scaled.
    assert.ok(found < 0.05, `${found} of the pixels have another colour`);
  },
  { colorScheme: "dark" },
);

onPage("a point is pinned where it is clicked on the logarithmic axis, too", "#log=-6,0,4.4,8", async (page) => {
  await page.mouse.click(420, 310);
  await page.waitForFunction(() => explorer.state.pin !== null);
  const [pin, there] = await page.evaluate(() => {
    const { view, pin } = explorer.state;
    const { left } = explorer.plane.corner;
    const { left: from } = explorer.plane.canvas.getBoundingClientRect();
    const part = (420 - from - left) / explorer.plane.box.width;
    return [pin.m, 2 ** (view.x[0] + part * (view.x[1] - view.x[0]))];
  });
  assert.ok(Math.abs(pin / there - 1) < 1e-3, `${pin} ${there}`);
});
