//! Limits that the figures of a kernel may not exceed: what a distribution's compiler once made of it.

use std::error::Error;
use std::path::PathBuf;

use crate::figures::Figures;
use crate::rows::Row;

/// How far a figure may rise above its limit.
const SLACK: f64 = 1.03;

/// What is planted in a row to see that the comparison sees it: one part within the slack, one beyond it.
const PLANTED: [f64; 2] = [1.02, 1.04];

/// Columns of the file before its figures.
const KEY: [&str; 4] = ["kernel", "scalar", "compiler", "version"];

/// What was found of a row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// Every figure keeps its limit.
    Kept,
    /// The limits are those of other versions of the compiler.
    OtherVersion(String),
    /// There is no limit for the kernel.
    Unknown,
    /// A figure rose, or is no longer told: a sentence for each.
    Risen(Vec<String>),
}

/// The limits: kernel, scalar, compiler, version and figures.
pub(crate) struct Limits(Vec<(Vec<String>, Vec<Option<f64>>)>);

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("benches/gpu/limits.csv")
}

fn names() -> impl Iterator<Item = &'static str> {
    KEY.into_iter().chain(Figures::HELD.map(|held| Figures::NAMES[held]))
}

fn key(row: &Row) -> [&str; 4] {
    [&row.kernel, &row.scalar, &row.compiler, &row.version]
}

impl Limits {
    /// Those that are kept in the repository.
    pub(crate) fn read() -> Result<Limits, Box<dyn Error>> {
        let mut reader = csv::Reader::from_path(path())?;
        if !reader.headers()?.iter().eq(names()) {
            return Err("benches/gpu/limits.csv has other columns: write it again with --keep-limits".into());
        }
        let mut limits = Vec::new();
        for record in reader.records() {
            let fields: Vec<String> = record?.iter().map(str::to_owned).collect();
            let values = fields[KEY.len()..].iter().map(|field| field.parse().ok()).collect();
            limits.push((fields[..KEY.len()].to_vec(), values));
        }
        Ok(Limits(limits))
    }

    /// Writes what was measured as the limits of these versions; those of other versions stay.
    pub(crate) fn write(rows: &[Row]) -> Result<PathBuf, Box<dyn Error>> {
        let fresh = |version: &String| rows.iter().any(|row| row.version == *version);
        let old = if path().exists() { Limits::read()?.0 } else { Vec::new() };
        let mut writer = csv::Writer::from_path(path())?;
        writer.write_record(names())?;
        let text = |value: &Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
        for (key, values) in old.iter().filter(|(key, _)| !fresh(&key[3])) {
            writer.write_record(key.iter().cloned().chain(values.iter().map(text)))?;
        }
        for row in rows {
            let values = row.figures.values();
            let held = Figures::HELD.map(|held| text(&values[held]));
            writer.write_record(key(row).map(str::to_owned).into_iter().chain(held))?;
        }
        writer.flush()?;
        Ok(path())
    }

    /// That a rise is seen: each figure of a row that keeps its limits is made larger, by what is allowed and by more.
    ///
    /// # Errors
    /// When one is not seen, or what is allowed is called a rise.
    pub(crate) fn sees_rises(&self, row: &Row) -> Result<(), String> {
        let Some((_, limits)) = self.0.iter().find(|limit| limit.0 == key(row)) else { return Ok(()) };
        for (place, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            for (factor, red) in PLANTED.into_iter().zip([false, true]) {
                let mut planted = row.clone();
                // A limit of 0 allows nothing.
                let value = if *limit == 0.0 && red { 1.0 } else { limit * factor };
                *planted.figures.held_mut()[place] = Some(value);
                if matches!(self.judge(&planted), Verdict::Risen(_)) != red {
                    let name = Figures::NAMES[Figures::HELD[place]];
                    return Err(format!("the comparison of {name} takes {value} against {limit} wrongly"));
                }
            }
        }
        Ok(())
    }

    /// Holds a row against them.
    pub(crate) fn judge(&self, row: &Row) -> Verdict {
        let same = |limit: &&(Vec<String>, Vec<Option<f64>>)| limit.0[..3] == key(row)[..3];
        let Some((_, limits)) = self.0.iter().find(|limit| limit.0 == key(row)) else {
            let versions: Vec<&str> = self.0.iter().filter(same).map(|limit| limit.0[3].as_str()).collect();
            return if versions.is_empty() {
                Verdict::Unknown
            } else {
                Verdict::OtherVersion(versions.join(", "))
            };
        };
        let values = row.figures.values();
        let mut risen = Vec::new();
        for (held, limit) in Figures::HELD.into_iter().zip(limits) {
            let name = Figures::NAMES[held];
            match (values[held], limit) {
                (Some(value), Some(limit)) if value > limit * SLACK => risen.push(format!(
                    "{name} of `{}` in {} on {} rose from {limit} to {value}",
                    row.kernel, row.scalar, row.compiler
                )),
                (None, Some(limit)) => risen.push(format!(
                    "{name} of `{}` in {} on {} is no longer told, it was {limit}",
                    row.kernel, row.scalar, row.compiler
                )),
                _ => {}
            }
        }
        if risen.is_empty() { Verdict::Kept } else { Verdict::Risen(risen) }
    }
}
