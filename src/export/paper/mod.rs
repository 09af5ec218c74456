//! `paper`: the figures of the source paper as pictures and tables.

mod accelerations;
mod growth;
mod laws;
mod phase;
mod ramp;
mod report;

use super::{modes, png};
use crate::error::Result;
use crate::paper::{Case, Figure, Study};

pub use report::report;

/// One figure as files.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture as an SVG document.
    pub svg: String,
    /// The numbers behind it.
    pub csv: Vec<u8>,
}

impl Drawn {
    /// The files and their extensions.
    ///
    /// # Errors
    /// When the picture is too large for an image.
    pub fn files(self) -> Result<[(&'static str, Vec<u8>); 3]> {
        Ok([("png", png::render(&self.svg)?), ("svg", self.svg.into_bytes()), ("csv", self.csv)])
    }
}

/// Computes and draws a figure.
///
/// # Errors
/// When an instance behind it fails.
pub fn draw(figure: Figure, study: &Study) -> Result<Drawn> {
    match figure {
        Figure::Figure2 => {
            let (spec, found) = study.modes()?;
            Ok(Drawn { svg: modes::draw(&spec, &found), csv: modes::table(&spec, &found)? })
        }
        Figure::Figure3 => laws::draw(study),
        Figure::Figure4 => ramp::draw(study, Case::NegativeSlope),
        Figure::Figure5 => ramp::draw(study, Case::ModeCoupling),
        Figure::Figure6 => ramp::draw(study, Case::Both),
        Figure::Figure7 => growth::draw(),
        Figure::Accelerations => accelerations::draw(study),
        Figure::Phase => phase::draw(study),
    }
}

/// The distinct values, rising.
fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}
