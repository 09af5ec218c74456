//! A sweep computed in memory.

use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use squealmap::cli::accuracy::{ranked, said};
use squealmap::engine::options::Options;
use squealmap::results::arrays::Variable;
use squealmap::results::gathered::Gathered;
use squealmap::sweep::accuracy::frontier::{Choice, Chosen};
use squealmap::sweep::accuracy::level::Level;
use squealmap::sweep::accuracy::trial::first_that_keeps;
use squealmap::sweep::spec::{Analysis, Spec};

use crate::dataset::{Dataset, variable};
use crate::failure::Failure;
use crate::sweep::{Engine, Sweep};
use crate::watch::watched;

/// Computes a sweep; `linear` of eigenvalues alone. Gives the dataset, warnings, what the program says of its engine, and the
/// exception that stopped it, or `None`.
#[pyfunction]
pub(crate) fn run(
    py: Python<'_>,
    sweep: Sweep,
    engine: Engine,
    linear: bool,
    check: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'_, PyTuple>> {
    let (threads, progress) = (engine.threads, progress.as_ref());
    let (made, raised) = watched(py, threads, progress, move |watch| {
        let mut spec = sweep.spec()?;
        if linear {
            spec.analysis = Analysis::LINEAR;
            spec.refine = None;
        }
        spec.analysis.checked &= check;
        if spec.refine.is_some() {
            return Err(Failure::input(
                "this sweep has [refine], and run computes every instance: remove [refine], or call squealmap.refine",
            ));
        }
        let warnings: Vec<String> = spec.beyond_its_modes().into_iter().collect();
        let notes = Mutex::new(Vec::new());
        let note = |text: &str| notes.lock().unwrap_or_else(PoisonError::into_inner).push(text.to_owned());
        let options = engine.options(watch, &note)?;
        watch.expect(spec.grid.len());
        let chosen = |level: Level| -> Result<Option<Choice>, Failure> {
            let ranked = ranked(level, &spec, &options)?;
            Ok(ranked.map(|ranked| first_that_keeps(ranked, &spec, &options)).transpose()?)
        };
        let choice = match engine.level()?.map(chosen).transpose() {
            // Stopped while it chose: nothing is computed.
            Err(_) if watch.is_cancelled() => None,
            choice => choice?.flatten(),
        };
        let options = match &choice {
            None => options,
            Some(choice) => {
                for sentence in said(&choice.chosen) {
                    note(&sentence);
                }
                spec = choice.configuration.sweep(&spec);
                Options { adapters: options.adapters, ..choice.configuration.options(&options) }
            }
        };
        let made = Gathered::compute(&spec, &options, &|count| watch.add(count))?;
        let made = dataset(&spec, made, choice.as_ref().map(|choice| choice.chosen.clone()))?;
        let notes = std::mem::take(&mut *notes.lock().unwrap_or_else(PoisonError::into_inner));
        Ok((made, warnings, notes))
    })?;
    let (dataset, warnings, notes) = made;
    let raised = raised.map(|raised| raised.into_value(py)).into_pyobject(py)?;
    let [warnings, notes] = [PyList::new(py, warnings)?, PyList::new(py, notes)?];
    let dataset = dataset.handed(py)?;
    PyTuple::new(py, [dataset.into_any(), warnings.into_any(), notes.into_any(), raised.into_any()])
}

fn dataset(spec: &Spec, made: Gathered, accuracy: Option<Chosen>) -> Result<Dataset, Failure> {
    let manifest = String::from_utf8_lossy(&made.manifest(spec, accuracy)?).into_owned();
    let complete = made.stopped.is_none();
    let mut dataset = Dataset::of(&made.arrays);
    let dimensions: Vec<&str> = made.arrays.dimensions.iter().map(|(name, _)| *name).collect();
    let of = |(one, values): (&Variable, _)| variable(one, values, &dimensions);
    dataset.variables = made.arrays.variables.iter().zip(made.values).map(of).collect();
    dataset.attributes = attributes("map", &spec.title, manifest);
    if !complete {
        dataset.attributes.push(("complete", "false".to_owned()));
    }
    Ok(dataset)
}

/// The attributes of every result: what it is, its title, what made it, and the document of the program.
pub(crate) fn attributes(kind: &str, title: &str, manifest: String) -> Vec<(&'static str, String)> {
    vec![
        ("title", title.to_owned()),
        ("source", squealmap::version::program()),
        ("Conventions", "CF-1.11".to_owned()),
        ("squealmap", kind.to_owned()),
        ("manifest", manifest),
    ]
}
