// One cell: how it moves, why it does, and what it sounds like.

import type { Answer } from "./ask";
import { figure, type Plot } from "./plots";
import { type About, type Column, escape, shown } from "./sweep";

/** Colours of the contact states slip, reverse, stick, free. */
const STATES = ["#1b6ca8", "#8a5a00", "#b5441a", "#6b2f8f"];
const STATE_NAMES = ["slip", "slip back", "stick", "flight"];
const SHADES = ["", "#f6ead2", "#f6d9cf", "#e6dcf0"];

type Pair = [number, number];

/** What an answer about a cell holds. */
export interface Cell {
  full: Pair[];
  flat: Pair[];
  frozen: Pair[];
  /** The type of a cell without eigenvalues. */
  none: string | null;
  equilibrium: { mu: number; slope: number; normal_force: number; x2: number; y1: number } | null;
  law: { velocity: Float64Array; mu: Float64Array } | null;
  /** The arrays of the motion by their names; of no length where there is none. */
  motion: Record<string, Float64Array>;
  period: number;
}

/** Takes an answer apart. */
export function taken(answer: Answer): Cell {
  const head = answer.head as {
    eigenvalues: { full?: Pair[] | null; flat?: Pair[]; frozen?: Pair[]; none?: string | null };
    equilibrium?: Cell["equilibrium"];
    law?: number;
    rows?: number;
    arrays?: string[];
    period?: number;
  };
  let at = 0;
  const next = (count: number) => answer.numbers.subarray(at, (at += count));
  const law = head.law ? { velocity: next(head.law), mu: next(head.law) } : null;
  const motion: Cell["motion"] = {};
  for (const name of head.arrays ?? []) motion[name] = next(head.rows ?? 0);
  const { full, flat, frozen, none } = head.eigenvalues;
  return {
    full: full ?? [],
    flat: flat ?? [],
    frozen: frozen ?? [],
    none: none ?? null,
    equilibrium: head.equilibrium ?? null,
    law,
    motion,
    period: head.period ?? NaN,
  };
}

const rightmost = (all: Pair[]): Pair | undefined =>
  all.reduce<Pair | undefined>((best, one) => (best === undefined || one[0] > best[0] || (one[0] === best[0] && one[1] > best[1]) ? one : best), undefined);

/** Why the equilibrium of a cell is what it is, in sentences made of its numbers. */
export function why(cell: Cell, type: string | undefined): string {
  const lead = [cell.full, cell.flat, cell.frozen].map(rightmost);
  const [full, flat, frozen] = lead;
  if (!full) return type ? `The type is ${type.replaceAll("_", " ")}: there is no sliding equilibrium with eigenvalues.` : "There are no eigenvalues here.";
  const rate = (pair: Pair | undefined) => (pair ? `${shown(pair[0], 3)} 1/s` : "–");
  const hertz = shown(Math.abs(full[1]) / (2 * Math.PI), 4);
  const at = cell.equilibrium;
  const place = at ? ` At the equilibrium μ = ${shown(at.mu, 3)}, its slope is ${shown(at.slope, 3)} s/m, and the normal force is ${shown(at.normal_force, 4)} N.` : "";
  const apart = cell.flat.length > 0 && cell.frozen.length > 0
    ? ` Without the slope of friction the largest growth rate is ${rate(flat)}, with the normal force frozen ${rate(frozen)}.`
    : "";
  const because: Record<string, string> = {
    stable: `Every mode decays: the slowest at ${rate(full)}, with ${hertz} Hz.`,
    negative_slope: `A mode of ${hertz} Hz grows at ${rate(full)}, and only because friction falls with velocity.`,
    mode_coupling: `Two modes have merged at ${hertz} Hz and one of them grows at ${rate(full)}: friction feeds the normal motion into the tangential one. The slope is not needed.`,
    coexistence: `A mode of ${hertz} Hz grows at ${rate(full)}, and would with either mechanism alone.`,
    interaction: `A mode of ${hertz} Hz grows at ${rate(full)}, and only with both mechanisms together.`,
  };
  return (because[type ?? ""] ?? `The leading mode has ${hertz} Hz and grows at ${rate(full)}.`) + apart + place;
}

/** The spectrum of evenly sampled values, as amplitudes over Hz. */
export function spectrum(t: ArrayLike<number>, values: ArrayLike<number>): { f: number[]; a: number[] } {
  const count = 1024;
  const [from, to] = [t[0] ?? 0, t[t.length - 1] ?? 0];
  if (!(to > from)) return { f: [], a: [] };
  const even = resampled(t, values, count);
  const mean = even.reduce((a, b) => a + b, 0) / count;
  // The window of Hann.
  const shaped = even.map((value, k) => (value - mean) * (1 - Math.cos((2 * Math.PI * k) / count)));
  const [f, a]: [number[], number[]] = [[], []];
  for (let n = 1; n < count / 4; n++) {
    let [re, im] = [0, 0];
    for (let k = 0; k < count; k++) {
      const angle = (2 * Math.PI * ((n * k) % count)) / count;
      re += (shaped[k] as number) * Math.cos(angle);
      im -= (shaped[k] as number) * Math.sin(angle);
    }
    f.push(n / (to - from));
    a.push((2 * Math.hypot(re, im)) / count);
  }
  return { f, a };
}

/** Values at so many evenly spaced times. */
export function resampled(t: ArrayLike<number>, values: ArrayLike<number>, count: number): number[] {
  const [from, to] = [t[0] ?? 0, t[t.length - 1] ?? 0];
  let k = 0;
  return Array.from({ length: count }, (_, n) => {
    const time = from + ((to - from) * n) / (count - 1);
    while (k + 2 < t.length && (t[k + 1] as number) < time) k++;
    const [a, b] = [t[k] as number, t[k + 1] as number];
    const part = b > a ? Math.min(Math.max((time - a) / (b - a), 0), 1) : 0;
    return (values[k] as number) * (1 - part) + (values[k + 1] as number) * part;
  });
}

/** Stretches of a contact state. */
function bands(cell: Cell): Plot["bands"] {
  const { t, state } = cell.motion;
  const all: NonNullable<Plot["bands"]> = [];
  if (!t || !state) return all;
  for (let k = 0; k + 1 < t.length; k++) {
    const colour = SHADES[state[k] as number];
    if (!colour) continue;
    const last = all[all.length - 1];
    if (last && last.to === t[k] && last.colour === colour) last.to = t[k + 1] as number;
    else all.push({ from: t[k] as number, to: t[k + 1] as number, colour });
  }
  return all;
}

/** The plots of a cell. */
export function plots(cell: Cell, belt: number): string {
  const { t, x2, vx2, y2, ax2, state } = cell.motion;
  const all: Plot[] = [];
  if (t && x2 && vx2 && y2 && ax2 && state && t.length > 1) {
    const mm = (values: Float64Array) => Array.from(values, (value) => 1000 * value);
    const ms = Array.from(t, (time) => 1000 * time);
    all.push({
      caption: `Velocity of the mass; shaded: ${STATE_NAMES.slice(1).join(", ")}`,
      x: "time, ms",
      y: "ẋ2, m/s",
      lines: [{ x: ms, y: vx2, colour: "#1b1d20" }],
      bands: (bands(cell) ?? []).map((band) => ({ ...band, from: 1000 * band.from, to: 1000 * band.to })),
      at: { y: belt },
    });
    const lines = STATES.map((colour, kind) => {
      const here = (k: number) => state[k] === kind || state[Math.max(0, k - 1)] === kind;
      return {
        x: mm(x2).map((value, k) => (here(k) ? value : NaN)),
        y: Array.from(vx2, (value, k) => (here(k) ? value : NaN)),
        colour,
        width: 1.4,
      };
    });
    all.push({ caption: `Phase portrait: ${STATE_NAMES.map((name, k) => `${name} ${["blue", "brown", "red", "violet"][k]}`).join(", ")}`, x: "x2, mm", y: "ẋ2, m/s", lines, at: { y: belt } });
    if (y2.some((value) => value > 0)) all.push({ caption: "Height above the belt", x: "time, ms", y: "y2, mm", lines: [{ x: ms, y: mm(y2), colour: "#6b2f8f" }] });
    const { f, a } = spectrum(t, ax2);
    all.push({ caption: "Spectrum of the tangential acceleration", x: "frequency, Hz", y: "amplitude, m/s²", lines: [{ x: f, y: a, colour: "#1b1d20" }] });
  }
  const marks = [
    ...cell.flat.map(([re, im]) => ({ x: re, y: im / (2 * Math.PI), colour: "#b5441a", hollow: true, title: "without the slope of friction" })),
    ...cell.frozen.map(([re, im]) => ({ x: re, y: im / (2 * Math.PI), colour: "#1b6ca8", hollow: true, title: "with the normal force frozen" })),
    ...cell.full.map(([re, im]) => ({ x: re, y: im / (2 * Math.PI), colour: "#1b1d20", title: "both mechanisms" })),
  ];
  if (marks.length > 0)
    all.push({ caption: "Eigenvalues: both mechanisms black; without slope red; normal force frozen blue", x: "growth rate, 1/s", y: "frequency, Hz", marks, at: { x: 0 } });
  if (cell.law) {
    const speeds = vx2 ? Array.from(vx2, (value) => Math.abs(belt - value)) : [];
    const used = speeds.length > 0 ? [{ from: Math.min(...speeds), to: Math.max(...speeds), colour: "#e3eefa" }] : [];
    const most = cell.law.velocity[cell.law.velocity.length - 1] ?? 0;
    all.push({
      caption: "Friction law; shaded: sliding speeds of the motion",
      x: "sliding speed, m/s",
      y: "μ",
      lines: [{ x: cell.law.velocity, y: cell.law.mu, colour: "#1b1d20", width: 1.6 }],
      bands: used.map((band) => ({ ...band, to: Math.min(band.to, most) })),
      ...(cell.equilibrium ? { marks: [{ x: belt, y: cell.equilibrium.mu, colour: "#b5441a", title: "equilibrium" }] } : {}),
    });
  }
  return all.map(figure).join("");
}

/** The numbers of a cell as rows of a table. */
export function rows(columns: Column[], values: Float64Array): string {
  return columns
    .map((column, k) => {
      const value = values[k] ?? NaN;
      if (Number.isNaN(value)) return "";
      const text = column.names.length > 0 ? (column.names[value] ?? "–").replaceAll("_", " ") : `${shown(value, 6)} ${escape(column.unit)}`;
      return `<tr title="${escape(column.meaning)}"><td>${escape(column.name)}</td><td>${text}</td></tr>`;
    })
    .join("");
}

/** The motion as a sound of two seconds, its main tone near 330 Hz; nothing where it does not move. */
export function sound(cell: Cell, rate: number): Float32Array | undefined {
  const { t, vx2 } = cell.motion;
  if (!t || !vx2 || t.length < 2) return undefined;
  const { f, a } = spectrum(t, vx2);
  const main = f[a.indexOf(Math.max(...a))];
  const length = (t[t.length - 1] as number) - (t[0] as number);
  if (!main || !(length > 0)) return undefined;
  const slower = main / 330;
  const once = Math.max(2, Math.round(length * slower * rate));
  const wave = resampled(t, vx2, Math.min(once, 1 << 19));
  const mean = wave.reduce((a, b) => a + b, 0) / wave.length;
  const most = wave.reduce((a, b) => Math.max(a, Math.abs(b - mean)), 0);
  if (!(most > 0)) return undefined;
  const out = new Float32Array(2 * rate);
  for (let k = 0; k < out.length; k++) {
    const fade = Math.min(1, k / (0.02 * rate), (out.length - k) / (0.05 * rate));
    out[k] = (0.25 * fade * ((wave[k % wave.length] as number) - mean)) / most;
  }
  return out;
}

/** Draws the two masses and the belt at a time of the motion. */
export function masses(canvas: HTMLCanvasElement, cell: Cell, belt: number, place: number): void {
  const context = canvas.getContext("2d");
  const { t, x2, y2, y1, state } = cell.motion;
  if (!context || !t || !x2 || !y2 || !y1 || !state || t.length === 0) return;
  const span = (values: Float64Array) => {
    let [low, high] = [Infinity, -Infinity];
    for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
    return [(low + high) / 2, Math.max(high - low, 1e-12)] as const;
  };
  const [mid, wide] = span(x2);
  const [high] = [Math.max(span(y2)[1], span(y1)[1])];
  const [rest] = span(y1);
  const k = Math.min(Math.max(place, 0), t.length - 1);
  const { width: w, height: h } = canvas;
  const x = w / 2 + (((x2[k] as number) - mid) / wide) * 0.35 * w;
  const floor = h - 30;
  const lower = floor - 34 - ((y2[k] as number) / high) * 22;
  const upper = floor - 92 - (((y1[k] as number) - rest) / high) * 22;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, w, h);
  // The belt, with marks that move with it.
  context.fillStyle = "#d9dce0";
  context.fillRect(0, floor, w, 12);
  context.strokeStyle = "#888";
  const moved = (((belt * (t[k] as number)) / wide) * 0.35 * w) % 24;
  context.beginPath();
  for (let mark = moved - 24; mark < w; mark += 24) {
    context.moveTo(mark, floor + 1);
    context.lineTo(mark + 8, floor + 11);
  }
  context.stroke();
  context.fillStyle = STATES[state[k] as number] ?? "#000";
  context.fillRect(x - 46, lower, 92, 34);
  context.fillStyle = "#50565d";
  context.fillRect(x - 30, upper, 60, 26);
  // The spring between both.
  context.strokeStyle = "#222";
  context.beginPath();
  for (let n = 0; n <= 8; n++) {
    const y = upper + 26 + ((lower - upper - 26) * n) / 8;
    context.lineTo(x + (n === 0 || n === 8 ? 0 : n % 2 ? 7 : -7), y);
  }
  context.stroke();
  context.fillStyle = "#000";
  context.font = "13px system-ui, sans-serif";
  context.fillText(`${STATE_NAMES[state[k] as number] ?? ""}, t = ${shown(1000 * ((t[k] as number) - (t[0] as number)), 3)} ms; motion not to scale`, 10, 18);
}

/** The columns that are shown of a cell. */
export function columnsOf(about: About, response: boolean): Column[] {
  const swept = new Set(about.axes.map((axis) => axis.key));
  return about.columns.filter((column) => !swept.has(column.name) && (response || !column.response));
}
