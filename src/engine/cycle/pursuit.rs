//! The hunts of one run, one after another until its cycle is found: the same for every engine.

use std::f64::consts::TAU;

use crate::engine::cycle::candidate::{Candidate, Course, Cycle};
use crate::engine::cycle::hunt::{Hunt, Next};
use crate::engine::cycle::point::{Freedom, Point, Return};

/// Periods between the first hunts.
const FIRST_WAIT: f64 = 2.0;

/// Hunts after which the time between them is doubled.
const DOUBLES_AFTER: u32 = 5;

/// Hunts of a run.
const MOST_HUNTS: u32 = 24;

/// Unstable cycles that a run may be found next to: about one it may turn for long.
const MOST_UNSTABLE: u32 = 12;

/// Hunts before those that look for cycles of several returns.
const FAR_FROM: u32 = 12;

/// Returns of the transient that are looked at, in the first hunts.
const FEW: usize = 5;

/// And in later ones, which look for cycles of several returns.
pub const MANY: usize = 17;

/// A motion smaller than this part of what the belt moves in `1/ω0` is no cycle: it has decayed to rounding.
const SMALLEST: f64 = 1e-6;

/// What has met no event until here, scaled, is measured like any other run: it may only be growing.
pub const GROWS: f64 = 24.0 * TAU;

/// Bound on the truncation of a step of a flight: next to nothing, as its end is compared with its neighbours'.
pub const TOLERANCE: f64 = 1e-13;

/// Steps per period of a flight, at least.
pub const STEPS_PER_PERIOD: u32 = 12;

/// The longest time from one return to the next, scaled: ten periods.
pub const LONGEST_RETURN: f64 = 10.0 * TAU;

/// The hunts of one run.
#[derive(Clone, Debug, Default)]
pub struct Pursuit {
    hunts: u32,
    /// How many of them have found a cycle that is unstable.
    unstable: u32,
    /// A stable cycle that the run may come to.
    candidate: Option<Box<Candidate>>,
    /// The unstable cycle that the last hunt has found.
    unstable_cycle: Option<Box<Candidate>>,
}

impl Pursuit {
    /// Whether there is another hunt.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.hunts < MOST_HUNTS && self.unstable < MOST_UNSTABLE
    }

    /// The returns of the transient that the present hunt looks at.
    #[must_use]
    pub fn looks_at(&self) -> usize {
        if self.looks_far() { MANY } else { FEW }
    }

    fn looks_far(&self) -> bool {
        self.hunts >= FAR_FROM
    }

    /// Looks at the returns of a transient up to the scaled time `now`, on a belt of a scaled velocity: the hunt to go on, if any. A candidate is kept for as
    /// long as they are near it.
    pub fn begin(
        &mut self,
        transient: &[Return],
        freedom: Freedom,
        now: f64,
        belt_velocity: f64,
    ) -> Option<Hunt> {
        // After some returns of a longer cycle another of its points is next.
        self.candidate = self.candidate.take().filter(|candidate| {
            candidate.cycle.returns == 1 && candidate.clone().course(transient, now) != Course::Elsewhere
        });
        if self.candidate.is_some() {
            None
        } else {
            Hunt::new(transient, freedom, self.looks_far(), SMALLEST * belt_velocity.abs())
        }
    }

    /// Takes what a hunt has come to; the points to follow, and how many returns, where it goes on.
    pub fn take(&mut self, next: Next) -> Option<(Vec<Point>, usize)> {
        match next {
            Next::Follow(points, returns) => return Some((points, returns)),
            Next::Found(candidate) => self.candidate = Some(candidate),
            Next::Unstable(cycle) => {
                self.unstable += 1;
                self.unstable_cycle = Some(cycle);
            }
            Next::Lost => {}
        }
        None
    }

    /// Where the returns of a transient up to the scaled time `now` show that it comes to its cycle: points on the way there, to
    /// be followed for so many returns.
    pub fn way(&mut self, transient: &[Return], now: f64) -> Option<(Vec<Point>, usize)> {
        let candidate = self.candidate.as_mut()?;
        let comes = candidate.course(transient, now) == Course::Comes;
        comes.then(|| (candidate.way(transient), candidate.cycle.returns))
    }

    /// The cycle, where the returns of the points on the way to it show that the way is open.
    #[must_use]
    pub fn arrives(&self, points: &[Point], flown: &[Option<&[Return]>]) -> Option<Cycle> {
        let candidate = self.candidate.as_ref()?;
        candidate.is_open(points, flown).then(|| candidate.cycle.clone())
    }

    /// Looks at the returns of a run whose windows say that it has settled: the hunt for the cycle that it is next to.
    #[must_use]
    pub fn doubts(&mut self, transient: &[Return], freedom: Freedom, belt_velocity: f64) -> Option<Hunt> {
        self.unstable_cycle = None;
        Hunt::new(transient, freedom, true, SMALLEST * belt_velocity.abs())
    }

    /// Whether that cycle is unstable, and left by those returns: then the run has not settled.
    #[must_use]
    pub fn leaves(&self, transient: &[Return]) -> bool {
        self.unstable_cycle.as_ref().is_some_and(|cycle| cycle.is_left_by(transient))
    }

    /// The scaled time to wait after a hunt that has found nothing.
    pub fn wait(&mut self) -> f64 {
        let wait = FIRST_WAIT * f64::from(1_u32 << (self.hunts / DOUBLES_AFTER)) * TAU;
        self.hunts += 1;
        wait
    }
}
