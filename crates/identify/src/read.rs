//! CSV → samples, one row at a time: the memory needed does not depend on the length of the file.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Read};
use std::rc::Rc;

use csv::ByteRecord;

use crate::channel::{Channel, PerChannel};
use crate::fault::Fault;
use crate::settings::Settings;
use crate::unit::{TimeUnit, is_time, named};
use squealmap_input::files::decoded;
use squealmap_input::quote::{clipped, quoted};

/// Bytes read at a time.
const BUFFER: usize = 1 << 18;
/// Bytes that a row may take: without a line feed, or within double quotes that are not closed, a row is the rest of the file.
const LONGEST_ROW: usize = 1 << 20;
/// The separators that are told apart by the header.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];
/// The column of time when none is named.
const TIME: &str = "t";

/// One row: time (s) where the file has it, and the channels (0 where the file has none).
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) line: u64,
    pub(super) time: Option<f64>,
    pub(super) values: PerChannel<f64>,
}

/// A file of signals that is being read.
pub(super) struct Table {
    reader: csv::Reader<Box<dyn BufRead>>,
    /// Bytes read since the last whole row.
    since: Rc<Cell<usize>>,
    record: ByteRecord,
    header: Vec<String>,
    time: Option<usize>,
    /// The unit of time that was said outright, and that of the header.
    units: [Option<TimeUnit>; 2],
    /// Whether the column of time gives the rate; else it may contradict the one given.
    believed: bool,
    /// Whether a row was read.
    begun: bool,
    /// Whether a comma is what separates the fields.
    by_commas: bool,
    marks: Marks,
    columns: PerChannel<Option<usize>>,
    /// Rows to pass over, and rows to read after them.
    skipped: u64,
    left: u64,
    /// Sign of what points along the contact: −1 for a stroke that goes the other way.
    sign: f64,
}

/// The marks before the decimals that the file has shown so far.
#[derive(Clone, Copy, Debug, Default)]
struct Marks {
    point: bool,
    comma: bool,
}

impl Table {
    /// Reads the header and finds the columns of signals: time, or a rate, and at least the tangential acceleration.
    pub(super) fn open(input: Box<dyn Read>, settings: &Settings) -> Result<Table, Fault> {
        Table::open_with(input, settings, &[Channel::TangentialAcceleration], true)
    }

    /// Reads the header and finds the columns; those of `needed` have to be there, and time if it is `timed`.
    pub(super) fn open_with(
        input: Box<dyn Read>,
        settings: &Settings,
        needed: &[Channel],
        timed: bool,
    ) -> Result<Table, Fault> {
        let since = Rc::new(Cell::new(0));
        let input = Bounded { input, since: Rc::clone(&since) };
        let mut input: Box<dyn BufRead> = Box::new(BufReader::with_capacity(BUFFER, input));
        let start = input.fill_buf().map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        let separator = separator(start);
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .from_reader(input);
        let headers = reader.byte_headers().map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        // A header in Latin-1 has the names that its program wrote, as `°C`.
        let header: Vec<String> = headers
            .iter()
            .map(|name| decoded(name.to_vec()).trim().trim_start_matches('\u{feff}').to_owned())
            .collect();
        let mut columns = PerChannel::default();
        for (channel, column) in Channel::ALL.into_iter().zip(&mut columns) {
            let named = settings.columns[channel as usize].as_deref();
            let found = find(&header, named.unwrap_or(channel.default_column()));
            // What is named has to be there, too.
            if found.is_none() && (named.is_some() || needed.contains(&channel)) {
                return Err(Fault::NoColumn {
                    words: channel.words(),
                    name: quoted(named.unwrap_or(channel.default_column())),
                    header: listed(&header),
                    flag: channel.flag(),
                });
            }
            if let Some(found) = found {
                once(&header, &header[found], channel.words(), channel.flag())?;
            }
            *column = found;
        }
        shared(&header, &columns)?;
        let time = match &settings.time {
            Some(name) => find(&header, name),
            None => find(&header, TIME).or_else(|| header.iter().position(|name| is_time(name))),
        };
        if timed && time.is_none() && (settings.rate.is_none() || settings.time.is_some()) {
            return Err(Fault::NoColumn {
                words: "time",
                name: settings.time.clone().unwrap_or(TIME.to_owned()),
                header: listed(&header),
                flag: "--time, or give the sampling rate with --rate",
            });
        }
        let time = time.filter(|_| timed);
        let believed = settings.rate.is_none();
        if let Some(found) = time.filter(|_| believed) {
            once(&header, &header[found], "time", "--time")?;
        }
        let units = [settings.time_unit, time.and_then(|found| named(&header[found]).1)];
        let by_commas = separator == b',';
        let (record, marks) = (ByteRecord::new(), Marks::default());
        since.set(0);
        Ok(Table {
            reader,
            since,
            record,
            header,
            time,
            units,
            believed,
            begun: false,
            by_commas,
            marks,
            columns,
            skipped: settings.rows.map_or(0, |[before, _]| before),
            left: settings.rows.map_or(u64::MAX, |[_, rows]| rows),
            sign: 1.0,
        })
    }

    /// This table with the signs along the contact turned: those of a stroke that goes the other way.
    pub(super) fn turned(self, turned: bool) -> Table {
        Table { sign: if turned { -1.0 } else { 1.0 }, ..self }
    }

    /// The next row; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Row>, Fault> {
        let is_first = self.record.is_empty();
        if !self.read()? {
            return Ok(None);
        }
        if is_first && self.is_units() && !self.read()? {
            return Ok(None);
        }
        while self.skipped > 0 {
            self.skipped -= 1;
            if !self.read()? {
                return Ok(None);
            }
        }
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        let line = self.record.position().map_or(0, csv::Position::line);
        if self.record.len() != self.header.len() {
            let (fields, columns) = (self.record.len(), self.header.len());
            // `0,5,1,25` under `t,a`.
            let because = if self.by_commas && fields > columns {
                "; where these are decimal commas, separate the fields with semicolons or tabs"
            } else {
                ""
            };
            return Err(Fault::Ragged { line, fields, columns, because });
        }
        let mut values = PerChannel::default();
        for (value, column) in values.iter_mut().zip(self.columns) {
            if let Some(column) = column {
                *value = self.number(column, line)?;
            }
        }
        for channel in [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::Velocity] {
            values[channel as usize] *= self.sign;
        }
        let unit = self.time_unit().unwrap_or(TimeUnit::Second).seconds();
        let time = self.time.map(|column| self.number(column, line).map(|time| time * unit));
        // Beside a given rate any text may stand for the time.
        let time = if self.believed {
            time.transpose().map_err(|fault| if self.begun { fault } else { no_time(fault) })?
        } else {
            time.and_then(Result::ok)
        };
        self.begun = true;
        Ok(Some(Row { line, time, values }))
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
        let is_number =
            |field: &[u8]| String::from_utf8_lossy(field).replacen(',', ".", 1).parse::<f64>().is_ok();
        self.record.iter().any(|field| !field.is_empty()) && !self.record.iter().any(is_number)
    }

    /// A finite number with a point or a comma before its decimals; one file has one of the two.
    fn number(&mut self, column: usize, line: u64) -> Result<f64, Fault> {
        let field = &self.record[column];
        let text = std::str::from_utf8(field).unwrap_or_default();
        // Commas that separate fields are none of a field.
        let comma = text.contains(',');
        let value = if comma { text.replacen(',', ".", 1).parse() } else { text.parse::<f64>() };
        let name = || quoted(&self.header[column]);
        let Some(value) = value.ok().filter(|value| value.is_finite()) else {
            let text = quoted(&String::from_utf8_lossy(field));
            return Err(Fault::NotANumber { line, column: name(), text });
        };
        self.marks.comma |= comma;
        self.marks.point |= !comma && text.contains('.');
        if self.marks.comma && self.marks.point {
            return Err(Fault::TwoMarks { line, column: name(), text: quoted(text) });
        }
        Ok(value)
    }

    /// Whether the file has the channel.
    pub(super) fn has(&self, channel: Channel) -> bool {
        self.columns[channel as usize].is_some()
    }

    /// The column of a channel, empty when the file has none.
    pub(super) fn name(&self, channel: Channel) -> String {
        self.columns[channel as usize].map(|column| quoted(&self.header[column])).unwrap_or_default()
    }

    /// The unit of the column of time, where it is known.
    pub(super) fn time_unit(&self) -> Option<TimeUnit> {
        self.units[0].or(self.units[1])
    }

    /// A sentence about the unit of time, where it is not the second or not the one of the header.
    pub(super) fn remark_on_unit(&self) -> Option<String> {
        let (name, unit) = (self.time.map(|_| self.time_name())?, self.time_unit()?);
        match self.units {
            [Some(said), Some(header)] if said != header => Some(format!(
                "column `{name}` is read as --time-unit {} says, not as its header does",
                said.name()
            )),
            _ => (unit != TimeUnit::Second).then(|| format!("column `{name}` is read in {}", unit.name())),
        }
    }

    /// The column of time.
    pub(super) fn time_name(&self) -> String {
        self.time.map(|column| quoted(&self.header[column])).unwrap_or_default()
    }
}

/// The fault of a column of time that holds no numbers from its first row on, such as times of day.
fn no_time(fault: Fault) -> Fault {
    match fault {
        Fault::NotANumber { line, column, text } => Fault::NotATime { line, column, text },
        fault => fault,
    }
}

/// The separator that the first line that is no comment holds most of.
fn separator(start: &[u8]) -> u8 {
    let mut lines = start.split(|byte| *byte == b'\n');
    let header = lines.find(|line| !line.is_empty() && line[0] != b'#').unwrap_or_default();
    let count = |separator: &u8| header.split(|byte| byte == separator).count();
    // Of equal counts the first separator of the list is the last of the reversed one.
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}

fn find(header: &[String], name: &str) -> Option<usize> {
    header.iter().position(|column| column == name)
}

/// Refuses a column whose name stands more than once in the header.
fn once(header: &[String], name: &str, words: &'static str, flag: &'static str) -> Result<(), Fault> {
    let count = header.iter().filter(|column| *column == name).count();
    if count > 1 { Err(Fault::Ambiguous { words, name: quoted(name), count, flag }) } else { Ok(()) }
}

/// The most characters that are said of a header.
const LISTED: usize = 400;

fn listed(header: &[String]) -> String {
    let names: Vec<String> = header.iter().take(LISTED).map(|name| format!("`{}`", quoted(name))).collect();
    clipped(&names.join(", "), LISTED)
}

/// A reader that gives up where a row has no end.
struct Bounded {
    input: Box<dyn Read>,
    since: Rc<Cell<usize>>,
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        // What was read ahead of a row counts as well.
        if self.since.get() > LONGEST_ROW + BUFFER {
            return Err(std::io::Error::other(format!(
                "a row is longer than {LONGEST_ROW} bytes: is a double quote not closed, or is this no table of signals?"
            )));
        }
        let read = self.input.read(buffer)?;
        self.since.set(self.since.get() + read);
        Ok(read)
    }
}

/// Refuses a column that is named for two quantities.
fn shared(header: &[String], columns: &PerChannel<Option<usize>>) -> Result<(), Fault> {
    for (second, column) in Channel::ALL.into_iter().zip(columns) {
        let Some(column) = column else { continue };
        let first = Channel::ALL.into_iter().zip(columns).find(|(_, other)| **other == Some(*column));
        if let Some((first, _)) = first.filter(|(first, _)| *first != second) {
            return Err(Fault::SharedColumn {
                name: quoted(&header[*column]),
                first: first.words(),
                second: second.words(),
                flag: second.flag(),
            });
        }
    }
    Ok(())
}
