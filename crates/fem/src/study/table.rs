//! `fem.csv`: one row per coefficient of friction and mode.

use super::band::in_band;
use std::fmt::Write as _;

use super::growth::grows;
use super::{Outcome, Study};
use crate::sweep::State;

/// A column of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty for none.
    pub unit: &'static str,
    /// What it holds.
    pub meaning: &'static str,
}

/// The columns, in their order.
pub const COLUMNS: [Column; 10] = [
    Column { name: "mu", unit: "", meaning: "coefficient of friction" },
    Column {
        name: "mode",
        unit: "",
        meaning: "the mode, followed by its shape; 1 is the lowest at the first coefficient of friction",
    },
    Column { name: "frequency", unit: "Hz", meaning: "imaginary part of the eigenvalue over 2 pi" },
    Column { name: "growth_rate", unit: "1/s", meaning: "real part of the eigenvalue" },
    Column {
        name: "damping_ratio",
        unit: "",
        meaning: "minus the real part over the magnitude of the eigenvalue; negative where the mode grows",
    },
    Column { name: "unstable", unit: "", meaning: "1 where the mode grows, by more than rounding" },
    Column {
        name: "residual",
        unit: "",
        meaning: "root of the energy of the forces that are left over in the full problem against that of the shape; for a mode computed directly, that of the iteration",
    },
    Column {
        name: "direct",
        unit: "",
        meaning: "1 where the projected problem was not good enough and the mode was computed on the full problem",
    },
    Column {
        name: "growth_without_slope",
        unit: "1/s",
        meaning: "growth rate without the slope of friction: mode coupling alone",
    },
    Column {
        name: "growth_without_feedback",
        unit: "1/s",
        meaning: "growth rate without the feedback of the normal force, of which the slope is left: falling friction alone; the same for every coefficient of friction",
    },
];

/// What both tables say of a mode: frequency (Hz), growth rate (1/s), damping ratio, whether it grows, residual.
fn cells(state: &State, grows: bool) -> String {
    let lambda = state.lambda;
    // Without a frequency and a growth there is no ratio.
    let ratio =
        if lambda.norm() > 0.0 { (0.0 - lambda.re / lambda.norm()).to_string() } else { String::new() };
    // Zero without a sign.
    let growth = lambda.re + 0.0;
    let frequency = lambda.im / std::f64::consts::TAU;
    format!("{frequency},{growth},{ratio},{},{:e}", u8::from(grows), state.residual)
}

/// The table of all modes in the band, in full precision.
#[must_use]
pub fn table(study: &Study, outcome: &Outcome) -> Vec<u8> {
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.name).collect();
    let mut text = names.join(",") + "\n";
    for (i, mu) in study.mus.iter().enumerate() {
        for (k, mode) in outcome.modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode)) {
            let state = &mode.states[i];
            let [flat, frozen] = outcome.alone[k][i].map(|growth| growth + 0.0);
            let (cells, direct) = (cells(state, outcome.grows(k, i)), u8::from(state.direct));
            let _ = writeln!(text, "{mu},{},{cells},{direct},{flat},{frozen}", k + 1);
        }
    }
    text.into_bytes()
}

/// `vary.csv`: one row per value and mode in the band; nothing where nothing is varied.
#[must_use]
pub fn vary_table(study: &Study, outcome: &Outcome) -> Option<Vec<u8>> {
    let (asked, found) = (study.document.vary.as_ref()?, outcome.variation.as_ref()?);
    // The first column of the other table is friction; those behind the residual are not known here.
    let residual = COLUMNS.iter().position(|column| column.name == "residual")?;
    let shared = COLUMNS[1..=residual].iter().map(|column| column.name);
    let names: Vec<&str> = std::iter::once(asked.parameter.name()).chain(shared).collect();
    let mut text = names.join(",") + "\n";
    for (i, value) in found.values.iter().enumerate() {
        for (k, mode) in found.modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode)) {
            let state = &mode.states[i];
            let cells = cells(state, grows(state.lambda, found.damped));
            let _ = writeln!(text, "{value:e},{},{cells}", k + 1);
        }
    }
    Some(text.into_bytes())
}
