//! What the paper claims of the lumped model, and whether the results bear it out.
//!
//! Verdicts are decided here from [`Evidence`] and [`LIMITS`]; none is written down.

mod amplitudes;
mod course;
mod phase;
mod ramps;

use crate::study::paper::LIMITS;
use crate::study::paper::evidence::{Evidence, RampFacts};

/// What became of a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds.
    Reproduced,
    /// It holds, but not as the paper has it: under this condition.
    Under(String),
    /// It does not hold.
    NotReproduced,
}

impl Verdict {
    fn of(holds: bool) -> Verdict {
        if holds { Verdict::Reproduced } else { Verdict::NotReproduced }
    }

    /// In words, without the condition.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self {
            Verdict::Reproduced => "reproduced",
            Verdict::Under(_) => "reproduced under a stated condition",
            Verdict::NotReproduced => "not reproduced",
        }
    }
}

/// One claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The figure or section it belongs to.
    pub figure: &'static str,
    /// What the paper says, as it is read here.
    pub says: &'static str,
    /// What was found, with the numbers.
    pub found: String,
    /// What became of it.
    pub verdict: Verdict,
}

/// All claims in the order of the figures.
#[must_use]
pub fn claims(evidence: &Evidence) -> Vec<Claim> {
    vec![
        critical_friction(evidence),
        coalescence_frequency(evidence),
        ramps::stable_until_critical_velocity(evidence),
        ramps::limit_cycle_shrinks(evidence),
        ramps::beat(evidence),
        ramps::saturation_with_detachment(evidence),
        course::stable_zone(evidence),
        amplitudes::similar(evidence),
        amplitudes::larger_under_coexistence(evidence),
        phase::in_phase(evidence),
        phase::in_quadrature(evidence),
        phase::separates(evidence),
    ]
}

/// `x` with `digits` decimals, or a dash.
fn or_none(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "none".to_owned(), |x| format!("{x:.digits$}"))
}

fn near(value: Option<f64>, target: f64, within: f64) -> bool {
    value.is_some_and(|x| (x - target).abs() <= within)
}

fn critical_friction(evidence: &Evidence) -> Claim {
    let found = evidence.critical_friction;
    Claim {
        figure: "2",
        says: "with constant friction the sliding equilibrium loses stability at μ = 0.22",
        found: format!("at μ = {}", or_none(found, 4)),
        verdict: Verdict::of(near(found, LIMITS.critical_friction, LIMITS.critical_friction_within)),
    }
}

fn coalescence_frequency(evidence: &Evidence) -> Claim {
    let found = evidence.coalescence_frequency;
    let within = LIMITS.coalescence_frequency_within;
    Claim {
        figure: "2",
        says: "the two modes merge at about 34 Hz",
        found: format!("{} Hz at the critical friction", or_none(found, 2)),
        verdict: Verdict::of(near(found, LIMITS.coalescence_frequency, within)),
    }
}

/// What is found where a vibration has not grown.
fn not_grown(ramp: &RampFacts) -> String {
    format!(
        "on this ramp the vibration does not grow: ẍ2 stays within {:.1} m/s², {:.1} times what disturbs it",
        ramp.largest().1,
        ramp.largest().1 / ramp.disturbance
    )
}
