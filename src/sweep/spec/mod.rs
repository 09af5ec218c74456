//! A sweep file (TOML), or calls in code, as a validated sweep. Only this folder reads TOML.
//!
//! | question | where |
//! |---|---|
//! | text → sweep | `read.rs`, `document.rs`, `duration.rs` |
//! | calls → sweep | `call.rs`, `code.rs` |
//! | its sections, key by key | `sections.rs`, `law.rs`, `start.rs`, [`refine`] |
//! | what varies | `axis.rs`, `varied.rs` |
//! | the model | `model.rs` |
//! | how the belt moves | `belt.rs`, `motion.rs` |
//! | files that it names | `files.rs`, `tables.rs`, `rows.rs` |
//! | what must hold between keys | `check.rs`, [`names`] |
//! | every key, for people | [`keys`] |
//! | one instance of it | `instance.rs`, `at.rs` |
//! | written out in full, and read from that again | `resolved.rs`, `again.rs` |

mod again;
mod at;
mod axis;
mod belt;
pub(crate) mod call;
mod check;
mod code;
mod document;
pub(crate) mod duration;
mod files;
mod instance;
pub mod keys;
mod law;
mod model;
mod motion;
pub mod names;
mod read;
pub mod refine;
mod resolved;
mod rows;
mod sections;
pub(crate) mod start;
mod tables;
mod varied;

pub(crate) use resolved::resolved_grid;

use std::sync::Arc;

use crate::engine::instances::Instances;
use crate::engine::plan::{Duration, Plan, StartKind};
use crate::model::friction::{LawKind, MuTable};
use crate::model::instance::Instance;
use crate::model::material::Material;
use crate::model::modal::Modal;
use crate::model::motion::Motion;
use crate::model::{Param, Params};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{AxisKey, Grid};
use refine::Settings;
use squealmap_input::place::Place;

/// Most instances of one sweep: what a disk of 44 TB (linear) or 225 TB (with response) holds; in a browser, what can be counted.
#[cfg(target_pointer_width = "64")]
pub const MAX_INSTANCES: usize = 1_000_000_000_000;
/// Most instances of one sweep.
#[cfg(not(target_pointer_width = "64"))]
pub const MAX_INSTANCES: usize = usize::MAX;

/// The most bytes of a sweep file, whose values take thirty times that while they are read.
pub const MAX_SWEEP_BYTES: u64 = 4 * squealmap_input::files::MIB;

/// Most rows of a file of points, which stand in memory: those of the longest `map.csv` that is written by itself.
pub const MAX_ROWS: usize = 20_000_000;

/// Most rows of a friction table or a material: an instance may have to look through all of them.
pub const MAX_TABLE_ROWS: usize = 65_536;

/// Most values of an axis, which stand in memory.
pub const MAX_VALUES: usize = 100_000_000;

/// Steps per period `2π/ω0` when a sweep does not say: enough for a Taylor method of high order.
pub const STEPS_PER_PERIOD: u32 = 12;

/// Time before the measuring window when a sweep does not say (0 with a ramp).
pub const SETTLE: Duration = Duration::Periods(200.0);

/// The measuring window when a sweep does not say (the ramp with a ramp).
pub const MEASURE: Duration = Duration::Periods(100.0);

/// Time before the first window of a run until settled.
pub const FIRST_SETTLE: Duration = Duration::Periods(24.0);

/// Time before the first look for a cycle.
pub const FIRST_HUNT: Duration = Duration::Periods(8.0);

/// The windows of a run until settled when a sweep does not say; they are lengthened to whole cycles.
pub const AUTO_MEASURE: Duration = Duration::Periods(48.0);

/// The longest time to settle when a sweep does not say.
pub const SETTLE_LIMIT: Duration = Duration::Periods(1000.0);

/// What a sweep computes.
#[expect(clippy::struct_excessive_bools, reason = "five questions with yes or no, asked one by one")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Analysis {
    /// Complex eigenvalue analysis.
    pub linear: bool,
    /// Time integration.
    pub response: bool,
    /// Time integration goes on until it is settled.
    pub until_settled: bool,
    /// Time integration looks for its limit cycle by shooting.
    pub finds_cycles: bool,
    /// A few instances are computed again, to measure the error of the others.
    pub checked: bool,
    /// The starts of the time integration.
    pub starts: Starts,
}

impl Analysis {
    /// The eigenvalues alone.
    pub const LINEAR: Analysis = Analysis {
        linear: true,
        response: false,
        until_settled: false,
        finds_cycles: false,
        checked: false,
        starts: Starts::One,
    };

    /// Whether instances are computed again: responses only.
    #[must_use]
    pub fn checks(self) -> bool {
        self.response && self.checked
    }
}

/// How many starts every instance has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Starts {
    /// One start, as [`crate::engine::plan::StartKind`] says.
    #[default]
    One,
    /// Two: the kick, and a large start with `large_velocity` and `large_displacement`.
    Both,
    /// The kick, and so many starts drawn from a box of displacements and velocities.
    Box(u32),
}

impl Starts {
    /// How many transients every instance has.
    #[must_use]
    pub fn count(self) -> usize {
        match self {
            Starts::One => 1,
            Starts::Both => 2,
            Starts::Box(samples) => 1 + samples as usize,
        }
    }
}

/// Which of its starts an instance is computed from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pass {
    /// The start of [`crate::engine::plan::StartKind`].
    #[default]
    Own,
    /// The large start of [`Starts::Both`].
    Large,
}

/// A validated sweep.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Title of figures and manifest; empty when not given.
    pub title: String,
    /// What is computed.
    pub analysis: Analysis,
    /// Parameters that do not vary; what varies overrides them.
    pub base: Params,
    /// The structure that slides; `None` for two masses.
    pub modal: Option<Arc<Modal>>,
    /// Whether impacts carry a Coulomb impulse.
    pub impact_friction: bool,
    /// The law of instances whose law does not vary.
    pub law: LawKind,
    /// The material of instances whose material does not vary.
    pub material: Option<Arc<Material>>,
    /// The materials of an axis or column `material`, by the name written there.
    pub materials: Vec<Arc<Material>>,
    /// The table of the law `table`.
    pub table: Option<Arc<MuTable>>,
    /// How the belt moves.
    pub motion: Motion,
    /// The instances.
    pub grid: Grid,
    /// How transients start.
    pub start: StartKind,
    /// Which of several starts [`Spec::instance`] gives.
    pub pass: Pass,
    /// Time before the measuring window, or before the first of a run until settled.
    pub settle: Duration,
    /// The latest start of a window in a run until settled (`settle = "auto"` or `"cycle"`).
    pub settle_limit: Option<Duration>,
    /// Length of the measuring window.
    pub measure: Duration,
    /// Largest step: this many per period `2π/ω0`.
    pub steps_per_period: u32,
    /// Where the sweep gives them, if it does.
    pub steps_given: Option<Place>,
    /// How its map is refined; `None` where every instance is computed.
    pub refine: Option<Settings>,
}

impl Spec {
    /// Why the velocity of the belt changes within a run, where it does, as the end of a sentence.
    #[must_use]
    pub fn moving_belt(&self) -> Option<String> {
        let is_varied = || self.grid.keys().contains(&AxisKey::Param(Param::RampDuration));
        self.motion.moves(&self.base).or_else(|| is_varied().then(|| "a ramp".to_owned()))
    }

    /// Refuses a sweep of another model than two masses.
    ///
    /// # Errors
    /// For a modal model; `what` needs two masses.
    pub fn of_two_masses(&self, what: &'static str) -> Result<()> {
        match &self.modal {
            None => Ok(()),
            Some(modal) => Err(Error::OnlyTwoMasses { what, modes: modal.name.clone() }),
        }
    }
}

impl Plan {
    /// The plan of a sweep for the reference method.
    #[must_use]
    pub fn new(spec: &Spec) -> Plan {
        Plan {
            start: spec.start,
            settle: spec.settle,
            settle_limit: spec.settle_limit,
            hunts: spec.analysis.finds_cycles,
            measure: spec.measure,
            steps_per_period: spec.steps_per_period,
            ..Plan::REFERENCE
        }
    }
}

impl Instances for Spec {
    fn instance(&self, index: usize) -> Instance {
        Spec::instance(self, index)
    }

    fn plan(&self) -> Plan {
        Plan::new(self)
    }

    fn linear(&self) -> bool {
        self.analysis.linear
    }

    fn response(&self) -> bool {
        self.analysis.response
    }

    fn modal(&self) -> bool {
        self.modal.is_some()
    }

    fn pieces(&self) -> usize {
        let of_materials = self.material.iter().chain(&self.materials).map(|material| material.most_rows());
        let of_table = self.table.iter().map(|table| table.velocity.len());
        of_materials.chain(of_table).max().unwrap_or(0).max(2)
    }
}
