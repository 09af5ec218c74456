//! A sweep as labelled arrays: dimensions, coordinates and variables, for formats of arrays.
//!
//! Axes are dimensions, in their order; tuples have the one dimension `instance`. What is a name in `map.csv` is a
//! code here, explained by `flag_values` and `flag_meanings` as in the CF conventions.

use crate::engine::record::Record;
use crate::sweep::columns::{Cell, Class, Column, Values as Source, columns};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::sheet::Sheet;

/// The dimension of tuples, and of a sweep without axes.
pub const INSTANCE: &str = "instance";

/// The kind of numbers that a variable holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Numbers in the unit of the variable; undefined ones are NaN.
    Numbers,
    /// Codes with their names.
    Codes(Vec<(i8, String)>),
}

/// One variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name.
    pub name: &'static str,
    /// Its SI unit, `1` when dimensionless.
    pub unit: &'static str,
    /// One line of explanation.
    pub meaning: &'static str,
    /// What its numbers are.
    pub kind: Kind,
    column: Column,
}

/// A coordinate: the values along a dimension.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Its name; that of its dimension, where it is an axis.
    pub name: &'static str,
    /// Its SI unit, `1` when dimensionless.
    pub unit: &'static str,
    /// One line of explanation.
    pub meaning: &'static str,
    /// Which dimension it runs along.
    pub dimension: usize,
    /// Its values; numbers of `names`, from 0 on, where there are any.
    pub values: Vec<f64>,
    /// The names of laws or materials.
    pub names: Vec<String>,
}

/// The arrays of a sweep.
#[derive(Clone, Debug)]
pub struct Arrays {
    /// Names and lengths of the dimensions; the first varies slowest.
    pub dimensions: Vec<(&'static str, usize)>,
    /// The coordinates.
    pub coordinates: Vec<Coordinate>,
    /// The variables, each over all dimensions.
    pub variables: Vec<Variable>,
}

/// The values of some instances.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Values of a variable of [`Kind::Numbers`].
    Numbers(Vec<f64>),
    /// Values of a variable of [`Kind::Codes`].
    Codes(Vec<i8>),
}

impl Arrays {
    /// The arrays of a sweep.
    #[must_use]
    pub fn new(sheet: Sheet) -> Arrays {
        let (dimensions, coordinates) = match sheet.grid {
            Grid::Axes(axes) if !axes.is_empty() => {
                let coordinates = axes.iter().enumerate().map(|(at, axis)| along(at, axis)).collect();
                (axes.iter().map(|axis| (axis.key.name(), axis.values.len())).collect(), coordinates)
            }
            Grid::Axes(_) => (vec![(INSTANCE, 1)], Vec::new()),
            Grid::Tuples { keys, rows } => {
                let column = |at: usize| rows.iter().map(|row| row[at].clone()).collect();
                let axis = |(at, key): (usize, &AxisKey)| Axis { key: *key, values: column(at), log: false };
                let coordinates = keys.iter().enumerate().map(axis).map(|axis| along(0, &axis)).collect();
                (vec![(INSTANCE, rows.len())], coordinates)
            }
        };
        let variables = columns(sheet.grid, sheet.analysis)
            .into_iter()
            .filter_map(|column| {
                let (name, unit, meaning) = (column.name, unit(column.unit), column.meaning);
                Some(Variable { name, unit, meaning, kind: kind(column.values()?), column })
            })
            .collect();
        Arrays { dimensions, coordinates, variables }
    }
}

impl Variable {
    /// Its values of some records.
    #[must_use]
    pub fn values(&self, records: &[Record]) -> Values {
        match self.column.values().and_then(Source::class) {
            None => Values::Numbers(records.iter().map(|record| self.number(record)).collect()),
            Some(class) => {
                Values::Codes(records.iter().map(|record| class.code(self.column.of(record))).collect())
            }
        }
    }

    fn number(&self, record: &Record) -> f64 {
        match self.column.cell(0, &[], record) {
            Cell::Number(number) => number,
            Cell::Count(count) => count as f64,
            Cell::Empty | Cell::Text(_) => f64::NAN,
        }
    }
}

/// A dimensionless unit has a name in formats of arrays.
fn unit(unit: &'static str) -> &'static str {
    if unit.is_empty() { "1" } else { unit }
}

/// What the numbers of a variable are; of yes and no, their codes are called so.
fn kind(values: Source) -> Kind {
    let codes = |class: &Class, names: &mut dyn Iterator<Item = (i8, &'static str)>| {
        let undefined = class.undefined().map(|code| (code, "undefined"));
        Kind::Codes(undefined.into_iter().chain(names).map(|(code, name)| (code, name.to_owned())).collect())
    };
    match values {
        Source::Name(class) => codes(class, &mut class.codes()),
        Source::Flag(class) => {
            codes(class, &mut class.codes().zip(["no", "yes"]).map(|((code, _), name)| (code, name)))
        }
        Source::Number(_) | Source::Count(_) | Source::Share(_) | Source::Summary(_) => Kind::Numbers,
    }
}

/// The coordinate of an axis along a dimension.
fn along(dimension: usize, axis: &Axis) -> Coordinate {
    let (unit_name, meaning) = match axis.key {
        AxisKey::Param(param) => (param.info().unit, param.info().meaning),
        AxisKey::Law => ("", "friction law"),
        AxisKey::Material => ("", "material file"),
    };
    let mut names: Vec<String> = Vec::new();
    let mut number = |value: &Value| match value {
        Value::Number(number) => *number,
        Value::Text(text) => {
            let at = names.iter().position(|name| name == text.as_str()).unwrap_or_else(|| {
                names.push(text.to_string());
                names.len() - 1
            });
            at as f64
        }
    };
    let values = axis.values.iter().map(&mut number).collect();
    Coordinate { name: axis.key.name(), unit: unit(unit_name), meaning, dimension, values, names }
}

/// Names in one text, separated by blanks, which none of them may hold.
#[must_use]
pub fn flag_meanings<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| name.replace(char::is_whitespace, "_")).collect::<Vec<_>>().join(" ")
}
