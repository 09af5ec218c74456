//! Eigenvalues along the first numeric axis of a sweep.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use squealmap::results::arrays::Arrays;
use squealmap::study::modes::follow::{Modes, document, modes_of};
use squealmap::sweep::sheet::Sheet;
use squealmap::sweep::spec::Spec;

use crate::dataset::{Column, Dataset, Named};
use crate::failure::Failure;
use crate::map::attributes;
use crate::sweep::Sweep;
use crate::watch::whole;

/// Every mode over the axes of a sweep.
#[pyfunction]
pub(crate) fn modes(py: Python<'_>, sweep: Sweep) -> PyResult<Bound<'_, PyTuple>> {
    whole(py, move |_| {
        let spec = sweep.spec()?;
        let found = modes_of(&spec)?;
        dataset(&spec, &found)
    })?
    .handed(py)
}

fn dataset(spec: &Spec, found: &Modes) -> Result<Dataset, Failure> {
    let arrays = Arrays::new(Sheet::new(spec, [None, None]));
    let mut dataset = Dataset::of(&arrays);
    let count = found.count();
    let mut values = [(); 3].map(|()| vec![f64::NAN; spec.grid.len() * count]);
    for branch in &found.branches {
        for (instance, modes) in branch.instances.iter().zip(&branch.modes) {
            for (k, mode) in modes.iter().flatten().enumerate() {
                let numbers = [mode.frequency(), mode.growth_rate(), mode.fast.unwrap_or(f64::NAN)];
                for (column, number) in values.iter_mut().zip(numbers) {
                    column[instance * count + k] = number;
                }
            }
        }
    }
    let names: Vec<&str> = arrays.dimensions.iter().map(|(name, _)| *name).chain(["mode"]).collect();
    let [frequency, growth, fast] = values.map(Column::Numbers);
    dataset.variables = vec![
        Named::new("frequency", &names, frequency, ["Hz", "imaginary part of the eigenvalue over 2 pi"]),
        Named::new("growth_rate", &names, growth, ["1/s", "real part of the eigenvalue"]),
        Named::new(
            "growth_rate_fast",
            &names,
            fast,
            ["1/s", "the faster decay of an overdamped mode; undefined of others"],
        ),
        critical(&arrays, found),
    ];
    let crossings = found.branches.iter().map(|branch| branch.critical.len()).max().unwrap_or(0);
    dataset.dimensions.extend([("mode".to_owned(), count), ("crossing".to_owned(), crossings)]);
    #[expect(clippy::cast_possible_wrap, reason = "a handful")]
    let numbers = Column::Counts((1..=count as i64).collect());
    let meaning = "number of the mode, followed along the axis";
    dataset.coordinates.push(Named::new("mode", &["mode"], numbers, ["", meaning]));
    let document = String::from_utf8_lossy(&document(spec, found)?).into_owned();
    dataset.attributes = attributes("modes", &spec.title, document);
    Ok(dataset)
}

/// Values of the axis at which the largest growth rate changes sign, over the other axes.
fn critical(arrays: &Arrays, found: &Modes) -> Named {
    let others = arrays.dimensions.iter().enumerate().filter(|(at, _)| *at != found.axis);
    let names: Vec<&str> = others.map(|(_, (name, _))| *name).chain(["crossing"]).collect();
    let most = found.branches.iter().map(|branch| branch.critical.len()).max().unwrap_or(0);
    let padded = |values: &[f64]| {
        let mut values = values.to_vec();
        values.resize(most, f64::NAN);
        values
    };
    let values = found.branches.iter().flat_map(|branch| padded(&branch.critical)).collect();
    let unit = arrays.coordinates.get(found.axis).map_or("1", |one| one.unit);
    let meaning = "values of the axis at which the largest growth rate changes sign, rising";
    Named::new("critical", &names, Column::Numbers(values), [unit, meaning])
}
