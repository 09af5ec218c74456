//! A column of a table, read back.

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
    /// Whether its values are angles in degrees: −180 and 180 are the same angle then.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        self.unit == "deg"
    }
}
