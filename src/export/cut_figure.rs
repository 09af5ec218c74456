//! The figure of a cut: a row of panels for each quantity, a curve for each value of the further axis.

use super::cut::{Cut, CutPanel};
use super::figure::{DOUBLE_COLUMN, MARGIN, SINGLE_COLUMN};
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_count, y_tick_room};
use super::heading::Heading;
use super::key::{self, Sample};
use super::letters;
use super::look::Look;
use super::marks::{MARK, UNSETTLED, open_marks};
use super::panels::{selection, setting};
use super::picture_axis::{Direction, PictureAxis};
use super::plot::{FIRST, Plot, SECOND, THIRD};
use super::scale::{Scale, Tick};
use super::svg::{Anchor, Style, Svg};
use super::text::Text;
use super::trust;
use super::words;
use crate::archive::NumberColumn;
use crate::map::Map;

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
/// Side by side no more panels than this; the table holds all.
const MOST_PANELS: usize = 4;
/// Panels are no narrower than this, points.
const NARROWEST: f64 = 90.0;
/// Curves that differ in colour, in lightness and in their dashes; of more values an even selection is shown.
const STROKES: [&str; 6] = [
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

/// The picture and its size, with panels of this height.
fn draw(map: &Map, cut: &Cut, quantities: &[&NumberColumn], look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let usual = if cut.panels.len() > 1 { DOUBLE_COLUMN } else { SINGLE_COLUMN };
    let page = look.points().unwrap_or(usual);
    let inner = page - 2.0 * MARGIN;
    let heading = look.headed(&Heading { title: map.spec.title.clone(), settings: cut.held.clone() });
    let mut svg = Svg::new();
    let mut y = MARGIN + heading.draw(&mut svg, inner);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let fit = (inner / NARROWEST).max(1.0) as usize;
    let panels: Vec<&CutPanel> =
        selection(cut.panels.len(), MOST_PANELS.min(fit)).map(|k| &cut.panels[k]).collect();
    let curves: Vec<usize> = selection(cut.panels[0].curves.len(), STROKES.len()).collect();
    let scales: Vec<Scale> = quantities.iter().map(|column| scale(column, &panels, &curves)).collect();
    let ticks: Vec<Vec<Tick>> = scales.iter().map(|scale| scale.ticks(y_tick_count(height))).collect();
    let left = MARGIN + LABEL_SIZE + 6.0 + ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let across = page - left - RIGHT;
    let columns = panels.len() as f64;
    let width = (across - (columns - 1.0) * GAP_ACROSS) / columns;
    let unsettled = |column: &NumberColumn, instance: usize| {
        map.records.get(instance).is_some_and(|record| trust::is_unsettled(column, record))
    };
    let doubtful = panels.iter().any(|panel| {
        let shown = curves.iter().flat_map(|curve| &panel.curves[*curve].instances);
        let of = |instance: &usize| {
            quantities.iter().any(|column| unsettled(column, *instance) && value(column, *instance).is_some())
        };
        shown.clone().any(of)
    });
    y += legend(&mut svg, panels[0], &curves, doubtful, [left, y], across);
    let lines = panels.iter().map(|panel| panel.of.len()).max().unwrap_or(0) as f64;
    y += lines * LINE + 2.0;
    let x = along(cut);
    let axis = PictureAxis::cells(&cut.axis).edge_to_edge(&x);
    let x_ticks = axis.ticks(width, Direction::Horizontal, TICK_SIZE);
    for (number, panel) in panels.iter().enumerate() {
        let from = left + number as f64 * (width + GAP_ACROSS);
        for (line, (key, value)) in panel.of.iter().rev().enumerate() {
            let base = y - 3.5 - line as f64 * LINE;
            let middle = Style::new(LABEL_SIZE, Anchor::Middle);
            svg.text(from + 0.5 * width, base, &setting(*key, value), middle);
        }
        for (row, column) in quantities.iter().enumerate() {
            let frame = Frame { x: from, y: y + row as f64 * (height + GAP), width, height };
            let plot = Plot { frame, x: &x, y: &scales[row] };
            for (curve, stroke) in curves.iter().zip(STROKES) {
                let curve = &panel.curves[*curve];
                let of = |instance: &usize| value(column, *instance).unwrap_or(f64::NAN);
                let points = curve.x.iter().copied().zip(curve.instances.iter().map(of));
                plot.curve(&mut svg, points.clone(), stroke);
                let doubtful = points.zip(&curve.instances);
                let doubtful = doubtful.filter(|(_, instance)| unsettled(column, **instance));
                open_marks(&mut svg, &plot, doubtful.map(|(point, _)| point), stroke);
            }
            frame.border(&mut svg);
            frame.x_ticks(&mut svg, &x_ticks, row + 1 == quantities.len());
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
    let shown =
        [(panels.len(), cut.panels.len(), "panels"), (curves.len(), cut.panels[0].curves.len(), "curves")];
    for (some, all, what) in shown.into_iter().filter(|(some, all, _)| some < all) {
        y += LABEL_SIZE + 4.0;
        let note = Text::from(format!("{some} of {all} {what} shown; the table holds all."));
        svg.text(MARGIN, y, &note, Style::new(TICK_SIZE, Anchor::Start));
    }
    (svg, [page, y + MARGIN + 2.0])
}

fn value(column: &NumberColumn, instance: usize) -> Option<f64> {
    column.values.get(instance).copied().flatten()
}

/// The scale of a quantity over all that is shown.
fn scale(column: &NumberColumn, panels: &[&CutPanel], curves: &[usize]) -> Scale {
    let shown = panels.iter().flat_map(|panel| curves.iter().map(|curve| &panel.curves[*curve]));
    let values =
        shown.flat_map(|curve| curve.instances.iter().filter_map(|instance| value(column, *instance)));
    Scale::spanning(values).widened(HEADROOM)
}

/// The axis of the curves, from its first value to its last.
fn along(cut: &Cut) -> Scale {
    let x = &cut.panels[0].curves[0].x;
    match Scale::spanning(x.iter().copied()) {
        Scale::Linear { low, high } if cut.axis.log && low > 0.0 => Scale::Log { low, high },
        linear => linear,
    }
}

/// Which curve is which; returns the height it takes.
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
