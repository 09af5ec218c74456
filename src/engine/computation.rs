//! Where and how an analysis is computed, and why it stopped.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::engine::error::{Error, Result};

/// Why a run stopped before its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// From outside, by Ctrl-C.
    Cancelled,
    /// By a failure, in the words of the device, that says nothing against the records that were done before.
    Failed(String),
}

impl TryFrom<Error> for Stopped {
    type Error = Error;

    /// # Errors
    /// The error itself when it puts what was done in doubt, as a kernel that miscounts does.
    fn try_from(error: Error) -> Result<Stopped> {
        match error {
            Error::Cancelled { .. } => Ok(Stopped::Cancelled),
            Error::OpenDevice { .. }
            | Error::Device { .. }
            | Error::DeviceLost { .. }
            | Error::DeviceLostAgain { .. } => Ok(Stopped::Failed(error.to_string())),
            doubtful => Err(doubtful),
        }
    }
}

impl Stopped {
    /// The error of a run that ended like this with `done` of `total` instances, where those that are done are not kept.
    #[must_use]
    pub fn error(self, done: usize, total: usize) -> Error {
        match self {
            Stopped::Cancelled => Error::Cancelled { done, total },
            Stopped::Failed(why) => Error::Engine { why },
        }
    }
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stopped::Cancelled => "cancelled",
            Stopped::Failed(why) => why,
        })
    }
}

/// Where and how one analysis was computed.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Computation {
    /// `cpu` or `gpu`.
    pub backend: String,
    /// `f64` or `f32`.
    pub precision: String,
    /// The method.
    pub method: String,
    /// The adapter of a GPU backend.
    pub adapter: Option<String>,
    /// Whether a GPU backend rounded every operation by itself.
    pub strict: Option<bool>,
}

impl fmt::Display for Computation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}, {}", self.backend, self.precision, self.method)
    }
}
