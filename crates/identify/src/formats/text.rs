//! CSV → rows, one at a time: the memory needed does not depend on the length of the file.

use std::borrow::Cow;
use std::cell::Cell;
use std::io::{Cursor, Read};
use std::rc::Rc;

use csv::ByteRecord;
use squealmap_input::files::decoded;
use squealmap_input::quote::quoted;

use super::preamble::{SEPARATORS, commented, is_number};
use super::source::Source;
use crate::fault::Fault;
use crate::place::Place;

/// Bytes read at a time.
pub(super) const BUFFER: usize = 1 << 18;
/// Bytes that a row may take: without a line feed, or within double quotes that are not closed, a row is the rest of the file.
const LONGEST_ROW: usize = 1 << 20;

/// A CSV file that is being read.
pub(super) struct Text {
    reader: csv::Reader<Bounded>,
    /// Bytes read since the last whole row.
    since: Rc<Cell<usize>>,
    record: ByteRecord,
    header: Vec<String>,
    /// What separates the fields.
    separator: u8,
    /// Whether a carriage return comes before the line feeds: a row ends with it.
    by_returns: bool,
    marks: Marks,
    /// The units of the columns, where the row below the header has them; empty where it has not.
    units: Vec<String>,
    /// Whether the row at hand is still to be gone to.
    waits: bool,
    /// Whether the file ended within its last row, which was then left out.
    cut_off: Rc<Cell<bool>>,
    left_out: bool,
    /// Lines before the header.
    before: usize,
}

/// The marks before the decimals that the file has shown so far.
#[derive(Clone, Copy, Debug, Default)]
struct Marks {
    point: bool,
    comma: bool,
}

impl Text {
    /// Reads the header of a file that begins with `start` and goes on with `rest`.
    pub(super) fn open(mut start: Vec<u8>, rest: Box<dyn Read>) -> Result<Text, Fault> {
        let before = commented(&mut start);
        let since = Rc::new(Cell::new(0));
        let separator = separator(&start);
        let by_returns = start.windows(2).any(|two| two == b"\r\n");
        let end = if by_returns { b'\r' } else { b'\n' };
        let input = Box::new(Cursor::new(start).chain(rest));
        let cut_off = Rc::new(Cell::new(false));
        let input =
            Bounded { input, since: Rc::clone(&since), cut_off: Rc::clone(&cut_off), last: b'\n', end };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
            .comment(Some(b'#'))
            .trim(csv::Trim::Headers)
            .flexible(true)
            .buffer_capacity(BUFFER)
            .from_reader(input);
        let headers = reader.byte_headers().map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        // A header in Latin-1 has the names that its program wrote, as `°C`.
        let header: Vec<String> = headers
            .iter()
            .map(|name| decoded(name.to_vec()).trim().trim_start_matches('\u{feff}').to_owned())
            .collect();
        if header.iter().all(String::is_empty) {
            return Err(Fault::Unreadable { why: "it holds no header".to_owned() });
        }
        since.set(0);
        let (record, marks, units) = (ByteRecord::new(), Marks::default(), Vec::new());
        let (waits, left_out) = (false, false);
        let mut text = Text {
            reader,
            since,
            record,
            header,
            separator,
            by_returns,
            marks,
            units,
            waits,
            cut_off,
            left_out,
            before,
        };
        text.waits = text.read()?;
        if text.waits && text.is_units() {
            text.units = text.record.iter().map(|unit| decoded(unit.to_vec()).trim().to_owned()).collect();
            text.waits = false;
        }
        Ok(text)
    }

    /// Reads the next row as it is; whether there is one.
    fn read(&mut self) -> Result<bool, Fault> {
        let more = self.reader.read_byte_record(&mut self.record);
        let more = more.map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        self.since.set(0);
        Ok(more)
    }

    /// Whether the row has text, and in no field a number: the units of the columns.
    fn is_units(&self) -> bool {
        let fields = || self.record.iter().map(<[u8]>::trim_ascii);
        fields().any(|field| !field.is_empty()) && !fields().any(is_number)
    }

    /// Whether the file ends within this row: the program that wrote it was stopped.
    fn is_cut_off(&self) -> bool {
        let last = self.record.iter().next_back().unwrap_or_default().trim_ascii();
        self.cut_off.get() && (self.record.len() < self.header.len() || last.is_empty())
    }

    /// The line of the row. That of its own position is the one behind the row before, and may be empty or a comment.
    fn line(&self) -> u64 {
        self.reader.position().line() - u64::from(!self.by_returns)
    }
}

impl Source for Text {
    fn header(&self) -> &[String] {
        &self.header
    }

    fn advance(&mut self) -> Result<bool, Fault> {
        if std::mem::take(&mut self.waits) {
            return Ok(true);
        }
        if !self.read()? {
            return Ok(false);
        }
        self.left_out = self.is_cut_off();
        Ok(!self.left_out)
    }

    fn unit(&self, column: usize) -> Option<&str> {
        self.units.get(column).map(String::as_str)
    }

    fn is_blank(&self, column: usize) -> bool {
        self.record.get(column).is_some_and(|field| field.trim_ascii().is_empty())
    }

    fn remark(&self) -> Option<String> {
        let mut said = Vec::new();
        if self.before > 0 {
            said.push(format!("{} line(s) before the header are passed over", self.before));
        }
        if self.left_out {
            said.push("the last line of the file is cut off and left out".to_owned());
        }
        (!said.is_empty()).then(|| said.join("; "))
    }

    fn whole(&self) -> Result<(), Fault> {
        let (fields, columns) = (self.record.len(), self.header.len());
        if fields == columns {
            return Ok(());
        }
        // `0,5,1,25` under `t,a`.
        let because = if self.separator == b',' && fields > columns {
            "; where these are decimal commas, separate the fields with semicolons or tabs"
        } else {
            ""
        };
        Err(Fault::Ragged { line: self.line(), fields, columns, because })
    }

    /// A finite number with a point or a comma before its decimals; one file has one of the two.
    fn number(&mut self, column: usize) -> Result<f64, Fault> {
        // Trimmed here: the reader would copy every row for that.
        let field = self.record[column].trim_ascii();
        // A file with decimal points shows nothing new with one more number of that kind.
        if self.marks.point
            && let Some(value) = finite(field)
        {
            return Ok(value);
        }
        // The first of them: a number with both is none. Commas that separate fields are none of a field.
        let mark = field.iter().position(|byte| matches!(byte, b',' | b'.'));
        let comma = mark.filter(|at| field[*at] == b',');
        let pointed = comma.map_or(Cow::Borrowed(field), |at| {
            let mut pointed = field.to_vec();
            pointed[at] = b'.';
            Cow::Owned(pointed)
        });
        let (name, text) = (|| quoted(&self.header[column]), || quoted(&String::from_utf8_lossy(field)));
        let Some(value) = finite(&pointed) else {
            return Err(Fault::NotANumber { line: self.line(), column: name(), text: text() });
        };
        self.marks.comma |= comma.is_some();
        self.marks.point |= comma.is_none() && mark.is_some();
        if self.marks.comma && self.marks.point {
            return Err(Fault::TwoMarks { line: self.line(), column: name(), text: text() });
        }
        Ok(value)
    }

    fn place(&self) -> Place {
        Place::Line(self.line())
    }
}

fn finite(field: &[u8]) -> Option<f64> {
    fast_float2::parse(field).ok().filter(|value: &f64| value.is_finite())
}

/// The separator that the first line that is no comment holds most of.
fn separator(start: &[u8]) -> u8 {
    let mut lines = start.split(|byte| *byte == b'\n');
    let header = lines.find(|line| !line.is_empty() && line[0] != b'#').unwrap_or_default();
    let count = |separator: &u8| header.split(|byte| byte == separator).count();
    // Of equal counts the first separator of the list is the last of the reversed one.
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}

/// A reader that gives up where a row has no end.
struct Bounded {
    input: Box<dyn Read>,
    since: Rc<Cell<usize>>,
    /// Whether the file has ended without the end of a row.
    cut_off: Rc<Cell<bool>>,
    /// The last byte.
    last: u8,
    /// What ends the last row, where the file does not.
    end: u8,
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        // What was read ahead of a row counts as well.
        if self.since.get() > LONGEST_ROW + BUFFER {
            return Err(std::io::Error::other(format!(
                "a row is longer than {LONGEST_ROW} bytes: is a double quote not closed, or is this no table of signals?"
            )));
        }
        let mut read = self.input.read(buffer)?;
        if let Some(last) = buffer[..read].last() {
            self.last = *last;
        } else if self.last != b'\n' && !buffer.is_empty() {
            (buffer[0], read, self.last) = (self.end, 1, b'\n');
            self.cut_off.set(true);
        }
        self.since.set(self.since.get() + read);
        Ok(read)
    }
}
