//! Tables over temperature as the file that sweeps read.

use std::fmt::Write as _;

use crate::study::fit::binned::{Bin, Binned, at_rest};
use crate::study::fit::table::span;
use crate::sweep::columns::Cell;
use squealmap_identify::Point;
use squealmap_input::quote::one_line;

/// The file of a material of tables: comments with what it was made of, then `temperature,velocity,mu,mu_error`.
#[must_use]
pub fn tables_csv(binned: &Binned, points: &[Point], source: &str) -> String {
    let mut text = format!(
        "# Means of {} points of {} in bins of velocity: law \"table\", root mean square residual {:.2e}.\n\
         # Measured from {} °C, at {} m/s.\n",
        binned.fit.points,
        one_line(source),
        binned.fit.residual,
        span(points, |point| point.temperature),
        span(points, |point| point.velocity.abs()),
    );
    for row in &binned.rows {
        let counts = row.bins.iter().map(|bin| bin.points);
        let (least, most) = (counts.clone().min().unwrap_or(0), counts.max().unwrap_or(0));
        let _ = writeln!(
            text,
            "# {} °C: {} bins of {least} to {most} points, measured at {:.2} °C in the mean.",
            Cell::from(row.temperature),
            row.bins.len(),
            row.measured
        );
    }
    text += "# A row at 0 m/s, the limit of stick, without mu_error: there the line through the two slowest bins ends.\n\
             # mu_error: standard error of mu by the scatter in its bin, for independent errors of friction; sweeps pass over it.\n\
             temperature,velocity,mu,mu_error\n";
    for row in &binned.rows {
        let temperature = Cell::from(row.temperature);
        if let Some(friction) = at_rest(&row.bins) {
            let _ = writeln!(text, "{temperature},0,{},", Cell::from(friction));
        }
        for Bin { velocity, friction, error, .. } in &row.bins {
            let (velocity, friction) = (Cell::from(*velocity), Cell::from(*friction));
            let _ = writeln!(text, "{temperature},{velocity},{friction},{error:.2e}");
        }
    }
    text
}
