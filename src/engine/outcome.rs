//! The outcome of the transient of one instance.

use serde::Serialize;

use crate::engine::cycle::candidate::Cycle;
use crate::model::equilibrium::Units;
use crate::model::status::Status;

/// How a run until settled ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// On its way back to a stable equilibrium without any event: its eigenvalues say the rest.
    Decays,
    /// Its windows agree.
    Settled,
    /// At the longest time to settle, its windows still differ.
    Limit,
}

/// What the transient of one instance did, SI units; `None` is an undefined value.
///
/// Means, deviations and fractions are over the measuring window, time-weighted.
/// When `status` is not [`Status::Ok`] every observable is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// How the instance ended.
    pub status: Status,
    /// Mean of `x2`, m.
    pub x2_mean: Option<f64>,
    /// Standard deviation of `x2`, m.
    pub x2_std: Option<f64>,
    /// Mean of `y1`, m.
    pub y1_mean: Option<f64>,
    /// Standard deviation of `y1`, m.
    pub y1_std: Option<f64>,
    /// Root mean square of `ẍ2`, m/s².
    pub ax_rms: Option<f64>,
    /// Root mean square of `ÿ1`, m/s².
    pub ay_rms: Option<f64>,
    /// Largest `|ẍ2|`, m/s².
    pub ax_peak: Option<f64>,
    /// Largest `|ÿ1|`, m/s².
    pub ay_peak: Option<f64>,
    /// `∫T dt / ∫N dt`.
    pub friction_mean: Option<f64>,
    /// Largest normal force, N.
    pub n_peak: Option<f64>,
    /// Upward zero crossings of `ẋ2` over the time from the first to the last, Hz.
    pub response_frequency: Option<f64>,
    /// Phase of `ÿ1` against `ẍ2` at the response frequency, degrees.
    pub phase_cycle: Option<f64>,
    /// Growth rate measured before the first event, 1/s.
    pub growth_rate_measured: Option<f64>,
    /// Frequency measured before the first event, Hz.
    pub frequency_measured: Option<f64>,
    /// Phase of `ÿ1` against `ẍ2` measured before the first event, degrees.
    pub phase_measured: Option<f64>,
    /// Fraction of time in stick.
    pub stick: Option<f64>,
    /// Fraction of time in free flight.
    pub free: Option<f64>,
    /// Fraction of time in reversed slip (`ẋ2 > V`).
    pub reverse: Option<f64>,
    /// Impacts per second.
    pub impacts_per_second: Option<f64>,
    /// Impacts that gained energy (Newton restitution with Coulomb friction), over the whole run; only the
    /// reference counts them.
    pub energy_gaining_impacts: Option<u64>,
    /// Rms of `sqrt(ẋ2² + ẏ1²)` in the first and the second half of the window, m/s.
    pub speed_rms_halves: [f64; 2],
    /// Standard deviation of `x2` in the two halves, m.
    pub x2_std_halves: [f64; 2],
    /// Rms of `ÿ1` in the two halves, m/s².
    pub ay_rms_halves: [f64; 2],
    /// Length of the measuring window, s.
    pub window: f64,
    /// Whether the run met an event, from its start to its end: rest on the belt, a kink of the friction law, the end of
    /// stick, lift-off, an impact.
    pub met_event: bool,
    /// Largest modulus of the multipliers of the cycle, where it was found as a fixed point of the return map: what is left
    /// of a small disturbance after one period.
    pub floquet: Option<f64>,
    /// The angle of that multiplier, degrees, 0 to 180.
    pub floquet_angle: Option<f64>,
    /// Returns to the section in a period, upward zero crossings of `ẋ2`.
    pub cycle_returns: Option<u64>,
    /// The period of the cycle, s.
    pub period: Option<f64>,
    /// How a run until settled ended.
    pub ending: Option<Ending>,
    /// The start of its last window, s: what came before was needed to settle.
    pub settling_time: Option<f64>,
    /// Simulated time, s.
    pub simulated_time: f64,
    /// Steps taken, those ended by an event included.
    pub steps: u64,
}

impl Outcome {
    /// The outcome of one period of a cycle that a run came to at the scaled time `time`.
    #[must_use]
    pub fn on_cycle(self, cycle: &Cycle, time: f64, units: &Units) -> Outcome {
        let [re, im] = cycle.multiplier;
        Outcome {
            floquet: Some(re.hypot(im)),
            floquet_angle: Some(im.atan2(re).to_degrees()),
            cycle_returns: Some(cycle.returns as u64),
            period: Some(cycle.period * units.time),
            ..self.ended(Ending::Settled, time * units.time)
        }
    }

    /// The outcome of the last window of a run until settled, which began at `start` (SI).
    #[must_use]
    pub fn ended(self, ending: Ending, start: f64) -> Outcome {
        match self.status {
            Status::Ok => Outcome { ending: Some(ending), settling_time: Some(start), ..self },
            _ => self,
        }
    }
}
