//! The figure of a cut: a row of panels for each quantity, a curve for each value of the further axis.

use crate::results::cut::{Curve, Cut, CutPanel, MOST_CURVES};
use crate::results::figure::beside::{most_panels, parted};
use crate::results::figure::field::has_sign;
use crate::results::figure::heading::Heading;
use crate::results::figure::look::Look;
use crate::results::figure::panels::{selection, setting};
use crate::results::figure::picture_axis::{Direction, PictureAxis};
use crate::results::figure::words;
use crate::results::number::NumberColumn;
use crate::results::trust::{self, Doubt};
use crate::sweep::label::Label;
use crate::sweep::map::Map;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::jumps::stepped;
use squealmap_figure::key::Sample;
use squealmap_figure::marks::{MARK, UNSETTLED, open_marks};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, SINGLE_COLUMN};
use squealmap_figure::plot::{FIRST, Plot, SECOND, THIRD, ZERO};
use squealmap_figure::scale::{Scale, Tick};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::{cyclic, key, letters};

/// The axis of positions.
const POSITION: Scale = Scale::Linear { low: 0.0, high: 1.0 };
/// Height of a panel, points.
const HEIGHT: f64 = 110.0;
/// Between panels that stand one below the other, points.
const GAP: f64 = 9.0;
/// Between panels of a row, points: room for half of two tick labels.
const GAP_ACROSS: f64 = 15.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.08;
/// Height of a line of a panel's title, points.
const LINE: f64 = 10.0;
/// Curves that differ in colour, in lightness and in their dashes; of more values an even selection is shown.
const STROKES: [&str; MOST_CURVES] = [
    FIRST,
    SECOND,
    THIRD,
    r##"fill="none" stroke="#000000" stroke-width="0.8" stroke-dasharray="6 1.4 1 1.4" stroke-linejoin="round""##,
    r##"fill="none" stroke="#B0669A" stroke-width="1.3" stroke-linejoin="round""##,
    r##"fill="none" stroke="#56B4E9" stroke-width="0.9" stroke-dasharray="7 2.4" stroke-linejoin="round""##,
];

/// The figure of a cut as an SVG document: single column width for one panel, double for several, unless the look says
/// otherwise.
#[must_use]
pub fn cut_svg(map: &Map, cut: &Cut, quantities: &[&NumberColumn], look: &Look<'_>) -> String {
    let title = look.title(&map.spec.title);
    let panels = quantities.len() as f64 * HEIGHT;
    let name = if title.is_empty() { "Cut" } else { title };
    look.fitted(name, panels, |part| draw(map, cut, quantities, look, part * HEIGHT))
}

/// The panels or curves of which a cut has more than its figure shows: how many are shown, of how many, and what they are
/// called. The table has all.
#[must_use]
pub fn left_out(cut: &Cut, look: &Look<'_>) -> Vec<(usize, usize, &'static str)> {
    let curves = cut.panels.first().map_or(0, |panel| panel.curves.len());
    let all = [(most_panels(page(cut, look)), cut.panels.len(), "panels"), (MOST_CURVES, curves, "curves")];
    all.into_iter().filter(|(some, all, _)| some < all).collect()
}

/// The width of the page, points.
fn page(cut: &Cut, look: &Look<'_>) -> f64 {
    look.points().unwrap_or(if cut.panels.len() > 1 { DOUBLE_COLUMN } else { SINGLE_COLUMN })
}

/// The picture and its size, with panels of this height.
fn draw(map: &Map, cut: &Cut, quantities: &[&NumberColumn], look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let page = page(cut, look);
    let inner = page - 2.0 * MARGIN;
    let heading = look.headed(&Heading { title: map.spec.title.clone(), settings: cut.held.clone() });
    let mut svg = Svg::new();
    let mut y = MARGIN + heading.draw(&mut svg, inner);
    let panels: Vec<&CutPanel> =
        selection(cut.panels.len(), most_panels(page)).map(|k| &cut.panels[k]).collect();
    let curves: Vec<usize> = selection(cut.panels[0].curves.len(), STROKES.len()).collect();
    let x = along(cut);
    let scales: Vec<Scale> = quantities.iter().map(|column| scale(column, &panels, &curves, &x)).collect();
    let ticks = |(scale, column): (&Scale, &&NumberColumn)| {
        let quarters = if column.is_angle() { cyclic::ticks(scale) } else { None };
        quarters.unwrap_or_else(|| y_ticks(scale, height))
    };
    let ticks: Vec<Vec<Tick>> = scales.iter().zip(quantities).map(ticks).collect();
    let left = MARGIN + LABEL_SIZE + 6.0 + ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let across = page - left - RIGHT;
    let columns = panels.len() as f64;
    let width = (across - (columns - 1.0) * GAP_ACROSS) / columns;
    let doubts: Vec<Doubt<'_>> = quantities.iter().map(|column| Doubt::of(column)).collect();
    let unsettled = |row: usize, instance: usize| {
        let value = value(quantities[row], instance);
        value.is_some()
            && map.records.get(instance).is_some_and(|record| doubts[row].is_unsettled_in(record, value))
    };
    let doubtful = panels.iter().any(|panel| {
        let shown = curves.iter().flat_map(|curve| &panel.curves[*curve].instances);
        let of = |instance: &usize| (0..quantities.len()).any(|row| unsettled(row, *instance));
        shown.clone().any(of)
    });
    y += legend(&mut svg, panels[0], &curves, doubtful, [left, y], across);
    let lines = panels.iter().map(|panel| panel.of.len()).max().unwrap_or(0) as f64;
    y += lines * LINE + 2.0;
    let axis = PictureAxis::cells(&cut.axis).edge_to_edge(&x);
    let x_ticks = axis.ticks(width, Direction::Horizontal, TICK_SIZE);
    // The last label of a panel must not run into the first of the next.
    let inner_ticks = parted(&axis, width, GAP_ACROSS);
    for (number, panel) in panels.iter().enumerate() {
        let from = left + number as f64 * (width + GAP_ACROSS);
        for (line, (key, value)) in panel.of.iter().rev().enumerate() {
            let base = y - 3.5 - line as f64 * LINE;
            let middle = Style::new(LABEL_SIZE, Anchor::Middle);
            svg.text(from + 0.5 * width, base, &setting(*key, value), middle);
        }
        for (row, column) in quantities.iter().enumerate() {
            let frame = Frame { x: from, y: y + row as f64 * (height + GAP), width, height };
            let plot = Plot { frame, x: &POSITION, y: &scales[row] };
            if has_sign(column) && (0.0..=1.0).contains(&scales[row].position(0.0)) {
                plot.curve(&mut svg, [(0.0, 0.0), (1.0, 0.0)], ZERO);
            }
            for (curve, stroke) in curves.iter().zip(STROKES) {
                let curve = &panel.curves[*curve];
                let points = points(column, curve, &x);
                let doubtful = points.iter().zip(&curve.instances);
                let doubtful = doubtful.filter(|(_, instance)| unsettled(row, **instance));
                let doubtful = doubtful.map(|(point, _)| *point);
                plot.curve(&mut svg, drawn(map, column, curve, &points, &scales[row]), stroke);
                open_marks(&mut svg, &plot, doubtful, stroke);
            }
            frame.border(&mut svg);
            let ticks_below = if number + 1 < panels.len() { &inner_ticks } else { &x_ticks };
            frame.x_ticks(&mut svg, ticks_below, row + 1 == quantities.len());
            frame.y_ticks(&mut svg, &ticks[row], number == 0);
        }
    }
    for (row, column) in quantities.iter().enumerate() {
        let frame = Frame { x: left, y: y + row as f64 * (height + GAP), width: 0.0, height };
        let label = |room: f64| words::label(column, scales[row].exponent(), room, LABEL_SIZE);
        letters::side(&mut svg, (row, quantities.len()), &frame, &[label(f64::INFINITY), label(0.0)]);
    }
    y += quantities.len() as f64 * (height + GAP) - GAP + x_tick_room() + LABEL_SIZE + 1.0;
    let middle = Style::new(LABEL_SIZE, Anchor::Middle);
    svg.text(left + 0.5 * across, y, &axis.label(across, LABEL_SIZE), middle);
    for (some, all, what) in left_out(cut, look) {
        y += LABEL_SIZE + 4.0;
        let note = Text::from(format!("{some} of {all} {what} shown; the table holds all."));
        svg.text(MARGIN, y, &note, Style::new(TICK_SIZE, Anchor::Start));
    }
    (svg, [page, y + MARGIN + 2.0])
}

fn value(column: &NumberColumn, instance: usize) -> Option<f64> {
    column.values.get(instance).copied().flatten()
}

/// The points of a curve: positions along the axis, 0 to 1, and values.
fn points(column: &NumberColumn, curve: &Curve, x: &Scale) -> Vec<(f64, f64)> {
    let of = |(x_value, instance): (&f64, &usize)| {
        (x.position(*x_value), value(column, *instance).unwrap_or(f64::NAN))
    };
    curve.x.iter().zip(&curve.instances).map(of).collect()
}

/// The points of a curve as they are drawn: angles go on at the other side of ±180°, and a jump from one class to another is
/// a step.
fn drawn(
    map: &Map,
    column: &NumberColumn,
    curve: &Curve,
    points: &[(f64, f64)],
    scale: &Scale,
) -> Vec<(f64, f64)> {
    if column.is_angle() {
        return cyclic::parted(points);
    }
    let class = |place: usize| curve.instances.get(place).and_then(|instance| class(map, column, *instance));
    stepped(points, scale.value(1.0) - scale.value(0.0), |place| class(place) == class(place + 1))
}

/// The class of an instance, from the start that a column belongs to.
fn class(map: &Map, column: &NumberColumn, instance: usize) -> Option<Label> {
    let record = map.records.get(instance)?;
    let record = if trust::is_of_large_start(column) { record.large()? } else { record };
    Some(Label::from(record).class())
}

/// The scale of a quantity over all that is shown.
fn scale(column: &NumberColumn, panels: &[&CutPanel], curves: &[usize], x: &Scale) -> Scale {
    let shown = panels.iter().flat_map(|panel| curves.iter().map(|curve| &panel.curves[*curve]));
    let values = shown.flat_map(|curve| {
        let points = points(column, curve, x);
        // Angles reach ±180° where they go on at the other side.
        if column.is_angle() { cyclic::parted(&points) } else { points }
    });
    Scale::spanning(values.map(|(_, value)| value)).widened(HEADROOM)
}

/// The axis of the curves, from its first value to its last.
fn along(cut: &Cut) -> Scale {
    let x = &cut.panels[0].curves[0].x;
    match Scale::spanning(x.iter().copied()) {
        Scale::Linear { low, high } if cut.axis.log && low > 0.0 => Scale::Log { low, high },
        linear => linear,
    }
}

/// Draws the legend, which says which curve is which. Returns its height.
fn legend(
    svg: &mut Svg,
    panel: &CutPanel,
    curves: &[usize],
    doubtful: bool,
    from: [f64; 2],
    width: f64,
) -> f64 {
    let words = curves.iter().filter_map(|curve| panel.curves[*curve].of.as_ref());
    let mut entries: Vec<(Text, Sample<'_>)> =
        words.map(|(key, value)| setting(*key, value)).zip(STROKES.map(Sample::Line)).collect();
    if doubtful {
        entries.push((Text::from("not settled"), Sample::Mark(MARK, UNSETTLED)));
    }
    key::rows(svg, from, width, LABEL_SIZE, &entries) + 3.0
}
