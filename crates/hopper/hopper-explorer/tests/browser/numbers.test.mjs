// Layers of numbers, points that are compared, the column of one M, edges of grounding, large pictures.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { READY, pages, settled } from "./browser.mjs";

const { onPage } = pages();
const said = (page, words) => page.waitForFunction((words) => document.getElementById("say").textContent.includes(words), words, READY);

onPage("layers of numbers have a bar, and say the number under the cursor", "#layer=phase&lin=0.02,0.2,4.4,8", async (page) => {
  const keys = await page.evaluate(() => [...document.getElementById("layer").options].map(({ textContent }) => textContent));
  for (const name of ["phase Ψ", "energy lost", "sudden lift-offs", "time of flight", "sensitivity |∂α′/∂α|"]) assert.ok(keys.includes(name), keys.join());
  assert.match(await page.textContent("#legend"), /fraction of the phase Ψ\s*00\.51\s*no number/);
  await page.hover("#canvas", { position: { x: 300, y: 300 } });
  await said(page, "fraction of the phase Ψ: 0.");
  // A point and its image have one phase.
  const phases = await page.evaluate(async () => {
    const layer = Number(document.getElementById("layer").value);
    const { speeds } = await explorer.desk.ask("point", 0.08, 6, 3);
    const about = (x) => [x * (1 - 1e-12), x * (1 + 1e-12)];
    const one = async (alpha) => {
      const job = { layer, logarithmic: false, x: about(0.08), alpha: about(alpha), columns: 1, rows: 1, values: true, strip: 1 };
      return new Float32Array((await explorer.desk.ask("tile", job)).values.buffer)[0];
    };
    return [await one(speeds[0]), await one(speeds[1])];
  });
  assert.ok(Math.abs(phases[0] - phases[1]) < 1e-6 && phases[0] > 0, phases.join());
});

onPage("a table of real numbers has them, and none where there is none", "#layer=energy&lin=0.5,1,4.6,7", async (page) => {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.click("#save").then(() => page.click('[data-file]:text-is("CSV")')),
  ]);
  const lines = (await readFile(await download.path(), "utf8")).trim().split("\n");
  assert.equal(lines[2], "M,alpha,loss");
  const numbers = lines.slice(3).map((line) => Number(line.split(",")[2]));
  assert.ok(numbers.some(Number.isNaN) && numbers.filter((x) => !Number.isNaN(x)).every((x) => x > 0 && x <= 1));
});

onPage("two points are compared, and the address keeps both", "#pin=0.08,6", async (page) => {
  await page.click("#compare summary");
  await page.click("#compare button:text('Keep')");
  await page.evaluate(() => explorer.change({ pin: { m: 0.5, alpha: 7 } }));
  await page.waitForFunction(() => document.querySelectorAll("#compare td").length > 10, null, READY);
  await page.waitForFunction(() => document.querySelector("#compare tbody tr td:nth-child(3)").textContent === "0.5", null, READY);
  const rows = await page.$$eval("#compare tr", (all) => all.map((row) => [...row.cells].map(({ textContent }) => textContent)));
  assert.deepEqual(rows[1], ["M", "0.08", "0.5"]);
  assert.match(rows[3].join(), /fate,hops for ever, height 1,/);
  await page.waitForFunction(() => location.hash.includes("with=0.08,6"), null, READY);
  await page.click("#compare button:text('Forget')");
  await page.waitForFunction(() => !location.hash.includes("with="), null, READY);
});

onPage("beside the picture is the column of the pinned M", "#pin=0.3,6&lin=0.1,0.5,4,9", async (page) => {
  await page.waitForFunction(() => explorer.plane.column.shown?.m === 0.3, null, READY);
  const same = await page.evaluate(async () => {
    const { bitmap, alpha } = explorer.plane.column.shown;
    const context = new OffscreenCanvas(1, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const row = Math.floor(bitmap.height / 2);
    const [red, green, blue] = context.getImageData(0, row, 1, 1).data;
    const speed = alpha[1] - ((row + 0.5) / bitmap.height) * (alpha[1] - alpha[0]);
    const { fate } = await explorer.desk.ask("point", 0.3, speed, 1);
    return [fate.color, `#${[red, green, blue].map((byte) => byte.toString(16).padStart(2, "0")).join("")}`];
  });
  assert.equal(same[0], same[1]);
});

onPage("an edge of grounding says that nothing changes with the depth", "", async (page) => {
  await page.evaluate(() => explorer.deep.open(0.5, 9, 30));
  await said(page, "an edge of grounding");
  const text = await page.textContent("#say");
  assert.match(text, /same at every depth: below p .* α′ = √\(8\.313 \|α − p\|\).* 2\.9·10⁻¹⁵ at the lower end/);
  await page.hover("#canvas", { position: { x: 300, y: 60 } });
  await said(page, "comes to rest");
  await page.hover("#canvas", { position: { x: 300, y: 500 } });
  await said(page, "ever lower");
});

onPage("the deep view moves along its edge and across it, with the pixels of the screen", "#depth=0.12,11.920553918335775,30", async (page) => {
  await page.waitForFunction(() => explorer.deep.frames.some(({ pixels }) => pixels > 256), null, READY);
  const widest = await page.evaluate(() => Math.max(...explorer.deep.frames.map(({ bitmap }) => bitmap.width)));
  assert.ok(widest >= (await page.evaluate(() => Math.max(explorer.plane.box.width, explorer.plane.box.height))) - 1, widest);
  await page.focus("#canvas");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowRight");
  const shift = await page.evaluate(() => explorer.state.depth.shift);
  assert.ok(Math.abs(shift[0] + 0.2) < 1e-12 && Math.abs(shift[1] + 0.2) < 1e-12, shift.join());
  await page.waitForFunction(() => explorer.deep.frames.some(({ depth }) => depth < 30), null, READY);
  await page.hover("#canvas", { position: { x: 300, y: 60 } });
  await said(page, "hops for ever, height 2");
});

onPage("a large picture has the pixels that it says", "#layer=fate&lin=0.1,0.5,4,9", async (page) => {
  const [download] = await Promise.all([
    page.waitForEvent("download", READY),
    page.click("#save").then(() => page.click('[data-file]:text-is("a large PNG")')),
  ]);
  const bytes = await readFile(await download.path());
  assert.equal(bytes.readUInt32BE(16), 4000);
  await settled(page);
});

const shown = (page, words) => page.waitForFunction((words) => document.getElementById("other-say").textContent.includes(words), words, READY);

onPage("other systems are computed in the page when they are asked for", "", async (page) => {
  const asked = [];
  page.on("request", (request) => asked.push(request.url().split("/").at(-1)));
  await page.click("#others");
  await page.waitForSelector("#other-canvas");
  assert.ok(asked.includes("systems.wasm") && asked.includes("others.js"), asked.join());
  const complete = () => page.waitForFunction(() => / to .*, .* to /.test(document.getElementById("other-say").textContent), null, READY);
  await complete();
  const colours = () =>
    page.evaluate(() => {
      const canvas = document.getElementById("other-canvas");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const found = new Set();
      for (let k = 0; k < data.length; k += 4) found.add(data[k + 3] === 255 ? (data[k] > data[k + 2] ? "warm" : "cold") : "empty");
      return [...found].sort();
    });
  assert.deepEqual(await colours(), ["cold", "warm"]);
  await page.focus("#other-canvas");
  await page.keyboard.press("+");
  await shown(page, "−2.51327 to 2.51327, −8 to 8");
  await page.selectOption("#other", "1");
  await shown(page, " parts");
  assert.match(await page.textContent("#other-legend"), /magnet on the right.*upper.*lower/);
});

onPage("a zoom is saved as a video, with its progress, and the view comes back", "#layer=fate&lin=0.1,0.11,7,7.2", async (page) => {
  const before = await page.evaluate(() => JSON.stringify(explorer.state.view));
  const [download] = await Promise.all([
    page.waitForEvent("download", { timeout: 120_000 }),
    page
      .click("#save")
      .then(() => page.click('[data-file]:text-is("a zoom as video")'))
      .then(() => page.waitForFunction(() => /Frame \d+ of/.test(document.getElementById("saved").textContent), null, READY)),
  ]);
  const bytes = await readFile(await download.path());
  // The head of a Matroska file.
  assert.equal(bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
  assert.ok(bytes.length > 50_000, String(bytes.length));
  assert.equal(await page.evaluate(() => JSON.stringify(explorer.state.view)), before);
});
