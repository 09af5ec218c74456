//! The first place in a step where a function of every lane falls below zero: sampled, then solved.

use std::ops::Not;

use pulp::Simd;

use super::polynomial::{at_one, value, value_and_slope, value_slope_and_bend, value_soon};
use super::vector::{Mask, Scalar, Vector};
use crate::kernel::crossing::{DIP, DIP_ITERATIONS, SAMPLES, SOLVER_ITERATIONS};
use crate::kernel::source::Precision;

/// The least part of the way between two samples at which a root is looked for first.
const LEAST: f64 = 1e-3;

/// Where an event function falls below zero.
pub struct Bracket<S: Simd, T: Scalar<S>, const K: usize> {
    /// A place where it is still positive.
    pub low: Vector<S, T, K>,
    /// A place where it no longer is.
    pub high: Vector<S, T, K>,
    /// Between them on the parabola through one sample more; 0 when it is not positive from the start, 2 when it stays positive.
    pub estimate: Vector<S, T, K>,
}

/// The first sample that is not positive, and the one before. `lead` is the first coefficient that counts, `has_root`
/// says that it is not the first.
#[inline(always)]
pub fn bracket<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    has_root: Mask<S, T, K>,
    lead: Vector<S, T, K>,
) -> Bracket<S, T, K> {
    let (zero, never) = (lead.like(0.0), lead.like(2.0));
    let width = lead.like(1.0 / SAMPLES as f64);
    let (mut high, mut at_low, mut at_high, mut behind) = (never, lead.like(1.0), zero, zero);
    let mut t = lead.like(1.0);
    let [mut here, slope] = at_one(c);
    let (ahead, falls) = (slope * width, -(c[1] * width));
    let mut samples = [here; SAMPLES + 1];
    let mut after = here + ahead;
    // The second difference less the value over DIP: not negative where the function may dip below zero.
    let weight = lead.like(2.0 + 1.0 / DIP);
    let half_weight = lead.like(1.0 + 0.5 / DIP);
    let mut depth = -never;
    // From the last sample to the first: what is set last is the first crossing.
    for i in (1..=SAMPLES).rev() {
        let down = here.not_positive();
        high = down.select(t, high);
        t = t - width;
        let before = if i == 1 { c[0] } else { value_soon(c, 0, t) };
        samples[i - 1] = before;
        // Behind a root at zero the line says nothing: the middle.
        let start = if i == 1 { has_root.select(here.abs(), before) } else { before };
        at_low = down.select(start, at_low);
        at_high = down.select(here, at_high);
        behind = down.select(after, behind);
        let bent = if i < SAMPLES {
            weight.fnma(here, before + after)
        } else {
            half_weight.fnma(here, before + ahead)
        };
        let rises = if i == 1 { down.or(has_root) } else { down };
        depth = rises.select(depth, depth.max(bent));
        after = here;
        here = before;
    }
    let at_start = half_weight.fnma(here, after + falls);
    depth = has_root.select(depth, depth.max(at_start));
    let mut low = high - width;
    let fall = at_low - at_high;
    let inside = high.less(never);
    let per_fall = lead.like(1.0) / zero.less(fall).select(fall, width);
    // On the straight line, and from there towards the parabola through one sample more.
    let along = at_low * per_fall;
    let bend = (at_low - at_high) + (behind - at_high);
    let nearer = along - (along - along * along) * lead.like(0.5) * bend * per_fall;
    let straight = has_root.or(inside.not());
    let part = straight.select(along, nearer.max(lead.like(LEAST)).min(lead.like(1.0)));
    let mut estimate = inside.select(width.fma(part, low), never);
    if zero.at_most(depth).any() {
        let [sample, curvature] = dips(&samples, ahead, falls, has_root);
        let dips = sample.less(high);
        if dips.any() {
            let mut t = sample;
            for _ in 0..DIP_ITERATIONS {
                let [_, slope] = value_and_slope(c, t);
                t = (t - slope * (width * width) / curvature).max(sample - width).min(sample + width);
            }
            let below = dips.and(value(c, t).not_positive());
            low = below.select((sample - width).max(zero), low);
            high = below.select(t, high);
            estimate = below.select((low + t) * t.like(0.5), estimate);
        }
    }
    Bracket { low, high, estimate: lead.not_positive().select(zero, estimate) }
}

/// The first sample near which a function may dip below zero, 2 for none, and its second difference there.
#[inline(always)]
fn dips<S: Simd, T: Scalar<S>, const K: usize>(
    samples: &[Vector<S, T, K>; SAMPLES + 1],
    ahead: Vector<S, T, K>,
    falls: Vector<S, T, K>,
    has_root: Mask<S, T, K>,
) -> [Vector<S, T, K>; 2] {
    let (zero, two, dip) = (falls.like(0.0), falls.like(2.0), falls.like(DIP));
    let (mut sample, mut curvature) = (two, falls.like(1.0));
    // Lowest in the middle, or at the end on its way up: it may dip below zero in between.
    for i in (1..=SAMPLES).rev() {
        let (before, here) = (samples[i - 1], samples[i]);
        let climbs = if i < SAMPLES { samples[i + 1] - here } else { ahead };
        let bent = if i < SAMPLES { (before - here) + climbs } else { two * ((before - here) + climbs) };
        let lowest = here.less(before).and(zero.less(climbs)).and(here.at_most(bent * dip));
        sample = lowest.select(two.like(i as f64 / SAMPLES as f64), sample);
        curvature = lowest.select(bent, curvature);
    }
    // Lowest at the start, on its way down.
    let bent = two * ((samples[1] - samples[0]) + falls);
    let lowest = zero.less(falls).and(samples[0].at_most(samples[1])).and(samples[0].at_most(bent * dip));
    let lowest = lowest.and(has_root.not());
    [lowest.select(zero, sample), lowest.select(bent, curvature)]
}

/// The root in a bracket by Halley's method that stays inside, for the function without its root of some order at
/// zero.
#[inline(always)]
pub fn refine<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    order: Vector<S, T, K>,
    bracket: &Bracket<S, T, K>,
) -> Vector<S, T, K> {
    let zero = c[0].like(0.0);
    let (mut low, mut high, mut t) = (bracket.low, bracket.high, bracket.estimate);
    let mut active = zero.less(t).and(t.at_most(zero.like(1.0)));
    let two = zero.like(2.0);
    let squares = order.fma(order, order);
    // Half the cube root of the rounding: the method cubes its error.
    let enough = zero.like(match T::PRECISION {
        Precision::F32 => 2.5e-3,
        Precision::F64 => 3e-6,
    });
    for _ in 0..SOLVER_ITERATIONS {
        let [here, slope, bend] = value_slope_and_bend(c, t);
        let positive = zero.less(here);
        low = positive.select(t, low);
        high = positive.select(high, t);
        // Of f = g/t^m: t − f/f′ / (1 − f f″/(2 f′²)), numerator and denominator times powers of t.
        let scaled = slope * t - order * here;
        let curved = (bend * t - two * order * slope).fma(t, squares * here);
        let denominator = two * scaled * scaled - here * curved;
        let down = scaled.less(zero).and(zero.less(denominator));
        let halley = t - two * here * t * scaled / down.select(denominator, zero.like(1.0));
        // At 0 the root that does not count is all there is to see.
        let good = down.and(low.at_most(halley)).and(halley.at_most(high)).and(zero.less(halley));
        let next = good.select(halley, (low + high) * zero.like(0.5));
        let change = (next - t).abs();
        t = active.select(next, t);
        active = active.and(enough.less(change));
        if !active.any() {
            break;
        }
    }
    t
}
