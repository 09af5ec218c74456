// Measured strokes over a map: what was observed beside what is predicted. The table is that of `plot --strokes`.

import { sides, type State } from "./state";
import { type About, type Class, shown } from "./sweep";

/** What may be observed, and the type of the map that has its colour. */
const OBSERVED: Record<string, string> = { no_instability: "stable", negative_slope: "negative_slope", mode_coupling: "mode_coupling", both: "coexistence", undecided: "" };

/** Strokes of one table. */
const MOST = 200;

/** A value this close to that of the view, as a part of it, is the same. */
const SAME = 0.02;

/** A stroke: its value on every axis of numbers, their standard errors, and what was observed. */
export interface Stroke {
  at: Record<string, number>;
  errors: Record<string, number>;
  observed: string;
}

/** Strokes of a table, rows by `;` or lines. Throws a sentence that says what is wrong. */
export function strokes(about: About, text: string): Stroke[] {
  // An address has no lines.
  const lines = text.split(/[\r\n]/.test(text) ? /[\r\n]+/ : /;/).map((line) => line.trim()).filter((line) => line !== "" && !line.startsWith("#"));
  const fields = (line: string) => line.replace(/^\ufeff/, "").split(",").map((field) => field.trim().replace(/^"([^"]*)"$/, "$1").trim());
  const header = fields(lines[0] ?? "");
  const keys = sides(about).map((axis) => axis.key);
  for (const name of [...keys, "observed"]) {
    if (!header.includes(name)) throw new Error(`the strokes have no column \`${name}\`, only ${header.map((one) => `\`${one.slice(0, 40)}\``).join(", ")}`);
  }
  if (lines.length < 2) throw new Error("the strokes have no rows; each stroke is one, below the names of the columns");
  if (lines.length - 1 > MOST) throw new Error(`there are ${lines.length - 1} strokes, and a page shows at most ${MOST}: leave some out`);
  return lines.slice(1).map((line, row) => {
    const cells = fields(line);
    if (cells.length !== header.length) throw new Error(`row ${row + 1} of the strokes has ${cells.length} fields, and their header has ${header.length}`);
    const number = (name: string): number => {
      const cell = cells[header.indexOf(name)] ?? "";
      const value = /^[-+]?[0-9.]/.test(cell) && !/^0[xob]/i.test(cell) ? Number(cell) : NaN;
      if (!Number.isFinite(value)) throw new Error(`\`${name}\` is \`${cell.slice(0, 40)}\` in row ${row + 1} of the strokes, and has to be a number`);
      return value;
    };
    const observed = cells[header.indexOf("observed")] ?? "";
    if (!Object.hasOwn(OBSERVED, observed)) throw new Error(`\`observed\` is \`${observed.slice(0, 40)}\` in row ${row + 1} of the strokes, and has to be one of ${Object.keys(OBSERVED).join(", ")}`);
    const known = keys.filter((key) => header.includes(`${key}_error`) && (cells[header.indexOf(`${key}_error`)] ?? "") !== "");
    return {
      at: Object.fromEntries(keys.map((key) => [key, number(key)])),
      errors: Object.fromEntries(known.map((key) => [key, Math.abs(number(`${key}_error`))])),
      observed,
    };
  });
}

/** Those strokes as one line of an address. */
export function line(all: Stroke[]): string {
  const first = all[0];
  if (!first) return "";
  const [keys, errors] = [Object.keys(first.at), [...new Set(all.flatMap((stroke) => Object.keys(stroke.errors)))]];
  const header = [...keys, ...errors.map((key) => `${key}_error`), "observed"];
  const rows = all.map(({ at, errors: known, observed }) => [...keys.map((key) => at[key]), ...errors.map((key) => known[key] ?? ""), observed]);
  return [header, ...rows].map((row) => row.join(",")).join(";");
}

/** A stroke in a view: its place and the ends of its errors in values of both sides, its colour, and whether it was measured at all other
 * values of the view. */
export interface Mark {
  at: [number, number];
  errors: [number, number];
  fill: string;
  here: boolean;
}

/** The marks of strokes in a view. */
export function marksOf(state: State, types: Class[]): Mark[] {
  const { x, y } = state;
  return state.strokes.map(({ at, errors, observed }) => ({
    at: [at[x] ?? NaN, at[y] ?? NaN],
    errors: [errors[x] ?? 0, errors[y] ?? 0],
    fill: types.find((one) => one.name === OBSERVED[observed])?.fill ?? "#808b81",
    here: Object.entries(at).every(([key, value]) => {
      const now = state.at[key];
      return key === x || key === y || typeof now !== "number" || Math.abs(value - now) <= SAME * Math.abs(now);
    }),
  }));
}

/** How many strokes a view shows how, in words. */
export function said(state: State): string {
  if (state.strokes.length === 0) return "";
  const all = marksOf(state, []);
  const inside = ([a, b]: [number, number]) => a >= state.rangeX[0] && a <= state.rangeX[1] && b >= state.rangeY[0] && b <= state.rangeY[1];
  const seen = all.filter(({ at }) => inside(at));
  const elsewhere = seen.filter(({ here }) => !here).length;
  const others = Object.keys(state.strokes[0]?.at ?? {}).filter((key) => key !== state.x && key !== state.y);
  const hollow = elsewhere > 0 ? `; ${elsewhere} hollow, measured at another ${others.map((key) => `${key} than ${shown(Number(state.at[key]), 4)}`).join(" or ")}` : "";
  return `${seen.length} of ${all.length} measured strokes are in view, in the colours of their types${hollow}.`;
}
