//! Columns as Python takes them: every array owns the memory in which it was computed.

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use squealmap::results::arrays::{Arrays, Coordinate, Kind, Values, Variable, flag_meanings};

/// The values of a column, in the order of its dimensions, the last varying fastest.
#[derive(Debug)]
pub(crate) enum Column {
    /// Numbers; undefined ones are NaN.
    Numbers(Vec<f64>),
    /// Numbers of less precision.
    Singles(Vec<f32>),
    /// Codes with their names.
    Codes(Vec<i8>, Vec<(i8, String)>),
    /// Whole numbers.
    Counts(Vec<i64>),
    /// Words.
    Words(Vec<String>),
}

/// A column with its name, dimensions, unit and meaning.
#[derive(Debug)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) dimensions: Vec<String>,
    pub(crate) column: Column,
    /// Its SI unit, `1` when dimensionless; empty of words and codes.
    pub(crate) unit: String,
    pub(crate) meaning: String,
}

impl Named {
    /// A column over `dimensions` with unit and meaning.
    pub(crate) fn new(
        name: impl Into<String>,
        dimensions: &[&str],
        column: Column,
        [unit, meaning]: [&str; 2],
    ) -> Named {
        let dimensions = dimensions.iter().map(|one| (*one).to_owned()).collect();
        Named { name: name.into(), dimensions, column, unit: unit.to_owned(), meaning: meaning.to_owned() }
    }

    /// `(name, dimensions, values, attributes)`.
    fn handed(self, py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
        let attributes = PyDict::new(py);
        let mut unit = Some(self.unit).filter(|unit| !unit.is_empty());
        let values = match self.column {
            Column::Numbers(numbers) => numbers.into_pyarray(py).into_any(),
            Column::Singles(numbers) => numbers.into_pyarray(py).into_any(),
            Column::Counts(numbers) => numbers.into_pyarray(py).into_any(),
            Column::Words(words) => PyList::new(py, words)?.into_any(),
            Column::Codes(codes, names) => {
                unit = None;
                let values: Vec<i8> = names.iter().map(|(code, _)| *code).collect();
                attributes.set_item("flag_values", values.into_pyarray(py))?;
                let names = names.iter().map(|(_, name)| name.as_str());
                attributes.set_item("flag_meanings", flag_meanings(names))?;
                codes.into_pyarray(py).into_any()
            }
        };
        if let Some(unit) = unit {
            attributes.set_item("units", unit)?;
        }
        if !self.meaning.is_empty() {
            attributes.set_item("long_name", self.meaning)?;
        }
        let dimensions = PyTuple::new(py, self.dimensions)?;
        PyTuple::new(
            py,
            [self.name.into_pyobject(py)?.into_any(), dimensions.into_any(), values, attributes.into_any()],
        )
    }
}

/// Columns over named dimensions.
#[derive(Debug, Default)]
pub(crate) struct Dataset {
    pub(crate) dimensions: Vec<(String, usize)>,
    pub(crate) coordinates: Vec<Named>,
    pub(crate) variables: Vec<Named>,
    pub(crate) attributes: Vec<(&'static str, String)>,
}

impl Dataset {
    /// The dimensions and coordinates of a sweep, without variables.
    pub(crate) fn of(arrays: &Arrays) -> Dataset {
        let dimensions = arrays.dimensions.iter().map(|(name, length)| ((*name).to_owned(), *length));
        let coordinate =
            |one: &Coordinate| coordinate(one, arrays.dimensions.get(one.dimension).map(|(name, _)| *name));
        Dataset {
            dimensions: dimensions.collect(),
            coordinates: arrays.coordinates.iter().map(coordinate).collect(),
            ..Dataset::default()
        }
    }

    /// `(dimensions, coordinates, variables, attributes)`.
    pub(crate) fn handed(self, py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
        let all = |named: Vec<Named>| {
            let handed: PyResult<Vec<_>> = named.into_iter().map(|one| one.handed(py)).collect();
            PyList::new(py, handed?)
        };
        let dimensions = PyList::new(py, self.dimensions)?;
        let attributes = PyDict::new(py);
        for (name, value) in self.attributes {
            attributes.set_item(name, value)?;
        }
        let [coordinates, variables] = [all(self.coordinates)?, all(self.variables)?];
        PyTuple::new(
            py,
            [dimensions.into_any(), coordinates.into_any(), variables.into_any(), attributes.into_any()],
        )
    }
}

/// A coordinate of a sweep; laws and materials by their names.
fn coordinate(one: &Coordinate, dimension: Option<&str>) -> Named {
    let column = if one.names.is_empty() {
        Column::Numbers(one.values.clone())
    } else {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of names")]
        let word = |value: &f64| one.names[*value as usize].clone();
        Column::Words(one.values.iter().map(word).collect())
    };
    let unit = if one.names.is_empty() { one.unit } else { "" };
    Named::new(one.name, dimension.as_slice(), column, [unit, one.meaning])
}

/// A variable of a sweep with some of its values, over `dimensions`.
pub(crate) fn variable(one: &Variable, values: Values, dimensions: &[&str]) -> Named {
    let column = match (values, &one.kind) {
        (Values::Codes(codes), Kind::Codes(names)) => Column::Codes(codes, names.clone()),
        (Values::Codes(codes), Kind::Numbers) => Column::Codes(codes, Vec::new()),
        (Values::Numbers(numbers), _) => Column::Numbers(numbers),
    };
    Named::new(one.name, dimensions, column, [one.unit, one.meaning])
}
