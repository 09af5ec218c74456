//! What the figure of measured signals shows.

use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::study::error::Result;
use crate::version::{COMMIT, VERSION};
use squealmap_identify::{Clip, Identification, Instant, Kind, Mechanism, Segment, Spectrogram, told};

/// Everything that the figure shows.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Shown {
    /// The heading; may be empty.
    pub title: String,
    /// The verdict in words.
    pub verdict: String,
    /// Start and end of the record, s.
    pub time: [f64; 2],
    /// Tangential and normal acceleration, m/s²: the record is cut into columns side by side, and each has its lowest and
    /// highest value. Empty where not recorded.
    pub accelerations: [Vec<[f64; 2]>; 2],
    /// Start and end of the time over which the friction is known, s.
    pub friction_time: [f64; 2],
    /// The friction coefficient: lowest and highest value of each column, over that time.
    pub friction: Vec<[f64; 2]>,
    /// Velocity, temperature, phase and coherence over time.
    pub course: Vec<Instant>,
    /// The segments of the record.
    pub segments: Vec<Coloured>,
    /// Both accelerations over a few periods.
    pub zooms: Vec<Clip>,
    /// The spectrogram, whose numbers stand in `spectrogram.nc`.
    pub spectrogram: Spectrogram,
}

/// A segment as it is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Coloured {
    /// Start and end, s.
    pub time: [f64; 2],
    /// Its colour.
    pub verdict: Colour,
}

/// What a colour says of a stretch of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Colour {
    /// Stable.
    NoInstability,
    /// A negative slope.
    NegativeSlope,
    /// A negative slope in any case.
    AnySlope,
    /// Mode coupling.
    ModeCoupling,
    /// Mode coupling in any case.
    AnyCoupling,
    /// Both.
    Both,
    /// None of these.
    Undecided,
}

impl Colour {
    /// All of them, in the order of a key.
    pub const ALL: [Colour; 7] = [
        Colour::NoInstability,
        Colour::NegativeSlope,
        Colour::AnySlope,
        Colour::ModeCoupling,
        Colour::AnyCoupling,
        Colour::Both,
        Colour::Undecided,
    ];

    /// That of a segment.
    #[must_use]
    pub fn of(segment: &Segment) -> Colour {
        match (segment.verdict.kind, segment.shared) {
            (Kind::Undecided, Some((Mechanism::NegativeSlope, _))) => Colour::AnySlope,
            (Kind::Undecided, Some((Mechanism::ModeCoupling, _))) => Colour::AnyCoupling,
            (kind, _) => Colour::from(kind),
        }
    }

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Colour::NoInstability => Kind::NoInstability.name(),
            Colour::NegativeSlope => Kind::NegativeSlope.name(),
            Colour::AnySlope => "negative_slope_at_least",
            Colour::ModeCoupling => Kind::ModeCoupling.name(),
            Colour::AnyCoupling => "mode_coupling_at_least",
            Colour::Both => Kind::Both.name(),
            Colour::Undecided => Kind::Undecided.name(),
        }
    }

    /// The words of a key.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Colour::NoInstability => "no instability",
            Colour::NegativeSlope => "negative slope",
            Colour::AnySlope => "negative slope at least",
            Colour::ModeCoupling => "mode coupling",
            Colour::AnyCoupling => "mode coupling at least",
            Colour::Both => "both",
            Colour::Undecided => "undecided",
        }
    }
}

impl From<Kind> for Colour {
    fn from(kind: Kind) -> Colour {
        match kind {
            Kind::NoInstability => Colour::NoInstability,
            Kind::NegativeSlope => Colour::NegativeSlope,
            Kind::ModeCoupling => Colour::ModeCoupling,
            Kind::Both => Colour::Both,
            Kind::Undecided => Colour::Undecided,
        }
    }
}

impl Shown {
    /// The figure of an identification, with a heading.
    #[must_use]
    pub fn new(found: &Identification, title: &str) -> Shown {
        let coloured = |segment: &Segment| Coloured { time: segment.time, verdict: Colour::of(segment) };
        Shown {
            title: title.to_owned(),
            verdict: verdict_line(found),
            time: found.time,
            accelerations: found.envelopes.each_ref().map(|envelope| envelope.columns.clone()),
            friction_time: found.friction_time,
            friction: found.friction.columns.clone(),
            course: found.course.clone(),
            segments: found.segments.iter().map(coloured).collect(),
            zooms: found.clips.clone(),
            spectrogram: found.spectrogram.clone(),
        }
    }

    /// What is left of it for a low page: neither velocity and temperature nor a close look, and no words where colours say it.
    #[must_use]
    pub(super) fn essentials(&self) -> Shown {
        let bare = |at: &Instant| Instant { velocity: None, temperature: None, ..*at };
        let verdict = if self.segments.is_empty() { self.verdict.clone() } else { String::new() };
        Shown { course: self.course.iter().map(bare).collect(), zooms: Vec::new(), verdict, ..self.clone() }
    }

    /// `figure.json`: all of it but the numbers of the spectrogram.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn document(&self) -> Result<Vec<u8>> {
        let program = json!({ "version": VERSION, "git_commit": COMMIT });
        let mut bytes = serde_json::to_vec(&json!({ "program": program, "figure": self }))
            .map_err(crate::results::error::Error::WriteManifest)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// `Verdict: 0.000 to 0.082 s no instability, to 0.250 s mode coupling`; of a record without segments that of the whole.
fn verdict_line(found: &Identification) -> String {
    if found.segments.is_empty() {
        let verdict = &found.verdict;
        return format!("Verdict: {} (confidence {:.2})", verdict.kind.words(), verdict.shown_confidence());
    }
    format!("Verdict: {}", told(&found.segments))
}
