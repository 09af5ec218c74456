//! The maps, and their runs.

use std::error::Error;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use squealmap::engine::instances::Instances;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::instance::Instance;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_HUNT, FIRST_SETTLE, Spec};

/// The map that heyoka and a script of numba were measured on, twice as fine.
const PEERS: &str = "title = \"peers\"\nanalysis = [\"response\"]\n[friction]\nknee_velocity = 5.0\n[axes]\n\
    mu_s = { from = 0.0, to = 0.6, points = 24 }\nmu_d = { from = 0.0, to = 0.6, points = 24 }\n\
    belt_velocity = { values = [0.5, 1.0, 3.0, 6.0] }\n[start]\nstart_velocity = 0.3\n[response]\nsettle = \"auto\"\n";

/// Instances that are computed together, as a sweep does.
const TOGETHER: usize = 512;

/// Instances with the plan to wait until they have settled.
pub(crate) struct Map {
    pub(crate) name: &'static str,
    pub(crate) instances: Vec<Instance>,
    plan: Plan,
}

/// Both maps.
pub(crate) fn all() -> Result<[Map; 2], Box<dyn Error>> {
    let sweeps = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps"));
    let map = |name, spec: Spec| Map {
        name,
        instances: (0..spec.grid.len()).map(|index| spec.instance(index)).collect(),
        plan: Instances::plan(&spec),
    };
    let peers = Spec::parse(PEERS, "peers.toml", sweeps)?;
    Ok([map("settled_map", Spec::read(&sweeps.join("settled_map.toml"))?), map("map of the peers", peers)])
}

impl Map {
    /// How it waits, and how it finds cycles.
    pub(crate) fn plans(&self) -> [Plan; 2] {
        let auto = Plan { settle: FIRST_SETTLE, hunts: false, measure: AUTO_MEASURE, ..self.plan };
        [auto, Plan { settle: FIRST_HUNT, hunts: true, ..auto }]
    }

    /// A run of a fixed time that judges others: in steps so fine that its own error does not count.
    pub(crate) fn fixed(&self, settle: Duration, measure: Duration) -> Plan {
        Plan { settle, settle_limit: None, hunts: false, measure, steps_per_period: 24, ..self.plan }
    }
}

/// The outcomes of instances on this thread.
pub(crate) fn run<T: Lanes>(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    let never = AtomicBool::new(false);
    let batch = |some: &[Instance]| outcomes::<T>(some, plan, &never).unwrap_or_default();
    instances.chunks(TOGETHER).flat_map(batch).collect()
}
