//! The lines of a large map from few of its instances, in memory.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use serde_json::json;
use squealmap::engine::backend::Backend;
use squealmap::engine::record::Record;
use squealmap::results::arrays::{Arrays, Values, Variable};
use squealmap::results::manifest::{Run, manifest};
use squealmap::store::cut::tile_of;
use squealmap::sweep::accuracy::sample::subset;
use squealmap::sweep::label::Label;
use squealmap::sweep::refine::{Refined, planes_of, refine as refined};
use squealmap::sweep::sheet::Sheet;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::refine::{COARSE, Settings};
use squealmap::sweep::spec::{Spec, Starts};

use crate::dataset::{Column, Dataset, Named, variable};
use crate::failure::Failure;
use crate::map::attributes;
use crate::sweep::{Engine, Sweep};
use crate::watch::watched;

/// Instances whose values are taken at a time.
const BLOCK: usize = 1 << 16;

/// How a map is refined; what is left out is that of the sweep.
#[derive(Clone, Copy, Debug, FromPyObject)]
pub(crate) struct Choices {
    #[pyo3(item)]
    coarse: Option<usize>,
    #[pyo3(item)]
    sample: Option<usize>,
    #[pyo3(item)]
    seed: Option<u64>,
}

impl Choices {
    fn settings(self, spec: &Spec) -> Result<Settings, Failure> {
        let given = spec.refine.unwrap_or_default();
        let coarse = self.coarse.unwrap_or(given.coarse);
        if !(COARSE.0..=COARSE.1).contains(&coarse) {
            let (least, most) = COARSE;
            return Err(Failure::input(format!("coarse is {coarse} but must be from {least} to {most}")));
        }
        Ok(Settings {
            coarse,
            sample: self.sample.unwrap_or(given.sample),
            seed: self.seed.unwrap_or(given.seed),
        })
    }
}

/// Follows the lines of a sweep. Gives the dataset and what the program says of its engine.
#[pyfunction]
pub(crate) fn refine(
    py: Python<'_>,
    sweep: Sweep,
    engine: Engine,
    choices: Choices,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'_, PyTuple>> {
    let (threads, progress) = (engine.threads, progress.as_ref());
    let (made, raised) = watched(py, threads, progress, move |watch| {
        let mut spec = sweep.spec()?;
        let settings = choices.settings(&spec)?;
        let notes = Mutex::new(Vec::new());
        let note = |text: &str| notes.lock().unwrap_or_else(PoisonError::into_inner).push(text.to_owned());
        // As the program: what is computed here has another place in the sweep, from which checks and boxes are drawn.
        spec.analysis.checked = false;
        if let Starts::Box(_) = spec.analysis.starts {
            note("a refined map has no starts from a box: every instance starts from its kick alone");
            spec.analysis.starts = Starts::One;
        }
        planes_of(&spec.grid)?;
        let options = engine.options(watch, &note)?;
        let began = Instant::now();
        let mut solver = Solver::new(&spec, &options)?;
        let part = tile_of(&spec, options.backend == Backend::Reference);
        let mut known = BTreeMap::new();
        let found = refined(&spec.grid, settings, &mut |instances: &[usize]| {
            watch.expect(known.len() + instances.len());
            let mut labels = Vec::with_capacity(instances.len());
            for block in instances.chunks(part) {
                let mut some = subset(&spec, block);
                some.analysis.starts = spec.analysis.starts;
                let made = solver.records_of(&some, 0..block.len(), &|count| watch.add(count))?;
                if let Some(why) = made.stopped {
                    return Err(Failure::from(why.error(0, block.len())));
                }
                labels.extend(made.records.iter().map(Label::from));
                known.extend(block.iter().copied().zip(made.records));
            }
            Ok(labels)
        })?;
        let [linear, response] = solver.computations();
        let sheet = Sheet::new(&spec, [linear.as_ref(), response.as_ref()]);
        let run = Run {
            threads: rayon::current_num_threads(),
            elapsed: began.elapsed(),
            computed: found.computed,
            reused: None,
            stopped: None,
            tiles: None,
            accuracy: None,
        };
        let document = manifest(sheet, &spec.resolved(), &found.tally, &run)?;
        let mut dataset = arrays(&Arrays::new(sheet), &found, &known);
        let document = String::from_utf8_lossy(&document).into_owned();
        dataset.attributes = attributes("map", &spec.title, document);
        dataset.attributes.push(("refined", account(settings, &found)));
        let notes = std::mem::take(&mut *notes.lock().unwrap_or_else(PoisonError::into_inner));
        Ok((dataset, notes))
    })?;
    if let Some(raised) = raised {
        return Err(raised);
    }
    let (dataset, notes) = made;
    PyTuple::new(py, [dataset.handed(py)?.into_any(), PyList::new(py, notes)?.into_any()])
}

/// What was computed, and the labels of the cells around all other instances.
fn arrays(arrays: &Arrays, found: &Refined, known: &BTreeMap<usize, Record>) -> Dataset {
    let mut dataset = Dataset::of(arrays);
    let dimensions: Vec<&str> = arrays.dimensions.iter().map(|(name, _)| *name).collect();
    let mut values: Vec<Values> = arrays.variables.iter().map(|one| one.values(&[])).collect();
    let mut computed = Vec::with_capacity(found.labels.len());
    for (block, labels) in found.labels.chunks(BLOCK).enumerate() {
        let record = |(at, label): (usize, _)| known.get(&(block * BLOCK + at)).cloned().unwrap_or(label);
        let all = labels.iter().map(|label| Record::from(*label)).enumerate();
        let records: Vec<Record> = all.map(record).collect();
        for (one, all) in arrays.variables.iter().zip(&mut values) {
            match (all, one.values(&records)) {
                (Values::Numbers(all), Values::Numbers(some)) => all.extend(some),
                (Values::Codes(all), Values::Codes(some)) => all.extend(some),
                // A variable has values of one kind.
                (_, _) => {}
            }
        }
        let first = block * BLOCK;
        computed.extend((first..first + labels.len()).map(|at| i8::from(known.contains_key(&at))));
    }
    let of = |(one, values): (&Variable, _)| variable(one, values, &dimensions);
    dataset.variables = arrays.variables.iter().zip(values).map(of).collect();
    let names = vec![(0, "no".to_owned()), (1, "yes".to_owned())];
    let meaning = "whether it was computed; else its labels are those of the cell around it";
    dataset.variables.push(Named::new(
        "computed",
        &dimensions,
        Column::Codes(computed, names),
        ["", meaning],
    ));
    dataset
}

/// How the lines were followed, and what may be missed: JSON.
fn account(settings: Settings, found: &Refined) -> String {
    json!({
        "coarse_cells_per_side": settings.coarse,
        "seed": settings.seed,
        "instances": found.labels.len(),
        "computed": found.computed,
        "sample": found.sampled,
        "sample_with_another_label": found.missed,
        "share_missed_at_most_95_percent": found.missed_at_most(),
    })
    .to_string()
}
