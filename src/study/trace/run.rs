//! One instance in full: the sampled trajectory.

use std::f64::consts::TAU;

use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::observer::Event;
use crate::engine::reference::observer::Observer;
use crate::engine::reference::observer::Step;
use crate::engine::reference::respond::respond;
use crate::engine::scene::Scene;
use crate::model::contact::ContactState;
use crate::model::instance::Instance;
use crate::study::error::{Error, Result};
use crate::sweep::spec::Spec;

/// One sample of a trajectory, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceRow {
    /// Time, s.
    pub t: f64,
    /// `x2`, `y2`, `y1`, m.
    pub position: [f64; 3],
    /// `ẋ2`, `ẏ2`, `ẏ1`, m/s.
    pub velocity: [f64; 3],
    /// `ẍ2`, `ÿ2`, `ÿ1`, m/s².
    pub acceleration: [f64; 3],
    /// Normal contact force N, N.
    pub normal_force: f64,
    /// Tangential contact force T, N.
    pub tangential_force: f64,
    /// Contact state.
    pub state: ContactState,
}

/// A trajectory and its outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Samples in order of time, events included (both sides of an impact).
    pub rows: Vec<TraceRow>,
    /// The observables, as a map would hold them.
    pub outcome: Outcome,
}

/// Most rows of a trace but those of its events: a gigabyte of memory.
const MOST_ROWS: f64 = 5e6;

/// Whether the rows of a trace have room in memory.
///
/// # Errors
/// When there would be more than five million.
pub fn has_room(spec: &Spec, instance: &Instance, samples_per_period: u32) -> Result<()> {
    let plan = Plan::new(spec);
    let Ok(scene) = Scene::planned(instance, &plan) else { return Ok(()) };
    let rows = |time: f64| time * f64::from(samples_per_period) / TAU;
    let longest = plan.settle_limit.unwrap_or(plan.settle);
    let mut count = rows(scene.scaled(longest) + scene.scaled(plan.measure));
    if count > MOST_ROWS && plan.settle_limit.is_some() {
        // It may settle long before.
        count = rows(respond(instance, &plan).simulated_time / scene.units.time);
    }
    if count > MOST_ROWS { Err(Error::TraceTooLong { rows: count, limit: MOST_ROWS }) } else { Ok(()) }
}

/// Integrates one instance and samples it `samples_per_period` times per `2π/ω0`, and on both sides of every event.
///
/// The trajectory ends where the instance fails; [`Trace::outcome`] says why.
#[must_use]
pub fn trace(spec: &Spec, instance: &Instance, samples_per_period: u32) -> Trace {
    let plan = Plan::new(spec);
    let outcome = respond(instance, &plan);
    let mut rows = Vec::new();
    if let Ok(scene) = Scene::planned(instance, &plan) {
        let mut sampler = Sampler {
            scene: &scene,
            spacing: TAU / f64::from(samples_per_period.max(1)),
            taken: 0,
            after_event: true,
            end: None,
            rows: &mut rows,
        };
        if let Ok(mut integrator) = scene.integrator(&plan) {
            let length = match plan.settle_limit {
                Some(_) => outcome.simulated_time / scene.units.time,
                None => scene.scaled(plan.settle) + scene.scaled(plan.measure),
            };
            // A failure ends the trace early; the outcome holds the status.
            if scene.advance(&mut integrator, length, &mut sampler).is_ok() {
                sampler.close();
            }
        }
    }
    Trace { rows, outcome }
}

/// Turns steps into rows.
struct Sampler<'a> {
    scene: &'a Scene,
    spacing: f64,
    /// Regular samples taken so far: sample `k` is at `k · spacing`.
    taken: u64,
    after_event: bool,
    /// The row at the end of the last step, not yet among the rows.
    end: Option<TraceRow>,
    rows: &'a mut Vec<TraceRow>,
}

impl Sampler<'_> {
    fn row(&self, step: &Step, tau: f64) -> TraceRow {
        let units = &self.scene.units;
        let motion = step.expansion.motion(tau);
        let (tangential, normal) = step.expansion.forces(tau);
        let mut position = motion.state.position.map(|x| x * units.length);
        let [base, drift] = [step.warmth.base, step.warmth.drift];
        position[0] += self.scene.equilibrium.x2 + base[0] * units.length;
        position[2] += self.scene.equilibrium.y1 + base[1] * units.length;
        let [vx, vy, vw] = motion.state.velocity;
        let velocity = [vx + drift[0], vy, vw + drift[1]];
        TraceRow {
            t: (step.start + tau) * units.time,
            position,
            velocity: velocity.map(|v| v * units.velocity),
            acceleration: motion.acceleration.map(|a| a * units.acceleration),
            normal_force: normal * units.force,
            tangential_force: tangential * units.force,
            state: step.expansion.contact.state(),
        }
    }

    fn close(&mut self) {
        self.rows.extend(self.end.take());
    }
}

impl Observer for Sampler<'_> {
    fn step(&mut self, step: &Step) {
        if self.after_event {
            self.rows.push(self.row(step, 0.0));
            self.after_event = false;
        }
        while self.taken as f64 * self.spacing <= step.start {
            self.taken += 1;
        }
        self.end = Some(self.row(step, step.duration));
        loop {
            let tau = self.taken as f64 * self.spacing - step.start;
            if tau > step.duration {
                break;
            }
            self.rows.push(self.row(step, tau));
            self.taken += 1;
            if tau >= step.duration {
                self.end = None;
            }
        }
    }

    fn event(&mut self, _event: Event) {
        self.close();
        self.after_event = true;
    }
}
