//! Why a command failed: what only the command line can be blamed for, and what the library says.

use std::path::PathBuf;

use squealmap_input::place::Place;
use squealmap_input::quote::{SAID, clipped, one_line};

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    /// What the library says.
    #[error(transparent)]
    Library(#[from] squealmap::Error),
    /// Results of two sweeps would go to one place.
    #[error(
        "two of the sweep files are named `{name}`, so that their results would stand in one directory; rename one, or \
         measure them by two commands"
    )]
    SameName {
        /// The name, without its ending.
        name: String,
    },
    /// A folder without records.
    #[error("`{}` {why}", path.display())]
    NoRecords {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// An option that a refined sweep does not have.
    #[error(
        "{option} cannot be used for a sweep with [refine], which one process computes level by level; leave it out, or \
         remove [refine] to compute the whole grid"
    )]
    RefineBeside {
        /// The option.
        option: &'static str,
    },
    /// A motion that is to be followed in steps while its belt changes its velocity.
    #[error("{what} holds the belt at every value, but here it has {motion}; take that out of [belt]")]
    FollowsRamp {
        /// The command or option.
        what: &'static str,
        /// What it is.
        motion: String,
    },
    /// A parameter with a value that is to be followed, too.
    #[error("`--at` gives `{name}` a value, which `--sweep-up-down` varies; leave it out of `--at`")]
    FollowedAndFixed {
        /// The parameter.
        name: &'static str,
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
    /// A file that `init` would write, and does not.
    #[error("`{}` is there already; name another one with -o", path.display())]
    FileThere {
        /// The file.
        path: PathBuf,
    },
    /// A file that `export` would replace, and does not.
    #[error("`{}` {why}", path.display())]
    ExportThere {
        /// The file.
        path: PathBuf,
        /// What it is, and what to do.
        why: &'static str,
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
    /// A tile that is not what it should be.
    #[error("`{}` is bad: {fault}; run the sweep again", path.display())]
    BadTile {
        /// The tile.
        path: PathBuf,
        /// What is wrong with it.
        fault: Box<dyn std::error::Error + Send + Sync>,
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
    /// An output file that cannot be written.
    #[error("cannot write `{}`: {why}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// A sweep file whose name names no directory.
    #[error("the name of `{}` gives the results no directory of their own; name one with -o", one_line(&path.display().to_string()))]
    NoStem {
        /// The sweep file.
        path: PathBuf,
    },
    /// Measurements that no model has.
    #[error("{fault}")]
    Calibrate {
        /// Which, and what to do.
        fault: squealmap::study::calibrate::Fault,
    },
    /// A file that is no material over temperature.
    #[error("`{}` {why}; give --material a file that `squealmap fit` wrote for at least two temperatures", path.display())]
    NoMaterial {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
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
    /// The page of a run, whose values no page has.
    #[error(
        "`{}` is the directory of a run, whose values the page of -o would not have; name its sweep file, or leave -o out",
        path.display()
    )]
    RunAsPage {
        /// The directory.
        path: PathBuf,
    },
    /// A port that cannot be listened on.
    #[error(
        "cannot listen on 127.0.0.1:{port}: {why}; name another --port, or leave it out for one that is free"
    )]
    Listen {
        /// The port.
        port: u16,
        /// What the system says.
        why: String,
    },
    /// A server that does not begin.
    #[error("the page cannot be served: {why}")]
    Serve {
        /// Why.
        why: String,
    },
    /// The handler of Ctrl-C cannot be set.
    #[error("cannot listen to Ctrl-C: {why}")]
    Signal {
        /// What the system says.
        why: String,
    },
}

impl From<squealmap::engine::error::Error> for Error {
    fn from(why: squealmap::engine::error::Error) -> Error {
        Error::Library(why.into())
    }
}

impl From<squealmap::sweep::error::Error> for Error {
    fn from(why: squealmap::sweep::error::Error) -> Error {
        Error::Library(why.into())
    }
}

impl From<squealmap::store::error::Error> for Error {
    fn from(why: squealmap::store::error::Error) -> Error {
        Error::Library(why.into())
    }
}

impl From<squealmap::results::error::Error> for Error {
    fn from(why: squealmap::results::error::Error) -> Error {
        Error::Library(why.into())
    }
}

impl From<squealmap::study::error::Error> for Error {
    fn from(why: squealmap::study::error::Error) -> Error {
        Error::Library(why.into())
    }
}

impl From<squealmap_identify::Unfit> for Error {
    fn from(unfit: squealmap_identify::Unfit) -> Error {
        squealmap::study::error::Error::from(unfit).into()
    }
}

impl From<squealmap_figure::Error> for Error {
    fn from(why: squealmap_figure::Error) -> Error {
        squealmap::results::error::Error::from(why).into()
    }
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    pub(crate) fn place(&self) -> Option<&Place> {
        match self {
            Error::Library(why) => why.place(),
            _ => None,
        }
    }

    /// Whether a run was stopped from outside.
    pub(crate) fn is_cancelled(&self) -> bool {
        matches!(self, Error::Library(why) if why.is_cancelled())
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    pub(crate) fn is_bad_input(&self) -> bool {
        match self {
            Error::Library(why) => why.is_bad_input(),
            Error::SameName { .. }
            | Error::RefineBeside { .. }
            | Error::NoRecords { .. }
            | Error::FollowsRamp { .. }
            | Error::FollowedAndFixed { .. }
            | Error::PartialAsWhole { .. }
            | Error::BadFrontier { .. }
            | Error::FileThere { .. }
            | Error::ExportThere { .. }
            | Error::OtherInput { .. }
            | Error::OtherVersion { .. }
            | Error::NoRefinement { .. }
            | Error::TilesMissing { .. }
            | Error::NoStem { .. }
            | Error::Calibrate { .. }
            | Error::NoMaterial { .. }
            | Error::OnlyOfMaps { .. }
            | Error::TooNarrow { .. }
            | Error::NotComparable { .. }
            | Error::NoIsolines { .. }
            | Error::NoAreas { .. }
            | Error::NoSuchQuantity { .. }
            | Error::NoScheduler { .. }
            | Error::ReuseInJobs
            | Error::RunAsPage { .. }
            | Error::Listen { .. }
            | Error::ManyGpus { .. }
            | Error::PathOfJob { .. } => true,
            _ => false,
        }
    }
}

/// The result of a command.
pub(crate) type Result<T> = std::result::Result<T, Error>;
