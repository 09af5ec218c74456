//! One stroke, and what is said of a file.

use std::io::{Cursor, Read};
use std::path::Path;

use squealmap_identify::{Channel, Identification, Settings, Unfit, identify};

/// Samples per second of every record, Hz.
pub(crate) const RATE: f64 = 50e3;
/// The columns of the records, in the order of the channels.
pub(crate) const NAMES: [&str; 5] = ["ax2", "ay1", "T", "N", "V"];

/// A file of the folder `records`.
pub(crate) fn record(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/records");
    std::fs::read(folder.join(name)).expect("a record of the folder")
}

/// The columns of `stroke.csv`.
pub(crate) fn columns() -> [Vec<f64>; NAMES.len()] {
    let text = String::from_utf8(record("stroke.csv")).expect("text");
    let mut columns = [const { Vec::new() }; NAMES.len()];
    for line in text.lines().skip(1) {
        for (column, field) in columns.iter_mut().zip(line.split(',')) {
            column.push(field.parse().expect("a number"));
        }
    }
    columns
}

/// CSV of columns.
pub(crate) fn csv(names: &[&str], columns: &[Vec<f64>]) -> Vec<u8> {
    let mut text = names.join(",") + "\n";
    for row in 0..columns[0].len() {
        let fields: Vec<String> = columns.iter().map(|column| column[row].to_string()).collect();
        text += &(fields.join(",") + "\n");
    }
    text.into_bytes()
}

pub(crate) fn at_rate(rate: f64) -> Settings {
    Settings { rate: Some(rate), ..Settings::default() }
}

/// Settings with other columns than the default ones.
pub(crate) fn named(columns: &[&str], settings: Settings) -> Settings {
    let mut settings = settings;
    for (channel, column) in Channel::ALL.into_iter().zip(columns) {
        settings.columns[channel as usize] = Some((*column).to_owned());
    }
    settings
}

pub(crate) fn run(bytes: &[u8], settings: &Settings) -> Result<Identification, Unfit> {
    let open = || Ok(Box::new(Cursor::new(bytes.to_owned())) as Box<dyn Read>);
    identify(open, "record", settings, &mut |_, _| {})
}

/// The whole identification as text, but for its notes and the names of its columns.
pub(crate) fn found(bytes: &[u8], settings: &Settings) -> String {
    let mut found = run(bytes, settings).unwrap_or_else(|why| panic!("{why}"));
    found.notes.clear();
    found.remarks.clear();
    found.columns = Default::default();
    format!("{found:?}")
}

/// What the stroke says as CSV.
pub(crate) fn reference() -> String {
    found(&csv(&NAMES, &columns()), &at_rate(RATE))
}

/// The sentence about a file that is refused; it must have all `parts`.
pub(crate) fn refused(bytes: &[u8], settings: &Settings, parts: &[&str]) -> String {
    let said = run(bytes, settings).expect_err("a fault").to_string();
    for part in parts {
        assert!(said.contains(part), "{part:?} is not in: {said}");
    }
    said
}
