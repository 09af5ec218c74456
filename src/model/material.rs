//! Materials: rows of temperature and law parameters, linear between rows.

use crate::model::Param;

/// What happens outside the range of temperatures of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// An input error.
    Error,
    /// The nearest row.
    Clamp,
}

/// A material: law parameters against temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file as written in the sweep file.
    pub name: String,
    /// Strictly rising temperatures, °C.
    pub temperature: Vec<f64>,
    /// Each law parameter with its value at every temperature.
    pub columns: Vec<(Param, Vec<f64>)>,
    /// What happens outside.
    pub outside: Outside,
}
