//! `modes.csv` and `modes.json`: eigenvalues along an axis read back.

use std::f64::consts::TAU;

use num_complex::Complex64;
use serde::Deserialize;

use crate::results::read::folder::{Folder, Table, Why};
use crate::results::read::map::drawn_spec;
use crate::store::grid_json;
use crate::study::error::Result;
use crate::study::modes::follow::{COLUMNS, Document, Mode, Modes, along};
use crate::sweep::grid::Grid;
use crate::sweep::spec::{Analysis, Spec, Starts};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["modes.csv", "modes.json"];

/// The modes in a table and a document, and their sweep. Only title and grid of the sweep are read.
pub(crate) fn read(folder: Folder<'_>, files: [&str; 2]) -> Result<(Spec, Modes)> {
    let table = folder.table(files[0])?;
    let document =
        Document::deserialize(folder.json(files[1])?).map_err(|why| folder.bad(files[1], why.to_string()))?;
    let (spec, mut modes) = sweep(&document).map_err(|why| folder.bad(files[1], why))?;
    fill(&mut modes, &table, spec.grid.len()).map_err(|why| folder.bad(files[0], why))?;
    Ok((spec, modes))
}

/// Title, axes and critical values.
fn sweep(document: &Document) -> Why<(Spec, Modes)> {
    let no_axes = || "has no `grid` with an axis of numbers".to_owned();
    let grid = grid_json::from_json(&document.grid, None).ok_or_else(no_axes)?;
    let Grid::Axes(axes) = &grid else { return Err(no_axes()) };
    let mut modes = along(axes).map_err(|_| no_axes())?;
    let critical = &document.critical;
    if critical.len() != modes.branches.len() {
        return Err(format!(
            "has critical values of {} branches, not {}",
            critical.len(),
            modes.branches.len()
        ));
    }
    for (branch, values) in modes.branches.iter_mut().zip(critical) {
        branch.critical.clone_from(values);
    }
    let analysis = Analysis {
        linear: true,
        response: false,
        until_settled: false,
        finds_cycles: false,
        checked: false,
        starts: Starts::One,
    };
    Ok((drawn_spec(document.title.clone(), analysis, grid), modes))
}

/// Takes the modes from their table, which has a row for every instance.
fn fill(modes: &mut Modes, table: &Table, instances: usize) -> Why<()> {
    let rows = table.numbers(COLUMNS)?;
    if rows.len() != instances {
        return Err(format!("{} rows for {instances} instances", rows.len()));
    }
    let mode = |frequency: f64, growth_rate: f64, fast: f64| Mode {
        value: Complex64::new(growth_rate, TAU * frequency),
        fast: fast.is_finite().then_some(fast),
    };
    let pair = |[f1, g1, fast1, f2, g2, fast2]: [f64; 6]| {
        let defined = [f1, g1, f2, g2].iter().any(|number| number.is_finite());
        defined.then(|| [mode(f1, g1, fast1), mode(f2, g2, fast2)])
    };
    for branch in &mut modes.branches {
        branch.modes = branch.instances.iter().map(|instance| pair(rows[*instance])).collect();
    }
    Ok(())
}
