//! The spine: survey the file, read it again window by window, find episodes, read these again, conclude.

use std::io::Read;

use super::channel::{Channel, PerChannel};
use super::conclude::{Friction, conclude, quasi_static_slope};
use super::envelope::Envelope;
use super::episode::{Episode, Recorded, episodes, swapped};
use super::fault::Fault;
use super::read::Table;
use super::reading::{Reading, reading};
use super::settings::Settings;
use super::spans::{Known, sharpened};
use super::spectrogram::{Builder, Spectrogram};
use super::survey::{Survey, survey};
use super::verdict::Verdict;
use super::window::{Analyser, Geometry, Window};
use crate::error::{Error, Result};

/// Everything found in a file of signals.
#[derive(Clone, Debug)]
pub struct Identification {
    /// Samples of the record.
    pub samples: u64,
    /// Samples per second, Hz.
    pub rate: f64,
    /// Start and end of the record, s.
    pub time: [f64; 2],
    /// The column of each channel, in the order of [`Channel::ALL`]; empty where the file has none.
    pub columns: [String; Channel::ALL.len()],
    /// The strongest oscillation of the record, Hz; `None`: none stands out.
    pub frequency: Option<f64>,
    /// The windows in order of time.
    pub windows: Vec<Window>,
    /// The growing oscillations in order of time.
    pub episodes: Vec<Episode>,
    /// Slope of the mean friction coefficient against the mean velocity of the quiet windows.
    pub slope: Option<Friction>,
    /// The verdict on the record.
    pub verdict: Verdict,
    /// Remarks: what limits the analysis.
    pub notes: Vec<String>,
    /// The spectrogram of the tangential acceleration.
    pub spectrogram: Spectrogram,
    /// Tangential and normal acceleration for a picture.
    pub envelopes: [Envelope; 2],
    recorded: Recorded,
    settings: Settings,
    /// `None`: no window fits.
    geometry: Option<Geometry>,
}

impl Identification {
    /// Phase, feedback and verdict of one window alone.
    #[must_use]
    pub fn read(&self, window: &Window) -> Reading {
        reading(window, self.recorded, &self.settings)
    }
}

/// Analyses the signals that `open` reads (called up to three times: the file is read anew and never held), named `name` in
/// messages.
///
/// # Errors
/// [`Error::Signals`] when the file cannot be read or is not fit for analysis: which column, where, what to do.
pub fn identify(
    mut open: impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
) -> Result<Identification> {
    let mut table = || -> std::result::Result<Table, Fault> {
        let input = open().map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        Table::open(input, settings)
    };
    let named = |fault| Error::Signals { name: name.to_owned(), fault: Box::new(fault) };
    let survey = table().and_then(|table| survey(table, settings)).map_err(named)?;
    let too_short = survey.too_short();
    let mut found = table().and_then(|table| analyse(table, survey, settings)).map_err(named)?;
    if let Some(geometry) = found.geometry.filter(|_| !found.episodes.is_empty()) {
        let Identification { recorded, rate, time: [start, _], .. } = found;
        let known = Known { recorded, settings, geometry, rate, start };
        table().and_then(|table| sharpened(table, &mut found.episodes, &known)).map_err(named)?;
    }
    found.verdict = conclude(&found.windows, &found.episodes, found.recorded, too_short, found.samples);
    Ok(found)
}

/// The second reading.
fn analyse(
    mut table: Table,
    survey: Survey,
    settings: &Settings,
) -> std::result::Result<Identification, Fault> {
    let Survey { samples, start, rate, .. } = survey;
    let has = |channel: Channel| survey.has[channel as usize];
    let recorded = Recorded {
        normal_acceleration: has(Channel::NormalAcceleration),
        forces: has(Channel::TangentialForce) && has(Channel::NormalForce),
    };
    let fits = survey.geometry().filter(|geometry| geometry.window as u64 <= samples);
    let mut analyser = fits.map(|geometry| Analyser::new(geometry, rate, survey.has, settings.band));
    let mut spectrogram = Builder::new(settings, samples, rate, start, survey.frequency);
    let mut envelopes = [Envelope::new(samples), Envelope::new(samples)];
    let mut waiting = PerChannel::<Vec<f64>>::default();
    let mut windows: Vec<Window> = Vec::new();
    let mut from: u64 = 0;
    while let Some(row) = table.next()? {
        let tangential = row.values[Channel::TangentialAcceleration as usize];
        spectrogram.take(tangential);
        envelopes[0].take(tangential);
        if recorded.normal_acceleration {
            envelopes[1].take(row.values[Channel::NormalAcceleration as usize]);
        }
        let (Some(analyser), Some(geometry)) = (&mut analyser, fits) else { continue };
        waiting.iter_mut().zip(row.values).for_each(|(waiting, value)| waiting.push(value));
        if waiting[0].len() == geometry.window {
            let at = start + from as f64 / rate;
            windows.push(analyser.window(at, &waiting.each_ref().map(Vec::as_slice)));
            for waiting in &mut waiting {
                waiting.drain(..geometry.hop);
            }
            from += geometry.hop as u64;
        }
    }
    let episodes = episodes(&windows, recorded, settings);
    if let Some(time) = swapped(&episodes, recorded) {
        let name = |channel: Channel| survey.names[channel as usize].clone();
        let [tangential, normal] = [Channel::TangentialAcceleration, Channel::NormalAcceleration].map(name);
        return Err(Fault::SwappedAccelerations { tangential, normal, time });
    }
    Ok(Identification {
        samples,
        rate,
        time: [start, start + samples as f64 / rate],
        frequency: survey.frequency,
        // Concluded when the episodes are known in full.
        verdict: Verdict::undecided("not concluded"),
        slope: quasi_static_slope(&windows, &episodes),
        notes: notes(&survey),
        columns: survey.names,
        windows,
        episodes,
        spectrogram: spectrogram.finish(),
        envelopes,
        recorded,
        settings: settings.clone(),
        geometry: fits,
    })
}

/// What limits the analysis.
fn notes(survey: &Survey) -> Vec<String> {
    let mut notes = Vec::new();
    for channel in &survey.constant {
        let column = &survey.names[*channel as usize];
        notes.push(format!("column `{column}` ({}) is constant", channel.words()));
    }
    for channel in Channel::ALL.into_iter().filter(|channel| !survey.has[*channel as usize]) {
        let limits = match channel {
            Channel::NormalAcceleration => ": no phase between the accelerations",
            Channel::TangentialForce | Channel::NormalForce => {
                ": no friction coefficient and no cause of an instability"
            }
            Channel::Velocity => ": no slope of the mean friction coefficient",
            _ => continue,
        };
        notes.push(format!("{} is not recorded{limits}; name it with {}", channel.words(), channel.flag()));
    }
    notes
}
