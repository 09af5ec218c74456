//! A fitted material as the file that sweeps read, and what it leaves of the points.

use std::fmt::Write as _;

use crate::results::csv::Table;
use crate::study::error::Result;
use crate::study::fit::Fit;
use crate::sweep::columns::Cell;
use squealmap_identify::Point;
use squealmap_input::quote::rounded;

/// The columns of the residuals, SI units, temperature in °C.
pub(super) const RESIDUALS: [&str; 5] = ["velocity", "temperature", "friction", "fitted", "residual"];

/// The file of a material: comments with what it was fitted to and its standard errors, `temperature` and one column per law
/// parameter, rising temperatures.
#[must_use]
pub fn material_csv(fit: &Fit, points: &[Point], source: &str) -> String {
    // A comment ends at the end of its line.
    let source: String = source.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut text = format!(
        "# Fitted to {} points of {source}: law \"{}\", root mean square residual {:.2e}.\n\
         # Measured from {} °C, at {} m/s.\n",
        fit.points,
        fit.law.name(),
        fit.residual,
        span(points, |point| point.temperature),
        span(points, |point| point.velocity.abs()),
    );
    text += &standard_errors(fit);
    text += "# Columns: temperature in °C, then law parameters in SI units.\n";
    let _ = writeln!(text, "{}", header(fit));
    for (row, temperature) in fit.temperature.iter().enumerate() {
        let _ = write!(text, "{}", Cell::from(*temperature));
        for (_, values) in &fit.columns {
            let _ = write!(text, ",{}", Cell::from(values[row]));
        }
        text.push('\n');
    }
    text
}

/// `temperature,mu_s,…`
fn header(fit: &Fit) -> String {
    let names = fit.columns.iter().map(|(param, _)| param.info().name);
    std::iter::once("temperature").chain(names).collect::<Vec<_>>().join(",")
}

/// The standard errors as comments, a row of them per row of the material.
fn standard_errors(fit: &Fit) -> String {
    let Some(deviation) = fit.deviation.filter(|_| fit.errors.iter().any(Option::is_some)) else {
        return "# Standard errors: the points do not tell them.\n".to_owned();
    };
    let mut text = format!(
        "# Standard errors, for independent errors of friction with the standard deviation {deviation:.2e} that the points have \
         about the law:\n# {}\n",
        header(fit)
    );
    for (row, temperature) in fit.temperature.iter().enumerate() {
        let _ = write!(text, "# {}", Cell::from(*temperature));
        for errors in &fit.errors {
            // A velocity that was given has none.
            let _ = match errors {
                Some(errors) => write!(text, ",{:.2e}", errors[row]),
                None => write!(text, ",given"),
            };
        }
        text.push('\n');
    }
    text
}

/// `100 to 500`, or `20` where all are alike.
pub(super) fn span(points: &[Point], of: impl Fn(&Point) -> f64) -> String {
    let [low, high] = crate::study::fit::range(points, of);
    let [low, high] = [low, high].map(rounded);
    if low < high { format!("{low} to {high}") } else { low.to_string() }
}

/// Every point with what the law gives there and what it leaves, in the order of the points.
///
/// # Errors
/// When a row cannot be written.
pub fn residuals_csv(fit: &Fit, points: &[Point]) -> Result<Vec<u8>> {
    let mut table = Table::new(RESIDUALS.iter())?;
    for (point, residual) in points.iter().zip(&fit.residuals) {
        let Point { velocity, temperature, friction, .. } = *point;
        let row = [velocity, temperature, friction, friction - residual, *residual];
        table.row(row.into_iter().map(|value| Cell::from(value).to_string()))?;
    }
    Ok(table.finish()?)
}
