//! The work-precision diagram: instances per second against error, the efficient frontier as a line.

use super::figure::{MARGIN, SINGLE_COLUMN, program, title};
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use super::plot::Plot;
use super::scale::{Scale, value_label};
use super::svg::{Anchor, Style, Svg};
use super::text::Text;
use super::tradeoff::on_gpu;
use crate::accuracy::frontier::is_comparison;
use crate::accuracy::measure::Measurement;
use crate::accuracy::row::{Row, pace};

/// Height of the panel, points.
const HEIGHT: f64 = 170.0;
/// Right of the panel, points.
const RIGHT: f64 = 8.0;
/// Radius of a mark, points.
const RADIUS: f64 = 1.9;
/// Height of a line of the key, points.
const LINE: f64 = 11.0;
/// Margin around the marks, as a fraction of the panel.
const HEADROOM: f64 = 0.06;
/// Errors below are drawn here: what is exact has no logarithm.
const LEAST: f64 = 1e-16;
/// The frontier.
const FRONTIER: &str = r##"fill="none" stroke="#000000" stroke-width="0.7""##;
/// The accuracies that have a name, and their lines.
const BOUNDS: [f64; 3] = [1e-2, 1e-3, 1e-4];
const NAMED: &str = r##"fill="none" stroke="#999999" stroke-width="0.5" stroke-dasharray="2 2""##;

/// Marks by engine: fill and line.
const MARKS: [(&str, &str, &str); 7] = [
    ("reference", "f64", r##"fill="#000000""##),
    ("cpu", "f64", r##"fill="#1F3F8F""##),
    ("cpu", "f32", r##"fill="#FFFFFF" stroke="#1F3F8F" stroke-width="0.9""##),
    ("gpu", "f64", r##"fill="#D55E00""##),
    ("gpu", "f32", r##"fill="#FFFFFF" stroke="#D55E00" stroke-width="0.9""##),
    ("located RK4", "f64", r##"fill="#009E73""##),
    ("fixed step", "f64", r##"fill="#CC79A7""##),
];

/// The figure as an SVG document of single column width.
#[must_use]
pub fn figure(heading: &str, measured: &Measurement) -> String {
    let shown: Vec<&Row> = measured.rows.iter().filter(|row| row.worst_p95.is_finite()).collect();
    let pace = pace(measured.rows.iter());
    let error = |row: &Row| row.worst_p95.max(LEAST);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, heading, SINGLE_COLUMN - 2.0 * MARGIN);
    let x_scale = logarithmic(shown.iter().map(|row| error(row)).chain(BOUNDS));
    let y_scale = logarithmic(shown.iter().map(|row| pace(row)));
    let y_ticks = y_scale.ticks(6);
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&y_ticks);
    for mark in MARKS.iter().filter(|mark| shown.iter().any(|row| is(row, mark))) {
        svg.circle(left + RADIUS, y + LABEL_SIZE - 2.8, RADIUS, mark.2);
        let compared =
            if shown.iter().any(|row| is(row, mark) && is_comparison(row)) { ", to compare" } else { "" };
        let words = Text::from(format!("{} {}{compared}", mark.0, mark.1));
        svg.text(left + 8.0, y + LABEL_SIZE, &words, Style::new(LABEL_SIZE, Anchor::Start));
        y += LINE;
    }
    y += 6.0;
    let frame = Frame { x: left, y, width: SINGLE_COLUMN - left - RIGHT, height: HEIGHT };
    let plot = Plot { frame, x: &x_scale, y: &y_scale };
    let ends = [y_scale.value(0.0), y_scale.value(1.0)];
    for bound in BOUNDS {
        plot.curve(&mut svg, ends.map(|end| (bound, end)), NAMED);
    }
    let mut frontier: Vec<&Row> = shown.iter().copied().filter(|row| row.frontier).collect();
    frontier.sort_by(|a, b| error(a).total_cmp(&error(b)));
    plot.curve(&mut svg, frontier.iter().map(|row| (error(row), pace(row))), FRONTIER);
    let at = |row: &Row| (frame.across(x_scale.position(error(row))), frame.up(y_scale.position(pace(row))));
    for row in &shown {
        if let Some(mark) = MARKS.iter().find(|mark| is(row, mark)) {
            let (across, up) = at(row);
            svg.circle(across, up, RADIUS, mark.2);
        }
    }
    // The steps per period above the efficient ones, where neither words nor marks are in the way.
    let mut free = f64::MIN;
    for row in frontier {
        let (across, up) = at(row);
        let words = value_label(f64::from(row.steps_per_period));
        let half = 0.5 * words.width(TICK_SIZE, false);
        let covered = |other: &&Row| {
            let (x, y) = at(other);
            (x - across).abs() < half + RADIUS && (up - 4.0 - TICK_SIZE - RADIUS..up - RADIUS).contains(&y)
        };
        if across - half > free && !shown.iter().any(covered) {
            svg.text(across, up - 4.0, &words, Style::new(TICK_SIZE, Anchor::Middle));
            free = across + half + 1.0;
        }
    }
    frame.border(&mut svg);
    frame.x_ticks(&mut svg, &x_scale.ticks(6), true);
    frame.y_ticks(&mut svg, &y_ticks, true);
    let style = Style::new(LABEL_SIZE, Anchor::Middle);
    let words =
        if on_gpu(&measured.rows) { "Instances per second" } else { "Instances per second of a processor" };
    svg.text(MARGIN + LABEL_SIZE, y + 0.5 * HEIGHT, &Text::from(words), style.upwards());
    y += HEIGHT + x_tick_room() + LABEL_SIZE + 1.0;
    let words = "Relative error that 95 % are within";
    svg.text(left + 0.5 * frame.width, y, &Text::from(words), style);
    y += LINE;
    let words = "Numbers: steps per period on the efficient frontier (line)";
    svg.text(left + 0.5 * frame.width, y, &Text::from(words), Style::new(TICK_SIZE, Anchor::Middle));
    svg.finish(SINGLE_COLUMN, y + MARGIN + 2.0, heading, &program())
}

fn is(row: &Row, (backend, precision, _): &(&str, &str, &str)) -> bool {
    row.backend == *backend && row.precision == *precision
}

/// A logarithmic scale with a margin around some positive values.
fn logarithmic(values: impl Iterator<Item = f64>) -> Scale {
    match Scale::spanning(values) {
        Scale::Linear { low, high } if low > 0.0 => Scale::Log { low, high }.widened(HEADROOM),
        other => other,
    }
}
