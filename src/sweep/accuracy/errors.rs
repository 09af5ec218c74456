//! How far results are from the truth, instance by instance and as quantiles.
//!
//! Motions that are chaotic, grazing or not settled depend on the last digits, so that any two methods differ in them.
//! Therefore numbers are compared only where the truth is a settled oscillation, labels everywhere.

use crate::engine::outcome::Outcome;
use crate::engine::record::Record;
use crate::engine::regime::Regime;
use crate::model::status::Status;

/// The quantities that an accuracy is about, as columns.
pub const QUANTITIES: [&str; 4] = ["x2_std", "ax_rms", "ay_rms", "response_frequency"];

/// The shares of the quantiles that are reported.
pub const SHARES: [f64; 3] = [0.5, 0.95, 0.99];

/// Median, 95th and 99th percentile.
pub type Quantiles = [f64; 3];

/// The quantities of a response.
#[must_use]
pub fn values(outcome: &Outcome) -> [Option<f64>; 4] {
    [outcome.x2_std, outcome.ax_rms, outcome.ay_rms, outcome.response_frequency]
}

/// Relative error; infinite where only one of the two is a number.
#[must_use]
pub fn relative(value: Option<f64>, truth: Option<f64>) -> f64 {
    match (value, truth) {
        (None, None) => 0.0,
        (Some(value), Some(truth)) if value.to_bits() == truth.to_bits() && value.is_finite() => 0.0,
        (Some(value), Some(truth)) => {
            let error = ((value - truth) / truth).abs();
            if error.is_finite() { error } else { f64::INFINITY }
        }
        _ => f64::INFINITY,
    }
}

/// The relative errors of the quantities of a record; all infinite where it has no response.
#[must_use]
pub fn of_record(record: &Record, truth: &Record) -> [f64; 4] {
    match (&record.outcome, &truth.outcome) {
        (Some(value), Some(of_truth)) if record.status == Status::Ok && truth.status == Status::Ok => {
            let (value, truth) = (values(value), values(of_truth));
            std::array::from_fn(|k| relative(value[k], truth[k]))
        }
        _ => [f64::INFINITY; 4],
    }
}

/// The largest of the four.
#[must_use]
pub fn worst(record: &Record, truth: &Record) -> f64 {
    of_record(record, truth).into_iter().fold(0.0, f64::max)
}

/// Whether the record is that of a settled oscillation: one whose numbers mean something.
#[must_use]
pub fn is_settled_oscillation(record: &Record) -> bool {
    record.settled == Some(true) && oscillates(record)
}

/// Whether the record is that of an oscillation.
#[must_use]
pub fn oscillates(record: &Record) -> bool {
    let rests = |regime| matches!(regime, Regime::Equilibrium | Regime::Stuck | Regime::NotYetGrown);
    record.regime.is_some_and(|regime| !rests(regime))
}

/// How much the halves of a record's own window differ in the deviation of `x2` and the rms of `ÿ1`, the larger
/// relative difference: what no method can be blamed for.
#[must_use]
pub fn scatter(record: &Record) -> f64 {
    let Some(outcome) = &record.outcome else { return 0.0 };
    [outcome.x2_std_halves, outcome.ay_rms_halves]
        .into_iter()
        .map(|[a, b]| (a - b).abs() / a.max(b))
        .filter(|difference| difference.is_finite())
        .fold(0.0, f64::max)
}

/// The smallest of some values that so many of them, by weight, do not exceed; NaN of none.
#[must_use]
pub fn quantile(mut values: Vec<(f64, f64)>, share: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = values.iter().map(|(_, weight)| weight).sum();
    let mut sum = 0.0;
    for (value, weight) in &values {
        sum += weight;
        // Rounding of the sums must not skip the last value.
        if sum >= share * total * (1.0 - 1e-12) {
            return *value;
        }
    }
    f64::NAN
}

/// The errors of one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Relative errors of [`QUANTITIES`].
    pub quantities: [Quantiles; 4],
    /// The worst of the four of each instance.
    pub worst: Quantiles,
    /// The 95th percentile of what the worst of the four is beyond the truth's own scatter.
    pub beyond_scatter: f64,
    /// Absolute errors of the fraction of time in stick.
    pub stick: Quantiles,
    /// Share of the instances with another type.
    pub types: f64,
    /// Share of the instances with another regime.
    pub regimes: f64,
    /// Share of the instances with another status.
    pub statuses: f64,
}

/// What results are compared with: true records, and how many instances of the sweep each stands for.
#[derive(Clone, Debug)]
pub struct Judge {
    truth: Vec<Record>,
    weights: Vec<f64>,
}

impl Judge {
    /// Judges by these records.
    ///
    /// # Panics
    /// When there is not one weight for each.
    #[must_use]
    pub fn new(truth: Vec<Record>, weights: Vec<f64>) -> Judge {
        assert_eq!(truth.len(), weights.len(), "a weight for every record");
        Judge { truth, weights }
    }

    /// The judge of some of the instances, by their places.
    #[must_use]
    pub fn part_of(&self, places: &[usize]) -> Judge {
        let truth = places.iter().map(|at| self.truth[*at].clone()).collect();
        Judge { truth, weights: places.iter().map(|at| self.weights[*at]).collect() }
    }

    /// The true records.
    #[must_use]
    pub fn truth(&self) -> &[Record] {
        &self.truth
    }

    /// The share of the instances whose true record is like this, by weight.
    #[must_use]
    pub fn share(&self, of: impl Fn(&Record) -> bool) -> f64 {
        self.part(|at| of(&self.truth[at]))
    }

    /// The share of the instances that are selected by their place, by weight.
    fn part(&self, of: impl Fn(usize) -> bool) -> f64 {
        let selected = self.weights.iter().enumerate().filter(|(at, _)| of(*at)).map(|(_, weight)| weight);
        // An empty sum would be -0.
        selected.fold(0.0, |sum, weight| sum + weight) / self.weights.iter().sum::<f64>()
    }

    /// Quantiles of a number of the settled oscillations; it gets a record and the true one.
    fn quantiles(&self, records: &[Record], of: impl Fn(&Record, &Record) -> f64) -> Quantiles {
        let judged: Vec<(f64, f64)> = records
            .iter()
            .zip(&self.truth)
            .zip(&self.weights)
            .filter(|((_, truth), _)| is_settled_oscillation(truth))
            .map(|((record, truth), weight)| (of(record, truth), *weight))
            .collect();
        SHARES.map(|share| quantile(judged.clone(), share))
    }

    /// The scatter of the truth.
    #[must_use]
    pub fn scatter(&self) -> Quantiles {
        self.quantiles(&self.truth, |_, truth| scatter(truth))
    }

    /// The errors of the records of the same instances.
    ///
    /// # Panics
    /// When there is not one for each.
    #[must_use]
    pub fn errors(&self, records: &[Record]) -> Errors {
        assert_eq!(records.len(), self.truth.len(), "a record for every true one");
        let differs =
            |of: &dyn Fn(&Record, &Record) -> bool| self.part(|at| of(&records[at], &self.truth[at]));
        let stick = |record: &Record| record.outcome.as_ref().and_then(|outcome| outcome.stick);
        Errors {
            quantities: std::array::from_fn(|k| {
                self.quantiles(records, |record, truth| of_record(record, truth)[k])
            }),
            worst: self.quantiles(records, worst),
            beyond_scatter: self
                .quantiles(records, |record, truth| (worst(record, truth) - scatter(truth)).max(0.0))[1],
            stick: self.quantiles(records, |record, truth| match (stick(record), stick(truth)) {
                (Some(value), Some(truth)) => (value - truth).abs(),
                _ => f64::INFINITY,
            }),
            types: differs(&|record, truth| record.kind != truth.kind),
            regimes: differs(&|record, truth| record.regime != truth.regime),
            statuses: differs(&|record, truth| record.status != truth.status),
        }
    }
}
