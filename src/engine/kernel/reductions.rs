//! The sums that an engine has reduced a run to, and from them the outcome in SI units (host only).

use num_complex::Complex64;

use crate::engine::kernel::observe::SUMS;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::observe::{Growth, GrowthFit};
use crate::engine::scene::Scene;
use crate::model::status::Status;

/// Words of the growth window.
pub const GROWTH: usize = 15;

/// Reductions of one run, scaled, deviations from the equilibrium.
#[derive(Clone, Debug, Default)]
pub struct Reductions {
    /// `x2` and `y1` from which the sums of positions count.
    pub origin: [f64; 2],
    /// The sums of [`crate::engine::kernel::observe::Sums::block`] over both halves of the window.
    pub halves: [[f64; SUMS]; 2],
    /// Largest `|ẍ2|`, `|ÿ1|`, `N`.
    pub peaks: [f64; 3],
    /// Impacts in the window.
    pub impacts: u32,
    /// Upward crossings of `ẋ2`.
    pub crossings: u64,
    /// Time of the first.
    pub first: f64,
    /// Time of the last.
    pub last: f64,
    /// Fourier components of `ẍ2` and `ÿ1` between the two, real and imaginary.
    pub phase: [[f64; 2]; 2],
    /// Time before the first event, sums of `x v a b` and their products, upper triangle by rows.
    pub growth: [f64; GROWTH],
    /// Whether there was an event in the whole run.
    pub met_event: bool,
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
}

impl Reductions {
    /// Cycles per time between the first and the last crossing, when there are two.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        let span = self.last - self.first;
        (self.crossings >= 2 && span > 0.0).then(|| (self.crossings - 1) as f64 / span)
    }

    /// The outcome.
    #[must_use]
    pub fn outcome(&self, scene: &Scene, plan: &Plan, end: &End) -> Outcome {
        let units = &scene.units;
        let mut outcome = Outcome { status: scene.told(end.status), steps: end.steps, ..Outcome::default() };
        if end.status != Status::Ok {
            outcome.simulated_time = end.time * units.time;
            return outcome;
        }
        outcome.simulated_time = scene.seconds(end.time, plan);
        if !self.halves.iter().flatten().chain(&self.peaks).all(|value| value.is_finite()) {
            // A square beyond the scalar's range.
            outcome.status = Status::NonFinite;
            return outcome;
        }
        let halves = self.halves;
        let all: [f64; SUMS] = std::array::from_fn(|i| halves[0][i] + halves[1][i]);
        let std = |s: &[f64; SUMS], i: usize| (s[i + 1] / s[0] - (s[i] / s[0]).powi(2)).max(0.0).sqrt();
        let rms = |s: &[f64; SUMS], i: usize| (s[i] / s[0]).sqrt();
        outcome.x2_mean = Some(scene.equilibrium.x2 + (self.origin[0] + all[1] / all[0]) * units.length);
        outcome.x2_std = Some(std(&all, 1) * units.length);
        outcome.y1_mean = Some(scene.equilibrium.y1 + (self.origin[1] + all[3] / all[0]) * units.length);
        outcome.y1_std = Some(std(&all, 3) * units.length);
        outcome.ax_rms = Some(rms(&all, 5) * units.acceleration);
        outcome.ay_rms = Some(rms(&all, 6) * units.acceleration);
        outcome.ax_peak = Some(self.peaks[0] * units.acceleration);
        outcome.ay_peak = Some(self.peaks[1] * units.acceleration);
        let friction = all[8] / all[9];
        outcome.friction_mean = (all[9] > 0.0 && friction.is_finite()).then_some(friction);
        outcome.n_peak = Some(self.peaks[2] * units.force);
        outcome.stick = Some(all[10] / all[0]);
        outcome.free = Some(all[11] / all[0]);
        outcome.reverse = Some(all[12] / all[0]);
        outcome.window = all[0] * units.time;
        outcome.impacts_per_second = Some(f64::from(self.impacts) / outcome.window);
        outcome.speed_rms_halves = halves.map(|s| rms(&s, 7) * units.velocity);
        outcome.x2_std_halves = halves.map(|s| std(&s, 1) * units.length);
        outcome.ay_rms_halves = halves.map(|s| rms(&s, 6) * units.acceleration);
        if let Some(frequency) = self.frequency() {
            outcome.response_frequency = Some(frequency / units.time);
            let [x, y] = self.phase.map(|z| Complex64::new(z[0], z[1]));
            let ratio = y / x;
            outcome.phase_cycle =
                (ratio.is_finite() && ratio.norm_sqr() > 0.0).then(|| ratio.arg().to_degrees());
        }
        outcome.met_event = self.met_event;
        if let Some(fit) = growth_fit(&self.growth) {
            outcome.growth_rate_measured = Some(fit.growth_rate / units.time);
            outcome.frequency_measured = Some(fit.angular_frequency / std::f64::consts::TAU / units.time);
            outcome.phase_measured = fit.phase.map(f64::to_degrees);
        }
        outcome
    }
}

/// The fit of the growth window from its sums.
fn growth_fit(words: &[f64; GROWTH]) -> Option<GrowthFit> {
    let mut product = [[0.0; 5]; 5];
    for (word, (i, j)) in (1..5).flat_map(|i| (i..5).map(move |j| (i, j))).enumerate() {
        product[i][j] = words[5 + word];
        product[j][i] = words[5 + word];
    }
    let sum = [words[0], words[1], words[2], words[3], words[4]];
    Growth::from_sums(words[0], sum, product).result()
}
