//! The map: grid, types, regimes, values, counts and provenance.

use std::fmt;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::accuracy::check::Check;
use crate::classify::{InstabilityType, Regime};
use crate::error::{Error, Result};
use crate::linear::Linear;
use crate::outcome::{Outcome, Status};
use crate::spec::Spec;
use crate::starts::{Basin, Others};

/// What was computed of one instance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// How it ended.
    pub status: Status,
    /// Type of instability; `None` when not asked for or not defined (Painlevé, invalid law).
    pub kind: Option<InstabilityType>,
    /// Eigenvalue analysis, when asked for and defined.
    pub linear: Option<Linear>,
    /// Regime of the measuring window, when asked for and defined.
    pub regime: Option<Regime>,
    /// Whether the regime is settled.
    pub settled: Option<bool>,
    /// The response, when asked for; apart, as a record without one is a quarter as large.
    pub outcome: Option<Box<Outcome>>,
    /// What a check found, where the instance was checked.
    pub check: Option<Check>,
    /// Whether several starts ended differently; `None` where there is one, or some have not settled.
    pub bistable: Option<bool>,
    /// What other starts gave, where there are any.
    pub others: Option<Others>,
}

impl Record {
    /// An instance that a stopped run did not come to.
    pub const NOT_COMPUTED: Record = Record {
        status: Status::NotComputed,
        kind: None,
        linear: None,
        regime: None,
        settled: None,
        outcome: None,
        check: None,
        bistable: None,
        others: None,
    };

    /// The record before any check; `None` where that is not known, or nothing was computed.
    #[must_use]
    pub fn as_made(&self) -> Option<Record> {
        let made = self.status != Status::NotComputed && self.check.is_none_or(|check| !check.taken);
        made.then(|| Record { check: None, ..self.clone() })
    }

    /// The record of the large start, where there is one.
    #[must_use]
    pub fn large(&self) -> Option<&Record> {
        match &self.others {
            Some(Others::Large(record)) => Some(record),
            _ => None,
        }
    }

    /// What the starts of a box gave, where there are any.
    #[must_use]
    pub fn basin(&self) -> Option<Basin> {
        match &self.others {
            Some(Others::Basin(basin)) => Some(*basin),
            _ => None,
        }
    }
}

/// Why a run stopped before its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// From outside, by Ctrl-C.
    Cancelled,
    /// By a failure that says nothing against what was done before: what the device said.
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
    /// The error of a run that ended like this with `done` of `total` instances, where what is done is not kept.
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

/// Where and how a map was computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// The eigenvalue analysis, when asked for.
    pub linear: Option<Computation>,
    /// The response, when asked for; apart, as a record without one is a quarter as large.
    pub response: Option<Computation>,
    /// Worker threads.
    pub threads: usize,
    /// Wall time of the computation.
    pub elapsed: Duration,
}

/// A computed sweep, all of it or as far as it came. `records[i]` belongs to instance `i` of `spec.grid`.
#[derive(Clone, Debug)]
pub struct Map {
    /// The sweep.
    pub spec: Spec,
    /// One record per instance.
    pub records: Vec<Record>,
    /// Why some records are [`Status::NotComputed`]; `None` when none is.
    pub stopped: Option<Stopped>,
    /// Where and how.
    pub provenance: Provenance,
}

impl Map {
    /// How many instances were computed.
    #[must_use]
    pub fn computed(&self) -> usize {
        self.records.iter().filter(|record| record.status != Status::NotComputed).count()
    }
}
