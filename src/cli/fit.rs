//! `squealmap fit`: measured friction as a material of sweeps.

use std::path::PathBuf;

use crate::cli::error::Result;
use crate::cli::home::prepare_beside;
use crate::cli::numbers::{finite, positive};
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::talk::{note, print};
use clap::{Args, ValueEnum};
use squealmap::model::friction::LawKind;
use squealmap::results::figure::look::Look;
use squealmap::study::error::Error;
use squealmap::study::fit::binned::binned;
use squealmap::study::fit::binned_csv::tables_csv;
use squealmap::study::fit::course::Shown;
use squealmap::study::fit::figure::fit_svg;
use squealmap::study::fit::rows::rows;
use squealmap::study::fit::table::{material_csv, residuals_csv};
use squealmap::study::fit::told::{remarks, warnings};
use squealmap::study::fit::{Candidate, Fit, FitFault, compare, fit};
use squealmap_identify::{Channel, FrictionColumn, Point, Settings, read_measurements};
use squealmap_input::quote::one_line;

/// The files that are written.
const FILES: [&str; 5] = ["fit.json", "fit.png", "fit.svg", "material.csv", "residuals.csv"];
/// The laws that can be fitted.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Law {
    Bilinear,
    Exponential,
    Constant,
    /// No law: tables, the means of friction in bins of velocity
    Table,
    /// The law with the least `AICc`, a table aside
    Best,
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub(crate) struct FitCommand {
    /// Measured points, or a record of a stroke: CSV with a header, or WAV, MAT (-v7), UFF 58 or TDMS
    points: PathBuf,
    /// Output directory [default: out/<name of the file>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Friction law of the material
    #[arg(long, value_enum, default_value_t = Law::Bilinear)]
    law: Law,
    /// Knee or Stribeck velocity, m/s; left out, the best one is found
    #[arg(long, value_name = "M/S", value_parser = positive)]
    law_velocity: Option<f64>,
    /// Column of the friction coefficient [default: the ratio of the forces]
    #[arg(long, value_name = "COLUMN")]
    friction: Option<String>,
    /// Column of the tangential force, N [default: T]
    #[arg(long, value_name = "COLUMN", conflicts_with = "friction")]
    tangential_force: Option<String>,
    /// Column of the normal force, N [default: N]
    #[arg(long, value_name = "COLUMN", conflicts_with = "friction")]
    normal_force: Option<String>,
    /// Column of the tangential acceleration of a record that may squeal, m/s²: what squeals is left out [default: ax2]
    #[arg(long, value_name = "COLUMN", conflicts_with = "friction")]
    tangential_acceleration: Option<String>,
    /// Samples per second of such a record, Hz, instead of a column of time
    #[arg(long, value_name = "HZ", value_parser = positive, conflicts_with = "friction")]
    rate: Option<f64>,
    /// Column of the sliding velocity, m/s [default: V]
    #[arg(long, value_name = "COLUMN")]
    velocity: Option<String>,
    /// Column of the temperature, °C [default: temperature]
    #[arg(long, value_name = "COLUMN", conflicts_with = "at_temperature")]
    temperature: Option<String>,
    /// The temperature of all points, °C, instead of a column
    #[arg(long, value_name = "C", allow_negative_numbers = true, value_parser = finite)]
    at_temperature: Option<f64>,
    /// Temperatures of the rows, °C, rising [default: those of the points, or 5 from the lowest to the highest where they hardly repeat]
    #[arg(long, value_name = "C,C,...", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    temperatures: Vec<f64>,
}

impl FitCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let name = self.points.display().to_string();
        let mut settings = Settings::default();
        settings.columns[Channel::TangentialForce as usize] = self.tangential_force;
        settings.columns[Channel::NormalForce as usize] = self.normal_force;
        settings.columns[Channel::Velocity as usize] = self.velocity;
        settings.columns[Channel::Temperature as usize] = self.temperature;
        let friction = self.friction.map_or(FrictionColumn::Forces, FrictionColumn::Named);
        settings.columns[Channel::TangentialAcceleration as usize] = self.tangential_acceleration;
        settings.rate = self.rate;
        let open = || {
            let file = squealmap_input::files::open(&self.points).map_err(std::io::Error::other)?;
            Ok(Box::new(file) as Box<dyn std::io::Read>)
        };
        let measured = read_measurements(open, &name, &settings, &friction, self.at_temperature)?;
        for remark in remarks(&measured) {
            note(&remark);
        }
        let points = measured.points;
        let given = !self.temperatures.is_empty();
        let rows = if given { self.temperatures.clone() } else { rows(&points) };
        let mut candidates = compare(&points, &rows, self.law_velocity);
        let law = match self.law {
            Law::Bilinear => LawKind::Bilinear,
            Law::Exponential => LawKind::Exponential,
            Law::Constant => LawKind::Constant,
            Law::Table => LawKind::Table,
            Law::Best => candidates[0].law,
        };
        let no_fit = |fault: FitFault| Error::Fit { name: name.clone(), fault: fault.into() };
        let mut elsewhere = Vec::new();
        let (fitted, text, courses) = if law.reads_table() {
            let binned = binned(&points, &self.temperatures).map_err(no_fit)?;
            candidates.push(binned.candidate());
            elsewhere = binned.elsewhere();
            let text = tables_csv(&binned, &points, &name);
            let courses = binned.courses(&points);
            (binned.fit, text, Some(courses))
        } else {
            let fitted = fit(&points, law, &rows, self.law_velocity).map_err(no_fit)?;
            let text = material_csv(&fitted, &points, &name);
            (fitted, text, None)
        };
        let output = prepare_beside(&self.points, self.output.as_deref(), &FILES)?;
        let heading = one_line(&self.points.file_stem().unwrap_or_default().to_string_lossy());
        let shown = Shown::new(&fitted, &points, &heading);
        let shown = Shown { courses: courses.unwrap_or(shown.courses), ..shown };
        let svg = fit_svg(&shown, &Look::default());
        let paths = output.write(&[
            (FILES[0], shown.document()?),
            (FILES[1], png_of(&svg)?),
            (FILES[2], svg.into_bytes()),
            (FILES[3], text.clone().into_bytes()),
            (FILES[4], residuals_csv(&fitted, &points)?),
        ])?;
        let usage = format!("[friction]\nlaw = \"{}\"\nmaterial = \"{}\"\n", law.name(), FILES[3]);
        print(&format!(
            "{text}{}{}{}in a sweep file beside {}:\n{usage}",
            largest(&fitted, &points),
            compared(&candidates),
            list(&paths),
            FILES[3]
        ));
        for warning in elsewhere {
            note(&format!("warning: {warning}"));
        }
        // Tables without given temperatures are where the points are.
        let warned = given || !law.reads_table();
        for warning in warned.then(|| warnings(&fitted, &points)).into_iter().flatten() {
            note(&format!("warning: {warning}"));
        }
        Ok(())
    }
}

/// The laws beside each other.
fn compared(candidates: &[Candidate]) -> String {
    let least = |k: usize| {
        candidates.iter().filter_map(|one| one.criteria).map(|all| all[k]).fold(f64::INFINITY, f64::min)
    };
    let line = |candidate: &Candidate| match (&candidate.fit, candidate.criteria) {
        (Ok(fit), Some([aicc, bic])) => format!(
            "law \"{}\": root mean square residual {:.2e}, AICc {:+.1}, BIC {:+.1} above the least\n",
            candidate.law.name(),
            fit.residual,
            aicc - least(0),
            bic - least(1)
        ),
        (Err(why), _) => format!("law \"{}\": {why}\n", candidate.law.name()),
        (Ok(_), None) => format!("law \"{}\": too few points to compare\n", candidate.law.name()),
    };
    candidates.iter().map(line).collect()
}

/// Where the law is farthest from a point.
fn largest(fitted: &Fit, points: &[Point]) -> String {
    let of = points.iter().zip(&fitted.residuals);
    of.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(String::new(), |(point, residual)| {
        format!("largest residual {residual:.2e}, at {} m/s and {} °C\n", point.velocity, point.temperature)
    })
}
