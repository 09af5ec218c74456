//! The content of a panel: cells or points in the colour of their class, with hatching and border lines.

use crate::results::figure::field::Field;
use crate::results::figure::fills::{
    FAILED_FILL, LIMIT, hatch, is_stable, not_computed, unsettled, unsettled_fill,
};
use crate::results::figure::look::Content;
use crate::results::figure::outline::{corner, shape, steps};
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::sides::Sides;
use crate::results::figure::{isolines, points, quantity};
use crate::sweep::grid::Grid;
use squealmap_figure::boundaries::{Vertex, borders, outlines};
use squealmap_figure::frame::Frame;
use squealmap_figure::svg::Svg;

/// Border lines between classes.
const BORDER: &str = r##"fill="none" stroke="#000000" stroke-width="0.5" stroke-linejoin="round""##;
/// Draws the content of a panel into its frame.
pub(crate) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    content: Content<'_>,
    frame: &Frame,
) {
    if let Some(field) = Field::of(content, panels) {
        quantity::draw(svg, grid, panels, panel, &field, frame);
    }
    let (colouring, hatched) = match content {
        Content::Basin | Content::Named { .. } | Content::Lines => return,
        Content::LargeRegime => (Colouring::Regime, false),
        Content::Quantity { column, levels } => {
            return isolines::draw(svg, panels, panel, (column, levels), frame);
        }
        Content::Classes { colouring, hatched } => (colouring, hatched),
    };
    if panels.scatter.is_some() {
        points::draw(svg, grid, panels, panel, colouring, frame);
    } else {
        draw_cells(svg, panels, panel, (colouring, hatched), frame);
    }
}

fn draw_cells(
    svg: &mut Svg,
    panels: &Panels,
    panel: &Panel,
    (colouring, hatched): (Colouring, bool),
    frame: &Frame,
) {
    let Some([columns, rows]) = shape(panels, panel) else { return };
    let at = |vertex: Vertex| corner(panels, frame, vertex);
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
    if hatched {
        for (k, look) in colouring.classes().iter().enumerate() {
            if let Some(hatch) = hatch(k, look.dark) {
                svg.path(&region(&|i, j| class(i, j) == Some(k)), &hatch);
            }
        }
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
        colouring != Colouring::Type && matches!(sides, [Some(one), Some(other)] if one != other)
    };
    // Where a run stopped is no border between classes.
    let known = |a: Vertex, b: Vertex| !blank(a.0, a.1) && !blank(b.0, b.1);
    svg.path(&lines(&|a, b| class(a.0, a.1) != class(b.0, b.1) && known(a, b) && !limit(a, b)), BORDER);
    let limit = lines(&limit);
    for stroke in LIMIT {
        svg.path(&limit, stroke);
    }
    Sides::draw(svg, panels, frame);
}
