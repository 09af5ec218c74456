//! Files of rows: a header and comma-separated fields, each with its place.
//!
//! Blank lines and lines that begin with `#` are skipped, a field may stand in double quotes, and line
//! ends and a byte order mark of any system are understood.

use std::ops::Range;
use std::path::Path;

use crate::error::{Error, Result};
use crate::model;
use crate::place::Source;
use crate::spec::names::unknown;

/// One field: its text without surrounding blanks and quotes, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) text: String,
    pub(super) span: Range<usize>,
}

/// A file of rows, every row as long as the header.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) source: Source,
    pub(super) header: Vec<Field>,
    pub(super) body: Vec<Vec<Field>>,
}

impl Rows {
    /// Reads the file `name` (relative to `base_dir`), which stands at `span` of `sweep`.
    pub(super) fn read(
        sweep: &Source,
        span: Range<usize>,
        role: &'static str,
        name: &str,
        base_dir: &Path,
    ) -> Result<Rows> {
        let path = base_dir.join(name);
        match std::fs::read_to_string(&path) {
            Ok(text) => Rows::parse(Source::new(path.display().to_string(), &text)),
            Err(why) => Err(Error::ReadNamed { at: sweep.place(span), role, path, why: why.to_string() }),
        }
    }

    /// Splits a text into header and rows.
    pub(super) fn parse(source: Source) -> Result<Rows> {
        let mut header: Option<Vec<Field>> = None;
        let mut body = Vec::new();
        let mut start = 0;
        for line in source.text.split_inclusive('\n') {
            let end = start + line.trim_end().len();
            let content = line.trim();
            if !content.is_empty() && !content.starts_with('#') {
                let fields = split(&source, start..end.max(start))?;
                match &header {
                    None => header = Some(fields),
                    Some(header) if header.len() == fields.len() => body.push(fields),
                    Some(header) => {
                        let (fields, columns) = (fields.len(), header.len());
                        return Err(Error::RaggedRow { at: source.place(start..end), fields, columns });
                    }
                }
            }
            start += line.len();
        }
        match header {
            Some(header) if !body.is_empty() => Ok(Rows { source, header, body }),
            Some(header) => {
                let span = header.first().map_or(0, |field| field.span.start)
                    ..header.last().map_or(0, |field| field.span.end);
                Err(Error::NoRows { at: source.place(span) })
            }
            None => {
                let at = source.place(0..0);
                Err(Error::Empty { at, what: "the file".to_owned(), least: "a header and one row" })
            }
        }
    }

    /// Turns every column name into what it stands for; refuses unknown and repeated names.
    pub(super) fn columns<T: PartialEq>(
        &self,
        names: &[&str],
        parse: impl Fn(&str) -> Option<T>,
    ) -> Result<Vec<T>> {
        let mut columns: Vec<T> = Vec::new();
        for field in &self.header {
            let within = "in the header";
            let Some(column) = parse(&field.text) else {
                return Err(unknown(&self.source, field.span.clone(), "column", &field.text, within, names));
            };
            if columns.contains(&column) {
                return Err(Error::Conflict {
                    at: self.source.place(field.span.clone()),
                    key: format!("column `{}`", field.text),
                    other: "a column of the same name".to_owned(),
                });
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// The number in a field of the column `name`.
    pub(super) fn number(&self, field: &Field, name: &str, range: model::Range) -> Result<f64> {
        let at = || self.source.place(field.span.clone());
        let key = || format!("column `{name}`");
        let Ok(value) = field.text.parse::<f64>() else {
            let found =
                if field.text.is_empty() { "an empty cell".to_owned() } else { format!("`{}`", field.text) };
            return Err(Error::WrongType { at: at(), key: key(), expected: "a number".to_owned(), found });
        };
        if range.contains(value) {
            Ok(value)
        } else {
            Err(Error::OutOfRange {
                at: at(),
                key: key(),
                value: field.text.clone(),
                limit: range.to_string(),
            })
        }
    }

    /// Refuses a column that does not rise strictly from row to row.
    pub(super) fn rising(&self, name: &'static str, column: usize, values: &[f64]) -> Result<()> {
        for (row, pair) in values.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let at = self.source.place(self.body[row + 1][column].span.clone());
                return Err(Error::NotRising { at, column: name, value: pair[1], previous: pair[0] });
            }
        }
        Ok(())
    }
}

/// Splits one line into fields.
fn split(source: &Source, line: Range<usize>) -> Result<Vec<Field>> {
    let text = source.written(line.clone());
    let mut fields = Vec::new();
    let mut start = 0;
    let mut quoted = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => {
                fields.push(field(text, start..at, line.start));
                start = at + 1;
            }
            _ => {}
        }
    }
    if quoted {
        let why = "a double quote is opened but not closed in this row; close it".to_owned();
        return Err(Error::Syntax { at: source.place(line.start + start..line.end), why });
    }
    fields.push(field(text, start..text.len(), line.start));
    Ok(fields)
}

/// The field in `range` of `line`, which begins at `offset` of the file.
fn field(line: &str, range: Range<usize>, offset: usize) -> Field {
    let raw = &line[range.clone()];
    let text = raw.trim();
    let start = offset + range.start + (raw.len() - raw.trim_start().len());
    let span = start..start + text.len();
    let bare = text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    Field { text: bare.map_or_else(|| text.to_owned(), |inner| inner.replace("\"\"", "\"")), span }
}
