//! The steps and events that a lane may take up to the end of its stretch. They are compared with that on the way, and
//! counted for the instance only at the end.

use std::f64::consts::TAU;

use crate::engine::reference::bounds::{MAX_EVENTS_PER_PERIOD, MAX_STEPS_PER_PERIOD};

/// The most that a lane counts to in f32, half of what it could.
const COUNTED: f64 = 8_388_608.0;

/// Steps and events since a time at which a period began. A stretch of several has the steps of all of them: where in the
/// stretch they fall, its lane does not tell.
#[derive(Clone, Copy, Debug, Default)]
pub struct Count {
    since: f64,
    steps: f64,
    events: f64,
}

impl Count {
    /// The most steps and events from `time` up to `until`, of a run that may have so many more steps.
    pub fn most(&mut self, [time, until]: [f64; 2], left: f64) -> [f64; 2] {
        if time >= self.since + TAU {
            *self = Count { since: time, ..Count::default() };
        }
        let periods = ((until - self.since) / TAU).max(1.0);
        let steps = f64::from(MAX_STEPS_PER_PERIOD) * periods - self.steps;
        let events = f64::from(MAX_EVENTS_PER_PERIOD) * periods - self.events;
        [steps.min(left).min(COUNTED), events.min(COUNTED)]
    }

    /// Counts from `time` on, to which a run goes back.
    #[must_use]
    pub fn restarted(time: f64) -> Count {
        Count { since: time, ..Count::default() }
    }

    /// Adds those of a stretch.
    pub fn add(&mut self, steps: f64, events: f64) {
        self.steps += steps;
        self.events += events;
    }
}
