//! The points of one file, or of several together.

use std::path::PathBuf;

use crate::study::error::{Error, Result};
use crate::study::fit::FitFault;
use crate::study::fit::told::remarks;
use squealmap_identify::{FrictionColumn, Point, Settings, read_measurements};
use squealmap_input::files::reader;

/// What some files hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Files {
    /// The points, in the order of the files.
    pub points: Vec<Point>,
    /// The files as messages name them.
    pub name: String,
    /// Sentences about what was not taken as it stands; where there are several files they begin with the name of theirs.
    pub remarks: Vec<String>,
}

/// Reads measured friction from every file: see [`read_measurements`]. Of `temperatures` (°C) there are none, where the files have a column,
/// one for all of them, or one for each.
///
/// # Errors
/// When a file cannot be read, or is not fit for that; when there is another number of temperatures.
pub fn files(
    paths: &[PathBuf],
    settings: &Settings,
    friction: &FrictionColumn,
    temperatures: &[f64],
) -> Result<Files> {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    let (given, needed) = (temperatures.len(), names.len());
    if given > 1 && given != needed {
        let fault = FitFault::Temperatures { given, files: needed };
        return Err(Error::Fit { name: names.join(", "), fault: fault.into() });
    }
    let mut all = Files { name: names.join(", "), ..Files::default() };
    for (number, (path, name)) in paths.iter().zip(&names).enumerate() {
        let temperature = temperatures.get(number).or(temperatures.first()).copied();
        let measured = read_measurements(|| reader(path), name, settings, friction, temperature)?;
        if let Some(fault) = of_both_signs(&measured.points) {
            return Err(Error::Fit { name: name.clone(), fault: fault.into() });
        }
        let named = |said: String| if names.len() > 1 { format!("{name}: {said}") } else { said };
        all.remarks.extend(remarks(&measured).into_iter().map(named));
        all.points.extend(measured.points);
    }
    Ok(all)
}

/// Why points have no law: friction opposes the sliding at some of them, and drives it at others, about as strongly.
fn of_both_signs(points: &[Point]) -> Option<FitFault> {
    /// The part of the points that noise about a small friction coefficient does not reach …
    const SOME: f64 = 0.02;
    /// … with a mean so large, over that of the others.
    const LARGE: f64 = 0.2;
    let (driven, opposed): (Vec<f64>, Vec<f64>) =
        points.iter().map(|point| point.friction).partition(|friction| *friction < 0.0);
    let mean = |of: &[f64]| of.iter().sum::<f64>().abs() / of.len().max(1) as f64;
    let few = SOME * points.len() as f64;
    let both =
        driven.len() as f64 > few && opposed.len() as f64 > few && mean(&driven) > LARGE * mean(&opposed);
    both.then_some(FitFault::BothSigns { negative: driven.len(), points: points.len() })
}
