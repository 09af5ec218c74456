//! Bodies in sliding contact by finite elements.

use std::collections::BTreeSet;
use std::panic::resume_unwind;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use squealmap::study::fem::{of_study, open};
use squealmap::version::program;
use squealmap_fem::study::{COLUMNS, Study, compute, manifest, table};

use crate::dataset::{Column, Dataset, Named};
use crate::failure::Failure;
use crate::map::attributes;
use crate::table::columns;
use crate::watch::whole;

/// Modes over friction.
#[pyfunction]
pub(crate) fn fem(py: Python<'_>, file: PathBuf) -> PyResult<Bound<'_, PyTuple>> {
    whole(py, move |watch| {
        let (study, text) = open(&file)?;
        let mut step = |_: &str| {
            if watch.is_cancelled() {
                // Nobody hears of it: the exception that stops the work is given.
                resume_unwind(Box::new("stopped"));
            }
        };
        let outcome = compute(&study, &mut step).map_err(|why| of_study(&file, &text, &why))?;
        let manifest = manifest(&study, &outcome, &text, &program());
        let manifest = String::from_utf8_lossy(&manifest).into_owned();
        dataset(&study, &table(&study, &outcome), manifest)
    })?
    .handed(py)
}

/// The table, which has a row for every coefficient of friction and mode, over both.
fn dataset(study: &Study, table: &[u8], manifest: String) -> Result<Dataset, Failure> {
    let mut dataset = Dataset::default();
    for (name, column) in columns(table)? {
        let Column::Numbers(numbers) = column else { continue };
        let said = COLUMNS.iter().find(|one| one.name == name);
        let (unit, meaning) = said.map_or(("1", ""), |one| (one.unit, one.meaning));
        let unit = if unit.is_empty() { "1" } else { unit };
        #[expect(clippy::cast_possible_truncation, reason = "whole numbers")]
        let whole = |numbers: &[f64]| numbers.iter().map(|number| *number as i64).collect();
        match name.as_str() {
            "mu" => {
                let mus = Column::Numbers(study.mus.clone());
                dataset.coordinates.push(Named::new("mu", &["mu"], mus, [unit, meaning]));
                dataset.dimensions.push(("mu".to_owned(), study.mus.len()));
            }
            "mode" => {
                let modes: Vec<i64> = whole(&numbers);
                let modes: Vec<i64> = modes.into_iter().collect::<BTreeSet<_>>().into_iter().collect();
                dataset.dimensions.push(("mode".to_owned(), modes.len()));
                let modes = Column::Counts(modes);
                dataset.coordinates.push(Named::new("mode", &["mode"], modes, ["", meaning]));
            }
            "unstable" | "direct" => {
                let yes = Column::Counts(whole(&numbers));
                dataset.variables.push(Named::new(name, &["mu", "mode"], yes, ["", meaning]));
            }
            _ => {
                let numbers = Column::Numbers(numbers);
                dataset.variables.push(Named::new(name, &["mu", "mode"], numbers, [unit, meaning]));
            }
        }
    }
    dataset.attributes = attributes("fem", &study.document.title, manifest);
    Ok(dataset)
}
