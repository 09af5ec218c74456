//! Universal files: the time responses of dataset 58, in ASCII or binary (58b), each a column.

use std::collections::HashSet;
use std::io::{BufRead, Read};

use squealmap_input::files::decoded;

use super::held::Column;
use super::numbers::{Number, Room, cut_off, read, skip};
use super::source::Clock;
use crate::unit::TimeUnit;

/// The line before and after every dataset.
pub(super) const DELIMITER: &[u8] = b"-1";
/// Bytes that are read of a line.
const LONGEST: u64 = 1 << 12;
/// Lines with names, and those after them.
const NAMES: usize = 5;
const OTHERS: usize = 6;
/// Where the line of an axis has its unit.
const UNIT: std::ops::Range<usize> = 47..67;
/// Functions: a time response, and one that is not said to be any.
const TIME_RESPONSE: u32 = 1;
const GENERAL: u32 = 0;
/// The abscissa of a time response.
const TIME: u32 = 17;
/// Directions from 1 on; those of the opposite sense are negative.
const DIRECTIONS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// A dataset 58 without its values.
struct Record {
    names: [String; NAMES],
    point: String,
    /// Whether it is a response over time.
    over_time: bool,
    /// How the values are stored, and how many there are.
    stored: u32,
    count: u64,
    even: bool,
    clock: Option<Clock>,
    unit: String,
}

/// What the first line of a binary dataset says.
struct Binary {
    big: bool,
    ieee: bool,
    bytes: u64,
}

/// Reads a whole file.
pub(super) fn columns(input: &mut dyn BufRead) -> Result<Vec<Column>, String> {
    let (mut found, mut room) = (Vec::new(), Room::new());
    while let Some(first) = line(input)? {
        if first.trim_ascii() != DELIMITER {
            continue;
        }
        let Some(mut kind) = line(input)? else { break };
        // An end without a beginning, as of a dataset that was cut out.
        while kind.trim_ascii() == DELIMITER {
            kind = needed(input, "a dataset")?;
        }
        match kind.trim_ascii().strip_prefix(b"58") {
            Some(b"") => found.extend(ascii(input, &mut room)?),
            Some([b'b' | b'B', rest @ ..]) => found.extend(binary(input, rest, &mut room)?),
            _ => to_end(input, "a dataset")?,
        }
    }
    if found.is_empty() {
        return Err("has no time response (dataset 58, function 1)".to_owned());
    }
    let names = names(&found);
    let columns = found.into_iter().zip(names);
    Ok(columns.map(|((_, column), name)| Column { name, ..column }).collect())
}

/// The next line, or what is read of it.
fn line(input: &mut dyn BufRead) -> Result<Option<Vec<u8>>, String> {
    let mut line = Vec::new();
    Read::take(&mut *input, LONGEST).read_until(b'\n', &mut line).map_err(|why| cut_off(&why))?;
    let mut last = line.last().copied();
    while !matches!(last, None | Some(b'\n')) {
        let mut rest = Vec::new();
        Read::take(&mut *input, LONGEST).read_until(b'\n', &mut rest).map_err(|why| cut_off(&why))?;
        last = rest.last().copied();
    }
    Ok(Some(line).filter(|line| !line.is_empty()))
}

/// A line that has to be there.
fn needed(input: &mut dyn BufRead, what: &str) -> Result<Vec<u8>, String> {
    line(input)?.ok_or_else(|| format!("is cut off in {what}"))
}

/// Passes over the lines up to the end of a dataset.
fn to_end(input: &mut dyn BufRead, what: &str) -> Result<(), String> {
    while needed(input, what)?.trim_ascii() != DELIMITER {}
    Ok(())
}

/// Reads the lines before the values.
fn record(input: &mut dyn BufRead) -> Result<Record, String> {
    let mut names = [const { String::new() }; NAMES];
    for name in &mut names {
        decoded(needed(input, "the names of a record")?).trim().clone_into(name);
    }
    let mut lines = [const { Vec::new() }; OTHERS];
    for other in &mut lines {
        *other = needed(input, "the beginning of a record")?;
    }
    let [point, numbers, abscissa, ordinate, ..] = &lines;
    let whole = |line: &[u8], from, to| field(line, from, to).parse::<u32>();
    let broken = |what: &str| format!("has a record (`{}`) whose {what} is no number", names[0]);
    let function = whole(point, 0, 5).map_err(|_| broken("function"))?;
    let stored = whole(numbers, 0, 10).map_err(|_| broken("type of values"))?;
    let count = field(numbers, 10, 20).parse().map_err(|_| broken("number of values"))?;
    let spacing = whole(numbers, 20, 30).map_err(|_| broken("spacing"))?;
    let start = number(field(numbers, 30, 43)).ok_or_else(|| broken("first time"))?;
    let step = number(field(numbers, 43, 56)).ok_or_else(|| broken("step of time"))?;
    let unit = TimeUnit::parse(field(abscissa, UNIT.start, UNIT.end)).unwrap_or(TimeUnit::Second).seconds();
    let over_time = match function {
        TIME_RESPONSE => true,
        GENERAL => whole(abscissa, 0, 10) == Ok(TIME),
        _ => false,
    };
    let even = spacing == 1;
    let clock = Clock::of_step(step * unit, start * unit, 0.0);
    if over_time && even && clock.is_none() {
        return Err(format!("has a record (`{}`) with a step of time of {step} s", names[0]));
    }
    let direction = field(point, 51, 55).parse::<i32>().unwrap_or(0);
    let sign = if direction < 0 { '-' } else { '+' };
    let axis = (direction.unsigned_abs() as usize).checked_sub(1).and_then(|axis| DIRECTIONS.get(axis));
    Ok(Record {
        point: format!("{}:{sign}{}", field(point, 41, 51), axis.unwrap_or(&"S")),
        names,
        over_time,
        stored,
        count,
        even,
        clock: clock.filter(|_| even),
        unit: decoded(part(ordinate, UNIT.start, UNIT.end).to_vec()).trim().to_owned(),
    })
}

/// A field of a line of fixed columns.
fn field(line: &[u8], from: usize, to: usize) -> &str {
    std::str::from_utf8(part(line, from, to)).unwrap_or_default().trim()
}

/// The bytes of a field, as many as there are.
fn part(line: &[u8], from: usize, to: usize) -> &[u8] {
    line.get(from..to.min(line.len())).unwrap_or_default()
}

/// A number as Fortran writes it.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| text.replace(['D', 'd'], "E").parse().ok())
}

impl Record {
    /// How the values are stored, their width in columns, or why they are not read.
    fn values(&self) -> Result<(Number, usize), &'static str> {
        match (self.stored, self.even) {
            (2, true) => Ok((Number::F32, 13)),
            (4, true) => Ok((Number::F64, 20)),
            (_, false) => Err("is sampled at uneven times; export it evenly sampled"),
            _ => Err("holds complex numbers; export it as real numbers"),
        }
    }

    fn column(&self, values: Vec<f64>) -> Column {
        let refused = self.values().err();
        let unit = Some(self.unit.clone());
        Column { name: String::new(), values, clock: self.clock, unit, refused }
    }
}

/// Reads a record in ASCII; none where it is no time response.
fn ascii(input: &mut dyn BufRead, room: &mut Room) -> Result<Option<(Record, Column)>, String> {
    let record = record(input)?;
    let mut values = Vec::new();
    if let Some((_, width)) = record.values().ok().filter(|_| record.over_time) {
        room.take(record.count)?;
        let name = &record.names[0];
        while (values.len() as u64) < record.count {
            let line = needed(input, &format!("record `{name}`"))?;
            let text = line.trim_ascii_end();
            if text.trim_ascii() == DELIMITER || !numbers(text, width, &mut values) {
                let (count, number) = (record.count, values.len() + 1);
                return Err(format!(
                    "has no number {number} of the {count} that its record `{name}` says it has"
                ));
            }
        }
        let after = needed(input, &format!("record `{name}`"))?;
        if values.len() as u64 != record.count || after.trim_ascii() != DELIMITER {
            return Err(format!(
                "has more than the {} numbers that its record `{name}` says it has",
                record.count
            ));
        }
    } else {
        to_end(input, "a record")?;
    }
    let column = record.column(values);
    Ok(record.over_time.then_some((record, column)))
}

/// Adds the numbers of a line, with blanks between them or in fields of a width; whether they are such.
fn numbers(text: &[u8], width: usize, values: &mut Vec<f64>) -> bool {
    let before = values.len();
    let mut add = |mut fields: &mut dyn Iterator<Item = &[u8]>| {
        values.truncate(before);
        (&mut fields).all(|field| {
            let value = std::str::from_utf8(field).ok().and_then(|text| number(text.trim()));
            values.extend(value);
            value.is_some()
        })
    };
    let mut apart = text.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty());
    add(&mut apart) || add(&mut text.chunks(width))
}

/// Reads a binary record, of which `first` is said behind its type; none where it is no time response.
fn binary(
    input: &mut dyn BufRead,
    first: &[u8],
    room: &mut Room,
) -> Result<Option<(Record, Column)>, String> {
    let first = String::from_utf8_lossy(first);
    let told: Vec<u64> = first.split_whitespace().map_while(|word| word.parse().ok()).collect();
    let [order, form, _, bytes, ..] = told[..] else {
        return Err("has a binary record whose first line lacks numbers".to_owned());
    };
    let told = Binary { big: order == 2, ieee: form == 2, bytes };
    let record = record(input)?;
    let name = &record.names[0];
    let mut values = Vec::new();
    if let Some((kind, _)) = record.values().ok().filter(|_| record.over_time) {
        if !told.ieee {
            return Err(format!("has binary numbers in a record (`{name}`) that are none of IEEE 754"));
        }
        if record.count.checked_mul(kind.width() as u64) != Some(told.bytes) {
            let (count, bytes) = (record.count, told.bytes);
            return Err(format!(
                "says that its record `{name}` has {count} numbers, but not in {bytes} bytes"
            ));
        }
        let mut input: &mut dyn Read = input;
        read(&mut input, (kind, told.big), record.count, room, &mut values)?;
    } else {
        let mut input: &mut dyn Read = input;
        skip(&mut input, told.bytes)?;
    }
    // The numbers may end within a line.
    let what = format!("record `{name}`");
    let after = needed(input, &what)?;
    let after = if after.trim_ascii().is_empty() { needed(input, &what)? } else { after };
    if after.trim_ascii() != DELIMITER {
        return Err(format!("has more than the {} bytes that its record `{name}` says it has", told.bytes));
    }
    let column = record.column(values);
    Ok(record.over_time.then_some((record, column)))
}

/// The names of the records: of what tells each from the others, the first.
fn names(found: &[(Record, Column)]) -> Vec<String> {
    let apart = |name: &dyn Fn(&Record) -> String| {
        let names: Vec<String> = found.iter().map(|(record, _)| name(record)).collect();
        let told = names.iter().all(|name| !name.is_empty() && name != "NONE");
        (told && names.iter().collect::<HashSet<_>>().len() == names.len()).then_some(names)
    };
    (0..NAMES)
        .find_map(|number| apart(&|record| record.names[number].clone()))
        .or_else(|| apart(&|record| record.point.clone()))
        .unwrap_or_else(|| (1..=found.len()).map(|number| format!("record_{number}")).collect())
}
