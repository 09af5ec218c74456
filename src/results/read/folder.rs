//! A directory as a reader sees it: its files, tables of text, and errors that name the file.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::Value as Json;

use crate::results::error::{Error, Result};
use crate::results::manifest::Sum;
use crate::store::seal::is_intact;

/// How damaged results of `run` and `refine` are put right, as the end of a sentence.
pub(crate) const HEALED: &str = "`squealmap verify --repair` writes it anew";

/// A result, or what is wrong with a file as the end of a sentence.
pub(crate) type Why<T> = std::result::Result<T, String>;

/// A directory that a command has written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Folder<'a>(pub(crate) &'a Path);

impl Folder<'_> {
    /// The error of one of its files.
    pub(crate) fn bad(self, file: &str, why: impl Into<String>) -> Error {
        Error::Archive { path: self.0.join(file), why: why.into() }
    }

    /// The text of a file.
    pub(crate) fn text(self, file: &str) -> Result<String> {
        String::from_utf8(self.bytes(file)?).map_err(|_| self.bad(file, "it is no UTF-8 text"))
    }

    /// The bytes of a file.
    pub(crate) fn bytes(self, file: &str) -> Result<Vec<u8>> {
        crate::disk::read(&self.0.join(file)).map_err(|why| self.bad(file, why.to_string()))
    }

    /// A file of JSON.
    pub(crate) fn json(self, file: &str) -> Result<Json> {
        serde_json::from_str(&self.text(file)?).map_err(|why| self.bad(file, why.to_string()))
    }

    /// A file of JSON that may have a checksum of its own. A file that was changed since is refused; `healed` says what puts
    /// it right.
    pub(crate) fn sealed(self, file: &str, healed: &str) -> Result<Json> {
        let document = self.json(file)?;
        // Whichever of the two a change has hit, the other is there.
        let is_sealed = ["files", "checksum"].iter().any(|key| document.get(key).is_some());
        if is_sealed && !is_intact(&self.bytes(file)?) {
            let why = format!("it was changed: its content does not have its checksum; {healed}");
            return Err(self.bad(file, why));
        }
        Ok(document)
    }

    /// The bytes of a file. Where the document `of` says its length and checksum, a file with others is refused, see
    /// [`Folder::sealed`].
    pub(crate) fn named(self, file: &str, [of, healed]: [&str; 2], document: &Json) -> Result<Vec<u8>> {
        let bytes = self.bytes(file)?;
        match Sum::in_manifest(document, file) {
            Some(sum) if sum != Sum::of(&bytes) => {
                let why =
                    format!("it is not the file that {of} names: its checksum is another one; {healed}");
                Err(self.bad(file, why))
            }
            _ => Ok(bytes),
        }
    }

    /// Refuses a table with another number of rows than the document `of` says: one that was cut short at the end of a line
    /// looks whole.
    pub(crate) fn has_rows(self, [file, of]: [&str; 2], table: &Table, rows: usize) -> Result<()> {
        if table.rows.len() == rows {
            return Ok(());
        }
        Err(self.bad(file, format!("has {} rows, but `{of}` says {rows}", table.rows.len())))
    }

    /// A table.
    pub(crate) fn table(self, file: &str) -> Result<Table> {
        Table::read(self.text(file)?.as_bytes()).map_err(|why| self.bad(file, why))
    }
}

/// A table as text.
pub(crate) struct Table {
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<csv::StringRecord>,
}

impl Table {
    pub(crate) fn read(text: &[u8]) -> Why<Table> {
        let mut reader = csv::Reader::from_reader(text);
        let header = reader.headers().map_err(|why| why.to_string())?.iter().map(str::to_owned).collect();
        let rows: std::result::Result<_, _> = reader.records().collect();
        Ok(Table { header, rows: rows.map_err(|why| why.to_string())? })
    }

    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|header| header == name)
    }

    /// The place of a column that has to be there.
    pub(crate) fn column(&self, name: &str) -> Why<usize> {
        self.find(name).ok_or_else(|| format!("has no column `{name}`"))
    }

    /// The cell of a column that may be missing; empty then.
    pub(crate) fn cell<'a>(&self, row: &'a csv::StringRecord, name: &str) -> &'a str {
        self.find(name).and_then(|k| row.get(k)).unwrap_or_default()
    }

    /// The numbers of some columns, row by row; an empty cell, which is an undefined value, is NaN.
    pub(crate) fn numbers<const N: usize>(&self, names: [&str; N]) -> Why<Vec<[f64; N]>> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            *place = self.column(name)?;
        }
        let row = |(line, row): (usize, &csv::StringRecord)| {
            let mut numbers = [f64::NAN; N];
            for ((number, place), name) in numbers.iter_mut().zip(places).zip(names) {
                let cell = row.get(place).unwrap_or_default();
                if !cell.is_empty() {
                    *number = cell
                        .parse()
                        .map_err(|_| format!("row {}: `{name}` is `{cell}`, no number", line + 1))?;
                }
            }
            Ok(numbers)
        };
        self.rows.iter().enumerate().map(row).collect()
    }
}

/// A text of a document; empty where there is none.
pub(crate) fn text(value: &Json) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// A document with a heading.
pub(crate) fn headed<T: DeserializeOwned>(document: Json) -> Why<T> {
    serde_json::from_value(document).map_err(|_| "has no `title`".to_owned())
}
