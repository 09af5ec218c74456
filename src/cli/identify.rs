//! `squealmap identify`: what measured signals say.

use crate::cli::error::Result;
use crate::cli::home::prepare_beside;
use crate::cli::numbers::{finite, number, positive};
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::talk::print;
use squealmap::results::figure::look::Look;
use squealmap::study::identify::report;
use squealmap::study::identify::report::{Shown, WindowsCsv};
use squealmap::study::identify::spectrogram::spectrogram_nc;
use squealmap_identify::{
    DAMPING_RATIO, FrictionReading, INCLINATION, Identification, LARGEST_FRICTION, Measured, OVERLAP, RATES,
    Settings, TimeUnit, Verdict, WINDOW, identify, rate_of, told,
};
use squealmap_input::files;
use squealmap_input::quote::one_line;
use std::fmt::Write;
use std::io::Read;
use std::path::PathBuf;

use clap::Args;

/// The files that are written.
const FILES: [&str; 6] =
    ["figure.json", "identify.json", "identify.png", "identify.svg", "spectrogram.nc", "windows.csv"];

/// Arguments of `identify`.
#[derive(Debug, Args)]
pub(crate) struct Identify {
    /// Measured signals: CSV with a header, separated by commas, semicolons or tabs
    signals: PathBuf,
    /// Output directory [default: out/<name of the file>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Column of time [default: t or time, with a unit or without: `t_ms`, `Time (ms)`]
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// Unit of the column of time: s, ms, us, ns, min or h [default: that of its header, or s]
    #[arg(long, value_name = "UNIT", value_parser = time_unit)]
    time_unit: Option<TimeUnit>,
    /// Samples per second instead of a column of time: 51200, 51200Hz or 51.2kHz
    #[arg(long, value_name = "HZ", value_parser = rate)]
    rate: Option<f64>,
    /// Column of the tangential acceleration, m/s² [default: ax2]
    #[arg(long, value_name = "COLUMN")]
    tangential_acceleration: Option<String>,
    /// Column of the normal acceleration, m/s² [default: ay1]
    #[arg(long, value_name = "COLUMN")]
    normal_acceleration: Option<String>,
    /// Column of the tangential force, N [default: T]
    #[arg(long, value_name = "COLUMN")]
    tangential_force: Option<String>,
    /// Column of the normal force, N, positive in compression [default: N]
    #[arg(long, value_name = "COLUMN")]
    normal_force: Option<String>,
    /// Column of the sliding velocity, m/s [default: V]
    #[arg(long, value_name = "COLUMN")]
    velocity: Option<String>,
    /// Column of the temperature, °C [default: temperature]
    #[arg(long, value_name = "COLUMN")]
    temperature: Option<String>,
    /// Delay of the normal acceleration behind the tangential one, s
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite)]
    skew: f64,
    /// Delay of the forces behind the tangential acceleration, s
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_hyphen_values = true, value_parser = finite)]
    force_skew: f64,
    /// Largest damping ratio the structure may have without friction
    #[arg(long, value_name = "RATIO", default_value_t = DAMPING_RATIO, value_parser = ratio)]
    damping_ratio: f64,
    /// Largest inclination of the structure to the contact, rad
    #[arg(long, value_name = "RAD", default_value_t = INCLINATION, value_parser = ratio)]
    inclination: f64,
    /// Frequencies in which to look for the oscillation, Hz; nothing is filtered
    #[arg(long, value_name = "LOW,HIGH", value_parser = band)]
    band: Option<[f64; 2]>,
    /// Window of the spectrogram, s
    #[arg(long, value_name = "S", default_value_t = WINDOW, value_parser = positive)]
    window: f64,
    /// Overlap of its windows
    #[arg(long, value_name = "PART", default_value_t = OVERLAP, value_parser = ratio)]
    overlap: f64,
    /// Largest T/N that is believed
    #[arg(long, value_name = "MU", default_value_t = LARGEST_FRICTION, value_parser = positive)]
    largest_friction: f64,
    /// Friction coefficient at which the modes coalesce, and its standard error, from `squealmap modes` or a test: 0.23 or 0.23,0.01
    #[arg(long, value_name = "MU[,ERROR]", value_parser = critical)]
    critical_friction: Option<Measured>,
    /// Instants at which the figure looks close, s: 0.12,0.25 [default: in the middles of the longest segments that vibrate]
    #[arg(long, value_name = "S,…", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    zoom: Vec<f64>,
}

impl Identify {
    pub(crate) fn execute(self) -> Result<()> {
        let name = self.signals.display().to_string();
        let heading = one_line(&self.signals.file_stem().unwrap_or_default().to_string_lossy());
        let asked = self.output.clone();
        let path = self.signals.clone();
        let settings = self.settings();
        let output = prepare_beside(&path, asked.as_deref(), &FILES)?;
        // Read up to three times, which a pipe cannot be.
        let open =
            || files::open(&path).map(|file| Box::new(file) as Box<dyn Read>).map_err(std::io::Error::other);
        let mut windows = output.draft(FILES[5])?;
        let mut table = WindowsCsv::new(windows.file())?;
        let found = identify(open, &name, &settings, &mut |window, reading| table.add(window, reading))?;
        table.finish()?;
        let shown = Shown::new(&found, &heading);
        let svg = report::identify_svg(&shown, &Look::default())?;
        let files = [
            (FILES[0], shown.document()?),
            (FILES[1], report::report_json(&found, &name)?),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
            (FILES[4], spectrogram_nc(&found.spectrogram, &heading)),
        ];
        let paths = output.write_beside(&files, vec![windows])?;
        print(&(summary(&found) + &list(&paths)));
        Ok(())
    }

    fn settings(self) -> Settings {
        Settings {
            time: self.time,
            time_unit: self.time_unit,
            rate: self.rate,
            columns: [
                self.tangential_acceleration,
                self.normal_acceleration,
                self.tangential_force,
                self.normal_force,
                self.velocity,
                self.temperature,
            ],
            skew: self.skew,
            force_skew: self.force_skew,
            damping_ratio: self.damping_ratio,
            inclination: self.inclination,
            band: self.band,
            window: self.window,
            overlap: self.overlap,
            largest_friction: self.largest_friction,
            critical_friction: self.critical_friction,
            zooms: self.zoom,
        }
    }
}

/// The segments with what each witness says, and the verdict of the growth.
fn summary(found: &Identification) -> String {
    let mut text = format!("{}\n", told(&found.segments));
    for segment in &found.segments {
        let [start, end] = segment.time;
        let Verdict { kind, reasons, .. } = &segment.verdict;
        let confidence = segment.verdict.shown_confidence();
        let slow = segment.friction.is_none_or(|friction| friction.reading != FrictionReading::Within);
        let at = segment.frequency.map_or(String::new(), |frequency| format!(" at {frequency:.1} Hz"));
        let _ = writeln!(
            text,
            "{start:.4} to {end:.4} s, {}{at}: {} (confidence {confidence:.2})",
            segment.state.words(),
            kind.words()
        );
        if let Some((mechanism, probability)) = segment.shared {
            let _ = writeln!(text, "  in any case: {} (confidence {probability:.2})", mechanism.words());
        }
        for reason in reasons {
            let _ = writeln!(text, "  {reason}");
        }
        if !segment.rests_on.is_empty() {
            let rests: Vec<&str> = segment.rests_on.iter().map(|witness| witness.words()).collect();
            let joint = rate_of(None, slow).map_or(String::new(), |rate| format!("; together: {rate}"));
            let _ = writeln!(text, "  rests on {}{joint}", rests.join(", "));
        }
        for testimony in &segment.testimonies {
            let said = testimony.chances.map_or("cannot speak".to_owned(), |chances| {
                let (kind, probability) = chances.leading();
                let tried =
                    rate_of(Some(testimony.witness), slow).map_or(String::new(), |rate| format!(" ({rate})"));
                format!("{} {:.0} %{tried}", kind.words(), 100.0 * probability)
            });
            let _ = writeln!(text, "  {}: {said}: {}", testimony.witness.words(), testimony.evidence);
        }
        for contradiction in &segment.contradictions {
            let _ = writeln!(text, "  contradiction: {contradiction}");
        }
    }
    if found.segments.is_empty() {
        let verdict = &found.verdict;
        let _ = writeln!(text, "{} (confidence {:.2})", verdict.kind.words(), verdict.shown_confidence());
        for reason in &verdict.reasons {
            let _ = writeln!(text, "  {reason}");
        }
    }
    if let Some(friction) = found.slope {
        let (slope, [low, high]) = (friction.slope, friction.velocity);
        let _ = writeln!(
            text,
            "mean friction changes by {} s/m between {low:.3} and {high:.3} m/s",
            slope.text(1.0, 5)
        );
    }
    let _ = writeln!(
        text,
        "{} samples at {:.1} Hz, {} window(s), {} episode(s) of growth",
        found.samples,
        found.rate,
        found.windows,
        found.episodes.len()
    );
    for note in &found.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

/// A unit of time.
fn time_unit(text: &str) -> std::result::Result<TimeUnit, String> {
    let names = TimeUnit::ALL.map(TimeUnit::name).join(", ");
    TimeUnit::parse(text).ok_or_else(|| format!("must be one of {names}"))
}

/// A rate in Hz; one without a unit has to be that of a sensor.
fn rate(text: &str) -> std::result::Result<f64, String> {
    /// Units of a rate with what they are in Hz; `hz` is the end of the others.
    const UNITS: [(&str, f64); 3] = [("khz", 1e3), ("mhz", 1e6), ("hz", 1.0)];
    let lower = text.to_lowercase();
    let with_unit = UNITS.iter().find_map(|(unit, hertz)| Some((lower.strip_suffix(unit)?, hertz)));
    if let Some((value, hertz)) = with_unit {
        return positive(value.trim()).map(|value| value * hertz);
    }
    let value = positive(text)?;
    let [slowest, fastest] = RATES;
    if (slowest..=fastest).contains(&value) {
        return Ok(value);
    }
    Err(format!(
        "sensors of vibrations have {slowest} to {fastest} samples per second; say its unit: --rate {value}kHz, or --rate {value}Hz if \
         they are so many"
    ))
}

fn ratio(text: &str) -> std::result::Result<f64, String> {
    number(text, |x| (0.0..1.0).contains(&x), "a number from 0 to below 1")
}

/// A friction coefficient and its standard error, a thirtieth of it where none is given.
fn critical(text: &str) -> std::result::Result<Measured, String> {
    const WORDS: &str = "a friction coefficient, and after a comma its standard error, such as 0.23,0.01";
    let (value, error) = text.split_once(',').map_or((text, None), |(value, error)| (value, Some(error)));
    let positive = |text: &str| number(text.trim(), |x| x > 0.0, WORDS);
    let value = positive(value)?;
    Ok(Measured { value, error: error.map_or(Ok(value / 30.0), positive)? })
}

fn band(text: &str) -> std::result::Result<[f64; 2], String> {
    let words = "two frequencies such as 1000,20000, the lower one first";
    let (low, high) = text.split_once(',').ok_or_else(|| format!("must be {words}"))?;
    let [low, high] = [low, high].map(|part| number(part.trim(), |x| x >= 0.0, words));
    match (low?, high?) {
        (low, high) if low < high => Ok([low, high]),
        _ => Err(format!("must be {words}")),
    }
}
