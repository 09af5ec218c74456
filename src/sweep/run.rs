//! The spine: spec → engine → records → map.

use std::time::Instant;

use crate::engine::computed::Computed;
use crate::engine::options::Options;
use crate::sweep::error::{Error, Result};
use crate::sweep::map::{Map, Provenance};
use crate::sweep::solver::Solver;
use crate::sweep::spec::Spec;

/// Most instances of a sweep in memory; the records of more would not fit a usual machine.
pub const MOST_IN_MEMORY: usize = 100_000_000;

/// Computes a sweep in memory. The CPU's part runs on the rayon pool that it is called in. `progress` gets the number of
/// newly finished instances. A run that is cancelled or fails on its way gives the records that are done, see
/// [`Map::stopped`]. [`crate::store`] computes sweeps of any size tile by tile into a directory.
///
/// # Errors
/// When the backend cannot compute the sweep, the run is cancelled or fails before any instance is done, or the
/// sweep has more than [`MOST_IN_MEMORY`] instances.
pub fn run(spec: Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let instances = spec.grid.len();
    if instances > MOST_IN_MEMORY {
        return Err(Error::TooManyInMemory { instances, limit: MOST_IN_MEMORY });
    }
    let mut solver = Solver::new(&spec, options)?;
    let Computed { records, stopped } = solver.records(0..instances, progress)?;
    let [linear, response] = solver.computations();
    let elapsed = began.elapsed();
    let provenance = Provenance { linear, response, threads: rayon::current_num_threads(), elapsed };
    Ok(Map { spec, records, stopped, provenance })
}
