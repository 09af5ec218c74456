//! The single mass between two events in closed form: with constant friction on a belt of one velocity it swings about
//! the point where friction holds the spring, `z = exp(−δt) (a cos ωt + b sin ωt)`, or sticks and moves on a straight line.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::angle::{about_arccos, angle_of, far_rotation, folded};
use crate::engine::lanes::block::{AT_ZERO, Block, OFFSET, SECOND, THIRD};
use crate::engine::lanes::constants::{CONE, MU0, N0, R, SWING};
use crate::engine::lanes::friction::exp_m1;
use crate::engine::lanes::root::SOLVER_ITERATIONS;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::precision::Precision;

/// The longest step of a lane, so that those that rest have a finite one.
const LONGEST: f64 = 1e6;

/// An angle by which the sign of a number that is about zero may mislead.
const UNSURE: f64 = 0.5;

/// The motion of every lane from its present state on.
#[derive(Clone, Copy, Debug)]
pub struct Swing<S: Simd, T: Scalar<S>> {
    /// Lanes that stick.
    pub sticks: Mask<S, T>,
    /// The point about which the others swing.
    pub centre: Vector<S, T>,
    /// Distance from it, velocity and acceleration at the beginning.
    pub begin: [Vector<S, T>; 3],
    /// What turns with the sine in each, where that turns with the cosine.
    pub sine: [Vector<S, T>; 3],
    /// Friction less that of the equilibrium, or what the spring and the damper take of it.
    pub force: Vector<S, T>,
    /// `σ`.
    pub sigma: Vector<S, T>,
    /// The angle by which `σ` times the acceleration is behind its maximum, in `(−π, π]`.
    pub phase: Vector<S, T>,
    /// The constants of [`SWING`].
    pub decay: Vector<S, T>,
    /// Angular frequency.
    pub omega: Vector<S, T>,
    /// Its inverse.
    pub per_omega: Vector<S, T>,
    /// The inverse of the stiffness.
    pub per_stiffness: Vector<S, T>,
    /// By how much of a turn a velocity is less than a quarter ahead of its position.
    pub lag: Vector<S, T>,
    /// Whether any lane is damped.
    damped: bool,
}

/// Where a step ends.
#[derive(Clone, Copy, Debug)]
pub struct Reached<S: Simd, T: Scalar<S>> {
    /// Its length.
    pub tau: Vector<S, T>,
    /// `exp(−δτ) − 1`.
    pub decayed: Vector<S, T>,
    /// Distance from the centre of the swing and velocity; those that stick have no such distance.
    pub state: [Vector<S, T>; 2],
    /// The event function that ends it, 0 for none.
    pub event: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Swing<S, T> {
    /// From the states of all lanes, whose sticking ones move as their belts do.
    #[inline(always)]
    pub fn new(b: &Block<S, T>) -> Self {
        let (sticks, sigma) = (b.stick(), b.sigma());
        let forward = sigma.like(0.0).less(sigma);
        let (decay, omega, per_omega) = (b.scene[SWING], b.scene[SWING + 1], b.scene[SWING + 2]);
        let (per_stiffness, lag) = (b.scene[SWING + 3], b.scene[SWING + 4]);
        let less = forward.select(b.piece[OFFSET], -(b.piece[AT_ZERO] + b.scene[MU0]));
        let (stiffness, damper) = (b.scene[R], b.scene[R + 3]);
        let (x, v) = (b.p[0], b.v[0]);
        let held = damper.fma(v, stiffness * x);
        let force = sticks.select(held, less * b.scene[N0]);
        let a = force - held;
        let jerk = -(damper.fma(a, stiffness * v));
        let centre = force * per_stiffness;
        let z = x - centre;
        let sine = [decay.fma(z, v) * per_omega, decay.fma(v, a) * per_omega, decay.fma(a, jerk) * per_omega];
        let phase = angle_of([sigma * a, sigma * sine[2]]);
        let damped = decay.like(0.0).less(decay).any();
        Swing {
            sticks,
            centre,
            begin: [z, v, a],
            sine,
            force,
            sigma,
            phase,
            decay,
            omega,
            per_omega,
            per_stiffness,
            lag,
            damped,
        }
    }

    /// The largest value that the derivative `n` would have at its first extremum, had nothing decayed since the beginning.
    #[inline(always)]
    pub fn largest(&self, n: usize) -> Vector<S, T> {
        let square = self.begin[n].fma(self.begin[n], self.sine[n] * self.sine[n]);
        self.omega * (square * self.per_stiffness).sqrt()
    }

    /// `exp(−δt) − 1`.
    #[inline(always)]
    pub fn decayed(&self, t: Vector<S, T>) -> Vector<S, T> {
        if self.damped { exp_m1(t.like(0.0) - self.decay * t) } else { t.like(0.0) }
    }

    /// Distance from the centre and velocity at `t`, and what [`Swing::decayed`] is there.
    #[inline(always)]
    fn at(&self, t: Vector<S, T>) -> ([Vector<S, T>; 2], Vector<S, T>) {
        let ([cosine, sine], short) = far_rotation(self.omega * t);
        let decayed = self.decayed(t);
        let rest = decayed + short;
        let mut state = [self.begin[0], self.begin[1]];
        for i in 0..2 {
            let free = state[i].fma(cosine, self.sine[i] * sine);
            state[i] = free.fma(rest, free);
        }
        (state, decayed)
    }

    /// The next event, at most `left` ahead. Without one it is the end of the step: the end of `left` or the place where the
    /// sliding speed is least, whichever comes first. Lanes that are `short` take no longer steps than that.
    #[inline(always)]
    pub fn reach(&self, b: &Block<S, T>, short: Mask<S, T>) -> Reached<S, T> {
        let (zero, one) = (b.left.like(0.0), b.left.like(1.0));
        let sticks = self.sticks;
        // The belt carries the body to the edge of the cone.
        let ahead = zero.less(b.belt);
        let speed = b.belt.abs();
        let margin = ahead.select(b.scene[CONE] - self.force, b.scene[CONE + 1] + self.force);
        let pull = b.scene[R] * speed;
        let lasts = (margin / zero.less(pull).select(pull, one)).max(zero);
        let lasts = zero.less(pull).select(lasts, one.like(LONGEST));
        // The sliding speed is least a quarter of a turn behind the maximum of the acceleration, not where it has just begun.
        let least = folded(self.phase + one.like(FRAC_PI_2), TAU);
        let begins = zero.less(b.disarmed).and(least.less(one.like(UNSURE)));
        let least = begins.select(least + one.like(TAU), least) * self.per_omega;
        let longest = short.select(b.step, one.like(LONGEST));
        let end = sticks.select(lasts, least);
        let mut tau = end.min(b.left).min(longest);
        let cone = sticks.and(lasts.at_most(tau));
        let ([z, v], mut decayed) = self.at(tau);
        let v = sticks.select(b.belt, v);
        let mut state = [z, v];
        let kink = ahead.select(one.like(f64::from(SECOND)), one.like(f64::from(THIRD)));
        let mut event = kink.only(cone);
        // It falls from its largest value on.
        let from = (least - self.per_omega * one.like(PI)).max(zero);
        let stops = (self.sigma * (b.belt - v)).not_positive().and(from.at_most(tau)).and(sticks.not());
        if stops.any() {
            let (root, position, there) = self.rest(b, stops, [from, tau], least);
            tau = stops.select(root, tau);
            decayed = stops.select(there, decayed);
            state = [stops.select(position, state[0]), stops.select(b.belt, state[1])];
            event = stops.select(one.like(f64::from(SECOND)), event);
        }
        Reached { tau, decayed, state, event }
    }

    /// Where the lanes `live` reach the velocity of their belts on the way from the largest sliding speed to the least, in
    /// a bracket; the distance from the centre there, and what [`Swing::decayed`] is.
    #[inline(always)]
    fn rest(
        &self,
        b: &Block<S, T>,
        live: Mask<S, T>,
        [mut low, mut high]: [Vector<S, T>; 2],
        least: Vector<S, T>,
    ) -> (Vector<S, T>, Vector<S, T>, Vector<S, T>) {
        let (zero, one, two) = (low.like(0.0), low.like(1.0), low.like(2.0));
        // As if the amplitude stayed what it is at the end, where the velocity is `cos(lag)` of it and hardly changes.
        let amplitude = self.largest(1);
        let amplitude = self.decayed(least).fma(amplitude, amplitude);
        let known = zero.less(amplitude);
        let cosine = (self.sigma * b.belt / known.select(amplitude, one)).min(one).max(-one);
        let mut t = (least - about_arccos(cosine) * self.per_omega).max(low).min(high);
        let enough = self.per_omega
            * one.like(match T::PRECISION {
                Precision::F32 => 2.5e-3,
                Precision::F64 => 1e-4,
            });
        let (stiffness, damper) = (b.scene[R], b.scene[R + 3]);
        let mut active = live;
        let (mut at, mut position, mut there) = (t, zero, zero);
        for _ in 0..SOLVER_ITERATIONS {
            let ([z, v], here) = self.at(t);
            let a = -(damper.fma(v, stiffness * z));
            let jerk = -(damper.fma(a, stiffness * v));
            let over = v - b.belt;
            let before = (self.sigma * over).less(zero);
            low = before.select(t, low);
            high = before.select(high, t);
            // Halley's method; where it leads out, the middle.
            let denominator = two * a * a - over * jerk;
            // Next to an extremum its step is short, however far the root.
            let rises = zero.less(self.sigma * a).and(zero.less(denominator));
            let rises = rises.and(denominator.at_most(one.like(4.0) * a * a));
            let halley = t - two * over * a / rises.select(denominator, one);
            let good = rises.and(low.at_most(halley)).and(halley.at_most(high));
            let next = good.select(halley, (low + high) * one.like(0.5));
            let step = next - t;
            // What little is left by the series.
            let moved = step.fma(step.fma(step.fma(jerk * one.like(1.0 / 6.0), a * one.like(0.5)), v), z);
            position = active.select(moved, position);
            let lost = self.decay * step;
            let lost = (lost * lost).fma(one.like(0.5), -lost);
            there = active.select((here + one).fma(lost, here), there);
            at = active.select(next, at);
            t = next;
            active = active.and(enough.less(step.abs()));
            if !active.any() {
                break;
            }
        }
        (at, position, there)
    }

    /// Lanes whose velocity rises over zero on the way to `end`, and when.
    #[inline(always)]
    pub fn rises(&self, end: &Reached<S, T>) -> (Mask<S, T>, Vector<S, T>) {
        let zero = end.tau.like(0.0);
        let unsure = zero.like(UNSURE);
        let half = zero.less(self.sigma).select(zero, zero.like(PI));
        let angle = folded(self.phase + half + self.lag, TAU);
        let (below, turned) = (self.begin[1].less(zero), self.omega * end.tau);
        // The signs decide where the angle is about 0 or a turn.
        let late = below.and(zero.like(TAU - UNSURE).less(angle));
        let early = below.not().and(angle.less(unsure));
        let angle = late.select(zero, early.select(angle + zero.like(TAU), angle));
        let ends_below = end.state[1].less(zero);
        let through = ends_below.not().and(below.or(angle.less(turned + unsure)));
        let over = ends_below.and(below).and(angle.less(turned - unsure));
        let crossed = through.or(over).and(self.sticks.not());
        (crossed, (angle * self.per_omega).min(end.tau))
    }
}
