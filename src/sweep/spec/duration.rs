//! Lengths of time as they are written: `"6 s"` or `"200 periods"`.

use std::fmt;

use crate::engine::plan::Duration;
use crate::sweep::error::Result;
use crate::sweep::spec::document::{Node, out_of_range, string};
use squealmap_input::place::Source;

/// The word for a run until its windows agree.
pub(crate) const AUTO: &str = "auto";

/// The word for a run until its cycle is found.
pub(crate) const CYCLE: &str = "cycle";

/// Longest duration in seconds or periods: a typing error is refused, no study is.
pub(super) const LONGEST: f64 = 1e9;

/// Whether a duration may be so many seconds or periods; only that of `settle` may be 0.
pub(super) fn is_legal(count: f64, settle: bool) -> bool {
    let long_enough = if settle { count >= 0.0 } else { count > 0.0 };
    long_enough && count <= LONGEST
}

/// Reads a duration; only that of `settle` may be 0.
pub(super) fn duration(source: &Source, node: &Node, label: &str, settle: bool) -> Result<Duration> {
    let (expected, bound) = if settle {
        ("\"auto\", \"cycle\" or a string such as \"6 s\" or \"200 periods\"", "not below 0")
    } else {
        ("a string such as \"6 s\" or \"200 periods\"", "greater than 0")
    };
    let text = string(source, node, label, expected)?;
    let bad = || out_of_range(source, node, label, format!("{expected}, {bound} and at most {LONGEST:e}"));

    let mut words = text.split_whitespace();
    let (Some(count), Some(unit), None) = (words.next(), words.next(), words.next()) else {
        return Err(bad());
    };
    let count: f64 = count.parse().map_err(|_| bad())?;
    if !is_legal(count, settle) {
        return Err(bad());
    }
    match unit {
        "s" => Ok(Duration::Seconds(count)),
        "period" | "periods" => Ok(Duration::Periods(count)),
        _ => Err(bad()),
    }
}

impl Duration {
    /// The length of time that is displayed like this; `None` of other words.
    pub(super) fn from_words(text: &str) -> Option<Duration> {
        match text.split_once(' ') {
            None => (text == Duration::Ramp.to_string()).then_some(Duration::Ramp),
            Some((count, "s")) => count.parse().ok().map(Duration::Seconds),
            Some((count, "periods")) => count.parse().ok().map(Duration::Periods),
            Some(_) => None,
        }
    }
}

impl fmt::Display for Duration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Duration::Seconds(seconds) => write!(f, "{seconds} s"),
            Duration::Periods(periods) => write!(f, "{periods} periods"),
            Duration::Ramp => write!(f, "ramp_duration"),
        }
    }
}
