//! The curves as a table, and what their figure needs beside it.

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::results::csv::Table;
use crate::results::manifest::{Sum, Sums, described};
use crate::store::grid_json;
use crate::store::seal::sealed;
use crate::study::curves::seek::PlaneCurves;
use crate::study::cycles::special::Special;
use crate::study::error::Result;
use crate::study::hysteresis::table::columns_of;
use crate::sweep::columns::Column;
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::Spec;

/// The name of the table.
pub(crate) const TABLE: &str = "curves.csv";

/// What comes before the columns of a map.
pub(crate) const OF_CURVES: [&str; 3] = ["curve", "special", "unstable_multipliers"];

/// The table of curves, point by point along each: the number of the curve from 0 on, what is special on it, how many Floquet multipliers
/// are outside the unit circle, and the columns of a map.
///
/// # Errors
/// When the table cannot be written.
pub fn curves_csv(spec: &Spec, planes: &[PlaneCurves]) -> Result<Vec<u8>> {
    let columns = columns_of(spec, &spec.grid, true);
    let mut table = Table::new(OF_CURVES.into_iter().chain(columns.iter().map(|column| column.name)))?;
    let Grid::Axes(axes) = &spec.grid else { return Ok(table.finish()?) };
    let all = planes.iter().flat_map(|plane| plane.curves.iter().map(move |curve| (plane, curve)));
    for (number, (plane, curve)) in all.enumerate() {
        for point in &curve.points {
            let own = plane.params.into_iter().zip(point.values);
            let own = own.map(|(param, value)| (AxisKey::Param(param), Value::Number(value)));
            let here: Vec<(AxisKey, Value)> = own.chain(plane.others.iter().cloned()).collect();
            let of_axis = |key: AxisKey| here.iter().find(|(other, _)| *other == key).map(|(_, value)| value);
            let coordinates: Vec<&Value> = axes.iter().filter_map(|axis| of_axis(axis.key)).collect();
            let cell = |column: &Column| column.cell(0, &coordinates, &point.cycle.record).to_string();
            let head =
                [number.to_string(), curve.special.name().to_owned(), point.cycle.unstable.to_string()];
            table.row(head.into_iter().chain(columns.iter().map(cell)))?;
        }
    }
    Ok(table.finish()?)
}

/// What the figure needs beside the table, and what the curves hold for.
#[derive(Deserialize, Serialize)]
pub(crate) struct Document {
    pub(crate) title: String,
    pub(crate) grid: Json,
    /// The sections of the sweep that say which system it is.
    #[serde(flatten)]
    pub(crate) system: System,
    /// Length and checksum of the table.
    files: Sums,
}

/// The sections of a sweep that say which system it is.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct System {
    pub(crate) model: Json,
    pub(crate) friction: Json,
    pub(crate) belt: Json,
}

impl System {
    /// The section in which another system differs.
    pub(crate) fn differs(&self, other: &System) -> Option<&'static str> {
        let sections = [
            ("model", self.model == other.model),
            ("friction", self.friction == other.friction),
            ("belt", self.belt == other.belt),
        ];
        sections.into_iter().find(|(_, same)| !same).map(|(name, _)| name)
    }
}

/// This document as JSON, beside a `table` of [`curves_csv`].
///
/// # Errors
/// When it cannot be written.
pub fn document(spec: &Spec, table: &[u8]) -> Result<Vec<u8>> {
    let resolved = spec.resolved();
    let section = |name: &str| resolved[name].clone();
    let system = System { model: section("model"), friction: section("friction"), belt: section("belt") };
    let files = Sums::from_iter([(TABLE, Sum::of(table))]);
    let document =
        Document { title: spec.title.clone(), grid: grid_json::to_json(&spec.grid), system, files };
    Ok(sealed(described(&document)?))
}

/// How a curve is named in sentences.
#[must_use]
pub fn named(special: Special) -> &'static str {
    match special {
        Special::Fold => "folds",
        Special::Corner => "folds at a change of contact",
        Special::Doubling => "period doublings",
        Special::Torus => "tori",
        Special::Hopf => "Hopf points",
        Special::Border => "changes of contact",
        Special::End => "ends",
    }
}
