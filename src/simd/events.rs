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
use super::vector::{Scalar, Vector};
use crate::kernel::crossing::{DIP, DIP_ITERATIONS, HIGHEST_ORDER, SAMPLES, SOLVER_ITERATIONS};
use crate::kernel::lane::ROUNDINGS;

/// `Σ b_k t^k`.
#[inline(always)]
pub fn value<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    t: Vector<S, T, K>,
) -> Vector<S, T, K> {
    value_to(b, N - 1, t)
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
/// Of two event functions that fall in one step the one with the earlier estimate (straight between samples)
/// comes first.
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
    let square = e.step * e.step;
    // Forces are off by the truncation of the motion and the rounding of the static loads.
    let band = force_band::<S, T, K, N, MOTION>(b, e, tolerance);
    let mut best = Bracket { low: zero, high: one, estimate: one.like(2.0), event: zero, order: zero };
    let mut series = [zero; N];
    let mut turn = 0;
    while pending.any() {
        // One open function per lane at a time.
        let here = [open[0], open[0].not().and(open[1]), open[0].or(open[1]).not().and(open[2])];
        let share = here[0].select(one, g.share);
        let sign = here[1].select(one, here[2].select(-one, zero));
        let mut c = [here[1].select(g.start[1], here[2].select(g.start[2], g.start[0])); N];
        for k in 1..N {
            c[k] = if MOTION == SINGLE { zero } else { share * e.n[k] };
            if k < N - 1 {
                c[k] = sign.fma(g.second[k], c[k]);
            }
        }
        let code = here[1].select(second, here[2].select(third, one));
        let begins = here[0].and(from_zero[0]).or(here[1].and(from_zero[1])).or(here[2].and(from_zero[2]));
        let of_force = slip.and(here[0]).or(slip.or(flies).not());
        let near = of_force.and(c[0].not_positive()).and((-(band * square)).at_most(c[0]));
        let mut deflate = begins.or(near).and(pending);
        let mut live = pending;
        let mut lead = c[0];
        let mut order = zero;
        if deflate.any() {
            // A function that begins at zero, by construction or within rounding, loses that root.
            let mut rounding = band * of_force.select(square, slip.select(e.step, b.scene[INV_DET]));
            for degree in 0..=HIGHEST_ORDER {
                if degree == HIGHEST_ORDER {
                    live = live.and(deflate.not());
                    break;
                }
                c[degree] = deflate.select(zero, c[degree]);
                lead = deflate.select(c[degree + 1], lead);
                order += one.only(deflate);
                rounding = rounding * e.step;
                // A force that stays where it is does not fall.
                let bound = rounding.only(begins);
                deflate = deflate.and(lead.not_positive()).and((-bound).at_most(lead));
                if !deflate.any() {
                    break;
                }
            }
        }
        let found = bracket(&c, lead, order);
        let earlier = live.and(found.estimate.less(best.estimate)).and(found.estimate.at_most(one));
        best.low = earlier.select(found.low, best.low);
        best.high = earlier.select(found.high, best.high);
        best.estimate = earlier.select(found.estimate, best.estimate);
        best.order = earlier.select(order, best.order);
        best.event = earlier.select(code, best.event);
        if turn == 0 {
            series = c;
        } else {
            for k in 0..N {
                series[k] = earlier.select(c[k], series[k]);
            }
        }
        turn += 1;
        for i in 0..3 {
            open[i] = open[i].and(here[i].not());
        }
        pending = open[0].or(open[1]).or(open[2]);
    }
    let happens = zero.less(best.event);
    if !happens.any() {
        return [one, zero];
    }
    [happens.select(refine(&series, &best), one), best.event]
}

/// What a force may be off by at the beginning of a step.
#[inline(always)]
fn force_band<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    b: &Block<S, T, K>,
    e: &Expansion<S, T, K, N>,
    tolerance: Vector<S, T, K>,
) -> Vector<S, T, K> {
    let one = e.step.like(1.0);
    let slower = largest::<S, T, K, N, MOTION>(e, 2).fma(e.rate, largest::<S, T, K, N, MOTION>(e, 1));
    let motion = slower.fma(e.rate, largest::<S, T, K, N, MOTION>(e, 0));
    let loads = (b.scene[MU_STICK] + one) * b.scene[N0] + e.n[0].abs() * (e.rate * e.rate);
    let rounding = Vector::splat(b.simd, T::EPSILON) * e.step.like(ROUNDINGS);
    rounding.fma(loads, tolerance * b.scene[STIFFNESS] * motion)
}

/// Where an event function falls below zero.
struct Bracket<S: Simd, T: Scalar<S>, const K: usize> {
    /// A place where it is still positive.
    low: Vector<S, T, K>,
    /// A place where it no longer is.
    high: Vector<S, T, K>,
    /// Between them on the straight line; 0 when it is not positive from the start, 2 when it stays positive.
    estimate: Vector<S, T, K>,
    /// The event function.
    event: Vector<S, T, K>,
    /// The order of its root at zero, which does not count.
    order: Vector<S, T, K>,
}

/// The first sample that is not positive, and the one before. `lead` is the first coefficient that counts:
/// its sign is that of the function behind a root of some order at zero.
#[inline(always)]
fn bracket<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    lead: Vector<S, T, K>,
    order: Vector<S, T, K>,
) -> Bracket<S, T, K> {
    let (zero, never) = (c[0].like(0.0), c[0].like(2.0));
    let (mut high, mut at_low, mut at_high) = (never, c[0].like(1.0), zero);
    let width = c[0].like(1.0 / SAMPLES as f64);
    let (two, dip) = (c[0].like(2.0), c[0].like(DIP));
    let (mut sample, mut curvature) = (never, c[0].like(1.0));
    // From the last sample to the first: what is set last is the first crossing, and the first dip.
    let mut after = zero;
    let [mut here, slope] = value_and_slope(c, c[0].like(1.0));
    let rise = slope * width;
    for i in (0..SAMPLES).rev() {
        let t = i as f64 / SAMPLES as f64;
        let before = if i == 0 { c[0] } else { value(c, c[0].like(t)) };
        let down = here.not_positive();
        high = down.select(c[0].like(t + 1.0 / SAMPLES as f64), high);
        // Behind a root at zero the line says nothing: the middle.
        let start = if i == 0 { zero.less(order).select(here.abs(), before) } else { before };
        at_low = down.select(start, at_low);
        at_high = down.select(here, at_high);
        // Lowest in the middle, or at the end on its way up: it may dip below zero in between.
        let climbs = if i + 1 < SAMPLES { after - here } else { rise };
        let bent = if i + 1 < SAMPLES { (before - here) + climbs } else { two * ((before - here) + climbs) };
        let lowest = here.less(before).and(zero.less(climbs)).and(here.at_most(bent * dip));
        sample = lowest.select(c[0].like(t + 1.0 / SAMPLES as f64), sample);
        curvature = lowest.select(bent, curvature);
        after = here;
        here = before;
    }
    // Lowest at the start, on its way down.
    let falls = -(c[1] * width);
    let bent = two * ((after - here) + falls);
    let lowest = zero.less(falls).and(here.at_most(after)).and(here.at_most(bent * dip));
    let lowest = lowest.and(order.not_positive());
    sample = lowest.select(zero, sample);
    curvature = lowest.select(bent, curvature);
    let mut low = high - width;
    let fall = at_low - at_high;
    let inside = high.less(never);
    let along = width * at_low / zero.less(fall).select(fall, width);
    let mut estimate = inside.select(low + along, never);
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
    Bracket { low, high, estimate: lead.not_positive().select(zero, estimate), event: zero, order }
}

/// The root in a bracket by Newton's method that stays inside, for the function without its root at zero.
#[inline(always)]
fn refine<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    c: &[Vector<S, T, K>; N],
    bracket: &Bracket<S, T, K>,
) -> Vector<S, T, K> {
    let zero = c[0].like(0.0);
    let (mut low, mut high, mut t) = (bracket.low, bracket.high, bracket.estimate);
    let mut active = zero.less(t).and(t.at_most(zero.like(1.0)));
    // Newton's method squares its error: what is left after such a change is below rounding.
    let enough = Vector::splat(c[0].simd(), T::EPSILON.sqrt());
    for _ in 0..SOLVER_ITERATIONS {
        let [here, slope] = value_and_slope(c, t);
        let positive = zero.less(here);
        low = positive.select(t, low);
        high = positive.select(high, t);
        // Of g/t^m: t − g/(g′ − m g/t).
        let scaled = slope * t - bracket.order * here;
        let down = scaled.less(zero);
        let newton = t - here * t / down.select(scaled, zero.like(-1.0));
        // At 0 the root that does not count is all there is to see.
        let good = down.and(low.at_most(newton)).and(newton.at_most(high)).and(zero.less(newton));
        let next = good.select(newton, (low + high) * zero.like(0.5));
        let change = (next - t).abs();
        t = active.select(next, t);
        active = active.and(enough.less(change));
        if !active.any() {
            break;
        }
    }
    t
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
