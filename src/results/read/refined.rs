//! `points.csv` and `refine.json`: a refined map read back, by following its lines again through the instances that were
//! computed.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::engine::computation::Computation;
use crate::results::error::Result;
use crate::results::figure::look::Look;
use crate::results::read::folder::{Folder, HEALED, Table, Why};
use crate::results::read::map::{drawn_spec, record};
use crate::results::refined::{Document, figure};
use crate::store::grid_json;
use crate::store::refinement::settings;
use crate::sweep::grid::Grid;
use crate::sweep::label::Label;
use crate::sweep::refine::{Refined, refine};
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::{Analysis, Spec, Starts};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["points.csv", "refine.json"];

/// A refined map and its sweep. Only title, analysis and grid of the sweep are read.
#[derive(Clone, Debug)]
pub(crate) struct Lines {
    pub(crate) spec: Spec,
    computations: [Option<Computation>; 2],
    refined: Refined,
}

impl Lines {
    /// The figure.
    pub(crate) fn svg(&self, look: &Look<'_>) -> String {
        let sheet = Sheet::new(&self.spec, self.computations.each_ref().map(Option::as_ref));
        figure(sheet, &self.refined).look(look)
    }
}

/// Reads the points and follows the lines again: the same points are asked for as by the command.
pub(crate) fn read(folder: Folder<'_>) -> Result<Lines> {
    let whole = folder.sealed(FILES[1], HEALED)?;
    let document = Document::deserialize(&whole).map_err(|why| folder.bad(FILES[1], why.to_string()))?;
    let spec = sweep(&document).map_err(|why| folder.bad(FILES[1], why))?;
    let settings = settings(&whole).map_err(|why| folder.bad(FILES[1], why))?;
    let points = folder.named(FILES[0], [FILES[1], HEALED], &whole)?;
    let known =
        Table::read(&points).and_then(|table| labels(&table)).map_err(|why| folder.bad(FILES[0], why))?;
    let refined = refine(&spec.grid, settings, &mut |instances| {
        let label = |instance: &usize| {
            let missing = || format!("has no instance {instance}, which the lines of `refine.json` lead to");
            known.get(instance).copied().ok_or_else(|| folder.bad(FILES[0], missing()))
        };
        instances.iter().map(label).collect()
    })?;
    let computations = [document.computation.linear, document.computation.response];
    Ok(Lines { spec, computations, refined })
}

/// Title, analysis and grid.
fn sweep(document: &Document) -> Why<Spec> {
    let grid = grid_json::from_json(&document.grid, None).filter(|grid| matches!(grid, Grid::Axes(_)));
    let grid = grid.ok_or_else(|| "has no `grid` of axes".to_owned())?;
    let analysis = Analysis {
        linear: document.analysis.linear,
        response: document.analysis.response,
        until_settled: false,
        finds_cycles: false,
        checked: false,
        starts: if document.both_starts { Starts::Both } else { Starts::One },
    };
    Ok(drawn_spec(document.title.clone(), analysis, grid))
}

/// The label of every instance that was computed.
fn labels(table: &Table) -> Why<BTreeMap<usize, Label>> {
    let place = table.column("instance")?;
    let label = |row: &csv::StringRecord| {
        let cell = row.get(place).unwrap_or_default();
        let instance = cell.parse().map_err(|_| format!("`instance` is `{cell}`, no count"))?;
        Ok((instance, Label::from(&record(table, row)?)))
    };
    table.rows.iter().map(label).collect()
}
