//! The map: grid, types, regimes, values, counts and provenance.

use std::fmt;
use std::time::Duration;

use serde::Serialize;

use crate::classify::{InstabilityType, Regime};
use crate::linear::Linear;
use crate::outcome::{Outcome, Status};
use crate::spec::Spec;

/// What was computed of one instance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    /// The response, when asked for.
    pub outcome: Option<Outcome>,
}

/// Where and how one analysis was computed.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    /// The response, when asked for.
    pub response: Option<Computation>,
    /// Worker threads.
    pub threads: usize,
    /// Wall time of the computation.
    pub elapsed: Duration,
}

/// A computed sweep. `records[i]` belongs to instance `i` of `spec.grid`.
#[derive(Clone, Debug)]
pub struct Map {
    /// The sweep.
    pub spec: Spec,
    /// One record per instance.
    pub records: Vec<Record>,
    /// Where and how.
    pub provenance: Provenance,
}
