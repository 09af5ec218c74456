//! The figure of a trajectory: stacked panels on one time axis, shaded by contact state.

use crate::model::contact::ContactState;
use crate::results::figure::heading::Heading;
use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::study::trace::run::{Trace, TraceRow};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::key::Sample;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN};
use squealmap_figure::plot::Plot;
use squealmap_figure::scale::{Scale, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::{key, letters};

/// Height of a panel, points.
const HEIGHT: f64 = 88.0;
/// Between panels, points.
const GAP: f64 = 8.0;
/// Above a panel of several curves, where their names stand, points.
const KEY_GAP: f64 = TICK_SIZE + 8.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Shading is resolved to columns of this width, points.
const COLUMN: f64 = 0.3;
/// Between the whole run and its last periods, points.
const COLUMN_GAP: f64 = 10.0;
/// The last periods take this share of the width.
const ZOOM_SHARE: f64 = 0.42;
/// So many of the last periods are shown ...
const SHOWN_PERIODS: f64 = 4.0;
/// ... when the run holds at least this many.
const MANY_PERIODS: f64 = 12.0;
/// A tick of the time axis takes about this much, points.
const TICK_WIDTH: f64 = 36.0;
/// The first and second curve of a panel.
const STROKES: [&str; 2] = [
    r##"fill="none" stroke="#1F3F8F" stroke-width="0.6" stroke-linejoin="round""##,
    r##"fill="none" stroke="#E08A3C" stroke-width="0.6" stroke-linejoin="round""##,
];

/// Shaded states with their colours, light enough for curves on top; slip stays white.
const SHADES: [(ContactState, &str, &str); 3] = [
    (ContactState::Stick, "#CDEBE2", "stick"),
    (ContactState::Free, "#F3D6EC", "free flight"),
    (ContactState::Reverse, "#D6D6D6", "reversed slip"),
];

/// A curve of a panel.
struct Curve {
    symbol: &'static str,
    value: fn(&TraceRow) -> f64,
}

/// The panels from top to bottom: their curves and their unit.
const PANELS: [(&[Curve], &str); 4] = [
    (&[Curve { symbol: "x_2", value: |row| 1e3 * row.position[0] }], "mm"),
    (&[Curve { symbol: "ẋ_2", value: |row| row.velocity[0] }], "m/s"),
    (
        &[
            Curve { symbol: "ẍ_2", value: |row| row.acceleration[0] },
            Curve { symbol: "ÿ_1", value: |row| row.acceleration[2] },
        ],
        "m/s^2",
    ),
    (
        &[
            Curve { symbol: "N", value: |row| row.normal_force },
            Curve { symbol: "T", value: |row| row.tangential_force },
        ],
        "N",
    ),
];

/// The figure of a trajectory as an SVG document, double column width unless the look says otherwise: the whole run
/// and, where that holds many periods, its last few beside it.
///
/// # Errors
/// None so far; figures share one signature.
pub fn trace_svg(trace: &Trace, heading: &Heading, look: &Look<'_>) -> Result<String> {
    let heading = look.headed(heading);
    let panels = HEIGHT * PANELS.len() as f64;
    Ok(look.fitted(heading.name("Trajectory"), panels, |part| draw(trace, &heading, look, part * HEIGHT)))
}

/// The picture and its size, with panels of this height.
fn draw(trace: &Trace, heading: &Heading, look: &Look<'_>, panel: f64) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let mut svg = Svg::new();
    let mut y = MARGIN + heading.draw(&mut svg, page - 2.0 * MARGIN);
    let scales = PANELS.map(|(curves, _)| {
        let values = curves.iter().flat_map(|curve| trace.rows.iter().map(curve.value));
        Scale::spanning(values).widened(HEADROOM)
    });
    let ticks = scales.each_ref().map(|scale| y_ticks(scale, panel));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let time_ticks = |rows: &[TraceRow], width: f64| {
        let time = Scale::spanning(rows.iter().map(|row| row.t));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
        let ticks = time.ticks((width / TICK_WIDTH) as usize);
        (time, ticks)
    };
    // The last label may reach beyond the panel.
    let beyond = columns(trace, page - left - RIGHT).pop().and_then(|(rows, width)| {
        let (_, ticks) = time_ticks(rows, width);
        ticks.last().map(|tick| 0.5 * tick.label.width(TICK_SIZE, false))
    });
    let right = beyond.map_or(RIGHT, |beyond| RIGHT.max(beyond + 1.0));
    y = legend(&mut svg, trace, [left, y], page - left - right);
    let tops = tops(y, panel);
    let bottom = tops[PANELS.len() - 1] + panel;
    let mut from = left;
    let columns = columns(trace, page - left - right);
    let last = columns.len() - 1;
    for (column, (rows, width)) in columns.into_iter().enumerate() {
        let (time, x_ticks) = time_ticks(rows, width);
        for (number, (curves, _)) in PANELS.iter().enumerate() {
            let frame = Frame { x: from, y: tops[number], width, height: panel };
            let plot = Plot { frame, x: &time, y: &scales[number] };
            // Over many periods the states alternate faster than a printer resolves.
            if column == last {
                shade(&mut svg, rows, &time, &frame);
            }
            for (curve, stroke) in curves.iter().zip(STROKES) {
                plot.curve(&mut svg, rows.iter().map(|row| (row.t, (curve.value)(row))), stroke);
            }
            frame.border(&mut svg);
            frame.y_ticks(&mut svg, &ticks[number], column == 0);
            frame.x_ticks(&mut svg, &x_ticks, number + 1 == PANELS.len());
            if curves.len() > 1 && column == 0 {
                let names = curves.iter().map(|curve| Text::default().symbol(curve.symbol));
                let entries: Vec<(Text, &str)> = names.zip(STROKES).collect();
                key::lines(&mut svg, frame.x, frame.y - 4.0, TICK_SIZE, &entries);
            }
        }
        let label = Text::from("Time ").symbol("t").plain(" (s)");
        let base = bottom + x_tick_room() + LABEL_SIZE + 1.0;
        svg.text(from + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
        from += width + COLUMN_GAP;
    }
    for (number, (curves, unit)) in PANELS.iter().enumerate() {
        let label = axis_label(curves, unit, scales[number].exponent());
        let frame = Frame { x: left, y: tops[number], width: 0.0, height: panel };
        letters::side(&mut svg, (number, PANELS.len()), &frame, &[label]);
    }
    let height = bottom + x_tick_room() + LABEL_SIZE + 3.0 + MARGIN;
    (svg, [page, height])
}

/// The samples and width of each column: everything, and the last few periods when there are many.
fn columns(trace: &Trace, width: f64) -> Vec<(&[TraceRow], f64)> {
    let rows = trace.rows.as_slice();
    let whole = vec![(rows, width)];
    let Some([first, last]) = rows.first().zip(rows.last()).map(|(first, last)| [first.t, last.t]) else {
        return whole;
    };
    let Some(frequency) = trace.outcome.response_frequency.filter(|f| f.is_finite() && *f > 0.0) else {
        return whole;
    };
    if (last - first) * frequency < MANY_PERIODS {
        return whole;
    }
    let start = rows.partition_point(|row| row.t < last - SHOWN_PERIODS / frequency);
    let zoom = ZOOM_SHARE * (width - COLUMN_GAP);
    vec![(rows, width - COLUMN_GAP - zoom), (&rows[start..], zoom)]
}

/// `ẍ_2, ÿ_1 (m/s²)`.
fn axis_label(curves: &[Curve], unit: &str, exponent: i32) -> Text {
    let mut label = Text::default();
    for (number, curve) in curves.iter().enumerate() {
        label = label.plain(if number == 0 { "" } else { ", " }).symbol(curve.symbol);
    }
    label.then(axis_unit(unit, exponent))
}

/// The upper edges of the panels below `y`.
fn tops(mut y: f64, panel: f64) -> [f64; PANELS.len()] {
    std::array::from_fn(|number| {
        if PANELS[number].0.len() > 1 {
            y += if number == 0 { KEY_GAP } else { KEY_GAP - GAP };
        }
        let top = y;
        y += panel + GAP;
        top
    })
}

/// The states that occur; returns where the panels begin.
fn legend(svg: &mut Svg, trace: &Trace, [left, y]: [f64; 2], width: f64) -> f64 {
    let occurs = |state: ContactState| trace.rows.iter().any(|row| row.state == state);
    let fills = SHADES.map(|(_, fill, _)| format!(r##"fill="{fill}" stroke="#000000" stroke-width="0.4""##));
    let entries: Vec<(Text, Sample<'_>)> = SHADES
        .iter()
        .zip(&fills)
        .filter(|((state, ..), _)| occurs(*state))
        .map(|((.., words), fill)| (Text::from(*words), Sample::Area(fill)))
        .collect();
    let height = key::rows(svg, [left, y], width, LABEL_SIZE, &entries);
    if entries.is_empty() { y } else { y + height + 2.0 }
}

/// Shades the background; of a column the state that fills most of it.
fn shade(svg: &mut Svg, rows: &[TraceRow], time: &Scale, frame: &Frame) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let columns = (frame.width / COLUMN).ceil() as usize;
    let mut filled = vec![[0.0; 3]; columns];
    for pair in rows.windows(2) {
        let Some(shade) = SHADES.iter().position(|(state, ..)| *state == pair[0].state) else { continue };
        let [from, to] = [pair[0].t, pair[1].t].map(|t| time.position(t) * columns as f64);
        if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
            continue;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the columns")]
        let [first, last] = [from.floor(), to.ceil()].map(|c| c.clamp(0.0, columns as f64) as usize);
        for (column, share) in filled.iter_mut().enumerate().take(last).skip(first) {
            let overlap = to.min(column as f64 + 1.0) - from.max(column as f64);
            share[shade] += overlap.max(0.0);
        }
    }
    let state = |share: &[f64; 3]| (0..3).find(|k| share[*k] > 0.5);
    svg.open(r#"shape-rendering="crispEdges""#);
    let mut column = 0;
    for run in filled.chunk_by(|a, b| state(a) == state(b)) {
        if let Some(k) = state(&run[0]) {
            let scale = frame.width / columns as f64;
            let x = frame.x + column as f64 * scale;
            let fill = format!(r#"class="{}" fill="{}""#, SHADES[k].0.name(), SHADES[k].1);
            svg.rect([x, frame.y, run.len() as f64 * scale, frame.height], &fill);
        }
        column += run.len();
    }
    svg.close();
}
