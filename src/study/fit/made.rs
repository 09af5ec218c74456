//! A material in the law that is asked for, with what is said and drawn of it.

use crate::model::friction::LawKind;
use crate::study::fit::binned::binned;
use crate::study::fit::binned_csv::tables_csv;
use crate::study::fit::course::{Course, courses};
use crate::study::fit::criteria::{Candidate, compare};
use crate::study::fit::each::fit;
use crate::study::fit::fault::FitFault;
use crate::study::fit::rows::rows;
use crate::study::fit::squares::{Fit, Point};
use crate::study::fit::table::material_csv;
use crate::study::fit::told::warnings;

/// The law that a material is to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// This one; [`LawKind::Table`] is means in bins of velocity.
    Law(LawKind),
    /// The law with the least `AICc`, a table aside.
    Best,
}

impl Wanted {
    /// What can be asked for.
    pub const ALL: [Wanted; 5] = [
        Wanted::Law(LawKind::Bilinear),
        Wanted::Law(LawKind::Exponential),
        Wanted::Law(LawKind::Constant),
        Wanted::Law(LawKind::Table),
        Wanted::Best,
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Wanted::Law(law) => law.name(),
            Wanted::Best => "best",
        }
    }
}

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// What it leaves of the points.
    pub fit: Fit,
    /// The file that sweeps read.
    pub text: String,
    /// Its friction over the velocity at each temperature.
    pub courses: Vec<Course>,
    /// The laws beside each other, the one with the least `AICc` first; a table, where it was asked for, last.
    pub candidates: Vec<Candidate>,
    /// What the points do not determine.
    pub warnings: Vec<String>,
}

/// A material from the points of `source`, with rows at some temperatures (°C), or, where there are none, at those that the
/// points suggest. `velocity` is the knee or the Stribeck velocity, m/s, where it is known.
///
/// # Errors
/// When the points do not determine it.
pub fn made(
    points: &[Point],
    source: &str,
    wanted: Wanted,
    temperatures: &[f64],
    velocity: Option<f64>,
) -> Result<Made, FitFault> {
    let suggested = rows(points);
    let of = if temperatures.is_empty() { &suggested } else { temperatures };
    let mut candidates = compare(points, of, velocity);
    if wanted == Wanted::Law(LawKind::Table) {
        let binned = binned(points, temperatures)?;
        candidates.push(binned.candidate());
        let mut warned = binned.elsewhere();
        // Tables without given temperatures are where the points are.
        if !temperatures.is_empty() {
            warned.extend(warnings(&binned.fit, points));
        }
        let (text, courses) = (tables_csv(&binned, points, source), binned.courses(points));
        return Ok(Made { fit: binned.fit, text, courses, candidates, warnings: warned });
    }
    let (law, unsure) = match wanted {
        Wanted::Law(law) => (law, None),
        Wanted::Best => (candidates[0].law, unsure(&candidates)),
    };
    let compared = candidates.iter().find(|one| one.law == law);
    let fit = compared.map_or_else(|| fit(points, law, of, velocity), |one| one.fit.clone())?;
    let warnings = unsure.into_iter().chain(warnings(&fit, points)).collect();
    let (text, courses) = (material_csv(&fit, points, source), courses(&fit, points));
    Ok(Made { fit, text, courses, candidates, warnings })
}

/// A warning where the best law is hardly better than the next.
fn unsure(candidates: &[Candidate]) -> Option<String> {
    /// Differences of `AICc` below this tell nothing.
    const TELLS: f64 = 2.0;
    let best = candidates.first()?;
    let said = |why: &str| {
        format!("the law \"{}\" is taken, but {why}; measure more, or name one with --law", best.law.name())
    };
    let Some([least, _]) = best.criteria else {
        return Some(said("the points are too few to compare laws"));
    };
    let near = |one: &&Candidate| one.criteria.is_some_and(|[aicc, _]| aicc - least < TELLS);
    let next = candidates[1..].iter().find(near)?;
    Some(said(&format!(
        "the points do not tell it from \"{}\": their AICc differs by less than {TELLS}",
        next.law.name()
    )))
}
