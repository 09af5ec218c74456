//! Why a sweep is refused, or does not come to its end.

use squealmap_input::place::Place;
use squealmap_input::quote::{SAID, clipped, one_line, quoted};
use std::path::PathBuf;

/// Why a sweep is refused, or does not come to its end. Every message is one sentence: where, the key, the value, the limit, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The sweep file cannot be read.
    #[error("cannot read the sweep file `{}`: {why}", path.display())]
    ReadSweep {
        /// The sweep file.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A file that the sweep file names cannot be read.
    #[error("{at}: cannot read the {role} file `{}`: {why}", one_line(&path.display().to_string()))]
    ReadNamed {
        /// Where it is named.
        at: Place,
        /// What it is for: `material`, `table`, `modes` or `points`.
        role: &'static str,
        /// The path that was tried.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A modal model where two masses are needed.
    #[error(
        "{what} needs two masses, but the model is the modes of {}: a modal model has eigenvalues alone, which `run` maps",
        one_line(modes)
    )]
    OnlyTwoMasses {
        /// What needs them.
        what: &'static str,
        /// The file of modes.
        modes: String,
    },
    /// A text is not what its format wants (TOML, or rows of fields).
    #[error("{at}: {}", clipped(why, SAID))]
    Syntax {
        /// Where.
        at: Place,
        /// What the parser says.
        why: String,
    },
    /// A key, column or name that does not exist here.
    #[error("{at}: unknown {what} `{}` {within}; {advice}", quoted(name))]
    Unknown {
        /// Where.
        at: Place,
        /// What kind of name it is: key, column, law, …
        what: &'static str,
        /// The name as written.
        name: String,
        /// In which section, header or argument.
        within: String,
        /// The nearest name, or all of them.
        advice: String,
    },
    /// A value of the wrong type.
    #[error("{at}: {key} must be {expected}, found {found}")]
    WrongType {
        /// Where.
        at: Place,
        /// The key and its section, axis or column.
        key: String,
        /// What is wanted.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A value outside its limits.
    #[error("{at}: {key} is {value} but must be {limit}")]
    OutOfRange {
        /// Where.
        at: Place,
        /// The key and its section, axis or column.
        key: String,
        /// The value as written.
        value: String,
        /// The legal values.
        limit: String,
    },
    /// A value that something needs is not given.
    #[error("{at}: `{key}` is missing: {needed_by}, so {remedy}")]
    Missing {
        /// Where it could stand, or what asks for it.
        at: Place,
        /// The key.
        key: &'static str,
        /// What needs it.
        needed_by: String,
        /// What to write.
        remedy: String,
    },
    /// Two keys that exclude each other.
    #[error("{at}: {key} stands beside {other}; remove one of them")]
    Conflict {
        /// Where the first stands.
        at: Place,
        /// The key and where it stands.
        key: String,
        /// The other one and where it stands.
        other: String,
    },
    /// A key that nothing chosen in the sweep uses.
    #[error("{at}: {key} would have no effect: it is used only by {used_by}; remove it or choose that")]
    Unused {
        /// Where.
        at: Place,
        /// The key and where it stands.
        key: String,
        /// What would use it.
        used_by: String,
    },
    /// An axis, list or file without a single value.
    #[error("{at}: {what} is empty; give at least {least}")]
    Empty {
        /// Where.
        at: Place,
        /// The axis, list or file.
        what: String,
        /// The least that is wanted.
        least: &'static str,
    },
    /// A file with a header and nothing below it.
    #[error("{at}: the file has a header but no rows; give at least one row")]
    NoRows {
        /// The header.
        at: Place,
    },
    /// Ends and number of points of an axis that do not go together.
    #[error("{at}: axis `{axis}` has {points} point(s) from {from} to {to}; {remedy}")]
    AxisEnds {
        /// Where.
        at: Place,
        /// The axis.
        axis: &'static str,
        /// The number of points.
        points: usize,
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// What to write.
        remedy: &'static str,
    },
    /// More instances than a sweep may hold.
    #[error("{at}: the sweep has {count} instances but at most {limit} are allowed; take fewer points")]
    TooMany {
        /// Where.
        at: Place,
        /// The product of the axes, as far as it can be computed.
        count: String,
        /// The limit.
        limit: usize,
    },
    /// An accuracy beside what it chooses.
    #[error("{option} stands beside --accuracy {accuracy}, which chooses it; remove one of them")]
    AccuracyBeside {
        /// The option as written.
        option: String,
        /// The accuracy.
        accuracy: String,
    },
    /// A map that is refined keeps a label per instance.
    #[error(
        "the sweep has {instances} instances but at most {limit} can be refined; make its axes shorter, or refine parts \
         of it"
    )]
    TooManyToRefine {
        /// Instances of the sweep.
        instances: usize,
        /// The limit.
        limit: usize,
    },
    /// No plane whose lines could be followed.
    #[error(
        "refining follows the lines of a map over two numeric axes, but the sweep has no two numeric axes with at least \
         3 values each; add some under `[axes]`, or compute the whole grid by `squealmap run`, without [refine]"
    )]
    NothingToRefine,
    /// Values of a sweep that memory has no room for.
    #[error(
        "the memory has no room for the values of {instances} instances; compute them into a directory of tiles, as \
         `squealmap run` does"
    )]
    NoRoomInMemory {
        /// Instances.
        instances: usize,
    },
    /// More instances than the records of a sweep in memory may have.
    #[error(
        "the sweep has {instances} instances but at most {limit} fit the memory; compute it into a directory of \
         tiles, as `squealmap run` does"
    )]
    TooManyInMemory {
        /// The instances.
        instances: usize,
        /// The limit.
        limit: usize,
    },
    /// A row with another number of fields than the header.
    #[error(
        "{at}: the row has {fields} field(s) but the header has {columns}; give one field per column{because}"
    )]
    RaggedRow {
        /// Where.
        at: Place,
        /// Fields of the row.
        fields: usize,
        /// Columns of the header.
        columns: usize,
        /// What may be the reason, as the end of the sentence.
        because: &'static str,
    },
    /// A column that has to rise strictly does not.
    #[error("{at}: `{column}` is {value} after {previous} but must rise from row to row; sort the rows")]
    NotRising {
        /// Where.
        at: Place,
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
        /// The value of the row before.
        previous: f64,
    },
    /// A temperature outside the rows of a material that is not clamped.
    #[error(
        "{at}: `{key}` is {value} but material `{}` covers {low} to {high} °C; \
         stay inside or set outside = \"clamp\" in [friction]",
        quoted(material)
    )]
    OutsideMaterial {
        /// Where the temperature is given.
        at: Place,
        /// What gives it.
        key: &'static str,
        /// The temperature, °C.
        value: f64,
        /// The material file as written.
        material: String,
        /// Its lowest temperature, °C.
        low: f64,
        /// Its highest temperature, °C.
        high: f64,
    },
    /// A part of an `--at` argument that is not `name=value`, or names something twice.
    #[error("{at}: `{}` {problem}; write name=value pairs such as mu_s=0.4,belt_velocity=3", quoted(part))]
    AtSyntax {
        /// The argument.
        at: Place,
        /// The part.
        part: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// No instance of a sweep has this number.
    #[error("--instance {number}: the sweep has {instances} instances, numbered from 0 to {}", instances - 1)]
    NoInstance {
        /// What was asked for.
        number: usize,
        /// How many there are, at least one.
        instances: usize,
    },
    /// Swept parameters that an `--at` argument leaves open.
    #[error("{at}: no value for {names}, which the sweep varies; add {example}")]
    AtMissing {
        /// The argument.
        at: Place,
        /// The parameters without a value.
        names: String,
        /// What could be added.
        example: String,
    },
    /// A sweep on which no accuracy can be measured.
    #[error("accuracy is measured on settled oscillations, but {what}")]
    NothingToJudge {
        /// What is missing, and what to do.
        what: &'static str,
    },
    /// An accuracy that nothing measured keeps.
    #[error(
        "no configuration that was measured on {kinds} keeps a relative error of {bound:e}: the best keeps {least:.1e}; \
         ask for less, for --accuracy reference, or measure this sweep with `squealmap tradeoff`"
    )]
    Inaccurate {
        /// The relative error that was asked for.
        bound: f64,
        /// The kinds of scenes.
        kinds: String,
        /// What the best of them keeps.
        least: f64,
    },
    /// An accuracy from what nobody has measured.
    #[error(
        "--accuracy chooses an engine and its steps from measurements, and there are none of the engine asked for on scenes such \
         as {kinds}; measure them with `squealmap tradeoff SWEEP` on this machine, or leave out --backend, --strict, --adapter and \
         --require-gpu, so that it may choose another engine"
    )]
    Unmeasured {
        /// The kinds of scenes.
        kinds: String,
    },
    /// A table could not be written.
    #[error("the table could not be written")]
    WriteTable(#[source] csv::Error),
    /// The worker threads cannot be started.
    #[error(
        "cannot start {threads} worker thread(s): {why}; take fewer with --threads, or raise the limits on threads and \
         memory (`ulimit -u`, `ulimit -v`)"
    )]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system says.
        why: String,
    },
    /// What the floor below says.
    #[error(transparent)]
    OfEngine(#[from] crate::engine::error::Error),
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Error::ReadNamed { at, .. }
            | Error::Syntax { at, .. }
            | Error::Unknown { at, .. }
            | Error::WrongType { at, .. }
            | Error::OutOfRange { at, .. }
            | Error::Missing { at, .. }
            | Error::Conflict { at, .. }
            | Error::Unused { at, .. }
            | Error::Empty { at, .. }
            | Error::NoRows { at }
            | Error::AxisEnds { at, .. }
            | Error::TooMany { at, .. }
            | Error::RaggedRow { at, .. }
            | Error::NotRising { at, .. }
            | Error::OutsideMaterial { at, .. }
            | Error::AtSyntax { at, .. }
            | Error::AtMissing { at, .. } => Some(at),
            _ => None,
        }
    }

    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::OfEngine(why) if why.is_cancelled())
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::ReadSweep { .. }
            | Error::AccuracyBeside { .. }
            | Error::TooManyToRefine { .. }
            | Error::NothingToRefine
            | Error::NoInstance { .. }
            | Error::OnlyTwoMasses { .. }
            | Error::NothingToJudge { .. }
            | Error::Inaccurate { .. }
            | Error::Unmeasured { .. } => true,
            Error::OfEngine(why) => why.is_bad_input(),
            _ => self.place().is_some(),
        }
    }
}

/// The result of this floor.
pub type Result<T> = std::result::Result<T, Error>;
