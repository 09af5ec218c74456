//! `strokes.csv` and `campaign.json`: a campaign read back.

use serde::{Deserialize, Serialize};

use crate::results::manifest::described;
use crate::results::read::folder::{Folder, Table, Why, headed};
use crate::study::campaign::row::{DIRECTIONS, Said, VelocityLaw};
use crate::study::error::Result;
use crate::study::identify::shown::Colour;
use squealmap_input::quote::quoted;

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["strokes.csv", "campaign.json"];

/// What the figure needs beside the table.
#[derive(Deserialize, Serialize)]
struct Document {
    title: String,
    /// The number of rows of the table.
    strokes: usize,
}

/// `campaign.json` of a campaign whose table has so many rows.
///
/// # Errors
/// When it cannot be written.
pub fn document(title: &str, strokes: usize) -> Result<Vec<u8>> {
    Ok(described(&Document { title: title.to_owned(), strokes })?)
}

/// The title of a campaign, and what its strokes say; those that say nothing are left out.
pub(crate) fn read(folder: Folder<'_>) -> Result<(String, Vec<Said>)> {
    let table = folder.table(FILES[0])?;
    let Document { title, strokes } =
        headed(folder.json(FILES[1])?).map_err(|why| folder.bad(FILES[1], why))?;
    folder.has_rows(FILES, &table, strokes)?;
    Ok((title, said(&table).map_err(|why| folder.bad(FILES[0], why))?))
}

fn said(table: &Table) -> Why<Vec<Said>> {
    let numbers =
        ["start", "end", "temperature", "velocity", "friction", "vibrating", "frequency", "amplitude"];
    let numbers = table.numbers(numbers)?;
    let shares = table.numbers(Colour::ALL.map(Colour::name))?;
    let mut all = Vec::new();
    for (number, ((row, numbers), shares)) in table.rows.iter().zip(numbers).zip(shares).enumerate() {
        let status = table.cell(row, "status");
        if status.is_empty() {
            return Err(format!("has no `status` in row {}", number + 1));
        }
        if status != "ok" {
            continue;
        }
        // An empty cell is what was not recorded.
        let strange = |name: &&&str| {
            let value = table.cell(row, name).parse::<f64>();
            value.is_ok_and(|value| !(value.is_finite() && value >= 0.0))
        };
        if let Some(name) = ["velocity", "frequency", "amplitude"].iter().find(strange) {
            let value = quoted(table.cell(row, name));
            return Err(format!("has `{value}` as `{name}` in row {}, which is none", number + 1));
        }
        let direction = table.cell(row, "direction");
        if !DIRECTIONS.contains(&direction) {
            return Err(format!("has `{}` as `direction` in row {}", quoted(direction), number + 1));
        }
        let [start, end, temperature, speed, friction, vibrating, frequency, amplitude] = numbers;
        let known = |value: f64| value.is_finite().then_some(value);
        let part = |value: &f64| (0.0..=1.0 + 1e-9).contains(value);
        if !(end > start && part(&vibrating) && shares.iter().all(part)) {
            return Err(format!("has a stroke from {start} to {end} s whose parts of the time are no parts"));
        }
        let name = table.cell(row, "velocity_law");
        let law = VelocityLaw::ALL.into_iter().find(|law| law.name() == name);
        if law.is_none() && !name.is_empty() {
            return Err(format!("`velocity_law` is `{name}`, which is none"));
        }
        all.push(Said {
            time: [start, end],
            forward: direction == DIRECTIONS[0],
            law,
            speed: known(speed),
            temperature: known(temperature),
            friction: known(friction),
            vibrating,
            vibration: known(frequency)
                .zip(known(amplitude))
                .map(|(frequency, amplitude)| [frequency, amplitude]),
            shares,
        });
    }
    Ok(all)
}
