//! `squealmap compare`: two result directories of the same grid, and where they differ.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::error::{Error, Result};
use crate::cli::output::{Output, list};
use crate::cli::pictures::png_of;
use crate::cli::talk::print;
use clap::Args;
use squealmap::results::comparison::{document, figure, table};
use squealmap::results::read::Archive;
use squealmap::results::read::compare::{Comparison, Differences, Labels};

/// What is written.
const FILES: [&str; 4] = ["compare.csv", "compare.json", "compare.png", "compare.svg"];
/// The most pairs of labels that are printed; the table has all.
const PAIRS: usize = 8;

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// Output directory of a run
    first: PathBuf,
    /// Output directory of a run of the same grid: with another engine, version, law or duration
    second: PathBuf,
    /// Where compare.csv, compare.json, compare.svg and compare.png go [default: nowhere, the summary alone]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

impl Compare {
    pub(crate) fn execute(self) -> Result<()> {
        let [first, second] = [&self.first, &self.second].map(|directory| Archive::read(directory));
        let (first, second) = (first?, second?);
        let found = Comparison::new(&first, &second).map_err(|why| Error::NotComparable {
            first: self.first.clone(),
            second: self.second.clone(),
            why,
        })?;
        print(&summary(&found));
        let Some(directory) = self.output else { return Ok(()) };
        let output = Output::prepare(directory, &FILES)?;
        let names = [&self.first, &self.second].map(|directory| directory.display().to_string());
        let svg = figure(&first, &found)?;
        let files = [
            (FILES[0], table(&first, &found)?),
            (FILES[1], document([&names[0], &names[1]], &found)?),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        print(&list(&output.write(&files)?));
        Ok(())
    }
}

/// The differences in words and two tables.
fn summary(found: &Comparison) -> String {
    let [computed, total] = found.computed;
    let mut text = String::new();
    if computed < total {
        let _ = writeln!(text, "{computed} of {total} instances were computed in both");
    }
    for labels in &found.labels {
        write_labels(&mut text, labels, computed);
    }
    let width = found.columns.iter().map(|column| column.name.len()).max().unwrap_or(0);
    if width > 0 {
        let _ = writeln!(
            text,
            "\nrelative differences\n{:width$}  {:>9}  {:>9}  {:>8}  {:>8}  {:>8}  {:>8}",
            "", "compared", "equal", "half", "90 %", "99 %", "all"
        );
    }
    for column in &found.columns {
        write_column(&mut text, column, width);
    }
    text
}

/// How many instances have another label, and the pairs that are most frequent.
fn write_labels(text: &mut String, labels: &Labels, computed: usize) {
    let changes = labels.changes();
    let differ: usize = changes.iter().map(|(_, count)| count).sum();
    let _ = writeln!(text, "{}: {differ} of {computed} instances differ", labels.name);
    let shown = |label: &str| if label.is_empty() { "-".to_owned() } else { label.to_owned() };
    for ([from, to], count) in changes.iter().take(PAIRS) {
        let _ = writeln!(text, "  {count:>7}  {} -> {}", shown(from), shown(to));
    }
    if changes.len() > PAIRS {
        let rest: usize = changes[PAIRS..].iter().map(|(_, count)| count).sum();
        let _ = writeln!(text, "  {rest:>7}  {} other pairs", changes.len() - PAIRS);
    }
}

fn write_column(text: &mut String, column: &Differences, width: usize) {
    let [compared, equal] = column.compared();
    let _ = write!(text, "{:width$}  {compared:>9}  {equal:>9}", column.name);
    for quantile in column.quantiles().into_iter().flatten() {
        let _ = write!(text, "  {quantile:>8.1e}");
    }
    let [first, second] = column.alone;
    if first + second > 0 {
        let _ = write!(text, "  (in the first alone {first}, in the second {second})");
    }
    text.push('\n');
}
