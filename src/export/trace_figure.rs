//! The figure of a trajectory: stacked panels on one time axis, shaded by contact state.

use super::figure::{DOUBLE_COLUMN, MARGIN, program, title};
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use super::plot::{FIRST, Plot, SECOND_SOLID};
use super::scale::Scale;
use super::svg::{Anchor, Style, Svg};
use super::text::Text;
use crate::error::Result;
use crate::model::contact::ContactState;
use crate::trace::{Trace, TraceRow};

/// Height of a panel, points.
const HEIGHT: f64 = 88.0;
/// Between panels, points.
const GAP: f64 = 8.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Shading is resolved to columns of this width, points.
const COLUMN: f64 = 0.3;
/// A swatch of the legend, points.
const SWATCH: f64 = 10.0;

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

/// What the panels show, from top to bottom: curves and unit.
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

/// The figure of a trajectory as an SVG document, double column width.
///
/// # Errors
/// None so far; figures share one signature.
pub fn trace_svg(trace: &Trace, heading: &str) -> Result<String> {
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, heading, DOUBLE_COLUMN - 2.0 * MARGIN);
    let time = Scale::spanning(trace.rows.iter().map(|row| row.t));
    let scales = PANELS.map(|(curves, _)| {
        let values = curves.iter().flat_map(|curve| trace.rows.iter().map(curve.value));
        Scale::spanning(values).widened(HEADROOM)
    });
    let ticks = scales.each_ref().map(|scale| scale.ticks(5));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let width = DOUBLE_COLUMN - left - RIGHT;
    y = legend(&mut svg, trace, left, y);
    let x_ticks = time.ticks(10);
    for (number, (curves, unit)) in PANELS.iter().enumerate() {
        let frame = Frame { x: left, y, width, height: HEIGHT };
        let plot = Plot { frame, x: &time, y: &scales[number] };
        shade(&mut svg, trace, &time, &frame);
        for (curve, stroke) in curves.iter().zip([FIRST, SECOND_SOLID]) {
            plot.curve(&mut svg, trace.rows.iter().map(|row| (row.t, (curve.value)(row))), stroke);
        }
        frame.border(&mut svg);
        frame.y_ticks(&mut svg, &ticks[number], true);
        frame.x_ticks(&mut svg, &x_ticks, number + 1 == PANELS.len());
        let label = axis_label(curves, unit, scales[number].exponent());
        let middle = y + 0.5 * HEIGHT;
        let style = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
        svg.text(MARGIN + LABEL_SIZE, middle, &label, style);
        if curves.len() > 1 {
            key(&mut svg, curves, &frame);
        }
        y += HEIGHT + GAP;
    }
    y += x_tick_room() - GAP + LABEL_SIZE + 1.0;
    let label = Text::from("Time ").symbol("t").plain(" (s)");
    svg.text(left + 0.5 * width, y, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    let name = if heading.is_empty() { "Trajectory" } else { heading };
    Ok(svg.finish(DOUBLE_COLUMN, y + MARGIN + 2.0, name, &program()))
}

/// `ẍ_2, ÿ_1 (m/s²)`.
fn axis_label(curves: &[Curve], unit: &str, exponent: i32) -> Text {
    let mut label = Text::default();
    for (number, curve) in curves.iter().enumerate() {
        label = label.plain(if number == 0 { "" } else { ", " }).symbol(curve.symbol);
    }
    label = label.plain(" (");
    if exponent != 0 {
        label = label.plain("10").superscript(&exponent.to_string().replace('-', "−")).plain(" ");
    }
    label.unit(unit).plain(")")
}

/// Which line is which, in the upper right corner of a panel on a white ground.
fn key(svg: &mut Svg, curves: &[Curve], frame: &Frame) {
    /// Length of a sample line, points.
    const SAMPLE: f64 = 12.0;
    let mut right = frame.x + frame.width - 4.0;
    let width: f64 = curves
        .iter()
        .map(|curve| SAMPLE + 12.0 + Text::default().symbol(curve.symbol).width(TICK_SIZE, false))
        .sum();
    svg.rect(
        [right - width + 5.0, frame.y + 2.5, width - 3.0, TICK_SIZE + 4.5],
        r##"fill="#FFFFFF" fill-opacity="0.85""##,
    );
    for (curve, stroke) in curves.iter().zip([FIRST, SECOND_SOLID]).rev() {
        let text = Text::default().symbol(curve.symbol);
        let base = frame.y + 3.0 + TICK_SIZE;
        svg.text(right, base, &text, Style::new(TICK_SIZE, Anchor::End));
        right -= text.width(TICK_SIZE, false) + 3.0;
        let y = base - 0.35 * TICK_SIZE;
        svg.path(&super::svg::polyline([(right - SAMPLE, y), (right, y)]), stroke);
        right -= SAMPLE + 8.0;
    }
}

/// The states that occur; returns where the panels begin.
fn legend(svg: &mut Svg, trace: &Trace, left: f64, y: f64) -> f64 {
    let mut x = left;
    for (state, fill, words) in SHADES {
        if !trace.rows.iter().any(|row| row.state == state) {
            continue;
        }
        let border = format!(r##"fill="{fill}" stroke="#000000" stroke-width="0.4""##);
        svg.rect([x, y, SWATCH, LABEL_SIZE - 1.0], &border);
        let text = Text::from(words);
        svg.text(x + SWATCH + 3.5, y + LABEL_SIZE - 2.0, &text, Style::new(LABEL_SIZE, Anchor::Start));
        x += SWATCH + 3.5 + text.width(LABEL_SIZE, false) + 14.0;
    }
    if x > left { y + LABEL_SIZE + 5.0 } else { y }
}

/// Shades the background; of a column the state that fills most of it.
fn shade(svg: &mut Svg, trace: &Trace, time: &Scale, frame: &Frame) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let columns = (frame.width / COLUMN).ceil() as usize;
    let mut filled = vec![[0.0; 3]; columns];
    for pair in trace.rows.windows(2) {
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
