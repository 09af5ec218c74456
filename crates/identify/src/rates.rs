//! How often each witness decides, and how often wrongly, on synthetic strokes: `rates.csv`, written by
//! `cargo bench --bench strokes`.

use std::sync::LazyLock;

use crate::testimony::Witness;

/// The counts.
const TABLE: &str = include_str!("rates.csv");

/// Strokes, and what a witness said about them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    /// How many strokes it was tried on.
    pub number: u32,
    /// Of how many it said something with a confidence of 0.9 and more.
    pub decided: u32,
    /// Of how many something that was wrong.
    pub wrong: u32,
}

/// Whether forces are slow, the name of a witness, and its rate.
type Row = (bool, &'static str, Rate);

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| TABLE.lines().skip(1).filter_map(row).collect());

fn row(line: &'static str) -> Option<Row> {
    let fields: Vec<&str> = line.split(',').collect();
    let [forces, witness, number, decided, wrong] = fields[..] else { return None };
    let count = |field: &str| field.parse().ok();
    Some((
        forces == "slow",
        witness,
        Rate { number: count(number)?, decided: count(decided)?, wrong: count(wrong)? },
    ))
}

/// The rate of a witness, or of all together (`None`), with slow force sensors or with those that follow the vibration.
#[must_use]
pub fn rate_of(witness: Option<Witness>, slow: bool) -> Option<Rate> {
    let name = witness.map_or("joint", Witness::name);
    ROWS.iter().find(|(forces, row, _)| *forces == slow && *row == name).map(|(.., rate)| *rate)
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Rate { number, decided, wrong } = self;
        write!(f, "decided {decided} of {number} synthetic strokes, {wrong} wrongly")
    }
}
