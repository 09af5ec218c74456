// The page in a browser that has WebGPU, on software where there is no other; see browser.mjs.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { curved, labels, launch, open, whole } from "./browser.mjs";

let browser, page;
const errors = [];
const choose = (choice) => page.evaluate((choice) => void (window.squealmap.engines.choice = choice), choice);
const opened = () => page.waitForFunction(() => window.squealmap.engines.device !== null, { timeout: 60000, polling: 50 });

before(async () => {
  browser = await launch("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader");
  page = await browser.newPage();
  page.on("pageerror", (error) => errors.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
  await open(page);
  await opened();
});
after(() => browser?.close());

test("the labels of WebGPU are those of the program", async () => {
  await choose("gpu");
  const { rows, differ } = await labels(page);
  assert.ok(rows > 8000, `${rows}`);
  assert.equal(differ, 0, `${differ} of ${rows} labels differ`);
  assert.notEqual(await page.evaluate(() => window.squealmap.engines.device), null, "the GPU was lost on the way");
});

/** Some transients by an engine: columns one after the other, and how long they took, s. */
const transients = (choice, columns) =>
  page.evaluate(
    async (choice, columns) => {
      const { engines, about } = window.squealmap;
      engines.choice = choice;
      const side = (key, from, to, points) => ({ key, from, to, points });
      const region = { ask: "region", x: side("mu_d", 0.05, 0.55, 16), y: side("mu_s", 0.05, 0.55, 16), at: { belt_velocity: 3 }, response: true, f32: true, columns };
      const by = engines.by(true);
      const began = performance.now();
      const { numbers } = await engines.ask(region);
      const names = about.columns.find((column) => column.name === columns[0]).names;
      return { by, took: (performance.now() - began) / 1000, numbers: [...numbers], names };
    },
    choice,
    columns,
  );

const COUNT = 256;
const COLUMNS = ["regime", "x2_std", "ax_rms", "ay_rms", "stick"];

/** Which regimes differ, and the largest relative difference of the numbers where they do not. */
function compared(gpu, cpu) {
  const regime = ({ numbers, names }, k) => names[numbers[k]] ?? "none";
  const cells = [...Array(COUNT).keys()];
  const other = cells.filter((k) => regime(gpu, k) !== regime(cpu, k));
  const worst = COLUMNS.slice(1).map((_, column) => {
    const parts = cells.filter((k) => !other.includes(k)).map((k) => [gpu.numbers[(column + 1) * COUNT + k], cpu.numbers[(column + 1) * COUNT + k]]);
    const known = parts.filter(([a, b]) => Number.isFinite(a) && Number.isFinite(b));
    assert.equal(known.length, parts.filter(([a, b]) => Number.isFinite(a) || Number.isFinite(b)).length, "one engine knows what the other does not");
    const scale = Math.max(...known.map(([, b]) => Math.abs(b)));
    return Math.max(...known.map(([a, b]) => Math.abs(a - b))) / scale;
  });
  return { other: other.length, worst };
}

for (const [law, of] of [["bilinear", undefined], ["exponential", curved]])
  test(`transients of WebGPU are those of WebAssembly, ${law} law`, async () => {
    assert.notEqual(of, "", "CURVED has to name a page; crates/explorer/check does");
    await open(page, "", of);
    await opened();
    // The first time the browser compiles the kernels.
    const first = await transients("gpu", COLUMNS);
    const [gpu, cpu] = [await transients("gpu", COLUMNS), await transients("cpu", COLUMNS)];
    assert.equal(await page.evaluate(() => window.squealmap.engines.noDevice), "", "the GPU was lost on the way");
    assert.notEqual(gpu.by, cpu.by);
    const { other, worst } = compared(gpu, cpu);
    console.log(`${law}: ${COUNT} transients in ${gpu.took.toFixed(2)} s (the first time ${first.took.toFixed(2)}) on ${gpu.by}, ${cpu.took.toFixed(2)} s on ${cpu.by}; regimes that differ: ${other}; largest differences by the scale: ${worst.map((one) => one.toExponential(1)).join(" ")}`);
    assert.ok(other <= 2, `${other} regimes differ`);
    assert.ok(Math.max(...worst) < 1e-3, `${worst}`);
    // The comparer sees a planted fault.
    gpu.numbers[COUNT] += 1;
    assert.ok(Math.max(...compared(gpu, cpu).worst) > 1e-3);
  });

/** The process of the browser that has the GPU. */
function gpuProcess() {
  const of = (pid, name) => {
    try {
      return readFileSync(`/proc/${pid}/${name}`, "utf8");
    } catch {
      return "";
    }
  };
  const parent = (pid) => of(pid, "stat").split(") ").at(-1).split(" ")[1];
  const isOurs = (pid) => pid === String(browser.process().pid) || (Number(pid) > 1 && isOurs(parent(pid)));
  const found = readdirSync("/proc").filter((pid) => of(pid, "cmdline").includes("--type=gpu-process") && isOurs(pid));
  assert.equal(found.length, 1, `${found}`);
  return Number(found[0]);
}

test("a device that is lost is told, and the map goes on without it", async () => {
  await open(page);
  await opened();
  await choose("gpu");
  process.kill(gpuProcess(), "SIGKILL");
  const numbers = await page.evaluate(async () => {
    const side = (key) => ({ key, from: 0.1, to: 0.5, points: 4 });
    return [...(await window.squealmap.engines.ask({ ask: "region", x: side("mu_d"), y: side("mu_s"), at: { belt_velocity: 3 }, response: false, columns: ["growth_rate"] })).numbers];
  });
  assert.ok(numbers.every(Number.isFinite), `${numbers}`);
  await page.waitForFunction(() => window.squealmap.engines.device === null, { timeout: 60000, polling: 50 });
  assert.notEqual(await page.$eval("#engine", (list) => list.title), "");
  await page.select("#quantity", "growth_rate");
  await whole(page);
});

test("nothing goes wrong unseen", () => assert.deepEqual(errors, []));
