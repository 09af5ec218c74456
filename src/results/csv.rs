//! `map.csv`: one row per instance, in the order of the grid.

use std::io::Write;

use rayon::prelude::*;

use crate::engine::record::Record;
use crate::results::accounted::accounted;
use crate::results::error::{Error, Result};
use crate::sweep::columns::{Column, columns};
use crate::sweep::grid::Grid;
use crate::sweep::map::Map;
use crate::sweep::sheet::Sheet;

/// Rows that one thread formats at a time.
const ROWS: usize = 2048;

/// The table of a map: UTF-8, comma separated, one header row, `\n` line ends.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn map_csv(map: &Map) -> Result<Vec<u8>> {
    accounted(map)?;
    let mut table = MapCsv::new(Sheet::from(map), Vec::new())?;
    table.add(0, &map.records)?;
    Ok(table.finish())
}

/// The table of a sweep, written part by part; keeps nothing of it.
#[derive(Debug)]
pub struct MapCsv<'a, W> {
    sheet: Sheet<'a>,
    columns: Vec<Column>,
    out: W,
}

impl<'a, W: Write> MapCsv<'a, W> {
    /// Writes the header.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(sheet: Sheet<'a>, mut out: W) -> Result<MapCsv<'a, W>> {
        let columns = columns(sheet.grid, sheet.analysis);
        let header = Table::new(columns.iter().map(|column| column.name))?.finish()?;
        written(out.write_all(&header))?;
        Ok(MapCsv { sheet, columns, out })
    }

    /// Writes the rows of the instances from `first` on; they are formatted on the rayon pool.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn add(&mut self, first: usize, records: &[Record]) -> Result<()> {
        let (grid, columns) = (self.sheet.grid, &self.columns);
        let parts: Vec<Vec<u8>> = records
            .par_chunks(ROWS)
            .enumerate()
            .map(|(part, records)| rows(grid, columns, (first + part * ROWS).., records))
            .collect::<Result<_>>()?;
        parts.iter().try_for_each(|part| written(self.out.write_all(part)))
    }

    /// Writes the rows of some instances, formatted on the rayon pool.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn add_some(&mut self, instances: &[usize], records: &[Record]) -> Result<()> {
        let (grid, columns) = (self.sheet.grid, &self.columns);
        let parts: Vec<Vec<u8>> = instances
            .par_chunks(ROWS)
            .zip(records.par_chunks(ROWS))
            .map(|(instances, records)| rows(grid, columns, instances.iter().copied(), records))
            .collect::<Result<_>>()?;
        parts.iter().try_for_each(|part| written(self.out.write_all(part)))
    }

    /// Gives back what it wrote to.
    pub fn finish(self) -> W {
        self.out
    }
}

/// The rows of some instances.
fn rows(
    grid: &Grid,
    columns: &[Column],
    instances: impl Iterator<Item = usize>,
    records: &[Record],
) -> Result<Vec<u8>> {
    let mut table = Table(csv::Writer::from_writer(Vec::new()));
    for (index, record) in instances.zip(records) {
        let coordinates = grid.coordinates(index);
        table.row(columns.iter().map(|column| column.cell(index, &coordinates, record).to_string()))?;
    }
    table.finish()
}

fn written(result: std::io::Result<()>) -> Result<()> {
    result.map_err(|why| Error::WriteTable(why.into()))
}

/// A table in memory.
pub(crate) struct Table(csv::Writer<Vec<u8>>);

impl Table {
    pub(crate) fn new(header: impl Iterator<Item = impl AsRef<[u8]>>) -> Result<Table> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(header).map_err(Error::WriteTable)?;
        Ok(Table(writer))
    }

    pub(crate) fn row(&mut self, cells: impl Iterator<Item = String>) -> Result<()> {
        self.0.write_record(cells.map(String::into_bytes)).map_err(Error::WriteTable)
    }

    pub(crate) fn finish(self) -> Result<Vec<u8>> {
        self.0.into_inner().map_err(|error| Error::WriteTable(error.into_error().into()))
    }
}
