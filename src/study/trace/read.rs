//! `trace.csv` and `trace.json`: a trajectory read back.

use crate::engine::outcome::Outcome;
use crate::model::contact::ContactState;
use crate::results::figure::heading::Heading;
use crate::results::read::folder::{Folder, Table, Why, headed};
use crate::study::error::Result;
use crate::study::trace::run::{Trace, TraceRow};
use crate::study::trace::table::{COLUMNS, Document};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["trace.csv", "trace.json"];

/// A trajectory and its heading; of its outcome the frequency of the response is read, which the figure shows the last
/// periods by.
pub(crate) fn read(folder: Folder<'_>) -> Result<(Trace, Heading)> {
    let table = folder.table(FILES[0])?;
    let document = headed(folder.json(FILES[1])?).map_err(|why| folder.bad(FILES[1], why))?;
    let Document { heading, response_frequency, rows: all } = document;
    let rows = rows(&table).map_err(|why| folder.bad(FILES[0], why))?;
    if let Some(all) = all {
        folder.has_rows(FILES, &table, all)?;
    }
    Ok((Trace { rows, outcome: Outcome { response_frequency, ..Outcome::default() } }, heading))
}

fn rows(table: &Table) -> Why<Vec<TraceRow>> {
    let names: [&str; 12] = std::array::from_fn(|k| COLUMNS[k]);
    let state = table.column(COLUMNS[12])?;
    let states = table.rows.iter().map(|row| row.get(state).unwrap_or_default());
    table
        .numbers(names)?
        .into_iter()
        .zip(states)
        .map(|([t, x2, y2, y1, vx2, vy2, vy1, ax2, ay2, ay1, normal_force, tangential_force], name)| {
            let state = ContactState::ALL
                .into_iter()
                .find(|state| state.name() == name)
                .ok_or_else(|| format!("`{name}` is no state of a contact"))?;
            Ok(TraceRow {
                t,
                position: [x2, y2, y1],
                velocity: [vx2, vy2, vy1],
                acceleration: [ax2, ay2, ay1],
                normal_force,
                tangential_force,
                state,
            })
        })
        .collect()
}
