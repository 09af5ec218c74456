//! Measured signals.

use std::io::{self, Read};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use squealmap::results::figure::look::Look;
use squealmap::study::identify::report::{Shown, WindowsCsv, identify_svg, report_json};
use squealmap::study::identify::rig::rig_of;
use squealmap::sweep::spec::Spec;
use squealmap_identify::{Identification, Measured, Settings, Spectrogram, TimeUnit, identify as identified};
use squealmap_input::{files, quote};

use crate::dataset::{Column, Dataset, Named};
use crate::failure::Failure;
use crate::map::attributes;
use crate::table::columns;
use crate::watch::whole;

/// Units of the columns of windows; those that are not here have none.
const UNITS: [(&str, &str); 15] = [
    ("start", "s"),
    ("end", "s"),
    ("friction", "1"),
    ("velocity", "m/s"),
    ("temperature", "degC"),
    ("rms_acceleration", "m/s2"),
    ("frequency", "Hz"),
    ("signal_to_noise_db", "dB"),
    ("growth_rate", "1/s"),
    ("growth_rate_error", "1/s"),
    ("phase", "degree"),
    ("phase_error", "degree"),
    ("slope", "s/m"),
    ("slope_error", "s/m"),
    ("confidence", "1"),
];

/// The choices of an analysis; what is `None` is as the command line has it.
#[derive(Debug, FromPyObject)]
pub(crate) struct Choices {
    #[pyo3(item)]
    time: Option<String>,
    #[pyo3(item)]
    time_unit: Option<String>,
    #[pyo3(item)]
    rate: Option<f64>,
    /// In the order of the channels.
    #[pyo3(item)]
    columns: [Option<String>; 6],
    #[pyo3(item)]
    skew: Option<f64>,
    #[pyo3(item)]
    force_skew: Option<f64>,
    #[pyo3(item)]
    damping_ratio: Option<f64>,
    #[pyo3(item)]
    inclination: Option<f64>,
    #[pyo3(item)]
    band: Option<[f64; 2]>,
    #[pyo3(item)]
    window: Option<f64>,
    #[pyo3(item)]
    overlap: Option<f64>,
    #[pyo3(item)]
    largest_friction: Option<f64>,
    /// Value and standard error.
    #[pyo3(item)]
    critical_friction: Option<[f64; 2]>,
    /// A sweep file.
    #[pyo3(item)]
    model: Option<PathBuf>,
}

impl Choices {
    /// The settings.
    ///
    /// # Errors
    /// For a value that is none, or a model that is none.
    fn settings(self) -> Result<Settings, Failure> {
        let of = |path: &PathBuf| Ok::<_, Failure>(rig_of(&Spec::read(path)?)?);
        let rig = self.model.as_ref().map(of).transpose()?;
        let known = Settings::default();
        let usual = Settings {
            damping_ratio: rig.map_or(known.damping_ratio, |rig| rig.damping_ratio()),
            inclination: rig.map_or(known.inclination, |rig| rig.theta.abs()),
            ..known
        };
        let positive: (fn(f64) -> bool, _) = (|x| x > 0.0, "a finite number greater than 0");
        let ratio: (fn(f64) -> bool, _) = (|x| (0.0..1.0).contains(&x), "a number from 0 to below 1");
        let finite: (fn(f64) -> bool, _) = (|_| true, "a finite number");
        let checked =
            |name: &str, value: Option<f64>, (holds, words): (fn(f64) -> bool, &str), usual: f64| match value
            {
                None => Ok(usual),
                Some(value) if value.is_finite() && holds(value) => Ok(value),
                Some(value) => Err(Failure::input(format!("{name} is {value} but must be {words}"))),
            };
        let unit = |said: String| {
            TimeUnit::parse(&said).ok_or_else(|| {
                let names = TimeUnit::ALL.map(TimeUnit::name).join(", ");
                let said = quote::quoted(&said);
                Failure::input(format!("time_unit is \"{said}\" but must be one of {names}"))
            })
        };
        if let Some([low, high]) = self.band
            && !(low >= 0.0 && low < high && high.is_finite())
        {
            return Err(Failure::input(format!(
                "band is ({low}, {high}) but must be two frequencies such as (1000, 20000), the lower one first"
            )));
        }
        if self.model.is_some() && self.force_skew.is_some_and(|skew| skew != 0.0) {
            return Err(Failure::input(
                "force_skew is given beside model, but the forces of a model come from the accelerations: leave one of them out".to_owned(),
            ));
        }
        if let Some([value, error]) = self.critical_friction {
            checked("critical_friction", Some(value), positive, 0.0)?;
            checked("the error of critical_friction", Some(error), positive, 0.0)?;
        }
        Ok(Settings {
            rows: None,
            back: false,
            time: self.time,
            time_unit: self.time_unit.map(unit).transpose()?,
            rate: self.rate.map(|rate| checked("rate", Some(rate), positive, 0.0)).transpose()?,
            columns: self.columns,
            skew: checked("skew", self.skew, finite, usual.skew)?,
            force_skew: checked("force_skew", self.force_skew, finite, usual.force_skew)?,
            damping_ratio: checked("damping_ratio", self.damping_ratio, ratio, usual.damping_ratio)?,
            inclination: checked("inclination", self.inclination, ratio, usual.inclination)?,
            band: self.band,
            window: checked("window", self.window, positive, usual.window)?,
            overlap: checked("overlap", self.overlap, ratio, usual.overlap)?,
            largest_friction: checked(
                "largest_friction",
                self.largest_friction,
                positive,
                usual.largest_friction,
            )?,
            zooms: Vec::new(),
            critical_friction: self.critical_friction.map(|[value, error]| Measured { value, error }),
            rig,
        })
    }
}

/// What is found in a file of signals: the report as JSON, the windows, the spectrogram, and the figure.
#[pyfunction]
pub(crate) fn identify(py: Python<'_>, file: PathBuf, choices: Choices) -> PyResult<Bound<'_, PyTuple>> {
    let (report, windows, spectrogram, svg) = whole(py, move |watch| {
        let name = file.display().to_string();
        let heading = quote::one_line(&file.file_stem().unwrap_or_default().to_string_lossy());
        let settings = choices.settings()?;
        let stop = Arc::new(AtomicBool::new(false));
        let open = || {
            let opened = files::open(&file).map_err(io::Error::other)?;
            Ok(Box::new(Stoppable(opened, Arc::clone(&stop))) as Box<dyn Read>)
        };
        let mut table = WindowsCsv::new(Vec::new())?;
        let mut each = |window: &_, reading: &_| {
            stop.store(watch.is_cancelled(), Ordering::Relaxed);
            table.add(window, reading);
        };
        let found =
            identified(open, &name, &settings, &mut each).map_err(squealmap::study::error::Error::from)?;
        let report = String::from_utf8_lossy(&report_json(&found, &name)?).into_owned();
        let windows = windows(&table.finish()?, &found, &heading)?;
        let svg = identify_svg(&Shown::new(&found, &heading), &Look::default())?;
        let attributes = attributes("spectrogram", &heading, String::new());
        Ok((report, windows, spectrogram(found.spectrogram, attributes), svg))
    })?;
    let report = report.into_pyobject(py)?;
    let svg = svg.into_pyobject(py)?;
    PyTuple::new(
        py,
        [
            report.into_any(),
            windows.handed(py)?.into_any(),
            spectrogram.handed(py)?.into_any(),
            svg.into_any(),
        ],
    )
}

/// A file that ends early once it is told to.
struct Stoppable<R>(R, Arc<AtomicBool>);

impl<R: Read> Read for Stoppable<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.1.load(Ordering::Relaxed) {
            return Err(io::Error::other("stopped"));
        }
        self.0.read(buffer)
    }
}

/// The table of windows.
fn windows(table: &[u8], found: &Identification, title: &str) -> Result<Dataset, Failure> {
    let unit = |name: &str| UNITS.iter().find(|(one, _)| *one == name).map_or("", |(_, unit)| *unit);
    let named = columns(table)?.into_iter().map(|(name, column)| {
        let said = [unit(&name), ""];
        Named::new(name, &["window"], column, said)
    });
    Ok(Dataset {
        dimensions: vec![("window".to_owned(), found.windows)],
        variables: named.collect(),
        attributes: attributes("windows", title, String::new()),
        ..Dataset::default()
    })
}

/// The spectrogram over the middles of its windows and bins.
fn spectrogram(found: Spectrogram, attributes: Vec<(&'static str, String)>) -> Dataset {
    let middles = |[low, high]: [f64; 2], count: usize| {
        let width = (high - low) / count.max(1) as f64;
        Column::Numbers((0..count).map(|k| low + (k as f64 + 0.5) * width).collect())
    };
    let both = ["time", "frequency"];
    Dataset {
        dimensions: vec![("time".to_owned(), found.columns), ("frequency".to_owned(), found.rows)],
        coordinates: vec![
            Named::new(
                "time",
                &both[..1],
                middles(found.time, found.columns),
                ["s", "middle of the windows"],
            ),
            Named::new(
                "frequency",
                &both[1..],
                middles(found.frequency, found.rows),
                ["Hz", "middle of the bins"],
            ),
        ],
        variables: vec![
            Named::new(
                "normalised",
                &both,
                Column::Singles(found.normalised),
                ["1", "amplitude over the largest one of the same window"],
            ),
            Named::new(
                "decibel",
                &both,
                Column::Singles(found.decibel),
                ["dB", "power over the largest one of the record"],
            ),
        ],
        attributes,
    }
}
