//! Records as columns of fixed width and back.
//!
//! Four columns of bytes (status, type, regime, flags), then one of little-endian f64 for every number that the table of
//! columns ([`crate::sweep::columns`]) has of the analysis. An undefined number is a NaN. What no export shows, the values
//! of the two halves of the window, is not kept.

use std::borrow::Borrow;

use crate::engine::outcome::Outcome;
use crate::engine::record::{By, Check, Record};
use crate::model::linear::Linear;
use crate::sweep::columns::{Class, Place, REGIME, STATUS, TYPE, numbers};
use crate::sweep::spec::Analysis;

/// The classes whose codes stand in a byte each.
const CLASSES: [&Class; 3] = [&STATUS, &TYPE, &REGIME];
/// Columns of bytes: the classes, and the flags.
const LABELS: usize = CLASSES.len() + 1;

/// Bits of the flags.
const HAS_LINEAR: u8 = 1;
const HAS_OUTCOME: u8 = 2;
const HAS_SETTLED: u8 = 4;
const SETTLED: u8 = 8;
const CHECKED_FINE: u8 = 16;
const CHECKED_REFERENCE: u8 = 32;
const TAKEN: u8 = 64;
const CHANGED: u8 = 128;

/// Bytes of one instance.
#[must_use]
pub fn width(analysis: Analysis) -> usize {
    LABELS + 8 * numbers(analysis).count()
}

/// The columns of some records.
///
/// # Panics
/// When `bytes` are not `records.len() * width(analysis)`.
pub fn encode<R: Borrow<Record>>(
    records: impl ExactSizeIterator<Item = R>,
    analysis: Analysis,
    bytes: &mut [u8],
) {
    let count = records.len();
    assert_eq!(bytes.len(), count * width(analysis), "columns have their length");
    let (labels, bytes) = bytes.split_at_mut(LABELS * count);
    let numbers: Vec<Place> = numbers(analysis).collect();
    // Row by row: a record is several cache lines, and each is read once, and given up where it is not needed any more.
    for (row, record) in records.enumerate() {
        let record = record.borrow();
        for (column, class) in CLASSES.into_iter().enumerate() {
            labels[column * count + row] = class.code(record).to_le_bytes()[0];
        }
        labels[CLASSES.len() * count + row] = flags(record);
        for (column, place) in numbers.iter().enumerate() {
            let at = 8 * (column * count + row);
            bytes[at..at + 8].copy_from_slice(&(place.get)(record).unwrap_or(f64::NAN).to_le_bytes());
        }
    }
}

/// The records of columns; `None` when a code or the length is none that [`encode`] writes.
#[must_use]
pub fn decode(bytes: &[u8], count: usize, analysis: Analysis) -> Option<Vec<Record>> {
    if bytes.len() != count * width(analysis) {
        return None;
    }
    let (labels, bytes) = bytes.split_at(LABELS * count);
    let number = |column: usize, row: usize| {
        let at = 8 * (column * count + row);
        bytes.get(at..at + 8).and_then(|eight| eight.try_into().ok()).map_or(f64::NAN, f64::from_le_bytes)
    };
    let numbers: Vec<Place> = numbers(analysis).collect();
    let record = |row: usize| {
        let flags = labels[CLASSES.len() * count + row];
        let has = |flag: u8| flags & flag != 0;
        let mut record = Record {
            linear: has(HAS_LINEAR).then(Linear::default),
            settled: has(HAS_SETTLED).then(|| has(SETTLED)),
            outcome: has(HAS_OUTCOME).then(Box::<Outcome>::default),
            check: check(flags),
            ..Record::default()
        };
        for (column, class) in CLASSES.into_iter().enumerate() {
            class.put_code(&mut record, i8::from_le_bytes([labels[column * count + row]]))?;
        }
        if let Some(outcome) = &mut record.outcome {
            outcome.status = record.status;
        }
        for (column, place) in numbers.iter().enumerate() {
            (place.put)(&mut record, number(column, row));
        }
        Some(record)
    };
    (0..count).map(record).collect()
}

/// What a check found, from the flags; its error stands among the numbers.
fn check(flags: u8) -> Option<Check> {
    let has = |flag: u8| flags & flag != 0;
    let by = match (has(CHECKED_FINE), has(CHECKED_REFERENCE)) {
        (true, _) => By::Fine,
        (false, true) => By::Reference,
        (false, false) => return None,
    };
    Some(Check { by, taken: has(TAKEN), changed: has(CHANGED), error: None })
}

fn flags(record: &Record) -> u8 {
    let flag = |set: bool, bit: u8| if set { bit } else { 0 };
    flag(record.linear.is_some(), HAS_LINEAR)
        | flag(record.outcome.is_some(), HAS_OUTCOME)
        | flag(record.settled.is_some(), HAS_SETTLED)
        | flag(record.settled == Some(true), SETTLED)
        | record.check.map_or(0, |check| {
            flag(check.by == By::Fine, CHECKED_FINE)
                | flag(check.by == By::Reference, CHECKED_REFERENCE)
                | flag(check.taken, TAKEN)
                | flag(check.changed, CHANGED)
        })
}
