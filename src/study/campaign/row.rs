//! A stroke of a campaign, and `strokes.csv` with a row for each.

use crate::results::csv::Table;
use crate::study::error::Result;
use crate::study::identify::shown::Colour;
use crate::sweep::columns::Cell;
use squealmap_identify::{Identification, Segment, State, Stroke};

/// The columns of a stroke; SI units, temperature in °C, shares of its time from 0 to 1.
const COLUMNS: [&str; 22] = [
    "record",
    "stroke",
    "start",
    "end",
    "direction",
    "temperature",
    "velocity",
    "velocity_start",
    "velocity_end",
    "velocity_law",
    "friction",
    "vibrating",
    "frequency",
    "amplitude",
    "no_instability",
    "negative_slope",
    "negative_slope_at_least",
    "mode_coupling",
    "mode_coupling_at_least",
    "both",
    "undecided",
    "status",
];

/// The directions of strokes, that of a positive velocity first.
pub(super) const DIRECTIONS: [&str; 2] = ["forward", "back"];

/// The velocity hardly changes where its quarters differ by less than this part of the largest.
const CONSTANT: f64 = 0.15;

/// How the velocity goes over a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum VelocityLaw {
    /// It hardly changes.
    Constant,
    /// It falls from quarter to quarter.
    Falling,
    /// It rises from quarter to quarter.
    Rising,
    /// It does both.
    Varying,
}

impl VelocityLaw {
    /// All of them.
    pub(super) const ALL: [VelocityLaw; 4] =
        [VelocityLaw::Constant, VelocityLaw::Falling, VelocityLaw::Rising, VelocityLaw::Varying];

    /// The law of a stroke whose quarters have these mean speeds.
    #[must_use]
    pub fn of(speeds: [f64; 4]) -> VelocityLaw {
        let [low, high] = [f64::min, f64::max].map(|of| speeds.into_iter().reduce(of).unwrap_or(0.0));
        match speeds {
            _ if high - low <= CONSTANT * high => VelocityLaw::Constant,
            speeds if speeds.is_sorted() => VelocityLaw::Rising,
            speeds if speeds.iter().rev().is_sorted() => VelocityLaw::Falling,
            _ => VelocityLaw::Varying,
        }
    }

    /// Its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            VelocityLaw::Constant => "constant",
            VelocityLaw::Falling => "falling",
            VelocityLaw::Rising => "rising",
            VelocityLaw::Varying => "varying",
        }
    }
}

/// What the signals of a stroke say: what its row of the table has.
#[derive(Clone, Debug, PartialEq)]
pub struct Said {
    /// Start and end, s, by the clock of the record.
    pub time: [f64; 2],
    /// Whether the body slides in the direction that has a positive velocity.
    pub forward: bool,
    /// How the velocity goes; `None` where it was not recorded.
    pub law: Option<VelocityLaw>,
    /// Mean speed, m/s; `None` where the velocity was not recorded.
    pub speed: Option<f64>,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
    /// Mean friction coefficient.
    pub friction: Option<f64>,
    /// The part of its time in which it vibrates.
    pub vibrating: f64,
    /// Frequency (Hz) of what vibrates longest, and the largest amplitude of the tangential acceleration, m/s².
    pub vibration: Option<[f64; 2]>,
    /// The parts of its time with each verdict, in the order of [`Colour::ALL`].
    pub shares: [f64; Colour::ALL.len()],
}

/// A stroke of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeRow {
    /// The record.
    pub record: String,
    /// Which of its strokes, from 1.
    pub number: usize,
    /// Where in the record, and which way; `None` of a record that cannot be read.
    pub stroke: Option<Stroke>,
    /// What its signals say, or why they say nothing.
    pub said: std::result::Result<Said, String>,
    /// Its segments in one sentence; empty of a stroke that says nothing.
    pub told: String,
}

impl Said {
    /// What was found in a stroke.
    #[must_use]
    pub fn new(found: &Identification, stroke: &Stroke) -> Said {
        // Without a column of time a stroke has a clock of its own.
        let begins = found.time[0].abs() * found.rate < 0.5 && stroke.rows[0] > 0;
        let offset = if begins { stroke.rows[0] as f64 / found.rate } else { 0.0 };
        let length = |segment: &Segment| segment.time[1] - segment.time[0];
        let whole: f64 = found.segments.iter().map(length).sum();
        let part = |is: &dyn Fn(&Segment) -> bool| {
            // The sum of nothing is −0.
            found.segments.iter().filter(|segment| is(segment)).map(length).fold(0.0, |sum, one| sum + one)
                / whole
        };
        let vibrates = |segment: &Segment| segment.state != State::Quiet;
        let loud = || found.segments.iter().filter(|segment| vibrates(segment));
        let longest = loud().max_by(|a, b| length(a).total_cmp(&length(b)));
        let amplitude = loud().map(|segment| segment.amplitude).fold(0.0, f64::max);
        let shares = Colour::ALL.map(|colour| {
            if whole > 0.0 {
                part(&|segment| Colour::of(segment) == colour)
            } else {
                f64::from(u8::from(Colour::from(found.verdict.kind) == colour))
            }
        });
        Said {
            time: found.time.map(|time| time + offset),
            forward: stroke.forward,
            law: stroke.quarters.map(VelocityLaw::of),
            speed: stroke.quarters.map(|quarters| quarters.iter().sum::<f64>() / quarters.len() as f64),
            temperature: stroke.temperature,
            friction: stroke.friction,
            vibrating: if whole > 0.0 { part(&vibrates) } else { 0.0 },
            vibration: longest.and_then(|segment| Some([segment.frequency?, amplitude])),
            shares,
        }
    }
}

/// `strokes.csv`.
///
/// # Errors
/// When it cannot be written.
pub fn strokes_csv(rows: &[StrokeRow]) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.iter())?;
    for row in rows {
        let said = row.said.as_ref().ok();
        let number = |value: Option<f64>| Cell::from(value).to_string();
        let direction = row.stroke.map_or("", |stroke| DIRECTIONS[usize::from(!stroke.forward)]);
        let ends = row.stroke.and_then(|stroke| stroke.quarters).map(|quarters| [quarters[0], quarters[3]]);
        let shares = Colour::ALL.map(|colour| number(said.map(|said| said.shares[colour as usize])));
        let mut cells = vec![row.record.clone(), row.number.to_string()];
        cells.extend([0, 1].map(|end| number(said.map(|said| said.time[end]))));
        cells.push(direction.to_owned());
        cells.push(number(said.and_then(|said| said.temperature)));
        cells.push(number(said.and_then(|said| said.speed)));
        cells.extend([0, 1].map(|end| number(ends.map(|ends| ends[end]))));
        let law = row.stroke.and_then(|stroke| stroke.quarters).map(VelocityLaw::of);
        cells.push(law.map_or("", VelocityLaw::name).to_owned());
        cells.push(number(said.and_then(|said| said.friction)));
        cells.push(number(said.map(|said| said.vibrating)));
        cells.extend([0, 1].map(|which| number(said.and_then(|said| Some(said.vibration?[which])))));
        cells.extend(shares);
        cells.push(row.said.as_ref().err().map_or("ok", String::as_str).to_owned());
        table.row(cells.into_iter())?;
    }
    Ok(table.finish()?)
}
