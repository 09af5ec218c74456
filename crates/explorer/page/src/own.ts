// The grid of a finished run: its cells stand where its axes have values, evenly or not.

import type { Column, About } from "./sweep";
import type { Range, State } from "./state";
import type { Run } from "./program";

/** The values of a run on both sides of a view, from the lower left. */
export interface Own {
  x: number[];
  y: number[];
  /** Whether the view is that of the whole run. */
  whole: boolean;
}

/** More values than a question has room for. */
const MOST_VALUES = 20000;

/** The cells of a run that a view shows; nothing where it shows something that the run has not. */
export function own(about: About, run: Run, state: State, column: Column): Own | null {
  if (column.response && !run.response) return null;
  for (const [key, value] of Object.entries(state.at)) {
    const axis = about.axes.find((one) => one.key === key);
    if (!axis?.values.includes(value)) return null;
  }
  const [x, y] = [within(about, state.x, state.rangeX), within(about, state.y, state.rangeY)];
  if (!x || !y || x.values.length + y.values.length > MOST_VALUES) return null;
  return { x: x.values, y: y.values, whole: x.whole && y.whole };
}

/** The values of an axis within a range, and the next beyond each end. */
function within(about: About, key: string, [low, high]: Range): { values: number[]; whole: boolean } | null {
  const axis = about.axes.find((one) => one.key === key);
  const values = axis?.values.filter((value): value is number => typeof value === "number").sort((a, b) => a - b) ?? [];
  const from = values.findIndex((value) => value >= low);
  const past = values.findIndex((value) => value > high);
  if (values.length === 0 || from < 0) return null;
  const kept = values.slice(Math.max(0, from - 1), past < 0 ? values.length : past + 1);
  return { values: kept, whole: values[0] === low && values.at(-1) === high };
}

/** For each of `count` pixels of a range the nearest of some rising values: its place. */
export function nearest(values: number[], [low, high]: Range, count: number): Int32Array {
  const places = new Int32Array(count);
  let at = 0;
  for (let pixel = 0; pixel < count; pixel++) {
    const here = low + ((pixel + 0.5) / count) * (high - low);
    while (at + 1 < values.length && Math.abs((values[at + 1] as number) - here) < Math.abs((values[at] as number) - here)) at++;
    places[pixel] = at;
  }
  return places;
}

/** The question about rows of a run's own cells. */
export function ownRegion(state: State, column: Column, { x, y }: Own, [row, rows]: [number, number]): object {
  const side = (key: string, values: number[]) => ({ key, from: values[0], to: values.at(-1), points: values.length, values });
  return { ask: "region", x: side(state.x, x), y: side(state.y, y.slice(row, row + rows)), at: state.at, response: column.response, columns: [column.name] };
}
