//! The cheapest configuration for an error, from what was measured.

use super::configuration::{Configuration, scenes};
use super::level::Level;
use super::row::{Row, from_csv};
use crate::error::{Error, Result};
use crate::spec::Spec;

use serde::{Deserialize, Serialize};

/// What is compiled in: `squealmap tradeoff` on the sweeps of `sweeps/accuracy`, see docs/accuracy.md.
const SHIPPED: &str = include_str!("default.csv");

/// What was measured must be so many times better than what is asked for: another sweep of the same kind has other
/// instances.
pub const MARGIN: f64 = 2.0;

/// Marks the efficient ones among the rows of each scene: no other is as accurate and as fast.
pub fn mark(rows: &mut [Row]) {
    let beats = |a: &Row, b: &Row| {
        a.scene == b.scene
            && a.worst_p95 <= b.worst_p95
            && a.per_second >= b.per_second
            && (a.worst_p95 < b.worst_p95 || a.per_second > b.per_second)
    };
    let efficient: Vec<bool> = rows
        .iter()
        .map(|row| row.worst_p95.is_finite() && !rows.iter().any(|other| beats(other, row)))
        .collect();
    for (row, efficient) in rows.iter_mut().zip(efficient) {
        row.frontier = efficient;
    }
}

/// Measured rows and where they come from.
#[derive(Clone, Debug)]
pub struct Frontier {
    rows: Vec<Row>,
    source: String,
}

/// A configuration and why it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The configuration.
    pub configuration: Configuration,
    /// What a manifest says of it.
    pub chosen: Chosen,
}

/// What was chosen for an accuracy, in words.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Chosen {
    /// The accuracy that was asked for.
    pub asked: String,
    /// The configuration.
    pub configuration: String,
    /// The relative error that 95 % of the settled oscillations kept when it was measured; `None` of the reference,
    /// which judges.
    pub measured_p95: Option<f64>,
    /// Why.
    pub why: String,
}

impl Choice {
    fn new(level: Level, configuration: Configuration, measured_p95: Option<f64>, why: String) -> Choice {
        let (asked, in_words) = (level.to_string(), configuration.to_string());
        Choice { configuration, chosen: Chosen { asked, configuration: in_words, measured_p95, why } }
    }
}

impl Frontier {
    /// What is compiled in.
    ///
    /// # Panics
    /// When the table in the program is none, which a test excludes.
    #[must_use]
    pub fn shipped() -> Frontier {
        let rows = from_csv(SHIPPED.as_bytes()).expect("the table that is compiled in can be read");
        Frontier { rows, source: "shipped with the program".to_owned() }
    }

    /// Rows that were measured on this machine; `source` says where they stand.
    #[must_use]
    pub fn measured(rows: Vec<Row>, source: String) -> Frontier {
        Frontier { rows, source }
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Whether every kind of scene of a sweep was measured.
    #[must_use]
    pub fn covers(&self, spec: &Spec) -> bool {
        scenes(spec).iter().all(|scene| self.rows.iter().any(|row| names(row, scene)))
    }

    /// The fastest configuration that keeps an accuracy on every kind of scene of a sweep, among those that are
    /// `allowed`. Where a kind was not measured, all kinds count.
    ///
    /// # Errors
    /// When nothing measured is accurate enough.
    pub fn choose(
        &self,
        level: Level,
        spec: &Spec,
        allowed: &dyn Fn(&Configuration) -> bool,
    ) -> Result<Choice> {
        let Level::Within(bound) = level else {
            let reference = Configuration::reference(spec.steps_per_period);
            return Ok(Choice::new(level, reference, None, "it is asked for".to_owned()));
        };
        let scenes = scenes(spec);
        let covered = self.covers(spec);
        let counts = |row: &&Row| !covered || scenes.iter().any(|scene| names(row, scene));
        let candidates = candidates(self.rows.iter().filter(counts), allowed);
        let kinds = if covered { scenes.join(" + ") } else { "all kinds of scenes".to_owned() };
        let enough = candidates.iter().filter(|one| MARGIN * one.error <= bound);
        let Some(best) = enough.max_by(|a, b| a.per_second.total_cmp(&b.per_second)) else {
            let least = candidates.iter().map(|one| one.error).fold(f64::INFINITY, f64::min);
            let least = if least.is_finite() {
                format!("the best keeps {:.1e}", MARGIN * least)
            } else {
                "none is there that may be taken".to_owned()
            };
            return Err(Error::Inaccurate { bound, kinds, least });
        };
        let why = format!(
            "the fastest of {} measured on {kinds} ({}) that keeps {bound:e}: 95 % within {:.1e}, {:.0} instances/s there",
            candidates.len(),
            self.source,
            best.error,
            best.per_second
        );
        Ok(Choice::new(level, best.configuration.clone(), Some(best.error), why))
    }
}

/// A configuration on all scenes that count: its largest error and its lowest speed.
struct Candidate {
    configuration: Configuration,
    /// On how many it was measured.
    scenes: usize,
    error: f64,
    per_second: f64,
}

/// The configurations that are allowed and were measured on every scene that counts, each once.
fn candidates<'a>(
    rows: impl Iterator<Item = &'a Row>,
    allowed: &dyn Fn(&Configuration) -> bool,
) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut scenes: Vec<&str> = Vec::new();
    for row in rows {
        if !scenes.contains(&row.scene.as_str()) {
            scenes.push(&row.scene);
        }
        let Some(configuration) = row.configuration() else { continue };
        match candidates.iter_mut().find(|one| one.configuration == configuration) {
            Some(one) => {
                one.scenes += 1;
                one.error = one.error.max(row.worst_p95);
                one.per_second = one.per_second.min(row.per_second);
            }
            None if allowed(&configuration) => {
                candidates.push(Candidate {
                    configuration,
                    scenes: 1,
                    error: row.worst_p95,
                    per_second: row.per_second,
                });
            }
            None => {}
        }
    }
    candidates.retain(|one| one.scenes == scenes.len());
    candidates
}

/// Whether a row was measured on a kind of scene, alone or with others.
fn names(row: &Row, scene: &str) -> bool {
    row.scene.split(" + ").any(|one| one == scene)
}
