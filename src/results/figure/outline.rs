//! Outlines of cells as paths.

use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::picture_axis::PictureAxis;
use squealmap_figure::boundaries::Vertex;
use squealmap_figure::frame::Frame;
use squealmap_figure::words::number;
use std::fmt::Write as _;

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
