//! Records of several starts as columns. Those of the small start come first, as in any sweep ([`crate::store::columns`]). A
//! byte for `bistable` follows, and then the results of the other starts: the columns of the large one, or the four counts
//! of a box (u32).
//!
//! A sweep of one start has its own columns and not a byte more.

use std::borrow::Cow;

use crate::engine::record::{Basin, Others, Record};
use crate::model::status::Status;
use crate::store::columns;
use crate::sweep::columns::shares;
use crate::sweep::spec::{Analysis, Starts};

/// Codes of `bistable`.
const CODES: [Option<bool>; 3] = [None, Some(false), Some(true)];

/// The analyses whose columns are kept of the small start and of the large one.
fn parts(analysis: Analysis) -> [Analysis; 2] {
    let small = Analysis { starts: Starts::One, ..analysis };
    [small, Analysis { linear: false, ..small }]
}

/// Bytes of the counts of a box.
fn counts() -> usize {
    4 * shares().count()
}

/// Bytes of one instance.
#[must_use]
pub fn width(analysis: Analysis) -> usize {
    let [small, large] = parts(analysis);
    columns::width(small)
        + match analysis.starts {
            Starts::One => 0,
            Starts::Both => 1 + columns::width(large),
            Starts::Box(_) => 1 + counts(),
        }
}

/// The columns of some records.
///
/// # Panics
/// When `bytes` are not `records.len() * width(analysis)`.
pub fn encode(records: Cow<[Record]>, analysis: Analysis, bytes: &mut [u8]) {
    let [small, large] = parts(analysis);
    let (own, others) = bytes.split_at_mut(records.len() * columns::width(small));
    if analysis.starts == Starts::One {
        match records {
            Cow::Borrowed(records) => columns::encode(records.iter(), small, own),
            Cow::Owned(records) => columns::encode(records.into_iter(), small, own),
        }
        return;
    }
    let records = records.as_ref();
    columns::encode(records.iter(), small, own);
    let (flags, others) = others.split_at_mut(records.len());
    for (flag, record) in flags.iter_mut().zip(records) {
        *flag = record.bistable.map_or(0, |bistable| 1 + u8::from(bistable));
    }
    if analysis.starts == Starts::Both {
        let of_large = |record: &Record| record.large().cloned().unwrap_or(Record::NOT_COMPUTED);
        columns::encode(records.iter().map(of_large), large, others);
    } else {
        for (bytes, record) in others.chunks_exact_mut(counts()).zip(records) {
            let mut basin = record.basin().unwrap_or_default();
            for (four, share) in bytes.chunks_exact_mut(4).zip(shares()) {
                four.copy_from_slice(&share(&mut basin).to_le_bytes());
            }
        }
    }
}

/// The records of columns; `None` when a code or the length is none that [`encode`] writes.
#[must_use]
pub fn decode(bytes: &[u8], count: usize, analysis: Analysis) -> Option<Vec<Record>> {
    if bytes.len() != count * width(analysis) {
        return None;
    }
    let [small, large] = parts(analysis);
    let (own, others) = bytes.split_at(count * columns::width(small));
    let mut records = columns::decode(own, count, small)?;
    if analysis.starts == Starts::One {
        return Some(records);
    }
    let (flags, others) = others.split_at(count);
    let others: Vec<Option<Others>> = if analysis.starts == Starts::Both {
        let computed =
            |record: Record| (record.status != Status::NotComputed).then(|| Others::Large(Box::new(record)));
        columns::decode(others, count, large)?.into_iter().map(computed).collect()
    } else {
        let counted = |basin: Basin| (basin.total() > 0).then_some(Others::Basin(basin));
        others.chunks_exact(counts()).map(|bytes| basin(bytes).map(counted)).collect::<Option<_>>()?
    };
    for ((record, flag), others) in records.iter_mut().zip(flags).zip(others) {
        record.bistable = *CODES.get(usize::from(*flag))?;
        record.others = others;
    }
    Some(records)
}

/// The counts of a box; `None` of counts that no box has, beyond their sum.
fn basin(bytes: &[u8]) -> Option<Basin> {
    let mut basin = Basin::default();
    let mut total = 0_u32;
    for (four, share) in bytes.chunks_exact(4).zip(shares()) {
        let count = four.try_into().map_or(0, u32::from_le_bytes);
        total = total.checked_add(count)?;
        *share(&mut basin) = count;
    }
    Some(basin)
}
