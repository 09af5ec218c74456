//! What is driven from elsewhere, or too weak to be judged, is never told with confidence to be an instability or none.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;

use crate::study::strokes::{Random, csv, run};
use squealmap::study::signals::sensors::Sample;
use squealmap_identify::{Fault, Identification, Kind, Measured, Settings};

/// Samples per second, Hz, and the frequency of the vibrations, Hz.
const RATE: f64 = 102.4e3;
const FREQUENCY: f64 = 9e3;

/// A coalescence at this friction coefficient, of a structure with a damping ratio of 2 % at most.
fn known(critical: f64) -> Settings {
    let critical_friction = Some(Measured { value: critical, error: 0.01 });
    Settings { critical_friction, damping_ratio: 0.02, ..Settings::default() }
}

/// Samples of a record that lasts so long, s.
fn record(length: f64, mut sample: impl FnMut(f64) -> Sample) -> Vec<Sample> {
    let count = (0..).take_while(|k| f64::from(*k) < length * RATE);
    count.map(|k| sample(f64::from(k) / RATE)).collect()
}

/// A stable mode with a damping ratio of 1 % that white noise excites, while the belt comes from 2 m/s down to 1 m/s: it moves by less
/// than a thousandth of that. Friction is flat; the forces follow it, or do not.
fn excited(seed: u64, fast: bool) -> Vec<Sample> {
    const DAMPING: f64 = 0.01;
    let mut random = Random::new(seed);
    let omega = TAU * FREQUENCY / RATE;
    let (radius, mut past) = ((-DAMPING * omega).exp(), [0.0; 2]);
    // Its standard deviation, of a resonance this narrow.
    let size = 1.0 / (2.0 * (1.0 - radius) * 2.0 * omega.sin().powi(2)).sqrt();
    let mut late = [0.0; 3];
    let mut next = move |random: &mut Random| {
        let here = random.normal() + 2.0 * radius * omega.cos() * past[0] - radius * radius * past[1];
        past = [here, past[0]];
        late.rotate_right(1);
        late[0] = here / size;
        [late[0], late[2]]
    };
    for _ in 0..2000 {
        next(&mut random);
    }
    record(0.4, |t| {
        let [along, away] = next(&mut random);
        let swing = if fast { -away } else { 0.0 };
        Sample {
            t,
            tangential_acceleration: 30.0 * along + 0.3 * random.normal(),
            normal_acceleration: 20.0 * away + 0.2 * random.normal(),
            tangential_force: 0.3 * (17.0 + swing) + 0.05 * random.normal(),
            normal_force: 17.0 + swing + 0.1 * random.normal(),
            belt_velocity: 2.0 - t / 0.4,
        }
    })
}

/// A shaker's tone of 0.8 of the belt's velocity, 0.05 m/s, with forces that follow it; friction by its law of the sliding velocity.
fn shaken(law: impl Fn(f64) -> f64) -> Vec<Sample> {
    const VELOCITY: f64 = 0.05;
    let mut random = Random::new(2);
    let omega = TAU * FREQUENCY;
    record(0.4, |t| {
        let moves = 0.8 * VELOCITY * (omega * t).sin();
        let normal = 17.0 - 2.0 * (omega * t - 0.7).cos();
        let acceleration = 0.8 * VELOCITY * omega;
        Sample {
            t,
            tangential_acceleration: acceleration * (omega * t).cos() + 20.0 * random.normal(),
            normal_acceleration: 0.6 * acceleration * (omega * t - 0.7).cos() + 20.0 * random.normal(),
            tangential_force: law(VELOCITY - moves) * normal + 0.02 * random.normal(),
            normal_force: normal + 0.02 * random.normal(),
            belt_velocity: VELOCITY,
        }
    })
}

/// What is told of a mechanism with a confidence of 0.9 and more.
fn told(found: &Identification) -> Vec<String> {
    let of = found.segments.iter().filter_map(|segment| {
        let is_verdict = !matches!(segment.verdict.kind, Kind::Undecided | Kind::NoInstability);
        let is_told = is_verdict || segment.shared.is_some();
        is_told.then(|| format!("{:?} {:?} {:?}", segment.time, segment.verdict, segment.shared))
    });
    of.collect()
}

/// Its amplitude rises by chance as a growth does, friction lies above a coalescence or below: neither makes it an instability.
#[test]
fn a_stable_mode_that_noise_excites_has_no_mechanism() {
    for (seed, fast) in (0..8).flat_map(|seed| [(seed, false), (seed, true)]) {
        let bytes = csv(&excited(5000 + seed, fast));
        for settings in [Settings::default(), known(0.2), known(0.4)] {
            let found = run(&bytes, &settings).unwrap();
            assert!(told(&found).is_empty(), "{seed} {fast} {settings:?}: {:?}", told(&found));
        }
    }
}

/// A vibration that friction takes power out of, and which goes on, is driven, whatever slope is read within it.
#[test]
fn a_shaker_that_works_against_friction_is_no_instability() {
    for (critical, law) in [(0.2, [0.3, 1.0]), (0.2, [0.3, 0.0]), (0.2, [0.1, 0.0])] {
        let found = run(&csv(&shaken(|v| law[0] + law[1] * (v - 0.05))), &known(critical)).unwrap();
        assert!(told(&found).is_empty(), "{law:?}: {:?}", told(&found));
        let reasons: Vec<&String> = found.segments.iter().flat_map(|one| &one.verdict.reasons).collect();
        assert!(reasons.iter().any(|why| why.contains("friction takes power out of")), "{reasons:?}");
    }
}

/// A tone far below the loudest of the record, and far above its noise, is not nothing.
#[test]
fn a_weak_vibration_beside_a_loud_one_is_not_told_to_be_none() {
    let mut random = Random::new(1);
    let samples = record(0.4, |t| {
        let part = if t < 0.25 { 1.0 } else { 0.08 };
        let swing = |late: f64| part * (TAU * FREQUENCY * t - late).cos();
        Sample {
            t,
            tangential_acceleration: 500.0 * swing(0.0) + 0.2 * random.normal(),
            normal_acceleration: 300.0 * swing(0.7) + 0.2 * random.normal(),
            tangential_force: 5.0 + 0.02 * random.normal(),
            normal_force: 17.0 + 0.02 * random.normal(),
            belt_velocity: 2.0,
        }
    });
    let found = run(&csv(&samples), &Settings::default()).unwrap();
    let last = found.segments.last().unwrap();
    assert!((last.time[0] - 0.25).abs() < 0.01 && last.verdict.kind == Kind::Undecided, "{last:?}");
    assert!(last.verdict.reasons[0].contains("8.0 % of the largest amplitude"), "{:?}", last.verdict);
}

/// A record of strokes in both directions has no sign along the contact: another command parts it.
#[test]
fn strokes_in_both_directions_are_refused_with_the_command_that_parts_them() {
    let forth_and_back = |back: f64| {
        let mut random = Random::new(3);
        let samples = record(0.2, |t| {
            let along = if t < 0.1 { 1.0 } else { -back };
            Sample {
                t,
                tangential_acceleration: random.normal(),
                normal_acceleration: random.normal(),
                tangential_force: 5.0 * along + 0.02 * random.normal(),
                normal_force: 17.0 + 0.02 * random.normal(),
                belt_velocity: 0.05 * along + 1e-4 * random.normal(),
            }
        });
        run(&csv(&samples), &Settings::default())
    };
    let refused = forth_and_back(1.0).unwrap_err();
    assert!(matches!(*refused.fault, Fault::BothDirections { .. }), "{refused}");
    let words = refused.to_string();
    assert!(
        words.contains("`V`") && words.contains("50 % back") && words.contains("squealmap campaign"),
        "{words}"
    );
    // Noise about a belt that comes to rest is no stroke.
    assert!(forth_and_back(0.0).is_ok());
}
