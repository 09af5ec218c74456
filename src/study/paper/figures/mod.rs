//! `paper`: the figures of the source paper as pictures and tables.
//!
//! - `laws.rs`: Figure 3; `ramp.rs`: Figures 4 to 6; `growth.rs`: Figure 7.
//! - `phase.rs`, `accelerations.rs`: the phase method on trial, and other ramps and kicks.
//! - `report.rs`: `paper.md`.
//! - `distinct.rs`: values without repeats.

mod accelerations;
mod distinct;
mod growth;
mod laws;
mod phase;
mod ramp;
mod report;

use serde_json::json;

use crate::results::figure::look::Look;
use crate::results::manifest::described;
use crate::study::error::Result;
use crate::study::modes::follow::{self, Modes};
use crate::study::paper::{Case, Figure, PhaseTrial, Study, Trial};
use crate::sweep::spec::Spec;
use squealmap_figure::png;

pub use growth::Growing;
pub use laws::Laws;
pub use ramp::Slowdown;
pub use report::report;
pub(crate) use {
    accelerations::COLUMNS as ACCELERATIONS, growth::COLUMNS as GROWTH, laws::COLUMNS as LAWS,
    phase::COLUMNS as PHASE, ramp::COLUMNS as RAMP,
};

/// One figure as files.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture as an SVG document.
    pub svg: String,
    /// The numbers behind it.
    pub csv: Vec<u8>,
    /// What the picture needs besides the table, as JSON.
    pub json: Vec<u8>,
}

impl Drawn {
    /// The files and their extensions.
    ///
    /// # Errors
    /// When the picture is too large for an image.
    pub fn files(self) -> Result<[(&'static str, Vec<u8>); 4]> {
        let png = png::render(&self.svg)?;
        Ok([("png", png), ("svg", self.svg.into_bytes()), ("csv", self.csv), ("json", self.json)])
    }
}

/// The content of a figure, computed or read back.
#[derive(Clone, Debug)]
pub enum Shown {
    /// Figure 2.
    Modes(Box<Spec>, Modes),
    /// Figure 3.
    Laws(Laws),
    /// Figures 4 to 6.
    Ramp(Slowdown),
    /// Figure 7.
    Growth(Vec<Growing>),
    /// Other ramps and kicks.
    Accelerations(Vec<Trial>),
    /// The phase method on trial.
    Phase(PhaseTrial),
}

impl Shown {
    /// Computes what a figure shows.
    ///
    /// # Errors
    /// When an instance behind it fails.
    pub fn compute(figure: Figure, study: &Study) -> Result<Shown> {
        Ok(match figure {
            Figure::Figure2 => {
                let (spec, modes) = study.modes()?;
                Shown::Modes(Box::new(spec), modes)
            }
            Figure::Figure3 => Shown::Laws(Laws::compute(study)),
            Figure::Figure4 => Shown::Ramp(Slowdown::compute(study, Case::NegativeSlope)?),
            Figure::Figure5 => Shown::Ramp(Slowdown::compute(study, Case::ModeCoupling)?),
            Figure::Figure6 => Shown::Ramp(Slowdown::compute(study, Case::Both)?),
            Figure::Figure7 => Shown::Growth(growth::compute(study)?),
            Figure::Accelerations => Shown::Accelerations(study.trials().to_vec()),
            Figure::Phase => Shown::Phase(study.phase_trial()?.clone()),
        })
    }

    /// The title above the picture.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Shown::Modes(spec, _) => &spec.title,
            Shown::Laws(_) => laws::HEADING,
            Shown::Ramp(ramp) => &ramp.heading,
            Shown::Growth(_) => growth::HEADING,
            Shown::Accelerations(_) => accelerations::HEADING,
            Shown::Phase(_) => phase::HEADING,
        }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn svg(&self, look: &Look<'_>) -> String {
        match self {
            Shown::Modes(spec, found) => follow::draw(spec, found, look),
            Shown::Laws(laws) => laws.picture(look),
            Shown::Ramp(ramp) => ramp::picture(ramp, look),
            Shown::Growth(growths) => growth::picture(growths, look),
            Shown::Accelerations(trials) => accelerations::picture(trials, look),
            Shown::Phase(trial) => phase::picture(trial, look),
        }
    }

    /// The numbers behind it.
    ///
    /// # Errors
    /// When the table cannot be written.
    pub fn csv(&self) -> Result<Vec<u8>> {
        match self {
            Shown::Modes(spec, found) => follow::table(spec, found),
            Shown::Laws(laws) => laws.table(),
            Shown::Ramp(ramp) => ramp::table(ramp),
            Shown::Growth(growths) => growth::table(growths),
            Shown::Accelerations(trials) => accelerations::table(trials),
            Shown::Phase(trial) => phase::table(trial),
        }
    }

    /// What the picture needs besides the table, as JSON.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn document(&self) -> Result<Vec<u8>> {
        match self {
            Shown::Modes(spec, found) => follow::document(spec, found),
            Shown::Ramp(ramp) => Ok(described(&ramp.to_json())?),
            Shown::Growth(growths) => Ok(described(&growth::to_json(growths))?),
            Shown::Accelerations(trials) => Ok(described(&accelerations::to_json(trials))?),
            Shown::Laws(_) | Shown::Phase(_) => Ok(described(&json!({ "title": self.title() }))?),
        }
    }
}

/// Computes and draws a figure.
///
/// # Errors
/// When an instance behind it fails.
pub fn draw(figure: Figure, study: &Study) -> Result<Drawn> {
    let shown = Shown::compute(figure, study)?;
    Ok(Drawn { svg: shown.svg(&Look::default()), csv: shown.csv()?, json: shown.document()? })
}
