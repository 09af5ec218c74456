//! A file of measured friction → points, whether it is a table of points or a record of a stroke that may squeal.

use std::io::Read;

use crate::analysis::identify;
use crate::channel::Channel;
use crate::fault::Unfit;
use crate::points::{FrictionColumn, Point, Points, read_points};
use crate::read::Table;
use crate::settings::Settings;
use crate::stroke::{Stroke, strokes};
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

impl Measurements {
    /// Adds those of another part, whose rows are so many times as many.
    fn add(&mut self, other: Measurements, rows: [f64; 2]) {
        let moving = [self.at_rest, other.at_rest].map(|rests| 1.0 - rests);
        self.left_out = mean([self.left_out, other.left_out], [rows[0] * moving[0], rows[1] * moving[1]]);
        self.at_rest = mean([self.at_rest, other.at_rest], rows);
        self.without_contact += other.without_contact;
        self.points.extend(other.points);
        for remark in other.remarks {
            if !self.remarks.contains(&remark) {
                self.remarks.push(remark);
            }
        }
    }
}

/// The mean of two values by their weights.
fn mean([one, other]: [f64; 2], weights: [f64; 2]) -> f64 {
    let sum = weights[0] + weights[1];
    if sum > 0.0 { (one * weights[0] + other * weights[1]) / sum } else { one }
}

/// Reads measured friction from the file that `open` reads (three times and more), named `name` in messages. With forces, a
/// velocity, a tangential acceleration and time it is a record of vibrations: what these blur is left out, and each of its strokes
/// is read by itself where they go both ways.
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
    if !open().is_ok_and(|input| forces && is_record(input, settings)) {
        return of_rows(open, name, settings, friction, temperature);
    }
    let mut all = Measurements::default();
    let mut before = 0.0;
    for settings in ways(&mut open, name, settings)? {
        let part = of_stroke(&mut open, name, &settings, temperature)?;
        let rows = settings.rows.map_or(1.0, |[_, rows]| rows as f64);
        all.add(part, [before, rows]);
        before += rows;
    }
    Ok(all)
}

/// The strokes of a record that go both ways, or the whole record where all go one way.
fn ways(
    open: &mut impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
) -> Result<Vec<Settings>, Unfit> {
    let found = strokes(open, name, settings)?;
    if found.windows(2).all(|two| two[0].forward == two[1].forward) {
        return Ok(vec![settings.clone()]);
    }
    let part =
        |stroke: &Stroke| Settings { rows: Some(stroke.rows), back: !stroke.forward, ..settings.clone() };
    Ok(found.iter().map(part).collect())
}

/// The friction of a stroke, by windows where it has any.
fn of_stroke(
    open: &mut impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
    temperature: Option<f64>,
) -> Result<Measurements, Unfit> {
    let found = identify(&mut *open, name, settings, &mut |_, _| ())?;
    let Undisturbed { points, left_out, at_rest } = found.undisturbed;
    let point = |(point, own): &(Point, bool)| {
        let temperature = temperature.or(own.then_some(point.temperature))?;
        Some(Point { temperature, ..*point })
    };
    let points: Option<Vec<Point>> = points.iter().map(point).collect();
    // Without a vibration there are no windows, and without a temperature the table says what is missing.
    match points.filter(|_| found.windows > 0) {
        Some(points) => {
            Ok(Measurements { points, left_out, at_rest, without_contact: 0, remarks: found.remarks })
        }
        None => of_rows(open, name, settings, &FrictionColumn::Forces, temperature),
    }
}

/// Every row as a point.
fn of_rows(
    mut open: impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
    friction: &FrictionColumn,
    temperature: Option<f64>,
) -> Result<Measurements, Unfit> {
    let input = open().map_err(|why| Unfit {
        name: name.to_owned(),
        fault: Box::new(crate::fault::Fault::Unreadable { why: why.to_string() }),
    })?;
    let Points { points, without_contact, at_rest, remarks } =
        read_points(input, name, settings, friction, temperature)?;
    Ok(Measurements { points, without_contact, left_out: 0.0, at_rest, remarks })
}

/// Whether a file has all that a record of vibrations has.
fn is_record(input: Box<dyn Read>, settings: &Settings) -> bool {
    let needed =
        [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::NormalForce, Channel::Velocity];
    Table::open_with(input, settings, &needed, true).is_ok()
}
