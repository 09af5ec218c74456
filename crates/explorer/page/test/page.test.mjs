// The page in a browser, computed by WebAssembly; see browser.mjs.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import * as tools from "./browser.mjs";

const { address } = tools;
const asked = [];
const errors = [];
let browser, page;

const open = (hash = "") => tools.open(page, hash);
const whole = () => tools.whole(page);
const state = () => page.evaluate(() => window.squealmap.state());
const status = () => page.$eval("#status", (element) => element.textContent);

before(async () => {
  browser = await tools.launch();
  page = await browser.newPage();
  page.on("request", (request) => asked.push(request.url()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
  await open();
});
after(() => browser?.close());

test("the labels of the page are those of the program", async () => {
  const { rows, differ } = await tools.labels(page);
  assert.ok(rows > 8000, `${rows}`);
  assert.equal(differ, 0, `${differ} of ${rows} labels differ`);
});

test("wheel, drag and keys move the view, and the address holds it", async () => {
  await open();
  const start = await state();
  const box = await (await page.$("#map")).boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(...middle);
  await page.mouse.wheel({ deltaY: -100 });
  const zoomed = await state();
  assert.ok(zoomed.rangeX[1] - zoomed.rangeX[0] < 0.8 * (start.rangeX[1] - start.rangeX[0]));
  await page.mouse.down();
  await page.mouse.move(middle[0] + 40, middle[1], { steps: 5 });
  await page.mouse.up();
  const panned = await state();
  assert.ok(panned.rangeX[0] < zoomed.rangeX[0] && panned.cell === null);
  await page.focus("#map");
  await page.keyboard.press("ArrowUp");
  assert.ok((await state()).rangeY[0] > panned.rangeY[0]);
  await whole();
  const hash = await page.evaluate(() => location.hash);
  const before = await state();
  await open(hash);
  assert.deepEqual(await state(), before);
});

test("a click looks into a cell, and its numbers are those of the map", async () => {
  await open();
  const box = await (await page.$("#map")).boundingBox();
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 0.2 * box.height);
  await page.waitForFunction(() => !document.getElementById("cell").hidden, { timeout: 240000, polling: 50 });
  const table = await page.$$eval("#numbers tr", (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  const value = (name) => table.find(([key]) => key === name)?.[1];
  assert.equal(value("status"), "ok");
  const here = await state();
  const type = await page.evaluate(async () => {
    const { view } = window.squealmap;
    return view.column("type").names[view.value(0.3, 0.8)];
  });
  assert.equal(value("type"), type.replaceAll("_", " "));
  assert.ok(Math.abs(here.cell[0] - 0.18) < 0.01 && Math.abs(here.cell[1] - 0.48) < 0.01, `${here.cell}`);
  assert.ok((await page.$$("#plots svg")).length >= 5);
  assert.match(await page.$eval("#why", (element) => element.textContent), /Hz/);
  await page.waitForFunction(() => document.querySelectorAll("#cuts svg").length === 2, { timeout: 60000, polling: 50 });
});

test("the gallery's places are what it says of them", async () => {
  await open();
  const found = await page.evaluate(async () => {
    const { engines, about, places } = window.squealmap;
    const names = (name) => about.columns.find((column) => column.name === name).names;
    const one = async ({ mu_d, mu_s, at, type, regime, title }) => {
      const side = (key, value) => ({ key, from: value, to: value, points: 1 });
      const { numbers } = await engines.ask({ ask: "region", x: side("mu_d", mu_d), y: side("mu_s", mu_s), at, response: true, columns: ["type", "regime"] });
      return { title, wanted: [type, regime], found: [names("type")[numbers[0]], names("regime")[numbers[1]]] };
    };
    return Promise.all(places.map(one));
  });
  assert.equal(found.length, 10);
  for (const { title, wanted, found: is } of found) assert.deepEqual(is, wanted, title);
  const links = await page.$$eval("#places a", (links) => links.map((link) => link.getAttribute("href")));
  assert.equal(links.length, 10);
  await open(links[9]);
  assert.deepEqual((await state()).cell, [0.6, 0.2]);
  assert.equal(await page.$eval("#wrong", (element) => element.textContent), "");
});

test("a slider changes the map, and a class is hidden", async () => {
  await open();
  const picture = () => page.evaluate(() => Array.from(window.squealmap.view.finest().values).reduce((a, b, k) => (a * 31 + b * (k % 97)) % 1e9, 0));
  const before = await picture();
  await page.$eval("#slider-belt_velocity", (slider) => {
    slider.value = "0";
    slider.dispatchEvent(new Event("input"));
  });
  await whole();
  assert.notEqual(await picture(), before);
  await page.click("#legend button");
  assert.equal((await state()).hidden.length, 1);
  const wrong = await page.evaluate(() => {
    const number = document.querySelector("#sliders input[type=number]");
    number.value = "-5";
    number.dispatchEvent(new Event("change"));
    return document.getElementById("status").textContent;
  });
  assert.match(wrong, /`belt_velocity` is -5, and has to be/);
});

test("frames stay short while transients are computed, and a move drops what is no more wanted", async () => {
  await open();
  await page.select("#quantity", "regime");
  const longest = await page.evaluate(
    () =>
      new Promise((resolve) => {
        let [last, most, from] = [performance.now(), 0, performance.now()];
        const frame = (now) => {
          most = Math.max(most, now - last);
          last = now;
          if (now - from > 3000) resolve(most);
          else requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
      }),
  );
  console.log(`longest frame while transients are computed: ${longest.toFixed(0)} ms`);
  await page.select("#quantity", "type");
  await whole();
  assert.equal(await page.evaluate(() => window.squealmap.engines.open() < 4), true);
});

test("200 zooms leave no memory behind", async () => {
  await open();
  const size = async () => (await page.metrics()).JSHeapUsedSize / 1e6;
  const before = await size();
  await page.evaluate(async () => {
    const { page } = window.squealmap;
    for (let k = 0; k < 200; k++) {
      page.zoom(k % 2 ? 1.25 : 0.8, [0.5, 0.5]);
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
  });
  await whole();
  const grown = (await size()) - before;
  console.log(`memory after 200 zooms: ${grown.toFixed(1)} MB more`);
  assert.ok(grown < 100, `${grown} MB`);
});

test("wrong addresses are told, and the page works", async () => {
  await open("#x=nothing&rx=5,2&show=depth&at.theta=9&cell=a");
  const told = await page.$eval("#wrong", (element) => element.textContent);
  for (const part of ["`x=nothing`", "`depth`", "`theta` is 9, and has to be", "`cell=a`"]) assert.ok(told.includes(part), `${part}: ${told}`);
  assert.match(await status(), /cells/);
  assert.equal((await state()).quantity, "type");
});

test("the page fits a phone, in both schemes", async () => {
  await page.setViewport({ width: 390, height: 844 });
  for (const value of ["light", "dark"]) {
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
    await open();
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, value);
  }
  await page.setViewport({ width: 1280, height: 900 });
});

test("nothing is asked of anywhere, and nothing goes wrong unseen", () => {
  const elsewhere = asked.filter((url) => !url.startsWith(address) && !url.startsWith("blob:") && !url.startsWith("data:") && url !== "about:blank");
  assert.deepEqual(elsewhere, []);
  assert.deepEqual(errors, []);
});
