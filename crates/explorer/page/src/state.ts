// What is looked at, and the address that holds it.

import { line, type Stroke, strokes } from "./strokes";
import { type About, type Axis, type Parameter, ends } from "./sweep";

/** A range of a side, from its lower to its upper edge. */
export type Range = [number, number];

/** What is looked at. */
export interface State {
  x: string;
  y: string;
  rangeX: Range;
  rangeY: Range;
  quantity: string;
  /** Values of everything that is not on a side: every other axis, and parameters that were moved. */
  at: Record<string, number | string>;
  /** Classes that are not shown. */
  hidden: string[];
  /** What a second map beside the first shows; nothing where there is none. */
  beside: string;
  /** Classes that it does not show. */
  hiddenBeside: string[];
  /** Whether lines of equal value and borders between classes are drawn. */
  lines: boolean;
  /** Measured strokes over the map. */
  strokes: Stroke[];
  /** A line across the map: both ends, each by its place on both sides. */
  cut: [number, number, number, number] | null;
  /** The cell that is looked into: its place on both sides. */
  cell: [number, number] | null;
}

/** The axes that a side may have. */
export function sides(about: About): Axis[] {
  return about.axes.filter((axis) => axis.numbers);
}

/** A parameter by its name. */
export function parameter(about: About, key: string): Parameter | undefined {
  return about.axes.find((axis) => axis.key === key) ?? about.fixed.find((fixed) => fixed.key === key);
}

/** The state that a sweep begins with: its two longest axes, as the figure of its map has them. */
export function first(about: About): State {
  const order = sides(about)
    .map((axis, place) => ({ axis, place }))
    .sort((a, b) => b.axis.values.length - a.axis.values.length || a.place - b.place)
    .slice(0, 2)
    .sort((a, b) => a.place - b.place)
    .map((one) => one.axis);
  const [y, x] = order;
  if (!x || !y) throw new Error("the sweep has not two axes of numbers");
  const state: State = {
    x: x.key,
    y: y.key,
    rangeX: ends(x),
    rangeY: ends(y),
    quantity: "type",
    at: {},
    hidden: [],
    beside: "",
    hiddenBeside: [],
    lines: false,
    strokes: [],
    cut: null,
    cell: null,
  };
  return closed(about, state);
}

/** The whole range of a side, of which no more is shown at once. */
export function whole(about: About, key: string): Range {
  const axis = about.axes.find((one) => one.key === key);
  const [low, high] = axis ? ends(axis) : [0, 1];
  return low < high ? [low, high] : [low - Math.abs(low || 1) / 2, high + Math.abs(high || 1) / 2];
}

/** A state in which everything that is needed has a value, and nothing that is not. */
export function closed(about: About, state: State): State {
  const at: State["at"] = {};
  for (const axis of about.axes) {
    if (axis.key === state.x || axis.key === state.y) continue;
    const kept = state.at[axis.key];
    const first = axis.values[Math.floor(axis.values.length / 2)] ?? axis.values[0];
    const value = kept !== undefined && typeof kept === typeof first ? kept : first;
    if (value !== undefined) at[axis.key] = value;
  }
  for (const fixed of about.fixed) {
    const kept = state.at[fixed.key];
    if (typeof kept === "number" && kept !== fixed.value) at[fixed.key] = kept;
  }
  return { ...state, at };
}

const numbers = (range: number[]) => range.join(",");

/** What an address may say, besides values at `at.`. */
const WORDS = ["x", "y", "rx", "ry", "show", "hide", "beside", "hide_beside", "lines", "strokes", "cut", "cell"];

/** The address of a state. */
export function written(state: State): string {
  const words = new URLSearchParams();
  words.set("x", state.x);
  words.set("y", state.y);
  words.set("rx", numbers(state.rangeX));
  words.set("ry", numbers(state.rangeY));
  words.set("show", state.quantity);
  for (const [key, value] of Object.entries(state.at)) words.set(`at.${key}`, String(value));
  if (state.hidden.length > 0) words.set("hide", state.hidden.join(","));
  if (state.beside !== "") words.set("beside", state.beside);
  if (state.beside !== "" && state.hiddenBeside.length > 0) words.set("hide_beside", state.hiddenBeside.join(","));
  if (state.lines) words.set("lines", "1");
  if (state.strokes.length > 0) words.set("strokes", line(state.strokes));
  if (state.cut) words.set("cut", numbers(state.cut));
  if (state.cell) words.set("cell", numbers(state.cell));
  return `#${words.toString()}`;
}

/** The state of an address. What it says that cannot be is left out, and told. */
export function read(about: About, hash: string): { state: State; wrong: string[] } {
  const state = first(about);
  const wrong: string[] = [];
  if (hash.length <= 1) return { state, wrong };
  const words = new URLSearchParams(hash.slice(1));
  const said = new Set<string>();
  for (const name of words.keys()) {
    if (said.has(name)) wrong.push(`\`${name}\` stands there twice; the first is taken`);
    else if (!name.startsWith("at.") && !WORDS.includes(name)) wrong.push(`\`${name}\` is nothing that an address says`);
    said.add(name);
  }
  const known = sides(about).map((axis) => axis.key);
  const side = (name: string, other: string) => {
    const value = words.get(name);
    if (value === null) return undefined;
    if (known.includes(value) && value !== other) return value;
    wrong.push(`\`${name}=${value}\` is no side of this map`);
    return undefined;
  };
  const x = side("x", "");
  const y = side("y", x ?? "");
  if ((x === undefined) !== (y === undefined) && wrong.length === 0) wrong.push("an address that names a side has to name both, `x` and `y`");
  if (x && y) {
    state.x = x;
    state.y = y;
    state.rangeX = whole(about, x);
    state.rangeY = whole(about, y);
  }
  const pair = (name: string): [number, number] | undefined => {
    const text = words.get(name);
    if (text === null) return undefined;
    const [a, b, more] = text.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    if (a !== undefined && b !== undefined && more === undefined && Number.isFinite(a) && Number.isFinite(b)) return [a, b];
    wrong.push(`\`${name}=${text}\` is not two numbers`);
    return undefined;
  };
  const range = (name: string, key: string) => {
    const found = pair(name);
    const kept = found && kept_within(about, key, found);
    if (found && !kept) wrong.push(`\`${name}\` is no range of \`${key}\``);
    return kept;
  };
  state.rangeX = range("rx", state.x) ?? state.rangeX;
  state.rangeY = range("ry", state.y) ?? state.rangeY;
  const show = words.get("show");
  if (show !== null) {
    if (about.columns.some((column) => column.name === show)) state.quantity = show;
    else wrong.push(`there is no column \`${show}\``);
  }
  for (const [name, text] of words) {
    if (!name.startsWith("at.")) continue;
    const key = name.slice(3);
    const of = parameter(about, key);
    const axis = about.axes.find((one) => one.key === key);
    if (axis && !axis.numbers) {
      if (axis.values.includes(text)) state.at[key] = text;
      else wrong.push(`\`${text}\` is no value of \`${key}\``);
      continue;
    }
    const value = text.trim() === "" ? NaN : Number(text);
    if (of && is_allowed(of, value)) state.at[key] = value;
    else wrong.push(of ? `\`${key}\` is ${text}, and has to be ${of.range}` : `\`${key}\` is no parameter of this sweep`);
  }
  const beside = words.get("beside");
  if (beside !== null) {
    if (about.columns.some((column) => column.name === beside)) state.beside = beside;
    else wrong.push(`there is no column \`${beside}\``);
  }
  const names = (of: string) => (words.get(of) ?? "").split(",").filter((name) => name !== "").slice(0, 32);
  state.hidden = names("hide");
  state.hiddenBeside = state.beside === "" ? [] : names("hide_beside");
  state.lines = words.get("lines") === "1";
  const measured = words.get("strokes");
  try {
    if (measured !== null) state.strokes = strokes(about, measured);
  } catch (why) {
    wrong.push(why instanceof Error ? why.message : String(why));
  }
  const [a, b] = [parameter(about, state.x), parameter(about, state.y)];
  const isPlace = ([x, y]: [number, number]) => a !== undefined && b !== undefined && is_allowed(a, x) && is_allowed(b, y);
  const cut = words.get("cut");
  if (cut !== null) {
    const [ax, ay, bx, by, more] = cut.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    const known = ax !== undefined && ay !== undefined && bx !== undefined && by !== undefined && more === undefined;
    if (known && isPlace([ax, ay]) && isPlace([bx, by])) state.cut = [ax, ay, bx, by];
    else wrong.push(`\`cut=${cut}\` is not two places of this map`);
  }
  const cell = pair("cell");
  if (cell) {
    if (isPlace(cell)) state.cell = cell;
    else wrong.push("`cell` lies outside of what the parameters may be");
  }
  return { state: closed(about, state), wrong };
}

/** Whether a parameter may have a value. */
export function is_allowed(of: Parameter, value: number): boolean {
  const beyond = (value: number, end: number) => (of.open ? value <= end : value < end);
  return Number.isFinite(value) && (of.least === null || !beyond(value, of.least)) && (of.most === null || !beyond(-value, -of.most));
}

/** A range within what its parameter may be; nothing where it is none. */
export function kept_within(about: About, key: string, [low, high]: Range): Range | undefined {
  const of = parameter(about, key);
  if (!of || !Number.isFinite(low) || !Number.isFinite(high)) return undefined;
  const range: Range = [Math.max(low, of.least ?? -Infinity), Math.min(high, of.most ?? Infinity)];
  // Closer than this, neighbours are the same number.
  const closest = 1e-9 * Math.max(Math.abs(range[0]), Math.abs(range[1]), 1e-6);
  return range[1] - range[0] > closest ? range : undefined;
}
