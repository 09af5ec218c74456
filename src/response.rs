//! The transient of one instance: start, settle, measure, outcome in SI units.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use num_complex::Complex64;

use crate::integrate::{Integrator, Observer, Resolution, STEP_TOLERANCE};
use crate::method::Method;
use crate::method::taylor::{BeltMotion, REFERENCE_ORDER, State};
use crate::model::equilibrium::{Equilibrium, Scaled, Units};
use crate::model::{Param, Params};
use crate::observe::{CyclePhase, EnergyGains, Growth, Sums, Window};
use crate::outcome::{Outcome, Status};
use crate::settle::Settling;
use crate::spec::{Duration, Instance, Spec, StartKind};
use crate::start::{kick, mode};

/// How to integrate: what of the sweep is common to all instances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// How transients start.
    pub start: StartKind,
    /// Time before the measuring window, or before the first of a run until settled.
    pub settle: Duration,
    /// The latest start of a window in a run until settled.
    pub settle_limit: Option<Duration>,
    /// Length of the measuring window.
    pub measure: Duration,
    /// Largest step: this many per period `2π/ω0`.
    pub steps_per_period: u32,
    /// How the reference takes a step; the other engines have their own way.
    pub method: Method,
    /// Order of the Taylor series.
    pub order: usize,
    /// Bound on the truncation of a step; infinite for steps of fixed length.
    pub tolerance: f64,
}

impl Plan {
    /// The plan of a sweep for the reference method.
    #[must_use]
    pub fn new(spec: &Spec) -> Plan {
        Plan {
            start: spec.start,
            settle: spec.settle,
            settle_limit: spec.settle_limit,
            measure: spec.measure,
            steps_per_period: spec.steps_per_period,
            method: Method::Taylor,
            order: REFERENCE_ORDER,
            tolerance: STEP_TOLERANCE,
        }
    }
}

impl Plan {
    /// The plan cut to at most `periods` of the instance, and the share of its time that is left; of a run until
    /// settled the longest it may be.
    #[must_use]
    pub fn shortened(&self, instance: &Instance, periods: f64) -> (Plan, f64) {
        if let Some(limit) = self.settle_limit {
            return Plan { settle: limit, settle_limit: None, ..*self }.shortened(instance, periods);
        }
        let Ok(scene) = Scene::new(instance, self.start) else { return (*self, 1.0) };
        let [settle, measure] = [self.settle, self.measure].map(|part| scene.scaled(part) / TAU);
        let share = (periods / (settle + measure)).min(1.0);
        if share >= 1.0 {
            return (*self, 1.0);
        }
        let cut = |part: f64| Duration::Periods(part * share);
        (Plan { settle: cut(settle), measure: cut(measure), ..*self }, share)
    }
}

/// Most steps of a run: 1.4 million periods with 12 steps each, a minute or two of one core. All that f32 counts, in
/// which an amplitude drifts by percents over that many; the same on every engine.
pub const MOST_STEPS: u32 = 1 << 24;

/// The largest scaled number of an instance, and the inverse of the smallest: the squares of such numbers are finite,
/// and products of them above zero, in f32 too.
pub const LARGEST: f64 = 1e18;

/// The largest unit of a scaled number, SI, and the inverse of the smallest.
const LARGEST_UNIT: f64 = 1e200;

/// The belt velocity over time, scaled: linear from the first value to the last, then constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    start: f64,
    end: f64,
    duration: f64,
}

impl Ramp {
    fn new(params: &Params, units: &Units) -> Ramp {
        let start = params.require(Param::BeltVelocity);
        let end = params.get(Param::BeltVelocityEnd).unwrap_or(start);
        let duration = params.get(Param::RampDuration).unwrap_or(0.0);
        Ramp { start: start / units.velocity, end: end / units.velocity, duration: duration / units.time }
    }

    /// The belt at the time `t`, and how long it goes on like that.
    fn at(&self, t: f64) -> (BeltMotion, f64) {
        if t < self.duration {
            let acceleration = (self.end - self.start) / self.duration;
            (BeltMotion { velocity: self.start + acceleration * t, acceleration }, self.duration - t)
        } else {
            (BeltMotion { velocity: self.end, acceleration: 0.0 }, f64::INFINITY)
        }
    }
}

/// The velocity of the belt of an instance at the time `time` (s), m/s.
#[must_use]
pub fn belt_velocity(params: &Params, time: f64) -> f64 {
    let start = params.require(Param::BeltVelocity);
    match (params.get(Param::BeltVelocityEnd), params.get(Param::RampDuration)) {
        (Some(end), Some(duration)) if time < duration => start + (end - start) * (time / duration),
        (Some(end), Some(_)) => end,
        _ => start,
    }
}

/// An instance ready to be integrated.
#[derive(Clone, Debug)]
pub struct Scene {
    /// SI values of the scaled units.
    pub units: Units,
    /// The sliding equilibrium.
    pub equilibrium: Equilibrium,
    /// The dimensionless model around it.
    pub model: Scaled,
    ramp: Ramp,
    start: State,
}

impl Scene {
    /// Prepares an instance.
    ///
    /// # Errors
    /// The status of an instance that cannot start: ill-posed law, no equilibrium.
    pub fn new(instance: &Instance, start: StartKind) -> Result<Scene, Status> {
        let equilibrium = Equilibrium::new(instance)?;
        let units = Units::new(&instance.params);
        let model = Scaled::new(instance, &units, &equilibrium);
        let ramp = Ramp::new(&instance.params, &units);
        let start = match start {
            StartKind::Kick => kick(&instance.params, &units),
            StartKind::Mode => mode(instance, &units, &model),
        };
        Ok(Scene { units, equilibrium, model, ramp, start })
    }

    /// Prepares an instance for a run as `plan` has it.
    ///
    /// # Errors
    /// As [`Scene::new`]; [`Status::NonFinite`] for scaled numbers beyond [`LARGEST`], [`Status::StepTooLarge`] for a run
    /// that has more than [`MOST_STEPS`] even if none is cut short.
    pub fn planned(instance: &Instance, plan: &Plan) -> Result<Scene, Status> {
        let scene = Scene::new(instance, plan.start)?;
        if !scene.is_representable() {
            return Err(Status::NonFinite);
        }
        let periods = (scene.scaled(plan.settle) + scene.scaled(plan.measure)) / TAU;
        let countable = periods * f64::from(plan.steps_per_period) <= f64::from(MOST_STEPS);
        if countable { Ok(scene) } else { Err(Status::StepTooLarge) }
    }

    /// Whether no scaled number is beyond [`LARGEST`], or so small that its inverse is.
    fn is_representable(&self) -> bool {
        let (model, ramp, start) = (&self.model, &self.ramp, &self.start);
        let (size, rate) = (|value: &f64| value.abs() <= LARGEST, |value: &f64| value.abs() >= 1.0 / LARGEST);
        let positive = [model.m1, model.k1, model.k2, model.det, model.n0, model.c];
        let others = [model.c1, model.c2, model.mu0, model.law.mu_stick, ramp.start, ramp.end];
        let mut pieces = model.law.pieces.iter().map(|piece| piece.largest());
        let Units { time, length, velocity, acceleration, force } = self.units;
        // What they are multiplied by stays a number, too.
        let units = [time, length, velocity, acceleration, force];
        let in_range = |value: &f64| (1.0 / LARGEST_UNIT..=LARGEST_UNIT).contains(value);
        let equilibrium = [self.equilibrium.x2, self.equilibrium.y1];
        units.iter().all(in_range)
            && equilibrium.iter().all(|value| value.abs() <= LARGEST_UNIT)
            && positive.iter().all(|value| size(value) && rate(value))
            && others.iter().chain(&model.law.kinks).chain(&start.position).chain(&start.velocity).all(size)
            && pieces.all(|value| size(&value))
            && [ramp.start, ramp.end].iter().all(|value| *value == 0.0 || rate(value))
            && (ramp.duration == 0.0 || size(&((ramp.end - ramp.start) / ramp.duration)))
    }

    /// The status an integration ended with, as it is told. On a piece too narrow for an arithmetic a speed may lie beyond its
    /// ends, and friction with it beyond all that the law has: where that alone makes `M11` vanish, nothing is Painlevé's.
    #[must_use]
    pub fn told(&self, status: Status) -> Status {
        if status == Status::Painleve && !self.model.may_be_painleve() {
            Status::StepTooLarge
        } else {
            status
        }
    }

    /// The belt at the time `t` (scaled).
    #[must_use]
    pub fn belt(&self, t: f64) -> BeltMotion {
        self.ramp.at(t).0
    }

    /// The belt from the time `t` (scaled) on, and how long it goes on like that.
    #[must_use]
    pub fn belt_from(&self, t: f64) -> (BeltMotion, f64) {
        self.ramp.at(t)
    }

    /// The state at the start.
    #[must_use]
    pub fn start(&self) -> State {
        self.start
    }

    /// The same from another start.
    #[must_use]
    pub fn started(self, start: State) -> Scene {
        Scene { start, ..self }
    }

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
        Integrator::new(&self.model, resolution, self.start, self.belt(0.0))
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
            let (belt, holds) = self.ramp.at(integrator.time());
            let part = rest.min(holds);
            integrator.advance(part, belt, observer)?;
            rest -= part;
        }
        Ok(())
    }

    /// The SI value of the simulated time `time`: in full when it is exactly the time the plan asks for.
    #[must_use]
    pub fn seconds(&self, time: f64, plan: &Plan) -> f64 {
        if plan.settle_limit.is_some() {
            return time * self.units.time;
        }
        let si = |duration| match duration {
            Duration::Seconds(seconds) => seconds,
            other => self.scaled(other) * self.units.time,
        };
        let half = 0.5 * self.scaled(plan.measure);
        let asked = self.scaled(plan.settle) + half + half;
        (si(plan.settle) + si(plan.measure)) * (time / asked)
    }

    /// A length of time of the plan in units of `1/ω0`.
    #[must_use]
    pub fn scaled(&self, duration: Duration) -> f64 {
        match duration {
            Duration::Seconds(seconds) => seconds / self.units.time,
            Duration::Periods(periods) => periods * TAU,
            Duration::Ramp => self.ramp.duration,
        }
    }
}

/// Integrates one instance.
#[must_use]
pub fn respond(instance: &Instance, plan: &Plan) -> Outcome {
    respond_until(instance, plan, &AtomicBool::new(false))
}

/// The same, which ends with [`Status::NotComputed`] soon after `cancel` is set.
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
