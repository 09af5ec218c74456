//! The branches of a parameter that rises and falls, as a table; the figure is in `figure.rs`.

use serde::{Deserialize, Serialize};

use crate::results::csv::Table;
use crate::results::figure::heading::Heading;
use crate::results::manifest::described;
use crate::study::cycles::special::Special;
use crate::study::error::Result;
use crate::study::hysteresis::follow::{Direction, Hysteresis};
use crate::sweep::columns::{Cell, Column, columns};
use crate::sweep::grid::{Grid, Value};
use crate::sweep::spec::{Analysis, Spec, Starts};

pub use crate::study::hysteresis::figure::hysteresis_svg;

/// The table of both branches, row by row as they were gone: the branch, the value, and the columns of a map.
///
/// # Errors
/// When the table cannot be written.
pub fn hysteresis_csv(spec: &Spec, hysteresis: &Hysteresis) -> Result<Vec<u8>> {
    let grid = hysteresis.grid();
    let columns = columns_of(spec, &grid, spec.analysis.finds_cycles);
    let mut table = Table::new(std::iter::once("branch").chain(columns.iter().map(|column| column.name)))?;
    for direction in Direction::ALL {
        let branch = direction.name().to_owned();
        for at in direction.order(hysteresis.values.len()) {
            let (coordinates, record) = (grid.coordinates(at), &hysteresis.branch(direction)[at]);
            let cell = |column: &Column| -> Cell { column.cell(at, &coordinates, record) };
            let cells = columns.iter().map(|column| cell(column).to_string());
            table.row(std::iter::once(branch.clone()).chain(cells))?;
        }
    }
    Ok(table.finish()?)
}

/// What comes before the columns of a map in the table of cycles.
pub(crate) const OF_CYCLES: [&str; 3] = ["cycle_branch", "unstable_multipliers", "special"];

/// The table of the branches of cycles, point by point along each: the number of the branch from 0 on, how many Floquet multipliers
/// are outside the unit circle, what is special about the point, and the columns of a map.
///
/// # Errors
/// When the table cannot be written.
pub fn cycles_csv(spec: &Spec, hysteresis: &Hysteresis) -> Result<Vec<u8>> {
    let columns = columns_of(spec, &hysteresis.grid(), true);
    let mut table = Table::new(OF_CYCLES.into_iter().chain(columns.iter().map(|column| column.name)))?;
    for (number, branch) in hysteresis.cycles.iter().enumerate() {
        for point in &branch.points {
            let value = Value::Number(point.value);
            let cell = |column: &Column| column.cell(0, &[&value], &point.record).to_string();
            let special = point.special.map_or("", Special::name).to_owned();
            let head = [number.to_string(), point.unstable.to_string(), special];
            table.row(head.into_iter().chain(columns.iter().map(cell)))?;
        }
    }
    Ok(table.finish()?)
}

/// The columns of a map of one response, without the index, which says nothing here.
pub(crate) fn columns_of(spec: &Spec, grid: &Grid, finds_cycles: bool) -> Vec<Column> {
    let analysis = Analysis {
        linear: true,
        response: true,
        until_settled: spec.settle_limit.is_some() || finds_cycles,
        finds_cycles,
        checked: false,
        starts: Starts::One,
    };
    columns(grid, analysis).into_iter().skip(1).collect()
}

/// What the figure needs beside the table: the heading, and which parameter was followed.
#[derive(Deserialize, Serialize)]
pub(crate) struct Document {
    #[serde(flatten)]
    pub(crate) heading: Heading,
    #[serde(default)]
    pub(crate) parameter: String,
}

/// This document as JSON.
///
/// # Errors
/// When it cannot be written.
pub fn document(hysteresis: &Hysteresis, heading: &Heading) -> Result<Vec<u8>> {
    let parameter = hysteresis.param.info().name.to_owned();
    Ok(described(&Document { heading: heading.clone(), parameter })?)
}
