//! Outliers and marks for missing values in measured signals: named, not analysed; strokes with impacts are no such.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::common::plan;
use crate::study::identify_growth::saturating;
use crate::study::strokes::{FIELDS, Random, Wanted, add_noise, draw, stroke};
use crate::study::strokes::{csv, run};
use squealmap::model::Param;
use squealmap::study::signals::sensors::{Recording, Sample, record};
use squealmap_identify::Unfit;
use squealmap_identify::{Fault, Kind, Settings};

/// Rate of the strokes, Hz.
const RATE: f64 = 51.2e3;
const NAMES: [&str; 4] = ["ax2", "ay1", "T", "N"];

/// What a noisy stroke is called with `change` made to channel `q` at each of the samples `at` (parts of the record).
fn outliers(q: usize, at: &[f64], change: impl Fn(f64) -> f64) -> Result<Kind, Fault> {
    let mut random = Random::new(21);
    let mut samples = stroke(Wanted::Coupling, RATE, 0.0, &mut random).samples;
    let _ = add_noise(&mut samples, 40.0, &mut random);
    let last = samples.len() as f64 - 1.0;
    for part in at {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the record")]
        let value = FIELDS[q](&mut samples[(part * last).round() as usize]);
        *value = change(*value);
    }
    match run(&csv(&samples), &Settings::default()) {
        Ok(found) => Ok(found.verdict.kind),
        Err(Unfit { fault, .. }) => Err(*fault),
    }
}

#[test]
fn outliers_are_named_wherever_they_stand() {
    for (q, name) in NAMES.into_iter().enumerate() {
        for at in [0.0, 0.004, 0.03, 0.5, 0.96, 1.0] {
            for (what, change) in [
                ("1e6 times", (|x| 1e6 * x) as fn(f64) -> f64),
                ("1e30", |_| 1e30),
                ("-1e20", |_| -1e20),
                ("beyond the largest number of f32", |_| 3e300),
            ] {
                let found = outliers(q, &[at], change);
                let named = matches!(&found, Err(Fault::Outliers { column, count: 1, .. }) if column == name);
                assert!(named, "{what} in {name} at {at}: {found:?}");
            }
        }
        // A mark for a missing value is no vibration even where the vibration is as large.
        let found = outliers(q, &[0.01, 0.02, 0.05], |_| -99999.0);
        assert!(
            matches!(&found, Err(Fault::Outliers { count: 3, value: -99999.0, .. })),
            "{name}: {found:?}"
        );
    }
    let message = outliers(1, &[0.5], |_| -1e20).unwrap_err().to_string();
    for part in ["`ay1`", "1 value(s)", " s)", "cut the record"] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_mark_in_a_channel_that_stands_still_is_named() {
    let mut samples = stroke(Wanted::Coupling, RATE, 0.0, &mut Random::new(21)).samples;
    for (k, sample) in samples.iter_mut().enumerate() {
        sample.belt_velocity = if k == 100 { -9999.0 } else { 3.0 };
    }
    let found = run(&csv(&samples), &Settings::default());
    assert!(
        matches!(&found, Err(Unfit { fault, .. }) if matches!(&**fault, Fault::Outliers { column, .. } if column == "V"))
    );
    samples[100].belt_velocity = 3.01;
    assert!(run(&csv(&samples), &Settings::default()).is_ok());
}

/// A velocity without noise that steps, as it is commanded: its rest is no outlier.
#[test]
fn a_rest_of_a_commanded_velocity_is_no_outlier() {
    let mut samples = stroke(Wanted::Coupling, RATE, 0.0, &mut Random::new(21)).samples;
    let count = samples.len();
    for (k, sample) in samples.iter_mut().enumerate() {
        let slides = (count / 5..4 * count / 5).contains(&k);
        sample.belt_velocity = if slides { 3.0 - 1e-4 * k as f64 } else { 0.0 };
    }
    let found = run(&csv(&samples), &Settings::default());
    assert!(found.is_ok(), "{found:?}");
    // Where it rests for some samples only it is one.
    for sample in &mut samples[count / 2..count / 2 + 9] {
        sample.belt_velocity = 0.0;
    }
    let fault = run(&csv(&samples), &Settings::default()).unwrap_err().fault;
    assert!(matches!(&*fault, Fault::Outliers { column, count: 9, .. } if column == "V"), "{fault:?}");
}

/// What is too small to be named must not lead astray either.
#[test]
fn smaller_outliers_are_never_confidently_wrong() {
    let mut random = Random::new(22);
    let mut clean = saturating(200e3, 300.0, 9e3);
    let _ = add_noise(&mut clean, 40.0, &mut random);
    let kind = |samples: &[Sample]| match run(&csv(samples), &Settings::default()) {
        Ok(found) => Some(found.verdict.kind),
        Err(Unfit { fault, .. }) if matches!(*fault, Fault::Outliers { .. }) => None,
        Err(other) => panic!("{other}"),
    };
    assert_eq!(kind(&clean), Some(Kind::ModeCoupling));
    let mut named = 0;
    for (field, name) in FIELDS.into_iter().zip(NAMES) {
        for at in [200, 3000, 6000] {
            for value in [30.0, 300.0, 3e3, 3e4, 3e5, 3e6, 3e7] {
                let mut samples = clean.clone();
                *field(&mut samples[at]) = value;
                let kind = kind(&samples);
                let right = matches!(kind, None | Some(Kind::ModeCoupling | Kind::Undecided));
                assert!(right, "{value} in {name} at sample {at}: {kind:?}");
                named += usize::from(kind.is_none());
            }
        }
    }
    assert!((20..80).contains(&named), "{named} of 84 named");
}

/// Flights, impacts, sticking and growth over decades without any noise; `two_hundred_strokes` analyses noisy ones.
#[test]
fn impacts_are_no_outliers() {
    let mut flights = 0;
    for seed in 0..12 {
        let mut random = Random::new(seed);
        let (mut instance, linear) = draw(Wanted::Coupling, &mut random);
        // Three times as long as the growth takes: most of it in the limit cycle, hardly pressed.
        instance.params.set(Param::StartVelocity, 0.01);
        instance.params.set(Param::FExt, 0.2 * instance.params.require(Param::FExt));
        let recording =
            Recording { rate: RATE, duration: 18.0 / linear.growth_rate, skew: 0.0, force_skew: 0.0 };
        let samples = record(&instance, &plan(1.0, 1.0, 12), &recording).samples;
        flights += samples
            .windows(2)
            .filter(|pair| pair[0].normal_force > 0.0 && pair[1].normal_force <= 0.0)
            .count();
        let found = run(&csv(&samples), &Settings::default());
        assert!(found.is_ok(), "seed {seed}: {found:?}");
    }
    assert!(flights > 100, "{flights} flights");
    for seed in 0..6 {
        let mut random = Random::new(seed);
        for decibel in [60.0, 40.0, 20.0] {
            let mut samples = stroke(Wanted::Slope, 200e3, 0.0, &mut random).samples;
            let _ = add_noise(&mut samples, decibel, &mut random);
            let found = run(&csv(&samples), &Settings::default());
            assert!(found.is_ok(), "seed {seed}, {decibel} dB: {found:?}");
        }
    }
}

/// The fault of a clean stroke whose header is changed, under these settings.
fn refused(header: &str, settings: &Settings) -> Option<Fault> {
    let samples = stroke(Wanted::Coupling, RATE, 0.0, &mut Random::new(21)).samples;
    let table = String::from_utf8(csv(&samples)).unwrap().replacen("t,ax2,ay1,T,N,V", header, 1);
    match run(table.as_bytes(), settings) {
        Ok(_) => None,
        Err(Unfit { fault, .. }) => Some(*fault),
    }
}

#[test]
fn a_rate_that_contradicts_the_column_of_time_is_named() {
    const HEADER: &str = "t,ax2,ay1,T,N,V";
    let rate = |rate: f64| Settings { rate: Some(rate), ..Settings::default() };
    assert_eq!(refused(HEADER, &rate(RATE)), None);
    assert_eq!(refused(HEADER, &rate(1.005 * RATE)), None, "times may be rounded");
    let fault = refused(HEADER, &rate(2.0 * RATE)).unwrap();
    assert!(
        matches!(&fault, Fault::Contradicted { found, .. } if (found / RATE - 1.0).abs() < 1e-3),
        "{fault}"
    );
    let message = fault.to_string();
    assert!(
        message.contains("102400 Hz") && message.contains("`t`") && message.contains("leave out --rate"),
        "{message}"
    );
    assert_eq!(refused("clock,ax2,ay1,T,N,V", &rate(2.0 * RATE)), None, "no column of time contradicts");
}

#[test]
fn delays_of_more_than_a_period_are_named() {
    const HEADER: &str = "t,ax2,ay1,T,N,V";
    let late = |skew: f64, force_skew: f64| Settings { skew, force_skew, ..Settings::default() };
    assert_eq!(refused(HEADER, &late(20e-6, -20e-6)), None);
    for (settings, flag) in
        [(late(1.0, 0.0), "--skew is 1 s"), (late(0.0, -1e-3), "--force-skew is -0.001 s")]
    {
        let message = refused(HEADER, &settings).unwrap().to_string();
        assert!(message.contains(flag) && message.contains("at most one period"), "{message}");
    }
}

#[test]
fn a_name_that_stands_twice_is_named_where_it_is_asked_for() {
    let settings = Settings::default();
    for (header, name) in [("t,ax2,ax2,T,N,V", "ax2"), ("t,ax2,ay1,T,N,N", "N"), ("t,ax2,ay1,T,N,t", "t")] {
        let fault = refused(header, &settings).unwrap();
        assert!(matches!(&fault, Fault::Ambiguous { name: found, count: 2, .. } if found == name), "{fault}");
    }
    assert_eq!(refused("t,ax2,spare,T,N,spare", &settings), None, "nobody asks for these");
}
