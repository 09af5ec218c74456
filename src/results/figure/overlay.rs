//! Lines over the panels of a map that come from elsewhere, such as the curves on which cycles end.

use std::fmt::Write as _;

use crate::results::figure::panels::{Panel, Panels};
use crate::sweep::grid::{AxisKey, Grid, Value};
use squealmap_figure::frame::Frame;
use squealmap_figure::svg::Svg;
use squealmap_figure::words::number;

/// Under a line, so that it is seen on any colour.
const HALO: &str = r##"fill="none" stroke="#FFFFFF" stroke-width="2.4" stroke-linejoin="round""##;

/// How a kind of line is drawn and named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stroke {
    /// Its words in the legend; empty where that does not name it.
    pub words: &'static str,
    /// Its attributes.
    pub attributes: &'static str,
    /// Of a mark instead of a line: the attributes of the larger dot under it.
    pub rim: Option<&'static str>,
}

impl Stroke {
    /// A line.
    #[must_use]
    pub const fn line(words: &'static str, attributes: &'static str) -> Stroke {
        Stroke { words, attributes, rim: None }
    }
}

/// A line over panels.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// What its coordinates are.
    pub axes: [AxisKey; 2],
    /// The panels that it is in have these values of their other axes.
    pub others: Vec<(AxisKey, Value)>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

impl Overlay {
    /// Whether the line is in a panel, and whether its coordinates are across and up (0, 1) or up and across (1, 0).
    fn order(&self, grid: &Grid, panels: &Panels, panel: &Panel) -> Option<[usize; 2]> {
        let sides = [panels.x.key()?, panels.y.as_ref()?.key()?];
        let order = [[0, 1], [1, 0]].into_iter().find(|order| order.map(|k| self.axes[k]) == sides)?;
        let first = *panels.instances.get(panel.cells.start)?;
        let mut here = Vec::new();
        grid.each(first, |key, value| here.push((key, value)));
        let matches = |(key, value): &(AxisKey, Value)| {
            here.iter().find(|(other, _)| other == key).is_some_and(|(_, other)| *other == value)
        };
        (panels.scatter.is_none() && self.others.iter().all(matches)).then_some(order)
    }

    /// Whether it is in any panel of a grid.
    pub(crate) fn is_in(&self, grid: &Grid) -> bool {
        let panels = Panels::new(grid);
        panels.all.iter().any(|panel| self.order(grid, &panels, panel).is_some())
    }
}

/// Draws the lines of a panel, inside its frame.
pub(crate) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    lines: &[Overlay],
    frame: &Frame,
) {
    let Some(up) = &panels.y else { return };
    for line in lines {
        let Some(order) = line.order(grid, panels, panel) else { continue };
        let mut data = String::new();
        for (k, point) in line.points.iter().enumerate() {
            let [x, y] = order.map(|k| point[k]);
            let x = frame.across(panels.x.scale.position(x).clamp(0.0, 1.0));
            let y = frame.up(up.scale.position(y).clamp(0.0, 1.0));
            let step = if k == 0 { 'M' } else { 'L' };
            let _ = write!(data, "{step}{} {}", number(x), number(y));
        }
        svg.path(&data, HALO);
        svg.path(&data, line.stroke.attributes);
    }
}

/// The strokes that occur, each once, in the order in which they come.
pub(crate) fn strokes(lines: &[Overlay]) -> Vec<Stroke> {
    let mut strokes: Vec<Stroke> = Vec::new();
    for line in lines {
        if !line.stroke.words.is_empty() && !strokes.contains(&line.stroke) {
            strokes.push(line.stroke);
        }
    }
    strokes
}
