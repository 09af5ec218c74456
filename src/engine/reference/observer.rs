//! What is seen of a motion: its steps and events.

use crate::engine::course::Warmth;
use crate::engine::method::taylor::{BeltMotion, Expansion, Motion};

/// One accepted step: the series holds from `start` for `duration`.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The motion.
    pub expansion: &'a Expansion,
    /// Time at the start of the step.
    pub start: f64,
    /// Length of the step.
    pub duration: f64,
    /// The belt at the start of the step.
    pub belt: BeltMotion,
    /// From where `x2` and `y1` and their velocities count.
    pub warmth: Warmth,
    /// The motion at the end of the step, before the event that ended it.
    pub end: Motion,
}

/// The event that ended a step early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The relative velocity reached 0.
    Rest,
    /// The relative velocity reached a kink of the friction law.
    Kink,
    /// The normal force fell to 0.
    LiftOff,
    /// The tangential force left the stick cone.
    StickLimit,
    /// The gap closed; with the energy gain of the impact.
    Impact {
        /// Whether the impact gained energy.
        gained_energy: bool,
    },
}

/// Watches the steps and events of an integration.
pub trait Observer {
    /// Called for every step, in order of time.
    fn step(&mut self, step: &Step);
    /// Called for every event, after the step that it ended.
    fn event(&mut self, _event: Event) {}
}

impl<A: Observer, B: Observer> Observer for (A, B) {
    fn step(&mut self, step: &Step) {
        self.0.step(step);
        self.1.step(step);
    }
    fn event(&mut self, event: Event) {
        self.0.event(event);
        self.1.event(event);
    }
}

impl<A: Observer> Observer for &mut A {
    fn step(&mut self, step: &Step) {
        (**self).step(step);
    }
    fn event(&mut self, event: Event) {
        (**self).event(event);
    }
}

impl Observer for () {
    fn step(&mut self, _: &Step) {}
}
