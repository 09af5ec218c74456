//! The options of commands that read measured signals.

use crate::cli::error::{Error, Result};
use crate::cli::numbers::{finite, number, positive};
use clap::Args;
use squealmap::study::identify::rig::rig_of;
use squealmap::sweep::spec::Spec;
use squealmap_identify::{
    DAMPING_RATIO, INCLINATION, LARGEST_FRICTION, Measured, OVERLAP, RATES, Settings, TimeUnit, WINDOW,
};
use std::path::PathBuf;

/// What the columns are, and what is known of the structure.
#[derive(Clone, Debug, Args)]
pub(crate) struct SignalOptions {
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
    /// Sweep file of the rig, as `squealmap calibrate` writes it: forces that slow sensors do not show are taken from the accelerations
    #[arg(long, value_name = "SWEEP", conflicts_with = "force_skew")]
    model: Option<PathBuf>,
    /// Largest damping ratio the structure may have without friction [default: that of --model, or 0.002]
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    damping_ratio: Option<f64>,
    /// Largest inclination of the structure to the contact, rad [default: that of --model, or 0.02]
    #[arg(long, value_name = "RAD", value_parser = ratio)]
    inclination: Option<f64>,
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
    /// [default: that of --model]
    #[arg(long, value_name = "MU[,ERROR]", value_parser = critical)]
    critical_friction: Option<Measured>,
}

impl SignalOptions {
    /// The settings of an analysis.
    ///
    /// # Errors
    /// For a model that is none.
    pub(crate) fn settings(self) -> Result<Settings> {
        let rig = self.model.map(|path| Ok::<_, Error>(rig_of(&Spec::read(&path)?)?)).transpose()?;
        let damping_ratio = rig.map(|rig| rig.damping_ratio());
        let inclination = rig.map(|rig| rig.theta.abs());
        Ok(Settings {
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
            damping_ratio: self.damping_ratio.or(damping_ratio).unwrap_or(DAMPING_RATIO),
            inclination: self.inclination.or(inclination).unwrap_or(INCLINATION),
            band: self.band,
            window: self.window,
            overlap: self.overlap,
            largest_friction: self.largest_friction,
            critical_friction: self.critical_friction,
            rig,
            ..Settings::default()
        })
    }
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
