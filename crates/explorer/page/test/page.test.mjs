// The page in a browser, computed by WebAssembly; see browser.mjs.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
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

test("two maps of one place have one pointer, and lines are where their values are", async () => {
  await open("#x=mu_d&y=mu_s&show=type&beside=growth_rate&lines=1&at.belt_velocity=3");
  await page.waitForFunction(() => Number.isFinite(window.squealmap.beside.times.last), { timeout: 240000, polling: 50 });
  const box = await (await page.$("#map-beside")).boundingBox();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.5 * box.height);
  const readout = await page.$eval("#readout", (element) => element.textContent);
  const [, type, growth] = readout.match(/: type = ([a-z ]+), growth_rate = (-?[0-9.]+) 1\/s$/) ?? [];
  const found = await page.evaluate(async () => {
    const { engines, state } = window.squealmap;
    const [x, y] = [state().rangeX, state().rangeY].map(([low, high], k) => low + [0.4, 0.5][k] * (high - low));
    const side = (key, value) => ({ key, from: value, to: value, points: 1 });
    const { numbers } = await engines.ask({ ask: "region", x: side("mu_d", x), y: side("mu_s", y), at: state().at, response: false, columns: ["growth_rate"] });
    return numbers[0];
  });
  assert.equal(type, "coexistence", readout);
  assert.ok(Math.abs(growth / found - 1) < 0.01, `${growth}, ${found}`);
  // Both have the pointer: a dark column where it is, and none where it is not.
  const dark = (id, at) =>
    page.$eval(
      id,
      (canvas, at) => {
        const { data } = canvas.getContext("2d").getImageData(Math.round(at * canvas.width) - 2, 0, 5, canvas.height);
        const rows = Array.from({ length: canvas.height }, (_, row) => Math.max(...[0, 1, 2, 3, 4].map((k) => (data[4 * (5 * row + k)] < 90 ? data[4 * (5 * row + k) + 3] : 0))));
        return rows.filter((alpha) => alpha > 120).length / canvas.height;
      },
      at,
    );
  for (const id of ["#marks", "#marks-beside"]) {
    assert.ok((await dark(id, 0.4)) > 0.9, id);
    assert.ok((await dark(id, 0.9)) < 0.3, id);
  }
  // Zooming one zooms both.
  await page.mouse.wheel({ deltaY: -100 });
  await page.waitForFunction(() => Number.isFinite(window.squealmap.beside.times.last) && Number.isFinite(window.squealmap.view.times.last), { timeout: 240000, polling: 50 });
  const wide = await page.evaluate(() => [window.squealmap.view, window.squealmap.beside].map((view) => view.shownState.rangeX[1] - view.shownState.rangeX[0]));
  assert.ok(wide[0] === wide[1] && wide[0] < 0.5, `${wide}`);
  await page.select("#beside", "");
  assert.equal(await page.$eval("#beside-map", (element) => element.hidden), true);
  assert.equal((await state()).beside, "");
});

test("other starts of a cell end elsewhere, and one of them is taken by hand", async () => {
  await open();
  const links = await page.$$eval("#places a", (links) => links.map((link) => link.getAttribute("href")));
  // Stable when left alone, unstable when struck.
  await open(links[5]);
  await page.waitForFunction(() => window.squealmap.basin.grid?.points === 34, { timeout: 240000, polling: 50 });
  const ends = () => page.evaluate(() => [[0, 0.01], [0, 7], [0.03, 0]].map((start) => window.squealmap.basin.at(start)));
  const [small, large] = await ends();
  assert.equal(small, "equilibrium");
  assert.equal(large, "slip_reversal");
  // Each cell of the plane is what the engine says of its start.
  const differ = await page.evaluate(async () => {
    const { basin, engines, state, about } = window.squealmap;
    const names = about.columns.find((column) => column.name === "regime").names;
    const { points, reach, values } = basin.grid;
    const side = (key, value) => ({ key, from: value, to: value, points: 1 });
    let differ = 0;
    for (const [row, at] of [[16, 16], [30, 16], [10, 25], [25, 4]]) {
      const [x, v] = [at, row].map((k, which) => reach[which] * (-1 + (2 * k) / (points - 1)));
      const at_ = { ...state().at, [state().x]: state().cell[0], [state().y]: state().cell[1] };
      delete at_.start_displacement;
      delete at_.start_velocity;
      const { numbers } = await engines.ask({ ask: "region", x: side("start_displacement", x), y: side("start_velocity", v), at: at_, response: true, columns: ["regime"] });
      if (names[numbers[0]] !== names[values[row * points + at]]) differ++;
    }
    return differ;
  });
  assert.equal(differ, 0);
  // Closer: kicks of up to 0.4 m/s do not reach the knee, those from 0.45 m/s on do (`run --backend reference`).
  const reach = () => page.evaluate(() => window.squealmap.basin.grid?.points === 34 && window.squealmap.basin.grid.reach[1]);
  const whole_plane = await reach();
  await page.focus("#basin");
  for (let k = 0; k < 5; k++) await page.keyboard.press("+");
  await page.waitForFunction((before) => window.squealmap.basin.grid?.points === 34 && window.squealmap.basin.grid.reach[1] < before / 7, { timeout: 240000, polling: 50 }, whole_plane);
  assert.deepEqual(await page.evaluate(() => [[0, 0.3], [0, -0.3], [0, 0.6], [0, -0.6]].map((start) => window.squealmap.basin.at(start))), ["equilibrium", "equilibrium", "slip_reversal", "slip_reversal"]);
  for (let k = 0; k < 5; k++) await page.keyboard.press("-");
  await page.waitForFunction((before) => window.squealmap.basin.grid?.points === 34 && Math.abs(window.squealmap.basin.grid.reach[1] / before - 1) < 0.01, { timeout: 240000, polling: 50 }, whole_plane);
  // The start is dragged to where the motion does not die away.
  await page.$eval("#basin", (canvas) => canvas.scrollIntoView({ block: "center" }));
  const box = await (await page.$("#basin")).boundingBox();
  const from = await page.$eval("#numbers", (table) => table.textContent);
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.05 * box.height, { steps: 4 });
  assert.match(await page.$eval("#basin-words", (words) => words.textContent), /slip reversal\.$/);
  await page.mouse.up();
  await page.waitForFunction((from) => document.getElementById("numbers").textContent !== from, { timeout: 240000, polling: 50 }, from);
  const { at } = await state();
  assert.ok(at.start_velocity > 7 && Math.abs(at.start_displacement ?? 0) < 1e-3, JSON.stringify(at));
  const regime = await page.$$eval("#numbers tr", (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)).find(([name]) => name === "regime")[1]);
  assert.equal(regime, "slip reversal");
});

test("measured strokes stand where they were measured, and the address keeps them", async () => {
  await open("#x=mu_d&y=mu_s&show=growth_rate&at.belt_velocity=3");
  const folder = mkdtempSync(join(tmpdir(), "strokes-"));
  const table = join(folder, "strokes.csv");
  writeFileSync(table, "mu_s,mu_d,belt_velocity,mu_s_error,observed\n0.3,0.15,3,0.02,negative_slope\n0.2,0.45,1,,mode_coupling\n");
  await (await page.$("#strokes-file")).uploadFile(table);
  await page.waitForFunction(() => document.getElementById("measured").textContent !== "", { timeout: 60000, polling: 50 });
  assert.match(await page.$eval("#measured", (told) => told.textContent), /^2 of 2 .* 1 hollow, measured at another belt_velocity than 3/);
  const colour = (a, b) =>
    page.$eval(
      "#marks",
      (canvas, a, b) => {
        const { rangeX, rangeY } = window.squealmap.state();
        const [x, y] = [((a - rangeX[0]) / (rangeX[1] - rangeX[0])) * canvas.width, (1 - (b - rangeY[0]) / (rangeY[1] - rangeY[0])) * canvas.height];
        return [...canvas.getContext("2d").getImageData(Math.round(x), Math.round(y), 1, 1).data].slice(0, 3);
      },
      a,
      b,
    );
  assert.deepEqual(await colour(0.15, 0.3), [0x56, 0xb4, 0xe9]);
  assert.deepEqual(await colour(0.45, 0.2), [255, 255, 255]);
  const hash = await page.evaluate(() => location.hash);
  await open(hash);
  assert.equal((await state()).strokes.length, 2);
  writeFileSync(table, "mu_s,mu_d\n1,2\n");
  await page.click("#strokes");
  assert.equal((await state()).strokes.length, 0);
  await (await page.$("#strokes-file")).uploadFile(table);
  await page.waitForFunction(() => /no column `belt_velocity`/.test(document.getElementById("status").textContent), { timeout: 60000, polling: 50 });
  rmSync(folder, { recursive: true });
});

test("a line across the map gives the cut", async () => {
  await open("#x=mu_d&y=mu_s&show=growth_rate&at.belt_velocity=3");
  await page.click("#draw-cut");
  await page.$eval("#map", (map) => map.scrollIntoView());
  const box = await (await page.$("#map")).boundingBox();
  await page.mouse.move(box.x + 0.1 * box.width, box.y + 0.9 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.9 * box.width, box.y + 0.3 * box.height, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelectorAll("#line-cut svg").length === 1, { timeout: 60000, polling: 50 });
  const { cut, rangeX, cell } = await state();
  assert.equal(cell, null);
  assert.deepEqual(rangeX, [0, 0.6]);
  [0.06, 0.06, 0.54, 0.42].forEach((wanted, k) => assert.ok(Math.abs(cut[k] - wanted) < 0.005, `${cut}`));
  // The curve has the values of its places, which are not those beside the line.
  const { curve, there, beside } = await page.evaluate(async () => {
    const { engines, state, page } = window.squealmap;
    const { cut, at, x, y } = state();
    const side = (key, value) => ({ key, from: value, to: value, points: 1 });
    const one = async (a, b) => (await engines.ask({ ask: "region", x: side(x, a), y: side(y, b), at, response: false, columns: ["growth_rate"] })).numbers[0];
    const place = (part, k) => cut[k] + part * (cut[k + 2] - cut[k]);
    const parts = [0, 0.25, 0.5, 1];
    const values = (off) => Promise.all(parts.map((part) => one(place(part, 0), place(part, 1) + off)));
    const curve = page.acrossValues;
    return { curve: parts.map((part) => curve[part * (curve.length - 1)]), there: await values(0), beside: await values(0.02) };
  });
  const off = (others) => Math.max(...curve.map((value, k) => Math.abs(value - others[k])));
  assert.ok(off(there) < 1e-9, `${curve} ${there}`);
  assert.ok(off(beside) > 0.01);
  await open(await page.evaluate(() => location.hash));
  await page.waitForFunction(() => document.querySelectorAll("#line-cut svg").length === 1, { timeout: 60000, polling: 50 });
  assert.deepEqual((await state()).cut, cut);
  await page.click("#draw-cut");
  assert.equal((await state()).cut, null);
  assert.equal(await page.$eval("#across-map", (section) => section.hidden), true);
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
