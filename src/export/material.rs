//! A fitted material as the file that sweeps read.

use std::fmt::Write as _;

use super::columns::Cell;
use crate::fit::Fit;

/// The file of a material: comments, `temperature` and one column per law parameter, rising temperatures.
#[must_use]
pub fn material_csv(fit: &Fit, source: &str) -> String {
    // A comment ends at the end of its line.
    let source: String = source.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut text = format!(
        "# Fitted to {} points of {source}: law \"{}\", root mean square residual {:.2e}.\n\
         # Columns: temperature in °C, then law parameters in SI units.\ntemperature",
        fit.points,
        fit.law.name(),
        fit.residual
    );
    for (param, _) in &fit.columns {
        let _ = write!(text, ",{}", param.info().name);
    }
    text.push('\n');
    for (row, temperature) in fit.temperature.iter().enumerate() {
        let _ = write!(text, "{}", Cell::from(*temperature));
        for (_, values) in &fit.columns {
            let _ = write!(text, ",{}", Cell::from(values[row]));
        }
        text.push('\n');
    }
    text
}
