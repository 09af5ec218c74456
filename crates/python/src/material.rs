//! Measured friction as a material.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use squealmap::model::friction::LawKind;
use squealmap::study::error::Error;
use squealmap::study::fit::Fit;
use squealmap::study::fit::files::{Files, files};
use squealmap::study::fit::made::{Wanted, made};
use squealmap::study::fit::table::residuals_csv;
use squealmap::study::fit::told::compared;
use squealmap_identify::{Channel, FrictionColumn, Settings};

use crate::dataset::{Column, Dataset, Named};
use crate::failure::Failure;
use crate::map::attributes;
use crate::sweep::named;
use crate::table::columns;
use crate::watch::whole;

/// How the points are read and fitted.
#[derive(Debug, FromPyObject)]
pub(crate) struct Choices {
    #[pyo3(item)]
    law: String,
    #[pyo3(item)]
    law_velocity: Option<f64>,
    #[pyo3(item)]
    friction: Option<String>,
    #[pyo3(item)]
    tangential_force: Option<String>,
    #[pyo3(item)]
    normal_force: Option<String>,
    #[pyo3(item)]
    tangential_acceleration: Option<String>,
    #[pyo3(item)]
    rate: Option<f64>,
    #[pyo3(item)]
    velocity: Option<String>,
    #[pyo3(item)]
    temperature: Option<String>,
    #[pyo3(item)]
    at_temperature: Vec<f64>,
    #[pyo3(item)]
    temperatures: Vec<f64>,
}

impl Choices {
    /// The law.
    ///
    /// # Errors
    /// For a name or a number that is none.
    fn law(&self) -> Result<Wanted, Failure> {
        for (name, value) in [("law_velocity", self.law_velocity), ("rate", self.rate)] {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && value.is_finite())) {
                return Err(Failure::input(format!(
                    "{name} is {value} but must be a finite number greater than 0"
                )));
            }
        }
        let temperatures = self.at_temperature.iter().chain(&self.temperatures);
        if let Some(value) = temperatures.into_iter().find(|value| !value.is_finite()) {
            return Err(Failure::input(format!("a temperature is {value} but must be a finite number")));
        }
        named("law", &self.law, &Wanted::ALL, Wanted::name)
    }
}

/// The material, the residuals, the text of the material's file, the laws beside each other, and remarks.
#[pyfunction]
pub(crate) fn fit(py: Python<'_>, paths: Vec<PathBuf>, choices: Choices) -> PyResult<Bound<'_, PyTuple>> {
    let (material, residuals, text, notes) = whole(py, move |_| {
        let law = choices.law()?;
        let mut settings = Settings { rate: choices.rate, ..Settings::default() };
        for (channel, column) in [
            (Channel::TangentialForce, choices.tangential_force),
            (Channel::NormalForce, choices.normal_force),
            (Channel::Velocity, choices.velocity),
            (Channel::Temperature, choices.temperature),
            (Channel::TangentialAcceleration, choices.tangential_acceleration),
        ] {
            settings.columns[channel as usize] = column;
        }
        let friction = choices.friction.map_or(FrictionColumn::Forces, FrictionColumn::Named);
        let Files { points, name, remarks: mut notes } =
            files(&paths, &settings, &friction, &choices.at_temperature)?;
        let made = made(&points, &name, law, &choices.temperatures, choices.law_velocity)
            .map_err(|fault| Error::Fit { name: name.clone(), fault: fault.into() })?;
        notes.extend(made.warnings);
        let residuals = rows_of(&residuals_csv(&made.fit, &points)?, "residuals", "point", &name)?;
        let material = match made.fit.law {
            LawKind::Table => rows_of(made.text.as_bytes(), "material", "row", &name)?,
            _ => material(made.fit, &name),
        };
        Ok((material, residuals, [made.text, compared(&made.candidates)], notes))
    })?;
    let [text, comparison] = text;
    let comparison = comparison.into_pyobject(py)?;
    let text = text.into_pyobject(py)?;
    let notes = PyList::new(py, notes)?;
    PyTuple::new(
        py,
        [
            material.handed(py)?.into_any(),
            residuals.handed(py)?.into_any(),
            text.into_any(),
            comparison.into_any(),
            notes.into_any(),
        ],
    )
}

/// The parameters of the law over the temperature, each with its standard error where the points tell it.
fn material(fit: Fit, name: &str) -> Dataset {
    let temperature = Column::Numbers(fit.temperature.clone());
    let over = ["temperature"];
    let mut variables = Vec::new();
    for ((param, values), errors) in fit.columns.into_iter().zip(fit.errors) {
        let info = param.info();
        let unit = if info.unit.is_empty() { "1" } else { info.unit };
        variables.push(Named::new(info.name, &over, Column::Numbers(values), [unit, info.meaning]));
        if let Some(errors) = errors {
            let (name, meaning) =
                (format!("{}_error", info.name), format!("standard error of {}", info.name));
            variables.push(Named::new(name, &over, Column::Numbers(errors), [unit, &meaning]));
        }
    }
    let mut attributes = attributes("material", name, String::new());
    attributes.extend([("law", fit.law.name().to_owned()), ("points", fit.points.to_string())]);
    attributes.push(("residual", fit.residual.to_string()));
    Dataset {
        dimensions: vec![("temperature".to_owned(), fit.temperature.len())],
        coordinates: vec![Named::new("temperature", &over, temperature, ["degC", "temperature"])],
        variables,
        attributes,
    }
}

/// A table of the program, row by row.
fn rows_of(table: &[u8], kind: &str, row: &'static str, name: &str) -> Result<Dataset, Failure> {
    let columns = columns(table)?;
    let unit = |name: &str| match name {
        "velocity" => "m/s",
        "temperature" => "degC",
        _ => "1",
    };
    let rows = columns.first().map_or(0, |(_, column)| match column {
        Column::Numbers(numbers) => numbers.len(),
        _ => 0,
    });
    let named = columns.into_iter().map(|(name, column)| {
        let said = [unit(&name), ""];
        Named::new(name, &[row], column, said)
    });
    Ok(Dataset {
        dimensions: vec![(row.to_owned(), rows)],
        variables: named.collect(),
        attributes: attributes(kind, name, String::new()),
        ..Dataset::default()
    })
}
