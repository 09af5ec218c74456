//! A trial: how a configuration does on some instances of a sweep, and whether it keeps a bound.

use serde::{Deserialize, Serialize};

/// The part of the oscillations of a trial that may break the bound. It is half of what the promise allows, because several
/// choices are tried on one sample and none should pass by luck. A choice that breaks the bound in 10 % of all cases passes
/// a trial of 100 oscillations one time in 500, and a trial of 40 one time in 70.
const BROKEN: f64 = 0.025;

/// How a configuration did on some instances of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Trial {
    /// Instances.
    pub instances: usize,
    /// Settled oscillations among them.
    pub settled_oscillations: usize,
    /// The relative error beyond the truth's own scatter that 95 % of them keep; `None` of fewer than 20.
    pub p95: Option<f64>,
    /// How many of them break the bound.
    pub broken: usize,
}

impl Trial {
    /// Whether the bound was kept, as far as so few can tell.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.broken as f64 <= (BROKEN * self.settled_oscillations as f64 - 0.5).max(0.0)
    }

    /// The result as a sentence for the user.
    #[must_use]
    pub fn sentence(&self, bound: f64) -> String {
        let Trial { instances, settled_oscillations: settled, p95, .. } = *self;
        let sample =
            format!("tried on {instances} instances of this sweep, {settled} of them settled oscillations");
        let found = match p95 {
            Some(p95) if p95 > 0.0 => format!("95 % within {p95:.1e} beyond their own scatter"),
            Some(_) => "95 % within their own scatter".to_owned(),
            None if self.passed() => {
                return format!("{sample}: too few to tell whether it keeps {bound:e} here");
            }
            None => "too few for a 95th percentile".to_owned(),
        };
        if self.passed() {
            return format!("{sample}: {found}");
        }
        format!(
            "warning: {sample}: {found}, but {} break {bound:e}, more than half of what may, and nothing measured is more \
             accurate; the checks in the summary say what the whole sweep has",
            self.broken
        )
    }
}
