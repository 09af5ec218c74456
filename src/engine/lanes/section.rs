//! The section of the return map: where `ẋ2` of a lane rises through zero inside its step.

use pulp::Simd;

use crate::engine::cycle::point::FORGETS;
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::observe::{Sums, change};
use crate::engine::lanes::polynomial::{soon_to, value_soon};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;

/// Steps of Newton's method from the straight line, each of which doubles the digits.
const REFINEMENTS: usize = 7;

/// Ends the steps of lanes that reach the section before `at`, without the event there; `before` is `ẋ2` at the start.
#[inline(always)]
pub fn section<S: Simd, T: Scalar<S>, const N: usize>(
    sums: &mut Sums<S, T>,
    e: &Expansion<S, T, N>,
    before: Vector<S, T>,
    [at, event]: [Vector<S, T>; 2],
) -> (Vector<S, T>, Vector<S, T>) {
    let (zero, one) = (at.like(0.0), at.like(1.0));
    let after = change(&e.v[0], at).fma(e.rate, before);
    let rises = before.less(zero).and(zero.less(after));
    sums.section = one.only(rises);
    if !rises.any() {
        return (at, event);
    }
    let mut low = zero;
    let mut high = at;
    let mut t = at * (before / rises.select(before - after, one));
    for _ in 0..REFINEMENTS {
        let here = value_soon(&e.v[0], 1, t) * e.rate;
        let slope = soon_to(&e.a[0], 0, N - 3, t) * e.rate;
        let below = here.less(zero);
        low = below.select(t, low);
        high = below.select(high, t);
        let rising = zero.less(slope);
        let newton = t - here / rising.select(slope, one);
        let inside = rises.and(rising).and(low.at_most(newton)).and(newton.at_most(high));
        t = inside.select(newton, rises.select((low + high) * one.like(0.5), t));
    }
    (rises.select(t, at), rises.select(zero, event))
}

impl<S: Simd, T: Scalar<S>> Sums<S, T> {
    /// Takes the events of the lanes, which are in these contact states, into the numbers of their orders.
    #[inline(always)]
    pub fn follow_order(&mut self, contact: Vector<S, T>, event: Vector<S, T>) {
        let happened = event.like(0.0).less(event);
        let code = contact.fma(event.like(4.0), event);
        let order = happened.select(self.order.fma(event.like(FORGETS), code), self.order);
        self.order.put(order);
    }
}
