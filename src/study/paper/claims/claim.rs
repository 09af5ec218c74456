//! A claim of the paper, and what becomes of it.

use crate::study::paper::evidence::RampFacts;

/// The verdict on a claim.
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
    pub(super) fn of(holds: bool) -> Verdict {
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
    /// The paper's claim, as it is read here.
    pub says: &'static str,
    /// The result here, with its numbers.
    pub found: String,
    /// The verdict.
    pub verdict: Verdict,
}

/// `x` with `digits` decimals, or a dash.
pub(super) fn or_none(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "none".to_owned(), |x| format!("{x:.digits$}"))
}

pub(super) fn near(value: Option<f64>, target: f64, within: f64) -> bool {
    value.is_some_and(|x| (x - target).abs() <= within)
}

/// The result of a ramp whose vibration has not grown.
pub(super) fn not_grown(ramp: &RampFacts) -> String {
    format!(
        "on this ramp the vibration does not grow: ẍ2 stays within {:.1} m/s², {:.1} times what disturbs it",
        ramp.largest().1,
        ramp.largest().1 / ramp.disturbance
    )
}
