//! `trace`: one instance in full, as a table; the figure is in `figure.rs`.

use serde::{Deserialize, Serialize};

use crate::results::csv::Table;
use crate::results::figure::heading::Heading;
use crate::results::manifest::described;
use crate::study::error::Result;
use crate::study::trace::run::{Trace, TraceRow};

pub use crate::study::trace::figure::trace_svg;

/// The columns of a trace, SI units.
pub const COLUMNS: [&str; 13] =
    ["t", "x2", "y2", "y1", "vx2", "vy2", "vy1", "ax2", "ay2", "ay1", "N", "T", "state"];

/// The table of a trajectory, one row per sample.
///
/// # Errors
/// When the table cannot be written.
pub fn trace_csv(trace: &Trace) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.into_iter())?;
    for row in &trace.rows {
        let cells = numbers(row).map(|x| crate::sweep::columns::Cell::from(x).to_string());
        table.row(cells.into_iter().chain(std::iter::once(row.state.name().to_owned())))?;
    }
    Ok(table.finish()?)
}

/// What the figure needs beside the table.
#[derive(Deserialize, Serialize)]
pub(crate) struct Document {
    #[serde(flatten)]
    pub(crate) heading: Heading,
    /// The frequency of the response, Hz.
    pub(crate) response_frequency: Option<f64>,
    /// The number of rows of the table; directories of before have none.
    pub(crate) rows: Option<usize>,
}

/// This document as JSON.
///
/// # Errors
/// When it cannot be written.
pub fn document(trace: &Trace, heading: &Heading) -> Result<Vec<u8>> {
    let (response_frequency, rows) = (trace.outcome.response_frequency, Some(trace.rows.len()));
    Ok(described(&Document { heading: heading.clone(), response_frequency, rows })?)
}

/// The numbers of a sample in the order of [`COLUMNS`].
fn numbers(row: &TraceRow) -> [f64; 12] {
    let ([x2, y2, y1], [vx2, vy2, vy1], [ax2, ay2, ay1]) = (row.position, row.velocity, row.acceleration);
    [row.t, x2, y2, y1, vx2, vy2, vy1, ax2, ay2, ay1, row.normal_force, row.tangential_force]
}
