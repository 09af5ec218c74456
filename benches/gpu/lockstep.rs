//! How well the march fills the warps of a GPU, without one: its twin in warps of 32 and 64 lanes, neighbours side by side,
//! on the map of `cargo bench --bench map`.
//!
//! What is counted are the operations of the kernel's text that any lane of a warp needs, reads and writes of buffers among
//! them. A compiler makes about as many instructions of them, where it fuses products and sums some fewer.

use std::collections::BTreeMap;
use std::error::Error;

use squealmap::engine::lanes::job::Part;
use squealmap::engine::lanes::{ORDER, tolerance};
use squealmap::engine::precision::Precision;
use squealmap::model::instance::Instance;
use squealmap::version::COMMIT;
use squealmap_lockstep::Count;

use crate::date::date;
use crate::kept::keep;
use crate::twin::outcomes_seen;
use crate::work::{Work, plan};

/// Instances of the map: as many as a chunk of a software adapter on two cores.
const SIZE: usize = 1024;

const HEADER: [&str; 8] = [
    "part",
    "lanes",
    "steps_per_period",
    "instances",
    "date",
    "commit",
    "warp_operations_per_period",
    "lanes_at_work_percent",
];

/// Columns that say which case a row is.
const KEY: usize = 4;

/// Measures, prints and keeps the rows.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    println!("| {} |\n|{}", HEADER.join(" | "), "---|".repeat(HEADER.len()));
    let mut rows = Vec::new();
    for steps in [4, 12] {
        rows.extend(measured::<32>(steps));
        rows.extend(measured::<64>(steps));
    }
    println!("kept in {}", keep("gpu-lockstep.csv", &HEADER, KEY, rows)?.display());
    Ok(())
}

/// Rows of every part of a run, and of all.
fn measured<const W: usize>(steps: u32) -> Vec<Vec<String>> {
    let work = Work::of_size(SIZE);
    let instances: Vec<Instance> = (0..work.len()).map(|index| work.instance(index)).collect();
    let plan = plan(steps, ORDER, tolerance(Precision::F32, steps));
    let mut parts: BTreeMap<Option<Part>, Count> = BTreeMap::new();
    outcomes_seen::<f32, W>(&instances, &plan, |chunk| {
        for part in [Some(chunk.part), None] {
            let count = parts.entry(part).or_default();
            count.issued += chunk.count.issued;
            count.useful += chunk.count.useful;
        }
    });
    let row = |(part, count): (Option<Part>, Count)| {
        let name = part.map_or("all".to_owned(), |part| format!("{part:?}").to_lowercase());
        let key = [name, W.to_string(), steps.to_string(), work.len().to_string()];
        let of_warps = (W as u64 * count.issued) as f64;
        let values = [
            date(),
            COMMIT.unwrap_or("unknown").to_owned(),
            format!("{:.0}", of_warps / work.periods()),
            format!("{:.1}", 100.0 * count.useful as f64 / of_warps),
        ];
        let fields: Vec<String> = key.into_iter().chain(values).collect();
        println!("| {} |", fields.join(" | "));
        fields
    };
    parts.into_iter().map(row).collect()
}
