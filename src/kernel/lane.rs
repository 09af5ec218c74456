//! Twin: shaders/lane.wgsl
//!
//! One instance advanced by iterations, one step or part of a step each.
//!
//! Time is counted in whole steps; an event splits a step, and what is left of it follows, so that every
//! lane is back on its grid of steps. The state lives in two flat records, as in the kernel's buffers.

#![expect(clippy::needless_range_loop, reason = "the loops are those of the WGSL twin")]

use super::crossing::{NEVER, first_crossing};
use super::observe::{Moment, Phase, Sums};
use super::scalar::Real;
use super::scene::{
    EVENTS_AT_ONCE, FIRST_HALF, OPEN_HALF, SECOND_HALF, SEGMENTS, SETTLE, Scene, Segment, Segments,
};
use super::series::{
    Body, Expansion, FREE, ORDER, REVERSE, SLIP, STICK, Series, evaluate, expand, largest, step_length,
};
use crate::outcome::Status;

/// What an event function belongs to.
pub const NOTHING: u32 = 0;
/// `v` falls to 0.
pub const REST: u32 = 1;
/// `|v|` falls to the lower kink.
pub const LOWER_KINK: u32 = 2;
/// `|v|` rises to the upper kink.
pub const UPPER_KINK: u32 = 3;
/// `N` falls to 0.
pub const LIFT_OFF: u32 = 4;
/// `T` leaves the stick cone forwards.
pub const CONE_FORWARD: u32 = 5;
/// `T` leaves the stick cone backwards.
pub const CONE_BACKWARD: u32 = 6;
/// `y2` returns to 0.
pub const GAP: u32 = 7;

/// Most events within [`STEPS_PER_COUNT`] steps.
pub const MAX_EVENTS_PER_COUNT: u32 = 20_000;

/// Steps over which events are counted.
pub const STEPS_PER_COUNT: u32 = 16;

/// Most parts of one step.
pub const MAX_PARTS: u32 = 100_000;

/// Roundings of the static loads that a force may be off by.
pub const ROUNDINGS: f64 = 8.0;
/// Events without time between them from which on a landing ends flight.
pub const HELD_FROM: u32 = 2;

/// What may be left of a step before it counts as done: this many roundings of what was left.
pub const LEAST_REST: f64 = 8.0;

/// The running integration of one instance.
#[derive(Clone, Debug)]
pub struct Lane<S> {
    /// Position and velocity.
    pub body: Body<S>,
    /// What is left of the present step, as a fraction of it.
    pub rest: S,
    /// Observables.
    pub sums: Sums<S>,
    /// Second pass over the window.
    pub phase: Phase<S>,
    /// Status; [`Status::Unwritten`] while running.
    pub status: Status,
    /// Iterations done.
    pub iterations: u32,
    /// Running segment.
    pub segment: u32,
    /// Whole steps done of it.
    pub index: u32,
    /// Contact state.
    pub contact: u32,
    /// Piece of the friction law.
    pub piece: u32,
    /// The event function that began at zero.
    pub disarmed: u32,
    /// Events without time between them.
    pub at_once: u32,
    /// Events since the last count began.
    pub counted: u32,
    /// Parts of the present step.
    pub parts: u32,
    /// Whether the window is passed the second time.
    pub second_pass: bool,
    /// State at the start of the window.
    pub snapshot: Body<S>,
    /// Contact state, piece, disarmed event at the start of the window.
    pub snapshot_flags: [u32; 3],
}

/// The belt during one step part.
#[derive(Clone, Copy, Debug)]
pub struct Belt<S> {
    /// Velocity.
    pub velocity: S,
    /// Acceleration.
    pub acceleration: S,
}

impl<S: Real> Lane<S> {
    /// Nothing yet.
    #[must_use]
    pub fn blank() -> Self {
        let body = Body { p: [S::ZERO; 3], v: [S::ZERO; 3] };
        Lane {
            body,
            rest: S::ONE,
            sums: Sums::new(),
            phase: Phase::new(),
            status: Status::Unwritten,
            iterations: 0,
            segment: 0,
            index: 0,
            contact: FREE,
            piece: 0,
            disarmed: NOTHING,
            at_once: 0,
            counted: 0,
            parts: 0,
            second_pass: false,
            snapshot: body,
            snapshot_flags: [FREE, 0, NOTHING],
        }
    }

    /// The start of an instance.
    #[must_use]
    pub fn new(scene: &Scene<S>) -> Self {
        let [x, w, vx, vw] = scene.start;
        let mut lane = Lane::blank();
        lane.body = Body { p: [x, S::ZERO, w], v: [vx, S::ZERO, vw] };
        let first = scene.segments[0];
        lane.enter_contact(scene, Belt { velocity: first.velocity, acceleration: first.acceleration });
        lane.take_snapshot();
        lane
    }

    /// Whether every segment is done.
    #[must_use]
    pub fn is_at_end(&self, segments: &Segments) -> bool {
        segments.get(self.segment as usize).is_none_or(|segment| segment[0] <= 0.0)
    }

    /// Runs to the end.
    pub fn run(&mut self, scene: &Scene<S>, tolerance: S) {
        while self.status == Status::Unwritten {
            self.iterate(scene, tolerance);
        }
    }

    /// One iteration.
    pub fn iterate(&mut self, scene: &Scene<S>, tolerance: S) {
        let segment = scene.segments[self.segment as usize];
        if S::from_f64(f64::from(self.index)) >= segment.steps {
            self.next_segment(scene);
            return;
        }
        self.iterations += 1;
        let elapsed = S::from_f64(f64::from(self.index)) + (S::ONE - self.rest);
        let belt = Belt {
            velocity: segment.velocity + segment.acceleration * (elapsed * segment.step),
            acceleration: segment.acceleration,
        };
        if self.contact == STICK {
            self.body.v[0] = belt.velocity;
        }
        let piece = &scene.pieces[self.piece as usize];
        let e = expand(scene, &self.body, self.contact, piece, belt.velocity, belt.acceleration);
        if self.contact <= REVERSE {
            let q = scene.friction(piece, self.sigma(), e.v[0], scene.v0 - e.v[0]).0;
            if S::ONE + scene.kappa * q <= S::ZERO {
                self.status = Status::Painleve;
                return;
            }
        }
        let remaining = self.rest * segment.step;
        let allowed = scene.longest[self.contact as usize];
        let mut longest = S::ZERO;
        // Shorter steps leave a position where it is.
        if allowed * allowed >= S::EPSILON {
            longest = step_length(&e, remaining.min(allowed), tolerance);
        }
        if longest <= S::ZERO {
            self.status = if self.body_is_finite() { Status::StepTooLarge } else { Status::NonFinite };
            return;
        }
        let (tau, event) = self.first_event(scene, &e, longest, tolerance);
        if tau > S::ZERO {
            self.observe(scene, &e, &segment, belt, tau);
            let (x, y, w) = (evaluate(&e.x, tau), evaluate(&e.y, tau), evaluate(&e.w, tau));
            self.body = Body { p: [x[0], y[0], w[0]], v: [x[1], y[1], w[1]] };
            self.disarmed = NOTHING;
        }
        if !self.body_is_finite() {
            self.status = Status::NonFinite;
            return;
        }
        self.advance_time(&segment, tau, tau >= remaining * (S::ONE - S::from_f64(LEAST_REST) * S::EPSILON));
        if event != NOTHING {
            self.count_event(tau);
            let then = Belt { velocity: belt.velocity + belt.acceleration * tau, ..belt };
            self.transition(scene, event, then);
        }
    }

    pub(crate) fn body_is_finite(&self) -> bool {
        self.body.p.iter().chain(&self.body.v).all(|value| value.is_finite())
    }

    /// `σ` of the present slip.
    fn sigma(&self) -> S {
        if self.contact == SLIP { S::ONE } else { -S::ONE }
    }

    /// Moves the clock by `tau`.
    fn advance_time(&mut self, segment: &Segment<S>, tau: S, whole: bool) {
        self.parts += 1;
        if whole {
            self.rest = S::ONE;
            self.index += 1;
            self.parts = 0;
            if self.index.is_multiple_of(STEPS_PER_COUNT) {
                self.counted = 0;
                self.sums.flush();
            }
        } else {
            self.rest -= tau / segment.step;
        }
        if self.parts > MAX_PARTS {
            self.status = Status::StepTooLarge;
        }
    }

    fn count_event(&mut self, tau: S) {
        self.at_once = if tau > S::ZERO { 0 } else { self.at_once + 1 };
        self.counted += 1;
        if self.at_once > EVENTS_AT_ONCE || self.counted > MAX_EVENTS_PER_COUNT {
            self.status = Status::EventLimit;
        }
    }

    /// Goes on to the next segment, the second pass, or the end.
    fn next_segment(&mut self, scene: &Scene<S>) {
        self.sums.flush();
        let before = part_of(&scene.segments[self.segment as usize]);
        self.segment += 1;
        self.index = 0;
        let done =
            self.segment as usize >= SEGMENTS || scene.segments[self.segment as usize].steps <= S::ZERO;
        if done {
            if self.second_pass || before == OPEN_HALF || !self.phase.prepare_phase(scene, &self.sums) {
                self.status = Status::Ok;
                return;
            }
            self.second_pass = true;
            self.body = self.snapshot;
            [self.contact, self.piece, self.disarmed] = self.snapshot_flags;
            self.segment = 0;
            while part_of(&scene.segments[self.segment as usize]) == SETTLE {
                self.segment += 1;
            }
            return;
        }
        let after = part_of(&scene.segments[self.segment as usize]);
        if before == SETTLE && after == FIRST_HALF && !self.second_pass {
            self.take_snapshot();
        }
    }

    /// Remembers the start of the window.
    pub fn take_snapshot(&mut self) {
        self.snapshot = self.body;
        self.snapshot_flags = [self.contact, self.piece, self.disarmed];
    }

    fn observe(&mut self, scene: &Scene<S>, e: &Expansion<S>, segment: &Segment<S>, belt: Belt<S>, tau: S) {
        let part = part_of(segment);
        let at = Moment { segment: self.segment, index: self.index, fraction: S::ONE - self.rest };
        if self.second_pass {
            self.phase.observe_phase(e, &self.sums, at, segment.step, tau);
            return;
        }
        if part != SETTLE {
            let origin = [self.snapshot.p[0], self.snapshot.p[2]];
            self.sums.observe_window(e, origin, scene.t0, self.contact, part, at, segment.step, tau);
            if self.contact == REVERSE {
                // What comes down to the velocity of the belt has not gone below it, which matters where that is 0.
                self.sums.previous = self.sums.previous.max(belt.velocity + belt.acceleration * tau);
            }
        }
        self.sums.observe_growth(e, tau);
    }

    /// The first event within `longest` and its time, or the whole.
    fn first_event(&self, scene: &Scene<S>, e: &Expansion<S>, longest: S, tolerance: S) -> (S, u32) {
        let mut tau = longest;
        let mut event = NOTHING;
        // Forces of the state differ from those of the truncated series by the tolerance on the motion, and by
        // the rounding of the static loads.
        let motion = largest(e, 0) + largest(e, 1) + largest(e, 2);
        let size = scene.n0 * (S::ONE + scene.mu_stick) + e.n[0].abs() + e.t[0].abs();
        let rounding =
            tolerance * (scene.k1 + scene.k2) * motion + S::from_f64(ROUNDINGS) * S::EPSILON * size;
        let mut watch = |g: &Series<S>, degree: usize, from_zero: bool, which: u32| {
            // The gap opens with ÿ2 = −N/det.
            let rounding = if which == GAP { rounding * scene.inv_det } else { rounding };
            // Positions and velocities are those of the state; forces follow from the series.
            let of_state = which == GAP || which <= UPPER_KINK;
            let near = if of_state { S::ZERO } else { rounding };
            if tau > S::ZERO {
                let at = first_crossing(g, degree, tau, from_zero, near, rounding);
                if at > S::from_f64(NEVER) {
                    tau = at;
                    event = which;
                }
            }
        };
        if self.contact == FREE {
            watch(&e.y, ORDER, self.disarmed == GAP, GAP);
        } else if self.contact == STICK {
            let mut forward = [S::ZERO; ORDER + 1];
            let mut backward = [S::ZERO; ORDER + 1];
            for k in 0..=ORDER - 2 {
                let normal = if k == 0 { e.n[0] - scene.n0 } else { e.n[k] };
                forward[k] = scene.mu_stick * normal - e.t[k];
                backward[k] = scene.mu_stick * normal + e.t[k];
            }
            forward[0] += scene.cone[0];
            backward[0] += scene.cone[1];
            watch(&forward, ORDER - 2, false, CONE_FORWARD);
            watch(&backward, ORDER - 2, false, CONE_BACKWARD);
            watch(&e.n, ORDER - 2, false, LIFT_OFF);
        } else {
            watch(&e.n, ORDER - 2, false, LIFT_OFF);
            let sigma = self.sigma();
            let mut speed = [S::ZERO; ORDER + 1];
            for k in 0..ORDER {
                speed[k] = sigma * e.v[k];
            }
            let start = speed[0];
            if self.piece == 0 {
                watch(&speed, ORDER - 1, self.disarmed == REST, REST);
            } else {
                speed[0] = start - scene.pieces[self.piece as usize - 1].kink;
                watch(&speed, ORDER - 1, self.disarmed == LOWER_KINK, LOWER_KINK);
            }
            if (self.piece as usize) + 1 < scene.pieces.len() {
                for k in 0..ORDER {
                    speed[k] = -(sigma * e.v[k]);
                }
                speed[0] = scene.pieces[self.piece as usize].kink - start;
                watch(&speed, ORDER - 1, self.disarmed == UPPER_KINK, UPPER_KINK);
            }
        }
        (tau, event)
    }

    /// Carries out the transition of an event.
    pub(crate) fn transition(&mut self, scene: &Scene<S>, event: u32, belt: Belt<S>) {
        self.sums.close_growth();
        match event {
            LOWER_KINK => {
                self.piece -= 1;
                self.disarmed = UPPER_KINK;
            }
            UPPER_KINK => {
                self.piece += 1;
                self.disarmed = LOWER_KINK;
            }
            REST => self.at_rest(scene, belt),
            CONE_FORWARD => self.slip_or_free(scene, S::ONE, S::ZERO, true),
            CONE_BACKWARD => self.slip_or_free(scene, -S::ONE, S::ZERO, true),
            LIFT_OFF => self.enter(FREE, false),
            _ => self.impact(scene, belt),
        }
    }

    /// `R − μ0 N0` and `W − N0` at the present state.
    fn loads(&self, scene: &Scene<S>) -> [S; 2] {
        let [x, y, w] = self.body.p;
        let [vx, vy, vw] = self.body.v;
        let h = scene.k2 * (x * scene.s + y * scene.c - w) + scene.c2 * (vx * scene.s + vy * scene.c - vw);
        let g = scene.k1 * (x * scene.c - y * scene.s) + scene.c1 * (vx * scene.c - vy * scene.s);
        [scene.c * g + scene.s * h, scene.c * h - scene.s * g]
    }

    /// Slip in direction `sigma` at `speed`, or flight when its normal force is not positive.
    fn slip_or_free(&mut self, scene: &Scene<S>, sigma: S, speed: S, at_rest: bool) {
        let piece = scene.piece_at(speed);
        let v = sigma * speed;
        let q = scene.friction(&scene.pieces[piece], sigma, v, scene.v0 - v).0;
        if S::ONE + scene.kappa * q <= S::ZERO {
            self.status = Status::Painleve;
            return;
        }
        let [r, w] = self.loads(scene);
        // A body that lands again and again without time between is held: the force is zero within rounding, and
        // flight does not open the gap.
        let held = self.contact == FREE && self.at_once >= HELD_FROM;
        if held || (w + scene.n0) + scene.kappa * (r + scene.t0) > S::ZERO {
            #[expect(clippy::cast_possible_truncation, reason = "a table has fewer than 2^32 rows")]
            let piece = piece as u32;
            self.piece = piece;
            self.enter(if sigma > S::ZERO { SLIP } else { REVERSE }, at_rest);
        } else {
            self.enter(FREE, false);
        }
    }

    fn enter(&mut self, contact: u32, at_rest: bool) {
        self.contact = contact;
        self.disarmed = NOTHING;
        if contact == FREE {
            self.disarmed = GAP;
        } else if contact <= REVERSE && at_rest {
            self.disarmed = REST;
        }
    }

    /// Decides the contact state at `v = 0`.
    fn at_rest(&mut self, scene: &Scene<S>, belt: Belt<S>) {
        self.body.v[0] = belt.velocity;
        let [r, w] = self.loads(scene);
        let tangential = r + belt.acceleration;
        let normal = w - scene.kappa * belt.acceleration;
        let forward = scene.mu_stick * normal - tangential + scene.cone[0];
        let backward = scene.mu_stick * normal + tangential + scene.cone[1];
        if forward >= S::ZERO && backward >= S::ZERO {
            self.enter(STICK, true);
        } else {
            let sigma = if tangential + scene.t0 >= S::ZERO { S::ONE } else { -S::ONE };
            self.slip_or_free(scene, sigma, S::ZERO, true);
        }
    }

    /// Decides the contact state of a closed contact.
    pub(crate) fn enter_contact(&mut self, scene: &Scene<S>, belt: Belt<S>) {
        let v = belt.velocity - self.body.v[0];
        if v > S::ZERO {
            self.slip_or_free(scene, S::ONE, v, false);
        } else if v < S::ZERO {
            self.slip_or_free(scene, -S::ONE, -v, false);
        } else {
            self.at_rest(scene, belt);
        }
    }

    /// `Δẋ2` of an impact that changes `ẏ2` by `change` with `P_t = q P_n`.
    fn tangential_jump(&mut self, scene: &Scene<S>, q: S, change: S) -> S {
        let inertia = S::ONE + scene.kappa * q;
        if inertia <= S::ZERO {
            self.status = Status::Painleve;
            return S::ZERO;
        }
        (scene.normal_mass * q + scene.kappa) / inertia * change
    }

    /// Newton's impact with friction inside its cone, see [`crate::model::contact`].
    fn impact(&mut self, scene: &Scene<S>, belt: Belt<S>) {
        let in_window = part_of(&scene.segments[self.segment as usize]) != SETTLE;
        if in_window && !self.second_pass {
            self.sums.count_impact();
        }
        let vx = self.body.v[0];
        let vy = self.body.v[1].min(S::ZERO);
        let mut rebound = -(scene.restitution * vy);
        if rebound < scene.slowest_rebound {
            rebound = S::ZERO;
        }
        let change = rebound - vy;
        let relative = belt.velocity - vx;
        let mut after = belt.velocity;
        if scene.impact_friction > S::ZERO {
            let limit = scene.mu(relative.abs());
            let q = if relative < S::ZERO { -limit } else { limit };
            let jump = self.tangential_jump(scene, q, change);
            let tangential = relative - scene.kappa * change;
            let normal = scene.normal_mass * change - scene.kappa * relative;
            if (relative - jump) * relative > S::ZERO {
                after = vx + jump;
            } else if tangential.abs() > limit * normal {
                after = vx + self.tangential_jump(scene, -q, change);
            }
        } else {
            after = vx + self.tangential_jump(scene, S::ZERO, change);
        }
        self.body.p[1] = S::ZERO;
        self.body.v[0] = after;
        self.body.v[1] = rebound;
        if rebound > S::ZERO {
            self.enter(FREE, false);
        } else {
            self.enter_contact(scene, belt);
        }
    }
}

/// The part of the run a segment belongs to.
fn part_of<S: Real>(segment: &Segment<S>) -> u32 {
    if segment.part < S::from_f64(0.5) {
        SETTLE
    } else if segment.part < S::from_f64(1.5) {
        FIRST_HALF
    } else if segment.part < S::from_f64(2.5) {
        SECOND_HALF
    } else {
        OPEN_HALF
    }
}
