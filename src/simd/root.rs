//! The first place in a step where a function of every lane falls below zero: sampled, then solved.

use std::hint::black_box;
use std::ops::Not;

use pulp::Simd;

use super::polynomial::{at_one, soon_to, value, value_and_slope, value_slope_and_bend};
use super::vector::{Mask, Scalar, Vector};
use crate::kernel::crossing::{DIP, DIP_ITERATIONS, SAMPLES, SOLVER_ITERATIONS};
use crate::kernel::source::Precision;

/// The least part of the way between two samples at which a root is looked for first.
const LEAST: f64 = 1e-3;

/// Where an event function falls below zero, or rises beyond its span.
pub struct Bracket<S: Simd, T: Scalar<S>, const K: usize> {
    /// A place where it is still positive.
    pub low: Vector<S, T, K>,
    /// A place where it no longer is.
    pub high: Vector<S, T, K>,
    /// Between them on the parabola through one sample more; 0 when it is not positive from the start, 2 when it stays positive.
    pub estimate: Vector<S, T, K>,
    /// Lanes whose function rises beyond its span there.
    pub beyond: Mask<S, T, K>,
}

/// The distance of a value to the nearer end of `[0, span]`, negative outside; the value itself without a span.
#[inline(always)]
fn within<S: Simd, T: Scalar<S>, const K: usize, const SPAN: bool>(
    value: Vector<S, T, K>,
    span: Vector<S, T, K>,
) -> Vector<S, T, K> {
    if SPAN { value.min(span - value) } else { value }
}

/// A walk over the samples of a function from the last to the first: what is kept last is the first crossing.
struct Walk<S: Simd, T: Scalar<S>, const K: usize> {
    /// The present sample, and the function there.
    t: Vector<S, T, K>,
    value: Vector<S, T, K>,
    inside: Vector<S, T, K>,
    /// The function at the sample after it.
    value_after: Vector<S, T, K>,
    inside_after: Vector<S, T, K>,
    /// The first sample outside, 2 for none, and the function there, one before and one after.
    high: Vector<S, T, K>,
    at_high: Vector<S, T, K>,
    at_low: Vector<S, T, K>,
    behind: Vector<S, T, K>,
    /// How far inside a second difference allows the function to dip below zero, up to the first crossing: nowhere if
    /// negative; and the same but for the first sample.
    depth: Vector<S, T, K>,
    depth_before: Vector<S, T, K>,
    /// The second difference less the value over [`DIP`] has this weight of the present sample.
    weight: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize> Walk<S, T, K> {
    /// On to the sample before, where the function has this value; returns what [`within`] makes of it.
    #[inline(always)]
    fn back<const SPAN: bool>(&mut self, value: Vector<S, T, K>, span: Vector<S, T, K>) -> Vector<S, T, K> {
        let down = self.inside.not_positive();
        self.high = down.select(self.t, self.high);
        self.at_high = down.select(self.value, self.at_high);
        self.at_low = down.select(value, self.at_low);
        self.behind = down.select(self.value_after, self.behind);
        let inside = within::<S, T, K, SPAN>(value, span);
        self.depth_before = self.depth;
        let bent = self.weight.fnma(self.inside, inside + self.inside_after);
        self.depth = down.select(value.like(-1.0), self.depth.max(bent));
        self.weight = value.like(2.0 + 1.0 / DIP);
        (self.inside_after, self.value_after) = (self.inside, self.value);
        (self.inside, self.value) = (inside, value);
        self.t = self.t - value.like(1.0 / SAMPLES as f64);
        inside
    }
}

/// The first sample that is not inside `[0, span]` (with `SPAN`; else that is not positive), and the one before. `lead` is
/// the first coefficient that counts (the distance to the nearer end where it is the value at the start), `has_root` says
/// that it is not the first.
#[inline(always)]
pub fn bracket<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const SPAN: bool>(
    c: &[Vector<S, T, K>; N],
    has_root: Mask<S, T, K>,
    lead: Vector<S, T, K>,
    span: Vector<S, T, K>,
) -> Bracket<S, T, K> {
    let (zero, one, never, half) = (lead.like(0.0), lead.like(1.0), lead.like(2.0), lead.like(0.5));
    let width = lead.like(1.0 / SAMPLES as f64);
    let [last, slope] = at_one(c);
    let inside = within::<S, T, K, SPAN>(last, span);
    let (mut ahead, mut falls) = (slope * width, -(c[1] * width));
    let value_after = last + ahead;
    if SPAN {
        // Towards the nearer end.
        let middle = span * half;
        ahead = middle.less(last).select(-ahead, ahead);
        falls = middle.less(c[0]).select(-falls, falls);
    }
    // At either end the second difference has the slope in place of a sample.
    let half_weight = lead.like(1.0 + 0.5 / DIP);
    let mut walk = Walk {
        t: one,
        value: last,
        inside,
        value_after,
        inside_after: ahead,
        high: never,
        at_high: zero,
        at_low: one,
        behind: zero,
        depth: -one,
        depth_before: -one,
        weight: half_weight,
    };
    let mut samples = [inside; SAMPLES + 1];
    // Loops, as their code is short. What the degrees leave out is some 3e-6 of a motion that turns by 2 in the step, in
    // shorter steps far less: enough to know where to look.
    let mut i = black_box(SAMPLES);
    while i > SAMPLES / 2 {
        i -= 1;
        samples[i] = walk.back::<SPAN>(soon_to(c, 0, N - 3, walk.t - width), span);
    }
    let mut i = black_box(SAMPLES / 2);
    while i > 1 {
        i -= 1;
        samples[i] = walk.back::<SPAN>(soon_to(c, 0, 7, walk.t - width), span);
    }
    samples[0] = walk.back::<SPAN>(c[0], span);
    let at_start = half_weight.fnma(walk.inside, walk.inside_after + falls);
    // Next to a root at zero the first sample says nothing.
    let depth = has_root.select(walk.depth_before, walk.depth.max(at_start));
    let Walk { mut high, mut at_high, mut at_low, mut behind, .. } = walk;
    let gone = lead.not_positive();
    let crosses = high.less(never);
    let mut low = high - width;
    let mut beyond = never.less(zero);
    if SPAN {
        beyond = (span * half).less(gone.select(c[0], at_high));
        // All three on the side where it leaves.
        at_low = beyond.select(span - at_low, at_low);
        at_high = beyond.select(span - at_high, at_high);
        behind = beyond.select(span - behind, behind);
    }
    // Next to a root at zero the line is that of the function without it, of its slope there.
    let straight = has_root.and(high.at_most(width));
    let at_low = straight.select(lead * width, at_low);
    let fall = at_low - at_high;
    let per_fall = one / zero.less(fall).select(fall, width);
    // On the straight line, and from there towards the parabola through one sample more.
    let along = at_low * per_fall;
    let bend = fall + (behind - at_high);
    let nearer = along - (along - along * along) * half * bend * per_fall;
    let part = straight.or(crosses.not()).select(along, nearer.max(lead.like(LEAST)).min(one));
    let mut estimate = crosses.select(width.fma(part, low), never);
    if zero.at_most(depth).and(width.less(high)).and(gone.not()).any() {
        let [sample, curvature] = dips(&samples, ahead, falls, has_root);
        let dips = sample.less(high);
        if dips.any() {
            let side = if SPAN { (span * half).less(value(c, sample)).select(-width, width) } else { width };
            let mut t = sample;
            for _ in 0..DIP_ITERATIONS {
                let [_, slope] = value_and_slope(c, t);
                t = (t - slope * (side * width) / curvature)
                    .max(sample - width)
                    .min(sample + width)
                    .max(zero)
                    .min(one);
            }
            let deepest = value(c, t);
            let below = dips.and(within::<S, T, K, SPAN>(deepest, span).not_positive());
            low = below.select((sample - width).max(zero), low);
            high = below.select(t, high);
            estimate = below.select((low + t) * half, estimate);
            if SPAN {
                beyond = below.and((span * half).less(deepest)).or(below.not().and(beyond));
            }
        }
    }
    Bracket { low, high, estimate: gone.select(zero, estimate), beyond }
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
