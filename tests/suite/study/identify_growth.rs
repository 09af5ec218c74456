//! The course of a growth: what saturates smoothly is measured at its beginning, what is driven is no instability.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;

use crate::common::near;
use crate::study::strokes::{Random, add_noise};
use crate::study::strokes::{csv, run};
use squealmap::study::signals::sensors::Sample;
use squealmap_identify::{Identification, Kind, Measured, Settings};

/// An oscillation of one mode: amplitude (m/s²) over time (s), growth rate (1/s) for the phase of the velocity, forces in
/// proportion, all of its power from the normal force.
fn oscillation(
    rate: f64,
    duration: f64,
    frequency: f64,
    growth: f64,
    envelope: impl Fn(f64) -> f64,
) -> Vec<Sample> {
    let count = (0..).take_while(|k| f64::from(*k) < duration * rate);
    count
        .map(|k| {
            let t = f64::from(k) / rate;
            let amplitude = envelope(t);
            let swing = |degrees: f64| (TAU * frequency * t + degrees.to_radians()).cos();
            // The velocity lags a quarter behind the acceleration, less what it grows.
            let lag = (TAU * frequency).atan2(growth).to_degrees();
            let normal = 2000.0 * amplitude / growth.hypot(TAU * frequency) * swing(40.0 - lag);
            Sample {
                t,
                tangential_acceleration: amplitude * swing(0.0),
                normal_acceleration: 0.5 * amplitude * swing(-41.0),
                tangential_force: 400.0 + 0.4 * normal,
                normal_force: 1000.0 + normal,
                belt_velocity: 3.0 - 0.03 * t,
            }
        })
        .collect()
}

/// A growth that falls off smoothly, by the normal form of Hopf: amplitude `e^{σt}/√(1 + (e^{σt}/a)²)`.
pub(crate) fn saturating(rate: f64, growth: f64, frequency: f64) -> Vec<Sample> {
    const SATURATED: f64 = 1000.0;
    oscillation(rate, 14.0 / growth, frequency, growth, |t| {
        let rise = (growth * t).exp();
        rise / (1.0 + (rise / SATURATED).powi(2)).sqrt()
    })
}

fn noisy(mut samples: Vec<Sample>, decibel: f64, random: &mut Random) -> Identification {
    let _ = add_noise(&mut samples, decibel, random);
    run(&csv(&samples), &Settings::default()).unwrap()
}

/// Deviation over stated error.
fn deviation(measured: Measured, truth: f64) -> f64 {
    (measured.value - truth) / measured.error
}

/// The kind is that of the linear growth; growth and phase are, too, and as uncertain as they say.
#[test]
fn growth_that_saturates_smoothly_is_measured_at_its_beginning() {
    let mut random = Random::new(3);
    for decibel in [60.0, 40.0, 30.0, 20.0] {
        let mut growths = Vec::new();
        for (rate, growth, frequency) in [(200e3, 300.0, 9e3), (51.2e3, 60.0, 2e3)].repeat(8) {
            let found = noisy(saturating(rate, growth, frequency), decibel, &mut random);
            let name = format!("{frequency} Hz, {decibel} dB");
            // At 20 dB the growth stands out of the noise for little more than one window: some have no episode.
            if decibel < 25.0 && found.episodes.is_empty() {
                assert_eq!(found.verdict.kind, Kind::Undecided, "{name}: {:?}", found.verdict);
                continue;
            }
            assert_eq!(found.verdict.kind, Kind::ModeCoupling, "{name}: {:?}", found.verdict);
            let episode = &found.episodes[0];
            near(&format!("growth, {name}"), episode.growth.value, growth, 0.1 * growth);
            near(&format!("phase, {name}"), episode.phase.unwrap().value, -41.0, 2.0);
            near(&format!("frequency, {name}"), episode.frequency, frequency, 1e-3 * frequency);
            growths.push((episode.growth, growth));
        }
        assert!(growths.len() >= 8, "{decibel} dB: {} episodes", growths.len());
        let squares = |off: f64| {
            let all = growths.iter().map(|(found, truth)| deviation(*found, truth * off).powi(2));
            (all.sum::<f64>() / growths.len() as f64).sqrt()
        };
        let typical = squares(1.0);
        assert!((0.4..=1.6).contains(&typical), "{decibel} dB: growth is {typical} of its stated errors off");
        // The judge notices a growth rate that is 7 % off.
        assert!(squares(1.07) > 1.6, "{decibel} dB: blind to 7 %");
    }
}

/// Amplitude over the part of the record that has passed.
type Ramp = fn(f64) -> f64;

/// Rates (Hz), frequencies (Hz) and durations (s) of records.
const RECORDS: [(f64, f64, f64); 3] = [(51.2e3, 2e3, 1.0), (51.2e3, 2e3, 0.1), (200e3, 9e3, 0.2)];

/// How many records of a vibration that is driven with these amplitudes are called so, in these words; all have to be
/// undecided.
fn undecided(ramps: &[(&str, Ramp)], records: &[(f64, f64, f64)], decibels: &[f64], words: &str) -> usize {
    let mut named = 0;
    for decibel in decibels {
        let mut random = Random::new(5);
        for (name, ramp) in ramps {
            for (rate, frequency, duration) in records.iter().copied() {
                let samples = oscillation(rate, duration, frequency, 0.0, |t| 100.0 * ramp(t / duration));
                let verdict = noisy(samples, *decibel, &mut random).verdict;
                assert_eq!(
                    verdict.kind,
                    Kind::Undecided,
                    "{name}, {frequency} Hz, {decibel} dB: {verdict:?}"
                );
                named += usize::from(verdict.reasons[0].contains(words));
            }
        }
    }
    named
}

/// A smooth step.
fn step(part: f64) -> f64 {
    let risen = (2.0 * part - 0.4).clamp(0.0, 1.0);
    risen * risen * (3.0 - 2.0 * risen)
}

/// A vibration that is driven harder and harder, or through a resonance, grows, but not by itself.
#[test]
fn what_is_driven_is_no_instability() {
    let ramps: [(&str, Ramp); 12] = [
        ("t", |part| part),
        ("t²", |part| part * part),
        ("t³", |part| part.powi(3)),
        ("t⁵", |part| part.powi(5)),
        ("√t", f64::sqrt),
        ("t from an offset", |part| 0.05 + part),
        ("t, then held", |part| (2.0 * part).min(1.0)),
        ("t² from rest", |part| (1.25 * (part - 0.2)).max(0.0).powi(2)),
        ("a bell", |part| (-12.5 * (part - 0.7).powi(2)).exp()),
        ("a resonance", |part| 1.0 / (1.0 + (20.0 * (part - 0.6)).powi(2))),
        ("a smooth step", step),
        ("modulation", |part| 1.0 + 0.9 * (2.0 * TAU * part - 1.6).sin()),
    ];
    let named = undecided(&ramps, &RECORDS, &[60.0, 40.0, 20.0], "driven");
    assert!(named >= 36, "{named} named as driven");
}

/// A vibration that was there before it is driven harder: too little of its growth looks exponential to decide.
#[test]
fn what_was_there_before_is_no_instability() {
    let ramps: [(&str, Ramp); 5] = [
        ("square after 0.6 %", |part| 0.006 + (part - 0.25).max(0.0).powi(2)),
        ("square after 6 %", |part| 0.06 + (part - 0.25).max(0.0).powi(2)),
        ("cube after 0.6 %", |part| 0.006 + (part - 0.25).max(0.0).powi(3)),
        ("step after 1 %", |part| 0.01 + step(part)),
        ("step after 10 %", |part| 0.1 + step(part)),
    ];
    let records = [(51.2e3, 2e3, 0.4), (51.2e3, 2e3, 0.1), (200e3, 9e3, 0.2)];
    let named = undecided(&ramps, &records, &[60.0, 40.0], "was there before");
    assert!(named >= 6, "{named} were there before");
}

/// A resonance (Hz, quality factor) that a drive passes, from 0.95 to 1.05 of its frequency; forces as those of
/// [`oscillation`].
fn swept(rate: f64, duration: f64, frequency: f64, quality: f64) -> Vec<Sample> {
    /// Steps per sample.
    const STEPS: u32 = 4;
    let (omega, step) = (TAU * frequency, 1.0 / (rate * f64::from(STEPS)));
    let drive = |t: f64| 100.0 / quality * (omega * t * (0.95 + 0.05 * t / duration)).cos();
    let [a, c] = [omega * omega, omega / quality];
    let slope = |t: f64, [x, v]: [f64; 2]| [v, drive(t) - c * v - a * x];
    let (mut at, mut state) = (0.0, [0.0; 2]);
    let count = (0..).take_while(|k| f64::from(*k) < duration * rate);
    count
        .map(|k| {
            let t = f64::from(k) / rate;
            let [x, v] = state;
            let acceleration = slope(t, state)[1];
            let along =
                |degrees: f64| v * degrees.to_radians().cos() + omega * x * degrees.to_radians().sin();
            let normal = 2000.0 * along(40.0);
            for _ in 0..STEPS {
                let moved = |by: f64, slope: [f64; 2]| [state[0] + by * slope[0], state[1] + by * slope[1]];
                let k1 = slope(at, state);
                let k2 = slope(at + 0.5 * step, moved(0.5 * step, k1));
                let k3 = slope(at + 0.5 * step, moved(0.5 * step, k2));
                let k4 = slope(at + step, moved(step, k3));
                for i in 0..2 {
                    state[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
                }
                at += step;
            }
            Sample {
                t,
                tangential_acceleration: acceleration,
                normal_acceleration: 0.5 * omega * along(41.0 + 90.0),
                tangential_force: 400.0 + 0.4 * normal,
                normal_force: 1000.0 + normal,
                belt_velocity: 3.0 - 0.03 * t,
            }
        })
        .collect()
}

/// A drive that passes a resonance moves the frequency.
#[test]
fn a_resonance_that_is_passed_is_no_instability() {
    let mut random = Random::new(9);
    for decibel in [60.0, 20.0] {
        for (quality, (rate, frequency, duration)) in
            [30.0, 100.0].into_iter().flat_map(|q| RECORDS.map(|r| (q, r)))
        {
            let verdict = noisy(swept(rate, duration, frequency, quality), decibel, &mut random).verdict;
            assert_eq!(
                verdict.kind,
                Kind::Undecided,
                "Q {quality}, {frequency} Hz, {decibel} dB: {verdict:?}"
            );
        }
    }
}

#[test]
fn an_error_shows_at_least_one_digit() {
    let text = |value: f64, error: f64| Measured { value, error }.text(1.0, 1);
    assert_eq!(text(1836.62, 2.31), "1836.6 ± 2.3");
    assert_eq!(text(4.68, 0.005_146), "4.680 ± 0.005");
    assert_eq!(text(4.68, 0.0), "4.7 ± 0.0");
    assert_eq!(Measured { value: 1.0, error: 0.000_02 }.text(100.0, 0), "100.000 ± 0.002");
}
