//! `modes.csv` and `modes.json`: eigenvalues along an axis read back.

use std::f64::consts::TAU;

use num_complex::Complex64;
use serde::Deserialize;

use crate::results::read::folder::{Folder, Table, Why};
use crate::results::read::map::drawn_spec;
use crate::store::grid_json;
use crate::study::error::Result;
use crate::study::modes::follow::{Document, Mode, Modes, along, columns};
use crate::sweep::grid::Grid;
use crate::sweep::spec::{Analysis, Spec};

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
    Ok((drawn_spec(document.title.clone(), Analysis::LINEAR, grid), modes))
}

/// Takes the modes from their table, which has a row for every instance.
fn fill(modes: &mut Modes, table: &Table, instances: usize) -> Why<()> {
    if table.rows.len() != instances {
        return Err(format!("{} rows for {instances} instances", table.rows.len()));
    }
    let there = (1..).take_while(|mode| table.find(&columns(*mode)[0]).is_some());
    let all: Why<Vec<Vec<[f64; 3]>>> =
        there.map(columns).map(|names| table.numbers(names.each_ref().map(String::as_str))).collect();
    let all = all?;
    let mode = |frequency: f64, growth_rate: f64, fast: f64| Mode {
        value: Complex64::new(growth_rate, TAU * frequency),
        fast: fast.is_finite().then_some(fast),
    };
    let found = |instance: &usize| {
        let numbers = || all.iter().map(|rows| rows[*instance]);
        let defined =
            numbers().any(|[frequency, growth_rate, _]| frequency.is_finite() || growth_rate.is_finite());
        defined.then(|| {
            numbers().map(|[frequency, growth_rate, fast]| mode(frequency, growth_rate, fast)).collect()
        })
    };
    for branch in &mut modes.branches {
        branch.modes = branch.instances.iter().map(found).collect();
    }
    Ok(())
}
