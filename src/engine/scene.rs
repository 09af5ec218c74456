//! An instance ready to be integrated: scaled, about its equilibrium, at its start.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::engine::belt::Belt;
use crate::engine::course::{Course, Warmth};
use crate::engine::method::taylor::{BeltMotion, State};
use crate::engine::plan::{Duration, Plan, StartKind};
use crate::engine::start::{kick, mode};
use crate::model::equilibrium::{Equilibrium, Units};
use crate::model::instance::Instance;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

impl Plan {
    /// The plan cut to at most `periods` of the instance, and the share of its time that is left; of a plan that has a time.
    #[must_use]
    pub fn shortened(&self, instance: &Instance, periods: f64) -> (Plan, f64) {
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

/// The largest scaled number that an instance may have; its inverse is the smallest. The squares of such numbers are finite
/// and their products above zero, in f32 too.
pub const LARGEST: f64 = 1e18;

/// The largest unit of a scaled number, SI, and the inverse of the smallest.
const LARGEST_UNIT: f64 = 1e200;

/// An instance ready to be integrated.
#[derive(Clone, Debug)]
pub struct Scene {
    /// SI values of the scaled units.
    pub units: Units,
    /// The sliding equilibrium.
    pub equilibrium: Equilibrium,
    /// The dimensionless model around it.
    pub model: Scaled,
    belt: Belt,
    course: Option<Arc<Course>>,
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
        let belt = Belt::new(instance, &units);
        let course = Course::of(instance, &units, &equilibrium);
        let start = match start {
            StartKind::Kick => kick(&instance.params, &units),
            StartKind::Mode => mode(instance, &units, &model),
        };
        Ok(Scene { units, equilibrium, model, belt, course, start })
    }

    /// Prepares an instance for a run as `plan` has it.
    ///
    /// # Errors
    /// As [`Scene::new`]; [`Status::NonFinite`] for scaled numbers beyond [`LARGEST`], [`Status::StepTooLarge`] for a run
    /// that has more than [`MOST_STEPS`] even if none is cut short.
    pub fn planned(instance: &Instance, plan: &Plan) -> Result<Scene, Status> {
        let scene = Scene::new(instance, plan.start)?;
        let [settle, measure] = [plan.settle, plan.measure].map(|part| scene.scaled(part));
        if !scene.is_representable() || !is_large(measure) || settle != 0.0 && !is_large(settle) {
            return Err(Status::NonFinite);
        }
        let periods = (settle + measure) / TAU;
        let countable = periods * f64::from(plan.steps_per_period) <= f64::from(MOST_STEPS);
        if countable { Ok(scene) } else { Err(Status::StepTooLarge) }
    }

    /// Whether no scaled number is beyond [`LARGEST`], or so small that its inverse is.
    fn is_representable(&self) -> bool {
        let start = &self.start;
        let (mut velocities, mut parts) = self.belt.numbers();
        let Units { time, length, velocity, acceleration, force } = self.units;
        // What they are multiplied by stays a number, too.
        let units = [time, length, velocity, acceleration, force];
        let in_range = |value: &f64| (1.0 / LARGEST_UNIT..=LARGEST_UNIT).contains(value);
        let equilibrium = [self.equilibrium.x2, self.equilibrium.y1];
        units.iter().all(in_range)
            && equilibrium.iter().all(|value| value.abs() <= LARGEST_UNIT)
            && has_range(&self.model)
            && start.position.iter().chain(&start.velocity).copied().all(is_small)
            && velocities.all(|value| is_small(value) && (value == 0.0 || is_large(value)))
            && parts.all(|[length, acceleration]| is_large(length) && is_small(acceleration))
    }

    /// What the model of the start is of.
    #[must_use]
    pub fn warmth(&self) -> Warmth {
        Warmth::steady(self.course.as_ref().map_or(0.0, |course| course.at(0.0).0))
    }

    /// The model at the time `t` (scaled), where it is another than the one of `now`.
    ///
    /// # Errors
    /// The status of an instance that cannot go on with it.
    pub fn warmed(&self, t: f64, now: &Warmth) -> Result<Option<(Scaled, Warmth)>, Status> {
        let Some(course) = &self.course else { return Ok(None) };
        let found = course.model(t, now)?;
        match &found {
            Some((model, _)) if !has_range(model) => Err(Status::NonFinite),
            _ => Ok(found),
        }
    }

    /// The most pieces that the law has within a run.
    #[must_use]
    pub fn most_pieces(&self) -> usize {
        let now = self.model.law.pieces.len();
        self.course.as_ref().map_or(now, |course| course.most_pieces(now))
    }

    /// The belt at the time `t` (scaled).
    #[must_use]
    pub fn belt(&self, t: f64) -> BeltMotion {
        self.belt.at(t).0
    }

    /// The belt from the time `t` (scaled) on, and how long it and the friction law go on like that.
    #[must_use]
    pub fn belt_from(&self, t: f64) -> (BeltMotion, f64) {
        let (belt, holds) = self.belt.at(t);
        (belt, self.course.as_ref().map_or(holds, |course| holds.min(course.at(t).1)))
    }

    /// Whether the belt is of one velocity.
    #[must_use]
    pub fn has_steady_belt(&self) -> bool {
        self.belt.is_steady()
    }

    /// The state at the start.
    #[must_use]
    pub fn start(&self) -> State {
        self.start
    }

    /// This scene with another start.
    #[must_use]
    pub fn started(self, start: State) -> Scene {
        Scene { start, ..self }
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
            Duration::Ramp => self.belt.duration(),
        }
    }
}

/// Whether a number is not beyond [`LARGEST`].
fn is_small(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Whether the inverse of a number is not.
fn is_large(value: f64) -> bool {
    value.abs() >= 1.0 / LARGEST
}

/// Whether no number of a model is beyond [`LARGEST`], or so small that its inverse is.
fn has_range(model: &Scaled) -> bool {
    let positive = [model.m1, model.k1, model.k2, model.det, model.n0, model.c];
    let others = [model.c1, model.c2, model.mu0, model.law.mu_stick];
    positive.into_iter().all(|value| is_small(value) && is_large(value))
        && others.iter().chain(&model.law.kinks).copied().all(is_small)
        && model.law.pieces.iter().all(|piece| is_small(piece.largest()))
}
