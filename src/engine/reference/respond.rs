//! The reference integrates one instance: start, settle, measure, outcome in SI units.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use crate::engine::measuring::Measuring;
use crate::engine::method::taylor::State;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reductions::End;
use crate::engine::reference::hunt::Chase;
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::observe::{EnergyGains, Growth, Window};
use crate::engine::reference::observer::Observer;
use crate::engine::reference::phase::phase;
use crate::engine::reference::resolution::Resolution;
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::status::Status;

impl Scene {
    /// Starts the integration.
    ///
    /// # Errors
    /// [`Status::Painleve`] when the first slip has no unique dynamics.
    pub fn integrator(&self, plan: &Plan) -> Result<Integrator<'_>, Status> {
        let resolution = Resolution {
            method: plan.method,
            order: plan.order,
            nominal_step: TAU / f64::from(plan.steps_per_period),
            tolerance: plan.tolerance,
        };
        let integrator = Integrator::new(&self.model, resolution, self.start(), self.belt(0.0))?;
        Ok(integrator.of(self.warmth()))
    }

    /// Integrates for exactly `duration` (scaled), the belt and the friction law as they go.
    ///
    /// # Errors
    /// The status that ends the instance before its time.
    pub fn advance(
        &self,
        integrator: &mut Integrator,
        duration: f64,
        observer: &mut impl Observer,
    ) -> Result<(), Status> {
        let mut rest = duration;
        while rest > 0.0 {
            let (belt, holds) = self.belt_from(integrator.time());
            if let Some((model, warmth)) = self.warmed(integrator.time(), integrator.warmth())? {
                integrator.go_over(model, warmth, warmth.seen(belt))?;
            }
            let belt = integrator.warmth().seen(belt);
            let part = rest.min(holds);
            integrator.advance(part, belt, observer)?;
            rest -= part;
        }
        Ok(())
    }
}

/// Integrates one instance.
#[must_use]
pub fn respond(instance: &Instance, plan: &Plan) -> Outcome {
    respond_until(instance, plan, &AtomicBool::new(false))
}

/// Integrates one instance. Soon after `cancel` is set it gives up, with [`Status::NotComputed`].
#[must_use]
pub fn respond_until(instance: &Instance, plan: &Plan, cancel: &AtomicBool) -> Outcome {
    match Scene::planned(instance, plan) {
        Ok(scene) => respond_in_until(&scene, instance, plan, cancel).0,
        Err(status) => Outcome { status, ..Outcome::default() },
    }
}

/// Integrates one instance from the start of its scene; gives the state at the end too, where it came to its end.
#[must_use]
pub fn respond_in(scene: &Scene, instance: &Instance, plan: &Plan) -> (Outcome, Option<State>) {
    respond_in_until(scene, instance, plan, &AtomicBool::new(false))
}

fn respond_in_until(
    scene: &Scene,
    instance: &Instance,
    plan: &Plan,
    cancel: &AtomicBool,
) -> (Outcome, Option<State>) {
    let mut integrator = match scene.integrator(plan) {
        Ok(integrator) => integrator,
        Err(status) => return (Outcome { status: scene.model.told(status), ..Outcome::default() }, None),
    };
    integrator.stop_at(cancel);
    match measure(scene, &mut integrator, plan, Measuring::new(instance, scene, plan)) {
        Ok(outcome) => (outcome, Some(integrator.state())),
        Err(status) => {
            let (simulated_time, steps) = (scene.seconds(integrator.time(), plan), integrator.steps());
            (Outcome { status: integrator.told(status), simulated_time, steps, ..Outcome::default() }, None)
        }
    }
}

fn measure(
    scene: &Scene,
    integrator: &mut Integrator,
    plan: &Plan,
    mut measuring: Measuring,
) -> Result<Outcome, Status> {
    let mut growth = Growth::default();
    let mut gains = EnergyGains::default();
    let mut chase = Chase::new(scene, plan);
    scene.advance(integrator, scene.scaled(plan.settle), &mut (&mut growth, &mut gains))?;
    loop {
        if let Some(chase) = &mut chase
            && let Some(outcome) = chase.run(integrator, (&mut growth, &mut gains), &mut measuring)?
        {
            return Ok(outcome);
        }
        let window_start = integrator.clone();
        measuring.begin(window_start.time());
        let half = measuring.half();
        let mut window = Window::default();
        for part in 0..2 {
            window.half = part;
            let mut all = (&mut window, &mut (&mut growth, &mut gains));
            scene.advance(integrator, half, &mut all)?;
        }
        let end = End {
            status: Status::Ok,
            steps: integrator.steps(),
            time: integrator.time(),
            met_event: growth.met_event(),
        };
        let mut seen = window.reductions(&growth);
        let outcome = seen.outcome(scene, plan, &end);
        if outcome.status != Status::Ok {
            return Err(outcome.status);
        }
        let frequency = seen.frequency();
        if measuring.goes_on(&outcome, frequency, window.events > 0, end.time) {
            continue;
        }
        if let Some(chase) = &mut chase
            && measuring.has_settled()
            && frequency.is_some()
            && chase.leaves(integrator, &growth)
            && measuring.reopen(frequency, end.time)
        {
            continue;
        }
        if let Some(frequency) = frequency {
            seen.phase = phase(scene, window_start, frequency, &seen, half)?;
        }
        let outcome = Outcome { energy_gaining_impacts: Some(gains.0), ..seen.outcome(scene, plan, &end) };
        return Ok(measuring.told(outcome, scene));
    }
}
