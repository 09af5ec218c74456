// The map along its two sides through a cell.

import type { Engines } from "./ask";
import { figure } from "./plots";
import type { State } from "./state";
import { type About, type Column, plain, shown } from "./sweep";

/** Values of a cut. */
const POINTS = { eigenvalues: 201, transients: 65 };

/** What is drawn where the map shows classes. */
const INSTEAD = "growth_rate";

/** The column that a cut of a map of it has. */
function shownBy(about: About, quantity: string): Column | undefined {
  const shown = about.columns.find((column) => column.name === quantity);
  return shown && shown.names.length === 0 ? shown : about.columns.find((one) => one.name === INSTEAD);
}

/** The label of the values of a column. */
const label = (column: Column) => (column.unit ? `${column.name}, ${column.unit}` : column.name);

/** A plot along a line across the map, which may be askew, and its values. */
export async function along(engines: Engines, about: About, state: State, group: number): Promise<{ plot: string; values: Float64Array }> {
  const { cut } = state;
  const column = shownBy(about, state.quantity);
  if (!cut || !column) return { plot: "", values: new Float64Array() };
  const points = column.response ? POINTS.transients : POINTS.eigenvalues;
  const place = (side: 0 | 1, k: number) => cut[side] + (k / (points - 1)) * (cut[(side + 2) as 2 | 3] - cut[side]);
  const cell = async (k: number): Promise<number> => {
    const [x, y] = [place(0, k), place(1, k)];
    const side = (key: string, value: number) => ({ key, from: value, to: value, points: 1 });
    const question = { ask: "region", x: side(state.x, x), y: side(state.y, y), at: state.at, response: column.response, columns: [column.name] };
    return (await engines.ask(question, group)).numbers[0] ?? NaN;
  };
  const values = Float64Array.from(await Promise.all(Array.from({ length: points }, (_, k) => cell(k))));
  // By the side that the line goes along more.
  const part = (side: 0 | 1, [low, high]: [number, number]) => Math.abs(cut[(side + 2) as 2 | 3] - cut[side]) / (high - low);
  const by = part(0, state.rangeX) >= part(1, state.rangeY) ? 0 : 1;
  const axis = about.axes.find((one) => one.key === (by === 0 ? state.x : state.y));
  const end = (from: 0 | 2) => `${state.x} = ${shown(cut[from], 4)}, ${state.y} = ${shown(cut[(from + 1) as 1 | 3], 4)}`;
  const plot = figure({
    caption: `${column.print.replace(/[{}]/g, "")} from ${end(0)} to ${end(2)}`,
    x: axis ? plain(axis) : "",
    y: label(column),
    lines: [{ x: Float64Array.from({ length: points }, (_, k) => place(by, k)), y: values, colour: "#1b6ca8" }],
    ...(column.signed ? { at: { y: 0 } } : {}),
  });
  return { plot, values };
}

/** Plots along both sides over what is visible; of a map of classes, of its growth rates. */
export async function cuts(engines: Engines, about: About, state: State, group: number): Promise<string> {
  const { cell } = state;
  const column = shownBy(about, state.quantity);
  if (!cell || !column) return "";
  const points = column.response ? POINTS.transients : POINTS.eigenvalues;
  const one = async (along: 0 | 1): Promise<string> => {
    const key = along === 0 ? state.x : state.y;
    const [from, to] = along === 0 ? state.rangeX : state.rangeY;
    const moving = { key, from, to, points };
    const still = { key: along === 0 ? state.y : state.x, from: cell[1 - along], to: cell[1 - along], points: 1 };
    const sides = along === 0 ? { x: moving, y: still } : { x: still, y: moving };
    const question = { ask: "region", ...sides, at: state.at, response: column.response, columns: [column.name] };
    const { numbers } = await engines.ask(question, group);
    const of = (name: string) => about.axes.find((axis) => axis.key === name);
    const x = Float64Array.from({ length: points }, (_, k) => from + (k / (points - 1)) * (to - from));
    const axis = of(key);
    const other = of(still.key);
    return figure({
      caption: `${column.print.replace(/[{}]/g, "")} at ${other?.symbol.replace("_", "") ?? still.key} = ${still.from}`,
      x: axis ? plain(axis) : key,
      y: label(column),
      lines: [{ x, y: numbers, colour: "#1b6ca8" }],
      at: { x: cell[along], ...(column.signed ? { y: 0 } : {}) },
    });
  };
  return (await Promise.all([one(0), one(1)])).join("");
}
