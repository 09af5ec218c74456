//! Why a directory of tiles cannot be read or written.

use squealmap_input::place::Place;
use squealmap_input::quote::{SAID, clipped};
use std::path::PathBuf;

/// Why a directory of tiles cannot be read or written. Every message is one sentence: where, the key, the value, the limit, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
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
    /// A directory that nothing can be reused from.
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
    /// What the floor below says.
    #[error(transparent)]
    OfSweep(#[from] crate::sweep::error::Error),
}

impl From<crate::engine::error::Error> for Error {
    fn from(why: crate::engine::error::Error) -> Error {
        Error::OfSweep(why.into())
    }
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Error::OfSweep(why) => why.place(),
            _ => None,
        }
    }

    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::OfSweep(why) if why.is_cancelled())
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::OutputDirectory { .. }
            | Error::NoTiles { .. }
            | Error::OtherSweep { .. }
            | Error::BadDescription { .. }
            | Error::StrangeTile { .. }
            | Error::OtherFormat { .. }
            | Error::OtherCut { .. }
            | Error::OtherMerge { .. }
            | Error::OtherReuse { .. }
            | Error::NoSpace { .. } => true,
            Error::OfSweep(why) => why.is_bad_input(),
            _ => false,
        }
    }
}

/// The result of this floor.
pub type Result<T> = std::result::Result<T, Error>;
