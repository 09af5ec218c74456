//! The cheapest configuration for an error, from what was measured.

use crate::engine::backend::Backend;
use crate::sweep::accuracy::configuration::{Configuration, scenes};
use crate::sweep::accuracy::level::Level;
use crate::sweep::accuracy::row::{Row, from_csv, pace};
use crate::sweep::accuracy::tried::Trial;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::Spec;

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

/// The measurements that are compiled in: `squealmap tradeoff` on the sweeps of `sweeps/accuracy`, see
/// `docs/accuracy_measured.md`.
const SHIPPED: &str = include_str!("default.csv");

/// A measured error must be so many times smaller than the bound that is asked for, since another sweep of the same kind has
/// other instances.
pub const MARGIN: f64 = 2.0;

/// Whether a row is of a method that is there to be compared with: it is never chosen.
#[must_use]
pub fn is_comparison(row: &Row) -> bool {
    Backend::of_name(&row.backend).is_some_and(Backend::is_comparison)
}

/// Marks the efficient ones among the rows of each scene that may be chosen: no other is as accurate and as fast.
pub fn mark(rows: &mut [Row]) {
    let pace = pace(rows.iter());
    let beats = |a: &Row, b: &Row| {
        a.scene == b.scene
            && !is_comparison(a)
            && a.worst_p95 <= b.worst_p95
            && pace(a) >= pace(b)
            && (a.worst_p95 < b.worst_p95 || pace(a) > pace(b))
    };
    let efficient: Vec<bool> = rows
        .iter()
        .map(|row| {
            row.worst_p95.is_finite() && !is_comparison(row) && !rows.iter().any(|other| beats(other, row))
        })
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
    /// The choice in the words of a manifest.
    pub chosen: Chosen,
}

/// The configuration that was chosen for an accuracy, in words.
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
    /// The relative error that was asked for; `None` of the reference.
    pub bound: Option<f64>,
    /// How it did on the sweep itself; `None` for the reference, which judges.
    pub trial: Option<Trial>,
}

impl Choice {
    fn new(level: Level, configuration: Configuration, measured_p95: Option<f64>, why: String) -> Choice {
        let (asked, in_words) = (level.to_string(), configuration.to_string());
        let bound = match level {
            Level::Within(bound) => Some(bound),
            Level::Reference => None,
        };
        let chosen = Chosen { asked, configuration: in_words, measured_p95, why, bound, trial: None };
        Choice { configuration, chosen }
    }
}

impl Frontier {
    /// The measurements that are compiled in.
    ///
    /// # Panics
    /// When the table in the program cannot be read, which a test excludes.
    #[must_use]
    pub fn shipped() -> &'static Frontier {
        // Read once: every tile asks for it.
        static READ: LazyLock<Frontier> = LazyLock::new(|| {
            let rows = from_csv(SHIPPED.as_bytes()).expect("the table that is compiled in can be read");
            Frontier { rows, source: "shipped with the program".to_owned() }
        });
        &READ
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

    /// Instances per second of one thread of a configuration of the CPU, with the nearest steps per period that were
    /// measured, under laws of straight pieces; NaN where none was.
    #[must_use]
    pub fn cpu_rate(&self, wanted: &Configuration) -> f64 {
        let of_kind = self.rows.iter().filter(|row| names(row, "pieces, fixed time")).filter_map(|row| {
            let found = row.configuration()?;
            let same = (found.backend, found.precision) == (wanted.backend, wanted.precision);
            row.per_cpu_second.filter(|_| same).map(|rate| (found.steps_per_period, rate))
        });
        let nearest = of_kind.min_by_key(|(steps, _)| steps.abs_diff(wanted.steps_per_period));
        nearest.map_or(f64::NAN, |(_, rate)| rate)
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
        Ok(self.ranked(level, spec, allowed)?.remove(0))
    }

    /// The choice of [`Frontier::choose`], followed by those to take should it fail on the sweep itself. Each is slower and
    /// more accurate than the one before. There is at least one.
    ///
    /// # Errors
    /// When nothing measured is accurate enough.
    pub fn ranked(
        &self,
        level: Level,
        spec: &Spec,
        allowed: &dyn Fn(&Configuration) -> bool,
    ) -> Result<Vec<Choice>> {
        let Level::Within(bound) = level else {
            let reference = Configuration::reference(spec.steps_per_period);
            return Ok(vec![Choice::new(level, reference, None, "it is asked for".to_owned())]);
        };
        let scenes = scenes(spec);
        let covered = self.covers(spec);
        let may_be_taken =
            |row: &Row| !is_comparison(row) && row.configuration().is_some_and(|one| allowed(&one));
        let counts = |row: &&Row| !covered || scenes.iter().any(|scene| names(row, scene));
        let rows: Vec<&Row> = self.rows.iter().filter(counts).filter(|row| may_be_taken(row)).collect();
        let candidates = candidates(&rows);
        let kinds = if covered { scenes.join(" + ") } else { "all kinds of scenes".to_owned() };
        let mut enough: Vec<&Candidate> =
            candidates.iter().filter(|one| MARGIN * one.error <= bound).collect();
        if enough.is_empty() {
            let least = candidates.iter().map(|one| one.error).fold(f64::INFINITY, f64::min);
            return Err(if least.is_finite() {
                Error::Inaccurate { bound, kinds, least: MARGIN * least }
            } else {
                Error::Unmeasured { kinds }
            });
        }
        enough.sort_by(|a, b| b.pace.total_cmp(&a.pace));
        let on_gpu = rows.iter().any(|row| row.per_cpu_second.is_none());
        let per = if on_gpu { "" } else { " of a processor" };
        let mut ranked: Vec<Choice> = Vec::new();
        let mut least = f64::INFINITY;
        for one in enough {
            if one.error >= least {
                continue;
            }
            least = one.error;
            let why = format!(
                "{} of {} measured on {kinds} ({}) that keeps {bound:e}: 95 % within {:.1e}, {:.0} instances/s{per} there",
                if ranked.is_empty() { "the fastest" } else { "the next more accurate" },
                candidates.len(),
                self.source,
                one.error,
                one.pace,
            );
            ranked.push(Choice::new(level, one.configuration.clone(), Some(one.error), why));
        }
        Ok(ranked)
    }
}

/// A configuration on all scenes that count: its largest error and its lowest speed.
struct Candidate {
    configuration: Configuration,
    /// On how many it was measured.
    scenes: usize,
    error: f64,
    pace: f64,
}

/// The configurations that were measured on every scene of these rows, each once.
fn candidates(rows: &[&Row]) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene.as_str()).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let pace = pace(rows.iter().copied());
    for row in rows {
        let Some(configuration) = row.configuration() else { continue };
        match candidates.iter_mut().find(|one| one.configuration == configuration) {
            Some(one) => {
                one.scenes += 1;
                one.error = one.error.max(row.worst_p95);
                one.pace = one.pace.min(pace(row));
            }
            None => {
                candidates.push(Candidate {
                    configuration,
                    scenes: 1,
                    error: row.worst_p95,
                    pace: pace(row),
                });
            }
        }
    }
    candidates.retain(|one| one.scenes == scenes.len());
    candidates
}

/// Whether a row was measured on a kind of scene, alone or with others.
fn names(row: &Row, scene: &str) -> bool {
    row.scene.split(" + ").any(|one| one == scene)
}
