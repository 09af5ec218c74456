//! What a step of the single mass in closed form adds to the sums of the window: exact integrals.
//!
//! With `z̈ = −kz − cż`, `c = 2δ`: `∫z = −([ż] + c[z])/k`; `[zż] = ∫ż² − k∫z² − δ[z²]`; and
//! `(ż + δz)² + ω²z²` decays as `exp(−2δt)`, whose integral is `∫ż² + k∫z² + δ[z²]`.

use std::f64::consts::{PI, TAU};
use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::angle::folded;
use crate::engine::lanes::block::Block;
use crate::engine::lanes::constants::{N0, R, T0};
use crate::engine::lanes::observe::Sums;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::swing::{Reached, Swing};
use crate::engine::lanes::vector::Vector;
use crate::engine::sums::{peak, sum};

impl<S: Simd, T: Scalar<S>> Sums<S, T> {
    /// Adds a step to the window.
    #[inline(always)]
    pub fn observe_swing(&mut self, b: &Block<S, T>, motion: &Swing<S, T>, end: &Reached<S, T>) {
        let (sticks, tau) = (motion.sticks, end.tau);
        let (zero, half) = (tau.like(0.0), tau.like(0.5));
        let damper = b.scene[R + 3];
        let [z0, v0, a0] = motion.begin;
        let [z1, v1] = end.state;
        let a1 = -(damper.fma(v1, b.scene[R] * z1));
        // ∫ exp(−2δt) dt.
        let damped = zero.less(motion.decay);
        let lost = -(end.decayed * (end.decayed + tau.like(2.0)));
        let span = damped.select(lost / damped.select(motion.decay * tau.like(2.0), tau.like(1.0)), tau);
        let straight = -((v1 - v0) + damper * (z1 - z0)) * motion.per_stiffness;
        let [square, speed] = squares(motion, span, [z0, v0], [z1, v1]);
        let [_, acceleration] = squares(motion, span, [v0, a0], [v1, a1]);
        // From the origin of the window; on the belt on a straight line.
        let from = motion.centre - self.origin[0];
        let mut position = from.fma(tau, straight);
        let mut positions = from.fma(from.fma(tau, straight + straight), square);
        let start = b.p[0] - self.origin[0];
        let way = b.belt * tau;
        position = sticks.select(tau * half.fma(way, start), position);
        let third = tau.like(1.0 / 3.0);
        positions = sticks.select(tau * start.fma(start + way, third * way * way), positions);
        let friction = (motion.force + b.scene[T0]) * tau;
        let on_belt = (b.scene[R] * half * way).fma(tau, friction);
        self.window[sum::TIME] += tau;
        self.window[sum::X] += position;
        self.window[sum::XX] += positions;
        self.window[sum::AX] += acceleration.only(sticks.not());
        self.window[sum::SPEED] += sticks.select(b.belt * way, speed);
        self.window[sum::TANGENTIAL] += sticks.select(on_belt, friction);
        self.window[sum::NORMAL] += b.scene[N0] * tau;
        self.window[sum::STICK] += tau.only(sticks);
        self.window[sum::REVERSE] += tau.only(b.reverse());
        let largest = motion.largest_acceleration(tau).max(a0.abs()).max(a1.abs());
        self.peaks[peak::AX] = self.peaks[peak::AX].max(largest.only(sticks.not()));
        self.peaks[peak::NORMAL] = self.peaks[peak::NORMAL].max(b.scene[N0]);
    }
}

/// `∫p²` and `∫q²` over a step of what swings, `p`, and of its derivative `q`, from their values at both ends; `span` is the
/// integral of the decay of their squares.
#[inline(always)]
fn squares<S: Simd, T: Scalar<S>>(
    motion: &Swing<S, T>,
    span: Vector<S, T>,
    [p0, q0]: [Vector<S, T>; 2],
    [p1, q1]: [Vector<S, T>; 2],
) -> [Vector<S, T>; 2] {
    let half = span.like(0.5);
    let (turning, across) = (motion.decay.fma(p0, q0), motion.omega * p0);
    let energy = turning.fma(turning, across * across) * span;
    let change = motion.decay * (p1 * p1 - p0 * p0);
    let sum = energy - change;
    let difference = p1 * q1 - p0 * q0 + change;
    // Of what is next to nothing beside the other the rounding may be negative; what is no number stays none.
    let (zero, p, q) =
        (span.like(0.0), (sum - difference) * half * motion.per_stiffness, (sum + difference) * half);
    // Written out: the closure of a `map` over an array is not inlined.
    [p.only(p.less(zero).not()), q.only(q.less(zero).not())]
}

impl<S: Simd, T: Scalar<S>> Swing<S, T> {
    /// The first extremum of the acceleration within `tau`, which is the largest; 0 without one.
    #[inline(always)]
    fn largest_acceleration(&self, tau: Vector<S, T>) -> Vector<S, T> {
        let t = folded(folded(self.phase - self.lag, TAU), PI) * self.per_omega;
        let size = self.largest(2);
        self.decayed(t).fma(size, size).only(t.less(tau))
    }
}
