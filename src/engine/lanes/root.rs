//! The first place in a step where a function of every lane falls below zero: sampled, then solved.

use std::hint::black_box;
use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::polynomial::{at_one, soon_to, value_and_slope, value_slope_and_bend, value_soon};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::precision::Precision;

/// Samples of an event function inside a step that the bound does not clear.
pub const SAMPLES: usize = 8;

/// A sample lower than both its neighbours is followed to the minimum when it is below this part of their second
/// difference: that of a parabola is no deeper than an eighth of it.
pub const DIP: f64 = 0.25;

/// Iterations that follow it: each leaves some tenth of the distance.
pub const DIP_ITERATIONS: usize = 3;

/// Iterations of the bracketed Newton solver.
pub const SOLVER_ITERATIONS: usize = 12;

/// The least part of the way between two samples at which a root is looked for first.
const LEAST: f64 = 1e-3;

/// The part of the step by which a bracket may be off.
pub const SLACK: f64 = 1e-4;

/// Where an event function falls below zero, or rises beyond its span.
pub struct Bracket<S: Simd, T: Scalar<S>> {
    /// A place where it is still positive, within [`SLACK`].
    pub low: Vector<S, T>,
    /// A place where it no longer is, likewise.
    pub high: Vector<S, T>,
    /// Between them on the parabola through one sample more; 0 when it is not positive from the start, 2 when it stays positive.
    pub estimate: Vector<S, T>,
    /// Lanes whose function rises beyond its span there.
    pub beyond: Mask<S, T>,
}

/// The distance of a value to the nearer end of `[0, span]`, negative outside; the value itself without a span.
#[inline(always)]
fn within<S: Simd, T: Scalar<S>, const SPAN: bool>(value: Vector<S, T>, span: Vector<S, T>) -> Vector<S, T> {
    if SPAN { value.min(span - value) } else { value }
}

/// A walk over the samples of a function from the last to the first, so that the crossing that it keeps in the end is the
/// first.
struct Walk<S: Simd, T: Scalar<S>> {
    /// The present sample, and the function there.
    t: Vector<S, T>,
    value: Vector<S, T>,
    inside: Vector<S, T>,
    /// The function at the sample after it.
    value_after: Vector<S, T>,
    /// The first sample outside, 2 for none, and the function there, one before and one after.
    high: Vector<S, T>,
    at_high: Vector<S, T>,
    at_low: Vector<S, T>,
    behind: Vector<S, T>,
    /// The largest second difference less the way to the nearer end over [`DIP`], up to the first crossing. If it is
    /// negative, the function dips out nowhere between samples. Besides that, the same number without the first sample.
    depth: Vector<S, T>,
    depth_before: Vector<S, T>,
    /// How much of the present sample is in that.
    weight: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Walk<S, T> {
    /// On to the sample before, where the function has this value.
    #[inline(always)]
    fn back<const SPAN: bool>(&mut self, value: Vector<S, T>, span: Vector<S, T>) {
        let down = self.inside.not_positive();
        self.high = down.select(self.t, self.high);
        self.at_high = down.select(self.value, self.at_high);
        self.at_low = down.select(value, self.at_low);
        self.behind = down.select(self.value_after, self.behind);
        let inside = within::<S, T, SPAN>(value, span);
        self.depth_before = self.depth;
        let around = value + self.value_after;
        let bent = if SPAN {
            // Towards either end.
            self.weight.fnma(self.inside, self.value.fnma(value.like(2.0), around).abs())
        } else {
            self.weight.fnma(self.value, around)
        };
        self.depth = down.select(value.like(-1.0), self.depth.max(bent));
        self.weight = value.like(weight(SPAN, 1.0));
        self.value_after = self.value;
        (self.inside, self.value) = (inside, value);
        self.t = self.t - value.like(1.0 / SAMPLES as f64);
    }
}

/// See [`Walk::weight`]: without a span the present sample's own part in a second difference is in it; at an end, where a
/// slope stands in for a sample, half of the difference is seen (`part`).
const fn weight(span: bool, part: f64) -> f64 {
    if span { part / DIP } else { 2.0 + part / DIP }
}

/// The first sample that is not inside `[0, span]` (with `SPAN`; else that is not positive), and the one before. `lead` is
/// the first coefficient that counts (the distance to the nearer end where it is the value at the start), `has_root` says
/// that it is not the first.
#[inline(always)]
pub fn bracket<S: Simd, T: Scalar<S>, const N: usize, const SPAN: bool>(
    c: &[Vector<S, T>; N],
    has_root: Mask<S, T>,
    lead: Vector<S, T>,
    span: Vector<S, T>,
) -> Bracket<S, T> {
    let (zero, one, never, half) = (lead.like(0.0), lead.like(1.0), lead.like(2.0), lead.like(0.5));
    let width = lead.like(1.0 / SAMPLES as f64);
    let [last, slope] = at_one(c);
    let (ahead, falls) = (slope * width, -(c[1] * width));
    let mut walk = Walk {
        t: one,
        value: last,
        inside: within::<S, T, SPAN>(last, span),
        value_after: last + ahead,
        high: never,
        at_high: zero,
        at_low: one,
        behind: zero,
        depth: -one,
        depth_before: -one,
        weight: lead.like(weight(SPAN, 0.5)),
    };
    let mut samples = [last; SAMPLES + 1];
    // Loops, as their code is short. In the first half of the step what lies above degree 7 is below 1e-5 of a motion that
    // turns by 2.35 in the step, in shorter steps far less: enough to know where to look, within [`SLACK`].
    let mut i = black_box(SAMPLES);
    while i > SAMPLES / 2 {
        i -= 1;
        samples[i] = value_soon(c, 0, walk.t - width);
        walk.back::<SPAN>(samples[i], span);
    }
    let mut i = black_box(SAMPLES / 2);
    while i > 1 {
        i -= 1;
        samples[i] = soon_to(c, 0, 7, walk.t - width);
        walk.back::<SPAN>(samples[i], span);
    }
    samples[0] = c[0];
    walk.back::<SPAN>(c[0], span);
    let middle = span * half;
    let bent = (walk.value_after - walk.value) + falls;
    let at_start = lead.like(0.5 / DIP).fnma(walk.inside, if SPAN { bent.abs() } else { bent });
    // Next to a root at zero the first sample says nothing, but of the other end.
    let excluded = if SPAN { has_root.and(walk.value_after.at_most(middle)) } else { has_root };
    let depth = excluded.select(walk.depth_before, has_root.select(walk.depth, walk.depth.max(at_start)));
    let Walk { mut high, mut at_high, mut at_low, mut behind, .. } = walk;
    let gone = lead.not_positive();
    let crosses = high.less(never);
    let mut low = high - width;
    let mut beyond = never.less(zero);
    if SPAN {
        beyond = middle.less(gone.select(c[0], at_high));
        // All three on the side where it leaves.
        at_low = beyond.select(span - at_low, at_low);
        at_high = beyond.select(span - at_high, at_high);
        behind = beyond.select(span - behind, behind);
    }
    // Next to a root at zero the line is that of the function without it, of its slope there.
    let straight = has_root.and(high.at_most(width)).and(beyond.not());
    let at_low = straight.select(lead * width, at_low);
    let fall = at_low - at_high;
    let per_fall = one / zero.less(fall).select(fall, width);
    // On the straight line, and from there towards the parabola through one sample more.
    let along = at_low * per_fall;
    let bend = fall + (behind - at_high);
    let nearer = along - (along - along * along) * half * bend * per_fall;
    let part = straight.or(crosses.not()).select(along, nearer.max(lead.like(LEAST)).min(one));
    let mut estimate = crosses.select(width.fma(part, low), never);
    let may_dip = zero.at_most(depth).and(width.less(high)).and(gone.not());
    if may_dip.any() {
        let [sample, curvature] = dips::<S, T, SPAN>(&samples, ahead, falls, has_root, span);
        let dips = sample.less(high).and(may_dip);
        if dips.any() {
            let side = if SPAN { middle.less(value_soon(c, 0, sample)).select(-width, width) } else { width };
            let mut t = sample;
            for _ in 0..DIP_ITERATIONS {
                let [_, slope] = value_and_slope(c, t);
                t = (t - slope * (side * width) / curvature)
                    .max(sample - width)
                    .min(sample + width)
                    .max(zero)
                    .min(one);
            }
            let deepest = value_soon(c, 0, t);
            let below = dips.and(within::<S, T, SPAN>(deepest, span).not_positive());
            low = below.select((sample - width).max(zero), low);
            high = below.select(t, high);
            estimate = below.select((low + t) * half, estimate);
            if SPAN {
                beyond = below.and(middle.less(deepest)).or(below.not().and(beyond));
            }
        }
    }
    Bracket { low, high, estimate: gone.select(zero, estimate), beyond }
}

/// The first sample near which a function may dip out of its span, 2 for none, and its second difference there, towards
/// the nearer end.
#[inline(always)]
fn dips<S: Simd, T: Scalar<S>, const SPAN: bool>(
    samples: &[Vector<S, T>; SAMPLES + 1],
    ahead: Vector<S, T>,
    falls: Vector<S, T>,
    has_root: Mask<S, T>,
    span: Vector<S, T>,
) -> [Vector<S, T>; 2] {
    let (zero, two, dip) = (falls.like(0.0), falls.like(2.0), falls.like(DIP));
    let (mut sample, mut curvature) = (two, falls.like(1.0));
    // Nearest to its end in the middle, or at the end of the step on its way back: it may dip out in between.
    for i in (0..=SAMPLES).rev() {
        let here = samples[i];
        let mut before = if i > 0 { samples[i - 1] - here } else { falls };
        let mut after = if i < SAMPLES { samples[i + 1] - here } else { ahead };
        if SPAN {
            let upper = (span * two.like(0.5)).less(here);
            (before, after) = (upper.select(-before, before), upper.select(-after, after));
        }
        let bent = if i == 0 || i == SAMPLES { two * (before + after) } else { before + after };
        let close = within::<S, T, SPAN>(here, span).at_most(bent * dip);
        let mut nearest = zero.less(before).and(close);
        nearest = nearest.and(if i == 0 { zero.at_most(after) } else { zero.less(after) });
        if i == 0 {
            nearest = nearest.and(has_root.not());
        }
        sample = nearest.select(two.like(i as f64 / SAMPLES as f64), sample);
        curvature = nearest.select(bent, curvature);
    }
    [sample, curvature]
}

/// The root in a bracket by Halley's method that stays inside, for the function without its root of some order at
/// zero.
#[inline(always)]
pub fn refine<S: Simd, T: Scalar<S>, const N: usize>(
    c: &[Vector<S, T>; N],
    order: Vector<S, T>,
    bracket: &Bracket<S, T>,
) -> Vector<S, T> {
    let zero = c[0].like(0.0);
    // A sample may be judged by what its degrees leave out.
    let slack = zero.like(SLACK);
    let (mut low, mut high) = ((bracket.low - slack).max(zero), (bracket.high + slack).min(zero.like(1.0)));
    let mut t = bracket.estimate;
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
