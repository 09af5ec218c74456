//! The one error type. Every message is one sentence: where, the key, the value, the limit, what to do.

use std::path::PathBuf;

use crate::fit::FitFault;
use crate::identify::Fault;
pub use crate::place::Place;
use crate::quote::{clipped, one_line, quoted};
use crate::store::tile::Fault as TileFault;

/// The most characters of what a parser says, which may quote the input.
pub const SAID: usize = 300;

/// The most characters of what is wrong with a file of signals; the names in its header are many.
const FAULT: usize = 1200;

/// Why a run failed. Instances that fail are data (see [`crate::outcome::Status`]), not errors.
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
    /// A description of bodies in contact, or its model, cannot be computed.
    #[error("`{}`: {}", one_line(&path.display().to_string()), clipped(why, SAID))]
    Fem {
        /// The description.
        path: PathBuf,
        /// What is wrong, as a sentence.
        why: String,
    },
    /// A file that the sweep file names cannot be read.
    #[error("{at}: cannot read the {role} file `{}`: {why}", one_line(&path.display().to_string()))]
    ReadNamed {
        /// Where it is named.
        at: Place,
        /// What it is for: `material`, `table` or `points`.
        role: &'static str,
        /// The path that was tried.
        path: PathBuf,
        /// What the system says.
        why: String,
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
    /// Results of two sweeps would go to one place.
    #[error(
        "two of the sweep files are named `{name}`, so that their results would stand in one directory; rename one, or \
         measure them by two commands"
    )]
    SameName {
        /// The name, without its ending.
        name: String,
    },
    /// No plane whose lines could be followed.
    #[error(
        "refining follows the lines of a map over two numeric axes, but the sweep has no two numeric axes with at least \
         3 values each; add some under `[axes]`, or compute the whole grid by `squealmap run`, without [refine]"
    )]
    NothingToRefine,
    /// An option that a refined sweep does not have.
    #[error(
        "{option} cannot be used for a sweep with [refine], which one process computes level by level; leave it out, or \
         remove [refine] to compute the whole grid"
    )]
    RefineBeside {
        /// The option.
        option: &'static str,
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
        "{at}: `temperature` is {value} but material `{}` covers {low} to {high} °C; \
         stay inside or set outside = \"clamp\" in [friction]",
        quoted(material)
    )]
    OutsideMaterial {
        /// Where the temperature is given.
        at: Place,
        /// The temperature, °C.
        value: f64,
        /// The material file as written.
        material: String,
        /// Its lowest temperature, °C.
        low: f64,
        /// Its highest temperature, °C.
        high: f64,
    },
    /// A motion that is to be followed in steps while its belt moves by a ramp.
    #[error(
        "`--sweep-up-down` holds the belt at every value, but this instance has a ramp, `ramp_duration` = {duration} s; \
         take the ramp out of [belt]"
    )]
    FollowsRamp {
        /// Its duration, s.
        duration: f64,
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
    /// An output directory that cannot be created or written.
    #[error("cannot write to the output directory `{}`: {why}; choose another one", path.display())]
    OutputDirectory {
        /// The directory.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A directory without tiles.
    #[error("`{}` holds no tiles; name the output directory of a `squealmap run` of a whole grid", path.display())]
    NoTiles {
        /// The directory.
        path: PathBuf,
    },
    /// A description of tiles that is none.
    #[error(
        "cannot read `{}`: {}; run its sweep file once more: the description is written anew, and good tiles stay",
        path.display(),
        clipped(why, SAID)
    )]
    BadDescription {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// A map with holes under the name of the whole one.
    #[error(
        "`{}` is where the whole map belongs, and tiles are missing; name another file with --output, or leave it out",
        path.display()
    )]
    PartialAsWhole {
        /// The file.
        path: PathBuf,
    },
    /// A table of measured accuracies that is none.
    #[error(
        "cannot read `{}`: {}; mend it, or remove it and measure again with `squealmap tradeoff`",
        path.display(),
        clipped(why, SAID)
    )]
    BadFrontier {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// A directory with tiles of another sweep.
    #[error(
        "`{}` holds the results of another sweep, program version or engine: {there}; choose another directory with -o, \
         or replace them with --force",
        path.display()
    )]
    OtherSweep {
        /// The directory.
        path: PathBuf,
        /// What is there.
        there: String,
    },
    /// A file that `init` would write, and does not.
    #[error("`{}` is there already; name another one with -o", path.display())]
    FileThere {
        /// The file.
        path: PathBuf,
    },
    /// No instance of a sweep has this number.
    #[error("--instance {number}: the sweep has {instances} instances, numbered from 0 to {}", instances - 1)]
    NoInstance {
        /// What was asked for.
        number: usize,
        /// How many there are, at least one.
        instances: usize,
    },
    /// A directory with what was made from another input file.
    #[error(
        "`{}` holds `{name}` made from `{}`; choose another directory with -o, or replace it with --force",
        path.display(),
        from.display()
    )]
    OtherInput {
        /// The directory.
        path: PathBuf,
        /// The file that would be replaced.
        name: &'static str,
        /// The other input file.
        from: PathBuf,
    },
    /// A directory that cannot be put right by this program.
    #[error(
        "`{}` was computed by another version of the program or an engine that is not at hand; run its sweep file with \
         that one, or into another directory with -o",
        path.display()
    )]
    OtherVersion {
        /// The directory.
        path: PathBuf,
    },
    /// A whole tile in a directory whose description does not name it.
    #[error(
        "`{}` is a good tile of another sweep, program version or engine; nothing was changed: choose another directory \
         with -o, or move it away",
        path.display()
    )]
    StrangeTile {
        /// The tile.
        path: PathBuf,
    },
    /// A description of tiles in a format that this version does not know.
    #[error(
        "cannot read `{}`: its format is {found}, which this version of the program does not know; nothing was changed: \
         use the version that wrote it, or choose another directory with -o",
        path.display()
    )]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
    },
    /// A refined directory that does not say what it was refined from.
    #[error(
        "`{}` does not hold what it was refined from: `refine.json` does not say it, nor one file alone in `parts`; run \
         `squealmap refine SWEEP.toml -o {}` again with its sweep file and options: good parts of this version are not \
         computed again",
        path.display(),
        path.display()
    )]
    NoRefinement {
        /// The directory.
        path: PathBuf,
    },
    /// Whole tiles of a sweep under other names than this run gives them.
    #[error(
        "`{}` is a good tile of this sweep, cut into tiles of another size; nothing was changed: give the same `--tile` as \
         the run before, or choose another directory with -o",
        path.display()
    )]
    OtherCut {
        /// The tile.
        path: PathBuf,
    },
    /// A part of a refined map that cannot be written.
    #[error(
        "cannot write `{}`: {why}; what was computed before it stays; run the same command again when this is put right",
        path.display()
    )]
    WritePart {
        /// The part.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A file of an output directory that this process cannot read, and that may be good.
    #[error(
        "cannot read `{}`: {why}; it may be good and is left as it is; let this user read it, or raise the limits on memory \
         and open files, and run the same command again",
        path.display()
    )]
    Denied {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A tile that is not what it should be.
    #[error("`{}` is bad: {fault}; run the sweep again", path.display())]
    BadTile {
        /// The tile.
        path: PathBuf,
        /// What is wrong with it.
        fault: TileFault,
    },
    /// An export of a sweep that is not complete.
    #[error(
        "`{}` holds {done} of {total} tiles; run the sweep to its end, or add --partial for what is there",
        path.display()
    )]
    TilesMissing {
        /// The directory.
        path: PathBuf,
        /// Its tiles.
        done: usize,
        /// All tiles.
        total: usize,
    },
    /// Directories of different sweeps that are to become one.
    #[error(
        "`{}` and `{}` hold tiles of different sweeps, program versions or engines; merge those of one",
        target.display(),
        source_dir.display()
    )]
    OtherMerge {
        /// The directory that was to get the tiles.
        target: PathBuf,
        /// The other one.
        source_dir: PathBuf,
    },
    /// A directory of which nothing can be reused.
    #[error("--reuse `{}`: {why}, or remove --reuse", path.display())]
    OtherReuse {
        /// The directory.
        path: PathBuf,
        /// What is in the way, and what to do.
        why: &'static str,
    },
    /// A disk without room for a sweep.
    #[error(
        "the sweep needs about {needed} in `{}`, 64 MB of it to leave free, where {free} are free; free some, choose another directory with -o, \
         or take fewer points",
        path.display()
    )]
    NoSpace {
        /// The directory.
        path: PathBuf,
        /// What is needed.
        needed: String,
        /// What is free.
        free: String,
    },
    /// A tile that cannot be written.
    #[error(
        "cannot write `{}`: {why}; {done} of {total} tiles are done and stay; run the same command again when this \
         is put right",
        path.display()
    )]
    WriteTile {
        /// The tile.
        path: PathBuf,
        /// What the system says.
        why: String,
        /// Tiles that are done.
        done: usize,
        /// All tiles.
        total: usize,
    },
    /// An output file that cannot be written.
    #[error("cannot write `{}`: {why}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A map holds fewer or more records than its grid has instances.
    #[error("the map holds {records} records for {instances} instances; nothing was exported")]
    Incomplete {
        /// Records in the map.
        records: usize,
        /// Instances of the grid.
        instances: usize,
    },
    /// A map holds an instance that was never computed, without a reason.
    #[error("instance {instance} was never computed; nothing was exported")]
    Unwritten {
        /// The first such instance.
        instance: usize,
    },
    /// A table could not be written.
    #[error("the table could not be written")]
    WriteTable(#[source] csv::Error),
    /// The same as Parquet.
    #[error("the Parquet file could not be written")]
    WriteParquet(#[source] parquet::errors::ParquetError),
    /// The manifest could not be written.
    #[error("the manifest could not be written")]
    WriteManifest(#[source] serde_json::Error),
    /// A figure is not a picture that can be drawn.
    #[error("the figure could not be read as SVG")]
    ReadSvg(#[source] resvg::usvg::Error),
    /// A figure is too large for an image, or its encoding failed.
    #[error("a picture of {width} × {height} pixels could not be made; plot fewer panels or points")]
    Rasterize {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// `modes` needs a numeric axis with at least two values.
    #[error(
        "modes needs an axis of numbers with at least 2 values, and [axes] has none; add one, e.g. mu_d = {{ from = 0.0, to = 0.6, points = 601 }}"
    )]
    NoModesAxis,
    /// `modes` needs axes, not tuples.
    #[error(
        "modes needs an axis of numbers with at least 2 values, and this sweep lists its instances in a file of `points`; give [axes] in its place, e.g. mu_d = {{ from = 0.0, to = 0.6, points = 601 }}"
    )]
    NoModesOfTuples,
    /// `modes` finds nothing to show.
    #[error(
        "no instance of the sweep has modes: none has a sliding equilibrium on a moving belt; give at least one a `belt_velocity` above 0 (and, where theta < 0, less friction; with the law `constant`, `mu_s` of at least `mu_d`)"
    )]
    NoModes,
    /// A sweep file whose name names no directory.
    #[error("the name of `{}` gives the results no directory of their own; name one with -o", one_line(&path.display().to_string()))]
    NoStem {
        /// The sweep file.
        path: PathBuf,
    },
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
    /// No adapter at all.
    #[error(
        "no GPU was found: no adapter answers through Vulkan, Metal or DX12; {remedy}, or use --backend cpu"
    )]
    NoAdapter {
        /// What to install.
        remedy: &'static str,
    },
    /// No adapter of the name that was asked for.
    #[error("no adapter has `{name}` in its name; there are: {names}; choose one with --adapter")]
    NoSuchAdapter {
        /// The part of a name.
        name: String,
        /// What there is.
        names: String,
    },
    /// An adapter without 64-bit arithmetic.
    #[error("{adapter} does not compute in f64 (SHADER_F64); use --precision f32 or --backend cpu")]
    NoF64 {
        /// The best adapter.
        adapter: String,
    },
    /// An adapter that cannot round every operation by itself.
    #[error(
        "{adapter} cannot compute strictly, which needs Vulkan; choose another with --adapter or remove --strict"
    )]
    NoStrict {
        /// The best adapter.
        adapter: String,
    },
    /// A hardware GPU is required but a software adapter would compute.
    #[error("--require-gpu: {instead} would compute; remove the flag or install a GPU driver")]
    NoHardware {
        /// What would compute.
        instead: String,
    },
    /// Something is asked for that only a GPU can honour, and none is taken.
    #[error("{asked}: this needs a GPU, but {cause}; {remedy}, or remove {asked}")]
    OnlyOnGpu {
        /// The options.
        asked: String,
        /// Why no GPU is taken.
        cause: String,
        /// What helps against it.
        remedy: String,
    },
    /// An adapter without a name.
    #[error(
        "--adapter is `{name}` but must be a part of an adapter's name as `squealmap adapters` prints it; \
         give one or remove --adapter"
    )]
    EmptyAdapter {
        /// The blanks that were given, if any.
        name: String,
    },
    /// A friction table that no kernel holds.
    #[error(
        "a friction table of {rows} rows is too long for a GPU, which takes {limit}; thin it out, or use --backend cpu"
    )]
    LongTable {
        /// Rows of the table.
        rows: usize,
        /// The most there may be.
        limit: usize,
    },
    /// The reference asked to compute in f32.
    #[error("the reference computes in f64 only; remove --precision f32 or use --backend cpu")]
    ReferencePrecision,
    /// The CPU engine asked to be strict.
    #[error("--strict is about how a GPU rounds; remove --strict or use --backend gpu")]
    CpuStrict,
    /// The CPU engine asked to use an adapter.
    #[error("the CPU engine uses no adapter; remove --adapter {name} or use --backend gpu")]
    CpuAdapter {
        /// The part of a name that was given.
        name: String,
    },
    /// The CPU engine asked to be a GPU.
    #[error("the CPU engine is no GPU; remove --require-gpu or use --backend gpu")]
    CpuRequireGpu,
    /// An adapter that cannot be opened.
    #[error("cannot open {adapter}: {why}; use --backend cpu")]
    OpenDevice {
        /// The adapter.
        adapter: String,
        /// What it says.
        why: String,
    },
    /// A device that rejects what it is given.
    #[error("the GPU failed while {what}: {why}; use --backend cpu")]
    Device {
        /// During what.
        what: String,
        /// What it says.
        why: String,
    },
    /// A device that is gone.
    #[error("the GPU was lost: {why}")]
    DeviceLost {
        /// What it says.
        why: String,
    },
    /// A device that was opened again and lost again.
    #[error(
        "the GPU was lost twice: {why}; {done} of {total} instances were done; \
         use --backend cpu or fewer instances"
    )]
    DeviceLostAgain {
        /// What it says.
        why: String,
        /// Finished instances.
        done: usize,
        /// All instances.
        total: usize,
    },
    /// A buffer with too few or too many words.
    #[error("the buffer `{name}` has {found} words instead of {wanted}; nothing was exported")]
    ShortBuffer {
        /// The buffer.
        name: &'static str,
        /// Its words.
        found: usize,
        /// What it should have.
        wanted: usize,
    },
    /// A kernel whose counters are not what they should be.
    #[error("the {kernel} kernel counted {found} instead of {wanted}; nothing was exported")]
    Miscounted {
        /// The kernel.
        kernel: &'static str,
        /// Its count.
        found: usize,
        /// What it should be.
        wanted: usize,
    },
    /// A kernel that does not come to an end.
    #[error(
        "the {kernel} kernel finished {finished} of {count} instances in {dispatches} dispatches; nothing was exported"
    )]
    Endless {
        /// The kernel.
        kernel: &'static str,
        /// Finished instances.
        finished: usize,
        /// Instances of the chunk.
        count: usize,
        /// Dispatches.
        dispatches: u64,
    },
    /// An engine that failed before anything was done.
    #[error("{why}")]
    Engine {
        /// What it says.
        why: String,
    },
    /// A run that was stopped from outside before anything was done, or a chunk of one.
    #[error("stopped after {done} of {total} instances; nothing was written")]
    Cancelled {
        /// Finished instances.
        done: usize,
        /// All instances.
        total: usize,
    },
    /// Measured signals that are not fit for analysis.
    #[error("{name}: {}", clipped(&fault.to_string(), FAULT))]
    Signals {
        /// The file as the user wrote it.
        name: String,
        /// Which column, where, and what to do.
        fault: Box<Fault>,
    },
    /// Measured friction that does not determine a material.
    #[error("{name}: {}", clipped(&fault.to_string(), FAULT))]
    Fit {
        /// The file as the user wrote it.
        name: String,
        /// Which value, and what to do.
        fault: FitFault,
    },
    /// A ramp of the paper's figures that does not come to its end.
    #[error(
        "the ramp under {case} of {duration} s with a kick of {kick} m ended early with status `{status}`; \
         choose another --ramp-duration or --kick"
    )]
    PaperRamp {
        /// The friction case in words.
        case: &'static str,
        /// Duration of the ramp, s.
        duration: f64,
        /// Displacement at its start, m.
        kick: f64,
        /// How it ended.
        status: &'static str,
    },
    /// A file of a directory that is not as its command writes it.
    #[error(
        "cannot read `{}`: {}; an output directory is needed as its command wrote it: run that again",
        path.display(),
        clipped(why, SAID)
    )]
    Archive {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// What is to be drawn is no directory.
    #[error("`{}` {why}; give `plot` the output directory of a command", path.display())]
    NoDirectoryToPlot {
        /// The path.
        path: PathBuf,
        /// What it is instead.
        why: &'static str,
    },
    /// A directory without a figure.
    #[error(
        "there is nothing to draw in `{}`: looked for {wanted}; give `plot` the output directory of one of these commands",
        path.display()
    )]
    NothingToPlot {
        /// The directory.
        path: PathBuf,
        /// The files that were looked for.
        wanted: String,
    },
    /// An option of maps for another figure.
    #[error("{option} is of maps, but the figure of `{}` is that of `{figure}`; leave {option} out", path.display())]
    OnlyOfMaps {
        /// The option.
        option: &'static str,
        /// The figure that the directory holds.
        figure: &'static str,
        /// The directory.
        path: PathBuf,
    },
    /// A figure narrower than its words.
    #[error("--width is {width} mm, but the figure `{figure}` needs at least {least} mm for its words")]
    TooNarrow {
        /// What was asked for, mm.
        width: f64,
        /// The figure.
        figure: &'static str,
        /// The least, mm.
        least: f64,
    },
    /// A figure taller than the page.
    #[error("the figure would be {height:.0} mm tall, but a page holds {most:.0} mm; {advice}")]
    TooTall {
        /// Its height, mm.
        height: f64,
        /// The most, mm.
        most: f64,
        /// What to do.
        advice: &'static str,
    },
    /// A cut that a map does not have.
    #[error("--cut {cut}: {why}")]
    Cut {
        /// What was asked for.
        cut: String,
        /// Why there is none, and what to write.
        why: String,
    },
    /// A part of a map that it does not have.
    #[error("--select {select}: {why}")]
    Select {
        /// What was asked for.
        select: String,
        /// Why there is none, and what to write.
        why: String,
    },
    /// Two maps that cannot be compared.
    #[error("`{}` and `{}` cannot be compared: {why}; give two directories of the same grid", first.display(), second.display())]
    NotComparable {
        /// The first directory.
        first: PathBuf,
        /// The second.
        second: PathBuf,
        /// What differs.
        why: String,
    },
    /// A map that is no source for LaTeX.
    #[error("--tikz writes the classes of a map, but {why}; leave --tikz out")]
    Tikz {
        /// Why there is none.
        why: &'static str,
    },
    /// Lines of equal value of something that has no values.
    #[error(
        "{option} draws lines of equal value, which `{name}` has none of; name numbers, such as --quantity growth"
    )]
    NoIsolines {
        /// The option.
        option: &'static str,
        /// What is shown.
        name: String,
    },
    /// Something of areas that a map of single points does not have.
    #[error(
        "{option} needs axes, and this sweep lists its instances in a file of `points`; leave {option} out"
    )]
    NoAreas {
        /// The option.
        option: &'static str,
    },
    /// A quantity that a map does not have.
    #[error("the map has no quantity `{name}`; {advice}")]
    NoSuchQuantity {
        /// What was asked for.
        name: String,
        /// The nearest name, or all of them.
        advice: String,
    },
    /// A PDF that cannot be made.
    #[error("the figure could not be written as PDF: {why}")]
    Pdf {
        /// What the library says.
        why: String,
    },
    /// A sweep on which no accuracy can be measured.
    #[error("accuracy is measured on settled oscillations, but {what}")]
    NothingToJudge {
        /// What is missing, and what to do.
        what: &'static str,
    },
    /// An accuracy beside what it chooses.
    #[error("{option} stands beside --accuracy {accuracy}, which chooses it; remove one of them")]
    AccuracyBeside {
        /// The option as written.
        option: String,
        /// The accuracy.
        accuracy: String,
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
        "--accuracy chooses from what was measured, and of {kinds} nothing was that may be taken here; measure it with \
         `squealmap tradeoff SWEEP` on this machine, or leave out --backend, --strict, --adapter and --require-gpu"
    )]
    Unmeasured {
        /// The kinds of scenes.
        kinds: String,
    },
    /// A scheduler that is not there.
    #[error(
        "`{program}` of Slurm is not on the path; submit from a node of the cluster, or see with --dry-run what would be \
         submitted"
    )]
    NoScheduler {
        /// The program that was called.
        program: &'static str,
    },
    /// A scheduler that refuses.
    #[error("`{program}` failed: {why}")]
    Scheduler {
        /// The program that was called.
        program: &'static str,
        /// What it says.
        why: String,
    },
    /// The first of two jobs is there and cannot be taken back.
    #[error(
        "job {array} computes the tiles, but there is no job that merges them: {why}; `squealmap merge` does it when that \
         is done"
    )]
    HalfSubmitted {
        /// The number of the array job.
        array: String,
        /// What was said of the other one.
        why: String,
    },
    /// Tasks that would take over another directory.
    #[error(
        "--reuse stands among the options of a job's tasks, which do not say together what they took over; use `run --reuse` \
         for the sweep as a whole, or leave it out"
    )]
    ReuseInJobs,
    /// More GPUs for a task than it uses.
    #[error(
        "--gpus is `{gpus}` but must be 1 or TYPE:1, as a run uses one GPU; take more --tasks for more GPUs"
    )]
    ManyGpus {
        /// What was asked for.
        gpus: String,
    },
    /// A path that no script holds.
    #[error(
        "the path `{}` cannot stand in a job: it is no UTF-8 or holds a control character; rename it",
        one_line(&path.display().to_string())
    )]
    PathOfJob {
        /// The path.
        path: PathBuf,
    },
    /// The path of the program is not known.
    #[error("cannot find the path of this program for the nodes: {why}")]
    OwnProgram {
        /// What the system says.
        why: String,
    },
    /// The handler of Ctrl-C cannot be set.
    #[error("cannot listen to Ctrl-C: {why}")]
    Signal {
        /// What the system says.
        why: String,
    },
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

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::ReadSweep { .. }
            | Error::Fem { .. }
            | Error::Signals { .. }
            | Error::Fit { .. }
            | Error::Archive { .. }
            | Error::NothingToPlot { .. }
            | Error::NoDirectoryToPlot { .. }
            | Error::OnlyOfMaps { .. }
            | Error::TooNarrow { .. }
            | Error::TooTall { .. }
            | Error::Cut { .. }
            | Error::Select { .. }
            | Error::NotComparable { .. }
            | Error::NoIsolines { .. }
            | Error::NoAreas { .. }
            | Error::Tikz { .. }
            | Error::NoSuchQuantity { .. }
            | Error::PaperRamp { .. }
            | Error::FollowsRamp { .. }
            | Error::OutputDirectory { .. }
            | Error::NoTiles { .. }
            | Error::BadDescription { .. }
            | Error::BadFrontier { .. }
            | Error::PartialAsWhole { .. }
            | Error::OtherSweep { .. }
            | Error::OtherInput { .. }
            | Error::FileThere { .. }
            | Error::NoInstance { .. }
            | Error::OtherVersion { .. }
            | Error::NoRefinement { .. }
            | Error::OtherCut { .. }
            | Error::StrangeTile { .. }
            | Error::OtherFormat { .. }
            | Error::OtherMerge { .. }
            | Error::OtherReuse { .. }
            | Error::TilesMissing { .. }
            | Error::NoSpace { .. }
            | Error::NoModesAxis
            | Error::NoModesOfTuples
            | Error::NoModes
            | Error::NothingToJudge { .. }
            | Error::NothingToRefine
            | Error::RefineBeside { .. }
            | Error::SameName { .. }
            | Error::TooManyToRefine { .. }
            | Error::AccuracyBeside { .. }
            | Error::NoScheduler { .. }
            | Error::ManyGpus { .. }
            | Error::ReuseInJobs
            | Error::PathOfJob { .. }
            | Error::NoStem { .. }
            | Error::Inaccurate { .. }
            | Error::Unmeasured { .. }
            | Error::NoAdapter { .. }
            | Error::NoSuchAdapter { .. }
            | Error::NoF64 { .. }
            | Error::NoStrict { .. }
            | Error::NoHardware { .. }
            | Error::LongTable { .. }
            | Error::OnlyOnGpu { .. }
            | Error::EmptyAdapter { .. }
            | Error::ReferencePrecision
            | Error::CpuStrict
            | Error::CpuAdapter { .. }
            | Error::CpuRequireGpu => true,
            _ => self.place().is_some(),
        }
    }
}

/// The crate's result.
pub type Result<T> = std::result::Result<T, Error>;
