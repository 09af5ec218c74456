//! The first event of every lane inside its step.
//!
//! For all lanes at once: a bound by Bernstein coefficients settles
//! most event functions; one that it does not settle is sampled and its first root refined.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::block::{Block, SECOND, THIRD};
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::function::{Function, Rounding};
use crate::engine::lanes::functions::{Functions, may_fall, may_return};
use crate::engine::lanes::root::{Bracket, bracket, refine};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;

/// The span of a function that may rise as far as it will: no number of a lane comes near.
const NO_SPAN: f64 = 1e30;

/// Where each lane's first event is in the step (1 when there is none), and which event function it belongs to (0 for none).
///
/// Of two event functions that fall in one step the one with the earlier estimate comes first.
#[inline(always)]
pub fn first_event<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    b: &Block<S, T>,
    e: &Expansion<S, T, N>,
    g: &Functions<S, T, N>,
    tolerance: Vector<S, T>,
) -> [Vector<S, T>; 2] {
    let zero = e.step.like(0.0);
    let one = e.step.like(1.0);
    let second = e.step.like(f64::from(SECOND));
    let third = e.step.like(f64::from(THIRD));
    let from_zero = [
        b.disarmed.less(second).and(zero.less(b.disarmed)),
        b.disarmed.less(third).and(second.at_most(b.disarmed)),
        third.at_most(b.disarmed),
    ];
    let falls = may_fall::<S, T, N, MOTION>(b, e, g);
    let mut open = [from_zero[0].or(falls[0]), from_zero[1].or(falls[1]), from_zero[2].or(falls[2])];
    let mut pending = open[0].or(open[1]).or(open[2]);
    if !pending.any() {
        return [one, zero];
    }
    let rounding = Rounding::new::<N, MOTION>(b, e, tolerance);
    if from_zero[1].or(from_zero[2]).any() {
        let returns = may_return(g, from_zero[2], rounding.speed * e.step);
        for i in 1..3 {
            open[i] = open[i].and(from_zero[i].not().or(returns));
        }
        pending = open[0].or(open[1]).or(open[2]);
    }
    let (slip, flies) = (b.slip(), b.free());
    let mut best = Bracket { low: zero, high: one, estimate: one.like(2.0), beyond: slip };
    let mut of_best = Function { start: zero, share: zero, sign: zero, order: zero };
    let mut event = zero;
    let mut c = [zero; N];
    // Lanes whose series is no longer that of the last search.
    let mut turned = zero.less(zero);
    let mut turns = 0;
    while pending.any() {
        turns += 1;
        // One open function per lane at a time; but both that a sliding speed has, between whose kinks it lies, are one
        // with a span: that which begins at a kink, or that of the lower one.
        let ahead = open[0].not().and(open[1]);
        let back = open[0].not().and(open[2]);
        let pair = slip.and(ahead).and(back);
        let ahead = ahead.and(pair.and(from_zero[2]).not());
        let here = [open[0], ahead, back.and(ahead.not())];
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
            lead = f.deflate::<N, MOTION>(b, e, g, &rounding, [begins, low, of_force], &mut live);
        } else {
            f.start = begins.select(zero, f.start);
            f.order = one.only(begins);
        }
        // In doubt one after the other.
        let pair = pair.and(doubtful.not());
        f.series::<N, MOTION>(e, g, &mut c);
        let has_root = zero.less(f.order);
        let found = if pair.any() {
            let span = pair.select(g.start[1] + g.start[2], one.like(NO_SPAN));
            let lead = begins.select(lead, lead.min(span - lead));
            bracket::<S, T, N, true>(&c, has_root, lead, span)
        } else {
            bracket::<S, T, N, false>(&c, has_root, lead, one)
        };
        let earlier = live.and(found.estimate.less(best.estimate)).and(found.estimate.at_most(one));
        let other = here[1].select(g.start[2], g.start[1]);
        best.low = earlier.select(found.low, best.low);
        best.high = earlier.select(found.high, best.high);
        best.estimate = earlier.select(found.estimate, best.estimate);
        of_best.start = earlier.select(found.beyond.select(other, f.start), of_best.start);
        of_best.share = earlier.select(f.share, of_best.share);
        of_best.sign = earlier.select(found.beyond.select(-f.sign, f.sign), of_best.sign);
        of_best.order = earlier.select(f.order.only(found.beyond.not()), of_best.order);
        let of_speed = here[1].and(found.beyond.not()).or(here[2].and(found.beyond));
        event = earlier.select(of_speed.select(second, here[0].select(one, third)), event);
        turned = turned.or(earlier.and(found.beyond));
        for i in 0..3 {
            open[i] = open[i].and(here[i].or(pair).not());
        }
        pending = open[0].or(open[1]).or(open[2]);
    }
    let happens = zero.less(event);
    if !happens.any() {
        return [one, zero];
    }
    if turns > 1 || turned.any() {
        of_best.series::<N, MOTION>(e, g, &mut c);
    }
    [happens.select(refine(&c, of_best.order, &best), one), event]
}
