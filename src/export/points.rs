//! The content of a panel of scattered points.

use std::cmp::Reverse;
use std::fmt::Write as _;

use super::cells::{FAILED_FILL, not_computed, unsettled, unsettled_paint};
use super::frame::Frame;
use super::palette::{Class, Colouring, PALE};
use super::panels::{Panel, Panels};
use super::svg::{Svg, number};
use crate::grid::Grid;
use crate::label::Label;

/// Largest and smallest radius of a point.
const RADII: [f64; 2] = [0.4, 3.2];
/// Radius by the distance of points that fill a panel evenly: neighbours leave half of its area free.
const PER_DISTANCE: f64 = 0.4;
/// Smaller points have no outline, which would be most of them.
const OUTLINED_FROM: f64 = 1.6;
/// Points of one path: a renderer's time grows faster than the points of a single one.
const POINTS_OF_A_PATH: usize = 256;

/// Colour of small points that were not computed.
const MISSING: &str = "#B4B4B4";
/// Layers of small points that failed, by their radius, and the least of that.
const FAILED: [(f64, &str); 3] = [(1.8, "#000000"), (1.5, FAILED_FILL), (0.9, "#C00000")];
const LEAST_FAILED: f64 = 0.8;
/// The rim of small points that are as light as the paper, and their radius within it.
const RIM: &str = "#808080";
const WITHIN_RIM: f64 = 0.7;

/// The radius of all points of a figure, so small that those of its fullest panel can be told apart.
pub(super) fn radius(panels: &Panels, frame: &Frame) -> f64 {
    let most = panels.all.iter().map(|panel| panel.cells.len()).max().unwrap_or(1).max(1);
    let distance = (frame.width * frame.height / most as f64).sqrt();
    (PER_DISTANCE * distance).clamp(RADII[0], RADII[1])
}

/// Whether points of this radius have an outline; else they are drawn by [`dots`].
pub(super) fn outlined(radius: f64) -> bool {
    radius >= OUTLINED_FROM
}

/// Draws the points of a panel into its frame.
pub(super) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    colouring: Colouring,
    frame: &Frame,
) {
    let radius = radius(panels, frame);
    let at = |place: &usize| positions(grid, panels, panels.instances[*place], frame);
    let missing = |place: &usize| not_computed(panels.labels[*place], colouring);
    // Nothing that was computed is covered by a point that was not.
    let (missing, computed): (Vec<usize>, Vec<usize>) = panel.cells.clone().partition(missing);
    if !outlined(radius) {
        let of = |place: &usize| Some((at(place)?, panels.labels[*place]));
        let missing: Vec<_> = missing.iter().filter_map(at).collect();
        let computed: Vec<_> = computed.iter().filter_map(of).collect();
        return draw_dense(svg, &missing, &computed, colouring, radius);
    }
    for [x, y] in missing.iter().filter_map(at) {
        missing_point(svg, [x, y], radius);
    }
    for place in computed {
        let (Some([x, y]), label) = (at(&place), panels.labels[place]) else { continue };
        point(svg, [x, y], radius, colouring.class(label).map(|k| &colouring.classes()[k]));
        if unsettled(label, colouring) {
            let dark = colouring.class(label).is_some_and(|k| colouring.classes()[k].dark);
            svg.circle(x, y, radius, &format!(r#"class="unsettled" fill="{}""#, unsettled_paint(dark)));
        }
    }
}

/// Draws points too small for outlines: those that were not computed, then class by class, the rarest last, and on top of
/// them those without one.
fn draw_dense(
    svg: &mut Svg,
    missing: &[[f64; 2]],
    computed: &[([f64; 2], Label)],
    colouring: Colouring,
    radius: f64,
) {
    let classes = colouring.classes();
    let mut members = vec![Vec::new(); classes.len()];
    let mut hatched = members.clone();
    let mut failed = Vec::new();
    for (at, label) in computed {
        let Some(k) = colouring.class(*label) else {
            failed.push(*at);
            continue;
        };
        members[k].push(*at);
        if unsettled(*label, colouring) {
            hatched[k].push(*at);
        }
    }
    let mut order: Vec<usize> = (0..classes.len()).collect();
    order.sort_by_key(|k| Reverse(members[*k].len()));
    dots(svg, missing, radius, "not_computed", MISSING);
    for k in order {
        let Class { name, fill, dark, .. } = classes[k];
        dots(svg, &members[k], radius, name, fill);
        dots(svg, &hatched[k], radius, "unsettled", unsettled_paint(dark));
    }
    // White rings around red: no class looks like them.
    for (times, colour) in FAILED {
        layer(svg, &failed, times * radius.max(LEAST_FAILED), "failed", colour);
    }
}

/// Draws discs without outline, but for those that are as light as the paper: the round ends of lines of no length.
pub(super) fn dots(svg: &mut Svg, at: &[[f64; 2]], radius: f64, name: &str, colour: &str) {
    if matches!(colour, FAILED_FILL | PALE) {
        layer(svg, at, radius, name, RIM);
        layer(svg, at, radius * WITHIN_RIM, name, colour);
    } else {
        layer(svg, at, radius, name, colour);
    }
}

/// One layer of [`dots`].
fn layer(svg: &mut Svg, at: &[[f64; 2]], radius: f64, name: &str, colour: &str) {
    let width = number(2.0 * radius);
    let look = format!(
        r#"class="{name}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#
    );
    for points in at.chunks(POINTS_OF_A_PATH) {
        let mut data = String::new();
        for [x, y] in points {
            let _ = write!(data, "M{} {}h0.01", number(*x), number(*y));
        }
        svg.path(&data, &look);
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
fn point(svg: &mut Svg, [x, y]: [f64; 2], radius: f64, class: Option<&Class>) {
    /// Edge of a cross inside the circle, by its radius.
    const ARM: f64 = 0.7;
    let (name, fill) = class.map_or(("failed", FAILED_FILL), |look| (look.name, look.fill));
    svg.circle(
        x,
        y,
        radius,
        &format!(r##"class="{name}" fill="{fill}" stroke="#000000" stroke-width="0.5""##),
    );
    if class.is_none() {
        svg.path(
            &super::key::cross((x, y), ARM * radius),
            r##"fill="none" stroke="#C00000" stroke-width="0.9""##,
        );
    }
}

/// A point that was not computed: hatched, in a thin grey line.
fn missing_point(svg: &mut Svg, [x, y]: [f64; 2], radius: f64) {
    svg.circle(x, y, radius, &format!(r#"class="not_computed" fill="{FAILED_FILL}""#));
    let hatch = r##"fill="url(#not-computed)" stroke="#B4B4B4" stroke-width="0.5""##;
    svg.circle(x, y, radius, hatch);
}
