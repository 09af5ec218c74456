// Colours of cells: classes by the colours of the printed figures, numbers by ramps that are even in lightness.

import { type Class, type Column, shown } from "./sweep";

/** Red, green, blue, each from 0 to 255. */
export type Colour = [number, number, number];

/** Anchors of ramps: cividis (Nuñez, Anderton, Renslow 2018) for sizes, a diverging one about zero for what has a sign (blue grows and ochre decays, as in print), and
 * one that closes the circle for angles (vikO of F. Crameri, every fourth colour of `crates/figure/src/cyclic.rs`). */
const CIVIDIS = ["#00224e", "#2a3f6d", "#575d6d", "#7d7c78", "#a59c74", "#d2c060", "#fee838"];
const ABOUT_ZERO = ["#d8a83c", "#f3d691", "#faead0", "#f7f7f7", "#a7cfe4", "#2f79b5", "#053061"];
const CIRCLE = ["#4f1a3d", "#3f2c5b", "#334c80", "#4575a1", "#769fbc", "#b0bec8", "#d5beb3", "#d7a286", "#c47a55", "#a14b2c", "#7a251e", "#601628", "#4f1a3d"];

/** What is undefined, or hidden. */
export const NOTHING: Colour = [255, 255, 255];
/** What is undefined beside a ramp whose middle is nearly white. */
const BESIDE_ZERO: Colour = [154, 154, 154];

/** A colour of a style sheet. */
export function parsed(hex: string): Colour {
  const value = Number.parseInt(hex.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

function ramp(anchors: string[], part: number): Colour {
  const at = Math.min(Math.max(part, 0), 1) * (anchors.length - 1);
  const k = Math.min(Math.floor(at), anchors.length - 2);
  const [a, b] = [parsed(anchors[k] as string), parsed(anchors[k + 1] as string)];
  const mix = (i: 0 | 1 | 2) => Math.round(a[i] + (at - k) * (b[i] - a[i]));
  return [mix(0), mix(1), mix(2)];
}

/** How the values of a column are shown. */
export interface Scale {
  colour(value: number): Colour;
  /** The colour of what is undefined. */
  nothing: Colour;
  /** Its classes; none of a column of numbers. */
  classes: Class[];
  /** The ends of a column of numbers. */
  ends: [number, number];
}

/** The scale of a column whose finite values lie between these ends. */
export function scale(column: Column, classes: Class[] | undefined, [low, high]: [number, number], hidden: string[]): Scale {
  if (column.names.length > 0) {
    const known = column.names.map((name, place) => {
      const found = classes?.find((one) => one.name === name);
      return found ?? { name, label: name.replaceAll("_", " "), fill: hex(ramp(CIVIDIS, place / Math.max(1, column.names.length - 1))) };
    });
    const fills = known.map((one): Colour => (hidden.includes(one.name) ? NOTHING : parsed(one.fill)));
    return { colour: (value) => (Number.isNaN(value) ? NOTHING : (fills[value] ?? NOTHING)), nothing: NOTHING, classes: known, ends: [0, 0] };
  }
  // An angle has the whole circle.
  const circle = column.circle === true;
  const both: [number, number] = circle ? [-180, 180] : column.signed ? [-Math.max(Math.abs(low), Math.abs(high)), Math.max(Math.abs(low), Math.abs(high))] : [low, high];
  const length = both[1] - both[0];
  const anchors = circle ? CIRCLE : column.signed ? ABOUT_ZERO : CIVIDIS;
  const nothing = anchors === ABOUT_ZERO ? BESIDE_ZERO : NOTHING;
  const colour = (value: number) => (Number.isFinite(value) ? ramp(anchors, length > 0 ? (value - both[0]) / length : 0.5) : nothing);
  return { colour, nothing, classes: [], ends: both };
}

/** A colour as style sheets write it. */
export function hex([r, g, b]: Colour): string {
  return `#${((r << 16) | (g << 8) | b).toString(16).padStart(6, "0")}`;
}

/** The words of the ends of a scale. */
export function words(column: Column, [low, high]: [number, number]): [string, string] {
  const unit = column.unit ? ` ${column.unit}` : "";
  return [shown(low, 3) + unit, shown(high, 3) + unit];
}
