// Places of the two-mass model that are worth a look, as addresses.

import { is_allowed, parameter, sides, type State, whole } from "./state";
import type { About } from "./sweep";

/** A place: dynamic and static friction coefficient, what else has another value than the sweep's, and what is to be seen there. */
export interface Place {
  title: string;
  words: string;
  mu_d: number;
  mu_s: number;
  at: Record<string, number>;
  /** What the engines say of it; tests compare. */
  type: string;
  regime: string;
}

/** What all of them have, beside the law `bilinear` and the masses and stiffnesses of Table 1. */
const EVERYWHERE = { theta: 0.01, knee_velocity: 5 };

const ALL: Place[] = [
  {
    title: "Quiet",
    words: "Little friction, the same at every speed. Both pairs of eigenvalues lie to the left: any disturbance dies away.",
    ...{ mu_d: 0.1, mu_s: 0.1, at: { belt_velocity: 3 }, type: "stable", regime: "equilibrium" },
  },
  {
    title: "Negative slope",
    words: "Friction falls with the speed and feeds the tangential mode like a negative damper. The motion grows until the body sticks once in every period.",
    ...{ mu_d: 0.05, mu_s: 0.2, at: { belt_velocity: 1 }, type: "negative_slope", regime: "stick_slip" },
  },
  {
    title: "Mode coupling",
    words: "Friction is the same at every speed, so no slope feeds anything. It couples the tangential and the normal mode: their frequencies meet, and one of the two grows.",
    ...{ mu_d: 0.4, mu_s: 0.4, at: { belt_velocity: 3 }, type: "mode_coupling", regime: "detaching_stick_slip" },
  },
  {
    title: "Both at once",
    words: "High friction that falls steeply. Each mechanism alone would make it unstable, as both counterfactuals of the eigenvalues show.",
    ...{ mu_d: 0.1, mu_s: 0.5, at: { belt_velocity: 1.5 }, type: "coexistence", regime: "stick_slip" },
  },
  {
    title: "Neither alone",
    words: "Friction rises with the speed, which damps the tangential motion alone. Without the slope it would be stable, and with the slope alone, too; both together are not.",
    ...{ mu_d: 0.35, mu_s: 0.1, at: { belt_velocity: 0.5 }, type: "interaction", regime: "detaching_stick_slip" },
  },
  {
    title: "Stable when left alone",
    words: "Beyond the knee the slope is gone, and the equilibrium is stable. A small kick dies away; the next place starts with a larger one.",
    ...{ mu_d: 0.1, mu_s: 0.3, at: { belt_velocity: 5.5 }, type: "stable", regime: "equilibrium" },
  },
  {
    title: "Unstable when struck",
    words: "The place before, started with a kick faster than the belt. The motion reaches down to where friction is high and never comes to rest: two stable states for one set of parameters.",
    ...{ mu_d: 0.1, mu_s: 0.3, at: { belt_velocity: 5.5, start_velocity: 7 }, type: "stable", regime: "slip_reversal" },
  },
  {
    title: "Damping that steadies",
    words: "Both directions are damped alike. Friction of 0.2 is not enough to couple the modes.",
    ...{ mu_d: 0.2, mu_s: 0.2, at: { belt_velocity: 3, c1: 2, c2: 2 }, type: "stable", regime: "equilibrium" },
  },
  {
    title: "More damping, less stable",
    words: "The place before with thirty times the damping in the normal direction. Unequal damping brings the instability down to less than half the friction: the destabilisation paradox.",
    ...{ mu_d: 0.2, mu_s: 0.2, at: { belt_velocity: 3, c1: 2, c2: 60 }, type: "mode_coupling", regime: "stick_slip" },
  },
  {
    title: "Off the belt",
    words: "Much friction on a fast belt: the body leaves the belt in every period and comes down on it again. Look at the force in the motion, which is zero in flight.",
    ...{ mu_d: 0.6, mu_s: 0.2, at: { belt_velocity: 5.5 }, type: "mode_coupling", regime: "detaching" },
  },
];

export const PLACES: Place[] = ALL.map((place) => ({ ...place, at: { ...EVERYWHERE, ...place.at } }));

/** The state of a place; nothing where the sweep does not have all that it needs. */
export function stateOf(about: About, place: Place): State | undefined {
  const known = sides(about).map((axis) => axis.key);
  const others = about.axes.every((axis) => ["mu_s", "mu_d"].includes(axis.key) || axis.key in place.at);
  const allowed = Object.entries(place.at).every(([key, value]) => {
    const of = parameter(about, key);
    return of !== undefined && is_allowed(of, value);
  });
  if (about.law !== "bilinear" || !known.includes("mu_s") || !known.includes("mu_d") || !others || !allowed) return undefined;
  return {
    ...{ x: "mu_d", y: "mu_s", rangeX: whole(about, "mu_d"), rangeY: whole(about, "mu_s") },
    ...{ quantity: "type", at: { ...place.at }, hidden: [], beside: "", hiddenBeside: [], lines: false, strokes: [], cut: null, cell: [place.mu_d, place.mu_s] },
  };
}
