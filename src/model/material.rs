//! Materials: rows of temperature and law parameters, linear between rows.

use crate::model::Param;

/// How a material continues outside its range of temperatures.
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
    /// How it continues outside.
    pub outside: Outside,
}

impl Material {
    /// The lowest and the highest temperature, °C.
    ///
    /// # Panics
    /// Without a row, which validation excludes.
    #[must_use]
    pub fn temperatures(&self) -> (f64, f64) {
        let low = self.temperature.first().expect("a validated material has a row");
        let high = self.temperature.last().expect("a validated material has a row");
        (*low, *high)
    }

    /// Whether the material may be read at `temperature` (°C).
    #[must_use]
    pub fn covers(&self, temperature: f64) -> bool {
        let (low, high) = self.temperatures();
        self.outside == Outside::Clamp || (low..=high).contains(&temperature)
    }

    /// Whether the material gives `param`.
    #[must_use]
    pub fn gives(&self, param: Param) -> bool {
        self.columns.iter().any(|(column, _)| *column == param)
    }

    /// Every law parameter at `temperature` (°C): linear between rows, the nearest row outside.
    pub fn at(&self, temperature: f64) -> impl Iterator<Item = (Param, f64)> {
        // Rows `lower` and `upper` enclose the temperature; `part` is the way between them, 0..1.
        let upper =
            self.temperature.partition_point(|&row| row < temperature).min(self.temperature.len() - 1);
        let lower = upper.saturating_sub(1);
        let (t0, t1) = (self.temperature[lower], self.temperature[upper]);
        let part = if t1 > t0 { ((temperature - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
        self.columns.iter().map(move |(param, values)| {
            let (v0, v1) = (values[lower], values[upper]);
            (*param, if part < 1.0 { v0 + (v1 - v0) * part } else { v1 })
        })
    }
}
