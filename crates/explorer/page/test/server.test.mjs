// The page served by the program, in a browser; see browser.mjs. SWEEP is the sweep, RUN the directory of a run of it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { endServers, labels, launch, open, serve, whole } from "./browser.mjs";

const { RUN, MAP, SWEEP } = process.env;
assert.ok(RUN && SWEEP, "RUN and SWEEP have to name files; crates/explorer/check does");

const errors = [];
const asked = [];
const dropped = [];
let browser, page;

const text = (id) => page.$eval(id, (element) => element.textContent);

before(async () => {
  browser = await launch();
  page = await browser.newPage();
  page.on("request", (request) => asked.push(request.url()));
  page.on("requestfailed", (request) => dropped.push(request.url()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
});
after(async () => {
  await browser?.close();
  endServers();
});

test("the labels of a served page are those of the program, which computes them", async () => {
  const { address } = await serve(SWEEP);
  await open(page, "", address);
  assert.equal(await page.$eval("#engine", (list) => list.value), "program");
  assert.match(await text("#status"), /this program \(\d+ cores\)/);
  const before = asked.length;
  const { rows, differ } = await labels(page);
  assert.ok(rows > 8000, `${rows}`);
  assert.equal(differ, 0, `${differ} of ${rows} labels differ`);
  assert.ok(asked.slice(before).every((url) => url === `${address}ask`) && asked.length > before);
  const elsewhere = asked.filter((url) => !url.startsWith(address) && !url.startsWith("blob:") && !url.startsWith("data:") && url !== "about:blank");
  assert.deepEqual(elsewhere, []);
});

let zoomed = 0;

/** From zooms to the first and to the last picture, s: the middle ones. */
async function times(choice, quantity, zooms) {
  await page.evaluate((choice) => void (window.squealmap.engines.choice = choice), choice);
  const all = [];
  for (let k = 0; k < zooms; k++) {
    await page.evaluate(([quantity, k]) => {
      const { page, state } = window.squealmap;
      page.go({ ...state(), rangeX: [0.1 + 0.001 * k, 0.5], rangeY: [0.1, 0.5], quantity });
    }, [quantity, ++zoomed]);
    await whole(page);
    all.push(await page.evaluate(() => window.squealmap.view.times));
  }
  const middle = (name) => all.map((one) => one[name]).sort((a, b) => a - b)[zooms >> 1];
  return { first: middle("first"), last: middle("last"), by: await page.evaluate(() => window.squealmap.engines.by(false)) };
}

for (const [quantity, zooms, width] of [["type", 5, 1280], ["regime", 1, 300]])
  test(`from a zoom to the first and the last picture: ${quantity}`, async () => {
    await page.setViewport({ width, height: 900 });
    for (const options of quantity === "type" ? [[]] : [[], ["--precision", "f64"]]) {
      const { address, end } = await serve(SWEEP, ...options);
      await open(page, "", address);
      const size = await page.$eval("#map", (map) => `${map.width} x ${map.height} pixels`);
      for (const choice of ["program", "cpu"]) {
        const { first, last, by } = await times(choice, quantity, zooms);
        console.log(`${quantity}, ${size}, ${[by, ...(choice === "program" ? options : [])].join(" ")}: first picture after ${first.toFixed(3)} s, last after ${last.toFixed(2)} s`);
        assert.ok(first <= last);
      }
      await end();
    }
    await page.setViewport({ width: 1280, height: 900 });
  });

test("what is no longer wanted is dropped, and a cell is looked into", async () => {
  const { address } = await serve(SWEEP);
  await open(page, "", address);
  const before = dropped.length;
  await page.evaluate(async () => {
    const { page, state } = window.squealmap;
    page.go({ ...state(), rangeX: [0, 0.6], rangeY: [0, 0.6], quantity: "regime" });
    for (let k = 0; k < 10; k++) {
      page.zoom(0.95, [0.5, 0.5]);
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    page.go({ ...state(), quantity: "type" });
  });
  await whole(page);
  assert.ok(dropped.length > before, "no question was dropped");
  assert.ok((await page.evaluate(() => window.squealmap.engines.open())) < 4);
  await page.evaluate(() => window.squealmap.page.pick([0.3, 0.8]));
  await page.waitForFunction(() => !document.getElementById("cell").hidden, { timeout: 60000, polling: 50 });
});

test("a server that ends is told, and the map goes on without it", async () => {
  const { address, end } = await serve(SWEEP);
  await open(page, "", address);
  await page.evaluate(() => window.squealmap.page.go({ ...window.squealmap.state(), quantity: "regime" }));
  await page.waitForFunction(() => window.squealmap.engines.atProgram.size > 0, { timeout: 60000, polling: 5 });
  await end();
  await page.waitForFunction(() => window.squealmap.engines.program === null, { timeout: 60000, polling: 50 });
  assert.match(await page.$eval("#engine", (list) => list.title), /The program does not answer: it has ended/);
  assert.equal(await page.$eval('#engine option[value="program"]', (option) => option.disabled), true);
  await page.select("#quantity", "type");
  await whole(page);
  assert.match(await text("#status"), /on \d+ engines/);
  const { differ } = await labels(page);
  assert.equal(differ, 0);
});

test("a run is shown as it is, and what it has not is computed", async () => {
  const { address } = await serve(RUN);
  await open(page, "", address);
  assert.match(await text("#source"), /^From the run of squealmap [^:]+: all of [\d,]+ cells\.$/);
  const [head, ...rows] = readFileSync(MAP, "utf8").trim().split("\n").map((line) => line.split(","));
  const found = await page.evaluate(() => {
    const { view, state, about } = window.squealmap;
    const { wide, high, values, own } = view.finest();
    return { wide, high, x: own.x, y: own.y, values: [...values], at: state().at, names: about.columns.find((column) => column.name === "type").names };
  });
  const of = (row, name) => row[head.indexOf(name)];
  const here = rows.filter((row) => Number(of(row, "belt_velocity")) === found.at.belt_velocity);
  assert.equal(here.length, found.wide * found.high);
  const differ = () => here.filter((row) => found.names[found.values[found.y.indexOf(Number(of(row, "mu_s"))) * found.wide + found.x.indexOf(Number(of(row, "mu_d")))]] !== of(row, "type")).length;
  assert.equal(differ(), 0);
  // The comparer sees a planted fault.
  found.values[7] = -1;
  assert.equal(differ(), 1);
  const box = await (await page.$("#map")).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  assert.match(await text("#readout"), /type = [a-z]/);
  // Between two instances the values of the nearest are told, and a click looks into that one.
  const [x, y] = [found.x[3], found.y[2]];
  const near = (values, at) => (values[at] + 0.3 * (values[at + 1] - values[at]) - values[0]) / (values.at(-1) - values[0]);
  const place = [near(found.x, 3), near(found.y, 2)];
  await page.mouse.move(box.x + place[0] * box.width, box.y + (1 - place[1]) * box.height);
  const told = (await text("#readout")).match(/= ([-0-9.e]+).*?= ([-0-9.e]+).*?: type = (.+)$/);
  assert.deepEqual([Number(told[1]), Number(told[2])], [x, y].map((value) => Number(value.toPrecision(5))));
  const instance = here.find((row) => Number(of(row, "mu_d")) === x && Number(of(row, "mu_s")) === y);
  assert.equal(told[3].replaceAll(" ", "_"), of(instance, "type"));
  await page.evaluate((place) => window.squealmap.page.pick(place), place);
  assert.deepEqual(await page.evaluate(() => window.squealmap.state().cell), [x, y]);
  await page.evaluate(() => window.squealmap.page.zoom(0.5, [0.5, 0.5]));
  await whole(page);
  assert.match(await text("#source"), /^From the run of squealmap [^:]+: \d+ of [\d,]+ cells; the others are computed\.$/);
  await page.select("#engine", "cpu");
  await whole(page);
  assert.equal(await text("#source"), "");
});

test("nothing goes wrong unseen", () => assert.deepEqual(errors, []));
