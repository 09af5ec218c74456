//! Twin: shaders/lane.wgsl
//!
//! One instance advanced by iterations, one step or part of a step each.
//!
//! Time is counted in whole steps; an event splits a step, and what is left of it follows, so that every
//! lane is back on its grid of steps. The state lives in two flat records, as in the kernel's buffers.

#![expect(clippy::needless_range_loop, reason = "the loops are those of the WGSL twin")]

use std::f64::consts::TAU;

use crate::engine::kernel::contact::{
    Belt, CONE_BACKWARD, CONE_FORWARD, GAP, LIFT_OFF, LOWER_KINK, NOTHING, REST, State, UPPER_KINK,
};
use crate::engine::kernel::crossing::{NEVER, first_crossing};
use crate::engine::kernel::observe::{Moment, Phase, Sums};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{
    EVENTS_AT_ONCE, FIRST_HALF, NO_KINK, OPEN_HALF, SECOND_HALF, SEGMENTS, SETTLE, Scene, Segment, Segments,
};
use crate::engine::kernel::series::{
    Body, Expansion, FREE, REVERSE, SLIP, STICK, Series, evaluate, expand, largest, step_length,
};
use crate::engine::kernel::steps::ORDER;
use crate::engine::reference::bounds::MAX_EVENTS_PER_PERIOD;
use crate::engine::reference::bounds::MAX_STEPS_PER_PERIOD;
use crate::engine::reference::bounds::ROUNDINGS;
use crate::engine::scene::MOST_STEPS;
use crate::model::status::Status;

/// Steps whose sums are added up before they join the others.
pub const STEPS_PER_SUM: u32 = 16;

/// A step counts as done when no more than this many roundings of it are left.
pub const LEAST_REST: f64 = 8.0;

/// The running integration of one instance.
#[derive(Clone, Debug)]
pub struct Lane<S> {
    /// Body, contact and status.
    pub state: State<S>,
    /// The rest of the present step, as a fraction of the step.
    pub rest: S,
    /// Observables.
    pub sums: Sums<S>,
    /// Second pass over the window.
    pub phase: Phase<S>,
    /// Iterations done.
    pub iterations: u32,
    /// Running segment.
    pub segment: u32,
    /// Whole steps done of it.
    pub index: u32,
    /// Events since the last period began.
    pub counted: u32,
    /// Parts of steps since then.
    pub parts: u32,
    /// Whether the window is passed the second time.
    pub second_pass: bool,
    /// State at the start of the window.
    pub snapshot: State<S>,
}

impl<S: Real> Lane<S> {
    /// Nothing yet.
    #[must_use]
    pub fn blank() -> Self {
        Lane {
            state: State::blank(),
            rest: S::ONE,
            sums: Sums::new(),
            phase: Phase::new(),
            iterations: 0,
            segment: 0,
            index: 0,
            counted: 0,
            parts: 0,
            second_pass: false,
            snapshot: State::blank(),
        }
    }

    /// The start of an instance.
    #[must_use]
    pub fn new(scene: &Scene<S>) -> Self {
        let first = scene.segments[0];
        let belt = Belt { velocity: first.velocity, acceleration: first.acceleration };
        let mut lane = Lane { state: State::new(scene, belt), ..Lane::blank() };
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
        while self.state.status == Status::Unwritten {
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
        if self.state.contact == STICK {
            self.state.body.v[0] = belt.velocity;
        }
        let piece = &scene.pieces[self.state.piece as usize];
        let e = expand(scene, &self.state.body, self.state.contact, piece, belt.velocity, belt.acceleration);
        let mut on_law = S::from_f64(NO_KINK);
        if self.state.contact <= REVERSE {
            let q = scene.friction(piece, self.sigma(), e.v[0], scene.v0 - e.v[0]).0;
            if S::ONE + scene.kappa * q <= S::ZERO {
                self.state.status = Status::Painleve;
                return;
            }
            on_law = piece.rate;
            if !scene.law.is_straight() {
                on_law = scene.longest_in_layer(piece, q, e.v[0], e.v[1]);
            }
        }
        let remaining = self.rest * segment.step;
        let allowed = scene.longest[self.state.contact as usize];
        let mut longest = S::ZERO;
        // Shorter steps leave a position where it is.
        if allowed * allowed >= S::EPSILON {
            longest = step_length(&e, remaining.min(allowed).min(on_law), tolerance);
        }
        if longest <= S::ZERO {
            self.state.status = if self.body_is_finite() { Status::StepTooLarge } else { Status::NonFinite };
            return;
        }
        let (tau, event) = self.first_event(scene, &e, longest, tolerance);
        if tau > S::ZERO {
            self.observe(scene, &e, &segment, belt, tau);
            let (x, y, w) = (evaluate(&e.x, tau), evaluate(&e.y, tau), evaluate(&e.w, tau));
            self.state.body = Body { p: [x[0], y[0], w[0]], v: [x[1], y[1], w[1]] };
            self.state.disarmed = NOTHING;
        }
        if !self.body_is_finite() {
            self.state.status = Status::NonFinite;
            return;
        }
        self.advance_time(&segment, tau, tau >= remaining * (S::ONE - S::from_f64(LEAST_REST) * S::EPSILON));
        if event != NOTHING {
            self.count_event(tau);
            let then = Belt { velocity: belt.velocity + belt.acceleration * tau, ..belt };
            self.carry_out(scene, event, then);
        }
    }

    fn body_is_finite(&self) -> bool {
        self.state.is_finite()
    }

    /// `σ` of the present slip.
    fn sigma(&self) -> S {
        if self.state.contact == SLIP { S::ONE } else { -S::ONE }
    }

    /// Moves the clock by `tau`.
    fn advance_time(&mut self, segment: &Segment<S>, tau: S, whole: bool) {
        self.parts += 1;
        if whole {
            self.rest = S::ONE;
            self.index += 1;
            if self.index.is_multiple_of(STEPS_PER_SUM) {
                self.sums.flush();
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "what is beyond all that are counted may be the most of them"
            )]
            let period = ((S::from_f64(TAU) / segment.step).to_f64() as u32).max(1);
            if self.index.is_multiple_of(period) {
                self.counted = 0;
                self.parts = 0;
            }
        } else {
            self.rest -= tau / segment.step;
        }
        // The second pass takes no step that the first has not.
        let endless = self.iterations > MOST_STEPS && !self.second_pass;
        if self.parts > MAX_STEPS_PER_PERIOD || endless {
            self.state.status = Status::StepTooLarge;
        }
    }

    fn count_event(&mut self, tau: S) {
        self.state.at_once = if tau > S::ZERO { 0 } else { self.state.at_once + 1 };
        self.counted += 1;
        if self.state.at_once > EVENTS_AT_ONCE || self.counted > MAX_EVENTS_PER_PERIOD {
            self.state.status = Status::EventLimit;
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
                self.state.status = Status::Ok;
                return;
            }
            self.second_pass = true;
            self.restore_snapshot();
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
        self.snapshot = self.state;
    }

    fn restore_snapshot(&mut self) {
        self.state.return_to(&self.snapshot);
    }

    fn observe(&mut self, scene: &Scene<S>, e: &Expansion<S>, segment: &Segment<S>, belt: Belt<S>, tau: S) {
        let part = part_of(segment);
        let at = Moment { segment: self.segment, index: self.index, fraction: S::ONE - self.rest };
        if self.second_pass {
            self.phase.observe_phase(e, &self.sums, at, segment.step, tau);
            return;
        }
        if part != SETTLE {
            let origin = [self.snapshot.body.p[0], self.snapshot.body.p[2]];
            self.sums.observe_window(e, origin, scene.t0, self.state.contact, part, at, segment.step, tau);
            if self.state.contact == REVERSE {
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
        if self.state.contact == FREE {
            watch(&e.y, ORDER, self.state.disarmed == GAP, GAP);
        } else if self.state.contact == STICK {
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
            if self.state.piece == 0 {
                watch(&speed, ORDER - 1, self.state.disarmed == REST, REST);
            } else {
                speed[0] = start - scene.pieces[self.state.piece as usize - 1].kink;
                watch(&speed, ORDER - 1, self.state.disarmed == LOWER_KINK, LOWER_KINK);
            }
            if (self.state.piece as usize) + 1 < scene.pieces.len() {
                for k in 0..ORDER {
                    speed[k] = -(sigma * e.v[k]);
                }
                speed[0] = scene.pieces[self.state.piece as usize].kink - start;
                watch(&speed, ORDER - 1, self.state.disarmed == UPPER_KINK, UPPER_KINK);
            }
        }
        (tau, event)
    }

    /// Carries out an event.
    fn carry_out(&mut self, scene: &Scene<S>, event: u32, belt: Belt<S>) {
        self.sums.close_growth();
        let in_window = part_of(&scene.segments[self.segment as usize]) != SETTLE;
        if event == GAP && in_window && !self.second_pass {
            self.sums.count_impact();
        }
        self.state.transition(scene, event, belt);
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
