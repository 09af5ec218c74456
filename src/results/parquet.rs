//! `map.parquet`: the rows and columns of `map.csv` as Apache Parquet, for data frames.
//!
//! One row group per tile. Undefined values are null. Parquet has no place for the unit of a column, so the file's own
//! metadata hold JSON objects from column to `units` and to `meanings`; both are also what pandas takes as `attrs`.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use serde_json::json;

use crate::engine::record::Record;
use crate::results::error::{Error, Result};
use crate::sweep::columns::{Cell, Column, Content, columns};
use crate::sweep::sheet::Sheet;
use crate::version::VERSION;

/// The table of a sweep, written part by part; keeps nothing of it.
pub struct MapParquet<'a, W: Write + Send> {
    sheet: Sheet<'a>,
    columns: Vec<Column>,
    writer: SerializedFileWriter<W>,
}

impl<'a, W: Write + Send> MapParquet<'a, W> {
    /// Begins the file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(sheet: Sheet<'a>, out: W) -> Result<MapParquet<'a, W>> {
        let columns = columns(sheet.grid, sheet.analysis);
        let properties = WriterProperties::builder()
            .set_created_by(format!("squealmap version {VERSION}"))
            .set_compression(Compression::SNAPPY)
            .set_key_value_metadata(Some(metadata(sheet, &columns)));
        let begun = schema(&columns)
            .and_then(|schema| SerializedFileWriter::new(out, schema, Arc::new(properties.build())));
        Ok(MapParquet { sheet, columns, writer: begun.map_err(Error::WriteParquet)? })
    }

    /// Writes the rows of the instances from `first` on as a row group.
    ///
    /// # Errors
    /// When they cannot be written, or a cell is not of its column's content.
    pub fn add(&mut self, first: usize, records: &[Record]) -> Result<()> {
        let mut parts: Vec<Part> = self.columns.iter().map(|column| Part::new(column.content())).collect();
        for (index, record) in (first..).zip(records) {
            let coordinates = self.sheet.grid.coordinates(index);
            for (part, column) in parts.iter_mut().zip(&self.columns) {
                if !part.push(column.cell(index, &coordinates, record)) {
                    let why =
                        format!("a cell of `{}` in row {index} is not of its column's kind", column.name);
                    return Err(Error::WriteParquet(ParquetError::General(why)));
                }
            }
        }
        let write = || {
            let mut group = self.writer.next_row_group()?;
            parts.into_iter().try_for_each(|part| part.write(&mut group))?;
            group.close().map(drop)
        };
        write().map_err(Error::WriteParquet)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(self) -> Result<()> {
        self.writer.close().map(drop).map_err(Error::WriteParquet)
    }
}

/// The columns of the file.
fn schema(columns: &[Column]) -> std::result::Result<Arc<Type>, ParquetError> {
    let field = |column: &Column| {
        let (physical, logical) = match column.content() {
            Content::Number => (Physical::DOUBLE, None),
            Content::Count => (Physical::INT64, None),
            Content::Name => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(column.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical);
        field.build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<std::result::Result<_, _>>()?;
    Type::group_type_builder("map").with_fields(fields).build().map(Arc::new)
}

/// The metadata of the file.
fn metadata(sheet: Sheet, columns: &[Column]) -> Vec<KeyValue> {
    let about = |what: fn(&Column) -> &'static str| {
        columns.iter().map(|column| (column.name, what(column))).collect::<BTreeMap<_, _>>()
    };
    let (units, meanings) = (about(|column| column.unit), about(|column| column.meaning));
    let all = json!({ "title": sheet.title, "units": units, "meanings": meanings });
    [
        ("title", sheet.title.to_owned()),
        ("units", all["units"].to_string()),
        ("meanings", all["meanings"].to_string()),
        ("PANDAS_ATTRS", all.to_string()),
    ]
    .into_iter()
    .map(|(key, value)| KeyValue::new(key.to_owned(), value))
    .collect()
}

/// One column of some rows: its defined values, and for each row 1 if it has one, or else 0.
struct Part {
    values: Values,
    defined: Vec<i16>,
}

enum Values {
    Numbers(Vec<f64>),
    Counts(Vec<i64>),
    Names(Vec<ByteArray>),
}

impl Part {
    fn new(content: Content) -> Part {
        let values = match content {
            Content::Number => Values::Numbers(Vec::new()),
            Content::Count => Values::Counts(Vec::new()),
            Content::Name => Values::Names(Vec::new()),
        };
        Part { values, defined: Vec::new() }
    }

    /// Adds a row; whether the cell is empty or of the column's content.
    fn push(&mut self, cell: Cell) -> bool {
        let defined = match (&mut self.values, cell) {
            (Values::Numbers(numbers), Cell::Number(number)) => {
                numbers.push(number);
                true
            }
            (Values::Counts(counts), Cell::Count(count)) => {
                // More than the largest there is, an instance or a step cannot be.
                counts.push(i64::try_from(count).unwrap_or(i64::MAX));
                true
            }
            (Values::Names(names), Cell::Text(name)) => {
                names.push(ByteArray::from(name.into_bytes()));
                true
            }
            (_, Cell::Empty) => false,
            _ => return false,
        };
        self.defined.push(i16::from(defined));
        true
    }

    fn write<W: Write + Send>(
        self,
        group: &mut SerializedRowGroupWriter<W>,
    ) -> std::result::Result<(), ParquetError> {
        match self.values {
            Values::Numbers(numbers) => column::<DoubleType, W>(group, &numbers, &self.defined),
            Values::Counts(counts) => column::<Int64Type, W>(group, &counts, &self.defined),
            Values::Names(names) => column::<ByteArrayType, W>(group, &names, &self.defined),
        }
    }
}

/// Writes the next column of a row group.
fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<W>,
    values: &[T::T],
    defined: &[i16],
) -> std::result::Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("the schema has too few columns".to_owned()));
    };
    column.typed::<T>().write_batch(values, Some(defined), None)?;
    column.close()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cell is of the content of its column or empty; another is refused and leaves nothing.
    #[test]
    fn a_cell_of_another_kind_is_refused() {
        let cells = || [Cell::Number(0.5), Cell::Count(3), Cell::Text("ok".to_owned())];
        for (own, content) in [Content::Number, Content::Count, Content::Name].into_iter().enumerate() {
            for (kind, cell) in cells().into_iter().enumerate() {
                let mut part = Part::new(content);
                assert!(part.push(Cell::Empty));
                assert_eq!(part.push(cell), kind == own, "{content:?}, cell {kind}");
                assert_eq!(part.defined, if kind == own { vec![0, 1] } else { vec![0] });
            }
        }
    }
}
