// The map along its two sides through a cell.

import type { Engines } from "./ask";
import { figure } from "./plots";
import type { State } from "./state";
import { type About, type Column, plain } from "./sweep";

/** Values of a cut. */
const POINTS = { eigenvalues: 201, transients: 65 };

/** What is drawn where the map shows classes. */
const INSTEAD = "growth_rate";

/** Plots along both sides over what is visible; of a map of classes, of its growth rates. */
export async function cuts(engines: Engines, about: About, state: State, group: number): Promise<string> {
  const { cell } = state;
  const shown = about.columns.find((column) => column.name === state.quantity);
  const column: Column | undefined = shown && shown.names.length === 0 ? shown : about.columns.find((one) => one.name === INSTEAD);
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
      y: column.unit ? `${column.name}, ${column.unit}` : column.name,
      lines: [{ x, y: numbers, colour: "#1b6ca8" }],
      at: { x: cell[along], ...(column.signed ? { y: 0 } : {}) },
    });
  };
  return (await Promise.all([one(0), one(1)])).join("");
}
