// What the sweep is, as the engine says it.

/** A parameter. */
export interface Parameter {
  key: string;
  symbol: string;
  unit: string;
  meaning: string;
  range: string;
  least: number | null;
  most: number | null;
  /** Whether the ends themselves lie outside. */
  open?: boolean;
}

/** A parameter that the sweep varies. */
export interface Axis extends Parameter {
  values: (number | string)[];
  log: boolean;
  numbers: boolean;
}

/** A parameter with one value. */
export interface Fixed extends Parameter {
  value: number;
  section: string;
}

/** A column of a map. */
export interface Column {
  name: string;
  unit: string;
  meaning: string;
  print: string;
  signed: boolean;
  /** Whether its values are angles of a whole turn, degrees. */
  circle?: boolean;
  response: boolean;
  names: string[];
}

/** What the engine says of a sweep. */
export interface About {
  title: string;
  version: string;
  axes: Axis[];
  fixed: Fixed[];
  law: string;
  responds: boolean;
  asks_for_response: boolean;
  until_settled: boolean;
  columns: Column[];
}

/** A class of cells: its name in tables, in words, and its colour. */
export interface Class {
  name: string;
  label: string;
  fill: string;
}

/** What the page is given beside the engines. */
export interface Given {
  /** The sweep as its tiles have it, a text: numbers that JavaScript writes again would have other digits. */
  description: string;
  file: string;
  classes: Record<string, Class[]>;
}

/** The first and the last number of an axis. */
export function ends(axis: Axis): [number, number] {
  const numbers = axis.values.filter((value): value is number => typeof value === "number");
  return [Math.min(...numbers), Math.max(...numbers)];
}

/** A symbol such as `mu_s` in HTML: what follows the line stands below. */
export function symbol(of: { symbol: string }): string {
  const [name, below] = of.symbol.split("_");
  return below === undefined ? escape(of.symbol) : `${escape(name ?? "")}<sub>${escape(below)}</sub>`;
}

/** A symbol on one line. */
export function plain(of: { symbol: string; unit: string }): string {
  return of.symbol.replace("_", "") + (of.unit ? `, ${of.unit}` : "");
}

/** Text that may stand in HTML. */
export function escape(text: string): string {
  return text.replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`);
}

/** A number for people. */
export function shown(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(digits - 1).replace("e+", "e");
  return String(Number(value.toPrecision(digits)));
}
