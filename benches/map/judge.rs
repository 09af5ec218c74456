//! How far the results of an engine are from those of the reference at twice its resolution.

use crate::work::{Work, reference_plan};
use rayon::prelude::*;
use squealmap::engine::judged::regime;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::regime::Regime;
use squealmap::model::linear;
use squealmap::model::status::Status;

/// Steps per period of the judge: twice those of a sweep.
const STEPS: u32 = 24;

/// Most instances that are judged of one map: their p99 has 20 instances beyond it.
const SAMPLE: usize = 2048;

/// Which instances of a map are judged, and what the reference says of them.
pub(crate) struct Judge {
    work: Work,
    /// The judged instances, rising.
    pub(crate) indices: Vec<usize>,
    truth: Vec<Outcome>,
}

/// The errors of a case.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Errors {
    /// Relative error of the standard deviation of `x2`: median and 99th percentile.
    pub(crate) median: f64,
    pub(crate) p99: f64,
    /// Share of the instances whose status or regime differs.
    pub(crate) labels: f64,
    /// Instances judged.
    pub(crate) judged: usize,
}

impl Judge {
    pub(crate) fn new(work: Work) -> Judge {
        let indices = work.sample(SAMPLE);
        let plan = reference_plan(STEPS);
        let truth = indices.par_iter().map(|&index| respond(&work.instance(index), &plan)).collect();
        let judge = Judge { work, indices, truth };
        judge.check();
        judge
    }

    /// Planted faults: a judge that does not see them would call every engine exact.
    fn check(&self) {
        let with = |fault: fn(&mut Outcome)| {
            let mut outcomes = self.truth.clone();
            outcomes.iter_mut().for_each(fault);
            self.errors(&outcomes)
        };
        let (none, longer) =
            (with(|_| ()), with(|outcome| outcome.x2_std = outcome.x2_std.map(|x| 1.01 * x)));
        let undefined = with(|outcome| outcome.x2_std = Some(f64::NAN));
        let unwritten = with(|outcome| *outcome = Outcome::default());
        assert!(none.p99 <= 0.0 && none.labels <= 0.0, "the reference differs from itself: {none:?}");
        assert!((longer.median - 0.01).abs() < 1e-9, "1 % more is not seen: {longer:?}");
        assert!(undefined.median.is_infinite(), "a NaN passes for a number: {undefined:?}");
        assert!(unwritten.labels >= 1.0, "unwritten outcomes pass for computed ones: {unwritten:?}");
    }

    /// The errors of the outcomes of the judged instances, in their order.
    pub(crate) fn errors(&self, outcomes: &[Outcome]) -> Errors {
        assert_eq!(outcomes.len(), self.truth.len(), "an outcome for every judged instance");
        let mut deviations = Vec::new();
        let mut labels = 0;
        for ((index, outcome), truth) in self.indices.iter().zip(outcomes).zip(&self.truth) {
            if self.label(*index, outcome) != self.label(*index, truth) {
                labels += 1;
            }
            if truth.status == Status::Ok {
                deviations.push(deviation(outcome, truth));
            }
        }
        deviations.sort_by(f64::total_cmp);
        let quantile = |share: usize| {
            deviations.get(deviations.len().saturating_sub(1) * share / 100).copied().unwrap_or(f64::NAN)
        };
        Errors {
            median: quantile(50),
            p99: quantile(99),
            labels: f64::from(labels) / outcomes.len() as f64,
            judged: outcomes.len(),
        }
    }

    /// What a map shows of an instance.
    fn label(&self, index: usize, outcome: &Outcome) -> (Status, Option<Regime>) {
        let instance = self.work.instance(index);
        let (kind, _) = linear::analyse(&instance);
        let of_ok = (outcome.status == Status::Ok).then(|| regime(&instance, kind, outcome).0);
        (outcome.status, of_ok)
    }
}

/// Relative error of the standard deviation of `x2`; infinite where there is none.
fn deviation(outcome: &Outcome, truth: &Outcome) -> f64 {
    let pair = outcome.x2_std.zip(truth.x2_std);
    let error = pair.map_or(f64::INFINITY, |(value, true_value)| (value / true_value - 1.0).abs());
    if error.is_finite() { error } else { f64::INFINITY }
}
