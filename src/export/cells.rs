//! The content of a panel: cells or points in the colour of their class, with hatching and border lines.

use std::fmt::Write as _;

use super::boundaries::{Vertex, borders, outlines};
use super::frame::Frame;
use super::palette::Colouring;
use super::panels::{Panel, Panels};
use super::svg::{Svg, number};
use crate::classify::InstabilityType;
use crate::grid::Grid;
use crate::label::Label;
use crate::outcome::Status;

/// Fill of cells without a result, or not computed.
pub(super) const FAILED_FILL: &str = "#FFFFFF";
/// Border lines between classes.
const BORDER: &str = r##"fill="none" stroke="#000000" stroke-width="0.5" stroke-linejoin="round""##;
/// The light casing and the dashes of the linear stability limit.
pub(super) const LIMIT: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="1.2" stroke-linejoin="round""##,
    r##"fill="none" stroke="#000000" stroke-width="0.75" stroke-dasharray="2.2 1.2" stroke-linejoin="round""##,
];
/// Radius of scattered points.
pub(super) const POINT_RADIUS: f64 = 3.2;

/// Hatchings, defined once per figure.
pub(super) fn define_patterns(svg: &mut Svg) {
    for (id, colour) in [("unsettled-on-light", "#000000"), ("unsettled-on-dark", "#FFFFFF")] {
        svg.define(&format!(
            r#"<pattern id="{id}" patternUnits="userSpaceOnUse" width="2.4" height="2.4"><path d="M-0.6 0.6L0.6 -0.6M0 2.4L2.4 0M1.8 3L3 1.8" stroke="{colour}" stroke-width="0.45"/></pattern>"#
        ));
    }
    svg.define(
        r##"<pattern id="not-computed" patternUnits="userSpaceOnUse" width="4" height="4"><path d="M-1 3L1 5M0 0L4 4M3 -1L5 1" stroke="#B4B4B4" stroke-width="0.4"/></pattern>"##,
    );
    svg.define(
        r##"<pattern id="failed" patternUnits="userSpaceOnUse" width="3" height="3"><path d="M0 0L3 3M3 0L0 3" stroke="#C00000" stroke-width="0.5"/></pattern>"##,
    );
}

/// The pattern that marks an unsettled instance of a class.
pub(super) fn unsettled_fill(dark: bool) -> &'static str {
    if dark { r#"fill="url(#unsettled-on-dark)""# } else { r#"fill="url(#unsettled-on-light)""# }
}

/// Whether hatching applies: only the response settles.
fn unsettled(label: Label, colouring: Colouring) -> bool {
    colouring == Colouring::Regime && label.settled() == Some(false)
}

/// Whether a stopped run did not come to what a colouring shows of an instance.
pub(super) fn not_computed(label: Label, colouring: Colouring) -> bool {
    label.status() == Status::NotComputed && colouring.class(label).is_none()
}

/// Draws the content of a panel into its frame.
pub(super) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    colouring: Colouring,
    frame: &Frame,
) {
    if panels.scatter.is_some() {
        draw_points(svg, grid, panels, panel, colouring, frame);
    } else {
        draw_cells(svg, panels, panel, colouring, frame);
    }
}

fn draw_cells(svg: &mut Svg, panels: &Panels, panel: &Panel, colouring: Colouring, frame: &Frame) {
    let columns = panels.x.len();
    let rows = panels.y.as_ref().map_or(1, super::picture_axis::PictureAxis::len);
    if columns * rows != panel.cells.len() || panel.cells.is_empty() {
        return;
    }
    let unit = [0.0, 1.0];
    let y_edges = panels.y.as_ref().map_or(unit.as_slice(), |y| &y.edges);
    let at = |(i, j): Vertex| (frame.across(panels.x.edges[i]), frame.up(y_edges[j]));
    let label = |i: usize, j: usize| panels.labels[panel.cells.start + j * columns + i];
    let class = |i: usize, j: usize| colouring.class(label(i, j));
    let region = |inside: &dyn Fn(usize, usize) -> bool| {
        outlines(columns, rows, inside).iter().map(|path| steps(path, &at, true)).collect::<String>()
    };
    svg.open(r#"shape-rendering="crispEdges" fill-rule="evenodd""#);
    for (k, look) in colouring.classes().iter().enumerate() {
        let data = region(&|i, j| class(i, j) == Some(k));
        svg.path(&data, &format!(r#"class="{}" fill="{}""#, look.name, look.fill));
    }
    let blank = |i: usize, j: usize| not_computed(label(i, j), colouring);
    let failed = region(&|i, j| class(i, j).is_none() && !blank(i, j));
    let missing = region(&blank);
    for (name, data) in [("failed", &failed), ("not_computed", &missing)] {
        svg.path(data, &format!(r#"class="{name}" fill="{FAILED_FILL}""#));
    }
    svg.close();
    svg.path(&missing, r#"fill="url(#not-computed)" fill-rule="evenodd""#);
    svg.path(&failed, r#"fill="url(#failed)" fill-rule="evenodd""#);
    for dark in [false, true] {
        let hatched = region(&|i, j| {
            unsettled(label(i, j), colouring)
                && class(i, j).is_some_and(|k| colouring.classes()[k].dark == dark)
        });
        svg.path(&hatched, &format!(r#"class="unsettled" {} fill-rule="evenodd""#, unsettled_fill(dark)));
    }
    let lines = |differ: &dyn Fn(Vertex, Vertex) -> bool| {
        borders(columns, rows, differ).iter().map(|path| steps(path, &at, false)).collect::<String>()
    };
    let limit = |a: Vertex, b: Vertex| {
        let sides = [label(a.0, a.1).kind(), label(b.0, b.1).kind()].map(|kind| kind.map(is_stable));
        colouring == Colouring::Regime && matches!(sides, [Some(one), Some(other)] if one != other)
    };
    // Where a run stopped is no border between classes.
    let known = |a: Vertex, b: Vertex| !blank(a.0, a.1) && !blank(b.0, b.1);
    svg.path(&lines(&|a, b| class(a.0, a.1) != class(b.0, b.1) && known(a, b) && !limit(a, b)), BORDER);
    let limit = lines(&limit);
    for stroke in LIMIT {
        svg.path(&limit, stroke);
    }
}

/// Whether the sliding equilibrium is stable.
pub(super) fn is_stable(kind: InstabilityType) -> bool {
    kind == InstabilityType::Stable
}

fn draw_points(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    colouring: Colouring,
    frame: &Frame,
) {
    let Some((x_column, y_column)) = panels.scatter else { return };
    // Nothing that was computed is covered by a point that was not.
    let mut points: Vec<usize> = panel.cells.clone().collect();
    points.sort_by_key(|point| !not_computed(panels.labels[*point], colouring));
    for cell in points {
        let coordinates = grid.coordinates(panels.instances[cell]);
        let x = frame.across(coordinates.get(x_column).map_or(0.5, |value| panels.x.position(value)));
        let up = match (&panels.y, y_column) {
            (Some(axis), Some(column)) => axis.position(coordinates[column]),
            _ => 0.5,
        };
        let label = panels.labels[cell];
        if not_computed(label, colouring) {
            missing_point(svg, x, frame.up(up));
            continue;
        }
        point(svg, x, frame.up(up), colouring.class(label).map(|k| &colouring.classes()[k]));
        if unsettled(label, colouring) {
            let dark = colouring.class(label).is_some_and(|k| colouring.classes()[k].dark);
            svg.circle(
                x,
                frame.up(up),
                POINT_RADIUS,
                &format!(r#"class="unsettled" {}"#, unsettled_fill(dark)),
            );
        }
    }
}

/// One point; without a class a white one with a cross.
fn point(svg: &mut Svg, x: f64, y: f64, class: Option<&super::palette::Class>) {
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
        let cross = [(-ARM, -ARM, ARM, ARM), (ARM, -ARM, -ARM, ARM)]
            .map(|(a, b, c, d)| super::svg::polyline([(x + a, y + b), (x + c, y + d)]));
        svg.path(&cross.concat(), r##"fill="none" stroke="#C00000" stroke-width="0.9""##);
    }
}

/// A point that was not computed: hatched, in a thin grey line.
fn missing_point(svg: &mut Svg, x: f64, y: f64) {
    svg.circle(x, y, POINT_RADIUS, &format!(r#"class="not_computed" fill="{FAILED_FILL}""#));
    let hatch = r##"fill="url(#not-computed)" stroke="#B4B4B4" stroke-width="0.5""##;
    svg.circle(x, y, POINT_RADIUS, hatch);
}

/// Path data along cell edges: horizontal and vertical steps only.
fn steps(path: &[Vertex], at: &impl Fn(Vertex) -> (f64, f64), closed: bool) -> String {
    let mut data = String::new();
    let mut before: Option<Vertex> = None;
    let points = if closed { &path[..path.len().saturating_sub(1)] } else { path };
    for vertex in points {
        let (x, y) = at(*vertex);
        let _ = match before {
            None => write!(data, "M{} {}", number(x), number(y)),
            Some(last) if last.1 == vertex.1 => write!(data, "H{}", number(x)),
            Some(_) => write!(data, "V{}", number(y)),
        };
        before = Some(*vertex);
    }
    if closed {
        data.push('Z');
    }
    data
}
