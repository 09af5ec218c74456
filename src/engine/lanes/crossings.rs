//! All upward zero crossings of `ẋ2` in a step of every lane.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::nodes::SAMPLE_TIMES;
use crate::engine::lanes::observe::Sums;
use crate::engine::lanes::polynomial::{soon_to, value_soon};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::spectrum::Nodes;
use crate::engine::lanes::vector::{Mask, Vector};

/// Refinements of a crossing by Newton's method, and of an extremum by a chord.
const REFINEMENTS: usize = 3;

/// `ẋ2` and `ẍ2` at the samples of a step, [`SAMPLE_TIMES`].
#[derive(Clone, Copy, Debug)]
pub struct Track<S: Simd, T: Scalar<S>> {
    velocity: [Vector<S, T>; 5],
    acceleration: [Vector<S, T>; 5],
}

impl<S: Simd, T: Scalar<S>> Track<S, T> {
    /// From `ẋ2` at both ends and at the nodes, and the accelerations at the nodes.
    #[inline(always)]
    pub fn new<const N: usize>(
        e: &Expansion<S, T, N>,
        at: Vector<S, T>,
        before: Vector<S, T>,
        after: Vector<S, T>,
        velocities: [Vector<S, T>; 3],
        nodes: &Nodes<S, T>,
    ) -> Self {
        let [v1, v2, v3] = velocities;
        let rate_square = e.rate * e.rate;
        let ends = [e.a[0][0] * rate_square, soon_to(&e.a[0], 0, N - 3, at) * rate_square];
        Track {
            velocity: [before, v1, v2, v3, after],
            acceleration: [ends[0], nodes[0][0], nodes[1][0], nodes[2][0], ends[1]],
        }
    }

    /// The lanes that rise over zero from one sample to the next.
    #[inline(always)]
    fn rises(&self, i: usize) -> Mask<S, T> {
        let zero = self.velocity[i].like(0.0);
        self.velocity[i].less(zero).and(zero.at_most(self.velocity[i + 1]))
    }

    /// The lanes with an extremum towards zero between two samples on the same side of it.
    #[inline(always)]
    fn turns(&self, i: usize) -> Mask<S, T> {
        let zero = self.velocity[i].like(0.0);
        let [v, w] = [self.velocity[i], self.velocity[i + 1]];
        let [a, b] = [self.acceleration[i], self.acceleration[i + 1]];
        let above = zero.at_most(v).and(zero.at_most(w)).and(a.less(zero)).and(zero.less(b));
        let below = v.less(zero).and(w.less(zero)).and(zero.less(a)).and(b.less(zero));
        above.or(below)
    }
}

/// Where a lane crosses upwards: between two fractions of the step.
#[derive(Clone, Copy, Debug)]
struct Bracket<S: Simd, T: Scalar<S>> {
    low: Vector<S, T>,
    high: Vector<S, T>,
    /// `ẋ2` at both.
    velocity: [Vector<S, T>; 2],
    /// `ẍ2` at both.
    acceleration: [Vector<S, T>; 2],
}

/// Notes the upward crossings of `ẋ2` up to `at` in the order of their times.
///
/// They are a jump to the first sample, rises from one sample to the next, and one
/// side of an extremum that reaches over zero between two samples of the same sign. Reversed slip and stick, which are not among
/// the lanes `open`, are not below the velocity of the belt, which is not below 0, but for a rounding.
#[inline(always)]
pub fn cross_upwards<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    sums: &mut Sums<S, T>,
    e: &Expansion<S, T, N>,
    track: &Track<S, T>,
    at: Vector<S, T>,
    open: Mask<S, T>,
) {
    let zero = at.like(0.0);
    let jumped = sums.previous.less(zero).and(zero.at_most(track.velocity[0]));
    sums.previous = track.velocity[4];
    let rises = [0, 1, 2, 3].map(|i| track.rises(i).and(open));
    let turns = track.turns(0).or(track.turns(1)).or(track.turns(2)).or(track.turns(3)).and(open);
    if !jumped.or(rises[0]).or(rises[1]).or(rises[2]).or(rises[3]).or(turns).any() {
        return;
    }
    let jump = Bracket { low: zero, high: zero, velocity: [at.like(-1.0), zero], acceleration: [zero; 2] };
    let mut brackets = [jump; 5];
    for i in 0..4 {
        brackets[i + 1] = Bracket {
            low: at * at.like(SAMPLE_TIMES[i]),
            high: at * at.like(SAMPLE_TIMES[i + 1]),
            velocity: [track.velocity[i], track.velocity[i + 1]],
            acceleration: [track.acceleration[i], track.acceleration[i + 1]],
        };
    }
    let mut crosses = [jumped, rises[0], rises[1], rises[2], rises[3]];
    if turns.any() {
        for i in 0..4 {
            let over = turn_over(e, track, i, &mut brackets[i + 1]);
            crosses[i + 1] = crosses[i + 1].or(over.and(open));
        }
    }
    loop {
        // The next crossing of every lane: most have one at most.
        let mut next = brackets[4];
        for i in (0..4).rev() {
            next = choose(crosses[i], &brackets[i], &next);
        }
        let mut crossed = zero.less(zero);
        let mut again = crossed;
        for crosses in &mut crosses {
            let here = *crosses;
            *crosses = here.and(crossed);
            again = again.or(*crosses);
            crossed = crossed.or(here);
        }
        take::<S, T, N, MOTION>(sums, e, &next, crossed);
        if !again.any() {
            return;
        }
    }
}

/// Notes a crossing of some lanes: exactly where the sums of the window begin or may end, that is the first one and what
/// may be the last.
#[inline(always)]
fn take<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    sums: &mut Sums<S, T>,
    e: &Expansion<S, T, N>,
    bracket: &Bracket<S, T>,
    crossed: Mask<S, T>,
) {
    let mut t = bracket.guess(e);
    let (zero, one) = (t.like(0.0), t.like(1.0));
    let begun = zero.less(sums.spectrum.begun);
    let late = sums.spectrum.closing.at_most(t.fma(e.step, sums.time));
    let counts = crossed.and(begun.not().or(late));
    if counts.any() {
        for _ in 0..REFINEMENTS {
            let slope = soon_to(&e.a[0], 0, N - 3, t) * e.rate;
            let here = value_soon(&e.v[0], 1, t) * e.rate;
            let rising = counts.and(zero.less(slope));
            let nearer = t - here / rising.select(slope, one);
            t = rising.select(nearer.max(bracket.low).min(bracket.high), t);
        }
        sums.spectrum.note::<N, MOTION>(e, sums.time, counts, t);
    }
    sums.note(crossed, t * e.step);
    sums.spectrum.fresh = crossed.select(one.only(counts), sums.spectrum.fresh);
}

/// One bracket in some lanes, and the other in the rest.
#[inline(always)]
fn choose<S: Simd, T: Scalar<S>>(
    mask: Mask<S, T>,
    one: &Bracket<S, T>,
    other: &Bracket<S, T>,
) -> Bracket<S, T> {
    Bracket {
        low: mask.select(one.low, other.low),
        high: mask.select(one.high, other.high),
        velocity: [
            mask.select(one.velocity[0], other.velocity[0]),
            mask.select(one.velocity[1], other.velocity[1]),
        ],
        acceleration: [
            mask.select(one.acceleration[0], other.acceleration[0]),
            mask.select(one.acceleration[1], other.acceleration[1]),
        ],
    }
}

impl<S: Simd, T: Scalar<S>> Bracket<S, T> {
    /// Where the cubic through velocities and accelerations crosses, by a step of Newton's method from the straight line.
    #[inline(always)]
    fn guess<const N: usize>(&self, e: &Expansion<S, T, N>) -> Vector<S, T> {
        let ([v, w], one) = (self.velocity, self.low.like(1.0));
        let zero = self.low.like(0.0);
        let span = self.high - self.low;
        let time = span * e.step;
        let [a, b] = [self.acceleration[0] * time, self.acceleration[1] * time];
        let rise = w - v;
        let s = (-v) / rise.max(one.like(1e-30));
        let (square, cube) = (rise.fma(one.like(3.0), -(a + a + b)), a + b - rise - rise);
        let here = cube.fma(s, square).fma(s, a).fma(s, v);
        let slope = (cube * one.like(3.0)).fma(s, square + square).fma(s, a);
        let rising = zero.less(slope);
        let nearer = s - here / rising.select(slope, one);
        let s = rising.select(nearer.max(zero).min(one), s);
        s.fma(span, self.low)
    }
}

/// Lanes whose velocity turns towards zero between two samples and reaches over it; their bracket becomes the side of the
/// extremum that rises.
#[inline(always)]
fn turn_over<S: Simd, T: Scalar<S>, const N: usize>(
    e: &Expansion<S, T, N>,
    track: &Track<S, T>,
    i: usize,
    bracket: &mut Bracket<S, T>,
) -> Mask<S, T> {
    let turns = track.turns(i);
    if !turns.any() {
        return turns;
    }
    let (low, high) = (bracket.low, bracket.high);
    let (zero, tiny) = (low.like(0.0), low.like(1e-30));
    let [v, w] = bracket.velocity;
    let [a, b] = bracket.acceleration;
    let bend = turns.select((b - a) / (high - low).max(tiny), low.like(1.0));
    let mut turn = low - a / bend;
    for _ in 0..REFINEMENTS {
        let here = soon_to(&e.a[0], 0, N - 3, turn) * (e.rate * e.rate);
        turn = (turn - here / bend).max(low).min(high);
    }
    let depth = value_soon(&e.v[0], 1, turn) * e.rate;
    let is_hump = v.less(zero);
    let over = is_hump.and(zero.at_most(depth)).or(is_hump.not().and(depth.less(zero)));
    let over = turns.and(over);
    let (from, to) = (over.and(is_hump.not()), over.and(is_hump));
    bracket.low = from.select(turn, low);
    bracket.high = to.select(turn, high);
    bracket.velocity = [from.select(depth, v), to.select(depth, w)];
    bracket.acceleration = [from.select(zero, a), to.select(zero, b)];
    over
}
