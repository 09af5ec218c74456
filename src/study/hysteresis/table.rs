//! The branches of a parameter that rises and falls, as a table; the figure is in `figure.rs`.

use serde::{Deserialize, Serialize};

use crate::results::csv::Table;
use crate::results::figure::heading::Heading;
use crate::results::manifest::described;
use crate::study::error::Result;
use crate::study::hysteresis::follow::{Direction, Hysteresis};
use crate::sweep::columns::{Cell, Column, columns};
use crate::sweep::spec::{Analysis, Spec, Starts};

pub use crate::study::hysteresis::figure::hysteresis_svg;

/// The table of both branches, row by row as they were gone: the branch, the value, and the columns of a map.
///
/// # Errors
/// When the table cannot be written.
pub fn hysteresis_csv(spec: &Spec, hysteresis: &Hysteresis) -> Result<Vec<u8>> {
    let analysis = Analysis {
        linear: true,
        response: true,
        until_settled: spec.settle_limit.is_some(),
        finds_cycles: spec.analysis.finds_cycles,
        checked: false,
        starts: Starts::One,
    };
    let grid = hysteresis.grid();
    // The index of an instance says nothing here.
    let columns: Vec<Column> = columns(&grid, analysis).into_iter().skip(1).collect();
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
