//! What the checks of a sweep found, counted in a memory that does not grow with it.

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};

use crate::engine::record::{By, Record};
use crate::engine::regime::THRESHOLDS;

/// Bins of a decade: a quantile is known to 12 %.
const BINS: f64 = 20.0;

/// The bin of an error of 0, and of one that is infinite.
const EXACT: i32 = i32::MIN;
const INFINITE: i32 = i32::MAX;

/// What the checks by one judge found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Instances that were checked.
    pub checked: usize,
    /// Checked instances with another type, regime or status.
    pub changed: usize,
    /// Checked instances near a border between labels: their record is the finer one.
    pub taken: usize,
    /// How many of these have another label in the finer record.
    pub taken_changed: usize,
    /// Checked instances that end elsewhere: with another label, or another amplitude.
    pub elsewhere: usize,
    /// How many errors fall into each part of a decade.
    errors: BTreeMap<i32, usize>,
}

impl Found {
    /// How many errors there are: those of settled oscillations.
    #[must_use]
    pub fn settled(&self) -> usize {
        self.errors.values().sum()
    }

    /// [`Found::quantile`], or `None` where there are too few settled oscillations for it: at least one has to lie above.
    #[must_use]
    pub fn known_quantile(&self, share: f64) -> Option<f64> {
        self.quantile(share).filter(|_| (1.0 - share) * self.settled() as f64 >= 1.0 - 1e-9)
    }

    /// The error that this share of the settled oscillations is within, to 12 %; `None` of none.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let wanted = share * self.settled() as f64;
        let mut sum = 0;
        for (bin, count) in &self.errors {
            sum += count;
            if sum as f64 >= wanted {
                return Some(upper(*bin));
            }
        }
        None
    }

    fn add(&mut self, record: &Record) {
        let Some(check) = record.check else { return };
        self.checked += 1;
        self.changed += usize::from(check.changed);
        let apart = check.error.is_some_and(|error| error > THRESHOLDS.apart);
        self.elsewhere += usize::from(check.changed || apart);
        self.taken += usize::from(check.taken);
        self.taken_changed += usize::from(check.taken && check.changed);
        if let Some(error) = check.error {
            *self.errors.entry(bin(error)).or_default() += 1;
        }
    }

    fn to_json(&self, judge: &str) -> Json {
        json!({
            "by": judge,
            "checked": self.checked,
            "settled_oscillations": self.settled(),
            "error": {
                "p50": self.known_quantile(0.5),
                "p95": self.known_quantile(0.95),
                "largest": self.quantile(1.0),
            },
            "labels_changed": self.changed,
            "labels_changed_share": self.changed as f64 / self.checked.max(1) as f64,
            "elsewhere": self.elsewhere,
            "near_a_border": self.taken,
            "near_a_border_changed": self.taken_changed,
        })
    }
}

/// What the checks of a sweep found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checks {
    /// The checks by the CPU engine in f64 with fine steps.
    pub fine: Found,
    /// The checks by the reference.
    pub reference: Found,
}

impl Checks {
    /// Counts a record.
    pub fn add(&mut self, record: &Record) {
        match record.check.map(|check| check.by) {
            Some(By::Fine) => self.fine.add(record),
            Some(By::Reference) => self.reference.add(record),
            None => {}
        }
    }

    /// Whether nothing was checked.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.fine.checked + self.reference.checked == 0
    }

    /// The checks as a manifest shows them; null when nothing was checked.
    #[must_use]
    pub fn to_json(&self) -> Json {
        if self.is_empty() {
            return Json::Null;
        }
        json!([
            self.fine.to_json("the CPU engine in f64 with fine steps"),
            self.reference.to_json("the reference"),
        ])
    }

    /// The checks as a summary shows them: a line for each judge that checked any instance. Those of cycles that were found are
    /// long runs.
    #[must_use]
    pub fn summary(&self, finds_cycles: bool) -> String {
        let line = |found: &Found, judge: &str| {
            if found.checked == 0 {
                return String::new();
            }
            let error = |error: Option<f64>| error.map_or("–".to_owned(), |error| format!("{error:.1e}"));
            let errors = match (found.known_quantile(0.5), found.known_quantile(0.95), found.settled()) {
                (_, _, 0) => String::new(),
                (Some(median), Some(most), _) => {
                    format!(" with relative errors of {median:.1e} (median) and {most:.1e} (95 %)")
                }
                _ => format!(
                    " with relative errors of at most {}: too few to say more",
                    error(found.quantile(1.0))
                ),
            };
            let near = if found.taken > 0 {
                format!(
                    "; of {} near a border between labels {} changed, and take that result",
                    found.taken, found.taken_changed
                )
            } else {
                String::new()
            };
            let (over, elsewhere) = if finds_cycles {
                (" in long runs", format!("; {} end elsewhere", found.elsewhere))
            } else {
                ("", String::new())
            };
            format!(
                "checked by {judge}{over}: {} instances, {} settled oscillations{errors}; {} other labels{elsewhere}{near}\n",
                found.checked,
                found.settled(),
                found.changed
            )
        };
        line(&self.fine, "the CPU engine in f64") + &line(&self.reference, "the reference")
    }
}

/// The part of a decade that an error falls into.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is within ±324")]
fn bin(error: f64) -> i32 {
    if error <= 0.0 {
        EXACT
    } else if error.is_finite() {
        (error.log10() * BINS).floor() as i32
    } else {
        INFINITE
    }
}

/// The upper end of a bin.
fn upper(bin: i32) -> f64 {
    match bin {
        EXACT => 0.0,
        INFINITE => f64::INFINITY,
        bin => 10_f64.powf((f64::from(bin) + 1.0) / BINS),
    }
}

#[cfg(test)]
mod tests {
    use super::{Checks, Found};
    use crate::engine::record::Record;
    use crate::engine::record::{By, Check};

    fn found(errors: impl Iterator<Item = f64>) -> Found {
        let mut checks = Checks::default();
        for error in errors {
            let check = Check { by: By::Fine, taken: false, changed: false, error: Some(error) };
            checks.add(&Record { check: Some(check), ..Record::default() });
        }
        checks.fine
    }

    #[test]
    fn quantiles_are_those_of_the_errors_to_a_bin() {
        let found = found((1..=1000).map(|k| f64::from(k) * 1e-6));
        for (share, truth) in [(0.5, 5e-4), (0.95, 9.5e-4), (1.0, 1e-3)] {
            let quantile = found.quantile(share).unwrap_or(f64::NAN);
            assert!(quantile >= truth && quantile < 1.13 * truth, "{share}: {quantile:e}");
        }
    }

    #[test]
    fn few_errors_have_no_95_percent() {
        assert_eq!(found([1e-6; 19].into_iter()).known_quantile(0.95), None);
        assert!(found([1e-6; 20].into_iter()).known_quantile(0.95).is_some());
        assert_eq!(found([1e-6].into_iter()).known_quantile(0.5), None);
        let mut checks = Checks::default();
        let check = Check { by: By::Fine, taken: false, changed: false, error: Some(0.25) };
        checks.add(&Record { check: Some(check), ..Record::default() });
        assert!(checks.summary(false).contains("too few to say more"));
    }

    #[test]
    fn extremes_have_their_place() {
        assert_eq!(found([].into_iter()).quantile(0.5), None);
        assert_eq!(found([0.0, 0.0, 1.0].into_iter()).quantile(0.5), Some(0.0));
        assert_eq!(found([0.0, f64::INFINITY].into_iter()).quantile(1.0), Some(f64::INFINITY));
        assert_eq!(found([f64::NAN].into_iter()).quantile(1.0), Some(f64::INFINITY));
    }
}
