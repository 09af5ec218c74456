//! The error of the library: that of one of its floors.

use squealmap_input::place::Place;

/// Why a call failed. Instances that fail are data (see [`crate::model::status::Status`]), not errors.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Why no engine computes, or why one stopped.
    #[error(transparent)]
    Engine(#[from] crate::engine::error::Error),
    /// Why a sweep is refused, or does not come to its end.
    #[error(transparent)]
    Sweep(#[from] crate::sweep::error::Error),
    /// Why a directory of tiles cannot be read or written.
    #[error(transparent)]
    Store(#[from] crate::store::error::Error),
    /// Why results cannot be written, drawn or read back.
    #[error(transparent)]
    Results(#[from] crate::results::error::Error),
    /// Why a study has no result.
    #[error(transparent)]
    Study(#[from] crate::study::error::Error),
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Error::Engine(_) => None,
            Error::Sweep(why) => why.place(),
            Error::Store(why) => why.place(),
            Error::Results(why) => why.place(),
            Error::Study(why) => why.place(),
        }
    }

    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        match self {
            Error::Engine(why) => why.is_cancelled(),
            Error::Sweep(why) => why.is_cancelled(),
            Error::Store(why) => why.is_cancelled(),
            Error::Results(why) => why.is_cancelled(),
            Error::Study(why) => why.is_cancelled(),
        }
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::Engine(why) => why.is_bad_input(),
            Error::Sweep(why) => why.is_bad_input(),
            Error::Store(why) => why.is_bad_input(),
            Error::Results(why) => why.is_bad_input(),
            Error::Study(why) => why.is_bad_input(),
        }
    }
}

/// The crate's result.
pub type Result<T> = std::result::Result<T, Error>;
