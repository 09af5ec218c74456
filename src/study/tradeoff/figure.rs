//! The work-precision diagram: instances per second against error, the efficient frontier as a line.

use crate::results::figure::look::Look;
use crate::study::tradeoff::report::on_gpu;
use crate::sweep::accuracy::frontier::is_comparison;
use crate::sweep::accuracy::level::{Level, NAMES};
use crate::sweep::accuracy::row::{Row, pace};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::key;
use squealmap_figure::key::Sample;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::plot::Plot;
use squealmap_figure::scale::{Scale, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// Height of the panel, points.
const HEIGHT: f64 = 170.0;
/// Right of the panel, points.
const RIGHT: f64 = 8.0;
/// Radius of a mark, points.
const RADIUS: f64 = 1.9;
/// Height of a line of words below the panel, points.
const LINE: f64 = 11.0;
/// Margin around the marks, as a fraction of the panel: the number above the topmost has room in it.
const HEADROOM: f64 = 0.08;
/// Errors below this are drawn here, since an error of 0 has no logarithm.
const LEAST: f64 = 1e-16;
/// The frontier.
const FRONTIER: &str = r##"fill="none" stroke="#000000" stroke-width="0.7""##;
/// The lines of the accuracies that have a name.
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

/// The figure as an SVG document of single column width unless the look says otherwise.
#[must_use]
pub fn figure(heading: &str, rows: &[Row], look: &Look<'_>) -> String {
    let name = if heading.is_empty() { "Speed against error" } else { heading };
    let heading = look.title(name);
    let name = if heading.is_empty() { name } else { heading };
    look.fitted(name, HEIGHT, |part| draw(heading, rows, look, part * HEIGHT))
}

/// The picture and its size, with a panel of this height.
fn draw(heading: &str, rows: &[Row], look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let shown: Vec<&Row> = rows.iter().filter(|row| row.worst_p95.is_finite()).collect();
    let pace = pace(rows.iter());
    let page = look.points().unwrap_or(SINGLE_COLUMN);
    let bounds = NAMES.into_iter().filter_map(|(name, level)| match level {
        Level::Within(bound) => Some((name, bound)),
        Level::Reference => None,
    });
    let mut bounds: Vec<(&str, f64)> = bounds.collect();
    // As they stand in the panel.
    bounds.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (names, bounds): (Vec<&str>, Vec<f64>) = bounds.into_iter().unzip();
    let error = |row: &Row| row.worst_p95.max(LEAST);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, heading, page - 2.0 * MARGIN);
    let x_scale = logarithmic(shown.iter().map(|row| error(row)).chain(bounds.iter().copied()));
    let y_scale = logarithmic(shown.iter().map(|row| pace(row)));
    let y_ticks = y_ticks(&y_scale, height);
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&y_ticks);
    let width = page - left - RIGHT;
    let occurring = MARKS.iter().filter(|mark| shown.iter().any(|row| is(row, mark)));
    let mut entries: Vec<(Text, Sample<'_>)> = occurring
        .map(|mark| {
            let compared = shown.iter().any(|row| is(row, mark) && is_comparison(row));
            let compared = if compared { ", to compare" } else { "" };
            (Text::from(format!("{} {}{compared}", mark.0, mark.1)), Sample::Mark(RADIUS, mark.2))
        })
        .collect();
    entries.push((Text::from("efficient frontier"), Sample::Line(FRONTIER)));
    entries.push((Text::from(names.join(", ")), Sample::Line(NAMED)));
    y += key::rows(&mut svg, [left, y], width, LABEL_SIZE, &entries) + 4.0;
    let frame = Frame { x: left, y, width, height };
    let plot = Plot { frame, x: &x_scale, y: &y_scale };
    let ends = [y_scale.value(0.0), y_scale.value(1.0)];
    for bound in bounds {
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
        // The line rises to the right: left of a mark and above it there is none.
        let (across, up) = at(row);
        let words = value_label(f64::from(row.steps_per_period));
        let room = words.width(TICK_SIZE, false);
        let [right, base] = [across - RADIUS, up - RADIUS - 1.0];
        let covered = |other: &&Row| {
            let (x, y) = at(other);
            (right - room - RADIUS..right + RADIUS).contains(&x)
                && (base - TICK_SIZE..base + RADIUS).contains(&y)
        };
        let inside = right - room > frame.x && base - TICK_SIZE > frame.y;
        if inside && right - room > free && !shown.iter().any(covered) {
            svg.text(right, base, &words, Style::new(TICK_SIZE, Anchor::End));
            free = right + 1.0;
        }
    }
    frame.border(&mut svg);
    frame.x_ticks(&mut svg, &x_scale.ticks(6), true);
    frame.y_ticks(&mut svg, &y_ticks, true);
    let style = Style::new(LABEL_SIZE, Anchor::Middle);
    let words = if on_gpu(rows) { "Instances per second" } else { "Instances per second of a processor" };
    svg.text(MARGIN + LABEL_SIZE, y + 0.5 * height, &Text::from(words), style.upwards());
    y += height + x_tick_room() + LABEL_SIZE + 1.0;
    let words = "Relative error that 95 % are within";
    svg.text(left + 0.5 * frame.width, y, &Text::from(words), style);
    y += LINE;
    let words = "Numbers: steps per period on the frontier";
    svg.text(left + 0.5 * frame.width, y, &Text::from(words), Style::new(TICK_SIZE, Anchor::Middle));
    (svg, [page, y + MARGIN + 2.0])
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
