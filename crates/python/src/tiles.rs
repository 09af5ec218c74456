//! The tiles of a directory, read as they are asked for.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use squealmap::engine::record::Record;
use squealmap::results::arrays::{Arrays, Values, Variable};
use squealmap::results::manifest::{Run, manifest};
use squealmap::store::directory::Store;
use squealmap::sweep::label::Tally;

use crate::dataset::{Dataset, variable};
use crate::failure::Failure;
use crate::map::attributes;
use crate::watch::whole;

/// The tiles of a directory.
#[pyclass(frozen, module = "squealmap._squealmap")]
#[derive(Debug)]
pub(crate) struct Tiles(Arc<Opened>);

#[derive(Debug)]
struct Opened {
    store: Store,
    arrays: Arrays,
}

#[pymethods]
impl Tiles {
    /// Opens the directory of a run.
    #[new]
    fn new(py: Python<'_>, directory: PathBuf) -> PyResult<Tiles> {
        let opened = whole(py, move |_| {
            let store = Store::open(&directory)?;
            let arrays = Arrays::new(store.description.sheet());
            Ok(Opened { store, arrays })
        })?;
        Ok(Tiles(Arc::new(opened)))
    }

    /// Dimensions, coordinates, variables without values, attributes.
    fn described<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let opened = Arc::clone(&self.0);
        whole(py, move |_| opened.described())?.handed(py)
    }

    /// Instances of a tile.
    #[getter]
    fn tile(&self) -> usize {
        self.0.store.description.tiling.tile
    }

    /// How many tiles are there, and how many there would be.
    fn done(&self, py: Python<'_>) -> PyResult<(usize, usize)> {
        let opened = Arc::clone(&self.0);
        whole(py, move |_| Ok((opened.store.done()?, opened.store.description.tiling.count())))
    }

    /// The values of a variable of the instances from `first` to before `last`.
    fn values<'py>(
        &self,
        py: Python<'py>,
        name: String,
        first: usize,
        last: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let opened = Arc::clone(&self.0);
        Ok(match whole(py, move |_| opened.values(&name, first, last))? {
            Values::Numbers(numbers) => numbers.into_pyarray(py).into_any(),
            Values::Codes(codes) => codes.into_pyarray(py).into_any(),
        })
    }
}

impl Opened {
    fn described(&self) -> Result<Dataset, Failure> {
        let mut dataset = Dataset::of(&self.arrays);
        let names: Vec<&str> = self.arrays.dimensions.iter().map(|(name, _)| *name).collect();
        let none = |one: &Variable| variable(one, one.values(&[]), &names);
        dataset.variables = self.arrays.variables.iter().map(none).collect();
        let description = &self.store.description;
        // What the tiles are of; what was found in them is not read here.
        let run = Run {
            threads: 0,
            elapsed: Duration::ZERO,
            computed: 0,
            reused: None,
            stopped: None,
            tiles: None,
            accuracy: description.accuracy.clone(),
        };
        let bytes = manifest(description.sheet(), &description.resolved, &Tally::default(), &run)?;
        let manifest = String::from_utf8_lossy(&bytes).into_owned();
        dataset.attributes = attributes("map", &description.title, manifest);
        Ok(dataset)
    }

    fn values(&self, name: &str, first: usize, last: usize) -> Result<Values, Failure> {
        let variable = self.arrays.variables.iter().find(|one| one.name == name);
        let variable = variable.ok_or_else(|| Failure::input(format!("no variable is called {name}")))?;
        let tiling = self.store.description.tiling;
        let last = last.min(tiling.instances);
        let mut all = variable.values(&[]);
        let mut at = first;
        while at < last {
            let number = at / tiling.tile;
            let bounds = tiling.bounds(number);
            let found = self.store.read(number).map_err(|fault| {
                let path = self.store.path(number);
                let path = path.display();
                Failure::input(format!("`{path}` is bad: {fault}; run the sweep again"))
            })?;
            // A tile that is not there is not computed, but for what a stopped run has kept of it.
            let kept = || self.store.read_some(number).ok().flatten();
            let records = found.or_else(kept).unwrap_or_else(|| vec![Record::NOT_COMPUTED; bounds.len()]);
            let end = last.min(bounds.end);
            match (&mut all, variable.values(&records[at - bounds.start..end - bounds.start])) {
                (Values::Numbers(all), Values::Numbers(some)) => all.extend(some),
                (Values::Codes(all), Values::Codes(some)) => all.extend(some),
                // A variable has values of one kind.
                (_, _) => {}
            }
            at = end;
        }
        Ok(all)
    }
}
