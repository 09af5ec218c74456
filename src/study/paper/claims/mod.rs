//! What the paper claims of the lumped model, and whether the results bear it out.
//!
//! Verdicts are decided here from [`Evidence`] and [`LIMITS`]; none is written down.
//!
//! - `claim.rs`: a claim and its verdict.
//! - `ramps.rs`, `amplitudes.rs`: claims on single ramps, and on ramps compared with each other.
//! - `course.rs`: claims on the size of a vibration along a ramp.
//! - `phase.rs`: claims on the phase of the two accelerations.

mod amplitudes;
mod claim;
mod course;
mod phase;
mod ramps;

use crate::study::paper::LIMITS;
use crate::study::paper::evidence::Evidence;
pub use claim::{Claim, Verdict};
use claim::{near, or_none};

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
