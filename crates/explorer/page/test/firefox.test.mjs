// The page in Firefox, which has no WebGPU here: FIREFOX is the browser; see browser.mjs.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { endServers, labels, launchFirefox, open, serve, whole } from "./browser.mjs";

let browser, page;
const errors = [];
const state = () => page.evaluate(() => window.squealmap.state());

before(async () => {
  browser = await launchFirefox();
  page = await browser.newPage();
  page.on("pageerror", (error) => errors.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
  await open(page);
});
after(async () => {
  await browser?.close();
  endServers();
});

test("the labels in Firefox are those of the program, without a GPU", async () => {
  const { rows, differ } = await labels(page);
  assert.ok(rows > 8000, `${rows}`);
  assert.equal(differ, 0, `${differ} of ${rows} labels differ`);
  await page.waitForFunction(() => window.squealmap.engines.noDevice !== "", { timeout: 60000, polling: 50 });
  assert.match(await page.$eval("#engine", (list) => list.title), /no GPU/);
});

test("wheel, keys, a click, a slider and a filter in Firefox", async () => {
  await open(page);
  const start = await state();
  const box = await (await page.$("#map")).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.wheel({ deltaY: -100 });
  const zoomed = await state();
  assert.ok(zoomed.rangeX[1] - zoomed.rangeX[0] < 0.95 * (start.rangeX[1] - start.rangeX[0]));
  await page.focus("#map");
  await page.keyboard.press("ArrowUp");
  assert.ok((await state()).rangeY[0] > zoomed.rangeY[0]);
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 0.2 * box.height);
  await page.waitForFunction(() => !document.getElementById("cell").hidden, { timeout: 240000, polling: 50 });
  await page.$eval("#slider-belt_velocity", (slider) => {
    slider.value = "0";
    slider.dispatchEvent(new Event("input"));
  });
  await page.click("#legend button");
  await whole(page);
  const now = await state();
  assert.equal(now.hidden.length, 1);
  assert.ok(now.cell !== null);
  const hash = await page.evaluate(() => location.hash);
  await open(page, hash);
  assert.deepEqual(await state(), now);
});

test("the page served by the program in Firefox", async () => {
  const { address } = await serve(process.env.SWEEP);
  await open(page, "", address);
  assert.equal(await page.$eval("#engine", (list) => list.value), "program");
  const { differ } = await labels(page);
  assert.equal(differ, 0);
});

test("a phone's width fits, and nothing goes wrong unseen", async () => {
  await page.setViewport({ width: 390, height: 844 });
  await open(page);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  assert.deepEqual(errors, []);
});
