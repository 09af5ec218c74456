// Addresses: what is written is read again, and what is wrong is told and left out.
import assert from "node:assert/strict";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const built = await build({
  stdin: { contents: 'export * from "./src/state"; export * from "./src/cell"; export * from "./src/own"; export { ticks } from "./src/plots";', resolveDir: fileURLToPath(new URL("..", import.meta.url)), loader: "ts" },
  bundle: true,
  write: false,
  format: "esm",
});
const { first, read, written, kept_within, nearest, own, ownRegion, spectrum, ticks, why } = await import(`data:text/javascript,${encodeURIComponent(built.outputFiles[0].text)}`);

const side = (key, values, least, most) => ({ key, symbol: key, unit: "", meaning: "", range: `between ${least} and ${most}`, least, most, values, log: false, numbers: true });
const about = {
  title: "t",
  axes: [side("mu_s", [0, 0.3, 0.6], 0, null), side("mu_d", [0, 0.2, 0.5], 0, null), side("belt_velocity", [1, 3], 0, null)],
  fixed: [{ ...side("theta", [], -1.5, 1.5), value: 0.01, section: "model" }],
  columns: [{ name: "type", names: ["stable"] }, { name: "growth_rate", names: [] }],
};

test("an address gives its state again", () => {
  const state = { ...first(about), rangeX: [0.1, 0.2], rangeY: [0.25, 0.5], quantity: "growth_rate", at: { belt_velocity: 2.5, theta: 0.02 }, hidden: ["stable"], cell: [0.15, 0.3] };
  const { state: again, wrong } = read(about, written(state));
  assert.deepEqual(wrong, []);
  assert.deepEqual(again, state);
  const other = read(about, written({ ...state, quantity: "type" })).state;
  assert.notDeepEqual(other, state);
});

test("200 wrong addresses leave a state that can be shown, and are told", () => {
  const keys = ["x", "y", "rx", "ry", "show", "at.belt_velocity", "at.theta", "at.nothing", "cell", "hide"];
  const values = ["", "mu_q", "NaN", "1e999", "-1", "5,2", "0.1,0.2,0.3", "1,1", "<script>", "%00", "__proto__", "belt_velocity", ",", "0x", "∞", "null", "[]", "{}", "1e-400,1e-400", "💥"];
  let told = 0;
  for (const key of keys) {
    for (const value of values) {
      const { state, wrong } = read(about, `#${new URLSearchParams([[key, value]])}`);
      told += wrong.length > 0 ? 1 : 0;
      for (const [low, high] of [state.rangeX, state.rangeY]) assert.ok(low >= 0 && high > low && Number.isFinite(high), `${key}=${value}: ${low}, ${high}`);
      assert.ok(state.x !== state.y && about.columns.some((column) => column.name === state.quantity), `${key}=${value}`);
      for (const number of Object.values(state.at)) assert.ok(Number.isFinite(number), `${key}=${value}`);
      assert.ok(state.cell === null || state.cell.every((number) => number >= 0), `${key}=${value}`);
    }
  }
  assert.ok(told > 120, `${told} were told`);
});

test("a range is kept within what its parameter may be", () => {
  assert.deepEqual(kept_within(about, "mu_s", [-1, 0.5]), [0, 0.5]);
  assert.equal(kept_within(about, "mu_s", [-2, -1]), undefined);
  assert.equal(kept_within(about, "mu_s", [0.3, 0.3]), undefined);
});

test("the cells of a run stand where its axes have values", () => {
  const run = { instances: 18, response: true, program: "p" };
  const state = first(about);
  const column = { name: "type", response: false };
  const whole = own(about, run, state, column);
  assert.deepEqual(whole, { x: [0, 0.2, 0.5], y: [0, 0.3, 0.6], whole: true });
  assert.deepEqual(own(about, run, { ...state, rangeX: [0.1, 0.3] }, column), { x: [0, 0.2, 0.5], y: [0, 0.3, 0.6], whole: false });
  assert.deepEqual(own(about, run, { ...state, rangeX: [0.25, 0.3] }, column).x, [0.2, 0.5]);
  // What the run has not.
  assert.equal(own(about, run, { ...state, at: { belt_velocity: 2 } }, column), null);
  assert.equal(own(about, run, { ...state, at: { ...state.at, theta: 0.02 } }, column), null);
  assert.equal(own(about, { ...run, response: false }, state, { ...column, response: true }), null);
  assert.equal(own(about, run, { ...state, rangeX: [0.7, 0.8] }, column), null);
  const question = ownRegion(state, column, whole, [1, 2]);
  assert.deepEqual(question.y, { key: "mu_s", from: 0.3, to: 0.6, points: 2, values: [0.3, 0.6] });
  assert.deepEqual([...nearest([0, 0.2, 0.5], [0, 0.5], 4)], [0, 1, 1, 2]);
});

test("the spectrum of a sine has its frequency and its amplitude", () => {
  const t = Array.from({ length: 4001 }, (_, k) => k / 4000);
  const { f, a } = spectrum(t, t.map((time) => 3 * Math.sin(2 * Math.PI * 40 * time) + 5));
  const most = Math.max(...a);
  assert.ok(Math.abs(f[a.indexOf(most)] - 40) < 1.01, `${f[a.indexOf(most)]} Hz`);
  assert.ok(Math.abs(most - 3) < 0.1, `${most}`);
});

test("ticks are round and inside", () => {
  assert.deepEqual(ticks(0, 0.6, 5).map((x) => Number(x.toPrecision(6))), [0, 0.2, 0.4, 0.6]);
  assert.ok(ticks(-3.2e-9, 4e-9, 4).every((x) => x >= -3.2e-9 && x <= 4e-9));
});

test("the paragraph names the mechanism and its numbers", () => {
  const cell = { full: [[10, 200], [-2, 210]], flat: [[-1, 205]], frozen: [[9, 201]], none: null, equilibrium: { mu: 0.3, slope: -0.04, normal_force: 996, x2: 0, y1: 0 }, law: null, motion: {}, period: 0.03 };
  const said = why(cell, "negative_slope");
  assert.match(said, /31\.83 Hz grows at 10 1\/s, and only because friction falls/);
  assert.match(said, /Without the slope of friction the largest growth rate is -1 1\/s/);
  assert.doesNotMatch(why({ ...cell, full: [[-2, 210]] }, "stable"), /grows/);
});
