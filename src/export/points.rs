//! The content of a panel of scattered points.

use super::cells::{FAILED_FILL, not_computed, unsettled, unsettled_fill};
use super::frame::Frame;
use super::palette::{Class, Colouring};
use super::panels::{Panel, Panels};
use super::svg::Svg;
use crate::grid::Grid;

/// Radius of a point.
pub(super) const POINT_RADIUS: f64 = 3.2;

/// Draws the points of a panel into its frame.
pub(super) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    colouring: Colouring,
    frame: &Frame,
) {
    // Nothing that was computed is covered by a point that was not.
    let mut places: Vec<usize> = panel.cells.clone().collect();
    places.sort_by_key(|place| !not_computed(panels.labels[*place], colouring));
    for place in places {
        let Some([x, y]) = positions(grid, panels, panels.instances[place], frame) else { continue };
        let label = panels.labels[place];
        if not_computed(label, colouring) {
            missing_point(svg, x, y);
            continue;
        }
        point(svg, x, y, colouring.class(label).map(|k| &colouring.classes()[k]));
        if unsettled(label, colouring) {
            let dark = colouring.class(label).is_some_and(|k| colouring.classes()[k].dark);
            svg.circle(x, y, POINT_RADIUS, &format!(r#"class="unsettled" {}"#, unsettled_fill(dark)));
        }
    }
}

/// Where a scattered point stands in a frame, points; `None` where the panels hold cells.
pub(super) fn positions(grid: &Grid, panels: &Panels, instance: usize, frame: &Frame) -> Option<[f64; 2]> {
    let (x_column, y_column) = panels.scatter?;
    let coordinates = grid.coordinates(instance);
    let x = coordinates.get(x_column).map_or(0.5, |value| panels.x.position(value));
    let up = match (&panels.y, y_column) {
        (Some(axis), Some(column)) => axis.position(coordinates[column]),
        _ => 0.5,
    };
    Some([frame.across(x), frame.up(up)])
}

/// One point; without a class a white one with a cross.
fn point(svg: &mut Svg, x: f64, y: f64, class: Option<&Class>) {
    /// Edge of a cross inside the circle.
    const ARM: f64 = 0.7 * POINT_RADIUS;
    let (name, fill) = class.map_or(("failed", FAILED_FILL), |look| (look.name, look.fill));
    svg.circle(
        x,
        y,
        POINT_RADIUS,
        &format!(r##"class="{name}" fill="{fill}" stroke="#000000" stroke-width="0.5""##),
    );
    if class.is_none() {
        svg.path(&super::key::cross((x, y), ARM), r##"fill="none" stroke="#C00000" stroke-width="0.9""##);
    }
}

/// A point that was not computed: hatched, in a thin grey line.
fn missing_point(svg: &mut Svg, x: f64, y: f64) {
    svg.circle(x, y, POINT_RADIUS, &format!(r#"class="not_computed" fill="{FAILED_FILL}""#));
    let hatch = r##"fill="url(#not-computed)" stroke="#B4B4B4" stroke-width="0.5""##;
    svg.circle(x, y, POINT_RADIUS, hatch);
}
