//! The confusion table: rows of `benches/results/strokes.csv`, and the error rates that the program prints.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use crate::study::confusion::{Fate, JUDGES, Judged, table};
use crate::study::laboratory::{Drawn, Sensors};

/// The seed had no part in the building of anything.
const SEED: u64 = 3_300;
/// Strokes of each kind, sort of sensor and ratio of signal to noise: 750 in all.
const EACH: usize = 25;

/// Draws the strokes, judges them and writes both files.
pub(crate) fn write(root: &Path) -> Result<(), Box<dyn Error>> {
    let seed = std::env::var("SQUEALMAP_SEED").ok().and_then(|text| text.parse().ok());
    let judged: Vec<Judged> = [&Sensors::ALL[..2], &Sensors::ALL[2..]]
        .into_iter()
        .flat_map(|sensors| table(seed.unwrap_or(SEED), EACH, sensors))
        .collect();
    let mut rows = "strokes,forces,witness,number,right,undecided,wrong,confidently_wrong\n".to_owned();
    let mut rates = "forces,witness,number,decided,confidently_wrong\n".to_owned();
    for sensors in Sensors::ALL {
        let forces = sensors.words();
        for (judge, name) in JUDGES.into_iter().enumerate() {
            for drawn in Drawn::ALL.map(Some).into_iter().chain([None]) {
                let of: Vec<&Judged> = judged
                    .iter()
                    .filter(|j| j.sensors == sensors && drawn.is_none_or(|drawn| j.drawn == drawn))
                    .collect();
                let count = |fate: Fate| of.iter().filter(|j| j.fate(judge) == fate).count();
                let [right, undecided, confidently] =
                    [Fate::Right, Fate::Undecided, Fate::ConfidentlyWrong].map(count);
                let wrong = of.iter().filter(|j| j.wrong(judge)).count();
                let words = drawn.map_or("all", Drawn::words);
                writeln!(
                    rows,
                    "{words},{forces},{name},{},{right},{undecided},{wrong},{confidently}",
                    of.len()
                )?;
                if drawn.is_none() {
                    writeln!(rates, "{forces},{name},{},{},{confidently}", of.len(), right + confidently)?;
                }
            }
        }
    }
    let mut calibration = "witness,stated_from,stated_to,number,mean_stated,right\n".to_owned();
    for (judge, name) in JUDGES.into_iter().enumerate() {
        for bounds in [[0.3, 0.5], [0.5, 0.7], [0.7, 0.8], [0.8, 0.9], [0.9, 0.95], [0.95, 1.01]] {
            let inside = |p: f64| p >= bounds[0] && p < bounds[1];
            let of: Vec<_> = judged
                .iter()
                .flat_map(|j| &j.statements)
                .filter(|s| s.judge == judge && inside(s.probability))
                .collect();
            let mean = of.iter().map(|s| s.probability).sum::<f64>() / of.len().max(1) as f64;
            let right = of.iter().filter(|s| s.right).count() as f64 / of.len().max(1) as f64;
            writeln!(
                calibration,
                "{name},{},{},{},{mean:.3},{right:.3}",
                bounds[0],
                bounds[1].min(1.0),
                of.len()
            )?;
        }
    }
    print!("{rows}\n{calibration}");
    let asked = |name: &str| std::env::var_os(name).is_some();
    if !(asked("SQUEALMAP_SEED") || asked("SQUEALMAP_RATE")) {
        std::fs::write(root.join("benches/results/strokes.csv"), rows)?;
        std::fs::write(root.join("benches/results/strokes_calibration.csv"), calibration)?;
        std::fs::write(root.join("crates/identify/src/rates.csv"), rates)?;
    }
    Ok(())
}
