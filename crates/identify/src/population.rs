//! Probabilities of the mechanisms from a simulated population: vibrations of the model whose cause is known from the
//! eigenvalues, counted by what a record shows of them. `population.csv` is written by `cargo bench --bench strokes -- population`.

use std::sync::LazyLock;

use crate::cross::Measured;
use crate::settings::DAMPING_RATIO;
use crate::testimony::{CAUSES, Chances};

/// The counts.
const TABLE: &str = include_str!("population.csv");
/// Lower ends of the bins of |phase|, degrees: finer where causes differ, near 0° and, on a rig that leans the other way, near 180°.
const BINS: [f64; 9] = [0.0, 10.0, 20.0, 45.0, 90.0, 150.0, 160.0, 170.0, 175.0];

/// Standard errors of `d ln μ/d ln v` beyond which nothing is known of a slope.
pub(super) const UNCLEAR: f64 = 0.1;

/// What kind of vibration it is, and how its friction was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// It grows.
    Growth,
    /// It is sustained; friction is a mean over it.
    Sustained,
    /// It is sustained, and force sensors that follow it read the law within it.
    Within,
}

impl Source {
    /// All of them.
    pub const ALL: [Source; 3] = [Source::Growth, Source::Sustained, Source::Within];

    /// The name in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Source::Growth => "growth",
            Source::Sustained => "sustained",
            Source::Within => "within",
        }
    }
}

/// Where the friction coefficient lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Above the coalescence of the modes.
    Above,
    /// Within two standard errors of it.
    Near,
    /// Below it.
    Below,
    /// Below 0.8 of it: what vibrates in phase lowers the mean of friction less.
    Far,
}

impl Level {
    /// All of them.
    pub const ALL: [Level; 4] = [Level::Above, Level::Near, Level::Below, Level::Far];

    /// The name in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Level::Above => "above",
            Level::Near => "near",
            Level::Below => "below",
            Level::Far => "far",
        }
    }
}

/// How strongly the structure is damped: how much of a falling slope that takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damped {
    /// With a damping ratio of [`DAMPING_RATIO`] at most.
    Lightly,
    /// With more.
    Strongly,
}

impl Damped {
    /// Both of them.
    pub const ALL: [Damped; 2] = [Damped::Lightly, Damped::Strongly];

    /// The name in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Damped::Lightly => "light",
            Damped::Strongly => "strong",
        }
    }

    /// What a structure may be whose damping ratio has this bound; `None` for either.
    #[must_use]
    pub fn bounded(damping_ratio: f64) -> Option<Damped> {
        (damping_ratio <= DAMPING_RATIO).then_some(Damped::Lightly)
    }
}

/// What the friction coefficient does with the velocity, by `d ln μ/d ln v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// It falls clearly.
    Falls,
    /// It falls slightly.
    Slight,
    /// It is flat, or rises.
    Other,
    /// The velocity hardly changes, or the slope is not clear.
    Unknown,
}

impl Trend {
    /// All of them.
    pub const ALL: [Trend; 4] = [Trend::Falls, Trend::Slight, Trend::Other, Trend::Unknown];

    /// The name in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Trend::Falls => "falls",
            Trend::Slight => "slight",
            Trend::Other => "other",
            Trend::Unknown => "unknown",
        }
    }

    /// The trend of `d ln μ/d ln v` with its standard error.
    pub(super) fn of(relative: Measured) -> Trend {
        /// From here on friction falls clearly, and slightly.
        const CLEARLY: f64 = -0.1;
        const SLIGHTLY: f64 = -0.03;
        /// Standard errors by which it does.
        const ERRORS: f64 = 3.0;
        let Measured { value, error } = relative;
        if value < CLEARLY && value < -ERRORS * error {
            Trend::Falls
        } else if error.is_nan() || error > UNCLEAR {
            Trend::Unknown
        } else if value < SLIGHTLY {
            Trend::Slight
        } else {
            Trend::Other
        }
    }
}

/// What a record shows of a vibration; `None` where it does not show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Growing or sustained.
    pub source: Source,
    /// The bin of |phase|.
    pub bin: Option<usize>,
    /// Level of the mean friction coefficient.
    pub level: Option<Level>,
    /// Its trend.
    pub trend: Option<Trend>,
    /// Its damping.
    pub damped: Option<Damped>,
}

/// The bin of a phase (degrees).
#[must_use]
pub fn bin(phase: f64) -> usize {
    BINS.iter().rposition(|low| phase.abs() >= *low).unwrap_or_default()
}

/// One row: what is seen and how many of slope, coupling, both, only both together.
type Row = (Seen, [f64; 4]);

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| TABLE.lines().skip(1).filter_map(row).collect());

fn row(line: &str) -> Option<Row> {
    let mut fields = line.split(',');
    let name = fields.next()?;
    let source = Source::ALL.into_iter().find(|source| source.name() == name)?;
    let bin = fields.next()?.parse().ok();
    let name = fields.next()?;
    let level = Level::ALL.into_iter().find(|level| level.name() == name);
    let name = fields.next()?;
    let trend = Trend::ALL.into_iter().find(|trend| trend.name() == name);
    let name = fields.next()?;
    let damped = Damped::ALL.into_iter().find(|damped| damped.name() == name);
    let mut count = || fields.next()?.parse().ok();
    Some((Seen { source, bin, level, trend, damped }, [count()?, count()?, count()?, count()?]))
}

/// What a witness says by itself from the population: a part is kept for what no simulation holds.
#[must_use]
pub fn stated(seen: Seen) -> (Chances, f64) {
    /// That part.
    const KEPT: f64 = 0.03;
    let (Chances(weights), number) = chances(seen);
    (Chances(weights.map(|weight| (1.0 - KEPT) * weight + KEPT / CAUSES as f64)), number)
}

/// Chances and the number of vibrations they rest on.
#[must_use]
pub fn chances(seen: Seen) -> (Chances, f64) {
    let mut counts = [0.0; 4];
    for (row, causes) in ROWS.iter() {
        let alike = row.source == seen.source
            && (seen.bin.is_none() || seen.bin == row.bin)
            && (seen.level.is_none() || seen.level == row.level)
            && (seen.trend.is_none() || seen.trend == row.trend)
            && (seen.damped.is_none() || seen.damped == row.damped);
        if alike {
            counts.iter_mut().zip(causes).for_each(|(sum, count)| *sum += count);
        }
    }
    let number: f64 = counts.iter().sum();
    // One vibration that might have been anything.
    let mut weights = [0.0; CAUSES];
    weights[1..].iter_mut().zip(counts).for_each(|(weight, count)| *weight = count + 0.25);
    let chances = Chances::from_weights(weights).unwrap_or(Chances([0.0, 0.25, 0.25, 0.25, 0.25]));
    (chances, number)
}
