//! A number over the panels: cells or points by lightness, and the bar that says how much.

use super::boundaries::{Vertex, outlines};
use super::cells::{FAILED_FILL, corner, shape, steps};
use super::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room};
use super::look::Content;
use super::panels::{Panel, Panels};
use super::points::{POINT_RADIUS, positions};
use super::raster;
use super::scale::{Scale, axis_unit};
use super::svg::{Anchor, Style, Svg};
use super::text::Text;
use super::words;
use crate::archive::NumberColumn;
use crate::grid::Grid;

/// Steps of lightness: more than the eye tells apart, few enough for small files.
const STEPS: usize = 48;
/// Height of the bar, points.
const BAR: f64 = 7.0;
/// The bar is no longer than this, points.
const LONGEST: f64 = 220.0;
/// What the bar of a fraction of starts says.
const STARTS: &str = "fraction of starts";

/// What a block shows: values of the places of its panels, and words.
pub(super) struct Field<'a> {
    heading: Text,
    /// Beside the bar; empty where the heading says it all.
    label: &'static str,
    scale: Scale,
    /// How many values are undefined.
    undefined: usize,
    /// The value of a place in [`Panels::instances`].
    value: Box<dyn Fn(usize) -> Option<f64> + 'a>,
}

impl<'a> Field<'a> {
    /// The field of a content that has values; `None` for classes.
    pub(super) fn of(content: Content<'a>, panels: &'a Panels) -> Option<Field<'a>> {
        match content {
            Content::Classes { .. } | Content::LargeRegime => None,
            Content::Quantity { column, .. } => {
                let value = |place: usize| column.values.get(panels.instances[place]).copied().flatten();
                Some(Field {
                    heading: words::label(column, 0, f64::INFINITY, LABEL_SIZE),
                    label: if column.name.starts_with("basin_") { STARTS } else { "" },
                    scale: scale(column),
                    undefined: column.values.iter().filter(|value| value.is_none()).count(),
                    value: Box::new(value),
                })
            }
            Content::Basin => {
                let value =
                    |place: usize| panels.basins.get(place).copied().filter(|fraction| fraction.is_finite());
                Some(Field {
                    heading: Text::from("Starts in a box that end in a settled oscillation"),
                    label: STARTS,
                    scale: Scale::Linear { low: 0.0, high: 1.0 },
                    undefined: (0..panels.instances.len()).filter(|place| value(*place).is_none()).count(),
                    value: Box::new(value),
                })
            }
        }
    }

    /// What stands above the block.
    pub(super) fn heading(&self) -> Text {
        self.heading.clone()
    }
}

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
    field: &Field<'_>,
    frame: &Frame,
) {
    let of = |place: usize| step((field.value)(place), &field.scale);
    if panels.scatter.is_some() {
        for place in panel.cells.clone() {
            let instance = panels.instances[place];
            let Some([x, y]) = positions(grid, panels, instance, frame) else { continue };
            let fill = of(place).map_or_else(|| FAILED_FILL.to_owned(), fill);
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
        let inside = |i: usize, j: usize| of(panel.cells.start + j * columns + i) == wanted;
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

/// Draws the bar from `(x, y)` downwards and returns its height; `svg` is `None` to measure only.
pub(super) fn bar(field: &Field<'_>, svg: Option<&mut Svg>, x: f64, y: f64, width: f64) -> f64 {
    let height = BAR + x_tick_room() + LABEL_SIZE;
    let Some(svg) = svg else { return height };
    let power =
        if field.scale.exponent() == 0 { Text::default() } else { axis_unit("", field.scale.exponent()) };
    let beside = power.plain(field.label);
    let room = beside.width(TICK_SIZE, false) + 6.0;
    let frame = Frame { x, y, width: (width - room).min(LONGEST), height: BAR };
    let wide = frame.width / STEPS as f64;
    svg.open(r#"shape-rendering="crispEdges""#);
    for number in 0..STEPS {
        let left = x + number as f64 * wide;
        svg.rect([left, y, wide, BAR], &format!(r#"fill="{}""#, fill(number)));
    }
    svg.close();
    frame.border(svg);
    frame.x_ticks(svg, &field.scale.ticks(6), true);
    svg.text(x + frame.width + 3.0, y + BAR - 1.0, &beside, Style::new(TICK_SIZE, Anchor::Start));
    if field.undefined > 0 {
        let words = Text::from(format!("hatched: undefined ({})", field.undefined));
        let base = y + height;
        svg.text(x, base, &words, Style::new(TICK_SIZE, Anchor::Start));
    }
    height
}
