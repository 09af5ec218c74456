//! A run on a kernel, window by window, until it is settled (host only).
//!
//! The kernel knows nothing of settling: it is given one window after another, each going on from the words the
//! one before has left, and makes the second pass over the last of them only.

use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::observe;
use crate::engine::kernel::observe::{Phase, Sums};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{SECOND_HALF, SEGMENTS, Segments};
use crate::engine::kernel::segments::{segments, window_segments};
use crate::engine::kernel::table::segment;
use crate::engine::measuring::Measuring;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reductions::{End, Reductions};
use crate::engine::scene::Scene;
use crate::engine::sums::growth;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// The windows of one instance: one, or as many as it takes to settle.
#[derive(Clone, Debug)]
pub struct Windows {
    /// The segments that the kernel is to run next.
    pub segments: Segments,
    plan: Plan,
    measuring: Measuring,
    /// Time at the beginning of the segments.
    start: f64,
    growth: [f64; growth::WORDS],
    growing: bool,
}

impl Windows {
    /// The first window of an instance.
    #[must_use]
    pub fn new(instance: &Instance, scene: &Scene, plan: &Plan) -> Windows {
        let measuring = Measuring::new(instance, scene, plan);
        let segments = if measuring.until_settled() {
            window_segments(scene, plan, measuring.start(), measuring.half())
        } else {
            segments(scene, plan)
        };
        Windows { segments, plan: *plan, measuring, start: 0.0, growth: [0.0; growth::WORDS], growing: true }
    }

    /// Takes what a lane has come to. `None`: it is to be run again, from what it is now, over the new segments.
    pub fn take<S: Real>(&mut self, scene: &Scene, lane: &mut Lane<S>) -> Option<Outcome> {
        let (mut seen, end) = reductions(&self.segments, lane);
        let end = End { time: self.start + end.time, ..end };
        if self.measuring.until_settled() {
            if !self.measuring.is_over() {
                self.add_growth(&seen.growth, lane.sums.growth_closed);
            }
            seen.growth = self.growth;
            seen.met_event = !self.growing;
        }
        let outcome = seen.outcome(scene, &self.plan, &end);
        if outcome.status != Status::Ok || !self.measuring.until_settled() || self.measuring.is_over() {
            return Some(self.measuring.told(outcome, scene));
        }
        if self.measuring.goes_on(&outcome, seen.frequency(), lane.sums.growth_closed, end.time) {
            self.start = end.time;
            self.segments = window_segments(scene, &self.plan, 0.0, self.measuring.half());
            lane.next_window();
        } else {
            for words in &mut self.segments {
                words[segment::PART] = words[segment::PART].min(f64::from(SECOND_HALF));
            }
            lane.back_to_the_end(&self.segments);
        }
        None
    }

    /// Adds the growth of a window as long as no event has come.
    fn add_growth(&mut self, growth: &[f64; growth::WORDS], closed: bool) {
        if self.growing {
            for (total, word) in self.growth.iter_mut().zip(growth) {
                *total += word;
            }
        }
        self.growing &= !closed;
    }
}

impl<S: Real> Lane<S> {
    /// Goes on with another window from here. Its first event closes its growth, so that it tells whether it had
    /// any.
    fn next_window(&mut self) {
        self.state.status = Status::Unwritten;
        [self.segment, self.index] = [0; 2];
        self.second_pass = false;
        self.sums = Sums::new();
        self.phase = Phase::new();
        self.take_snapshot();
    }

    /// Stands before the decision about a second pass once more.
    fn back_to_the_end(&mut self, segments: &Segments) {
        self.state.status = Status::Unwritten;
        self.segment -= 1;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number of steps"
        )]
        let steps = segments[self.segment as usize][segment::STEPS] as u32;
        self.index = steps;
    }
}

/// The sums of a finished lane, and how it ended. Times count from the beginning of the segments.
#[must_use]
pub fn reductions<S: Real>(segments: &Segments, lane: &Lane<S>) -> (Reductions, End) {
    let time = |segment: u32, index: u32, fraction: f64| -> f64 {
        let before: f64 = segments[..(segment as usize).min(SEGMENTS)]
            .iter()
            .map(|s| s[segment::STEPS] * s[segment::STEP])
            .sum();
        let step = segments.get(segment as usize).map_or(0.0, |s| s[segment::STEP]);
        before + (f64::from(index) + fraction) * step
    };
    let moment = |m: &observe::Moment<S>| time(m.segment, m.index, m.fraction.to_f64());
    let sums = &lane.sums;
    let reductions = Reductions {
        origin: [lane.snapshot.body.p[0], lane.snapshot.body.p[2]].map(Real::to_f64),
        halves: sums.total.map(|half| half.map(Real::to_f64)),
        peaks: sums.peaks.map(Real::to_f64),
        impacts: u64::from(sums.impacts),
        crossings: u64::from(sums.crossings),
        first: moment(&sums.first),
        last: moment(&sums.last),
        phase: [lane.phase.x, lane.phase.y].map(|part| part.map(Real::to_f64)),
        growth: sums.growth.map(Real::to_f64),
        met_event: sums.growth_closed,
    };
    let end = End {
        status: lane.state.status,
        steps: u64::from(lane.iterations),
        time: time(lane.segment, lane.index, 0.0),
    };
    (reductions, end)
}
