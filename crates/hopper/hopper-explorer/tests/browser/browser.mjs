// The headless Chromium of the tests, and pages that are ready.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";

const { chromium } = createRequire(process.env.EXPLORER_MODULES)("playwright-core");
export const url = process.env.EXPLORER_URL;
export const ready = () => window.explorer?.plane.idle === true;
export const READY = { timeout: 60_000 };

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: [
      "--headless",
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });

/** The address with points in place of shares, which take long: where a test does not ask for another layer. */
const withPoints = (hash) => (/layer=|^ $/.test(hash) ? hash.trim() : `${hash}${hash ? "&" : "#"}layer=fate`);

/** A page at an address, with its complete picture; an error of the page fails the test at its end. A hash of a space is a first visit. */
export async function open(browser, hash = "", options = {}) {
  const context = await browser.newContext({
    viewport: { width: 1000, height: 700 },
    acceptDownloads: true,
    // What glides is where it goes at once.
    reducedMotion: "reduce",
    ...options,
  });
  context.setDefaultTimeout(READY.timeout);
  const page = await context.newPage();
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("request", (request) => {
    if (!request.url().startsWith(url) && !/^(data|blob):/.test(request.url()))
      page.problems.push(`loads ${request.url()}`);
  });
  await page.goto(url + withPoints(hash));
  await page.waitForFunction(() => window.explorer !== undefined, null, READY);
  if (hash !== " " && !/depth=\d/.test(hash)) await page.waitForFunction(ready, null, READY);
  return page;
}

/** What tests of a file share: a browser, and `onPage` for a test with its own page, which may have no errors, and loads nothing from elsewhere. */
export function pages() {
  let browser;
  before(async () => {
    browser = await launch();
  });
  after(() => browser.close());
  const onPage = (name, hash, use, options) =>
    test(name, { timeout: 180_000 }, async () => {
      const page = await open(browser, hash, options);
      try {
        await use(page);
        assert.deepEqual(page.problems, []);
      } finally {
        await page.context().close();
      }
    });
  return { onPage, browser: () => browser };
}
export const view = (page) => page.evaluate(() => explorer.state.view);
export const settled = (page) => page.waitForFunction(ready, null, READY);

/** FNV-1a of bytes, as in native_answers.rs; to be called in the page. */
export const DIGEST = `(bytes) => {
  let [high, low] = [0xcbf29ce4, 0x84222325];
  for (const byte of bytes) {
    low = (low ^ byte) >>> 0;
    // Times 0x100000001b3 modulo 2^64.
    const product = low * 0x1b3;
    const carry = Math.floor(product / 2 ** 32);
    high = (Math.imul(high, 0x1b3) + carry + Math.imul(low, 0x100)) >>> 0;
    low = product % 2 ** 32;
  }
  return high.toString(16).padStart(8, "0") + low.toString(16).padStart(8, "0");
}`;
