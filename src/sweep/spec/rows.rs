//! Files of rows: a header and fields, each with its place.
//!
//! Fields are separated by commas or, where the header has none, by semicolons or tabs; a comma then stands before decimals. A
//! row of units below the header of numbers is passed over. Blank lines and lines that begin with `#` are skipped, a field may stand in double quotes, and line
//! ends and a byte order mark of any system are understood.

use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;

use crate::model;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::names::{LONGEST_NAME, nearest, unknown};
use crate::sweep::spec::{MAX_ROWS, MAX_TABLE_ROWS};
use squealmap_input::files;
use squealmap_input::files::MIB;
use squealmap_input::place::Source;
use squealmap_input::quote::{is_obeyed, list, quoted};

/// What a file of rows is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Points,
    Table,
    Material,
    Motion,
}

impl Role {
    fn name(self) -> &'static str {
        match self {
            Role::Points => "points",
            Role::Table => "table",
            Role::Material => "material",
            Role::Motion => "motion",
        }
    }

    /// The most bytes that are read.
    fn most_bytes(self) -> u64 {
        match self {
            Role::Points => 1024 * MIB,
            Role::Table | Role::Material | Role::Motion => 16 * MIB,
        }
    }

    /// The most rows there may be.
    fn most_rows(self) -> usize {
        match self {
            Role::Points => MAX_ROWS,
            Role::Table | Role::Material | Role::Motion => MAX_TABLE_ROWS,
        }
    }
}

/// One field: its text without surrounding blanks and quotes, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Field<'a> {
    pub(super) text: Cow<'a, str>,
    pub(super) span: Range<usize>,
}

/// A file of rows, every row as long as the header. Only its text is held; fields are found again when they are asked for.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) source: Source,
    /// The header, its names without quotes.
    pub(super) header: Vec<Field<'static>>,
    /// The separator of the fields.
    separator: u8,
    /// Where the first row begins.
    body: usize,
    count: usize,
}

impl Rows {
    /// Reads the file `name` (relative to `base_dir`), which stands at `span` of `sweep`. Where its header has no name like
    /// those of `columns`, it is some other file, and the error tells no more of it than its first name.
    pub(super) fn read(
        sweep: &Source,
        span: Range<usize>,
        role: Role,
        columns: &[&str],
        name: &str,
        base_dir: &Path,
    ) -> Result<Rows> {
        let path = base_dir.join(name);
        let text = match files::table(&path, role.most_bytes()) {
            Ok(text) => text,
            Err(why) => return Err(Error::ReadNamed { at: sweep.place(span), role: role.name(), path, why }),
        };
        // It becomes the name of a material, in figures and on terminals.
        if name.chars().any(is_obeyed) {
            let why = "its name holds a control character; rename the file".to_owned();
            return Err(Error::ReadNamed { at: sweep.place(span), role: role.name(), path, why });
        }
        let source = Source::new(path.display().to_string(), &text);
        if let Some(first) = stranger(&source, columns) {
            let why = format!(
                "its header begins with `{first}` and names none of its columns; give a CSV file with columns of {}",
                list(columns)
            );
            return Err(Error::ReadNamed { at: sweep.place(span), role: role.name(), path, why });
        }
        let mut rows = Rows::parse(source)?;
        // Points may have columns of names alone.
        if role != Role::Points {
            rows.pass_over_units();
        }
        if rows.count > role.most_rows() {
            let (count, most) = (rows.count, role.most_rows());
            let why = format!("it has {count} rows but at most {most} are allowed; take fewer");
            return Err(Error::ReadNamed { at: sweep.place(span), role: role.name(), path, why });
        }
        Ok(rows)
    }

    /// Says that a column is missing; `what` has such a one.
    pub(super) fn no_column(&self, key: &'static str, what: &str) -> Error {
        let start = self.header.first().map_or(0, |field| field.span.start);
        let end = self.header.last().map_or(0, |field| field.span.end);
        Error::Missing {
            at: self.source.place(start..end),
            key,
            needed_by: format!("{what} has such a column"),
            remedy: "add it to the header and to every row".to_owned(),
        }
    }

    /// The rows of a text that was made of numbers given in code by the call `name`.
    pub(super) fn given(name: &str, text: &str, role: Role) -> Result<Rows> {
        let rows = Rows::parse(Source::new(name, text))?;
        if rows.count > role.most_rows() {
            return Err(Error::OutOfRange {
                at: rows.source.place(0..0),
                key: "the number of rows".to_owned(),
                value: rows.count.to_string(),
                limit: format!("at most {}", role.most_rows()),
            });
        }
        Ok(rows)
    }

    /// Finds header and rows of a text.
    pub(super) fn parse(source: Source) -> Result<Rows> {
        let separator = separator(&source);
        let mut lines = Lines { text: &source.text, start: 0 };
        let Some(line) = lines.next() else {
            let at = source.place(0..0);
            return Err(Error::Empty { at, what: "the file".to_owned(), least: "a header and one row" });
        };
        let mut fields = Vec::new();
        split(&source, line, separator, &mut fields)?;
        let header: Vec<Field<'static>> = fields
            .iter()
            .map(|field| Field { text: field.text.clone().into_owned().into(), span: field.span.clone() })
            .collect();
        let body = lines.start;
        let mut count = 0;
        for line in lines {
            split(&source, line.clone(), separator, &mut fields)?;
            if fields.len() != header.len() {
                let (fields, columns) = (fields.len(), header.len());
                // `100,0,5` under `temperature,mu_d`.
                let because = if separator == b',' && fields > columns {
                    "; where these are decimal commas, separate the fields with semicolons"
                } else {
                    ""
                };
                return Err(Error::RaggedRow { at: source.place(line), fields, columns, because });
            }
            count += 1;
        }
        if count == 0 {
            let span = header.first().map_or(0, |field| field.span.start)
                ..header.last().map_or(0, |field| field.span.end);
            return Err(Error::NoRows { at: source.place(span) });
        }
        drop(fields);
        Ok(Rows { source, header, separator, body, count })
    }

    /// Leaves out a first row without any number, where others follow it: the units of the columns.
    fn pass_over_units(&mut self) {
        let mut lines = Lines { text: &self.source.text, start: self.body };
        let mut fields = Vec::new();
        let Some(line) = lines.next().filter(|_| self.count > 1) else { return };
        let is_units = split(&self.source, line, self.separator, &mut fields).is_ok()
            && fields.iter().any(|field| !field.text.is_empty())
            && fields.iter().all(|field| field.text.replacen(',', ".", 1).parse::<f64>().is_err());
        let body = lines.start;
        drop(fields);
        if is_units {
            (self.body, self.count) = (body, self.count - 1);
        }
    }

    /// The number of rows.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Gives the number and the fields of every row to `take`.
    pub(super) fn each(&self, mut take: impl FnMut(usize, &[Field]) -> Result<()>) -> Result<()> {
        let mut fields = Vec::with_capacity(self.header.len());
        for (number, line) in (Lines { text: &self.source.text, start: self.body }).enumerate() {
            split(&self.source, line, self.separator, &mut fields)?;
            take(number, &fields)?;
        }
        Ok(())
    }

    /// Where the field in some row and column stands.
    pub(super) fn span(&self, row: usize, column: usize) -> Range<usize> {
        let line = Lines { text: &self.source.text, start: self.body }.nth(row).unwrap_or(0..0);
        let mut fields = Vec::new();
        match split(&self.source, line.clone(), self.separator, &mut fields) {
            Ok(()) => fields.get(column).map_or(line, |field| field.span.clone()),
            Err(_) => line,
        }
    }

    /// The numbers of a column.
    pub(super) fn numbers(&self, column: usize, name: &str, range: model::Range) -> Result<Vec<f64>> {
        let mut numbers = Vec::with_capacity(self.count);
        self.each(|_, fields| {
            numbers.push(self.number(&fields[column], name, range)?);
            Ok(())
        })?;
        Ok(numbers)
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
                    key: format!("column `{}`", quoted(&field.text)),
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
        let decimals = if self.separator == b',' { None } else { Some(field.text.replacen(',', ".", 1)) };
        let Ok(value) = decimals.as_deref().unwrap_or(&field.text).parse::<f64>() else {
            let found = if field.text.is_empty() {
                "an empty cell".to_owned()
            } else {
                format!("`{}`", quoted(&field.text))
            };
            return Err(Error::WrongType { at: at(), key: key(), expected: "a number".to_owned(), found });
        };
        if range.contains(value) {
            Ok(value)
        } else {
            Err(Error::OutOfRange {
                at: at(),
                key: key(),
                value: quoted(&field.text),
                limit: range.to_string(),
            })
        }
    }

    /// Refuses a column that does not rise strictly from row to row.
    pub(super) fn rising(&self, name: &'static str, column: usize, values: &[f64]) -> Result<()> {
        for (row, pair) in values.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let at = self.source.place(self.span(row + 1, column));
                return Err(Error::NotRising { at, column: name, value: pair[1], previous: pair[0] });
            }
        }
        Ok(())
    }
}

/// The first name of a header of several words in which nothing is like a column: that of another kind of file.
fn stranger(source: &Source, columns: &[&str]) -> Option<String> {
    let line = Lines { text: &source.text, start: 0 }.next()?;
    let mut fields = Vec::new();
    split(source, line, separator(source), &mut fields).ok()?;
    let is_word = |text: &str| text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | ' '));
    let foreign = fields.iter().all(|field| nearest(&field.text, columns).is_none())
        && !fields.iter().all(|field| is_word(&field.text) && field.text.len() <= LONGEST_NAME);
    foreign.then(|| quoted(&fields[0].text))
}

/// The separator of the fields: a comma where the header has one, or else a semicolon or a tab.
fn separator(source: &Source) -> u8 {
    let header = Lines { text: &source.text, start: 0 }.next().unwrap_or(0..0);
    let header = source.written(header);
    [b',', b';', b'\t'].into_iter().find(|byte| header.as_bytes().contains(byte)).unwrap_or(b',')
}

/// The lines of a text that hold something, without blanks at their ends: neither blank nor a comment.
struct Lines<'a> {
    text: &'a str,
    start: usize,
}

impl Iterator for Lines<'_> {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Range<usize>> {
        while self.start < self.text.len() {
            let rest = &self.text[self.start..];
            let line = rest.find('\n').map_or(rest, |end| &rest[..=end]);
            let start = self.start;
            self.start += line.len();
            let content = line.trim();
            if !content.is_empty() && !content.starts_with('#') {
                return Some(start..start + line.trim_end().len());
            }
        }
        None
    }
}

/// Splits one line into fields.
fn split<'a>(
    source: &'a Source,
    line: Range<usize>,
    separator: u8,
    fields: &mut Vec<Field<'a>>,
) -> Result<()> {
    let text = source.written(line.clone());
    fields.clear();
    let mut start = 0;
    let mut in_quotes = false;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'"' => in_quotes = !in_quotes,
            byte if byte == separator && !in_quotes => {
                fields.push(field(text, start..at, line.start));
                start = at + 1;
            }
            _ => {}
        }
    }
    if in_quotes {
        let why = "a double quote is opened but not closed in this row; close it".to_owned();
        return Err(Error::Syntax { at: source.place(line.start + start..line.end), why });
    }
    fields.push(field(text, start..text.len(), line.start));
    Ok(())
}

/// The field in `range` of `line`, which begins at `offset` of the file.
fn field(line: &str, range: Range<usize>, offset: usize) -> Field<'_> {
    let raw = &line[range.clone()];
    let text = raw.trim();
    let start = offset + range.start + (raw.len() - raw.trim_start().len());
    let span = start..start + text.len();
    let bare = text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    let text = match bare {
        Some(inner) if inner.contains('"') => inner.replace("\"\"", "\"").into(),
        Some(inner) => inner.into(),
        None => text.into(),
    };
    Field { text, span }
}
