//! The instances of a sweep as words of the linear kernel, and what it has made of them as their records.

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::judged::begun;
use crate::engine::kernel::linear::{Analysed, KERNEL, POLYNOMIALS, analyse};
use crate::engine::kernel::places::{filled, place};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{FLAG_STATUS, FLAG_STEPS};
use crate::engine::kernel::words::{FLAG_WORDS, INPUT_WORDS, STATE_WORDS, Words};
use crate::engine::record::Record;
use crate::model::kind::{InstabilityType, UNSTABLE_ABOVE};
use crate::model::linear::{prepare, solve};
use crate::model::status::Status;

/// The flag word of the type.
const FLAG_TYPE: usize = 2;

/// An instance before the kernel: its record so far, and its words where it needs the kernel.
pub type Known = (Record, Option<Words>);

/// Instance `index` before the kernel.
#[must_use]
pub fn known(spec: &dyn Instances, index: usize) -> Known {
    let instance = spec.instance(index);
    let prepared = prepare(&instance);
    let mut record = begun(&instance, &prepared);
    let words = prepared.as_ref().ok().map(Words::new).filter(|words| !words.is_far());
    if words.is_none() {
        (record.kind, record.linear) = solve(&prepared);
    }
    (record, words)
}

/// The inputs of those instances that need the kernel, and how many they are.
#[must_use]
pub fn inputs<R: Real>(known: &[Known]) -> (Vec<R>, usize) {
    let live: Vec<[R; INPUT_WORDS]> =
        known.par_iter().filter_map(|(_, words)| Some(words.as_ref()?.inputs.map(R::from_f64))).collect();
    (filled(INPUT_WORDS, live.len(), |index| &live[index][..]), live.len())
}

/// Completes the records of a chunk by the words of its state and flags, and appends them; instances that were not computed before
/// it was `cancelled` have none.
///
/// # Errors
/// When the kernel says that it has not done all of an instance.
pub fn take<R: Real>(
    records: &mut Vec<Record>,
    known: Vec<Known>,
    (all_state, flags): (&[R], &[u32]),
    cancelled: bool,
) -> Result<()> {
    let mut count = 0;
    let number = |(_, words): &Known| {
        let number = count;
        count += usize::from(words.is_some());
        number
    };
    let numbers: Vec<usize> = known.iter().map(number).collect();
    let miscounted = AtomicU32::new(POLYNOMIALS);
    let record = |((mut record, words), number): (Known, usize)| {
        let Some(words) = words else { return record };
        let flag = |word: usize| flags[place([word, FLAG_WORDS], number)];
        if cancelled && flag(FLAG_STATUS) == Status::Unwritten as u32 {
            return Record::NOT_COMPUTED;
        }
        if flag(FLAG_STEPS) != POLYNOMIALS {
            miscounted.store(flag(FLAG_STEPS), Ordering::Relaxed);
        }
        let state: [f64; STATE_WORDS] =
            std::array::from_fn(|k| all_state[place([k, STATE_WORDS], number)].to_f64());
        let (state, kind) = if doubtful::<R>(&words, state) {
            let Analysed { state, flags } = analyse::<f64>(&|word| words.inputs[word]);
            (state, flags[FLAG_TYPE])
        } else {
            (state, flag(FLAG_TYPE))
        };
        complete(&mut record, &words, state, flag(FLAG_STATUS), kind);
        record
    };
    records.par_extend(known.into_par_iter().zip(numbers).map(record));
    let found = miscounted.into_inner();
    if found != POLYNOMIALS {
        let wanted = POLYNOMIALS as usize;
        return Err(Error::Miscounted { kernel: KERNEL.name, found: found as usize, wanted });
    }
    Ok(())
}

/// Whether the rounding of the scalar decides on the sign of a growth rate: such an instance is analysed again in f64.
fn doubtful<R: Real>(words: &Words, [full, .., flat, frozen]: [f64; STATE_WORDS]) -> bool {
    /// Roundings that add up in a growth rate, in the size of the dampings: half their sum `P`, and their coupling `e`.
    const ROUNDINGS: f64 = 32.0;
    let rounding = ROUNDINGS * R::EPSILON.to_f64();
    let near = |(rate, four): (f64, &[f64])| rate.abs() < rounding * (four[0].abs() + four[3].abs());
    rounding > UNSTABLE_ABOVE && [full, flat, frozen].into_iter().zip(words.inputs.chunks(4)).any(near)
}

/// Puts the kernel's results into a record.
fn complete(record: &mut Record, words: &Words, state: [f64; STATE_WORDS], status: u32, kind: u32) {
    let results: Option<(InstabilityType, _)> =
        (status == Status::Ok as u32).then(|| words.results(state, kind)).flatten();
    match results {
        Some((kind, linear)) => (record.kind, record.linear) = (Some(kind), Some(linear)),
        // Finite on the host but beyond the kernel's scalar.
        None => record.status = Status::NonFinite,
    }
}
