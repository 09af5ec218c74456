//! How well the march fills the warps of a GPU, without one: its twin in warps of 32 and 64 lanes, neighbours side by side,
//! on the map of `cargo bench --bench map`.
//!
//! What is counted are the operations of the kernel's text that any lane of a warp needs, reads and writes of buffers among
//! them. A compiler makes about as many instructions of them, where it fuses products and sums some fewer. Where the first word of an
//! instance is it finds out once, whereas the text says it at every word: that does not count.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;

use squealmap::engine::lanes::job::Part;
use squealmap::engine::lanes::{ORDER, tolerance};
use squealmap::engine::march::marching::Form;
use squealmap::engine::precision::Precision;
use squealmap::model::instance::Instance;
use squealmap::model::piece::LawForm;
use squealmap::version::COMMIT;
use squealmap_lockstep::{Count, Program};

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

/// The function that says where the first word of an instance is, and what it does.
const PLACE: [&str; 2] = ["first_place", "(instance / TOGETHER) * (words * TOGETHER) + instance % TOGETHER"];

/// Columns that say which case a row is.
const KEY: usize = 4;

/// Measures, prints and keeps the rows.
pub(crate) fn run(steps: &[&str]) -> Result<(), Box<dyn Error>> {
    println!("| {} |\n|{}", HEADER.join(" | "), "---|".repeat(HEADER.len()));
    let mut rows = Vec::new();
    let steps = steps.iter().map(|steps| steps.parse()).collect::<Result<Vec<u32>, _>>()?;
    for steps in if steps.is_empty() { vec![4, 12] } else { steps } {
        rows.extend(measured::<32>(steps));
        rows.extend(measured::<64>(steps));
    }
    println!("kept in {}", keep("gpu-lockstep.csv", &HEADER, KEY, rows)?.display());
    Ok(())
}

/// Prints where the operations of warps of so many lanes are, without those of less than a hundredth of them.
fn shown(functions: BTreeMap<(Part, String), Count>, lanes: usize, periods: f64) {
    let mut functions: Vec<_> = functions.into_iter().collect();
    let all: Count = functions.iter().map(|(_, count)| *count).sum();
    functions.retain(|(_, count)| 100 * count.issued > all.issued);
    functions.sort_by_key(|(_, count)| std::cmp::Reverse(count.issued));
    for ((part, name), Count { issued, useful }) in functions {
        let of_warps = (lanes as u64 * issued) as f64;
        let (per_period, filled) = (of_warps / periods, 100.0 * useful as f64 / of_warps);
        println!(
            "{part:?} in {lanes} lanes, {name}: {per_period:.0} operations per period, {filled:.1} % of lanes at work"
        );
    }
}

/// How many operations the text of a part has, for a law of two pieces.
fn of_text(part: Part) -> u64 {
    let form = Form { law: LawForm::Pieces, pieces: 2, ramp: false };
    let (kernel, choices) = form.kernel(part).expect("a kernel for two pieces");
    let text = kernel.source(Precision::F32, &choices);
    assert!(text.contains(PLACE[1]), "{} says it otherwise", PLACE[0]);
    Program::new(&text.replace(PLACE[1], "0u")).expect("a kernel that compiles").operations()
}

/// Rows of every part of a run, and of all.
fn measured<const W: usize>(steps: u32) -> Vec<Vec<String>> {
    let work = Work::of_size(SIZE);
    let instances: Vec<Instance> = (0..work.len()).map(|index| work.instance(index)).collect();
    let plan = plan(steps, ORDER, tolerance(Precision::F32, steps));
    let mut parts: BTreeMap<Option<Part>, Count> = BTreeMap::new();
    let mut functions: BTreeMap<(Part, String), Count> = BTreeMap::new();
    outcomes_seen::<f32, W>(&instances, &plan, |chunk| {
        for (name, count) in chunk.by_function.into_iter().filter(|(name, _)| name != PLACE[0]) {
            for part in [Some(chunk.part), None] {
                *parts.entry(part).or_default() += count;
            }
            *functions.entry((chunk.part, name)).or_default() += count;
        }
    });
    for part in functions.keys().map(|(part, _)| *part).collect::<BTreeSet<Part>>() {
        println!("{part:?}: {} operations in the text of pieces", of_text(part));
    }
    shown(functions, W, work.periods());
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
