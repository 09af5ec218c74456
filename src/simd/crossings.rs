//! All upward zero crossings of `ẋ2` in a step of every lane.

use std::ops::Not;

use pulp::Simd;

use super::events::value_to;
use super::expand::Expansion;
use super::observe::{Sums, derivative};
use super::spectrum::Nodes;
use super::vector::{Mask, Scalar, Vector};
use crate::kernel::observe::SAMPLE_TIMES;

/// Refinements of a crossing by Newton's method, and of an extremum by a chord.
const REFINEMENTS: usize = 3;

/// `ẋ2` and `ẍ2` at the samples of a step, [`SAMPLE_TIMES`].
#[derive(Clone, Copy, Debug)]
pub struct Track<S: Simd, T: Scalar<S>, const K: usize> {
    velocity: [Vector<S, T, K>; 5],
    acceleration: [Vector<S, T, K>; 5],
}

impl<S: Simd, T: Scalar<S>, const K: usize> Track<S, T, K> {
    /// From `ẋ2` at both ends and at the nodes, and the accelerations at the nodes.
    #[inline(always)]
    pub fn new<const N: usize>(
        e: &Expansion<S, T, K, N>,
        at: Vector<S, T, K>,
        before: Vector<S, T, K>,
        after: Vector<S, T, K>,
        velocities: [Vector<S, T, K>; 3],
        nodes: &Nodes<S, T, K>,
    ) -> Self {
        let [v1, v2, v3] = velocities;
        let rate_square = e.rate * e.rate;
        let ends = [e.a[0][0] * rate_square, value_to(&e.a[0], N - 3, at) * rate_square];
        Track {
            velocity: [before, v1, v2, v3, after],
            acceleration: [ends[0], nodes[0][0], nodes[1][0], nodes[2][0], ends[1]],
        }
    }

    /// The lanes that rise over zero from one sample to the next.
    #[inline(always)]
    fn rises(&self, i: usize) -> Mask<S, T, K> {
        let zero = self.velocity[i].like(0.0);
        self.velocity[i].less(zero).and(zero.at_most(self.velocity[i + 1]))
    }

    /// The lanes with an extremum towards zero between two samples on the same side of it.
    #[inline(always)]
    fn turns(&self, i: usize) -> Mask<S, T, K> {
        let zero = self.velocity[i].like(0.0);
        let [v, w] = [self.velocity[i], self.velocity[i + 1]];
        let [a, b] = [self.acceleration[i], self.acceleration[i + 1]];
        let above = zero.at_most(v).and(zero.at_most(w)).and(a.less(zero)).and(zero.less(b));
        let below = v.less(zero).and(w.less(zero)).and(zero.less(a)).and(b.less(zero));
        above.or(below)
    }
}

/// Where a lane crosses upwards: between two fractions of the step, near a third.
#[derive(Clone, Copy, Debug)]
struct Bracket<S: Simd, T: Scalar<S>, const K: usize> {
    crosses: Mask<S, T, K>,
    low: Vector<S, T, K>,
    high: Vector<S, T, K>,
    guess: Vector<S, T, K>,
}

/// Notes the upward crossings of `ẋ2` up to `at` in the order of their times.
///
/// They are those of [`crate::kernel::observe`]: a jump to the first sample, rises from one sample to the next, and one
/// side of an extremum that reaches over zero between two samples of the same sign.
#[inline(always)]
pub fn cross_upwards<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    sums: &mut Sums<S, T, K>,
    e: &Expansion<S, T, K, N>,
    track: &Track<S, T, K>,
    at: Vector<S, T, K>,
) {
    let zero = at.like(0.0);
    let jumped = sums.previous.less(zero).and(zero.at_most(track.velocity[0]));
    sums.previous = track.velocity[4];
    let rises = track.rises(0).or(track.rises(1)).or(track.rises(2)).or(track.rises(3));
    let turns = track.turns(0).or(track.turns(1)).or(track.turns(2)).or(track.turns(3));
    let turns_somewhere = turns.any();
    if !turns_somewhere && !jumped.or(rises).any() {
        return;
    }
    let mut brackets = [Bracket { crosses: jumped, low: zero, high: zero, guess: zero }; 5];
    for i in 0..4 {
        brackets[i + 1] = between(e, track, i, at, turns_somewhere);
    }
    loop {
        // The next crossing of every lane: most have one at most.
        let mut crossed = zero.less(zero);
        let (mut low, mut high, mut t) = (zero, zero, zero);
        for bracket in &mut brackets {
            let taken = bracket.crosses.and(crossed.not());
            low = taken.select(bracket.low, low);
            high = taken.select(bracket.high, high);
            t = taken.select(bracket.guess, t);
            bracket.crosses = bracket.crosses.and(taken.not());
            crossed = crossed.or(taken);
        }
        if !crossed.any() {
            return;
        }
        for _ in 0..REFINEMENTS {
            let slope = value_to(&e.a[0], N - 3, t) * e.rate;
            let here = derivative(&e.v[0], t) * e.rate;
            let rising = zero.less(slope);
            let next = t - here / rising.select(slope, at.like(1.0));
            t = rising.select(next.max(low).min(high), t);
        }
        sums.note(crossed, t * e.step);
        sums.spectrum.note::<N, MOTION>(e, sums.time, crossed, t);
    }
}

/// The lanes that cross upwards between one sample and the next.
#[inline(always)]
fn between<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    e: &Expansion<S, T, K, N>,
    track: &Track<S, T, K>,
    i: usize,
    at: Vector<S, T, K>,
    turns_somewhere: bool,
) -> Bracket<S, T, K> {
    let tiny = at.like(1e-30);
    let (low, high) = (at * at.like(SAMPLE_TIMES[i]), at * at.like(SAMPLE_TIMES[i + 1]));
    let [v, w] = [track.velocity[i], track.velocity[i + 1]];
    let crosses = track.rises(i);
    let straight = low + (high - low) * (v / (v - w).min(at.like(-1e-30)));
    let rise = Bracket { crosses, low, high, guess: straight };
    let turns = track.turns(i);
    if !turns_somewhere || !turns.any() {
        return rise;
    }
    let zero = at.like(0.0);
    let [a, b] = [track.acceleration[i], track.acceleration[i + 1]];
    let bend = turns.select((b - a) / (high - low).max(tiny), at.like(1.0));
    let mut turn = low - a / bend;
    for _ in 0..REFINEMENTS {
        let here = value_to(&e.a[0], N - 3, turn) * (e.rate * e.rate);
        turn = (turn - here / bend).max(low).min(high);
    }
    let depth = derivative(&e.v[0], turn) * e.rate;
    let is_hump = v.less(zero);
    let over = is_hump.and(zero.at_most(depth)).or(is_hump.not().and(depth.less(zero)));
    let over = turns.and(over);
    // The parabola through the extremum and the sample on the side of the crossing.
    let part = (depth / is_hump.select((depth - v).max(tiny), (depth - w).min(zero - tiny))).max(zero).sqrt();
    let guess = is_hump.select(turn - (turn - low) * part, turn + (high - turn) * part);
    Bracket {
        crosses: crosses.or(over),
        low: over.and(is_hump.not()).select(turn, low),
        high: over.and(is_hump).select(turn, high),
        guess: over.select(guess, straight),
    }
}
