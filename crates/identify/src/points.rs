//! A file of velocity, friction and temperature → points to fit a material to.

use std::io::Read;

use crate::channel::Channel;
use crate::fault::{Fault, Unfit};
use crate::read::{Row, Table};
use crate::settings::Settings;

/// What moves slower than this part of the fastest is at rest: no law of sliding is measured there.
pub(super) const RESTS: f64 = 0.01;

/// One measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Sliding velocity, m/s; its sign does not matter.
    pub velocity: f64,
    /// Half of the range of velocities over which the friction is averaged, m/s.
    pub half_range: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Temperature, °C.
    pub temperature: f64,
}

/// The options that say where the friction coefficient comes from.
const FORCE_OR_FRICTION: &str =
    "--tangential-force, or the column of the friction coefficient with --friction";

/// Where the friction coefficient comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum FrictionColumn {
    /// A column of its own.
    Named(String),
    /// The ratio of both forces.
    Forces,
}

/// The points of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// In the order of the file.
    pub points: Vec<Point>,
    /// Rows that are passed over, as nothing presses there.
    pub without_contact: u64,
    /// Share of the others that is left out, as nothing moves there: forces at rest are no friction of sliding.
    pub at_rest: f64,
    /// Sentences about what was read and how, where that is not plain.
    pub remarks: Vec<String>,
}

/// Reads points from a file with the columns of `settings` for velocity, temperature and both forces; its name in
/// messages is `name`. Without a column of temperature every point has `temperature` (°C).
///
/// # Errors
/// When it is not fit for that: which column, where, what to do.
pub fn read_points(
    input: Box<dyn Read>,
    name: &str,
    settings: &Settings,
    friction: &FrictionColumn,
    temperature: Option<f64>,
) -> Result<Points, Unfit> {
    points(input, settings, friction, temperature)
        .map_err(|fault| Unfit { name: name.to_owned(), fault: Box::new(fault) })
}

fn points(
    input: Box<dyn Read>,
    settings: &Settings,
    friction: &FrictionColumn,
    temperature: Option<f64>,
) -> Result<Points, Fault> {
    let mut settings = settings.clone();
    let mut needed = vec![Channel::Velocity];
    if temperature.is_none() {
        needed.push(Channel::Temperature);
    }
    match friction {
        // The friction coefficient takes the place of a force that is then not needed.
        FrictionColumn::Named(column) => {
            settings.columns[Channel::TangentialForce as usize] = Some(column.clone());
            settings.columns[Channel::NormalForce as usize] = None;
        }
        FrictionColumn::Forces => needed.extend([Channel::TangentialForce, Channel::NormalForce]),
    }
    let mut table = Table::open_with(input, &settings, &needed, false).map_err(|fault| match fault {
        // A table of friction coefficients has no forces at all.
        Fault::NoColumn { words, name, header, flag } if flag == Channel::TangentialForce.flag() => {
            Fault::NoColumn { words, name, header, flag: FORCE_OR_FRICTION }
        }
        fault => fault,
    })?;
    if temperature.is_some() {
        table.pass_over(Channel::Temperature);
    }
    let mut points = Vec::new();
    let mut open = None;
    let mut without_contact = 0;
    while let Some(Row { place, values, .. }) = table.next()? {
        let value = |channel: Channel| values[channel as usize];
        let (tangential, normal) = (value(Channel::TangentialForce), value(Channel::NormalForce));
        let coefficient = match friction {
            FrictionColumn::Named(_) => tangential,
            FrictionColumn::Forces if normal > 0.0 => tangential / normal,
            FrictionColumn::Forces => {
                let column = table.name(Channel::NormalForce);
                open.get_or_insert(Fault::NoContact { place, column, value: normal });
                without_contact += 1;
                continue;
            }
        };
        points.push(Point {
            velocity: value(Channel::Velocity),
            half_range: 0.0,
            friction: coefficient,
            temperature: temperature.unwrap_or(value(Channel::Temperature)),
        });
    }
    if let Some(fault) = open.filter(|_| points.is_empty()) {
        return Err(fault);
    }
    turn(&mut points);
    let read = points.len();
    if *friction == FrictionColumn::Forces {
        let fastest = points.iter().map(|point: &Point| point.velocity.abs()).fold(0.0, f64::max);
        // Rows that do not follow each other in time rest only where they say so: speeds of a table may span decades.
        let rests = if table.is_over_time() { RESTS * fastest } else { 0.0 };
        points.retain(|point| point.velocity.abs() > rests || fastest == 0.0);
    }
    let at_rest = (read - points.len()) as f64 / read.max(1) as f64;
    Ok(Points { points, without_contact, at_rest, remarks: table.remarks() })
}

/// Friction of bodies that slide backwards, along their way: a force that opposes it has the other sign.
fn turn(points: &mut [Point]) {
    let back = || points.iter().filter(|point| point.velocity < 0.0);
    if back().map(|point| point.friction).sum::<f64>() < 0.0 {
        points
            .iter_mut()
            .filter(|point| point.velocity < 0.0)
            .for_each(|point| point.friction = -point.friction);
    }
}
