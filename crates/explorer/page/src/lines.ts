// Lines in a map: where a number has a round value, and where one class ends and another begins.

import type { Own } from "./own";
import type { Range } from "./state";

/** Cells row by row from below, and where they stand, if not evenly over the view. */
export interface Cells {
  wide: number;
  high: number;
  values: Float64Array;
  own?: Own;
}

/** A piece of a line: both ends as parts of the sides from the lower left. */
export type Piece = [number, number, number, number];

/** The places of cells along a side, as parts of it. */
export function places(count: number, range: Range, own: number[] | undefined): Float64Array {
  return Float64Array.from({ length: count }, (_, k) => (own ? ((own[k] as number) - range[0]) / (range[1] - range[0]) : (k + 0.5) / count));
}

/** Where a number has a value, straight between neighbours (marching squares); nothing where one of four is undefined, or where they
 * differ by more than `most`: an angle goes on at the other side there. */
export function isoline({ wide, high, values }: Cells, x: Float64Array, y: Float64Array, level: number, most = Infinity): Piece[] {
  const pieces: Piece[] = [];
  for (let row = 0; row + 1 < high; row++) {
    for (let at = 0; at + 1 < wide; at++) {
      const k = row * wide + at;
      // Around the cell: lower left, lower right, upper right, upper left.
      const corners = [values[k], values[k + 1], values[k + wide + 1], values[k + wide]] as [number, number, number, number];
      const [low, high] = [Math.min(...corners), Math.max(...corners)];
      // A corner that is undefined makes both so.
      if (!(low < level && level <= high) || !(high - low <= most)) continue;
      const ends: [number, number][] = [];
      const [left, right, below, above] = [x[at], x[at + 1], y[row], y[row + 1]] as [number, number, number, number];
      const around: [number, number][] = [[left, below], [right, below], [right, above], [left, above]];
      for (let side = 0; side < 4; side++) {
        const [a, b] = [corners[side] as number, corners[(side + 1) % 4] as number];
        if (a < level === b < level) continue;
        const part = (level - a) / (b - a);
        const [[ax, ay], [bx, by]] = [around[side], around[(side + 1) % 4]] as [[number, number], [number, number]];
        ends.push([ax + part * (bx - ax), ay + part * (by - ay)]);
      }
      for (let end = 0; end + 1 < ends.length; end += 2) pieces.push([...(ends[end] as [number, number]), ...(ends[end + 1] as [number, number])]);
    }
  }
  return pieces;
}

/** Where neighbouring cells have other classes; nothing next to what is undefined. */
export function borders({ wide, high, values }: Cells, x: Float64Array, y: Float64Array): Piece[] {
  const pieces: Piece[] = [];
  // Cells end half way to the next.
  const edges = (at: Float64Array) => Float64Array.from({ length: at.length + 1 }, (_, k) => (k === 0 ? 0 : k === at.length ? 1 : ((at[k - 1] as number) + (at[k] as number)) / 2));
  const [across, up] = [edges(x), edges(y)];
  const differ = (a: number | undefined, b: number | undefined) => a !== b && Number.isFinite(a) && Number.isFinite(b);
  for (let row = 0; row < high; row++) {
    for (let at = 0; at < wide; at++) {
      const here = values[row * wide + at];
      const [left, right, below, above] = [across[at], across[at + 1], up[row], up[row + 1]] as [number, number, number, number];
      if (at + 1 < wide && differ(here, values[row * wide + at + 1])) pieces.push([right, below, right, above]);
      if (row + 1 < high && differ(here, values[(row + 1) * wide + at])) pieces.push([left, above, right, above]);
    }
  }
  return pieces;
}
