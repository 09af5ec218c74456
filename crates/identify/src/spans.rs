//! The third reading of a file: the samples of its episodes, and what a fit to them tells.

use crate::block::Block;
use crate::channel::Channel;
use crate::course::course;
use crate::cross::Ratio;
use crate::episode::{Episode, Recorded};
use crate::fault::Fault;
use crate::feedback::{Feedback, Skews};
use crate::restore::Samples;
use crate::settings::Settings;
use crate::sharpen::{AFTER, MOST, Sharpened, Span, sharpen};
use crate::verdict::{Setting, Verdict, judge};
use crate::window::Geometry;

/// The channels of a fit; the tangential acceleration is the first.
const FITTED: [Channel; 4] = [
    Channel::TangentialAcceleration,
    Channel::NormalAcceleration,
    Channel::TangentialForce,
    Channel::NormalForce,
];

/// E-foldings by which linear growth tells whether it is driven.
const ENOUGH: f64 = 1.5;

/// That number of e-foldings where the oscillation was there before.
const FIFTYFOLD: f64 = 4.0;

/// The knowledge of the record from its other readings.
pub(super) struct Known<'a> {
    pub(super) recorded: Recorded,
    pub(super) settings: &'a Settings,
    pub(super) geometry: Geometry,
    /// Samples per second, Hz.
    pub(super) rate: f64,
    /// The time of the first sample, s.
    pub(super) start: f64,
}

/// An episode whose samples are being read.
struct Open {
    episode: usize,
    /// First sample, the one after the last that windows have seen, and the one after the last of the span.
    samples: [u64; 3],
    channels: Vec<Vec<f64>>,
}

/// Reads the samples of the episodes and replaces what windows tell of each by what a fit tells. Memory: the samples of
/// one episode, at most.
pub(super) fn sharpened(
    mut again: Samples<'_>,
    episodes: &mut [Episode],
    known: &Known,
) -> Result<(), Fault> {
    let channels = known.fitted();
    let mut waiting: Vec<Open> =
        episodes.iter().enumerate().map(|(number, episode)| known.open(number, episode)).collect();
    waiting.reverse();
    let mut reading: Vec<Open> = Vec::new();
    let (mut block, mut first) = (Block::default(), 0);
    while !(waiting.is_empty() && reading.is_empty()) && again.next(&mut block)? {
        let end = first + block.len() as u64;
        while let Some(next) = waiting.pop_if(|next| next.samples[0] < end) {
            reading.push(next);
        }
        for open in &mut reading {
            let [from, _, to] = open.samples;
            for (values, channel) in open.channels.iter_mut().zip(&channels) {
                values.extend_from_slice(block.within(*channel, [from, to], first));
            }
        }
        first = end;
        for done in reading.extract_if(.., |open| open.samples[2] <= end) {
            known.close(&mut episodes[done.episode], done);
        }
    }
    // The record ends where the growth of its last episode might still go on.
    for open in reading {
        known.close(&mut episodes[open.episode], open);
    }
    Ok(())
}

impl Known<'_> {
    fn fitted(&self) -> Vec<Channel> {
        let recorded = |channel: &Channel| match channel {
            Channel::NormalAcceleration => self.recorded.normal_acceleration,
            Channel::TangentialForce | Channel::NormalForce => self.recorded.forces,
            _ => true,
        };
        FITTED.into_iter().filter(recorded).collect()
    }

    /// The samples that an episode needs: those before its end that are fitted, and those after it where its growth may end.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive numbers of samples"
    )]
    fn open(&self, number: usize, episode: &Episode) -> Open {
        let [first, last] = episode.windows.map(|window| (window * self.geometry.hop) as u64);
        let seen = last + self.geometry.window as u64;
        let after = (AFTER * self.rate / episode.growth.value).min(MOST as f64) as u64;
        let samples = [first.max(seen.saturating_sub(2 * MOST as u64)), seen, seen + after];
        Open { episode: number, samples, channels: vec![Vec::new(); self.fitted().len()] }
    }

    /// Fits what was read of an episode.
    fn close(&self, episode: &mut Episode, open: Open) {
        let [first, seen, _] = open.samples;
        let end = usize::try_from(seen - first).unwrap_or(usize::MAX);
        let span = Span { channels: open.channels, rate: self.rate, end };
        let (growth, frequency) = (episode.growth.value, episode.frequency);
        let sharp = sharpen(&span, growth, frequency);
        let whole = course(&span, span.end, growth, frequency);
        // Windows may see a little more than the linear growth: that alone must not decide, where enough is linear.
        let alone = |sharp: &Sharpened| {
            let gain = sharp.linear.value * sharp.end as f64 / self.rate;
            gain < ENOUGH || course(&span, sharp.end, growth, frequency).driven.is_some()
        };
        let driven = whole.driven.filter(|_| sharp.as_ref().is_none_or(alone));
        if let Some(reason) = driven {
            episode.verdict = Verdict::undecided(reason);
            episode.wanders = true;
        }
        if let Some(sharp) = sharp {
            let end = self.start + (first as f64 + sharp.end as f64) / self.rate;
            self.replace(episode, &sharp, end);
        } else if let Some(growth) = whole.growth {
            // Most of what windows saw is saturated already: no exponential fits, but its beginning still shows.
            self.judged(episode, Feedback { growth, ..episode.feedback }, episode.distortion);
        }
        if let Some([low, high]) =
            self.settings.band.filter(|[low, high]| !(low..=high).contains(&&episode.frequency))
        {
            episode.verdict = Verdict::undecided(format!(
                "the oscillation lies outside of the band that was looked at, {low} to {high} Hz (--band); move it"
            ));
            episode.wanders = true;
        }
        if episode.preceded && episode.gain < FIFTYFOLD && !episode.wanders {
            episode.verdict = Verdict::undecided(
                "the oscillation was there before it grew, and too little of its growth is exponential (less than fiftyfold) to \
                 tell an instability from a vibration that is driven; record what drives it",
            );
            episode.wanders = true;
        }
    }

    /// Judges an episode anew with a better known feedback and distortion.
    fn judged(&self, episode: &mut Episode, feedback: Feedback, distortion: f64) {
        let setting = Setting {
            forces: self.recorded.forces,
            normal_acceleration: self.recorded.normal_acceleration,
            settings: self.settings,
            distortion,
            episode: true,
        };
        if !episode.wanders {
            episode.verdict = judge(&feedback, &setting);
        }
        episode.growth = feedback.growth;
        episode.feedback = feedback;
    }

    /// Takes what the fit tells of an episode, which ends at `end` (s).
    fn replace(&self, episode: &mut Episode, sharp: &Sharpened, end: f64) {
        let Sharpened { mode, linear, .. } = sharp;
        let channels = self.fitted();
        let of = |channel: Channel| channels.iter().position(|fitted| *fitted == channel);
        let ratio = |channel: Channel| of(channel).map(|q| mode.ratio(q, 0)).unwrap_or_default();
        let mean = |channel: Channel| of(channel).map(|q| mode.channels[q].mean);
        let settings = self.settings;
        let accelerations = ratio(Channel::NormalAcceleration);
        // Restored forces have the noise of the accelerations: those of the fitted mode have less.
        let [pulled, pressed] = match settings.rig {
            Some(rig) => rig.ratios(*linear, mode.omega, accelerations.advanced(mode.omega * settings.skew)),
            None => [ratio(Channel::TangentialForce), ratio(Channel::NormalForce)],
        };
        let normal_force = mean(Channel::NormalForce);
        let friction = mean(Channel::TangentialForce).zip(normal_force).map(|(t, n)| t / n);
        let mu = friction.unwrap_or(0.0);
        let change = Ratio {
            value: pulled.value - mu * pressed.value,
            error: pulled.error.hypot(mu * pressed.error),
            ..pulled
        };
        let skews = Skews { acceleration: settings.skew, force: settings.force_skew };
        let ratios = [accelerations, pressed, change];
        let feedback = Feedback::from_ratios(ratios, *linear, mode.omega, mu, skews).of(settings.rig);
        // The fit has harmonics of its own.
        self.judged(episode, feedback, 0.0);
        episode.time[1] = end;
        episode.gain = mode.growth.value * (end - episode.time[0]);
        episode.frequency = mode.omega / std::f64::consts::TAU;
        episode.friction = friction.or(episode.friction);
        episode.measured(self.recorded, normal_force);
    }
}
