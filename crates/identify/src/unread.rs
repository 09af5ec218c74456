//! Why a file of a recorder is not read.

/// What is wrong with a file that is no text, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unread {
    /// A kind of file that is known, but not read.
    #[error("this is {what}, which is not read; {remedy}")]
    Kind {
        /// What it is.
        what: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A file that is cut off, has wrong counts, or holds what is not read.
    #[error("this {format} file {why}; {remedy}")]
    Broken {
        /// Its format.
        format: &'static str,
        /// What is wrong with it.
        why: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A column that is asked for and not read.
    #[error("column `{column}` {why}")]
    Column {
        /// The column.
        column: String,
        /// What is wrong with it, and what to do.
        why: &'static str,
    },
    /// NaN or infinity.
    #[error(
        "sample {sample}: column `{column}` holds {value}, which is no finite number; cut the record before or after it"
    )]
    NotFinite {
        /// The sample, from 1.
        sample: u64,
        /// The column.
        column: String,
        /// What stands there.
        value: f64,
    },
    /// Two columns that do not belong together.
    #[error(
        "columns `{first}` and `{second}` have {} and {} samples, so they are not of one record; name columns that were recorded together, or export all at one rate",
        counts[0],
        counts[1]
    )]
    Lengths {
        /// One column.
        first: String,
        /// The other.
        second: String,
        /// How many samples they have.
        counts: [u64; 2],
    },
    /// Two columns that were recorded at different rates.
    #[error(
        "columns `{first}` and `{second}` have {} and {} samples per second; name columns that were recorded together, or export all at one rate",
        rates[0],
        rates[1]
    )]
    Rates {
        /// One column.
        first: String,
        /// The other.
        second: String,
        /// Their rates, Hz.
        rates: [f64; 2],
    },
    /// Two columns that were recorded at different times.
    #[error(
        "column `{second}` begins {later} s after column `{first}`; name columns that were recorded together, or export a record of the time that they share"
    )]
    Begins {
        /// One column.
        first: String,
        /// The other.
        second: String,
        /// How much later it begins, s.
        later: f64,
    },
    /// A rate that no sensor of vibrations has.
    #[error(
        "the file itself says {own} samples per second, which no sensor of vibrations has ({} to {} Hz); correct the rate in the file, or \
         export it as CSV",
        usual[0],
        usual[1]
    )]
    NoRate {
        /// The rate of the file, Hz.
        own: f64,
        /// The slowest and the fastest that are usual, Hz.
        usual: [f64; 2],
    },
    /// A rate that is not that of the file.
    #[error(
        "{what} {given} Hz but the file itself says {own} samples per second; leave out {flag}, or correct the rate in the file"
    )]
    OtherRate {
        /// What says otherwise, with its verb.
        what: String,
        /// Its rate, Hz.
        given: f64,
        /// The rate of the file, Hz.
        own: f64,
        /// The option.
        flag: &'static str,
    },
}
