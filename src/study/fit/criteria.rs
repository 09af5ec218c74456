//! Several laws beside each other, by what each leaves of the points and how many values it takes for that.
//!
//! With `n` points, residuals `r`, `σ² = Σ r²/n`, and `k` values, the variance among them,
//!
//! ```text
//! AICc = n ln σ² + 2k + 2k (k + 1)/(n − k − 1)        BIC = n ln σ² + k ln n
//! ```
//!
//! The law with the least is preferred; a difference below 2 tells nothing. Both take the errors of friction for independent.

use crate::model::friction::LawKind;
use crate::study::fit::fault::FitFault;
use crate::study::fit::shape::Shape;
use crate::study::fit::squares::{Fit, Point, fit};

/// No friction coefficient is known better than this: exact points do not make a law better that rounding favours.
const KNOWN: f64 = 1e-9;

/// A law and its criteria.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The law.
    pub law: LawKind,
    /// Its fit, or why there is none.
    pub fit: Result<Fit, FitFault>,
    /// `AICc` and `BIC`; `None` without a fit, or with too few points for so many values.
    pub criteria: Option<[f64; 2]>,
}

/// Fits every law that can be fitted, as [`fit`] does, in the order of their `AICc`.
#[must_use]
pub fn compare(points: &[Point], temperatures: &[f64], velocity: Option<f64>) -> Vec<Candidate> {
    let fitted = LawKind::ALL.into_iter().filter(|law| Shape::of(*law) != Shape::Other);
    let mut all: Vec<Candidate> = fitted
        .map(|law| {
            let found = fit(points, law, temperatures, velocity);
            let criteria = found.as_ref().ok().and_then(|found| criteria(found, velocity.is_some()));
            Candidate { law, fit: found, criteria }
        })
        .collect();
    let key = |candidate: &Candidate| candidate.criteria.map_or(f64::INFINITY, |[aicc, _]| aicc);
    all.sort_by(|a, b| key(a).total_cmp(&key(b)));
    all
}

/// `AICc` and `BIC` of a fit whose velocity was `given`, or found.
fn criteria(fit: &Fit, given: bool) -> Option<[f64; 2]> {
    let n = fit.points as f64;
    let rows = fit.temperature.len();
    let values = |(param, _): &(crate::model::Param, Vec<f64>)| match Shape::of(fit.law) {
        Shape::Falling(_, velocity) if *param == velocity => usize::from(!given),
        _ => rows,
    };
    let values = fit.columns.iter().map(values).sum();
    information(fit.points, values, n * fit.residual * fit.residual)
}

/// `AICc` and `BIC` of so many values, beside the variance, that leave this sum of `squares` of so many `points`.
pub(super) fn information(points: usize, values: usize, squares: f64) -> Option<[f64; 2]> {
    let (n, k) = (points as f64, (values + 1) as f64);
    let free = n - k - 1.0;
    let fits = n * (squares / n).max(KNOWN * KNOWN).ln();
    (free > 0.0).then(|| [fits + 2.0 * k + 2.0 * k * (k + 1.0) / free, fits + k * n.ln()])
}
