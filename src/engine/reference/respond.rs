//! The reference integrates one instance: start, settle, measure, outcome in SI units.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use num_complex::Complex64;

use crate::engine::method::taylor::State;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::integrate::{Integrator, Observer, Resolution};
use crate::engine::reference::observe::{CyclePhase, EnergyGains, Growth, Sums, Window};
use crate::engine::scene::Scene;
use crate::engine::settling::Settling;
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
        Integrator::new(&self.model, resolution, self.start(), self.belt(0.0))
    }

    /// Integrates for exactly `duration` (scaled), the belt as the ramp says.
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
        Err(status) => return (Outcome { status: scene.told(status), ..Outcome::default() }, None),
    };
    integrator.stop_at(cancel);
    match measure(scene, &mut integrator, plan, Settling::new(instance, scene, plan)) {
        Ok(outcome) => (outcome, Some(integrator.state())),
        Err(status) => {
            let (simulated_time, steps) = (scene.seconds(integrator.time(), plan), integrator.steps());
            (Outcome { status: scene.told(status), simulated_time, steps, ..Outcome::default() }, None)
        }
    }
}

fn measure(
    scene: &Scene,
    integrator: &mut Integrator,
    plan: &Plan,
    mut settling: Option<Settling>,
) -> Result<Outcome, Status> {
    let mut growth = Growth::default();
    let mut gains = EnergyGains::default();
    scene.advance(integrator, scene.scaled(plan.settle), &mut (&mut growth, &mut gains))?;
    let mut length = scene.scaled(plan.measure);
    if let Some(settling) = &settling {
        length = 2.0 * settling.half(None);
    }
    loop {
        let window_start = integrator.clone();
        let mut window = Window::default();
        for half in 0..2 {
            window.half = half;
            let mut all = (&mut window, &mut (&mut growth, &mut gains));
            scene.advance(integrator, 0.5 * length, &mut all)?;
        }
        let mut outcome = Outcome {
            status: Status::Ok,
            energy_gaining_impacts: Some(gains.0),
            simulated_time: scene.seconds(integrator.time(), plan),
            steps: integrator.steps(),
            ..Outcome::default()
        };
        report_window(&mut outcome, scene, &window);
        report_growth(&mut outcome, scene, &growth);
        if !outcome_is_finite(&outcome) {
            return Err(Status::NonFinite);
        }
        if let Some(settling) = &mut settling {
            let Some(ending) = settling.judge(&outcome, window.events > 0, integrator.time()) else {
                length = 2.0 * settling.half(window.response_frequency());
                continue;
            };
            outcome = outcome.ended(ending, window_start.time() * scene.units.time);
        }
        outcome.phase_cycle = cycle_phase(scene, window_start, &window, length)?;
        return Ok(outcome);
    }
}

fn report_window(outcome: &mut Outcome, scene: &Scene, window: &Window) {
    let units = &scene.units;
    let all: Sums = window.halves[0].plus(window.halves[1]);
    let rms = |sum: f64, time: f64| (sum / time).sqrt();
    let [x0, y0] = window.origin.unwrap_or_default();
    outcome.x2_mean = Some(scene.equilibrium.x2 + (x0 + all.x / all.time) * units.length);
    outcome.x2_std = Some(all.x_std() * units.length);
    outcome.y1_mean = Some(scene.equilibrium.y1 + (y0 + all.y / all.time) * units.length);
    outcome.y1_std = Some(all.y_std() * units.length);
    outcome.ax_rms = Some(rms(all.ax, all.time) * units.acceleration);
    outcome.ay_rms = Some(rms(all.ay, all.time) * units.acceleration);
    outcome.ax_peak = Some(window.ax_peak * units.acceleration);
    outcome.ay_peak = Some(window.ay_peak * units.acceleration);
    let friction = all.tangential / all.normal;
    outcome.friction_mean = (all.normal > 0.0 && friction.is_finite()).then_some(friction);
    outcome.n_peak = Some(window.n_peak * units.force);
    outcome.response_frequency = window.response_frequency().map(|f| f / units.time);
    outcome.stick = Some(all.stick / all.time);
    outcome.free = Some(all.free / all.time);
    outcome.reverse = Some(all.reverse / all.time);
    outcome.window = all.time * units.time;
    outcome.impacts_per_second = Some(window.impacts as f64 / outcome.window);
    outcome.speed_rms_halves = window.halves.map(|half| rms(half.speed, half.time) * units.velocity);
    outcome.x2_std_halves = window.halves.map(|half| half.x_std() * units.length);
    outcome.ay_rms_halves = window.halves.map(|half| rms(half.ay, half.time) * units.acceleration);
}

fn report_growth(outcome: &mut Outcome, scene: &Scene, growth: &Growth) {
    outcome.met_event = growth.met_event();
    if let Some(fit) = growth.result() {
        outcome.growth_rate_measured = Some(fit.growth_rate / scene.units.time);
        outcome.frequency_measured = Some(fit.angular_frequency / TAU / scene.units.time);
        outcome.phase_measured = fit.phase.map(f64::to_degrees);
    }
}

/// The phase at the response frequency, which is known only after the window: a second pass over it.
fn cycle_phase(
    scene: &Scene,
    mut integrator: Integrator,
    window: &Window,
    length: f64,
) -> Result<Option<f64>, Status> {
    let Some(frequency) = window.response_frequency() else { return Ok(None) };
    let mut cycle = CyclePhase {
        angular_frequency: TAU * frequency,
        from: window.first_crossing,
        to: window.last_crossing,
        x: Complex64::ZERO,
        y: Complex64::ZERO,
    };
    for _ in 0..2 {
        scene.advance(&mut integrator, 0.5 * length, &mut cycle)?;
    }
    let ratio = cycle.y / cycle.x;
    Ok((ratio.is_finite() && ratio != Complex64::ZERO).then(|| ratio.arg().to_degrees()))
}

fn outcome_is_finite(outcome: &Outcome) -> bool {
    [outcome.x2_std, outcome.y1_std, outcome.ax_rms, outcome.ay_rms, outcome.ax_peak, outcome.ay_peak]
        .iter()
        .flatten()
        .all(|value| value.is_finite())
}
