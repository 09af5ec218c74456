//! `squealmap fit`: measured friction as a material of sweeps.

use std::path::PathBuf;

use crate::cli::error::Result;
use crate::cli::home::prepare_beside;
use crate::cli::numbers::{finite, positive};
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::records::listed;
use crate::cli::talk::{note, print};
use clap::{Args, ValueEnum};
use squealmap::model::friction::LawKind;
use squealmap::results::figure::look::Look;
use squealmap::study::error::Error;
use squealmap::study::fit::Fit;
use squealmap::study::fit::course::Shown;
use squealmap::study::fit::figure::fit_svg;
use squealmap::study::fit::files::{Files, files as measured_in};
use squealmap::study::fit::made::{Wanted, made};
use squealmap::study::fit::table::residuals_csv;
use squealmap::study::fit::told::compared;
use squealmap_identify::{Channel, FrictionColumn, Point, Settings};
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

impl Law {
    fn wanted(self) -> Wanted {
        match self {
            Law::Bilinear => Wanted::Law(LawKind::Bilinear),
            Law::Exponential => Wanted::Law(LawKind::Exponential),
            Law::Constant => Wanted::Law(LawKind::Constant),
            Law::Table => Wanted::Law(LawKind::Table),
            Law::Best => Wanted::Best,
        }
    }
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub(crate) struct FitCommand {
    /// Measured points, or records of strokes: CSV with a header, WAV, MAT (-v7), UFF 58 or TDMS; several files, or folders of
    /// them, make one material
    #[arg(required = true)]
    points: Vec<PathBuf>,
    /// Output directory [default: out/<name of the first of them>]
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
    /// The temperature of all points, °C, instead of a column; of several files, one for all or one for each
    #[arg(long, value_name = "C,…", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    at_temperature: Vec<f64>,
    /// Temperatures of the rows, °C, rising [default: those of the points, or 5 from the lowest to the highest where they hardly repeat]
    #[arg(long, value_name = "C,C,...", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    temperatures: Vec<f64>,
}

impl FitCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let files = listed(&self.points)?;
        let mut settings = Settings::default();
        settings.columns[Channel::TangentialForce as usize] = self.tangential_force;
        settings.columns[Channel::NormalForce as usize] = self.normal_force;
        settings.columns[Channel::Velocity as usize] = self.velocity;
        settings.columns[Channel::Temperature as usize] = self.temperature;
        let friction = self.friction.map_or(FrictionColumn::Forces, FrictionColumn::Named);
        settings.columns[Channel::TangentialAcceleration as usize] = self.tangential_acceleration;
        settings.rate = self.rate;
        let Files { points, name, remarks } =
            measured_in(&files, &settings, &friction, &self.at_temperature)?;
        for remark in &remarks {
            note(remark);
        }
        let made = made(&points, &name, self.law.wanted(), &self.temperatures, self.law_velocity)
            .map_err(|fault| Error::Fit { name, fault: fault.into() })?;
        let fitted = &made.fit;
        let output = prepare_beside(&self.points[0], self.output.as_deref(), &FILES)?;
        let heading = one_line(&self.points[0].file_stem().unwrap_or_default().to_string_lossy());
        let shown = Shown::new(fitted, made.courses, &points, &heading);
        let svg = fit_svg(&shown, &Look::default());
        let paths = output.write(&[
            (FILES[0], shown.document()?),
            (FILES[1], png_of(&svg)?),
            (FILES[2], svg.into_bytes()),
            (FILES[3], made.text.clone().into_bytes()),
            (FILES[4], residuals_csv(fitted, &points)?),
        ])?;
        let usage = format!("[friction]\nlaw = \"{}\"\nmaterial = \"{}\"\n", fitted.law.name(), FILES[3]);
        print(&format!(
            "{}{}{}{}in a sweep file beside {}:\n{usage}",
            made.text,
            largest(fitted, &points),
            compared(&made.candidates),
            list(&paths),
            FILES[3]
        ));
        for warning in &made.warnings {
            note(&format!("warning: {warning}"));
        }
        Ok(())
    }
}

/// Where the law is farthest from a point.
fn largest(fitted: &Fit, points: &[Point]) -> String {
    let of = points.iter().zip(&fitted.residuals);
    of.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(String::new(), |(point, residual)| {
        format!("largest residual {residual:.2e}, at {} m/s and {} °C\n", point.velocity, point.temperature)
    })
}
