//! Records as columns of fixed width and back.
//!
//! Four columns of bytes (status, type, regime, flags), then columns of little-endian f64: five of the eigenvalue
//! analysis, 22 of the response, the settling time and the error that a check found, where asked for. An undefined number is a NaN. What no export shows, the values
//! of the two halves of the window, is not kept.

use std::borrow::Borrow;

use crate::engine::outcome::Outcome;
use crate::engine::record::{By, Check, Record};
use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::model::linear::Linear;
use crate::model::status::Status;
use crate::sweep::label::Label;
use crate::sweep::spec::Analysis;

/// Columns of bytes.
const LABELS: usize = 4;
/// Numbers of the eigenvalue analysis.
const LINEAR: usize = 5;
/// Numbers of the response.
const RESPONSE: usize = 22;

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
    LABELS + 8 * numbers_of(analysis)
}

fn numbers_of(analysis: Analysis) -> usize {
    LINEAR * usize::from(analysis.linear)
        + RESPONSE * usize::from(analysis.response)
        + usize::from(analysis.until_settled)
        + usize::from(analysis.checks())
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
    let (labels, numbers) = bytes.split_at_mut(LABELS * count);
    let place = |found: Option<usize>| code(found.map_or(0, |place| place + 1));
    // Row by row: a record is several cache lines, and each is read once, and given up where it is not needed any more.
    for (row, record) in records.enumerate() {
        let record = record.borrow();
        let label = Label::from(record);
        let codes = [
            code(record.status as usize),
            place(label.kind_position()),
            place(label.regime_position()),
            flags(record),
        ];
        for (column, code) in codes.into_iter().enumerate() {
            labels[column * count + row] = code;
        }
        let mut column = 0;
        let mut put = |number: Option<f64>| {
            let at = 8 * (column * count + row);
            numbers[at..at + 8].copy_from_slice(&number.unwrap_or(f64::NAN).to_le_bytes());
            column += 1;
        };
        if analysis.linear {
            let linear = record.linear.as_ref().map_or([None; LINEAR], linear_numbers);
            linear.into_iter().for_each(&mut put);
        }
        if analysis.response {
            let response = record.outcome.as_deref().map_or([None; RESPONSE], response_numbers);
            response.into_iter().for_each(&mut put);
        }
        if analysis.until_settled {
            put(record.outcome.as_ref().and_then(|outcome| outcome.settling_time));
        }
        if analysis.checks() {
            put(record.check.and_then(|check| check.error));
        }
    }
}

/// The records of columns; `None` when a code or the length is none that [`encode`] writes.
#[must_use]
pub fn decode(bytes: &[u8], count: usize, analysis: Analysis) -> Option<Vec<Record>> {
    if bytes.len() != count * width(analysis) {
        return None;
    }
    let (labels, numbers) = bytes.split_at(LABELS * count);
    let number = |column: usize, row: usize| {
        let at = 8 * (column * count + row);
        numbers.get(at..at + 8).and_then(|eight| eight.try_into().ok()).map_or(f64::NAN, f64::from_le_bytes)
    };
    let first_response = LINEAR * usize::from(analysis.linear);
    let settling_time = |row: usize| {
        if analysis.until_settled { defined(number(first_response + RESPONSE, row)) } else { None }
    };
    let last = numbers_of(analysis).saturating_sub(1);
    let error = |row: usize| if analysis.checks() { defined(number(last, row)) } else { None };
    let record = |row: usize| {
        let [status, kind, regime, flags] = std::array::from_fn(|k| labels[k * count + row]);
        let status = Status::IN_MAP.into_iter().find(|one| *one as u32 == u32::from(status))?;
        let has = |flag: u8| flags & flag != 0;
        let linear = has(HAS_LINEAR).then(|| linear_from(std::array::from_fn(|k| number(k, row))));
        let outcome = has(HAS_OUTCOME).then(|| {
            Box::new(Outcome {
                status,
                settling_time: settling_time(row),
                ..response_from(std::array::from_fn(|k| number(first_response + k, row)))
            })
        });
        Some(Record {
            status,
            kind: named(&InstabilityType::ALL, kind).ok()?,
            linear,
            regime: named(&Regime::ALL, regime).ok()?,
            settled: has(HAS_SETTLED).then(|| has(SETTLED)),
            outcome,
            check: check(flags, error(row)),
            bistable: None,
            others: None,
        })
    };
    (0..count).map(record).collect()
}

/// What a check found, from the flags and its error.
fn check(flags: u8, error: Option<f64>) -> Option<Check> {
    let has = |flag: u8| flags & flag != 0;
    let by = match (has(CHECKED_FINE), has(CHECKED_REFERENCE)) {
        (true, _) => By::Fine,
        (false, true) => By::Reference,
        (false, false) => return None,
    };
    Some(Check { by, taken: has(TAKEN), changed: has(CHANGED), error })
}

/// The entry of a list with this code, which is none for 0; an error when the list has no such code.
fn named<T: Copy>(all: &[T], code: u8) -> Result<Option<T>, u8> {
    match usize::from(code).checked_sub(1) {
        None => Ok(None),
        Some(place) => all.get(place).copied().map(Some).ok_or(code),
    }
}

/// A position or a status, which are few.
fn code(position: usize) -> u8 {
    u8::try_from(position).unwrap_or(u8::MAX)
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

fn linear_numbers(linear: &Linear) -> [Option<f64>; LINEAR] {
    let Linear { growth_rate, frequency, phase, growth_rate_flat, growth_rate_frozen } = *linear;
    [Some(growth_rate), Some(frequency), phase, Some(growth_rate_flat), Some(growth_rate_frozen)]
}

fn linear_from(numbers: [f64; LINEAR]) -> Linear {
    let [growth_rate, frequency, phase, growth_rate_flat, growth_rate_frozen] = numbers;
    Linear { growth_rate, frequency, phase: defined(phase), growth_rate_flat, growth_rate_frozen }
}

fn defined(number: f64) -> Option<f64> {
    Some(number).filter(|number| !number.is_nan())
}

/// The one list of the response's columns, read in both directions.
macro_rules! response {
    ($($field:ident)*) => {
        fn response_numbers(outcome: &Outcome) -> [Option<f64>; RESPONSE] {
            let impacts = outcome.energy_gaining_impacts.map(|impacts| impacts as f64);
            [$(outcome.$field,)* impacts, Some(outcome.simulated_time), Some(outcome.steps as f64)]
        }

        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts, written as f64")]
        fn response_from(numbers: [f64; RESPONSE]) -> Outcome {
            let mut next = numbers.into_iter();
            let mut number = || next.next().unwrap_or(f64::NAN);
            let mut outcome = Outcome::default();
            $(outcome.$field = defined(number());)*
            outcome.energy_gaining_impacts = defined(number()).map(|impacts| impacts as u64);
            outcome.simulated_time = number();
            outcome.steps = number() as u64;
            outcome
        }
    };
}

response! {
    x2_mean x2_std y1_mean y1_std ax_rms ay_rms ax_peak ay_peak friction_mean n_peak response_frequency
    phase_cycle growth_rate_measured frequency_measured phase_measured stick free reverse impacts_per_second
}
