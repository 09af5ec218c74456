//! What an engine has reduced of a run, into an outcome in SI units: the one conversion for all engines.

use num_complex::Complex64;

use crate::engine::growth::{self, GrowthFit};
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use crate::engine::sums::{growth as words, peak, sum};
use crate::model::status::Status;

/// A crossing so close to the end of a period, as a part of it, is the one that ends it.
const AT_END: f64 = 1e-6;

/// Reductions of one run, scaled, deviations from the equilibrium.
#[derive(Clone, Debug, Default)]
pub struct Reductions {
    /// `x2` and `y1` from which the sums of positions count.
    pub origin: [f64; 2],
    /// The sums of both halves of the window, see [`sum`].
    pub halves: [[f64; sum::WORDS]; 2],
    /// Largest values, see [`peak`].
    pub peaks: [f64; peak::WORDS],
    /// Impacts in the window.
    pub impacts: u64,
    /// Upward crossings of `ẋ2`.
    pub crossings: u64,
    /// Time of the first.
    pub first: f64,
    /// Time of the last.
    pub last: f64,
    /// Fourier components of `ẍ2` and `ÿ1` between the two, real and imaginary.
    pub phase: [[f64; 2]; 2],
    /// Sums before the first event, see [`words`].
    pub growth: [f64; words::WORDS],
}

/// How a run ended.
#[derive(Clone, Copy, Debug)]
pub struct End {
    /// Its status.
    pub status: Status,
    /// Its steps.
    pub steps: u64,
    /// The time it reached.
    pub time: f64,
    /// Whether there was an event in the whole run.
    pub met_event: bool,
}

impl Reductions {
    /// Cycles per time between the first and the last crossing, when there are two.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        let span = self.last - self.first;
        (self.crossings >= 2 && span > 0.0).then(|| (self.crossings - 1) as f64 / span)
    }

    /// Takes what a window from `start` to `end` has seen for a whole period of a cycle that begins with a crossing. Its halves
    /// are alike then, and another crossing ends it, whether rounding let it be seen or not.
    pub fn close_period(&mut self, [start, end]: [f64; 2]) {
        let halves = self.halves;
        self.halves = [std::array::from_fn(|i| 0.5 * (halves[0][i] + halves[1][i])); 2];
        let at_end = self.crossings > 0 && end - self.last <= AT_END * (end - start);
        self.crossings += if at_end { 1 } else { 2 };
        (self.first, self.last) = (start, end);
    }

    /// The outcome.
    #[must_use]
    pub fn outcome(&self, scene: &Scene, plan: &Plan, end: &End) -> Outcome {
        let units = &scene.units;
        let mut outcome =
            Outcome { status: scene.model.told(end.status), steps: end.steps, ..Outcome::default() };
        if end.status != Status::Ok {
            outcome.simulated_time = end.time * units.time;
            return outcome;
        }
        outcome.simulated_time = scene.seconds(end.time, plan);
        let blank = outcome;
        if !self.halves.iter().flatten().chain(&self.peaks).all(|value| value.is_finite()) {
            // A square beyond the scalar's range.
            return Outcome { status: Status::NonFinite, ..blank };
        }
        let halves = self.halves;
        let all: [f64; sum::WORDS] = std::array::from_fn(|i| halves[0][i] + halves[1][i]);
        let std = |s: &[f64; sum::WORDS], i: usize, ii: usize| {
            (s[ii] / s[sum::TIME] - (s[i] / s[sum::TIME]).powi(2)).max(0.0).sqrt()
        };
        let rms = |s: &[f64; sum::WORDS], i: usize| (s[i] / s[sum::TIME]).sqrt();
        outcome.x2_mean =
            Some(scene.equilibrium.x2 + (self.origin[0] + all[sum::X] / all[sum::TIME]) * units.length);
        outcome.x2_std = Some(std(&all, sum::X, sum::XX) * units.length);
        outcome.y1_mean =
            Some(scene.equilibrium.y1 + (self.origin[1] + all[sum::Y] / all[sum::TIME]) * units.length);
        outcome.y1_std = Some(std(&all, sum::Y, sum::YY) * units.length);
        outcome.ax_rms = Some(rms(&all, sum::AX) * units.acceleration);
        outcome.ay_rms = Some(rms(&all, sum::AY) * units.acceleration);
        outcome.ax_peak = Some(self.peaks[peak::AX] * units.acceleration);
        outcome.ay_peak = Some(self.peaks[peak::AY] * units.acceleration);
        let friction = all[sum::TANGENTIAL] / all[sum::NORMAL];
        outcome.friction_mean = (all[sum::NORMAL] > 0.0 && friction.is_finite()).then_some(friction);
        outcome.n_peak = Some(self.peaks[peak::NORMAL] * units.force);
        outcome.stick = Some(all[sum::STICK] / all[sum::TIME]);
        outcome.free = Some(all[sum::FREE] / all[sum::TIME]);
        outcome.reverse = Some(all[sum::REVERSE] / all[sum::TIME]);
        outcome.window = all[sum::TIME] * units.time;
        outcome.impacts_per_second = Some(self.impacts as f64 / outcome.window);
        outcome.speed_rms_halves = halves.map(|s| rms(&s, sum::SPEED) * units.velocity);
        let deviations = halves.map(|s| std(&s, sum::X, sum::XX));
        outcome.x2_std_halves = deviations.map(|deviation| deviation * units.length);
        outcome.ay_rms_halves = halves.map(|s| rms(&s, sum::AY) * units.acceleration);
        // What rests has no frequency, whatever its last digits do.
        if let Some(frequency) = self.frequency().filter(|_| outcome.x2_std > Some(0.0)) {
            outcome.response_frequency = Some(frequency / units.time);
            let [x, y] = self.phase.map(|z| Complex64::new(z[0], z[1]));
            let ratio = y / x;
            outcome.phase_cycle =
                (ratio.is_finite() && ratio != Complex64::ZERO).then(|| ratio.arg().to_degrees());
        }
        outcome.met_event = end.met_event;
        let [early, late] = deviations;
        let is_linear =
            |fit: &GrowthFit| end.met_event || !fit.is_bent(&scene.model, &self.growth, early.max(late));
        if let Some(fit) = growth::fit(&self.growth).filter(is_linear) {
            outcome.growth_rate_measured = Some(fit.growth_rate / units.time);
            outcome.frequency_measured = Some(fit.angular_frequency / std::f64::consts::TAU / units.time);
            outcome.phase_measured = fit.phase.map(f64::to_degrees);
        }
        let Outcome { x2_std, y1_std, ax_rms, ay_rms, ax_peak, ay_peak, .. } = outcome;
        if ![x2_std, y1_std, ax_rms, ay_rms, ax_peak, ay_peak].iter().flatten().all(|value| value.is_finite())
        {
            // In SI units it is.
            return Outcome { status: Status::NonFinite, ..blank };
        }
        outcome
    }
}
