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
        let named = |said: String| if names.len() > 1 { format!("{name}: {said}") } else { said };
        all.remarks.extend(remarks(&measured).into_iter().map(named));
        all.points.extend(measured.points);
    }
    Ok(all)
}
