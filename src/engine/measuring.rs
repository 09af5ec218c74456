//! The measuring of one run: one window at its time, or one after another until the run is settled. The one driver for all
//! engines.

use crate::engine::outcome::{Ending, Outcome};
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use crate::engine::settling::Settling;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// The windows of one run; times are scaled.
#[derive(Clone, Debug)]
pub struct Measuring {
    settling: Option<Box<Settling>>,
    ending: Option<Ending>,
    start: f64,
    half: f64,
}

impl Measuring {
    /// The first window of an instance.
    #[must_use]
    pub fn new(instance: &Instance, scene: &Scene, plan: &Plan) -> Measuring {
        let settling = Settling::new(instance, scene, plan).map(Box::new);
        let asked = 0.5 * scene.scaled(plan.measure);
        let half = settling.as_ref().map_or(asked, |settling| settling.half(None));
        Measuring { settling, ending: None, start: scene.scaled(plan.settle), half }
    }

    /// Whether the run goes on until it is settled.
    #[must_use]
    pub fn until_settled(&self) -> bool {
        self.settling.is_some()
    }

    /// Whether the windows of the run agree.
    #[must_use]
    pub fn has_settled(&self) -> bool {
        self.ending == Some(Ending::Settled)
    }

    /// Takes back that the run has settled at `end`. True when another window follows, which is the present one then; false when that
    /// would be too late.
    pub fn reopen(&mut self, frequency: Option<f64>, end: f64) -> bool {
        let Some(settling) = &self.settling else { return false };
        self.ending = (end > settling.limit()).then_some(Ending::Limit);
        if self.ending.is_none() {
            (self.start, self.half) = (end, settling.half(frequency));
        }
        self.ending.is_none()
    }

    /// Whether the last window has been judged.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.ending.is_some()
    }

    /// Where the present window begins.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Where the present window has begun, to the last digits of an engine that counts its own time.
    pub fn begin(&mut self, start: f64) {
        self.start = start;
    }

    /// The length of a half of the present window.
    #[must_use]
    pub fn half(&self) -> f64 {
        self.half
    }

    /// Goes on for a scaled time from `now` on before the window begins; false when that would be too late, and the window
    /// begins now.
    pub fn wait(&mut self, now: f64, time: f64) -> bool {
        let waits = self.settling.as_ref().is_some_and(|settling| now + time <= settling.limit());
        self.start = if waits { now + time } else { now };
        waits
    }

    /// Judges a window that ended at `end`, in which the response had a `frequency` (cycles per scaled time); `events` says
    /// whether any fell into it. True when another one follows, which is the present one then.
    pub fn goes_on(&mut self, outcome: &Outcome, frequency: Option<f64>, events: bool, end: f64) -> bool {
        let Some(settling) = &mut self.settling else { return false };
        if self.ending.is_some() || outcome.status != Status::Ok {
            return false;
        }
        self.ending = settling.judge(outcome, events, end);
        if self.ending.is_some() {
            return false;
        }
        (self.start, self.half) = (end, settling.half(frequency));
        true
    }

    /// The outcome of the last window, which says how the run ended.
    #[must_use]
    pub fn told(&self, outcome: Outcome, scene: &Scene) -> Outcome {
        match self.ending {
            Some(ending) => outcome.ended(ending, self.start * scene.units.time),
            None => outcome,
        }
    }
}
