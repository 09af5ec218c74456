//! Instances with several starts: the engine runs over the same instances once per start, and their records are joined.
//! The starts of `kind = "box"` are drawn by a hash of the index of the instance and the number of the start alone.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::engine::computation::Stopped;
use crate::engine::computed::Computed;
use crate::engine::error::{Error, Result};
use crate::engine::record::{Basin, Others, Record, differ};
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::model::{Param, Params, linear};
use crate::sweep::draw::mixed;
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::{Analysis, Pass, Spec, Starts};

/// Seed of the starts that are drawn from a box.
const BOX_SEED: u64 = 0x5153_424f;

/// Computes a range of a sweep whose instances have one start each; gives the number of newly finished ones.
pub(crate) type Once<'a> = dyn FnMut(&Spec, Range<usize>, &(dyn Fn(usize) + Sync)) -> Result<Computed> + 'a;

/// The records of the instances `range` of a sweep of several starts, some `block` starts at a time: a run that is
/// stopped leaves the blocks that were done.
///
/// # Errors
/// Those of `once`; when it is stopped before any instance is done.
pub(crate) fn records(
    spec: &Spec,
    range: Range<usize>,
    block: usize,
    once: &mut Once,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let total = range.len();
    let analysis = Analysis { starts: Starts::One, ..spec.analysis };
    let own = Spec { analysis, ..spec.clone() };
    let large = Spec { analysis: Analysis { linear: false, ..analysis }, pass: Pass::Large, ..spec.clone() };
    let block = match spec.analysis.starts {
        Starts::One | Starts::Both => block,
        Starts::Box(samples) => block / samples as usize,
    };
    let mut records = Vec::with_capacity(total);
    for first in range.clone().step_by(block.max(1)) {
        let part = first..(first + block.max(1)).min(range.end);
        let (count, finished) = (spec.analysis.starts.count(), AtomicUsize::new(0));
        // An instance counts when it has come to its last start; until then the shares of all add up.
        let share = |newly: usize| {
            let before = finished.fetch_add(newly, Ordering::Relaxed);
            match (before + newly) / count - before / count {
                0 => {}
                whole => progress(whole),
            }
        };
        let mut computed = once(&own, part.clone(), &share);
        if let Ok(Computed { records, stopped: stopped @ None }) = &mut computed {
            let kinds = kinds(spec, part.clone(), records);
            let joined = match spec.analysis.starts {
                Starts::One => Ok(None),
                Starts::Both => with_large(records, &kinds, &large, part, once, &share),
                Starts::Box(samples) => with_box(records, &kinds, (&own, samples), part, once, &share),
            };
            match joined {
                Ok(ended) => *stopped = ended,
                Err(why) => computed = Err(why),
            }
        } else if let Ok(computed) = &mut computed {
            // Nothing of them is done: none has come to its other starts.
            computed.records.fill(Record::NOT_COMPUTED);
        }
        let Computed { records: done, stopped } = match computed {
            Ok(computed) => computed,
            Err(Error::Cancelled { .. }) => {
                let why = Error::Cancelled { done: records.len(), total };
                return Computed::new(records, total, Err(why));
            }
            Err(why) => return Computed::new(records, total, Err(why)),
        };
        records.extend(done);
        if let Some(stopped) = stopped {
            if records.iter().all(|record| record.status == Status::NotComputed) {
                return Err(stopped.error(0, total));
            }
            records.resize(total, Record::NOT_COMPUTED);
            return Ok(Computed { records, stopped: Some(stopped) });
        }
    }
    Ok(Computed { records, stopped: None })
}

/// The types of the equilibria of some instances.
fn kinds(spec: &Spec, range: Range<usize>, records: &[Record]) -> Vec<Option<InstabilityType>> {
    if spec.analysis.linear {
        records.iter().map(|record| record.kind).collect()
    } else {
        range.map(|index| linear::analyse(&spec.instance(index)).0).collect()
    }
}

/// Joins what the large start gives; an instance that was stopped before it, or before it was checked, is not done.
fn with_large(
    records: &mut [Record],
    kinds: &[Option<InstabilityType>],
    large: &Spec,
    range: Range<usize>,
    once: &mut Once,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Option<Stopped>> {
    let mut computed = once(large, range, progress)?;
    if computed.stopped.is_some() && large.analysis.checks() {
        computed.records.fill(Record::NOT_COMPUTED);
    }
    for ((record, from), kind) in records.iter_mut().zip(computed.records).zip(kinds) {
        if from.status == Status::NotComputed {
            *record = Record::NOT_COMPUTED;
        } else {
            record.bistable = differ(record, &from, *kind);
            record.others = Some(Others::Large(Box::new(from)));
        }
    }
    Ok(computed.stopped)
}

/// Joins what the starts of a box give, as a sweep of its own over instances and starts; an instance that was stopped
/// before the last of them is not done.
fn with_box(
    records: &mut [Record],
    kinds: &[Option<InstabilityType>],
    (own, samples): (&Spec, u32),
    range: Range<usize>,
    once: &mut Once,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Option<Stopped>> {
    let sweep = boxed(own, range, samples);
    let computed = once(&sweep, 0..sweep.grid.len(), progress)?;
    let of_instance = computed.records.chunks(samples as usize);
    for ((record, starts), kind) in records.iter_mut().zip(of_instance).zip(kinds) {
        if starts.iter().any(|one| one.status == Status::NotComputed) {
            *record = Record::NOT_COMPUTED;
            continue;
        }
        let mut basin = Basin::default();
        for one in starts {
            basin.add(one, *kind);
        }
        record.bistable = basin.is_bistable();
        record.others = Some(Others::Basin(basin));
    }
    Ok(computed.stopped)
}

/// The starts of some instances as instances of their own, which are judged by their regimes alone and not checked.
fn boxed(own: &Spec, range: Range<usize>, samples: u32) -> Spec {
    // The last two override a start that the sweep varies.
    let start = [Param::StartDisplacement, Param::StartVelocity].map(AxisKey::Param);
    let keys = own.grid.keys().into_iter().chain(start).collect();
    let mut rows = Vec::with_capacity(range.len() * samples as usize);
    for index in range {
        let values: Vec<Value> = own.grid.coordinates(index).into_iter().cloned().collect();
        let params = own.instance(index).params;
        for number in 0..samples {
            let start = drawn(&params, index, number).map(Value::Number);
            rows.push(values.iter().cloned().chain(start).collect());
        }
    }
    let analysis = Analysis { linear: false, checked: false, ..own.analysis };
    Spec { grid: Grid::Tuples { keys, rows: rows.into() }, analysis, ..own.clone() }
}

/// Start `number` from the box of instance `index`: displacement (m) and velocity (m/s), uniform between their bounds.
fn drawn(params: &Params, index: usize, number: u32) -> [f64; 2] {
    let bounds = [
        [Param::BoxDisplacementFrom, Param::BoxDisplacementTo],
        [Param::BoxVelocityFrom, Param::BoxVelocityTo],
    ];
    let of_instance = mixed(BOX_SEED, index as u64);
    std::array::from_fn(|side| {
        // The upper 53 bits: all that a number below 1 holds.
        let bits = mixed(of_instance, 2 * u64::from(number) + side as u64) >> 11;
        let fraction = bits as f64 / (1_u64 << 53) as f64;
        let [from, to] = bounds[side].map(|bound| params.require(bound));
        from + (to - from) * fraction
    })
}
