//! How far numbers are apart, and the rows of benches/results/calculix.csv.

use std::fmt::Write as _;

use crate::Failure;
use crate::cost::Cost;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/results/calculix.csv");
const HEAD: &str = "model,program,wall_s,work_s,memory_gb,largest_difference,load_before";

/// Relative difference of two numbers.
pub(crate) fn apart(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// The largest difference of two lists, above any bound where one of them is no number.
///
/// # Errors
/// Lists of different lengths, or without a number.
pub(crate) fn worst(ours: &[f64], theirs: &[f64]) -> Result<f64, Failure> {
    if ours.len() != theirs.len() || ours.is_empty() {
        return Err(format!("{} numbers here, {} of CalculiX", ours.len(), theirs.len()).into());
    }
    let apart = ours.iter().zip(theirs).map(|(a, b)| apart(*a, *b));
    Ok(apart.map(|x| if x.is_finite() { x } else { f64::INFINITY }).fold(0.0, f64::max))
}

/// Programs that wanted to run in the last minute, where Linux tells.
pub(crate) fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace().next().unwrap_or("unknown").to_owned()
}

/// Writes the rows of a model, and leaves those of others.
pub(crate) fn write(model: &str, costs: [Cost; 2], worst: f64, load: &str) -> Result<(), Failure> {
    let of = format!("{model},");
    let known = std::fs::read_to_string(FILE).unwrap_or_default();
    let mut text = format!("{HEAD}\n");
    for line in known.lines().skip(1).filter(|line| !line.starts_with(&of)) {
        let _ = writeln!(text, "{line}");
    }
    for (program, cost) in ["squealmap-fem", "CalculiX"].iter().zip(costs) {
        let Cost { wall, work, memory } = cost;
        let _ = writeln!(text, "{of}{program},{wall:.2},{work:.2},{memory:.3},{worst:.1e},{load}");
    }
    Ok(std::fs::write(FILE, text)?)
}

#[cfg(test)]
mod tests {
    use super::worst;

    #[test]
    fn a_planted_fault_is_seen() -> Result<(), super::Failure> {
        let right = [1.0, -2.0, 3.0];
        assert!(worst(&right, &right)? < 1e-15);
        assert!(worst(&right, &[1.0, -2.0, 3.0003])? > 0.9e-4);
        assert!(worst(&right, &[1.0, 2.0, 3.0])? > 1.0);
        assert!(worst(&right, &[1.0, f64::NAN, 3.0])?.is_infinite());
        assert!(worst(&right, &[1.0, 0.0, 3.0])?.is_infinite());
        assert!(worst(&right, &right[..2]).is_err());
        assert!(worst(&[], &[]).is_err());
        Ok(())
    }
}
