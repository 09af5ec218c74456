//! Why results cannot be written, drawn or read back.

use squealmap_input::place::Place;
use squealmap_input::quote::{SAID, clipped};
use std::path::PathBuf;

/// Why results cannot be written, drawn or read back. Every message is one sentence: where, the key, the value, the limit, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A map holds fewer or more records than its grid has instances.
    #[error("the map holds {records} records for {instances} instances; nothing was exported")]
    Incomplete {
        /// Records in the map.
        records: usize,
        /// Instances of the grid.
        instances: usize,
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
    /// A part of a map that it does not have.
    #[error("--select {select}: {why}")]
    Select {
        /// What was asked for.
        select: String,
        /// Why there is none, and what to write.
        why: String,
    },
    /// A map that is no source for LaTeX.
    #[error("--tikz writes the classes of a map, but {why}; leave --tikz out")]
    Tikz {
        /// Why there is none.
        why: &'static str,
    },
    /// The table as a Parquet file cannot be written.
    #[cfg(feature = "parquet")]
    #[error("the Parquet file could not be written")]
    WriteParquet(#[source] parquet::errors::ParquetError),
    /// A cut that a map does not have.
    #[error("--cut {cut}: {why}")]
    Cut {
        /// What was asked for.
        cut: String,
        /// Why there is none, and what to write.
        why: String,
    },
    /// The manifest could not be written.
    #[error("the manifest could not be written")]
    WriteManifest(#[source] serde_json::Error),
    /// A document that could not be drawn.
    #[cfg(feature = "figures")]
    #[error(transparent)]
    Figure(#[from] squealmap_figure::Error),
    /// A table could not be written.
    #[error("the table could not be written")]
    WriteTable(#[source] csv::Error),
    /// What the floor below says.
    #[error(transparent)]
    OfStore(#[from] crate::store::error::Error),
}

impl From<crate::sweep::error::Error> for Error {
    fn from(why: crate::sweep::error::Error) -> Error {
        Error::OfStore(why.into())
    }
}

impl From<crate::engine::error::Error> for Error {
    fn from(why: crate::engine::error::Error) -> Error {
        Error::OfStore(why.into())
    }
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Error::OfStore(why) => why.place(),
            _ => None,
        }
    }

    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::OfStore(why) if why.is_cancelled())
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::Archive { .. }
            | Error::TooTall { .. }
            | Error::Select { .. }
            | Error::Tikz { .. }
            | Error::Cut { .. } => true,
            Error::OfStore(why) => why.is_bad_input(),
            _ => false,
        }
    }
}

/// The result of this floor.
pub type Result<T> = std::result::Result<T, Error>;
