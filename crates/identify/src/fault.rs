//! The faults of files of signals. A file with a fault is named and not analysed.

use crate::place::Place;
use crate::unread::Unread;
use squealmap_input::quote::rounded;

/// The slowest and the fastest rate of sensors of vibrations, Hz. What a column of time without a unit says beyond them is asked
/// about: squeal at 51.2 kHz with its time in milliseconds would be 51.2 Hz.
pub const RATES: [f64; 2] = [1e3, 1e6];

/// Why signals are not analysed: which column, where, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The file cannot be read.
    #[error("cannot be read: {why}; give a CSV file with a header, or a WAV, MAT, UFF 58 or TDMS file")]
    Unreadable {
        /// What the system says.
        why: String,
    },
    /// A file of a recorder that is not read.
    #[error(transparent)]
    Unread(#[from] Unread),
    /// A named column that is not there.
    #[error("there is no column `{name}` for {words}; the header has {header}; name one with {flag}")]
    NoColumn {
        /// The quantity.
        words: &'static str,
        /// The column looked for.
        name: String,
        /// What the header holds.
        header: String,
        /// The option that names it.
        flag: &'static str,
    },
    /// A column that is asked for and stands twice in the header.
    #[error(
        "column `{name}` for {words} stands {count} times in the header; give each column a name of its own, or name another with {flag}"
    )]
    Ambiguous {
        /// The quantity.
        words: &'static str,
        /// The column.
        name: String,
        /// How often it stands there.
        count: usize,
        /// The option that names it.
        flag: &'static str,
    },
    /// Two quantities from one column.
    #[error("column `{name}` is named for {first} and for {second}; name another with {flag}")]
    SharedColumn {
        /// The column.
        name: String,
        /// One quantity.
        first: &'static str,
        /// The other column.
        second: &'static str,
        /// The option of the second.
        flag: &'static str,
    },
    /// A row with another number of fields than the header.
    #[error(
        "line {line}: the row has {fields} field(s) but the header has {columns}; give one field per column{because}"
    )]
    Ragged {
        /// Line, from 1.
        line: u64,
        /// Its fields.
        fields: usize,
        /// The number of columns in the header.
        columns: usize,
        /// What it looks like, with a leading semicolon, or nothing.
        because: &'static str,
    },
    /// An empty field, NaN, infinity or text.
    #[error(
        "line {line}: column `{column}` holds `{text}`, which is no finite number; cut the record before or after it"
    )]
    NotANumber {
        /// Line, from 1.
        line: u64,
        /// The column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// A column of time without numbers.
    #[error(
        "line {line}: column `{column}` for time holds `{text}`, which is no finite number; name another column with --time, or give the rate with --rate"
    )]
    NotATime {
        /// Line, from 1.
        line: u64,
        /// The column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// Decimal points and decimal commas in one file, or commas between thousands.
    #[error(
        "line {line}: column `{column}` holds `{text}`, but of points and commas the file has both before decimals; write all numbers with a decimal point and without marks between thousands"
    )]
    TwoMarks {
        /// Line, from 1.
        line: u64,
        /// The column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// Time that stands still or runs backwards.
    #[error(
        "{place}: column `{column}` is {time} s after {previous} s but must rise; sort the rows, name another column with --time, or give --rate"
    )]
    NotRising {
        /// Where.
        place: Place,
        /// The column.
        column: String,
        /// The time, s.
        time: f64,
        /// The one before, s.
        previous: f64,
    },
    /// A normal force that is not positive, where a friction coefficient is wanted.
    #[error(
        "{place}: column `{column}` is {value} N, without contact there is no friction coefficient; leave such rows out"
    )]
    NoContact {
        /// Where.
        place: Place,
        /// The column.
        column: String,
        /// Its value, N.
        value: f64,
    },
    /// Missing samples.
    #[error(
        "{place}: a gap of {missing} sample(s) in column `{column}` before {time} s; cut the record there and give one part"
    )]
    Gap {
        /// Where.
        place: Place,
        /// The column of time.
        column: String,
        /// Samples that are missing.
        missing: u64,
        /// The time after the gap, s.
        time: f64,
    },
    /// Samples that are not evenly spaced.
    #[error(
        "{place}: column `{column}` steps by {} s where {} s is usual; where only the times are rounded or doubled, give --rate, and else evenly spaced samples",
        rounded(*step), rounded(*usual)
    )]
    Uneven {
        /// Where.
        place: Place,
        /// The column of time.
        column: String,
        /// The step, s.
        step: f64,
        /// The usual step, s.
        usual: f64,
    },
    /// A rate that is no rate.
    #[error("the sampling rate is {rate} Hz but must be a finite number greater than 0; set --rate")]
    NoRate {
        /// The rate.
        rate: f64,
    },
    /// A rate that is not that of the column of time.
    #[error(
        "--rate is {given} Hz but column `{column}` holds {found:.6} samples per second{because}; leave out --rate, say the unit of the column with --time-unit, or give it another name in the header if it is no time"
    )]
    Contradicted {
        /// The rate given, Hz.
        given: f64,
        /// The column of time.
        column: String,
        /// The rate by it, Hz.
        found: f64,
        /// The unit of time that would make both one, with a leading semicolon, or nothing.
        because: String,
    },
    /// A column of time without a unit that has a rate of no sensor.
    #[error(
        "column `{column}` holds {rate} samples per second if it is in seconds, but sensors of vibrations have {} to {}; say its unit with {units}, or with --time-unit s if they are so many, or give the rate with --rate",
        RATES[0],
        RATES[1]
    )]
    DoubtfulTime {
        /// The column of time.
        column: String,
        /// The rate in seconds, Hz.
        rate: f64,
        /// Options that say a unit with which the rate is usual.
        units: String,
    },
    /// A delay between channels that no recorder has.
    #[error(
        "{flag} is {delay} s but must be at most one period of the oscillation at {frequency:.1} Hz, {period:.3e} s; give the delay in seconds, or shift the channels by whole samples before"
    )]
    TooLate {
        /// The option.
        flag: &'static str,
        /// The delay, s.
        delay: f64,
        /// The strongest oscillation, Hz.
        frequency: f64,
        /// Its period, s.
        period: f64,
    },
    /// Too few samples.
    #[error("the record has {samples} sample(s) but at least {least} are needed{because}; record longer")]
    TooShort {
        /// Its samples.
        samples: u64,
        /// The least.
        least: u64,
        /// For what, with a leading comma, or nothing.
        because: String,
    },
    /// A channel that does not move.
    #[error(
        "column `{column}` ({words}) is constant at {value}; check the sensor, or name another column with {flag}"
    )]
    Constant {
        /// The column.
        column: String,
        /// The quantity.
        words: &'static str,
        /// Its value.
        value: f64,
        /// The option that names it.
        flag: &'static str,
    },
    /// A channel cut off at its end of range.
    #[error(
        "column `{column}` ({words}) is clipped at {value} ({runs} times, first at {time} s); record with a larger range, or cut the record before"
    )]
    Clipped {
        /// The column.
        column: String,
        /// The quantity.
        words: &'static str,
        /// Where it is cut off.
        value: f64,
        /// How often.
        runs: u64,
        /// When first, s from the start of the record.
        time: f64,
    },
    /// Values that no vibration has.
    #[error(
        "column `{column}` ({words}) holds {count} value(s) far outside all around them (first {value} at {time} s), as a dropout or a logger's mark for a missing value; cut the record before or after them, or replace them by the mean of their neighbours"
    )]
    Outliers {
        /// The column.
        column: String,
        /// The quantity.
        words: &'static str,
        /// The first of them.
        value: f64,
        /// How many samples.
        count: u64,
        /// When first, s.
        time: f64,
    },
    /// Strokes in both directions.
    #[error(
        "column `{column}` (the sliding velocity) goes in both directions, {forward:.0} % of its way forward and {back:.0} % back; \
         `squealmap campaign` parts such a record into its strokes, or cut it where it turns"
    )]
    BothDirections {
        /// The column.
        column: String,
        /// Part of the way that goes forward, per cent.
        forward: f64,
        /// Part that goes back.
        back: f64,
    },
    /// A friction coefficient that no brake has.
    #[error(
        "T/N of columns `{tangential}` and `{normal}` is {friction:.3}, above {largest}: they look swapped; exchange --tangential-force and --normal-force, or allow it with --largest-friction"
    )]
    SwappedForces {
        /// The column of the tangential force.
        tangential: String,
        /// The column of the normal force.
        normal: String,
        /// Their ratio.
        friction: f64,
        /// The largest one believed.
        largest: f64,
    },
    /// A normal force that does not press.
    #[error(
        "column `{column}` (the normal force) has mean {mean:.4} and standard deviation {deviation:.4}: it presses on nothing, so it looks swapped or of the wrong sign; name another with --normal-force"
    )]
    NotPressing {
        /// The column.
        column: String,
        /// Its mean, N.
        mean: f64,
        /// Its standard deviation, N.
        deviation: f64,
    },
    /// A friction force against the motion.
    #[error(
        "T/N of columns `{tangential}` and `{normal}` along the sliding velocity is {friction:.3}: friction would drive the sliding; change the \
         sign of the tangential force, or of the velocity"
    )]
    NegativeFriction {
        /// The column of the tangential force.
        tangential: String,
        /// The column of the normal force.
        normal: String,
        /// Their ratio.
        friction: f64,
    },
    /// An acceleration that looks like a force.
    #[error(
        "column `{column}` ({words}) has mean {mean:.4} and standard deviation {deviation:.4}: that is a force or an offset, no vibration; name another column with {flag} or subtract its mean"
    )]
    Offset {
        /// The column.
        column: String,
        /// The quantity.
        words: &'static str,
        /// Its mean.
        mean: f64,
        /// Its standard deviation.
        deviation: f64,
        /// The option that names it.
        flag: &'static str,
    },
    /// Accelerations that contradict the forces unless they are swapped.
    #[error(
        "at {time:.6} s the friction force feeds the motion of column `{normal}` but not that of `{tangential}`: they look swapped, or one of them has the wrong sign, or they are skewed; exchange --tangential-acceleration and --normal-acceleration, turn the sign of one, or set --skew"
    )]
    SwappedAccelerations {
        /// The column of the tangential acceleration.
        tangential: String,
        /// The column of the normal acceleration.
        normal: String,
        /// When, s.
        time: f64,
    },
    /// An oscillation too fast for the sampling.
    #[error(
        "the oscillation at {frequency:.1} Hz has {samples:.2} samples per period but needs at least {least}; sample faster or look below it with --band"
    )]
    TooFast {
        /// Its frequency, Hz.
        frequency: f64,
        /// Samples per period.
        samples: f64,
        /// The least.
        least: f64,
    },
    /// Forces that are to be restored from what is not recorded.
    #[error(
        "--model takes the forces of the vibration from both accelerations and the mean forces and the velocity from their sensors, but \
         {words} is not recorded; name it with {flag}, or leave out --model"
    )]
    NotRestored {
        /// The quantity.
        words: &'static str,
        /// The option that names it.
        flag: &'static str,
    },
    /// Forces that are to be restored from too few samples.
    #[error(
        "the oscillation at {frequency:.1} Hz has {samples:.1} samples per period, but --model takes {least} to restore its forces; sample \
         faster, or leave out --model"
    )]
    TooFewToRestore {
        /// Its frequency, Hz.
        frequency: f64,
        /// Samples per period.
        samples: f64,
        /// The least.
        least: f64,
    },
}

/// A file of signals that is not fit for analysis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name}: {fault}")]
pub struct Unfit {
    /// The file as the user wrote it.
    pub name: String,
    /// Which column, where, and what to do.
    pub fault: Box<Fault>,
}
