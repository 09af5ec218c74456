//! A number over the panels: cells or points by lightness, and the bar that says how much.

use super::boundaries::{Vertex, outlines};
use super::cells::{FAILED_FILL, corner, shape, steps};
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room};
use super::panels::{Panel, Panels};
use super::points::{POINT_RADIUS, positions};
use super::raster;
use super::scale::{Scale, axis_unit};
use super::svg::{Anchor, Style, Svg};
use super::text::Text;
use crate::archive::NumberColumn;
use crate::grid::Grid;

/// Steps of lightness: more than the eye tells apart, few enough for small files.
const STEPS: usize = 48;
/// Height of the bar, points.
const BAR: f64 = 7.0;
/// The bar is no longer than this, points.
const LONGEST: f64 = 220.0;

/// The scale of a quantity over all panels: from its lowest to its highest value.
pub(super) fn scale(quantity: &NumberColumn) -> Scale {
    Scale::spanning(quantity.values.iter().flatten().copied())
}

/// The fill of a step.
fn fill(step: usize) -> String {
    raster::fill(step as f32 / (STEPS - 1) as f32)
}

/// The step of every instance; `None` where the value is undefined.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the steps")]
fn step(value: Option<f64>, scale: &Scale) -> Option<usize> {
    value.map(|x| (scale.position(x) * STEPS as f64).clamp(0.0, (STEPS - 1) as f64) as usize)
}

/// Draws the content of a panel into its frame.
pub(super) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    quantity: &NumberColumn,
    frame: &Frame,
) {
    let scale = scale(quantity);
    let of = |instance: usize| step(quantity.values.get(instance).copied().flatten(), &scale);
    if panels.scatter.is_some() {
        for place in panel.cells.clone() {
            let instance = panels.instances[place];
            let Some([x, y]) = positions(grid, panels, instance, frame) else { continue };
            let fill = of(instance).map_or_else(|| FAILED_FILL.to_owned(), fill);
            svg.circle(
                x,
                y,
                POINT_RADIUS,
                &format!(r##"fill="{fill}" stroke="#000000" stroke-width="0.5""##),
            );
        }
        return;
    }
    let Some([columns, rows]) = shape(panels, panel) else { return };
    let at = |vertex: Vertex| corner(panels, frame, vertex);
    let region = |wanted: Option<usize>| {
        let inside = |i: usize, j: usize| of(panels.instances[panel.cells.start + j * columns + i]) == wanted;
        outlines(columns, rows, inside).iter().map(|path| steps(path, &at, true)).collect::<String>()
    };
    svg.open(r#"shape-rendering="crispEdges" fill-rule="evenodd""#);
    for number in 0..STEPS {
        svg.path(&region(Some(number)), &format!(r#"fill="{}""#, fill(number)));
    }
    svg.close();
    let missing = region(None);
    svg.path(&missing, &format!(r#"class="undefined" fill="{FAILED_FILL}""#));
    svg.path(&missing, r#"fill="url(#not-computed)" fill-rule="evenodd""#);
}

/// `growth rate (1/s)`.
pub(super) fn heading(quantity: &NumberColumn) -> Text {
    let words = quantity.name.replace('_', " ");
    let unit = quantity.unit.replace("deg", "°");
    if unit.is_empty() { Text::from(words) } else { Text::from(words).plain(" (").unit(&unit).plain(")") }
}

/// Draws the bar from `(x, y)` downwards and returns its height; `svg` is `None` to measure only.
pub(super) fn bar(quantity: &NumberColumn, svg: Option<&mut Svg>, x: f64, y: f64, width: f64) -> f64 {
    let height = BAR + x_tick_room() + LABEL_SIZE;
    let Some(svg) = svg else { return height };
    let scale = scale(quantity);
    let frame = Frame { x, y, width: width.min(LONGEST), height: BAR };
    let wide = frame.width / STEPS as f64;
    svg.open(r#"shape-rendering="crispEdges""#);
    for number in 0..STEPS {
        let left = x + number as f64 * wide;
        svg.rect([left, y, wide, BAR], &format!(r#"fill="{}""#, fill(number)));
    }
    svg.close();
    frame.border(svg);
    frame.x_ticks(svg, &scale.ticks(6), true);
    if scale.exponent() != 0 {
        let power = axis_unit("", scale.exponent());
        svg.text(x + frame.width + 3.0, y + BAR, &power, Style::new(TICK_SIZE, Anchor::Start));
    }
    let undefined = quantity.values.iter().filter(|value| value.is_none()).count();
    if undefined > 0 {
        let words = Text::from(format!("hatched: undefined ({undefined})"));
        let base = y + height;
        svg.text(x, base, &words, Style::new(TICK_SIZE, Anchor::Start));
    }
    height
}
