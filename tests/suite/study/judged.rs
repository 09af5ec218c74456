//! 200 synthetic strokes whose type and phase are known, and what `identify` makes of them.

use crate::study::bound::{decidable, phase_bound};
use crate::study::strokes::{Random, Stroke, Wanted, add_noise, csv, run, stroke};
use squealmap_identify::{Identification, Kind, Settings};

/// The seed of the table: strokes, noise and skews follow from it.
pub(crate) const SEED: u64 = 1;
/// Signal-to-noise ratios, dB.
pub(crate) const RATIOS: [f64; 5] = [40.0, 30.0, 20.0, 10.0, 0.0];
/// From this ratio on verdicts are held to the requirements, dB.
pub(crate) const GOOD: f64 = 20.0;
/// Sampling rates, Hz.
const RATES: [f64; 2] = [200e3, 51.2e3];
/// How many strokes of each kind there are per ratio and rate.
const SHARES: [(Wanted, usize); 6] = [
    (Wanted::Stable, 6),
    (Wanted::Slope, 4),
    (Wanted::Coupling, 5),
    (Wanted::Both, 3),
    (Wanted::BothOneWeak, 1),
    (Wanted::Interaction, 1),
];
/// Largest skew of the normal acceleration, s.
const LARGEST_SKEW: f64 = 20e-6;
/// Bound on the damping ratio that the analysis is given: that of the strokes.
const DAMPING_RATIO: f64 = 1e-3;

/// One stroke of the table and what was found.
pub(crate) struct Judged {
    pub(crate) wanted: Wanted,
    pub(crate) ratio: f64,
    pub(crate) skew_known: bool,
    /// `None`: named and not analysed.
    pub(crate) found: Option<Identification>,
    pub(crate) true_phase: f64,
    /// Standard error of the phase that no estimator can do without, degrees.
    pub(crate) bound: f64,
    /// Whether the signals could tell the cause if they were free of noise.
    #[allow(dead_code, reason = "the benchmark shows it")]
    pub(crate) decidable: bool,
    #[allow(dead_code, reason = "the benchmark shows it")]
    pub(crate) rate: f64,
}

impl Judged {
    pub(crate) fn kind(&self) -> Option<Kind> {
        self.found.as_ref().map(|found| found.verdict.kind)
    }

    /// Whether a confident verdict is wrong. Of two mechanisms of which one is weak the other is the cause, and both
    /// are named rightly, too.
    pub(crate) fn wrong(&self) -> bool {
        let right: &[Kind] = match self.wanted {
            Wanted::Stable => &[Kind::NoInstability],
            Wanted::Slope => &[Kind::NegativeSlope],
            Wanted::Coupling => &[Kind::ModeCoupling],
            Wanted::Both => &[Kind::Both],
            Wanted::BothOneWeak => &[Kind::NegativeSlope, Kind::ModeCoupling, Kind::Both],
            Wanted::Interaction => &[],
        };
        self.kind().is_some_and(|kind| kind != Kind::Undecided && !right.contains(&kind))
    }

    pub(crate) fn is_confident(&self) -> bool {
        self.kind().is_some_and(|kind| kind != Kind::Undecided)
    }

    /// Error of the phase of the last episode and the standard error that it states, degrees, where the skew is known
    /// and the oscillation grows.
    pub(crate) fn phase(&self) -> Option<[f64; 2]> {
        let phase = self.found.as_ref()?.episodes.last()?.phase?;
        let unstable = self.wanted != Wanted::Stable;
        let off = (phase.value - self.true_phase + 180.0).rem_euclid(360.0) - 180.0;
        (self.skew_known && unstable).then_some([off, phase.error])
    }

    pub(crate) fn phase_error(&self) -> Option<f64> {
        self.phase().map(|[off, _]| off)
    }

    /// A phase more than 2° off where the bound is below 1°.
    pub(crate) fn phase_is_bad(&self) -> bool {
        self.bound < 1.0 && self.phase_error().is_some_and(|off| off.abs() > 2.0)
    }
}

/// The part of the phases within this many of their own standard errors, and how many there are.
pub(crate) fn within<'a>(strokes: impl IntoIterator<Item = &'a Judged>, errors: f64) -> (f64, usize) {
    let phases: Vec<[f64; 2]> = strokes.into_iter().filter_map(Judged::phase).collect();
    let inside = phases.iter().filter(|[off, error]| off.abs() <= errors * error).count();
    (inside as f64 / phases.len().max(1) as f64, phases.len())
}

/// The 200 strokes.
pub(crate) fn table(seed: u64) -> Vec<Judged> {
    let mut random = Random::new(seed);
    let mut judged = Vec::new();
    for ratio in RATIOS {
        for rate in RATES {
            for wanted in SHARES.iter().flat_map(|(wanted, count)| std::iter::repeat_n(*wanted, *count)) {
                let skew_known = judged.len() % 2 == 0;
                let skew = LARGEST_SKEW * random.uniform();
                let Stroke { instance, linear, mut samples } = stroke(wanted, rate, skew, &mut random);
                let [along, across, ..] = add_noise(&mut samples, ratio, &mut random);
                let settings = Settings {
                    skew: if skew_known { skew } else { 0.0 },
                    damping_ratio: DAMPING_RATIO,
                    ..Settings::default()
                };
                let found = run(&csv(&samples), &settings).ok();
                let true_phase = linear.phase.unwrap_or(f64::NAN);
                let bound = phase_bound(&instance, &linear, rate, [along, across]).unwrap_or(f64::NAN);
                let decidable = decidable(&instance, &linear, DAMPING_RATIO);
                judged.push(Judged { wanted, ratio, skew_known, found, true_phase, bound, decidable, rate });
            }
        }
    }
    judged
}

/// The worst and the median error of the phase at this ratio, degrees, and how many there are.
pub(crate) fn phase_errors(judged: &[Judged], ratio: f64) -> (f64, f64, usize) {
    let at = judged.iter().filter(|stroke| stroke.ratio >= ratio && stroke.ratio < ratio + 1.0);
    let mut errors: Vec<f64> = at.filter_map(Judged::phase_error).map(f64::abs).collect();
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN);
    (errors.last().copied().unwrap_or(f64::NAN), median, errors.len())
}

/// Confident verdicts among these strokes, in percent.
pub(crate) fn confident(strokes: &[&Judged]) -> usize {
    let count = strokes.iter().filter(|stroke| stroke.is_confident()).count();
    100 * count / strokes.len().max(1)
}
