//! The two-panel figure of the modes: frequency above, growth rate below, as Figure 2 of the paper.

use crate::model::linear::is_unstable;
use crate::results::figure::beside::{most_panels, parted};
use crate::results::figure::look::Look;
use crate::results::figure::panels::{selection, setting};
use crate::results::figure::picture_axis::{Direction, PictureAxis};
use crate::study::error::Result;
use crate::study::modes::follow::{Branch, Mode, Modes, modes_of};
use crate::sweep::grid::{AxisKey, Grid};
use crate::sweep::spec::Spec;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::plot::{CRITICAL, FIRST, GROWS, Plot, SECOND, STABLE, ZERO};
use squealmap_figure::scale::{Scale, axis_unit, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;
use squealmap_figure::{key, letters};

/// Height of a panel, points.
const HEIGHT: f64 = 120.0;
/// Between the two panels, points.
const GAP: f64 = 9.0;
/// Between columns, points: room for half of two tick labels.
const GAP_ACROSS: f64 = 15.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.08;
/// Height of a line of text, points.
const LINE: f64 = 10.0;

/// Two modes by name, each with its line,
const NAMED: [(&str, &str); 2] = [("mode 1", FIRST), ("mode 2", SECOND)];
/// or many by what they do.
const MANY: [(&str, &str); 2] = [("stable", STABLE), ("unstable", GROWS)];

/// The figure of a sweep's eigenvalues as an SVG document: single column width for one branch.
///
/// # Errors
/// When the sweep has no axis of numbers with at least two values, or no instance with modes.
pub fn modes_svg(spec: &Spec) -> Result<String> {
    Ok(draw(spec, &modes_of(spec)?, &Look::default()))
}

/// The figure of modes that were followed: single column width for one branch, double for several, unless the look says
/// otherwise.
#[must_use]
pub fn draw(spec: &Spec, modes: &Modes, look: &Look<'_>) -> String {
    let name = look.title(&spec.title);
    let name = if name.is_empty() { "Modes" } else { name };
    look.fitted(name, 2.0 * HEIGHT, |part| page(spec, modes, look, part * HEIGHT))
}

/// The picture and its size, with panels of this height.
fn page(spec: &Spec, modes: &Modes, look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let usual = if modes.branches.len() > 1 { DOUBLE_COLUMN } else { SINGLE_COLUMN };
    let width = look.points().unwrap_or(usual);
    let shown = shown(modes, most_panels(width));
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(&spec.title), width - 2.0 * MARGIN);
    let axis = match &spec.grid {
        Grid::Axes(axes) => PictureAxis::cells(&axes[modes.axis]),
        Grid::Tuples { .. } => PictureAxis::single(),
    };
    let x = Scale::spanning(shown.iter().flat_map(|branch| branch.values.iter().copied()));
    let all = || shown.iter().flat_map(|branch| branch.modes.iter().flatten().flatten());
    let (hertz, unit) = unit(all().map(Mode::frequency).fold(0.0, f64::max));
    let frequency = Scale::spanning(all().map(|mode| mode.frequency() / hertz)).widened(HEADROOM);
    let growth = Scale::spanning(all().map(Mode::growth_rate).chain([0.0])).widened(HEADROOM);
    let scales = [frequency, growth];
    let ticks = scales.each_ref().map(|scale| y_ticks(scale, height));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let columns = shown.len().max(1) as f64;
    let across = (width - left - RIGHT - (columns - 1.0) * GAP_ACROSS) / columns;
    let names = if modes.count() > NAMED.len() { MANY } else { NAMED };
    let names = names.map(|(name, stroke)| (Text::from(name), stroke));
    key::lines(&mut svg, left, y + LABEL_SIZE - 1.2, LABEL_SIZE, &names);
    y += LABEL_SIZE + 5.0;
    let titles: Vec<Vec<Text>> = shown.iter().map(|branch| settings(spec, modes, branch)).collect();
    let lines = titles.iter().map(Vec::len).max().unwrap_or(0) as f64;
    y += lines * LINE;
    let mark_room = if shown.iter().any(|branch| !branch.critical.is_empty()) { LINE } else { 0.0 };
    y += mark_room;
    let axis = axis.edge_to_edge(&x);
    let x_ticks = axis.ticks(across, Direction::Horizontal, TICK_SIZE);
    // The last label of a panel must not run into the first of the next.
    let inner_ticks = parted(&axis, across, GAP_ACROSS);
    for (number, branch) in shown.iter().enumerate() {
        let from = left + number as f64 * (across + GAP_ACROSS);
        for (line, text) in titles[number].iter().rev().enumerate() {
            let base = y - mark_room - 3.5 - line as f64 * LINE;
            svg.text(from + 0.5 * across, base, text, Style::new(LABEL_SIZE, Anchor::Middle));
        }
        for (row, scale) in scales.iter().enumerate() {
            let frame = Frame { x: from, y: y + row as f64 * (height + GAP), width: across, height };
            let plot = Plot { frame, x: &x, y: scale };
            curves(&mut svg, &plot, branch, (row == 0).then_some(hertz));
            frame.border(&mut svg);
            let ticks_below = if number + 1 < shown.len() { &inner_ticks } else { &x_ticks };
            frame.x_ticks(&mut svg, ticks_below, row == 1);
            frame.y_ticks(&mut svg, &ticks[row], number == 0);
        }
        let frame = Frame { x: from, y, width: across, height: 2.0 * height + GAP };
        critical(&mut svg, spec, modes, branch, &x, &frame);
    }
    for (row, (words, unit)) in [("Frequency", unit), ("Growth rate", "1/s")].into_iter().enumerate() {
        let frame = Frame { x: left, y: y + row as f64 * (height + GAP), width: 0.0, height };
        let words = Text::from(words).then(axis_unit(unit, scales[row].exponent()));
        letters::side(&mut svg, (row, 2), &frame, &[words]);
    }
    y += 2.0 * height + GAP + x_tick_room() + LABEL_SIZE + 1.0;
    let whole = columns * (across + GAP_ACROSS) - GAP_ACROSS;
    svg.text(left + 0.5 * whole, y, &axis.label(whole, LABEL_SIZE), Style::new(LABEL_SIZE, Anchor::Middle));
    if shown.len() < modes.branches.len() {
        y += LABEL_SIZE + 6.0;
        let note = format!("{} of {} panels shown; the table holds all.", shown.len(), modes.branches.len());
        svg.text(MARGIN, y, &Text::from(note), Style::new(LABEL_SIZE, Anchor::Start));
    }
    (svg, [width, y + MARGIN + 2.0])
}

/// An even selection of at most so many branches, of those that have modes.
fn shown(modes: &Modes, most: usize) -> Vec<&Branch> {
    let with_modes = |branch: &&Branch| branch.modes.iter().any(Option::is_some);
    let all: Vec<&Branch> = modes.branches.iter().filter(with_modes).collect();
    selection(all.len(), most).map(|number| all[number]).collect()
}

/// The values of the further axes of a branch.
fn settings(spec: &Spec, modes: &Modes, branch: &Branch) -> Vec<Text> {
    let keys = spec.grid.keys();
    let values = spec.grid.coordinates(branch.first);
    let further = (0..keys.len()).filter(|i| *i != modes.axis);
    further.map(|i| setting(keys[i], values[i])).collect()
}

/// The unit of an axis of frequencies up to this one (Hz), in Hz and by name: kHz from 10 kHz on, as in the figures of studies.
fn unit(largest: f64) -> (f64, &'static str) {
    if largest >= 1e4 { (1e3, "kHz") } else { (1.0, "Hz") }
}

/// Frequencies in a unit (Hz), or growth rates.
fn curves(svg: &mut Svg, plot: &Plot<'_>, branch: &Branch, hertz: Option<f64>) {
    let nothing = f64::NAN;
    if hertz.is_none() {
        plot.curve(svg, [branch.values[0], branch.values[branch.values.len() - 1]].map(|x| (x, 0.0)), ZERO);
    }
    let value = |mode: &Mode| hertz.map_or_else(|| mode.growth_rate(), |hertz| mode.frequency() / hertz);
    let along = |k: usize, wanted: fn(&Mode) -> bool| {
        let points = branch.values.iter().zip(&branch.modes);
        points.map(move |(x, modes)| {
            let mode = modes.as_ref().map(|modes| modes[k]).filter(wanted);
            (*x, mode.map_or(nothing, |mode| value(&mode)))
        })
    };
    let count = branch.modes.iter().flatten().map(Vec::len).max().unwrap_or(0);
    if count <= NAMED.len() {
        for (k, (_, stroke)) in NAMED.into_iter().enumerate().take(count) {
            plot.curve(svg, along(k, |_| true), stroke);
        }
        return;
    }
    // What grows lies on top.
    let courses: [fn(&Mode) -> bool; 2] = [|_| true, |mode| is_unstable(mode.value)];
    for ((_, stroke), wanted) in MANY.into_iter().zip(courses) {
        for k in 0..count {
            plot.curve(svg, along(k, wanted), stroke);
        }
    }
}

/// A line through both panels at each critical value, with its value above.
fn critical(svg: &mut Svg, spec: &Spec, modes: &Modes, branch: &Branch, x: &Scale, frame: &Frame) {
    /// Digits of a critical value: more than a plot resolves, enough to compare.
    const DIGITS: usize = 3;
    let Some(AxisKey::Param(param)) = spec.grid.keys().get(modes.axis).copied() else { return };
    let mut free = f64::MIN;
    for value in branch.critical.iter().copied() {
        let at = frame.across(x.position(value));
        svg.path(&polyline([(at, frame.y), (at, frame.bottom())]), CRITICAL);
        let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
        let text = Text::default().symbol(param.info().symbol).plain(" = ").then(value_label(rounded));
        let half = 0.5 * text.width(TICK_SIZE, false);
        let middle = at.clamp(frame.x + half, (frame.x + frame.width - half).max(frame.x + half));
        // Labels that would overlap are left out: the table has the values.
        if middle - half > free {
            svg.text(middle, frame.y - 3.0, &text, Style::new(TICK_SIZE, Anchor::Middle));
            free = middle + half + 2.0;
        }
    }
}
