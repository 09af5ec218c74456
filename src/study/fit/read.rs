//! `residuals.csv` and `fit.json`: a fit read back, to be drawn.

use crate::results::read::folder::{Folder, headed};
use crate::study::error::Result;
use crate::study::fit::course::{Document, Shown};
use crate::study::fit::table::RESIDUALS;

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["residuals.csv", "fit.json"];

/// Reads a fit.
pub(crate) fn read(folder: Folder<'_>) -> Result<Shown> {
    let table = folder.table(FILES[0])?;
    let Document { title, law, points: all, courses } =
        headed(folder.json(FILES[1])?).map_err(|why| folder.bad(FILES[1], why))?;
    folder.has_rows(FILES, &table, all)?;
    let [velocity, temperature, friction, _, residual] = RESIDUALS;
    let points = table.numbers([velocity, temperature, friction, residual]);
    let mut points = points.map_err(|why| folder.bad(FILES[0], why))?;
    if let Some(row) = points.iter().position(|point| point.iter().any(|value| !value.is_finite())) {
        return Err(folder.bad(FILES[0], format!("has no finite number in row {}", row + 1)).into());
    }
    for point in &mut points {
        point[0] = point[0].abs();
    }
    Ok(Shown { title, law, courses, points })
}
