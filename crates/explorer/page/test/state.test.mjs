// Addresses: what is written is read again, and what is wrong is told and left out.
import assert from "node:assert/strict";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const built = await build({
  stdin: { contents: 'export * from "./src/state"; export * from "./src/cell"; export * from "./src/own"; export * from "./src/lines"; export * from "./src/strokes"; export { ticks } from "./src/plots";', resolveDir: fileURLToPath(new URL("..", import.meta.url)), loader: "ts" },
  bundle: true,
  write: false,
  format: "esm",
});
const { borders, first, isoline, places, read, marksOf, said, strokes, written, kept_within, nearest, own, ownRegion, spectrum, ticks, why } = await import(`data:text/javascript,${encodeURIComponent(built.outputFiles[0].text)}`);

const side = (key, values, least, most) => ({ key, symbol: key, unit: "", meaning: "", range: `between ${least} and ${most}`, least, most, values, log: false, numbers: true });
const about = {
  title: "t",
  axes: [side("mu_s", [0, 0.3, 0.6], 0, null), side("mu_d", [0, 0.2, 0.5], 0, null), side("belt_velocity", [1, 3], 0, null)],
  fixed: [{ ...side("theta", [], -1.5, 1.5), value: 0.01, section: "model" }],
  columns: [{ name: "type", names: ["stable"] }, { name: "growth_rate", names: [] }],
};

const TABLE = "# measured\nmu_s,mu_d,belt_velocity,mu_s_error,observed\n0.2,0.3,2.5,0.02,both\n0.4,0.1,1,,mode_coupling\n";

test("an end that lies outside is told", () => {
  const open = { ...about, fixed: [{ ...side("m1", [], 0, null), range: "greater than 0", open: true, value: 2, section: "model" }] };
  assert.deepEqual(read(open, "#at.m1=1e-9").wrong, []);
  assert.match(read(open, "#at.m1=0").wrong[0], /`m1` is 0, and has to be greater than 0/);
  assert.deepEqual(read(about, "#at.theta=1.5").wrong, []);
});

test("an address gives its state again", () => {
  const state = { ...first(about), rangeX: [0.1, 0.2], rangeY: [0.25, 0.5], quantity: "growth_rate", at: { belt_velocity: 2.5, theta: 0.02 }, hidden: ["stable"], cell: [0.15, 0.3] };
  const { state: again, wrong } = read(about, written(state));
  assert.deepEqual(wrong, []);
  assert.deepEqual(again, state);
  const two = { ...state, beside: "type", hiddenBeside: ["stable"], lines: true, strokes: strokes(about, TABLE), cut: [0.1, 0.2, 0.3, 0.4] };
  assert.deepEqual(read(about, written(two)), { state: two, wrong: [] });
  assert.equal(read(about, "#cut=1,2,3").wrong.length, 1);
  assert.equal(read(about, "#cut=-1,0,0.1,0.2").wrong.length, 1);
  for (const [hash, why] of [["#foo=1", /`foo` is nothing/], ["#x=mu_s", /both/], ["#show=type&show=type", /twice/]]) assert.match(read(about, hash).wrong.join(), why);
  assert.equal(read(about, "#beside=depth").wrong.length, 1);
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

test("neighbouring numbers have no endless ticks", () => {
  let next = 18.5;
  for (let k = 0; k < 6; k++) {
    next += 2 ** -48;
    assert.ok(ticks(18.5, next, 5).length <= 6);
  }
  assert.deepEqual(ticks(Infinity, -Infinity, 5), []);
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

/** Cells of a function of both sides, 0 to 1, row by row from below. */
const cells = (wide, high, of) => {
  const [x, y] = [places(wide, [0, 1]), places(high, [0, 1])];
  return { x, y, cells: { wide, high, values: Float64Array.from({ length: wide * high }, (_, k) => of(x[k % wide], y[Math.floor(k / wide)])) } };
};

test("a line of equal value is where the function has it", () => {
  const [r, about] = [0.3, [0.52, 0.47]];
  const distance = (x, y) => Math.hypot(x - about[0], y - about[1]);
  const { x, y, cells: all } = cells(80, 60, (x, y) => distance(x, y) ** 2);
  const pieces = isoline(all, x, y, r * r);
  const off = (pieces) => Math.max(...pieces.flatMap(([ax, ay, bx, by]) => [Math.abs(distance(ax, ay) - r), Math.abs(distance(bx, by) - r)]));
  const long = pieces.reduce((sum, [ax, ay, bx, by]) => sum + Math.hypot(bx - ax, by - ay), 0);
  assert.ok(off(pieces) < 2e-4, `${off(pieces)}`);
  assert.ok(Math.abs(long - 2 * Math.PI * r) < 2e-3, `${long}`);
  // The comparer sees a line of another value.
  assert.ok(off(isoline(all, x, y, 0.32 ** 2)) > 0.01);
  // No line passes what is undefined, or where an angle goes on at its other side.
  const { cells: holed } = cells(80, 60, (x, y) => (x > about[0] ? NaN : distance(x, y) ** 2));
  assert.ok(isoline(holed, x, y, r * r).every(([ax, , bx]) => ax <= about[0] && bx <= about[0]));
  const angle = cells(40, 40, (x) => (x < 0.5 ? 170 : -170));
  assert.equal(isoline(angle.cells, angle.x, angle.y, 0, 180).length, 0);
  assert.ok(isoline(angle.cells, angle.x, angle.y, 0).length > 0);
});

test("borders stand between cells of two classes, also of a run whose cells are uneven", () => {
  const { x, y, cells: all } = cells(4, 2, (x) => (x < 0.5 ? 1 : 2));
  assert.deepEqual(borders(all, x, y), [[0.5, 0, 0.5, 0.5], [0.5, 0.5, 0.5, 1]]);
  const uneven = places(3, [0, 10], [0, 1, 9]);
  const one = { wide: 3, high: 1, values: Float64Array.of(0, 1, NaN) };
  assert.deepEqual(borders(one, uneven, places(1, [0, 1])), [[0.05, 0, 0.05, 1]]);
});

test("strokes of a table are marks in the colours of their types", () => {
  const state = { ...first(about), at: { belt_velocity: 2.5 }, strokes: strokes(about, TABLE) };
  const types = [{ name: "coexistence", fill: "#452087" }, { name: "mode_coupling", fill: "#b5441a" }];
  const [x, y] = [state.x, state.y].map((key) => ({ mu_s: [0.2, 0.4], mu_d: [0.3, 0.1] })[key]);
  assert.deepEqual(marksOf(state, types), [
    { at: [x[0], y[0]], errors: state.x === "mu_s" ? [0.02, 0] : [0, 0.02], fill: "#452087", here: true },
    { at: [x[1], y[1]], errors: [0, 0], fill: "#b5441a", here: false },
  ]);
  assert.match(said(state), /^2 of 2 measured strokes are in view.*; 1 hollow, measured at another belt_velocity than 2.5/);
  assert.match(said({ ...state, rangeX: [0.5, 0.6] }), /^0 of 2/);
  for (const [text, why] of [
    ["mu_s,mu_d,observed\n1,2,both", /no column `belt_velocity`, only `mu_s`, `mu_d`, `observed`/],
    ["mu_s,mu_d,belt_velocity,observed", /no rows/],
    ["mu_s,mu_d,belt_velocity,observed\n0.1,x,1,both", /`mu_d` is `x` in row 1/],
    ["mu_s,mu_d,belt_velocity,observed\n0.1,0.1,1,squeal", /`observed` is `squeal` in row 1 .* one of no_instability/],
    ["mu_s,mu_d,belt_velocity,observed\n" + "0.1,0.1,1,both\n".repeat(201), /201 strokes, and a page shows at most 200/],
    ["", /no column `mu_s`/],
    ["mu_s,mu_d,belt_velocity,observed\n0x1,0.1,1,both", /`mu_s` is `0x1` in row 1/],
    ["mu_s,mu_d,belt_velocity,observed\n0.1,0.1,1,both,7", /row 1 of the strokes has 5 fields, and their header has 4/],
  ])
    assert.throws(() => strokes(about, text), why);
  assert.match(read(about, "#strokes=mu_s;1").wrong[0], /no column/);
  // Fields in quotes, and what is no row in a remark.
  assert.equal(strokes(about, '# first; then\n"mu_s","mu_d",belt_velocity,"observed"\n"0.1",0.1,1,"both"\n').length, 1);
});
