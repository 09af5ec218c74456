//! The content of a panel: cells or points in the colour of their class, with hatching and border lines.

use std::fmt::Write as _;

use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::results::figure::isolines;
use crate::results::figure::look::Content;
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::picture_axis::PictureAxis;
use crate::results::figure::points;
use crate::results::figure::quantity;
use crate::results::figure::quantity::Field;
use crate::results::figure::sides::Sides;
use crate::sweep::grid::Grid;
use crate::sweep::label::Label;
use squealmap_figure::boundaries::{Vertex, borders, outlines};
use squealmap_figure::frame::Frame;
use squealmap_figure::svg::{Svg, number};

/// Fill of cells without a result, or not computed.
pub(crate) const FAILED_FILL: &str = "#FFFFFF";
/// Border lines between classes.
const BORDER: &str = r##"fill="none" stroke="#000000" stroke-width="0.5" stroke-linejoin="round""##;
/// The light line and the dashes on it of the linear stability limit: as wide as each other, so that no region beside it is
/// hidden.
pub(crate) const LIMIT: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="0.75" stroke-linejoin="round""##,
    r##"fill="none" stroke="#000000" stroke-width="0.75" stroke-dasharray="2.2 1.2" stroke-linejoin="round""##,
];

/// One hatching per class after the first, in a square of 4 points; they differ in direction and density.
const HATCHES: [&str; 7] = [
    "M-1 1L1 -1M0 4L4 0M3 5L5 3",
    "M-1 3L1 5M0 0L4 4M3 -1L5 1",
    "M0 2H4",
    "M2 0V4",
    "M0 2H4M2 0V4",
    "M0 0L4 4M4 0L0 4",
    "M0 1H2M2 3H4",
];

/// Hatchings, defined once per figure.
pub(crate) fn define_patterns(svg: &mut Svg) {
    for (id, colour) in [("unsettled-on-light", "#000000"), ("unsettled-on-dark", "#FFFFFF")] {
        svg.define(&format!(
            r#"<pattern id="{id}" patternUnits="userSpaceOnUse" width="2.4" height="2.4"><path d="M-0.6 0.6L0.6 -0.6M0 2.4L2.4 0M1.8 3L3 1.8" stroke="{colour}" stroke-width="0.45"/></pattern>"#
        ));
    }
    for (tone, colour) in [("light", "#000000"), ("dark", "#FFFFFF")] {
        svg.define(&format!(
            r#"<pattern id="dots-on-{tone}" patternUnits="userSpaceOnUse" width="3" height="3"><path d="M0.75 0.75h0.01M2.25 2.25h0.01" stroke="{colour}" stroke-width="0.8" stroke-linecap="round"/></pattern>"#
        ));
    }
    for (k, lines) in HATCHES.iter().enumerate() {
        for (tone, colour) in [("light", "#000000"), ("dark", "#FFFFFF")] {
            svg.define(&format!(
                r#"<pattern id="hatch-{k}-{tone}" patternUnits="userSpaceOnUse" width="4" height="4"><path d="{lines}" fill="none" stroke="{colour}" stroke-width="0.4"/></pattern>"#
            ));
        }
    }
    svg.define(
        r##"<pattern id="not-computed" patternUnits="userSpaceOnUse" width="4" height="4"><path d="M-1 3L1 5M0 0L4 4M3 -1L5 1" stroke="#B4B4B4" stroke-width="0.4"/></pattern>"##,
    );
    svg.define(
        r##"<pattern id="failed" patternUnits="userSpaceOnUse" width="3" height="3"><path d="M0 0L3 3M3 0L0 3" stroke="#C00000" stroke-width="0.5"/></pattern>"##,
    );
}

/// The hatching of the class with this position; the first class has none.
pub(crate) fn hatch(class: usize, dark: bool) -> Option<String> {
    let number = class.checked_sub(1).filter(|number| *number < HATCHES.len())?;
    let tone = if dark { "dark" } else { "light" };
    Some(format!(r#"class="hatch" fill="url(#hatch-{number}-{tone})" fill-rule="evenodd""#))
}

/// The pattern that marks an unsettled instance of a class.
pub(crate) fn unsettled_fill(dark: bool) -> &'static str {
    if dark { r#"fill="url(#unsettled-on-dark)""# } else { r#"fill="url(#unsettled-on-light)""# }
}

/// Whether hatching applies: only the response settles.
pub(crate) fn unsettled(label: Label, colouring: Colouring) -> bool {
    colouring == Colouring::Regime && label.settled() == Some(false)
}

/// Whether a stopped run did not come to what a colouring shows of an instance.
pub(crate) fn not_computed(label: Label, colouring: Colouring) -> bool {
    label.status() == Status::NotComputed && colouring.class(label).is_none()
}

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
        Content::Basin | Content::Named { .. } => return,
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

/// Whether the sliding equilibrium is stable.
pub(crate) fn is_stable(kind: InstabilityType) -> bool {
    kind == InstabilityType::Stable
}

/// Columns and rows of a panel of cells; `None` for one without any.
pub(crate) fn shape(panels: &Panels, panel: &Panel) -> Option<[usize; 2]> {
    let shape = [panels.x.len(), panels.y.as_ref().map_or(1, PictureAxis::len)];
    let cells = panel.cells.len();
    (cells > 0 && shape[0] * shape[1] == cells).then_some(shape)
}

/// A corner between cells, points.
pub(crate) fn corner(panels: &Panels, frame: &Frame, (i, j): Vertex) -> (f64, f64) {
    let up = panels.y.as_ref().map_or([0.0, 1.0][j.min(1)], |y| y.edges[j]);
    (frame.across(panels.x.edges[i]), frame.up(up))
}

/// Path data along cell edges: horizontal and vertical steps only.
pub(crate) fn steps(path: &[Vertex], at: &impl Fn(Vertex) -> (f64, f64), closed: bool) -> String {
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
