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

/// How the forces were known at the frequency of the vibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forces {
    /// Not at all: their sensors are slow.
    Slow,
    /// By sensors that follow it.
    Fast,
    /// From the accelerations, by a model of the rig.
    Model,
}

impl Forces {
    fn name(self) -> &'static str {
        match self {
            Forces::Slow => "slow",
            Forces::Fast => "fast",
            Forces::Model => "model",
        }
    }
}

/// How the forces were known, the name of a witness, and its rate.
type Row = (&'static str, &'static str, Rate);

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| TABLE.lines().skip(1).filter_map(row).collect());

fn row(line: &'static str) -> Option<Row> {
    let fields: Vec<&str> = line.split(',').collect();
    let [forces, witness, number, decided, wrong] = fields[..] else { return None };
    let count = |field: &str| field.parse().ok();
    Some((forces, witness, Rate { number: count(number)?, decided: count(decided)?, wrong: count(wrong)? }))
}

/// The rate of a witness, or of all together (`None`), with forces that are known so.
#[must_use]
pub fn rate_of(witness: Option<Witness>, by: Forces) -> Option<Rate> {
    let name = witness.map_or("joint", Witness::name);
    ROWS.iter().find(|(forces, row, _)| *forces == by.name() && *row == name).map(|(.., rate)| *rate)
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Rate { number, decided, wrong } = self;
        write!(f, "decided {decided} of {number} synthetic strokes, {wrong} wrongly")
    }
}
