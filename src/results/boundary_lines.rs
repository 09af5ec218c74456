//! The lines between classes as a table, for pgfplots and MATLAB.

use crate::results::csv::Table;
use crate::results::error::Result;
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::PictureAxis;
use crate::sweep::columns::Cell;
use crate::sweep::grid::{AxisKey, Grid};
use crate::sweep::label::Label;
use crate::sweep::map::Map;
use crate::sweep::refine::Refined;
use crate::sweep::spec::{Analysis, Spec};
use squealmap_figure::boundaries::{Vertex, borders};

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
    let mut lines = Lines::new(map.spec.analysis)?;
    let (Some(y), None) = (&panels.y, panels.scatter) else { return lines.table.finish() };
    let numeric = |axis: &PictureAxis| axis.key().is_some_and(|key| matches!(key, AxisKey::Param(_)));
    if keys.is_empty() || !numeric(&panels.x) || !numeric(y) {
        return lines.table.finish();
    }
    let columns = panels.x.len();
    for (number, panel) in panels.all.iter().enumerate() {
        let label = |(i, j): Vertex| panels.labels[panel.cells.start + j * columns + i];
        lines.add(number + 1, [&panels.x, y], label)?;
    }
    lines.table.finish()
}

/// The boundary lines of a refined map, in the form of [`boundary_lines`], at the full resolution of its grid. Its panels
/// are the planes of the grid.
///
/// # Errors
/// When the table cannot be written.
pub fn refined_lines(spec: &Spec, refined: &Refined) -> Result<Vec<u8>> {
    let mut lines = Lines::new(spec.analysis)?;
    let Grid::Axes(axes) = &spec.grid else { return lines.table.finish() };
    let planes = &refined.planes;
    let [x, y] = planes.axes.map(|i| PictureAxis::cells(&axes[i]));
    for plane in 0..planes.count() {
        let label = |(i, j): Vertex| refined.labels[planes.listed(plane, [x.order[i], y.order[j]])];
        lines.add(plane + 1, [&x, &y], label)?;
    }
    lines.table.finish()
}

/// The table of lines.
struct Lines {
    table: Table,
    analysis: Analysis,
}

impl Lines {
    fn new(analysis: Analysis) -> Result<Lines> {
        let table = Table::new(["panel", "separates", "x", "y"].into_iter())?;
        Ok(Lines { table, analysis })
    }

    /// Adds the lines of a panel of labelled cells.
    fn add(
        &mut self,
        number: usize,
        [x, y]: [&PictureAxis; 2],
        label: impl Fn(Vertex) -> Label,
    ) -> Result<()> {
        for colouring in Colouring::of(self.analysis) {
            let class = |cell: Vertex| colouring.class(label(cell));
            let mut row = |x: String, y: String| {
                self.table.row([number.to_string(), colouring.name().to_owned(), x, y].into_iter())
            };
            for line in borders(x.len(), y.len(), |a, b| class(a) != class(b)) {
                for (i, j) in line {
                    let [x, y] = [x.scale.value(x.edges[i]), y.scale.value(y.edges[j])];
                    row(Cell::from(x).to_string(), Cell::from(y).to_string())?;
                }
                row("NaN".to_owned(), "NaN".to_owned())?;
            }
        }
        Ok(())
    }
}
