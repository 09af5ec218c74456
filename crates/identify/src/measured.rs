//! A file of measured friction → points, whether it is a table of points or a record of a stroke that may squeal.

use std::io::Read;

use crate::analysis::identify;
use crate::channel::Channel;
use crate::fault::Unfit;
use crate::points::{FrictionColumn, Point, Points, read_points};
use crate::read::Table;
use crate::settings::Settings;
use crate::undisturbed::Undisturbed;

/// Measured friction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurements {
    /// The points.
    pub points: Vec<Point>,
    /// Rows of a table that are passed over, as nothing presses there.
    pub without_contact: u64,
    /// Share of a record that is left out, as a vibration blurs its friction.
    pub left_out: f64,
    /// Share of a record, or of rows with forces, that is at rest and left out.
    pub at_rest: f64,
    /// Sentences about what was read and how, where that is not plain.
    pub remarks: Vec<String>,
}

/// Reads measured friction from the file that `open` reads (up to three times), named `name` in messages. With forces, a
/// velocity, a tangential acceleration and time it is a record of vibrations: what these blur is left out.
/// Otherwise every row is a point. Without a column of temperature every point has `temperature` (°C).
///
/// # Errors
/// When the file cannot be read or is not fit for that: which column, where, what to do.
pub fn read_measurements(
    mut open: impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
    friction: &FrictionColumn,
    temperature: Option<f64>,
) -> Result<Measurements, Unfit> {
    let forces = *friction == FrictionColumn::Forces;
    let record = open().ok().filter(|_| forces).and_then(|input| of_record(input, settings));
    if let Some(remarks) = record {
        let found = identify(&mut open, name, settings, &mut |_, _| ())?;
        let Undisturbed { points, left_out, at_rest } = found.undisturbed;
        let point = |(point, own): &(Point, bool)| {
            let temperature = temperature.or(own.then_some(point.temperature))?;
            Some(Point { temperature, ..*point })
        };
        let points: Option<Vec<Point>> = points.iter().map(point).collect();
        // Without a vibration there are no windows, and without a temperature the table says what is missing.
        if let Some(points) = points.filter(|_| found.windows > 0) {
            return Ok(Measurements { points, without_contact: 0, left_out, at_rest, remarks });
        }
    }
    let input = open().map_err(|why| Unfit {
        name: name.to_owned(),
        fault: Box::new(crate::fault::Fault::Unreadable { why: why.to_string() }),
    })?;
    let Points { points, without_contact, at_rest, remarks } =
        read_points(input, name, settings, friction, temperature)?;
    Ok(Measurements { points, without_contact, left_out: 0.0, at_rest, remarks })
}

/// What is to be said of how a file is read; `None` where it does not have all that a record of vibrations has.
fn of_record(input: Box<dyn Read>, settings: &Settings) -> Option<Vec<String>> {
    let needed =
        [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::NormalForce, Channel::Velocity];
    Table::open_with(input, settings, &needed, true).ok().map(|table| table.remarks())
}
