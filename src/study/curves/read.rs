//! `curves.csv` and `curves.json`: curves read back, as lines over a map.

use std::path::Path;

use serde::Deserialize;

use crate::results::figure::overlay::Overlay;
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::PictureAxis;
use crate::results::read::folder::{Folder, Table, Why};
use crate::results::read::map::drawn_spec;
use crate::results::read::{map, refined};
use crate::store::grid_json;
use crate::store::grid_json::PHYSICS;
use crate::study::curves::figure::{ordered, stroke};
use crate::study::curves::table::{Document, OF_CURVES, System, TABLE};
use crate::study::cycles::special::Special;
use crate::study::error::{Error, Result};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::spec::{Analysis, Spec};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = [TABLE, "curves.json"];

/// How files that were changed are put right.
const HEALED: &str = "run `squealmap curves` again";

/// Curves read back.
#[derive(Clone, Debug)]
pub struct Curves {
    /// Title and grid of their sweep.
    pub spec: Spec,
    /// The lines.
    pub lines: Vec<Overlay>,
    /// What they hold for.
    pub(crate) system: System,
}

impl Curves {
    /// The lines over a map in another directory: the manifest of a run or the document of a refinement says of which system
    /// that is.
    ///
    /// # Errors
    /// When the curves cannot be read, are of another system, or lie in no plane of the grid.
    pub fn over(directory: &Path, map: &Path, grid: &Grid) -> Result<Vec<Overlay>> {
        let curves = read(Folder(directory))?;
        let path = || directory.to_owned();
        let of_map =
            [(map::FILES[0], "spec"), (refined::FILES[1], PHYSICS)].into_iter().find_map(|(file, key)| {
                let document = Folder(map).json(file).ok()?;
                System::deserialize(&document[key]).ok()
            });
        if let Some(other) = of_map
            && let Some(section) = curves.system.differs(&other)
        {
            return Err(Error::CurvesOfAnother { path: path(), section });
        }
        if !curves.lines.iter().any(|line| line.is_in(grid)) {
            return Err(Error::CurvesElsewhere { path: path() });
        }
        Ok(curves.lines)
    }
}

/// Reads the curves of a directory.
pub(crate) fn read(folder: Folder<'_>) -> Result<Curves> {
    let document = folder.sealed(FILES[1], HEALED)?;
    let table = folder.named(FILES[0], [FILES[1], HEALED], &document)?;
    let table = Table::read(&table).map_err(|why| folder.bad(FILES[0], why))?;
    let document = Document::deserialize(document).map_err(|why| folder.bad(FILES[1], why.to_string()))?;
    let no_axes = || folder.bad(FILES[1], "has no `grid` of axes");
    let grid = grid_json::from_json(&document.grid, None).ok_or_else(no_axes)?;
    let Grid::Axes(axes) = &grid else { return Err(no_axes().into()) };
    let panels = Panels::new(&grid);
    let sides = panels.x.key().zip(panels.y.as_ref().and_then(PictureAxis::key));
    let (x, y) = sides.ok_or_else(|| folder.bad(FILES[1], "has a `grid` without a plane"))?;
    let lines = lines(&table, axes, [x, y]).map_err(|why| folder.bad(FILES[0], why))?;
    Ok(Curves { spec: drawn_spec(document.title, Analysis::LINEAR, grid), lines, system: document.system })
}

fn lines(table: &Table, axes: &[Axis], sides: [AxisKey; 2]) -> Why<Vec<Overlay>> {
    let [number, special, _] = OF_CURVES;
    let numbers = table.numbers([number, sides[0].name(), sides[1].name()])?;
    let mut lines: Vec<Overlay> = Vec::new();
    let mut last = f64::NAN;
    for (row, [number, x, y]) in table.rows.iter().zip(numbers) {
        if !(x.is_finite() && y.is_finite()) {
            return Err(format!("has a point at ({x}, {y}), which is none of a plane"));
        }
        if number.to_bits() != last.to_bits() {
            let name = table.cell(row, special);
            let stroke = Special::of(name).and_then(stroke);
            let stroke = stroke.ok_or_else(|| format!("`special` is `{name}`, which no curve is"))?;
            let others = axes.iter().filter(|axis| !sides.contains(&axis.key));
            let value = |axis: &Axis| {
                let cell = table.cell(row, axis.key.name());
                let same = |value: &&Value| match value {
                    Value::Number(number) => cell.parse() == Ok(*number),
                    Value::Text(text) => text.as_str() == cell,
                };
                let value = axis.values.iter().find(same);
                value.map(|value| (axis.key, value.clone())).ok_or_else(|| {
                    format!("`{}` is `{cell}`, which is no value of the axis", axis.key.name())
                })
            };
            let others = others.map(value).collect::<Why<_>>()?;
            lines.push(Overlay { axes: sides, others, stroke, points: Vec::new() });
            last = number;
        }
        if let Some(line) = lines.last_mut() {
            line.points.push([x, y]);
        }
    }
    Ok(ordered(lines))
}
