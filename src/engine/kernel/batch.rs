//! The instances of a sweep as words of the linear kernel, and what it has made of them as their records.

use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::judged::begun;
use crate::engine::kernel::linear::{KERNEL, POLYNOMIALS};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{FLAG_STATUS, FLAG_STEPS};
use crate::engine::kernel::words::{INPUT_WORDS, STATE_WORDS, Words};
use crate::engine::record::Record;
use crate::model::kind::InstabilityType;
use crate::model::linear::prepare;
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
    match prepared {
        Ok(prepared) => (record, Some(Words::new(&prepared))),
        Err(kind) => {
            record.kind = kind;
            (record, None)
        }
    }
}

/// The word-major inputs of those instances that need the kernel.
#[must_use]
pub fn inputs<R: Real>(known: &[Known]) -> Vec<R> {
    let live: Vec<&Words> = known.iter().filter_map(|(_, words)| words.as_ref()).collect();
    let word = |word: usize| live.iter().map(move |one| R::from_f64(one.inputs[word]));
    let mut inputs = Vec::with_capacity(INPUT_WORDS * live.len());
    for k in 0..INPUT_WORDS {
        inputs.extend(word(k));
    }
    inputs
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
    let count = known.iter().filter(|(_, words)| words.is_some()).count();
    let mut next = 0;
    for (mut record, words) in known {
        if let Some(words) = words {
            let flag = |word: usize| flags[word * count + next];
            let done = flag(FLAG_STEPS);
            if cancelled && flag(FLAG_STATUS) == Status::Unwritten as u32 {
                records.push(Record::NOT_COMPUTED);
                next += 1;
                continue;
            }
            if done != POLYNOMIALS {
                let wanted = POLYNOMIALS as usize;
                return Err(Error::Miscounted { kernel: KERNEL.name, found: done as usize, wanted });
            }
            let state: [f64; STATE_WORDS] = std::array::from_fn(|k| all_state[k * count + next].to_f64());
            complete(&mut record, &words, state, flag(FLAG_STATUS), flag(FLAG_TYPE));
            next += 1;
        }
        records.push(record);
    }
    Ok(())
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
