//! A column of a table, read back.

use crate::sweep::columns::{Column, Reading, find};

/// A column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberColumn {
    /// The header.
    pub name: String,
    /// The SI unit; empty when dimensionless.
    pub unit: String,
    /// One line of explanation.
    pub meaning: String,
    /// One value per instance; `None` where it is undefined.
    pub values: Vec<Option<f64>>,
}

impl NumberColumn {
    /// Its row in the table of columns; `None` of a column that no map has.
    #[must_use]
    pub fn row(&self) -> Option<&'static Column> {
        find(&self.name)
    }

    /// How its values are read.
    #[must_use]
    pub fn reading(&self) -> Reading {
        self.row().map_or(Reading::Linear, |row| row.reading)
    }

    /// Whether its values are angles in degrees, of which −180 and 180 are one.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        self.unit == "deg" && self.reading() != Reading::HalfTurn
    }
}
