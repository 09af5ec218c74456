//! The transients of some instances in the lanes of vector registers.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::engine::lanes::drive::drive;
use crate::engine::lanes::job::Job;
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::lanes::{Lanes, ORDER, tolerance};
use crate::engine::method::pace::Turns;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use crate::model::Param;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;

/// The transients of some instances; `None` when `cancel` is set on the way.
#[must_use]
pub fn outcomes<T: Lanes>(instances: &[Instance], plan: &Plan, cancel: &AtomicBool) -> Option<Vec<Outcome>> {
    outcomes_on::<T>(instances, plan, Terms::default(), cancel)
}

/// The transients of some instances, integrated on other terms than the default; `None` when `cancel` is set on the way.
#[must_use]
pub fn outcomes_on<T: Lanes>(
    instances: &[Instance],
    plan: &Plan,
    terms: Terms,
    cancel: &AtomicBool,
) -> Option<Vec<Outcome>> {
    let tolerance = tolerance(T::PRECISION, plan.steps_per_period);
    let settings = Settings { plan, tolerance, terms, cancel };
    let turns = Turns::new(ORDER, settings.tolerance);
    let mut outcomes = vec![Outcome::default(); instances.len()];
    let upright = |instance: &Instance| instance.params.require(Param::Theta) == 0.0;
    // What steps together has a law of one form; the single mass is stepped by less code.
    for (form, single) in LawForm::ALL.into_iter().flat_map(|form| [(form, true), (form, false)]) {
        let here = |instance: &Instance| {
            instance.law.kind().form() == form && (form.is_straight() && upright(instance)) == single
        };
        let mut indices: Vec<usize> = (0..instances.len()).filter(|index| here(&instances[*index])).collect();
        let mut jobs = Vec::<Job<T>>::with_capacity(indices.len());
        indices.retain(|index| match Scene::planned(&instances[*index], plan) {
            Ok(scene) => {
                jobs.push(Job::new(&instances[*index], scene, plan, &turns));
                true
            }
            Err(status) => {
                outcomes[*index].status = status;
                false
            }
        });
        let some: Vec<&Instance> = indices.iter().map(|index| &instances[*index]).collect();
        let ended = drive(&mut jobs, &some, settings);
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        for (index, outcome) in indices.into_iter().zip(ended) {
            outcomes[index] = outcome;
        }
    }
    Some(outcomes)
}
