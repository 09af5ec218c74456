//! `tradeoff.csv` and `tradeoff.json`: speed against error read back.

use crate::results::read::folder::{Folder, text};
use crate::study::error::Result;
use crate::sweep::accuracy::row::{Row, from_csv};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["tradeoff.csv", "tradeoff.json"];

/// The title of the sweep, and the rows.
pub(crate) fn read(folder: Folder<'_>) -> Result<(String, Vec<Row>)> {
    let rows = folder.text(FILES[0])?;
    let title = text(&folder.json(FILES[1])?["title"]);
    let rows = from_csv(rows.as_bytes()).map_err(|why| folder.bad(FILES[0], why))?;
    if rows.is_empty() {
        return Err(folder.bad(FILES[0], "has no rows").into());
    }
    Ok((title, rows))
}
