//! A table of the program as columns.

use crate::dataset::Column;
use crate::failure::Failure;

/// The columns of a table by their names: numbers, where every cell is one or empty, else words.
///
/// # Errors
/// When the bytes are no table.
pub(crate) fn columns(bytes: &[u8]) -> Result<Vec<(String, Column)>, Failure> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(bytes);
    let broken = |why: csv::Error| Failure::panic(&why.to_string());
    let names: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_owned).collect();
    let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(broken)?;
    let column = |(at, name): (usize, String)| {
        let cells = rows.iter().map(|row| row.get(at).unwrap_or_default());
        let number = |cell: &str| if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() };
        let column = match cells.clone().map(number).collect() {
            Some(numbers) => Column::Numbers(numbers),
            None => Column::Words(cells.map(str::to_owned).collect()),
        };
        (name, column)
    };
    Ok(names.into_iter().enumerate().map(column).collect())
}
