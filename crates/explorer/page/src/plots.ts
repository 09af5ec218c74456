// Small plots as SVG, black on white in either scheme.

import { escape, shown } from "./sweep";

/** A line of a plot. */
export interface Line {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  colour: string;
  width?: number;
}

/** A mark of a plot. */
export interface Mark {
  x: number;
  y: number;
  colour: string;
  hollow?: boolean;
  title?: string;
}

/** What a plot shows. */
export interface Plot {
  caption: string;
  x: string;
  y: string;
  lines?: Line[];
  marks?: Mark[];
  /** Ranges along x that are shaded. */
  bands?: { from: number; to: number; colour: string }[];
  /** Lines across at a value of x or y. */
  at?: { x?: number; y?: number };
}

const [W, H] = [330, 220];
const [LEFT, RIGHT, TOP, BOTTOM] = [58, 10, 8, 38];

/** Steps of an axis: 1, 2 or 5 times a power of ten. */
export function ticks(low: number, high: number, about: number): number[] {
  const rough = (high - low) / about;
  // Neighbouring numbers have no ticks between them: counting on would not go on.
  const closest = 1e-12 * Math.max(Math.abs(low), Math.abs(high));
  if (!(rough > closest) || !Number.isFinite(rough)) return Number.isFinite(low) ? [low] : [];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10) * power;
  const first = Math.ceil(low / step - 1e-9);
  const all: number[] = [];
  for (let k = first; k * step <= high + 1e-9 * step; k++) all.push(k * step);
  return all;
}

function bounds(values: Iterable<number>): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  if (low === high) return [low - (Math.abs(low) || 1) * 0.5, high + (Math.abs(high) || 1) * 0.5];
  const margin = 0.05 * (high - low);
  return [low - margin, high + margin];
}

function* all(plot: Plot, side: "x" | "y"): Generator<number> {
  for (const line of plot.lines ?? []) yield* Array.from(line[side]);
  for (const mark of plot.marks ?? []) yield mark[side];
  const at = plot.at?.[side];
  if (at !== undefined) yield at;
}

/** The plot as a figure. */
export function figure(plot: Plot): string {
  const [x0, x1] = bounds(all(plot, "x"));
  const [y0, y1] = bounds(all(plot, "y"));
  const px = (x: number) => LEFT + ((x - x0) / (x1 - x0)) * (W - LEFT - RIGHT);
  const py = (y: number) => H - BOTTOM - ((y - y0) / (y1 - y0)) * (H - TOP - BOTTOM);
  const parts: string[] = [];
  for (const { from, to, colour } of plot.bands ?? []) {
    const [a, b] = [px(Math.max(from, x0)), px(Math.min(to, x1))];
    if (b > a) parts.push(`<rect x="${a.toFixed(1)}" y="${TOP}" width="${(b - a).toFixed(1)}" height="${H - TOP - BOTTOM}" fill="${colour}"/>`);
  }
  for (const tick of ticks(x0, x1, 4)) {
    parts.push(`<path d="M${px(tick).toFixed(1)} ${H - BOTTOM}v4" stroke="#000"/><text x="${px(tick).toFixed(1)}" y="${H - BOTTOM + 15}" text-anchor="middle">${shown(tick, 4)}</text>`);
  }
  for (const tick of ticks(y0, y1, 4)) {
    parts.push(`<path d="M${LEFT} ${py(tick).toFixed(1)}h-4" stroke="#000"/><text x="${LEFT - 6}" y="${(py(tick) + 3.5).toFixed(1)}" text-anchor="end">${shown(tick, 4)}</text>`);
  }
  if (plot.at?.x !== undefined) parts.push(`<path d="M${px(plot.at.x).toFixed(1)} ${TOP}V${H - BOTTOM}" stroke="#888" stroke-dasharray="3 2"/>`);
  if (plot.at?.y !== undefined) parts.push(`<path d="M${LEFT} ${py(plot.at.y).toFixed(1)}H${W - RIGHT}" stroke="#888" stroke-dasharray="3 2"/>`);
  for (const line of plot.lines ?? []) {
    let path = "";
    let pen = false;
    for (let k = 0; k < line.x.length; k++) {
      const [x, y] = [line.x[k] as number, line.y[k] as number];
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        pen = false;
        continue;
      }
      path += `${pen ? "L" : "M"}${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
      pen = true;
    }
    parts.push(`<path d="${path}" fill="none" stroke="${line.colour}" stroke-width="${line.width ?? 1.1}" stroke-linejoin="round"/>`);
  }
  for (const mark of plot.marks ?? []) {
    const fill = mark.hollow ? "none" : mark.colour;
    const title = mark.title ? `<title>${escape(mark.title)}</title>` : "";
    parts.push(`<circle cx="${px(mark.x).toFixed(1)}" cy="${py(mark.y).toFixed(1)}" r="4" fill="${fill}" stroke="${mark.colour}" stroke-width="1.5">${title}</circle>`);
  }
  const frame = `<rect x="${LEFT}" y="${TOP}" width="${W - LEFT - RIGHT}" height="${H - TOP - BOTTOM}" fill="none" stroke="#000"/>`;
  const names =
    `<text x="${(LEFT + W - RIGHT) / 2}" y="${H - 6}" text-anchor="middle">${escape(plot.x)}</text>` +
    `<text transform="translate(11 ${(TOP + H - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">${escape(plot.y)}</text>`;
  return (
    `<figure><svg viewBox="0 0 ${W} ${H}" role="img" aria-label="${escape(plot.caption)}" font-family="system-ui, sans-serif" font-size="10" fill="#000">` +
    `${parts.join("")}${frame}${names}</svg><figcaption>${escape(plot.caption)}</figcaption></figure>`
  );
}
