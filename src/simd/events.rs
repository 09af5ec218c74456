//! The first event of every lane inside its step.
//!
//! The rules of [`crate::kernel::crossing`], for all lanes at once: a bound by Bernstein coefficients settles
//! most event functions; one that it does not settle is sampled and its first root refined.

use std::ops::Not;

use pulp::Simd;

use super::block::{Block, SECOND, THIRD};
use super::constants::{INV_DET, MU_STICK, N0, STIFFNESS};
use super::expand::{Expansion, FLIGHT, SINGLE};
use super::functions::{Functions, may_fall};
use super::vector::{Mask, Scalar, Vector};
use crate::kernel::crossing::{DIP, DIP_ITERATIONS, HIGHEST_ORDER, SAMPLES, SOLVER_ITERATIONS};
use crate::kernel::lane::ROUNDINGS;
use crate::kernel::source::Precision;

/// `Σ b_k t^k`.
#[inline(always)]
pub fn value<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    t: Vector<S, T, K>,
) -> Vector<S, T, K> {
    value_to(b, N - 1, t)
}

/// `Σ b_k t^(k − first)` from one degree up to another, even and odd ones at a time: sooner there than by a chain.
#[inline(always)]
pub fn value_soon<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    first: usize,
    degree: usize,
    t: Vector<S, T, K>,
) -> Vector<S, T, K> {
    let square = t * t;
    let [mut lower, mut upper] = [b[degree - 1], b[degree]];
    let mut k = degree - 1;
    while k >= first + 2 {
        k -= 2;
        lower = lower.fma(square, b[k]);
        upper = upper.fma(square, b[k + 1]);
    }
    let sum = upper.fma(t, lower);
    if k == first { sum } else { sum.fma(t, b[first]) }
}

/// `Σ b_k t^k` up to a degree.
#[inline(always)]
pub fn value_to<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    degree: usize,
    t: Vector<S, T, K>,
) -> Vector<S, T, K> {
    let mut sum = b[degree];
    for k in (0..degree).rev() {
        sum = sum.fma(t, b[k]);
    }
    sum
}

/// `Σ b_k` and `Σ k b_k`: value and slope at 1.
#[inline(always)]
fn at_one<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
) -> [Vector<S, T, K>; 2] {
    // Four sums at a time, which do not wait for each other.
    let mut sums = [b[0], b[1], b[2], b[3]];
    let mut slopes = [b[0].like(0.0), b[1], b[2] + b[2], b[3] * b[3].like(3.0)];
    for k in 4..N {
        sums[k % 4] += b[k];
        slopes[k % 4] = b[k].fma(b[k].like(k as f64), slopes[k % 4]);
    }
    [(sums[0] + sums[1]) + (sums[2] + sums[3]), (slopes[0] + slopes[1]) + (slopes[2] + slopes[3])]
}

/// `Σ b_k t^k` and its derivative.
#[inline(always)]
fn value_and_slope<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    t: Vector<S, T, K>,
) -> [Vector<S, T, K>; 2] {
    let mut sum = b[N - 1];
    let mut slope = sum.like(0.0);
    for k in (0..N - 1).rev() {
        slope = slope.fma(t, sum);
        sum = sum.fma(t, b[k]);
    }
    [sum, slope]
}

/// Where in the step each lane's first event is, 1 when there is none, and the event function it belongs to,
/// 0 for none.
///
/// Of two event functions that fall in one step the one with the earlier estimate comes first.
#[inline(always)]
pub fn first_event<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    b: &Block<S, T, K>,
    e: &Expansion<S, T, K, N>,
    g: &Functions<S, T, K, N>,
    tolerance: Vector<S, T, K>,
) -> [Vector<S, T, K>; 2] {
    let zero = e.step.like(0.0);
    let one = e.step.like(1.0);
    let second = e.step.like(f64::from(SECOND));
    let third = e.step.like(f64::from(THIRD));
    let from_zero = [
        b.disarmed.less(second).and(zero.less(b.disarmed)),
        b.disarmed.less(third).and(second.at_most(b.disarmed)),
        third.at_most(b.disarmed),
    ];
    let falls = may_fall::<S, T, K, N, MOTION>(b, e, g);
    let mut open = [from_zero[0].or(falls[0]), from_zero[1].or(falls[1]), from_zero[2].or(falls[2])];
    let mut pending = open[0].or(open[1]).or(open[2]);
    if !pending.any() {
        return [one, zero];
    }
    let (slip, flies) = (b.slip(), b.free());
    let mut best = Bracket { low: zero, high: one, estimate: one.like(2.0) };
    let mut of_best = Function { start: zero, share: zero, sign: zero, order: zero };
    let mut event = zero;
    let mut c = [zero; N];
    let mut turns = 0;
    while pending.any() {
        turns += 1;
        // One open function per lane at a time.
        let here = [open[0], open[0].not().and(open[1]), open[0].or(open[1]).not().and(open[2])];
        let mut f = Function {
            start: here[1].select(g.start[1], here[2].select(g.start[2], g.start[0])),
            share: here[0].select(one, g.share),
            sign: here[1].select(one, here[2].select(-one, zero)),
            order: zero,
        };
        let begins = here[0].and(from_zero[0]).or(here[1].and(from_zero[1])).or(here[2].and(from_zero[2]));
        let of_force = slip.and(here[0]).or(slip.or(flies).not());
        let mut live = pending;
        // The first coefficient that counts: its sign is that of the function behind its root at zero.
        let mut lead = begins.select(f.coefficient::<N, MOTION>(e, g, 1), f.start);
        let doubtful = begins.and(lead.not_positive());
        let low = of_force.and(pending).and(begins.not()).and(f.start.not_positive());
        if doubtful.or(low).any() {
            let rounding = Rounding::new::<N, MOTION>(b, e, tolerance, of_force);
            lead = f.deflate::<N, MOTION>(e, g, &rounding, [begins, low], &mut live);
        } else {
            f.start = begins.select(zero, f.start);
            f.order = one.only(begins);
        }
        f.series::<N, MOTION>(e, g, &mut c);
        let found = bracket(&c, zero.less(f.order), lead);
        let earlier = live.and(found.estimate.less(best.estimate)).and(found.estimate.at_most(one));
        best.low = earlier.select(found.low, best.low);
        best.high = earlier.select(found.high, best.high);
        best.estimate = earlier.select(found.estimate, best.estimate);
        of_best.start = earlier.select(f.start, of_best.start);
        of_best.share = earlier.select(f.share, of_best.share);
        of_best.sign = earlier.select(f.sign, of_best.sign);
        of_best.order = earlier.select(f.order, of_best.order);
        event = earlier.select(here[1].select(second, here[2].select(third, one)), event);
        for i in 0..3 {
            open[i] = open[i].and(here[i].not());
        }
        pending = open[0].or(open[1]).or(open[2]);
    }
    let happens = zero.less(event);
    if !happens.any() {
        return [one, zero];
    }
    if turns > 1 {
        of_best.series::<N, MOTION>(e, g, &mut c);
    }
    [happens.select(refine(&c, of_best.order, &best), one), event]
}

/// What event functions and their derivatives may be off by at the beginning of a step.
struct Rounding<S: Simd, T: Scalar<S>, const K: usize> {
    /// A force.
    force: Vector<S, T, K>,
    /// The event function.
    function: Vector<S, T, K>,
    /// One degree more.
    step: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize> Rounding<S, T, K> {
    /// Forces are off by the truncation of the motion and the rounding of the static loads.
    #[inline(always)]
    fn new<const N: usize, const MOTION: u8>(
        b: &Block<S, T, K>,
        e: &Expansion<S, T, K, N>,
        tolerance: Vector<S, T, K>,
        of_force: Mask<S, T, K>,
    ) -> Self {
        let one = e.step.like(1.0);
        let slower = largest::<S, T, K, N, MOTION>(e, 2).fma(e.rate, largest::<S, T, K, N, MOTION>(e, 1));
        let motion = slower.fma(e.rate, largest::<S, T, K, N, MOTION>(e, 0));
        let loads = (b.scene[MU_STICK] + one) * b.scene[N0] + e.n[0].abs() * (e.rate * e.rate);
        let rounding = Vector::splat(b.simd, T::EPSILON) * e.step.like(ROUNDINGS);
        let band = rounding.fma(loads, tolerance * b.scene[STIFFNESS] * motion);
        let square = e.step * e.step;
        let unit = of_force.select(square, b.slip().select(e.step, b.scene[INV_DET]));
        Rounding { force: band * square, function: band * unit, step: e.step }
    }
}

/// An event function of every lane, without its root of some order at zero.
struct Function<S: Simd, T: Scalar<S>, const K: usize> {
    /// Its value at the beginning.
    start: Vector<S, T, K>,
    /// How much of the normal force is in it, see [`Functions`].
    share: Vector<S, T, K>,
    /// How much of the second series.
    sign: Vector<S, T, K>,
    /// The order of its root at zero, which does not count: coefficients below it are taken to be 0.
    order: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize> Function<S, T, K> {
    /// A coefficient above degree 0.
    #[inline(always)]
    fn coefficient<const N: usize, const MOTION: u8>(
        &self,
        e: &Expansion<S, T, K, N>,
        g: &Functions<S, T, K, N>,
        degree: usize,
    ) -> Vector<S, T, K> {
        let force = if MOTION == SINGLE { e.step.like(0.0) } else { self.share * e.n[degree] };
        if degree < N - 1 { self.sign.fma(g.second[degree], force) } else { force }
    }

    /// Takes the root at zero from functions that begin there, by construction (`begins`) or within rounding (some of
    /// `low`); returns the first coefficient that counts. Lanes with nothing but zeros are no longer `live`.
    #[inline(always)]
    fn deflate<const N: usize, const MOTION: u8>(
        &mut self,
        e: &Expansion<S, T, K, N>,
        g: &Functions<S, T, K, N>,
        rounding: &Rounding<S, T, K>,
        [begins, low]: [Mask<S, T, K>; 2],
        live: &mut Mask<S, T, K>,
    ) -> Vector<S, T, K> {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let mut deflate = begins.or(low.and((-rounding.force).at_most(self.start)));
        let mut lead = self.start;
        let mut bound = rounding.function;
        self.start = deflate.select(zero, self.start);
        for degree in 0..HIGHEST_ORDER {
            lead = deflate.select(self.coefficient::<N, MOTION>(e, g, degree + 1), lead);
            self.order += one.only(deflate);
            bound = bound * rounding.step;
            // A force that stays where it is does not fall.
            deflate = deflate.and(lead.not_positive()).and((-bound.only(begins)).at_most(lead));
            if !deflate.any() {
                return lead;
            }
        }
        *live = live.and(deflate.not());
        lead
    }

    /// All coefficients.
    #[inline(always)]
    fn series<const N: usize, const MOTION: u8>(
        &self,
        e: &Expansion<S, T, K, N>,
        g: &Functions<S, T, K, N>,
        c: &mut [Vector<S, T, K>; N],
    ) {
        c[0] = self.start;
        for degree in 1..N {
            c[degree] = self.coefficient::<N, MOTION>(e, g, degree);
        }
        let one = self.order.like(1.0);
        for degree in 1..HIGHEST_ORDER {
            let less = one.like(degree as f64).less(self.order);
            if !less.any() {
                break;
            }
            c[degree] = c[degree].only(less.not());
        }
    }
}

/// The least part of the way between two samples at which a root is looked for first.
const LEAST: f64 = 1e-3;

/// Where an event function falls below zero.
struct Bracket<S: Simd, T: Scalar<S>, const K: usize> {
    /// A place where it is still positive.
    low: Vector<S, T, K>,
    /// A place where it no longer is.
    high: Vector<S, T, K>,
    /// Between them on the parabola through one sample more; 0 when it is not positive from the start, 2 when it stays positive.
    estimate: Vector<S, T, K>,
}

/// The first sample that is not positive, and the one before. `lead` is the first coefficient that counts, `has_root`
/// says that it is not the first.
#[inline(always)]
fn bracket<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    has_root: Mask<S, T, K>,
    lead: Vector<S, T, K>,
) -> Bracket<S, T, K> {
    let (zero, never) = (lead.like(0.0), lead.like(2.0));
    let width = lead.like(1.0 / SAMPLES as f64);
    let (mut high, mut at_low, mut at_high, mut behind) = (never, lead.like(1.0), zero, zero);
    // The second difference less the value over DIP: not negative where the function may dip below zero.
    let weight = lead.like(2.0 + 1.0 / DIP);
    let half_weight = lead.like(1.0 + 0.5 / DIP);
    let mut t = lead.like(1.0);
    let [mut here, slope] = at_one(c);
    let ahead = slope * width;
    let mut after = here + ahead;
    let mut depth = -never;
    // From the last sample to the first: what is set last is the first crossing.
    for i in (1..=SAMPLES).rev() {
        let down = here.not_positive();
        high = down.select(t, high);
        t = t - width;
        let before = if i == 1 { c[0] } else { value_soon(c, 0, N - 1, t) };
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
    let falls = -(c[1] * width);
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
        let [sample, curvature] = dips(c, ahead, falls, has_root);
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
fn dips<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    ahead: Vector<S, T, K>,
    falls: Vector<S, T, K>,
    has_root: Mask<S, T, K>,
) -> [Vector<S, T, K>; 2] {
    let (zero, two, dip) = (falls.like(0.0), falls.like(2.0), falls.like(DIP));
    let (mut sample, mut curvature) = (two, falls.like(1.0));
    // Lowest in the middle, or at the end on its way up: it may dip below zero in between.
    let mut here = value(c, falls.like(1.0));
    let mut after = here + ahead;
    for i in (1..=SAMPLES).rev() {
        let before = if i == 1 { c[0] } else { value(c, two.like((i - 1) as f64 / SAMPLES as f64)) };
        let climbs = if i < SAMPLES { after - here } else { ahead };
        let bent = if i < SAMPLES { (before - here) + climbs } else { two * ((before - here) + climbs) };
        let lowest = here.less(before).and(zero.less(climbs)).and(here.at_most(bent * dip));
        sample = lowest.select(two.like(i as f64 / SAMPLES as f64), sample);
        curvature = lowest.select(bent, curvature);
        after = here;
        here = before;
    }
    // Lowest at the start, on its way down.
    let bent = two * ((after - here) + falls);
    let lowest = zero.less(falls).and(here.at_most(after)).and(here.at_most(bent * dip));
    let lowest = lowest.and(has_root.not());
    [lowest.select(zero, sample), lowest.select(bent, curvature)]
}

/// The root in a bracket by Halley's method that stays inside, for the function without its root of some order at
/// zero.
#[inline(always)]
fn refine<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
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

/// `Σ b_k t^k` and its first two derivatives.
#[inline(always)]
fn value_slope_and_bend<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    t: Vector<S, T, K>,
) -> [Vector<S, T, K>; 3] {
    let mut sum = b[N - 1];
    let mut slope = sum.like(0.0);
    let mut half_bend = sum.like(0.0);
    for k in (0..N - 1).rev() {
        half_bend = half_bend.fma(t, slope);
        slope = slope.fma(t, sum);
        sum = sum.fma(t, b[k]);
    }
    [sum, slope, half_bend + half_bend]
}

/// The largest magnitude of the positions' coefficients of degree `k`.
#[inline(always)]
pub fn largest<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    e: &Expansion<S, T, K, N>,
    k: usize,
) -> Vector<S, T, K> {
    match MOTION {
        SINGLE => e.p[0][k].abs(),
        FLIGHT => e.p[0][k].abs().max(e.p[2][k].abs()).max(e.p[1][k].abs()),
        _ => e.p[0][k].abs().max(e.p[2][k].abs()),
    }
}
