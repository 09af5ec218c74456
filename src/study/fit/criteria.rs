//! Several laws beside each other, by what each leaves of the points and how many values it takes for that.
//!
//! The law with the least is preferred; a difference below 2 tells nothing. Both take the errors of friction for independent.

use crate::model::friction::LawKind;
use crate::study::fit::each::{criteria, fit};
use crate::study::fit::fault::FitFault;
use crate::study::fit::shape::Shape;
use crate::study::fit::squares::{Fit, Point};

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
