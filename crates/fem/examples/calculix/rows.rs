//! The rows of benches/results/calculix.csv.

use std::fmt::Write as _;

use crate::Failure;
use crate::cost::Cost;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/results/calculix.csv");
const HEAD: &str = "model,program,wall_s,work_s,memory_gb,largest_difference,with_exact_mass,load_before";

/// Programs that wanted to run in the last minute, where Linux tells.
pub(crate) fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace().next().unwrap_or("unknown").to_owned()
}

/// Writes the rows of a model, and leaves those of others; `worst` is the largest difference with the mass as CalculiX integrates it, and
/// with the exact one.
pub(crate) fn write(model: &str, costs: [Cost; 2], worst: [f64; 2], load: &str) -> Result<(), Failure> {
    let [alike, exact] = worst;
    let of = format!("{model},");
    let known = std::fs::read_to_string(FILE).unwrap_or_default();
    let mut text = format!("{HEAD}\n");
    for line in known.lines().skip(1).filter(|line| !line.starts_with(&of)) {
        let _ = writeln!(text, "{line}");
    }
    for (program, cost) in ["squealmap-fem", "CalculiX"].iter().zip(costs) {
        let Cost { wall, work, memory } = cost;
        let _ =
            writeln!(text, "{of}{program},{wall:.2},{work:.2},{memory:.3},{alike:.1e},{exact:.1e},{load}");
    }
    Ok(std::fs::write(FILE, text)?)
}
