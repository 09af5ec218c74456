//! The results of a sweep, counted: regimes against types, and statuses when any is not `ok`.

use std::fmt::Write;

use squealmap::engine::regime::Regime;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::sweep::label::{Label, Tally};
use squealmap::sweep::spec::{Analysis, Starts};

/// The word where an analysis gave nothing.
const NONE: &str = "-";

/// The table of classes, and what else there is to say of what was computed.
pub(crate) fn summary(analysis: Analysis, tally: &Tally) -> String {
    classes(analysis, tally) + &remarks(analysis, tally)
}

/// The table of counts: one row per type, one column per regime, only those that occur among what was computed.
pub(crate) fn classes(analysis: Analysis, tally: &Tally) -> String {
    let types: Vec<&str> = InstabilityType::ALL.iter().map(|kind| kind.name()).chain([NONE]).collect();
    let regimes: Vec<&str> = Regime::ALL.iter().map(|regime| regime.name()).chain([NONE]).collect();
    let computed = |label: Label| label.status() != Status::NotComputed;
    let count = |selects: &dyn Fn(Label) -> bool| tally.count(|label| computed(label) && selects(label));
    let kind = |label: Label| label.kind().map_or(NONE, InstabilityType::name);
    let regime = |label: Label| label.regime().map_or(NONE, Regime::name);

    let mut text = String::new();
    if analysis.linear && analysis.response {
        cross(&mut text, &count, ("type", &types, &kind), (&regimes, &regime));
    } else if analysis.linear {
        cross(&mut text, &count, ("type", &types, &kind), (&[], &|_| ""));
    } else {
        cross(&mut text, &count, ("regime", &regimes, &regime), (&[], &|_| ""));
    }
    text
}

/// Failures, what has not settled, what several starts gave, and what checks found.
fn remarks(analysis: Analysis, tally: &Tally) -> String {
    let mut text = String::new();
    if tally.count(|label| label.status() != Status::Ok) > 0 {
        let statuses: Vec<&str> = Status::IN_MAP.iter().map(|status| status.name()).collect();
        text.push('\n');
        let all = |selects: &dyn Fn(Label) -> bool| tally.count(selects);
        cross(&mut text, &all, ("status", &statuses, &|label| label.status().name()), (&[], &|_| ""));
    }
    let unsettled = tally.count(|label| label.settled() == Some(false));
    if unsettled > 0 {
        let _ = writeln!(text, "\n{unsettled} of {} instances had not settled", tally.computed());
    }
    if analysis.starts != Starts::One {
        let computed = |label: Label| label.status() != Status::NotComputed;
        let verdict = |wanted| tally.count(|label| computed(label) && label.bistable() == wanted);
        let _ = writeln!(
            text,
            "\n{} of {} instances are bistable: starts end differently ({} without a verdict)",
            verdict(Some(true)),
            tally.computed(),
            verdict(None)
        );
    }
    let failed: Vec<String> = tally.failed().map(|(status, count)| format!("{count} {status}")).collect();
    if !failed.is_empty() {
        let _ = writeln!(text, "large starts without a response: {}", failed.join(", "));
    }
    if tally.failed_in_boxes() > 0 {
        let _ = writeln!(text, "{} starts of boxes have no response", tally.failed_in_boxes());
    }
    let checks = tally.checks().summary(analysis.finds_cycles);
    if !checks.is_empty() {
        text.push('\n');
        text += &checks;
    }
    text
}

/// Counts what is selected.
type Count<'a> = &'a dyn Fn(&dyn Fn(Label) -> bool) -> usize;

/// Names and which one a label has.
type Rows<'a> = (&'a str, &'a [&'a str], &'a dyn Fn(Label) -> &'static str);
type Columns<'a> = (&'a [&'a str], &'a dyn Fn(Label) -> &'static str);

/// Counts instances by row and column; a last column holds the sums of the rows.
fn cross(text: &mut String, of: Count, (title, rows, row_of): Rows, (columns, column_of): Columns) {
    let count = |row: &str, column: Option<&str>| {
        of(&|label| row_of(label) == row && column.is_none_or(|name| column_of(label) == name))
    };
    let columns: Vec<&str> =
        columns.iter().copied().filter(|column| of(&|label| column_of(label) == *column) > 0).collect();
    let width = rows.iter().map(|row| row.len()).max().unwrap_or(0).max(title.len());
    let _ = write!(text, "{title:width$}");
    for column in &columns {
        let _ = write!(text, "  {column:>7}");
    }
    let _ = writeln!(text, "  {:>9}", "instances");
    for row in rows {
        let sum = count(row, None);
        if sum == 0 {
            continue;
        }
        let _ = write!(text, "{row:width$}");
        for column in &columns {
            let _ = write!(text, "  {:>1$}", count(row, Some(column)), column.len().max(7));
        }
        let _ = writeln!(text, "  {sum:>9}");
    }
}
