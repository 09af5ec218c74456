//! A run on a kernel, window by window, until it is settled (host only).
//!
//! The kernel knows nothing of settling: it is given one window after another, each going on from the words the
//! one before has left, and makes the second pass over the last of them only.

use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::observe;
use crate::engine::kernel::observe::{Phase, Sums};
use crate::engine::kernel::reductions::{End, GROWTH, Reductions};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{SECOND_HALF, SEGMENTS, Segments};
use crate::engine::kernel::segments::{segments, window_segments};
use crate::engine::outcome::{Ending, Outcome};
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use crate::engine::settling::Settling;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// The windows of one instance: one, or as many as it takes to settle.
#[derive(Clone, Debug)]
pub struct Windows {
    /// The segments that the kernel is to run next.
    pub segments: Segments,
    plan: Plan,
    settling: Option<Settling>,
    ending: Option<Ending>,
    /// Time at the beginning of the segments, and of the window in them.
    start: [f64; 2],
    growth: [f64; GROWTH],
    growing: bool,
}

impl Windows {
    /// The first window of an instance.
    #[must_use]
    pub fn new(instance: &Instance, scene: &Scene, plan: &Plan) -> Windows {
        let settling = Settling::new(instance, scene, plan);
        let segments = match &settling {
            None => segments(scene, plan),
            Some(settling) => window_segments(scene, plan, scene.scaled(plan.settle), settling.half(None)),
        };
        Windows {
            segments,
            plan: *plan,
            settling,
            ending: None,
            start: [0.0, scene.scaled(plan.settle)],
            growth: [0.0; GROWTH],
            growing: true,
        }
    }

    /// Takes what a lane has come to. `None`: it is to be run again, from what it is now, over the new segments.
    pub fn take<S: Real>(&mut self, scene: &Scene, lane: &mut Lane<S>) -> Option<Outcome> {
        let (mut seen, end) = reductions(&self.segments, lane);
        let end = End { time: self.start[0] + end.time, ..end };
        if self.settling.is_some() {
            if self.ending.is_none() {
                self.add_growth(&seen.growth, lane.sums.growth_closed);
            }
            seen.growth = self.growth;
            seen.met_event = !self.growing;
        }
        let outcome = seen.outcome(scene, &self.plan, &end);
        let settling = match &mut self.settling {
            Some(settling) if outcome.status == Status::Ok => settling,
            _ => return Some(outcome),
        };
        if let Some(ending) = self.ending {
            return Some(outcome.ended(ending, self.start[1] * scene.units.time));
        }
        if let Some(ending) = settling.judge(&outcome, lane.sums.growth_closed, end.time) {
            self.ending = Some(ending);
            for [.., part] in &mut self.segments {
                *part = part.min(f64::from(SECOND_HALF));
            }
            lane.back_to_the_end(&self.segments);
        } else {
            let half = settling.half(seen.frequency());
            self.start = [end.time; 2];
            self.segments = window_segments(scene, &self.plan, 0.0, half);
            lane.next_window();
        }
        None
    }

    /// Adds the growth of a window as long as no event has come.
    fn add_growth(&mut self, growth: &[f64; GROWTH], closed: bool) {
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
        let steps = segments[self.segment as usize][0] as u32;
        self.index = steps;
    }
}

/// The sums of a finished lane, and how it ended. Times count from the beginning of the segments.
#[must_use]
pub fn reductions<S: Real>(segments: &Segments, lane: &Lane<S>) -> (Reductions, End) {
    let time = |segment: u32, index: u32, fraction: f64| -> f64 {
        let before: f64 = segments[..(segment as usize).min(SEGMENTS)].iter().map(|s| s[0] * s[1]).sum();
        let step = segments.get(segment as usize).map_or(0.0, |s| s[1]);
        before + (f64::from(index) + fraction) * step
    };
    let moment = |m: &observe::Moment<S>| time(m.segment, m.index, m.fraction.to_f64());
    let sums = &lane.sums;
    let reductions = Reductions {
        origin: [lane.snapshot.body.p[0], lane.snapshot.body.p[2]].map(Real::to_f64),
        halves: sums.total.map(|half| half.map(Real::to_f64)),
        peaks: sums.peaks.map(Real::to_f64),
        impacts: sums.impacts,
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
