//! `identify`: the table of windows and the report; the figure is in `figure.rs`.

use std::fmt::Write as _;
use std::io::Write;

use serde_json::{Value, json};

use crate::results::error::Error;
use crate::study::error::Result;
use crate::sweep::columns::Cell;
use crate::version::{COMMIT, VERSION};
use squealmap_identify::{
    Chances, Channel, Episode, Identification, Measured, Reading, Segment, Testimony, Verdict, Window, told,
};

pub use crate::study::identify::figure::identify_svg;
pub use crate::study::identify::shown::Shown;

/// The columns of `windows.csv`; SI units, phases in degrees, temperature in °C.
pub const COLUMNS: [&str; 22] = [
    "start",
    "end",
    "friction",
    "velocity",
    "temperature",
    "rms_acceleration",
    "frequency",
    "signal_to_noise_db",
    "growth_rate",
    "growth_rate_error",
    "distortion",
    "phase",
    "phase_error",
    "coherence",
    "force_coherence",
    "normal_share",
    "normal_share_error",
    "slope",
    "slope_error",
    "verdict",
    "confidence",
    "leaning",
];

/// `windows.csv`, one row per window, written as they come; keeps nothing of it.
#[derive(Debug)]
pub struct WindowsCsv<W: Write> {
    writer: csv::Writer<W>,
    /// The text of a cell.
    text: String,
    /// Whether all rows so far were written.
    written: Result<()>,
}

impl<W: Write> WindowsCsv<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(out: W) -> Result<WindowsCsv<W>> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS).map_err(Error::WriteTable)?;
        Ok(WindowsCsv { writer, text: String::new(), written: Ok(()) })
    }

    /// Writes the row of the next window. An error is kept until [`WindowsCsv::finish`]; nothing is written after it.
    pub fn add(&mut self, window: &Window, reading: &Reading) {
        if self.written.is_ok() {
            self.written = self.row(window, reading).map_err(|why| Error::WriteTable(why).into());
        }
    }

    /// Writes the row of a window.
    fn row(&mut self, window: &Window, reading: &Reading) -> csv::Result<()> {
        let value = |measured: Option<Measured>| measured.map(|m| m.value);
        let error = |measured: Option<Measured>| measured.map(|m| m.error);
        let numbers = [
            Some(window.time[0]),
            Some(window.time[1]),
            window.friction,
            window.velocity,
            window.temperature,
            Some(window.rms),
            Some(window.frequency),
            Some(10.0 * window.signal_to_noise.log10()),
            Some(window.growth.value),
            Some(window.growth.error),
            Some(window.distortion),
            value(reading.phase),
            error(reading.phase),
            reading.coherence,
            reading.force_coherence,
            value(reading.share),
            error(reading.share),
            value(reading.slope),
            error(reading.slope),
        ];
        for number in numbers {
            self.cell(number)?;
        }
        self.writer.write_field(reading.verdict.kind.name())?;
        self.cell(Some(reading.verdict.confidence))?;
        self.writer.write_field(reading.verdict.leaning.map_or("", |kind| kind.name()))?;
        self.writer.write_record(None::<&[u8]>)
    }

    fn cell(&mut self, number: Option<f64>) -> csv::Result<()> {
        self.text.clear();
        // Text takes everything.
        let _ = write!(self.text, "{}", Cell::from(number));
        self.writer.write_field(&self.text)
    }

    /// Ends the table and gives the writer back.
    ///
    /// # Errors
    /// When a row could not be written.
    pub fn finish(self) -> Result<W> {
        self.written?;
        Ok(self.writer.into_inner().map_err(|error| Error::WriteTable(error.into_error().into()))?)
    }
}

/// Verdict, evidence and what was analysed, as JSON.
///
/// # Errors
/// When it cannot be written.
pub fn report_json(found: &Identification, name: &str) -> Result<Vec<u8>> {
    let columns: serde_json::Map<String, Value> = Channel::ALL
        .into_iter()
        .zip(&found.columns)
        .filter(|(_, column)| !column.is_empty())
        .map(|(channel, column)| (channel.flag()[2..].replace('-', "_"), json!(column)))
        .collect();
    let report = json!({
        "program": env!("CARGO_PKG_NAME"),
        "version": VERSION,
        "commit": COMMIT,
        "signals": name,
        "columns": columns,
        "samples": found.samples,
        "rate": found.rate,
        "start": found.time[0],
        "end": found.time[1],
        "frequency": found.frequency,
        "summary": told(&found.segments),
        "segments": found.segments.iter().map(segment).collect::<Vec<_>>(),
        "growth_verdict": verdict(&found.verdict),
        "friction_slope": found.slope.map(|friction| json!({
            "slope": measured(friction.slope),
            "velocity": friction.velocity,
        })),
        "episodes": found.episodes.iter().map(episode).collect::<Vec<_>>(),
        "windows": found.windows,
        "notes": found.notes,
        "units": "SI; phases in degrees, negative when the normal acceleration lags; temperature in °C",
    });
    let mut bytes = serde_json::to_vec_pretty(&report).map_err(Error::WriteManifest)?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn verdict(verdict: &Verdict) -> Value {
    json!({
        "kind": verdict.kind,
        "confidence": verdict.confidence,
        "leaning": verdict.leaning,
        "reasons": verdict.reasons,
    })
}

fn measured(measured: Measured) -> Value {
    json!({ "value": measured.value, "error": measured.error })
}

fn episode(episode: &Episode) -> Value {
    json!({
        "start": episode.time[0],
        "end": episode.time[1],
        "frequency": episode.frequency,
        "friction": episode.friction,
        "growth_rate": measured(episode.growth),
        "gain": episode.gain.exp(),
        "phase": episode.phase.map(measured),
        "coherence": episode.coherence,
        "normal_share": episode.share.map(measured),
        "slope": episode.slope.map(measured),
        "distortion": episode.distortion,
        "verdict": verdict(&episode.verdict),
    })
}

fn segment(segment: &Segment) -> Value {
    json!({
        "start": segment.time[0],
        "end": segment.time[1],
        "state": segment.state,
        "frequency": segment.frequency,
        "amplitude": segment.amplitude,
        "vibration_over_sliding_velocity": segment.reach,
        "phase": segment.phase.map(measured),
        "coherence": segment.coherence,
        "stiffness_across_over_model": segment.across.map(|[stiffness, _]| measured(stiffness)),
        "damping_across_over_model": segment.across.map(|[_, damping]| measured(damping)),
        "friction": segment.friction.map(|friction| json!({
            "reading": friction.reading,
            "level": measured(friction.level),
            "slope": friction.slope.map(measured),
            "damping": friction.damping.map(measured),
            "misfit": friction.misfit,
        })),
        "velocity": segment.velocity,
        "temperature": segment.temperature,
        "verdict": verdict(&segment.verdict),
        "in_any_case": segment.shared.map(|(mechanism, probability)| json!({
            "mechanism": mechanism,
            "confidence": probability,
        })),
        "rests_on": segment.rests_on,
        "contradictions": segment.contradictions,
        "witnesses": segment.testimonies.iter().map(testimony).collect::<Vec<_>>(),
    })
}

fn testimony(testimony: &Testimony) -> Value {
    let chances = testimony.chances.map(|Chances([none, slope, coupling, both, together])| {
        json!({
            "no_instability": none,
            "negative_slope": slope,
            "mode_coupling": coupling,
            "both": both,
            "only_both_together": together,
        })
    });
    json!({ "witness": testimony.witness, "chances": chances, "evidence": testimony.evidence })
}
