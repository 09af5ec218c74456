//! The lines between classes as a table, for pgfplots and MATLAB.

use super::boundaries::{Vertex, borders};
use super::columns::Cell;
use super::csv::Table;
use super::palette::Colouring;
use super::panels::Panels;
use super::picture_axis::PictureAxis;
use crate::error::Result;
use crate::grid::AxisKey;
use crate::map::Map;

/// One row per corner of a line: the number of the panel (from 1, in the order of the figure), what the line
/// separates (`type` or `regime`), and both coordinates. A row of `NaN` ends each line: MATLAB's `plot` and
/// pgfplots with `unbounded coords=jump` lift the pen there. A map of points has no lines.
///
/// # Errors
/// When the table cannot be written.
pub fn boundary_lines(map: &Map) -> Result<Vec<u8>> {
    let mut panels = Panels::new(&map.spec.grid);
    panels.add(0, &map.records);
    let keys = map.spec.grid.keys();
    let mut table = Table::new(["panel", "separates", "x", "y"].into_iter())?;
    let (Some(y), None) = (&panels.y, panels.scatter) else { return table.finish() };
    let numeric = |axis: &PictureAxis| axis.key().is_some_and(|key| matches!(key, AxisKey::Param(_)));
    if keys.is_empty() || !numeric(&panels.x) || !numeric(y) {
        return table.finish();
    }
    let (columns, rows) = (panels.x.len(), y.len());
    let asked =
        [(Colouring::Type, map.spec.analysis.linear), (Colouring::Regime, map.spec.analysis.response)];
    for (number, panel) in panels.all.iter().enumerate() {
        for (colouring, _) in asked.into_iter().filter(|(_, asked)| *asked) {
            let class = |(i, j): Vertex| colouring.class(panels.labels[panel.cells.start + j * columns + i]);
            let name = if colouring == Colouring::Type { "type" } else { "regime" };
            let mut row = |x: String, y: String| {
                table.row([(number + 1).to_string(), name.to_owned(), x, y].into_iter())
            };
            for line in borders(columns, rows, |a, b| class(a) != class(b)) {
                for (i, j) in line {
                    let [x, y] = [panels.x.scale.value(panels.x.edges[i]), y.scale.value(y.edges[j])];
                    row(Cell::from(x).to_string(), Cell::from(y).to_string())?;
                }
                row("NaN".to_owned(), "NaN".to_owned())?;
            }
        }
    }
    table.finish()
}
