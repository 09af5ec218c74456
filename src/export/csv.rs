//! `map.csv`: one row per instance, in the order of the grid.

use super::accounted;
use super::columns::columns;
use crate::error::{Error, Result};
use crate::map::Map;

/// The table of a map: UTF-8, comma separated, one header row, `\n` line ends.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn map_csv(map: &Map) -> Result<Vec<u8>> {
    accounted(map)?;
    let columns = columns(&map.spec);
    let mut table = Table::new(columns.iter().map(|column| column.name))?;
    for index in 0..map.records.len() {
        table.row(columns.iter().map(|column| column.cell(map, index).to_string()))?;
    }
    table.finish()
}

/// A table in memory.
pub(super) struct Table(csv::Writer<Vec<u8>>);

impl Table {
    pub(super) fn new<'a>(header: impl Iterator<Item = &'a str>) -> Result<Table> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(header).map_err(Error::WriteTable)?;
        Ok(Table(writer))
    }

    pub(super) fn row(&mut self, cells: impl Iterator<Item = String>) -> Result<()> {
        self.0.write_record(cells.map(String::into_bytes)).map_err(Error::WriteTable)
    }

    pub(super) fn finish(self) -> Result<Vec<u8>> {
        self.0.into_inner().map_err(|error| Error::WriteTable(error.into_error().into()))
    }
}
