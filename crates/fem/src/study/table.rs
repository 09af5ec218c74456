//! `fem.csv`: one row per coefficient of friction and mode.

use super::band::in_band;
use std::fmt::Write as _;

use super::transitions::grows;
use super::{Outcome, Study};

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
    Column {
        name: "unstable",
        unit: "",
        meaning: "1 where the mode grows, by more than rounding where nothing damps",
    },
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

/// The table of all modes in the band, in full precision.
#[must_use]
pub fn table(study: &Study, outcome: &Outcome) -> Vec<u8> {
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.name).collect();
    let mut text = names.join(",") + "\n";
    for (i, mu) in study.mus.iter().enumerate() {
        for (k, mode) in outcome.modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode)) {
            let state = &mode.states[i];
            let lambda = state.lambda;
            let [flat, frozen] = outcome.alone[k][i].map(|growth| growth + 0.0);
            // Without a frequency and a growth there is no ratio.
            let ratio = if lambda.norm() > 0.0 {
                (0.0 - lambda.re / lambda.norm()).to_string()
            } else {
                String::new()
            };
            let _ = writeln!(
                text,
                "{mu},{},{},{},{ratio},{},{:e},{},{flat},{frozen}",
                k + 1,
                lambda.im / std::f64::consts::TAU,
                // Zero without a sign.
                lambda.re + 0.0,
                u8::from(outcome.grows(k, i)),
                state.residual,
                u8::from(state.direct)
            );
        }
    }
    text.into_bytes()
}

/// `vary.csv`: one row per value and mode in the band; nothing where nothing is varied.
#[must_use]
pub fn vary_table(study: &Study, outcome: &Outcome) -> Option<Vec<u8>> {
    let (asked, found) = (study.document.vary.as_ref()?, outcome.variation.as_ref()?);
    let mut text =
        format!("{},mode,frequency,growth_rate,damping_ratio,unstable,residual\n", asked.parameter.name());
    for (i, value) in found.values.iter().enumerate() {
        for (k, mode) in found.modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode)) {
            let (lambda, residual) = (mode.states[i].lambda, mode.states[i].residual);
            let _ = writeln!(
                text,
                "{value:e},{},{},{},{},{},{residual:e}",
                k + 1,
                lambda.im / std::f64::consts::TAU,
                lambda.re + 0.0,
                0.0 - lambda.re / lambda.norm(),
                u8::from(grows(lambda, found.damped)),
            );
        }
    }
    Some(text.into_bytes())
}
