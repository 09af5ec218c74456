//! The measurement of one configuration as a row of a table: of `tradeoff.csv`, and of the file that choices come from.

use serde::{Deserialize, Serialize};

use crate::engine::backend::Backend;
use crate::engine::precision::Precision;
use crate::sweep::accuracy::configuration::Configuration;
use crate::sweep::accuracy::errors::Errors;
use crate::sweep::error::{Error, Result};

/// Cost and error of a configuration on one kind of scene. Errors are relative (those of `stick` absolute) and quantiles
/// over the settled oscillations of a sample; labels are shares of all instances.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The kind of scene, see [`crate::sweep::accuracy::configuration::scenes`].
    pub scene: String,
    /// The backend.
    pub backend: String,
    /// The adapter of a GPU.
    pub adapter: Option<String>,
    /// The scalar.
    pub precision: String,
    /// Steps per period.
    pub steps_per_period: u32,
    /// Instances per second of one thread; none on a GPU.
    pub per_cpu_second: Option<f64>,
    /// Instances per second of wall time, all threads.
    pub per_second: f64,
    /// Error of `x2_std`: median, 95th and 99th percentile.
    pub x2_std_p50: f64,
    /// 95th percentile.
    pub x2_std_p95: f64,
    /// 99th percentile.
    pub x2_std_p99: f64,
    /// Error of `ax_rms`.
    pub ax_rms_p50: f64,
    /// 95th percentile.
    pub ax_rms_p95: f64,
    /// 99th percentile.
    pub ax_rms_p99: f64,
    /// Error of `ay_rms`.
    pub ay_rms_p50: f64,
    /// 95th percentile.
    pub ay_rms_p95: f64,
    /// 99th percentile.
    pub ay_rms_p99: f64,
    /// Error of `response_frequency`.
    pub response_frequency_p50: f64,
    /// 95th percentile.
    pub response_frequency_p95: f64,
    /// 99th percentile.
    pub response_frequency_p99: f64,
    /// The worst of these four of each instance.
    pub worst_p50: f64,
    /// 95th percentile.
    pub worst_p95: f64,
    /// 99th percentile.
    pub worst_p99: f64,
    /// The worst of the errors beyond the truth's own scatter, 95th percentile.
    pub beyond_scatter_p95: f64,
    /// Absolute error of the fraction of time in stick.
    pub stick_p50: f64,
    /// 95th percentile.
    pub stick_p95: f64,
    /// 99th percentile.
    pub stick_p99: f64,
    /// Share of instances with another type.
    pub types: f64,
    /// Share of instances with another regime.
    pub regimes: f64,
    /// Share of instances with another status.
    pub statuses: f64,
    /// Whether nothing measured is as accurate and faster.
    pub frontier: bool,
}

/// The speed by which rows are compared: per second of a processor, which other work on the machine hardly changes; or per
/// second of wall time for all of them, where some row has a GPU.
#[must_use]
pub fn pace<'a>(rows: impl Iterator<Item = &'a Row>) -> fn(&Row) -> f64 {
    let mut all = true;
    for row in rows {
        all &= row.per_cpu_second.is_some();
    }
    if all { |row| row.per_cpu_second.unwrap_or_default() } else { |row| row.per_second }
}

/// Instances per second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Instances per second of one thread; `None` on a GPU.
    pub per_cpu_second: Option<f64>,
    /// Instances per second of all threads.
    pub per_second: f64,
}

impl Rate {
    /// Takes the faster of the two for each speed.
    pub fn improve(&mut self, other: Rate) {
        self.per_second = self.per_second.max(other.per_second);
        // None is less than any number.
        if other.per_cpu_second > self.per_cpu_second {
            self.per_cpu_second = other.per_cpu_second;
        }
    }
}

impl Row {
    /// The row of a configuration.
    #[must_use]
    pub fn new(scene: &str, configuration: &Configuration, rate: Rate, errors: &Errors) -> Row {
        let [x2, ax, ay, frequency] = errors.quantities;
        let (worst, stick) = (errors.worst, errors.stick);
        Row {
            scene: scene.to_owned(),
            backend: configuration.backend.name().to_owned(),
            adapter: configuration.adapter.clone(),
            precision: configuration.precision.to_string(),
            steps_per_period: configuration.steps_per_period,
            per_cpu_second: rate.per_cpu_second,
            per_second: rate.per_second,
            x2_std_p50: x2[0],
            x2_std_p95: x2[1],
            x2_std_p99: x2[2],
            ax_rms_p50: ax[0],
            ax_rms_p95: ax[1],
            ax_rms_p99: ax[2],
            ay_rms_p50: ay[0],
            ay_rms_p95: ay[1],
            ay_rms_p99: ay[2],
            response_frequency_p50: frequency[0],
            response_frequency_p95: frequency[1],
            response_frequency_p99: frequency[2],
            worst_p50: worst[0],
            worst_p95: worst[1],
            worst_p99: worst[2],
            beyond_scatter_p95: errors.beyond_scatter,
            stick_p50: stick[0],
            stick_p95: stick[1],
            stick_p99: stick[2],
            types: errors.types,
            regimes: errors.regimes,
            statuses: errors.statuses,
            frontier: false,
        }
    }

    /// The configuration; `None` when its names are none of this version.
    #[must_use]
    pub fn configuration(&self) -> Option<Configuration> {
        let precision =
            [Precision::F32, Precision::F64].into_iter().find(|one| one.name() == self.precision)?;
        Some(Configuration {
            backend: Backend::of_name(&self.backend)?,
            adapter: self.adapter.clone(),
            precision,
            steps_per_period: self.steps_per_period,
        })
    }
}

/// Rows as CSV with a header.
///
/// # Errors
/// When they cannot be written.
pub fn to_csv(rows: &[Row]) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    rows.iter().try_for_each(|row| writer.serialize(row)).map_err(Error::WriteTable)?;
    writer.into_inner().map_err(|why| Error::WriteTable(why.into_error().into()))
}

/// The rows of a CSV file.
///
/// # Errors
/// What is wrong with it, as the end of a sentence.
pub fn from_csv(bytes: &[u8]) -> std::result::Result<Vec<Row>, String> {
    let rows: std::result::Result<Vec<Row>, _> = csv::Reader::from_reader(bytes).deserialize().collect();
    let rows = rows.map_err(|why| why.to_string())?;
    let sound = |row: &Row| {
        let fast = row.per_second > 0.0 && row.per_cpu_second.is_none_or(|rate| rate > 0.0);
        row.configuration().is_some() && fast && !row.worst_p95.is_nan()
    };
    match rows.iter().position(|row| !sound(row)) {
        None => Ok(rows),
        Some(number) => Err(format!("row {} is none that `squealmap tradeoff` writes", number + 1)),
    }
}
