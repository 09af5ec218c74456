//! Some runs from part to part: windows one after another until they are settled, and hunts for cycles between them.

use std::sync::atomic::Ordering;

use crate::engine::lanes::Lanes;
use crate::engine::lanes::hunts::Hunts;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::Settings;
use crate::engine::outcome::Outcome;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;

/// Takes jobs whose laws have one form to their end. Where it is stopped, the outcomes mean nothing.
pub fn drive<T: Lanes>(jobs: &mut [Job<T>], instances: &[&Instance], settings: Settings) -> Vec<Outcome> {
    // Once for all parts: those that swing pass all their time in one of them.
    let single = jobs.iter().all(|job| job.law() == LawForm::Pieces && job.is_single());
    let mut hunts = settings.plan.hunts.then(|| Hunts::new(jobs.len(), single, settings));
    let stopped = || settings.cancel.load(Ordering::Relaxed);
    loop {
        T::run(jobs, &[Part::Growth, Part::Approach, Part::Settle], single, settings);
        if let Some(hunts) = &mut hunts {
            let waits = !stopped() && hunts.hunt(jobs, instances);
            if waits {
                continue;
            }
        }
        if stopped() {
            break;
        }
        T::run(jobs, &[Part::Window], single, settings);
        if stopped() {
            break;
        }
        // Those that are not settled go on together with another window.
        let mut goes_on = jobs.iter_mut().fold(false, |any, job| job.goes_on(settings.plan) | any);
        if let Some(hunts) = &mut hunts {
            goes_on |= hunts.doubt(jobs, instances);
        }
        if stopped() || !goes_on {
            break;
        }
    }
    if !stopped() {
        T::run(jobs, &[Part::Phase], single, settings);
    }
    let found = |index: usize| hunts.as_ref().and_then(|hunts| hunts.found(index));
    jobs.iter()
        .enumerate()
        .map(|(index, job)| found(index).unwrap_or_else(|| job.outcome(settings.plan)))
        .collect()
}
