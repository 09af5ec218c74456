//! A few periods of both accelerations at instants all over a record, for pictures that look close.

use crate::block::Block;
use crate::channel::Channel;
use crate::segment::{Segment, State};

/// Instants that are kept beside those that are asked for: a segment that is not short has one of them near its middle.
const SPREAD: u64 = 64;
/// Periods that are shown.
const PERIODS: f64 = 6.0;
/// The most samples of a clip.
const MOST: usize = 2000;
/// Clips that are shown where no instants are asked for.
const SHOWN: usize = 3;

/// Samples in a row.
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
pub struct Clip {
    /// The time of the first sample, s.
    pub start: f64,
    /// Between samples, s.
    pub step: f64,
    /// Tangential and normal acceleration, m/s²; the latter empty where it is not recorded.
    pub accelerations: [Vec<f64>; 2],
}

impl Clip {
    /// The middle, s.
    #[must_use]
    pub fn middle(&self) -> f64 {
        self.start + 0.5 * self.step * self.accelerations[0].len() as f64
    }
}

/// Collects clips while the record goes by.
pub(super) struct Clips {
    /// In order of time: the first sample of each, and whether it was asked for.
    all: Vec<(u64, bool, Clip)>,
    length: u64,
    normal: bool,
    taken: u64,
}

impl Clips {
    /// For a record of `samples` at `rate` (Hz) from `start` (s) on with an oscillation of `frequency` (Hz); `asked`: middles
    /// of the clips that are asked for, s.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive numbers of samples"
    )]
    pub(super) fn new(
        samples: u64,
        [rate, start]: [f64; 2],
        frequency: Option<f64>,
        normal: bool,
        asked: &[f64],
    ) -> Clips {
        let length = frequency.map_or(0, |frequency| (PERIODS * rate / frequency).ceil() as usize).min(MOST);
        let fits = samples.saturating_sub(length as u64);
        let from = |middle: f64| ((middle * rate - 0.5 * length as f64).max(0.0) as u64).min(fits);
        let spread = (0..SPREAD).map(|k| {
            let part = (k as f64 + 0.5) / SPREAD as f64;
            (from(part * samples as f64 / rate), false)
        });
        let end = start + samples as f64 / rate;
        let asked =
            asked.iter().filter(|time| (start..=end).contains(*time)).map(|time| (from(time - start), true));
        let mut places: Vec<(u64, bool)> =
            if length == 0 { Vec::new() } else { spread.chain(asked).collect() };
        places.sort_unstable();
        let clip = |(first, asked): (u64, bool)| {
            let start = start + first as f64 / rate;
            (first, asked, Clip { start, step: 1.0 / rate, ..Clip::default() })
        };
        let all = places.into_iter().map(clip).collect();
        Clips { all, length: length as u64, normal, taken: 0 }
    }

    pub(super) fn take(&mut self, block: &Block) {
        for (first, _, clip) in &mut self.all {
            let own = [*first, *first + self.length];
            let of = |channel: Channel| block.within(channel, own, self.taken);
            clip.accelerations[0].extend_from_slice(of(Channel::TangentialAcceleration));
            if self.normal {
                clip.accelerations[1].extend_from_slice(of(Channel::NormalAcceleration));
            }
        }
        self.taken += block.len() as u64;
    }

    /// The clips that were asked for; without any, those in the middles of the longest segments that vibrate.
    pub(super) fn finish(self, segments: &[Segment]) -> Vec<Clip> {
        let asked: Vec<Clip> =
            self.all.iter().filter(|(_, asked, _)| *asked).map(|(_, _, clip)| clip.clone()).collect();
        if !asked.is_empty() {
            return asked;
        }
        let mut loud: Vec<&Segment> =
            segments.iter().filter(|segment| segment.state != State::Quiet).collect();
        let length = |segment: &Segment| segment.time[1] - segment.time[0];
        loud.sort_by(|a, b| length(b).total_cmp(&length(a)));
        loud.truncate(SHOWN);
        loud.sort_by(|a, b| a.time[0].total_cmp(&b.time[0]));
        let of = |segment: &Segment| {
            let middle = 0.5 * (segment.time[0] + segment.time[1]);
            let off = |clip: &Clip| (clip.middle() - middle).abs();
            let inside = self.all.iter().map(|(_, _, clip)| clip).filter(|clip| {
                clip.start >= segment.time[0] && 2.0 * clip.middle() - clip.start <= segment.time[1]
            });
            inside.min_by(|a, b| off(a).total_cmp(&off(b))).cloned()
        };
        loud.into_iter().filter_map(of).collect()
    }
}
