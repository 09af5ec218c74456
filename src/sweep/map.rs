//! The map: grid, types, regimes, values, counts and provenance.

use std::time::Duration;

use crate::engine::computation::{Computation, Stopped};
use crate::engine::record::Record;
use crate::model::status::Status;
use crate::sweep::spec::Spec;

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
    /// Why some records are [`Status::NotComputed`]; `None` when all were computed.
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
