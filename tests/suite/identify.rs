//! Measured signals: identification on synthetic strokes whose type and phase are known.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::io::{Cursor, Read};
use std::path::Path;

use squealmap::Error;
use squealmap::export::signals::signals_csv;
use squealmap::identify::{Fault, Identification, Kind, Settings, alone, identify};
use squealmap::signals::Sample;

use crate::common::near;
use crate::strokes::{Field, FIELDS, Random, Stroke, Wanted, add_noise, stroke};

/// The seed of the table: strokes, noise and skews follow from it.
const SEED: u64 = 1;
/// Signal-to-noise ratios, dB.
const RATIOS: [f64; 5] = [40.0, 30.0, 20.0, 10.0, 0.0];
/// From this ratio on verdicts are held to the requirements, dB.
const GOOD: f64 = 20.0;
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

fn run(bytes: &[u8], settings: &Settings) -> Result<Identification, Error> {
    identify(|| Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Read>), "signals.csv", settings)
}

fn csv(samples: &[Sample]) -> Vec<u8> {
    signals_csv(samples, None).unwrap()
}

/// One stroke of the table and what was found.
struct Judged {
    wanted: Wanted,
    ratio: f64,
    skew_known: bool,
    /// `None`: named and not analysed.
    found: Option<Identification>,
    true_phase: f64,
}

impl Judged {
    fn kind(&self) -> Option<Kind> {
        self.found.as_ref().map(|found| found.verdict.kind)
    }

    /// Whether a confident verdict is wrong. Of two mechanisms of which one is weak the other is the cause, and both
    /// are named rightly, too.
    fn wrong(&self) -> bool {
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

    /// Error of the phase of the last episode, degrees, where the skew is known and the oscillation grows.
    fn phase_error(&self) -> Option<f64> {
        let episode = self.found.as_ref()?.episodes.last()?;
        let unstable = self.wanted != Wanted::Stable;
        let off = (episode.phase?.value - self.true_phase + 180.0).rem_euclid(360.0) - 180.0;
        (self.skew_known && unstable).then_some(off)
    }
}

/// The 200 strokes.
fn table(seed: u64) -> Vec<Judged> {
    let mut random = Random::new(seed);
    let mut judged = Vec::new();
    for ratio in RATIOS {
        for rate in RATES {
            for wanted in SHARES.iter().flat_map(|(wanted, count)| std::iter::repeat_n(*wanted, *count)) {
                let skew_known = judged.len() % 2 == 0;
                let skew = LARGEST_SKEW * random.uniform();
                let Stroke { linear, mut samples } = stroke(wanted, rate, skew, &mut random);
                add_noise(&mut samples, ratio, &mut random);
                let settings = Settings {
                    skew: if skew_known { skew } else { 0.0 },
                    damping_ratio: DAMPING_RATIO,
                    ..Settings::default()
                };
                let found = run(&csv(&samples), &settings).ok();
                let true_phase = linear.phase.unwrap_or(f64::NAN);
                judged.push(Judged { wanted, ratio, skew_known, found, true_phase });
            }
        }
    }
    judged
}

/// The worst and the median error of the phase at this ratio, degrees, and how many there are.
fn phase_errors(judged: &[Judged], ratio: f64) -> (f64, f64, usize) {
    let at = judged.iter().filter(|stroke| stroke.ratio >= ratio && stroke.ratio < ratio + 1.0);
    let mut errors: Vec<f64> = at.filter_map(Judged::phase_error).map(f64::abs).collect();
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN);
    (errors.last().copied().unwrap_or(f64::NAN), median, errors.len())
}

#[test]
fn two_hundred_strokes() {
    let judged = table(SEED);
    assert_eq!(judged.len(), 200);
    let good: Vec<&Judged> = judged.iter().filter(|stroke| stroke.ratio >= GOOD).collect();
    for stroke in &good {
        let found = stroke.found.as_ref().map(|found| &found.verdict);
        assert!(!stroke.wrong(), "{:?} at {} dB called {found:?}", stroke.wanted, stroke.ratio);
    }
    let confident = good.iter().filter(|stroke| stroke.kind().is_some_and(|kind| kind != Kind::Undecided)).count();
    assert!(confident * 100 >= 80 * good.len(), "{confident} of {} confident", good.len());
    for ratio in [40.0, 30.0, 20.0] {
        let (worst, _, count) = phase_errors(&judged, ratio);
        assert!(worst <= 2.0 && count >= 8, "{ratio} dB: phase off by {worst}° at worst of {count}");
    }
}

#[test]
#[ignore = "prints the summary of many seeds"]
fn many_seeds() {
    for seed in 1..=8 {
        let judged = table(seed);
        let good: Vec<&Judged> = judged.iter().filter(|stroke| stroke.ratio >= GOOD).collect();
        let confident = good.iter().filter(|s| s.kind().is_some_and(|kind| kind != Kind::Undecided)).count();
        let wrong = |of: &[&Judged]| of.iter().filter(|stroke| stroke.wrong()).count();
        let low: Vec<&Judged> = judged.iter().filter(|stroke| stroke.ratio < GOOD).collect();
        let phases = [40.0, 30.0, 20.0].map(|ratio| phase_errors(&judged, ratio));
        println!("seed {seed}: confident {confident}/{}, wrong {} (below {GOOD} dB {}), phases {phases:.2?}", good.len(), wrong(&good), wrong(&low));
        for s in judged.iter().filter(|s| s.wrong()) { println!("   {:?} {} dB {:?}", s.wanted, s.ratio, s.found.as_ref().map(|f| (&f.verdict.kind, f.verdict.confidence))); }
        for k in Wanted::ALL { let of: Vec<_> = good.iter().filter(|s| s.wanted == k).collect(); print!(" {k:?} {}/{};", of.iter().filter(|s| s.kind().is_some_and(|k| k != Kind::Undecided)).count(), of.len()); }
        println!();
    }
}
