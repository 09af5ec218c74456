//! A quantity of a sweep with one axis of numbers: a curve along it, as a block of a map's figure.

use crate::results::figure::field::Field;
use crate::results::figure::isolines::PLATE;
use crate::results::figure::look::Content;
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::Direction;
use crate::results::figure::starts_block;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::jumps::stepped;
use squealmap_figure::key::Sample;
use squealmap_figure::marks::{MARK, UNSETTLED, open_marks};
use squealmap_figure::plot::{FIRST, Plot, ZERO};
use squealmap_figure::scale::{Scale, Tick, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::{cyclic, key, letters};

/// Height of the panel, points.
pub(crate) const HEIGHT: f64 = 110.0;
/// Right of the panel, as of strips, points.
const RIGHT: f64 = 6.0;
/// Height of a line of a heading, points.
const LINE: f64 = 10.0;
/// Margin above and below the curve, as a fraction of the panel.
const HEADROOM: f64 = 0.08;
/// A line at a level that was asked for.
const LEVEL: &str = r##"class="isoline" fill="none" stroke="#777777" stroke-width="0.5""##;

/// Whether a content of these panels is a curve: numbers along one axis of them.
pub(crate) fn is_curve(content: Content<'_>, panels: &Panels) -> bool {
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
    let points = if field.is_angle() { cyclic::parted(&points) } else { points };
    let around = || Scale::spanning(points.iter().map(|(_, value)| *value)).widened(HEADROOM);
    let scale = field.own_scale().unwrap_or_else(around);
    if field.is_angle() {
        return (points, scale);
    }
    let reach = scale.value(1.0) - scale.value(0.0);
    (stepped(&points, reach, same_class(panels)), scale)
}

/// Whether an instance and the next one are of one class.
fn same_class(panels: &Panels) -> impl Fn(usize) -> bool {
    let first = panels.all[0].cells.start;
    let class = move |cell: usize| panels.labels.get(first + cell).map(|label| label.class());
    move |cell| class(cell) == class(cell + 1)
}

/// The ticks of the values.
fn ticks(field: &Field<'_>, scale: &Scale, height: f64) -> Vec<Tick> {
    let quarters = if field.is_angle() { cyclic::ticks(scale) } else { None };
    quarters.unwrap_or_else(|| y_ticks(scale, height))
}

/// The room for words left of a panel of this height, points.
pub(crate) fn left(content: Content<'_>, panels: &Panels, height: f64) -> f64 {
    Field::of(content, panels).map_or(0.0, |field| {
        let (_, scale) = curve(&field, panels);
        LABEL_SIZE + 6.0 + y_tick_room(&ticks(&field, &scale, height))
    })
}

/// Draws the block with its upper left corner at `[x, y]`, in a given width, with a panel of a given height that stands
/// `left` points from the left. Returns the height of the block.
pub(crate) fn draw(
    svg: &mut Svg,
    panels: &Panels,
    (content, letter): (Content<'_>, Option<usize>),
    [x, y]: [f64; 2],
    [width, height, left]: [f64; 3],
) -> f64 {
    let Some(field) = Field::of(content, panels) else { return 0.0 };
    let places = panels.all[0].cells.clone();
    let (along, scale) = curve(&field, panels);
    let of_starts = starts_block::entries(field.basins());
    let doubtful: Vec<(f64, f64)> = places
        .enumerate()
        .filter(|(_, place)| of_starts.is_empty() && field.is_doubtful(*place))
        .map(|(cell, place)| (panels.x.between(cell as f64), field.value(place).unwrap_or(f64::NAN)))
        .collect();
    let ticks = ticks(&field, &scale, height);
    let mut top = y;
    // Several curves have words above them, as strips have.
    let is_headed = !of_starts.is_empty();
    if is_headed {
        let mut words = x;
        if let Some(number) = letter {
            letters::draw_at(svg, number, [x, top]);
            words = x + letters::width(number);
        }
        for line in starts_block::heading(field.basins()).wrapped(x + width - words, LABEL_SIZE) {
            let base = top + letters::ASCENT * LABEL_SIZE;
            svg.text(words, base, &line, Style::new(LABEL_SIZE, Anchor::Start));
            top += LINE;
        }
        top += 2.0;
    }
    let mut entries = of_starts;
    if !doubtful.is_empty() {
        entries.push(("not settled".into(), Sample::Mark(MARK, UNSETTLED)));
    }
    if !entries.is_empty() {
        // From the outer edge where that saves a line.
        let measured =
            |indent: f64| key::rows(&mut Svg::new(), [0.0; 2], width - indent, LABEL_SIZE, &entries);
        let indent = if measured(0.0) < measured(left) { 0.0 } else { left };
        top += key::rows(svg, [x + indent, top], width - indent, LABEL_SIZE, &entries) + 4.0;
    }
    let frame = Frame { x: x + left, y: top, width: width - left - RIGHT, height };
    let position = Scale::Linear { low: 0.0, high: 1.0 };
    let plot = Plot { frame, x: &position, y: &scale };
    let levels = if let Content::Quantity { levels, .. } = content { levels } else { &[] };
    let levels: Vec<f64> =
        levels.iter().copied().filter(|level| (0.0..=1.0).contains(&scale.position(*level))).collect();
    for level in &levels {
        plot.curve(svg, [(0.0, *level), (1.0, *level)], LEVEL);
    }
    values(svg, &frame, &scale, &levels);
    if field.has_sign() && (0.0..=1.0).contains(&scale.position(0.0)) {
        plot.curve(svg, [(0.0, 0.0), (1.0, 0.0)], ZERO);
    }
    if field.basins().is_empty() {
        plot.curve(svg, along, FIRST);
    } else {
        starts_block::curves(svg, &plot, panels, field.basins(), same_class(panels));
    }
    open_marks(svg, &plot, doubtful, FIRST);
    frame.border(svg);
    let x_ticks = panels.x.ticks(frame.width, Direction::Horizontal, TICK_SIZE);
    frame.x_ticks(svg, &x_ticks, true);
    frame.y_ticks(svg, &ticks, true);
    let letter = letter.filter(|_| !is_headed);
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

/// The value of each line at its right end, with the power of ten of the axis; below the curve, and none upon another.
fn values(svg: &mut Svg, frame: &Frame, scale: &Scale, levels: &[f64]) {
    let unit = 10_f64.powi(scale.exponent());
    let right = frame.x + frame.width - 2.0;
    let mut last = f64::INFINITY;
    let mut rising = levels.to_vec();
    rising.sort_by(f64::total_cmp);
    for level in rising {
        let up = frame.up(scale.position(level));
        if last - up < TICK_SIZE {
            continue;
        }
        last = up;
        let label = value_label(level / unit);
        let wide = label.width(TICK_SIZE, false);
        svg.rect([right - wide - 1.0, up - 0.5 * TICK_SIZE, wide + 2.0, TICK_SIZE], PLATE);
        svg.text(right, up + 0.36 * TICK_SIZE, &label, Style::new(TICK_SIZE, Anchor::End));
    }
}
