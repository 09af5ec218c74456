//! A run read from its directory: its sweep, and what it has computed.

use std::collections::BTreeMap;
use std::path::Path;

use crate::engine::record::Record;
use crate::model::status::Status;
use crate::results::manifest::Program;
use crate::results::read::Archive;
use crate::results::read::folder::{Folder, HEALED};
use crate::results::read::map::FILES;
use crate::store::directory::Store;
use crate::study::error::{Error, Result};
use crate::study::explore::finished::Finished;
use crate::study::explore::region::number;
use crate::sweep::columns::{Column, Content, columns};
use crate::sweep::grid::Grid;
use crate::sweep::spec::{Analysis, Spec, Starts};

/// The sweep of a directory, and what is computed of it: by its table, or by its tiles where a run is on its way.
///
/// # Errors
/// When the directory holds no run, one of single points, one of another version, or a file that was changed.
pub fn read(directory: &Path) -> Result<(Spec, Finished)> {
    if FILES.iter().all(|file| directory.join(file).is_file()) { table(directory) } else { tiles(directory) }
}

fn table(directory: &Path) -> Result<(Spec, Finished)> {
    let folder = Folder(directory);
    let archive = Archive::read(directory)?;
    let document = folder.sealed(FILES[0], HEALED)?;
    let Spec { title, analysis, grid, .. } = &archive.map.spec;
    let spec = Spec::from_resolved(&document["spec"], title, *analysis, grid.clone());
    let spec = spec.ok_or_else(|| {
        let why = "its `spec` is that of another version of this program; run the sweep again";
        folder.bad(FILES[0], why)
    })?;
    let numbers = archive.columns.into_iter().map(|column| (column.name, column.values)).collect();
    let finished = of(&spec, &archive.map.records, archive.program, Some(numbers))?;
    Ok((spec, finished))
}

fn tiles(directory: &Path) -> Result<(Spec, Finished)> {
    let store = Store::open(directory)?;
    let spec = store.description.spec_as_read().ok_or_else(|| Error::NoRunToExplore {
        path: directory.to_owned(),
        why: "its tiles are those of another version of this program",
    })?;
    let mut records = Vec::with_capacity(spec.grid.len());
    for number in 0..store.description.tiling.count() {
        let length = store.description.tiling.bounds(number).len();
        // A tile that is bad or in work is none.
        let tile = store.read(number).ok().flatten();
        records.extend(tile.unwrap_or_else(|| vec![Record::NOT_COMPUTED; length]));
    }
    let program = Program::this().to_string();
    let finished = of(&spec, &records, program, None)?;
    Ok((spec, finished))
}

/// What `records` hold; their classes alone where the numbers stand in a table.
fn of(
    spec: &Spec,
    records: &[Record],
    program: String,
    mut table: Option<BTreeMap<String, Vec<Option<f64>>>>,
) -> Result<Finished> {
    let Grid::Axes(axes) = &spec.grid else { return Err(Error::NothingToExplore) };
    // The first start of many is not the sweep's own.
    let response = spec.analysis.response && !matches!(spec.analysis.starts, Starts::Box(_));
    let analysis = Analysis { response, ..spec.analysis };
    let swept: Vec<&str> = axes.iter().map(|axis| axis.key.name()).collect();
    let all = columns(&spec.grid, analysis);
    let own = all.iter().filter(|column| column.name != "instance" && !swept.contains(&column.name));
    let mut values = |column: &Column| match &mut table {
        Some(table) if column.content() != Content::Name => {
            // A column without any number is not read.
            let numbers = table.remove(column.name).unwrap_or_else(|| vec![None; records.len()]);
            numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect()
        }
        _ => {
            let cells = records.iter().enumerate();
            cells.map(|(index, record)| number(column, &spec.grid, index, record)).collect()
        }
    };
    let values = own.map(|column| (column.name, values(column))).collect();
    let is_computed = records.iter().map(|record| record.status != Status::NotComputed).collect();
    Ok(Finished::new((program, response), axes, is_computed, values))
}
