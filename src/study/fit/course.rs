//! What the figure of a fit shows: the law over the sliding velocity among the points.

use serde::{Deserialize, Serialize};

use crate::results::manifest::described;
use crate::study::error::Result;
use crate::study::fit::shape::Shape;
use crate::study::fit::{Fit, range};
use squealmap_identify::Point;

/// Speeds at which a law is drawn.
const SPEEDS: usize = 120;

/// The law at one temperature.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Course {
    /// The temperature, °C.
    pub temperature: f64,
    /// The parameters of the law.
    pub parameters: Vec<Parameter>,
    /// Speed (m/s) and friction coefficient, from rest to the fastest point.
    pub points: Vec<[f64; 2]>,
}

/// A parameter of a law.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Parameter {
    /// Its name in a sweep file.
    pub name: String,
    /// Its value, SI units.
    pub value: f64,
    /// Its standard error; `None` where it was given, or the points do not tell.
    pub error: Option<f64>,
}

/// What the figure of a fit shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The heading; may be empty.
    pub title: String,
    /// The name of the law.
    pub law: String,
    /// The law at each temperature.
    pub courses: Vec<Course>,
    /// Speed (m/s), temperature (°C), friction coefficient, and what the law leaves of it.
    pub points: Vec<[f64; 4]>,
}

/// What the figure needs beside the table of residuals.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub(crate) struct Document {
    pub(crate) title: String,
    pub(crate) law: String,
    /// The number of rows of that table.
    pub(crate) points: usize,
    pub(crate) courses: Vec<Course>,
}

impl Shown {
    /// The figure of a fit to some points, and of its course at each temperature, with a heading.
    #[must_use]
    pub fn new(fit: &Fit, courses: Vec<Course>, points: &[Point], title: &str) -> Shown {
        let row = |(point, residual): (&Point, &f64)| {
            [point.velocity.abs(), point.temperature, point.friction, *residual]
        };
        Shown {
            title: title.to_owned(),
            law: fit.law.name().to_owned(),
            courses,
            points: points.iter().zip(&fit.residuals).map(row).collect(),
        }
    }

    /// `fit.json`: all of it but the points.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn document(&self) -> Result<Vec<u8>> {
        let Shown { title, law, courses, points } = self.clone();
        Ok(described(&Document { title, law, points: points.len(), courses })?)
    }
}

/// The law of each row from rest to the fastest point.
#[must_use]
pub fn courses(fit: &Fit, points: &[Point]) -> Vec<Course> {
    let [_, fastest] = range(points, |point| point.velocity.abs());
    let course = |(row, temperature): (usize, &f64)| {
        let parameters: Vec<Parameter> = fit
            .columns
            .iter()
            .zip(&fit.errors)
            .map(|((param, values), errors)| Parameter {
                name: param.info().name.to_owned(),
                value: values[row],
                error: errors.as_ref().map(|errors| errors[row]),
            })
            .collect();
        let value = |k: usize| parameters.get(k).map_or(0.0, |parameter| parameter.value);
        let mut speeds: Vec<f64> = (0..=SPEEDS).map(|k| fastest * k as f64 / SPEEDS as f64).collect();
        // The knee is a corner.
        if let Shape::Falling(..) = Shape::of(fit.law)
            && value(2) < fastest
        {
            speeds.insert(speeds.partition_point(|speed| *speed < value(2)), value(2));
        }
        let friction = |speed: f64| match Shape::of(fit.law) {
            Shape::Falling(part, _) => {
                let part = part.over([speed; 2], value(2));
                value(0) * (1.0 - part) + value(1) * part
            }
            Shape::Level | Shape::Other => value(0),
        };
        let points = speeds.into_iter().map(|speed| [speed, friction(speed)]).collect();
        Course { temperature: *temperature, parameters, points }
    };
    fit.temperature.iter().enumerate().map(course).collect()
}
