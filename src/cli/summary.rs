//! What came out of a sweep, counted: regimes against types, and statuses when any is not `ok`.

use std::fmt::Write;

use squealmap::classify::{InstabilityType, Regime};
use squealmap::map::{Map, Record};
use squealmap::outcome::Status;

/// What stands where an analysis gave nothing.
const NONE: &str = "-";

/// The table of counts: one row per type, one column per regime, only those that occur among what was computed.
pub(crate) fn summary(map: &Map) -> String {
    let analysis = map.spec.analysis;
    let types: Vec<&str> = InstabilityType::ALL.iter().map(|kind| kind.name()).chain([NONE]).collect();
    let regimes: Vec<&str> = Regime::ALL.iter().map(|regime| regime.name()).chain([NONE]).collect();
    let computed: Vec<&Record> =
        map.records.iter().filter(|record| record.status != Status::NotComputed).collect();
    let kind = |record: &Record| record.kind.map_or(NONE, InstabilityType::name);
    let regime = |record: &Record| record.regime.map_or(NONE, Regime::name);

    let mut text = String::new();
    if analysis.linear && analysis.response {
        cross(&mut text, &computed, ("type", &types, &kind), (&regimes, &regime));
    } else if analysis.linear {
        cross(&mut text, &computed, ("type", &types, &kind), (&[], &|_| ""));
    } else {
        cross(&mut text, &computed, ("regime", &regimes, &regime), (&[], &|_| ""));
    }
    if map.records.iter().any(|record| record.status != Status::Ok) {
        let statuses: Vec<&str> = Status::IN_MAP.iter().map(|status| status.name()).collect();
        text.push('\n');
        let all: Vec<&Record> = map.records.iter().collect();
        cross(&mut text, &all, ("status", &statuses, &|record| record.status.name()), (&[], &|_| ""));
    }
    let unsettled = map.records.iter().filter(|record| record.settled == Some(false)).count();
    if unsettled > 0 {
        let _ = writeln!(text, "\n{unsettled} of {} instances had not settled", computed.len());
    }
    text
}

/// Names and which one a record has.
type Rows<'a> = (&'a str, &'a [&'a str], &'a dyn Fn(&Record) -> &'static str);
type Columns<'a> = (&'a [&'a str], &'a dyn Fn(&Record) -> &'static str);

/// Counts records by row and column; a last column holds the sums of the rows.
fn cross(text: &mut String, records: &[&Record], (title, rows, row_of): Rows, (columns, column_of): Columns) {
    let count = |row: &str, column: Option<&str>| {
        let matches =
            |record: &&&Record| row_of(record) == row && column.is_none_or(|name| column_of(record) == name);
        records.iter().filter(matches).count()
    };
    let columns: Vec<&str> = columns
        .iter()
        .copied()
        .filter(|column| records.iter().any(|one| column_of(one) == *column))
        .collect();
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
