//! What single precision does not bring to its end, computed once more in double precision.
//!
//! At contacts that graze, rounding in f32 makes events pile up until they are counted out: of a million random
//! instances 1553 end so, in f64 81. So few cost nothing to compute again.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::instances::Instances;
use crate::engine::judged::{Examined, take_response};
use crate::engine::lanes::linear::examined_many;
use crate::engine::lanes::outcomes::outcomes;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::model::instance::Instance;

/// The words about it in the name of a method.
#[must_use]
pub fn note(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => ", what ends early again in f64",
        Precision::F64 => "",
    }
}

/// Instances computed together: some to every lane.
const TOGETHER: usize = 64;

/// Computes those outcomes again that ended early; `None` when `cancel` is set on the way.
#[must_use]
pub fn outcomes_again(
    instances: &[Instance],
    plan: &Plan,
    mut made: Vec<Outcome>,
    cancel: &AtomicBool,
) -> Option<Vec<Outcome>> {
    let failed: Vec<usize> = (0..made.len()).filter(|index| made[*index].status.may_come_through()).collect();
    let few: Vec<Instance> = failed.iter().map(|index| instances[*index].clone()).collect();
    for (index, outcome) in failed.into_iter().zip(outcomes::<f64>(&few, plan, cancel)?) {
        made[index] = outcome;
    }
    Some(made)
}

/// Computes the responses of those records again that ended early, on the rayon pool it is called in; the records are those
/// of the instances from `first` on of a sweep. What `cancel` stops is not computed.
pub fn records_again(spec: &dyn Instances, first: usize, records: &mut [Record], cancel: &AtomicBool) {
    let plan = spec.plan();
    let failed: Vec<usize> = (0..records.len())
        .into_par_iter()
        .filter(|index| records[*index].outcome.is_some() && records[*index].status.may_come_through())
        .collect();
    let made: Vec<(usize, Record)> = failed
        .par_chunks(TOGETHER)
        .flat_map_iter(|some| {
            let instances: Vec<Instance> = some.iter().map(|index| spec.instance(first + index)).collect();
            let made = outcomes::<f64>(&instances, &plan, cancel).unwrap_or_default();
            let complete = |(((index, instance), (_, kind)), outcome): (((&usize, _), Examined), Outcome)| {
                let mut record = records[*index].clone();
                take_response(&mut record, instance, kind, &outcome);
                (*index, record)
            };
            let examined = examined_many(&instances, false);
            some.iter().zip(&instances).zip(examined).zip(made).map(complete).collect::<Vec<_>>()
        })
        .collect();
    for index in failed {
        records[index] = Record::NOT_COMPUTED;
    }
    for (index, record) in made {
        records[index] = record;
    }
}
