//! Records that are taken from another directory for the same instances here. So a sweep whose axes were moved or refined
//! computes only its new instances.
//!
//! Two instances are the same when the values on all axes agree to the last bit, and so does everything else that their
//! numbers depend on: physics, program, engine and settings. Which instances are checked follows from the grid, so checks
//! are made anew. A record is taken as the engine made it; where a check has put a finer one in its place, it is not taken
//! at all.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use same_file::is_same_file;

use crate::engine::record::Record;
use crate::store::description::Description;
use crate::store::directory::{Note, Store};
use crate::store::error::{Error, Result};
use crate::sweep::grid::{Axis, Grid, Value};
use crate::sweep::spec::Starts;

/// Another directory, seen from a sweep.
#[derive(Debug)]
pub struct Reuse {
    source: Store,
    /// For every axis, slowest first, where each value here stands there.
    places: Vec<Vec<Option<usize>>>,
    /// Values of the axes there.
    lengths: Vec<usize>,
}

impl Reuse {
    /// The records in `directory` that the sweep `description` can take; its tiles go to `output`.
    ///
    /// # Errors
    /// When it has no tiles, or differs in more than the values of axes.
    pub fn new(directory: &Path, description: &Description, output: &Path) -> Result<Reuse> {
        let refused = |why| Error::OtherReuse { path: directory.to_owned(), why };
        if is_same_file(directory, output).unwrap_or(false) {
            return Err(refused("it is the output directory itself; choose another one with -o"));
        }
        if description.analysis.starts != Starts::One {
            // The starts in a box depend on the index of the instance, and both starts of one are checked.
            return Err(refused(
                "only sweeps with one start for each instance reuse another; choose another `kind`",
            ));
        }
        let source = Store::open(directory)?;
        let (Grid::Axes(here), Grid::Axes(there)) = (&description.grid, &source.description.grid) else {
            return Err(refused("only sweeps with [axes] reuse another; one of both lists its `points`"));
        };
        let keys = |axes: &[Axis]| axes.iter().map(|axis| axis.key).collect::<Vec<_>>();
        if keys(here) != keys(there) {
            return Err(refused("its [axes] are others or in another order; give them the same"));
        }
        if !description.differs_only_in_grid(&source.description) {
            return Err(refused(
                "it was computed with other parameters, settings, engine or version; only values of [axes] may differ",
            ));
        }
        let lengths = there.iter().map(|axis| axis.values.len()).collect();
        let places =
            here.iter().zip(there).map(|(here, there)| places(&here.values, &there.values)).collect();
        Ok(Reuse { source, places, lengths })
    }

    /// The id of the other sweep.
    #[must_use]
    pub fn sweep_id(&self) -> String {
        self.source.description.id.to_string()
    }

    /// The records of the instances `bounds` that are there, as the engine made them. A bad tile there is named and left
    /// as it is.
    #[must_use]
    pub fn known(&self, bounds: Range<usize>, note: Note) -> Vec<Option<Record>> {
        let mut known = vec![None; bounds.len()];
        let size = self.source.description.tiling.tile;
        // By the tiles there, so that each is read once.
        let mut wanted: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        for (at, index) in bounds.enumerate() {
            if let Some(there) = self.place(index) {
                wanted.entry(there / size).or_default().push((at, there % size));
            }
        }
        for (number, places) in wanted {
            match self.source.read(number) {
                Ok(Some(records)) => {
                    for (at, there) in places {
                        known[at] = records[there].as_made();
                    }
                }
                Ok(None) => {}
                Err(fault) => {
                    note(&format!("`{}` is not reused: {fault}", self.source.path(number).display()));
                }
            }
        }
        known
    }

    /// The index there of instance `index` here.
    fn place(&self, index: usize) -> Option<usize> {
        let (mut rest, mut there, mut stride) = (index, 0, 1);
        for (places, length) in self.places.iter().zip(&self.lengths).rev() {
            there += stride * places[rest % places.len()]?;
            rest /= places.len();
            stride *= length;
        }
        Some(there)
    }
}

/// Where each of the values `here` stands `there`; of values that are there twice, one of them.
fn places(here: &[Value], there: &[Value]) -> Vec<Option<usize>> {
    let key = |value: &Value| match value {
        Value::Number(number) => (number.to_bits(), String::new()),
        Value::Text(text) => (0, text.to_string()),
    };
    let numbers: BTreeMap<_, usize> = there.iter().map(key).zip(0..).collect();
    here.iter().map(|value| numbers.get(&key(value)).copied()).collect()
}
