//! The unit of a column of time: said outright, or by its header.

/// A unit of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeUnit {
    /// s
    Second,
    /// ms
    Millisecond,
    /// µs
    Microsecond,
    /// ns
    Nanosecond,
    /// min
    Minute,
    /// h
    Hour,
}

impl TimeUnit {
    /// Every unit, the usual ones first.
    pub const ALL: [TimeUnit; 6] = [
        TimeUnit::Second,
        TimeUnit::Millisecond,
        TimeUnit::Microsecond,
        TimeUnit::Nanosecond,
        TimeUnit::Minute,
        TimeUnit::Hour,
    ];

    /// Its name as an option takes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            TimeUnit::Second => "s",
            TimeUnit::Millisecond => "ms",
            TimeUnit::Microsecond => "us",
            TimeUnit::Nanosecond => "ns",
            TimeUnit::Minute => "min",
            TimeUnit::Hour => "h",
        }
    }

    /// How many seconds it has.
    #[must_use]
    pub fn seconds(self) -> f64 {
        match self {
            TimeUnit::Second => 1.0,
            TimeUnit::Millisecond => 1e-3,
            TimeUnit::Microsecond => 1e-6,
            TimeUnit::Nanosecond => 1e-9,
            TimeUnit::Minute => 60.0,
            TimeUnit::Hour => 3600.0,
        }
    }

    /// Reads a unit as people write it.
    #[must_use]
    pub fn parse(text: &str) -> Option<TimeUnit> {
        Some(match text.trim().to_lowercase().as_str() {
            "s" | "sec" | "secs" | "second" | "seconds" => TimeUnit::Second,
            "ms" | "msec" | "millisecond" | "milliseconds" => TimeUnit::Millisecond,
            // The micro sign and the Greek letter.
            "us" | "\u{b5}s" | "\u{3bc}s" | "usec" | "microsecond" | "microseconds" => TimeUnit::Microsecond,
            "ns" | "nsec" | "nanosecond" | "nanoseconds" => TimeUnit::Nanosecond,
            "min" | "minute" | "minutes" => TimeUnit::Minute,
            "h" | "hr" | "hour" | "hours" => TimeUnit::Hour,
            _ => return None,
        })
    }
}

impl TimeUnit {
    /// Reads a unit that may stand in brackets.
    pub(super) fn bare(text: &str) -> Option<TimeUnit> {
        TimeUnit::parse(text.trim().trim_matches(['[', ']', '(', ')']))
    }
}

/// What stands before the brackets that a header ends with, and in them.
pub(super) fn bracketed(header: &str) -> Option<(&str, &str)> {
    let header = header.trim();
    let unclosed = header.strip_suffix(']').map(|text| (text, '['));
    let (text, bracket) = unclosed.or(header.strip_suffix(')').map(|text| (text, '(')))?;
    text.rsplit_once(bracket)
}

/// The name of a column and the unit that its header says: of `time [ms]`, `t_ms`, `Time (ms)`, `t/ms`, `t in ms`.
pub(super) fn named(header: &str) -> (&str, Option<TimeUnit>) {
    let header = header.trim();
    let parts = bracketed(header).or_else(|| header.rsplit_once(['_', ' ', '/', ',', '-']));
    let Some((name, unit)) = parts.and_then(|(name, unit)| Some((name, TimeUnit::parse(unit)?))) else {
        return (header, None);
    };
    let name = name.trim_end_matches(['_', ' ', '/', ',', '-']);
    (name.strip_suffix(" in").unwrap_or(name).trim_end(), Some(unit))
}

/// Whether a header names a column of time when none is named: `t` or `time`, with or without a unit. `T` is a force.
pub(super) fn is_time(header: &str) -> bool {
    let (name, _) = named(header);
    name == "t" || name.eq_ignore_ascii_case("time")
}
