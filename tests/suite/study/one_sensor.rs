//! Records in which one sensor is dead, hums, or is louder at a harmonic than at the oscillation.

use std::f64::consts::TAU;

use squealmap::study::signals::sensors::Sample;
use squealmap_identify::{Kind, Settings};

use crate::study::strokes::{Random, csv, run};

const RATE: f64 = 51_200.0;

/// A sustained vibration of both masses at a frequency (Hz), with noise, for 0.3 s; `of` changes each sample, which has its time.
fn record(frequency: f64, of: impl Fn(&mut Sample, &mut Random)) -> Vec<Sample> {
    let mut random = Random::new(11);
    let sample = |k: u32| {
        let t = f64::from(k) / RATE;
        let phase = TAU * frequency * t;
        let mut noise = || random.normal();
        let mut sample = Sample {
            t,
            tangential_acceleration: 400.0 * phase.sin() + noise(),
            normal_acceleration: 600.0 * (phase + 2.4).sin() + noise(),
            tangential_force: 9.0 + 2.0 * phase.cos() + 0.05 * noise(),
            normal_force: 30.0 + 6.0 * (phase + 0.5).cos() + 0.1 * noise(),
            belt_velocity: 0.02 + 1e-4 * t,
        };
        of(&mut sample, &mut random);
        sample
    };
    (0..15_360).map(sample).collect()
}

fn settings() -> Settings {
    Settings { damping_ratio: 0.005, ..Settings::default() }
}

/// A contact that squeals across and shows nothing along it is not quiet: the sensor is.
#[test]
fn a_dead_tangential_accelerometer_is_no_stable_contact() {
    let dead = |sample: &mut Sample, random: &mut Random| sample.tangential_acceleration = random.normal();
    let found = run(&csv(&record(2840.0, dead)), &settings()).expect("a record");
    assert_eq!(found.verdict.kind, Kind::Undecided);
    assert!(found.verdict.reasons[0].contains("its sensor may be dead"), "{:?}", found.verdict.reasons);
    // One that dies on the way leaves what came before.
    let dies = |sample: &mut Sample, random: &mut Random| {
        if sample.t > 0.1 {
            sample.tangential_acceleration = random.normal();
        }
    };
    let found = run(&csv(&record(2840.0, dies)), &settings()).expect("a record");
    let quiet = found.segments.iter().filter(|segment| segment.time[0] > 0.099);
    assert!(quiet.clone().count() > 0);
    for segment in quiet {
        assert_eq!(segment.verdict.kind, Kind::Undecided, "{:?}", segment.time);
    }
    // A contact that is quiet in both is stable, as before.
    let quiet = |sample: &mut Sample, random: &mut Random| {
        (sample.tangential_acceleration, sample.normal_acceleration) =
            (random.normal(), 3.0 * random.normal());
    };
    let found = run(&csv(&record(2840.0, quiet)), &settings()).expect("a record");
    assert_eq!(found.verdict.kind, Kind::NoInstability);
    // So it is where the normal sensor drifts, or takes one knock.
    for drifts in [true, false] {
        let odd = |sample: &mut Sample, random: &mut Random| {
            let knock = if (0.12..0.122).contains(&sample.t) { 2000.0 } else { 0.0 };
            sample.tangential_acceleration = random.normal();
            sample.normal_acceleration = random.normal() + if drifts { 900.0 * sample.t } else { knock };
        };
        let found = run(&csv(&record(2840.0, odd)), &settings()).expect("a record");
        assert_eq!(found.verdict.kind, Kind::NoInstability, "{drifts}: {:?}", found.verdict.reasons);
    }
}

/// Hum that is louder than the squeal is named, with the band to look at instead.
#[test]
fn hum_is_named_with_the_band_above_it() {
    let hums = |sample: &mut Sample, _: &mut Random| {
        sample.tangential_acceleration += 700.0 * (TAU * 50.0 * sample.t).sin();
    };
    let found = run(&csv(&record(2840.0, hums)), &settings()).expect("a record");
    let says = |note: &&String| note.contains("hum of the mains") && note.contains("--band 1988,4260");
    assert_eq!(found.notes.iter().filter(says).count(), 1, "{:?}", found.notes);
    let within = Settings { band: Some([1988.0, 4260.0]), ..settings() };
    let found = run(&csv(&record(2840.0, hums)), &within).expect("a record");
    assert!(found.notes.iter().all(|note| !note.contains("hum")), "{:?}", found.notes);
    assert!((found.frequency.expect("an oscillation") / 2840.0 - 1.0).abs() < 0.01);
}

/// Where a harmonic is louder in some of the windows, the frequency is that of the oscillation and not one between.
#[test]
fn a_frequency_is_one_that_the_record_has() {
    let louder = |sample: &mut Sample, _: &mut Random| {
        if (sample.t * 100.0).fract() < 0.45 {
            sample.tangential_acceleration += 480.0 * (2.0 * TAU * 2840.0 * sample.t).sin();
        }
    };
    let found = run(&csv(&record(2840.0, louder)), &settings()).expect("a record");
    let frequencies: Vec<f64> = found.segments.iter().filter_map(|segment| segment.frequency).collect();
    assert!(!frequencies.is_empty());
    for frequency in frequencies {
        let order = frequency / 2840.0;
        assert!((order - order.round()).abs() < 0.02 && order < 2.1, "{frequency}");
    }
}
