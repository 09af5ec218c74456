//! The spine: survey the file, read it again window by window, find episodes, read these again, conclude.

use std::io::Read;

use crate::block::Block;
use crate::cells::{Cell, Cells};
use crate::channel::Channel;
use crate::clips::{Clip, Clips};
use crate::conclude::{Looked, conclude};
use crate::envelope::Envelope;
use crate::episode::{Episode, Recorded, swapped};
use crate::fault::{Fault, Unfit};
use crate::instants::{Instant, instants};
use crate::joint::judged;
use crate::misfit::misfit;
use crate::overview::{Friction, Overview};
use crate::read::Table;
use crate::reading::{Reading, reading};
use crate::restore::{Restoring, Samples};
use crate::runs::Runs;
use crate::segment::{Has, Segment, segments};
use crate::settings::Settings;
use crate::sliding::Sliding;
use crate::spans::{Known, sharpened};
use crate::spectrogram::{Builder, Spectrogram};
use crate::survey::{Survey, survey};
use crate::undisturbed::{Undisturbed, undisturbed};
use crate::verdict::Verdict;
use crate::window::{Analyser, Window};
use crate::within::PER_PERIOD;
use crate::witness::Structure;

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
    /// The strongest oscillation of the record, Hz; `None` where none stands out.
    pub frequency: Option<f64>,
    /// Number of windows.
    pub windows: usize,
    /// The growing oscillations in order of time.
    pub episodes: Vec<Episode>,
    /// Slope of the mean friction coefficient against the mean velocity of the quiet windows.
    pub slope: Option<Friction>,
    /// The verdict of the growth alone, on the record as a whole.
    pub verdict: Verdict,
    /// The segments of the record in order of time; empty where no oscillation stands out.
    pub segments: Vec<Segment>,
    /// Friction against velocity; empty without forces and velocity.
    pub undisturbed: Undisturbed,
    /// Remarks: what limits the analysis.
    pub notes: Vec<String>,
    /// Those of them that say what was read and how, where that is not plain.
    pub remarks: Vec<String>,
    /// The spectrogram of the tangential acceleration.
    pub spectrogram: Spectrogram,
    /// Tangential and normal acceleration for a picture.
    pub envelopes: [Envelope; 2],
    /// Mean friction coefficient of the windows for a picture, over [`Identification::friction_time`].
    pub friction: Envelope,
    /// What the record does over time, for a picture.
    pub course: Vec<Instant>,
    /// Both accelerations over a few periods, for a picture.
    pub clips: Vec<Clip>,
    /// Start of the first and end of the last window, s.
    pub friction_time: [f64; 2],
}

/// Analyses the signals that `open` reads (called up to three times: what is longer than some two million samples is read anew and never held), named `name` in
/// messages. `each` is given every window in order of time, with what it says by itself; none is kept.
///
/// # Errors
/// When the file cannot be read or is not fit for analysis: which column, where, what to do.
pub fn identify(
    mut open: impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
    each: &mut dyn FnMut(&Window, &Reading),
) -> Result<Identification, Unfit> {
    let mut table = || -> Result<Table, Fault> {
        let input = open().map_err(|why| Fault::Unreadable { why: why.to_string() })?;
        Table::open(input, settings)
    };
    let named = |fault| Unfit { name: name.to_owned(), fault: Box::new(fault) };
    let (survey, kept) = table().and_then(|table| survey(table, settings)).map_err(named)?;
    let (samples, too_short) = (survey.samples, survey.too_short());
    let given = settings;
    let settings = &given.directed(survey.turned);
    let restoring = restoring(&survey, settings).map_err(named)?;
    let (band, outside, unlike) = (settings.band, survey.outside, survey.unlike);
    let looked = Looked { samples, too_short, band, outside, unlike };
    let (mut found, overview, its_rig) = kept
        .again(survey.turned, &mut table)
        .map(|samples| Samples::new(samples, restoring))
        .and_then(|samples| analyse(samples, &survey, settings, each))
        .map_err(named)?;
    if let Some(geometry) = survey.windows().filter(|_| !found.episodes.is_empty()) {
        let Survey { rate, start, turned, .. } = survey;
        let known = Known { recorded: recorded(&survey), settings, geometry, rate, start };
        kept.again(turned, &mut table)
            .map(|samples| Samples::new(samples, restoring))
            .and_then(|samples| sharpened(samples, &mut found.episodes, &known))
            .map_err(named)?;
    }
    if !its_rig {
        for episode in &mut found.episodes {
            episode.verdict =
                Verdict::undecided("its forces are those of --model, which does not fit the record");
        }
    }
    let structure = Structure::new(if its_rig { settings } else { given });
    judged(&mut found.segments, &found.episodes, &found.course, structure);
    found.verdict = conclude(&overview, &found.episodes, &looked);
    Ok(found)
}

/// How the forces are restored; `None` where nothing vibrates, or no rig is given.
fn restoring(survey: &Survey, settings: &Settings) -> Result<Option<Restoring>, Fault> {
    let (Some(rig), Some(frequency), Some(_)) = (settings.rig, survey.frequency, survey.windows()) else {
        return Ok(None);
    };
    let needed =
        [Channel::NormalAcceleration, Channel::TangentialForce, Channel::NormalForce, Channel::Velocity];
    if let Some(channel) = needed.into_iter().find(|channel| !survey.has[*channel as usize]) {
        return Err(Fault::NotRestored { words: channel.words(), flag: channel.flag() });
    }
    let rate = survey.rate;
    if rate < PER_PERIOD * frequency {
        return Err(Fault::TooFewToRestore { frequency, samples: rate / frequency, least: PER_PERIOD });
    }
    Ok(Some(Restoring { rig, rate, frequency, skew: settings.skew }))
}

fn has(survey: &Survey) -> Has {
    let Recorded { normal_acceleration, forces } = recorded(survey);
    let [velocity, temperature] =
        [Channel::Velocity, Channel::Temperature].map(|channel| survey.has[channel as usize]);
    Has { normal_acceleration, forces, velocity, temperature }
}

fn recorded(survey: &Survey) -> Recorded {
    let has = |channel: Channel| survey.has[channel as usize];
    Recorded {
        normal_acceleration: has(Channel::NormalAcceleration),
        forces: has(Channel::TangentialForce) && has(Channel::NormalForce),
    }
}

/// The second time through the record.
fn analyse(
    mut again: Samples<'_>,
    survey: &Survey,
    settings: &Settings,
    each: &mut dyn FnMut(&Window, &Reading),
) -> Result<(Identification, Overview, bool), Fault> {
    let Survey { samples, start, rate, .. } = *survey;
    let recorded = recorded(survey);
    let fits = survey.windows();
    let mut analyser = fits.map(|geometry| Analyser::new(geometry, rate, survey.has, settings));
    let mut spectrogram = Builder::new(settings, samples, rate, start, survey.frequency);
    let mut envelopes = [Envelope::new(samples), Envelope::new(samples)];
    let normal = recorded.normal_acceleration;
    let mut clips = Clips::new(samples, [rate, start], survey.frequency, normal, &settings.zooms);
    let mut sliding = fits.map(|fits| Channel::ALL.map(|_| Sliding::new(fits.window, fits.hop)));
    let count = fits.map_or(0, |geometry| (samples - geometry.window as u64) / geometry.hop as u64 + 1);
    let mut friction = Envelope::new(count);
    let mut runs = Runs::new(recorded, settings);
    let mut overview = Overview::new(recorded);
    let mut cells = Cells::new(fits.map_or(0.0, |geometry| geometry.hop as f64 / rate));
    let mut from: u64 = 0;
    let mut block = Block::default();
    while again.next(&mut block)? {
        let tangential = block.of(Channel::TangentialAcceleration);
        spectrogram.take(tangential);
        clips.take(&block);
        envelopes[0].take(tangential);
        if recorded.normal_acceleration {
            envelopes[1].take(block.of(Channel::NormalAcceleration));
        }
        let (Some(analyser), Some(sliding)) = (&mut analyser, &mut sliding) else { continue };
        sliding.iter_mut().zip(block.columns()).for_each(|(sliding, values)| sliding.take(values));
        while sliding[0].window().is_some() {
            let at = start + from as f64 / rate;
            let window = analyser.window(at, &sliding.each_ref().map(|s| s.window().unwrap_or_default()));
            each(&window, &reading(&window, recorded, settings));
            runs.take(&window);
            overview.take(&window);
            cells.take(&window);
            if let Some(mu) = window.friction {
                friction.take(&[mu]);
            }
            sliding.iter_mut().for_each(Sliding::leave);
            from += fits.map_or(0, |fits| fits.hop as u64);
        }
    }
    let episodes = runs.finish();
    if let Some(time) = swapped(&episodes, recorded) {
        let name = |channel: Channel| survey.names[channel as usize].clone();
        let [tangential, normal] = [Channel::TangentialAcceleration, Channel::NormalAcceleration].map(name);
        return Err(Fault::SwappedAccelerations { tangential, normal, time });
    }
    let mut notes = notes(survey, settings);
    let has = has(survey);
    let mut cut = segments(&cells.list, has, settings);
    // Where nothing stands out nothing is restored, and nothing tells.
    let restored_from = again.restored_from();
    let rig = settings.rig.filter(|_| restored_from.is_some());
    let misfit = rig.and_then(|rig| misfit(&cut, &rig, Cell::sum(&cells.list).normal()));
    let its_rig = misfit.is_none();
    if let Some(why) = misfit {
        notes.push(why);
        cells.forget_fast_forces();
        cut = segments(&cells.list, has, settings);
    } else if let Some(frequency) = restored_from {
        notes.push(format!(
            "forces that are faster than a third of {frequency:.0} Hz are those that move the masses of the model, by the accelerations"
        ));
        if again.needless() {
            notes.push(
                "the force sensors follow the vibration: the forces that were taken are those of the model all the same; leave out --model \
                 for what was measured, and give what it says by --critical-friction, --damping-ratio and --inclination"
                    .to_owned(),
            );
        }
    }
    let friction_read = has.forces && has.velocity;
    let found = Identification {
        samples,
        rate,
        time: [start, start + samples as f64 / rate],
        frequency: survey.frequency,
        // Concluded when the episodes are known in full.
        verdict: Verdict::undecided("not concluded"),
        slope: overview.quasi_static_slope(&episodes),
        notes,
        remarks: survey.remarks.clone(),
        columns: survey.names.clone(),
        windows: overview.windows,
        course: instants(&cells.list, has, settings.skew),
        clips: clips.finish(&cut),
        segments: cut,
        undisturbed: if friction_read {
            undisturbed(&cells.list, has.temperature, settings.rows.is_some())
        } else {
            Undisturbed::default()
        },
        episodes,
        spectrogram: spectrogram.finish(),
        envelopes,
        friction,
        friction_time: overview.time,
    };
    Ok((found, overview, its_rig))
}

/// Sentences about everything that limits the analysis.
fn notes(survey: &Survey, settings: &Settings) -> Vec<String> {
    let mut notes: Vec<String> = survey.remarks.clone();
    if survey.turned {
        notes.push(
            "the stroke goes the other way: the signs of what points along the contact are turned".to_owned(),
        );
    }
    if let Some(own) =
        settings.rig.map(|rig| rig.damping_ratio()).filter(|own| settings.damping_ratio < 0.999 * own)
    {
        notes.push(format!(
            "--damping-ratio {} is below {own:.4}, the damping ratio of --model: that of the model counts",
            settings.damping_ratio
        ));
    }
    let [start, end] = [survey.start, survey.start + survey.samples as f64 / survey.rate];
    for time in settings.zooms.iter().filter(|time| !(start..=end).contains(*time)) {
        notes.push(format!(
            "nothing to look at close at {time} s (--zoom): the record lasts from {start:.6} to {end:.6} s"
        ));
    }
    for channel in &survey.constant {
        let column = &survey.names[*channel as usize];
        notes.push(format!("column `{column}` ({}) is constant", channel.words()));
    }
    for (channel, stand) in &survey.still {
        notes.push(format!(
            "column `{}` ({}) stands still at {} for {} samples from {:.6} s on: a dropout, unless everything rests there; cut the \
             record before it",
            survey.names[*channel as usize],
            channel.words(),
            stand.value,
            stand.count,
            survey.start + stand.first as f64 / survey.rate
        ));
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
