//! A number over the panels: cells or points by lightness, angles by colours that close a circle.

use crate::results::figure::field::Field;
use crate::results::figure::fills::FAILED_FILL;
use crate::results::figure::outline::{corner, shape, steps};
use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::points::{self, Marks, NOT_COMPUTED, contrast, positions};
use crate::results::figure::tones::Tones;
use crate::sweep::grid::Grid;
use squealmap_figure::boundaries::{Vertex, outlines};
use squealmap_figure::frame::Frame;
use squealmap_figure::svg::Svg;

/// How a point without a value looks, and its sample.
pub(super) const UNDEFINED: &str = r##"fill="url(#not-computed)" stroke="#000000" stroke-width="0.4""##;
/// Radius of a dot on a small point, by that of the point.
const DOT: f64 = 0.4;

/// Draws the content of a panel into its frame.
pub(crate) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    field: &Field<'_>,
    frame: &Frame,
) {
    let tones = field.tones;
    let of = |place: usize| field.value(place).map(|value| tones.step(value, &field.scale));
    let is_dark = |step| tones.is_dark(step);
    if panels.scatter.is_some() {
        return draw_points(svg, grid, panels, panel, field, frame);
    }
    let Some([columns, rows]) = shape(panels, panel) else { return };
    let at = |vertex: Vertex| corner(panels, frame, vertex);
    let place = |i: usize, j: usize| panel.cells.start + j * columns + i;
    let region = |inside: &dyn Fn(usize) -> bool| {
        let paths = outlines(columns, rows, |i, j| inside(place(i, j)));
        paths.iter().map(|path| steps(path, &at, true)).collect::<String>()
    };
    svg.open(r#"shape-rendering="crispEdges" fill-rule="evenodd""#);
    for number in 0..tones.steps() {
        svg.path(&region(&|place| of(place) == Some(number)), &format!(r#"fill="{}""#, tones.fill(number)));
    }
    svg.close();
    let missing = region(&|place| of(place).is_none());
    svg.path(&missing, &format!(r#"class="undefined" fill="{FAILED_FILL}""#));
    svg.path(&missing, r#"fill="url(#not-computed)" fill-rule="evenodd""#);
    for dark in [false, true] {
        let doubtful = region(&|place| field.is_doubtful(place) && of(place).map(is_dark) == Some(dark));
        svg.path(&doubtful, &dotted(dark));
    }
}

/// Draws the content of a panel of scattered points. Those with a value lie on top of those without.
fn draw_points(svg: &mut Svg, grid: &Grid, panels: &Panels, panel: &Panel, field: &Field<'_>, frame: &Frame) {
    let Some(scatter) = panels.scatter else { return };
    let (tones, radius) = (field.tones, points::radius(scatter, frame));
    let mut undefined = Vec::new();
    let mut defined = Vec::new();
    for place in panel.cells.clone() {
        let Some(at) = positions(grid, panels, panels.instances[place], frame) else { continue };
        match field.value(place) {
            Some(value) => defined.push((at, tones.step(value, &field.scale), field.is_doubtful(place))),
            None => undefined.push(at),
        }
    }
    if !points::outlined(radius) {
        return draw_small_points(svg, &undefined, &defined, tones, radius);
    }
    for [x, y] in undefined {
        svg.circle(x, y, radius, &format!(r#"class="undefined" fill="{FAILED_FILL}""#));
        svg.circle(x, y, radius, UNDEFINED);
    }
    for ([x, y], step, doubtful) in defined {
        let tone = tones.fill(step);
        svg.circle(x, y, radius, &format!(r##"fill="{tone}" stroke="#000000" stroke-width="0.5""##));
        if doubtful {
            svg.circle(x, y, radius, &dotted(tones.is_dark(step)));
        }
    }
}

/// Draws points that are too small for outlines. Each defined one is its place, the step of its value, and whether its
/// response has not settled.
fn draw_small_points(
    svg: &mut Svg,
    undefined: &[[f64; 2]],
    defined: &[([f64; 2], usize, bool)],
    tones: Tones<'_>,
    radius: f64,
) {
    Marks { radius, class: "undefined" }.backslashes(svg, undefined, NOT_COMPUTED);
    let mut of_step = vec![Vec::new(); tones.steps()];
    let mut doubtful = [Vec::new(), Vec::new()];
    for (at, step, open) in defined {
        of_step[*step].push(*at);
        if *open {
            doubtful[usize::from(tones.is_dark(*step))].push(*at);
        }
    }
    for (step, at) in of_step.iter().enumerate() {
        Marks { radius, class: "value" }.rims(svg, at, &tones.fill(step));
    }
    for (dark, at) in [(false, &doubtful[0]), (true, &doubtful[1])] {
        Marks { radius: DOT * radius, class: "unsettled" }.discs(svg, at, contrast(dark));
    }
}

/// The dots on what has not settled.
fn dotted(dark: bool) -> String {
    let tone = if dark { "dark" } else { "light" };
    format!(r#"class="unsettled" fill="url(#dots-on-{tone})" fill-rule="evenodd""#)
}
