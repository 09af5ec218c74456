//! A sweep computed in memory as arrays alone: part by part, and the records of a part go when its values are taken.

use std::time::Instant;

use rayon::prelude::*;

use crate::engine;
use crate::engine::backend::Backend;
use crate::engine::computation::Stopped;
use crate::engine::computed::Computed;
use crate::engine::options::Options;
use crate::engine::record::Record;
use crate::results::accounted::all_written;
use crate::results::arrays::{Arrays, Kind, Values, Variable};
use crate::results::error::Result;
use crate::results::manifest::{Run, manifest};
use crate::store::cut::tile_of;
use crate::sweep::accuracy::frontier::Chosen;
use crate::sweep::error::Error;
use crate::sweep::label::Tally;
use crate::sweep::map::Provenance;
use crate::sweep::run::MOST_IN_MEMORY;
use crate::sweep::sheet::Sheet;
use crate::sweep::solver::Solver;
use crate::sweep::spec::Spec;

/// Instances at a time that a stopped run did not come to.
const MISSING: usize = 1 << 16;

/// The arrays of a sweep with their values.
#[derive(Debug)]
pub struct Gathered {
    /// Dimensions, coordinates and variables.
    pub arrays: Arrays,
    /// The values of each variable, of all instances in the order of the grid.
    pub values: Vec<Values>,
    /// How many instances have which label.
    pub tally: Tally,
    /// Why some instances are not computed; `None` when all were.
    pub stopped: Option<Stopped>,
    /// Where and how.
    pub provenance: Provenance,
}

impl Gathered {
    /// Computes a sweep. The CPU's part runs on the rayon pool that it is called in. `progress` gets the number of newly
    /// finished instances. A run that is cancelled, or fails on its way, gives what is done.
    ///
    /// # Errors
    /// As [`crate::sweep::run::run`].
    pub fn compute(spec: &Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Gathered> {
        let began = Instant::now();
        let instances = spec.grid.len();
        if instances > MOST_IN_MEMORY {
            return Err(Error::TooManyInMemory { instances, limit: MOST_IN_MEMORY }.into());
        }
        let mut solver = Solver::new(spec, options)?;
        let [linear, response] = solver.computations();
        let arrays = Arrays::new(Sheet::new(spec, [linear.as_ref(), response.as_ref()]));
        let mut values = empty(&arrays, instances).ok_or(Error::NoRoomInMemory { instances })?;
        let (mut tally, mut stopped) = (Tally::default(), None);
        // Whole tiles, as the program takes them.
        let tile = tile_of(spec, options.backend == Backend::Reference);
        let part = solver.busy_with(tile).div_ceil(tile).max(1) * tile;
        let mut first = 0;
        while first < instances && stopped.is_none() {
            let range = first..instances.min(first + part);
            let ahead = solver.ahead().min(instances - range.end);
            let computed = match solver.records_ahead(range, ahead, progress) {
                Ok(computed) => computed,
                // Nothing is done, and cannot be; but a stop is no failure.
                Err(why) if first == 0 && !matches!(why, engine::error::Error::Cancelled { .. }) => {
                    return Err(why.into());
                }
                Err(why) => Computed { records: Vec::new(), stopped: Some(Stopped::try_from(why)?) },
            };
            all_written(first, &computed.records, computed.stopped.is_some())?;
            take(&arrays.variables, &mut values, &computed.records);
            tally.add(&computed.records);
            first += computed.records.len();
            stopped = computed.stopped;
        }
        let missing = vec![Record::NOT_COMPUTED; MISSING.min(instances - first)];
        while first < instances {
            let count = MISSING.min(instances - first);
            take(&arrays.variables, &mut values, &missing[..count]);
            tally.add_missing(count);
            first += count;
        }
        let elapsed = began.elapsed();
        let provenance = Provenance { linear, response, threads: rayon::current_num_threads(), elapsed };
        Ok(Gathered { arrays, values, tally, stopped, provenance })
    }

    /// The manifest of the sweep: UTF-8 JSON, indented. `accuracy` is what was asked for, and what was chosen for it.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn manifest(&self, spec: &Spec, accuracy: Option<Chosen>) -> Result<Vec<u8>> {
        let made = &self.provenance;
        let run = Run {
            threads: made.threads,
            elapsed: made.elapsed,
            computed: self.tally.computed(),
            reused: None,
            stopped: self.stopped.as_ref().map(ToString::to_string),
            tiles: None,
            accuracy,
        };
        let sheet = Sheet::new(spec, [made.linear.as_ref(), made.response.as_ref()]);
        manifest(sheet, &spec.resolved(), &self.tally, &run)
    }
}

/// Room for the values of all instances; `None` where there is none.
fn empty(arrays: &Arrays, instances: usize) -> Option<Vec<Values>> {
    fn room<T>(instances: usize) -> Option<Vec<T>> {
        let mut room = Vec::new();
        room.try_reserve_exact(instances).ok().map(|()| room)
    }
    let of = |variable: &Variable| match variable.kind {
        Kind::Numbers => room(instances).map(Values::Numbers),
        Kind::Codes(_) => room(instances).map(Values::Codes),
    };
    arrays.variables.iter().map(of).collect()
}

/// Takes the values of some records, variable by variable on the rayon pool.
fn take(variables: &[Variable], values: &mut [Values], records: &[Record]) {
    variables.par_iter().zip(values).for_each(|(variable, all)| match (all, variable.values(records)) {
        (Values::Numbers(all), Values::Numbers(some)) => all.extend(some),
        (Values::Codes(all), Values::Codes(some)) => all.extend(some),
        // A variable has values of one kind.
        (_, _) => {}
    });
}
