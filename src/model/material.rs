//! Materials: rows of temperature and law parameters, or a table of friction at each temperature; linear between temperatures.

use std::sync::Arc;

use crate::model::friction::{FrictionLaw, LawKind, MuTable};
use crate::model::{Param, Params};

/// How a material continues outside its range of temperatures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// An input error.
    Error,
    /// The nearest row.
    Clamp,
}

/// A material: law parameters, or tables of friction, against temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file as written in the sweep file.
    pub name: String,
    /// Strictly rising temperatures, °C.
    pub temperature: Vec<f64>,
    /// Each law parameter with its value at every temperature; none where there are tables.
    pub columns: Vec<(Param, Vec<f64>)>,
    /// The table of friction at every temperature; none where there are law parameters.
    pub tables: Vec<Arc<MuTable>>,
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

    /// Whether it holds tables of friction, which the law `table` reads.
    #[must_use]
    pub fn has_tables(&self) -> bool {
        !self.tables.is_empty()
    }

    /// Every law parameter at `temperature` (°C): linear between rows, the nearest row outside.
    pub fn at(&self, temperature: f64) -> impl Iterator<Item = (Param, f64)> {
        let (lower, upper, part) = self.between(temperature);
        self.columns.iter().map(move |(param, values)| {
            let (v0, v1) = (values[lower], values[upper]);
            (*param, if part < 1.0 { v0 + (v1 - v0) * part } else { v1 })
        })
    }

    /// The table of friction at `temperature` (°C): that of a row as it is, between two rows linear at equal velocity, the
    /// nearest row outside. `None` where there are no tables.
    #[must_use]
    pub fn table_at(&self, temperature: f64) -> Option<Arc<MuTable>> {
        if self.tables.is_empty() {
            return None;
        }
        let (lower, upper, part) = self.between(temperature);
        let (colder, hotter) = (&self.tables[lower], &self.tables[upper]);
        Some(if part < 1.0 { Arc::new(colder.mixed(hotter, part)) } else { Arc::clone(hotter) })
    }

    /// The law `kind` at `temperature` (°C), whose parameters it puts into `params`; `table` is read where it has none itself.
    #[must_use]
    pub fn law_at(
        &self,
        temperature: f64,
        kind: LawKind,
        params: &mut Params,
        table: Option<&Arc<MuTable>>,
    ) -> FrictionLaw {
        for (param, value) in self.at(temperature) {
            params.set(param, value);
        }
        let own = self.table_at(temperature);
        kind.with(params, own.as_ref().or(table))
    }

    /// Most rows that a table has at any temperature; 0 where there are no tables.
    #[must_use]
    pub fn most_rows(&self) -> usize {
        let own = self.tables.iter().map(|table| table.velocity.len());
        let between = self.tables.windows(2).map(|pair| pair[0].mixed(&pair[1], 0.5).velocity.len());
        own.chain(between).max().unwrap_or(0)
    }

    /// The rows that enclose a temperature, and the part of the way from the lower to the upper one, 0..1.
    fn between(&self, temperature: f64) -> (usize, usize, f64) {
        let upper =
            self.temperature.partition_point(|&row| row < temperature).min(self.temperature.len() - 1);
        let lower = upper.saturating_sub(1);
        let (t0, t1) = (self.temperature[lower], self.temperature[upper]);
        let part = if t1 > t0 { ((temperature - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
        (lower, upper, part)
    }
}
