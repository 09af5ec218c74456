//! A quantity of a sweep with one axis of numbers: a curve along it, as a block of a map's figure.

use super::cyclic;
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_count, y_tick_room};
use super::letters;
use super::look::Content;
use super::marks::{MARK, UNSETTLED, open_marks};
use super::panels::Panels;
use super::picture_axis::Direction;
use super::plot::{FIRST, Plot};
use super::quantity::Field;
use super::scale::{Scale, Tick};
use super::svg::{Anchor, Style, Svg};
use super::{key, key::Sample};

/// Height of the panel, points.
pub(super) const HEIGHT: f64 = 110.0;
/// Right of the panel, as of strips, points.
const RIGHT: f64 = 6.0;
/// Margin above and below the curve, as a fraction of the panel.
const HEADROOM: f64 = 0.08;
/// A line at a level that was asked for.
const LEVEL: &str = r##"class="isoline" fill="none" stroke="#777777" stroke-width="0.5""##;

/// Whether a content of these panels is a curve: numbers along one axis of them.
pub(super) fn is_curve(content: Content<'_>, panels: &Panels) -> bool {
    let numbers = matches!(content, Content::Quantity { .. } | Content::Basin);
    let along = !panels.x.is_named() && panels.x.len() > 1;
    numbers && along && panels.y.is_none() && panels.scatter.is_none() && panels.all.len() == 1
}

/// The points of a curve, positions along its axis and values, and the scale of the values.
fn curve(field: &Field<'_>, panels: &Panels) -> (Vec<(f64, f64)>, Scale) {
    let value = |place: usize| field.value(place).unwrap_or(f64::NAN);
    let places = panels.all[0].cells.clone().enumerate();
    let points: Vec<(f64, f64)> =
        places.map(|(cell, place)| (panels.x.between(cell as f64), value(place))).collect();
    let drawn = if field.is_angle() { cyclic::parted(&points) } else { points };
    let scale = Scale::spanning(drawn.iter().map(|(_, value)| *value)).widened(HEADROOM);
    (drawn, scale)
}

/// The ticks of the values.
fn ticks(field: &Field<'_>, scale: &Scale, height: f64) -> Vec<Tick> {
    let quarters = if field.is_angle() { cyclic::ticks(scale) } else { None };
    quarters.unwrap_or_else(|| scale.ticks(y_tick_count(height)))
}

/// What stands left of a panel of this height, points.
pub(super) fn left(content: Content<'_>, panels: &Panels, height: f64) -> f64 {
    Field::of(content, panels).map_or(0.0, |field| {
        let (_, scale) = curve(&field, panels);
        LABEL_SIZE + 6.0 + y_tick_room(&ticks(&field, &scale, height))
    })
}

/// Draws it with the upper left corner at `[x, y]`, in a width, with a panel of this height and `left` points before it;
/// returns the height of the block.
pub(super) fn draw(
    svg: &mut Svg,
    panels: &Panels,
    (content, letter): (Content<'_>, Option<usize>),
    [x, y]: [f64; 2],
    [width, height, left]: [f64; 3],
) -> f64 {
    let Some(field) = Field::of(content, panels) else { return 0.0 };
    let places = panels.all[0].cells.clone();
    let (along, scale) = curve(&field, panels);
    let doubtful: Vec<(f64, f64)> = places
        .enumerate()
        .filter(|(_, place)| field.is_doubtful(*place))
        .map(|(cell, place)| (panels.x.between(cell as f64), field.value(place).unwrap_or(f64::NAN)))
        .collect();
    let ticks = ticks(&field, &scale, height);
    let mut top = y;
    if !doubtful.is_empty() {
        let entry = ("not settled".into(), Sample::Mark(MARK, UNSETTLED));
        top += key::rows(svg, [x + left, y], width - left, LABEL_SIZE, &[entry]) + 4.0;
    }
    let frame = Frame { x: x + left, y: top, width: width - left - RIGHT, height };
    let position = Scale::Linear { low: 0.0, high: 1.0 };
    let plot = Plot { frame, x: &position, y: &scale };
    if let Content::Quantity { levels, .. } = content {
        for level in levels.iter().filter(|level| (0.0..=1.0).contains(&scale.position(**level))) {
            plot.curve(svg, [(0.0, *level), (1.0, *level)], LEVEL);
        }
    }
    plot.curve(svg, along, FIRST);
    open_marks(svg, &plot, doubtful, FIRST);
    frame.border(svg);
    let x_ticks = panels.x.ticks(frame.width, Direction::Horizontal, TICK_SIZE);
    frame.x_ticks(svg, &x_ticks, true);
    frame.y_ticks(svg, &ticks, true);
    if let Some(number) = letter {
        letters::draw_at(svg, number, [x, top]);
    }
    let room = letters::room(height, if letter.is_some() { 2 } else { 1 });
    let label = field.axis_label(scale.exponent(), room);
    svg.text(
        x + LABEL_SIZE,
        frame.bottom() - 0.5 * room,
        &label,
        Style::new(LABEL_SIZE, Anchor::Middle).upwards(),
    );
    let base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
    let label = panels.x.label(frame.width, LABEL_SIZE);
    svg.text(frame.across(0.5), base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    base + 3.0 - y
}
