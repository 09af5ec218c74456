//! Forces that slow sensors do not show, taken from the accelerations and a known rig: strokes like the source paper's Figures 11 to 14,
//! through the filter of a recorder.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::sync::Arc;

use crate::common::{near, plan};
use crate::study::confusion::{TOLERANCE, is_right};
use crate::study::laboratory::{Stroke, coalescence, exact, right, sensed};
use crate::study::segments::{LENGTH, couples, describe, rig};
use crate::study::strokes::{Random, csv, run};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::{Motion, MotionTable};
use squealmap::study::signals::filter::recorded;
use squealmap::study::signals::sensors::{Recording, Sample};
use squealmap_identify::{Fault, FrictionReading, Identification, Kind, Rig, Segment, Settings, Witness};

/// Samples per second, Hz: 27 per period.
const RATE: f64 = 400e3;
/// Friction of the law, and its knee, m/s.
const MU_S: f64 = 0.51;
const MU_D: f64 = 0.3423;
const KNEE: f64 = 0.0228;

/// A stroke through the filter of a recorder, by a rig whose inclination is that of the stroke's direction.
fn sampled(instance: &Instance, rate: f64) -> Vec<Sample> {
    let recording = Recording { rate, duration: LENGTH, skew: 0.0, force_skew: 0.0 };
    recorded(instance, &plan(1.0, 1.0, 12), &recording).samples
}

/// What slow force sensors and noise (dB) make of it.
fn noisy(samples: &[Sample], decibel: f64, backwards: bool, seed: u64) -> Vec<u8> {
    let mut samples = samples.to_vec();
    sensed(&mut samples, true, decibel, backwards, &mut Random::new(seed));
    csv(&samples)
}

/// What is known of the rig of a stroke: everything, its masses times `mass`, its stiffnesses along and across times `along` and `across`.
fn known(instance: &Instance, backwards: bool, [mass, along, across]: [f64; 3]) -> Settings {
    let rig = exact(instance, backwards);
    let rig =
        Rig { m1: mass * rig.m1, m2: mass * rig.m2, k1: along * rig.k1, k2: mass * across * rig.k2, ..rig };
    let (damping_ratio, inclination) = (rig.damping_ratio(), rig.theta.abs());
    Settings { damping_ratio, inclination, rig: Some(rig), ..Settings::default() }
}

/// The segments that are longer than a boundary may be off.
fn long(found: &Identification) -> impl Iterator<Item = &Segment> {
    found.segments.iter().filter(|s| s.time[1] - s.time[0] > TOLERANCE * LENGTH)
}

/// All that is decided is right.
fn assert_right(instance: &Instance, found: &Identification) {
    let stroke = Stroke {
        instance: instance.clone(),
        critical: coalescence(instance),
        samples: Vec::new(),
        damping_ratio: 0.02,
        duration: LENGTH,
    };
    for segment in long(found).filter(|segment| segment.verdict.kind != Kind::Undecided) {
        assert!(is_right(&stroke, segment.time, &[segment.verdict.kind]), "{}", describe(found));
    }
}

/// A motion of these corners: time, s, and velocity, m/s.
fn table(corners: &[[f64; 2]]) -> Motion {
    Motion::Table(Arc::new(MotionTable {
        name: "table".to_owned(),
        corners: corners.into(),
        temperature: None,
    }))
}

/// Noise, direction and draw of the records of a stroke that are tried.
const TRIED: [(f64, bool, u64); 4] = [(40.0, false, 5), (40.0, true, 6), (20.0, false, 7), (20.0, true, 8)];

/// Figures 13 and 14: mode coupling above the knee, both below it, and the law as it is.
#[test]
fn figure_13_is_mode_coupling_then_both_with_slow_sensors() {
    let [first, last] = [0.0472, 0.0041];
    let rig = rig(MU_S, MU_D, KNEE, [first, last]);
    let at = |velocity: f64| LENGTH * (first - velocity) / (first - last);
    assert_eq!(right(&rig, at(KNEE) - 0.01), [Kind::ModeCoupling]);
    assert_eq!(right(&rig, at(KNEE) + 0.01), [Kind::Both]);
    let samples = sampled(&rig, RATE);
    // How late both is told, as a part of the stroke.
    let told = |decibel: f64, backwards: bool, seed: u64| {
        let found =
            run(&noisy(&samples, decibel, backwards, seed), &known(&rig, backwards, [1.0; 3])).unwrap();
        assert_right(&rig, &found);
        assert!(long(&found).all(couples), "{}", describe(&found));
        let both = found.segments.iter().position(|s| s.verdict.kind == Kind::Both).unwrap();
        // The law beside the knee is known by all that lies there: the slope is excluded before it.
        let before = &found.segments[..both];
        let leans = before.iter().all(|segment| segment.verdict.leaning == Some(Kind::ModeCoupling));
        assert!(leans && !before.is_empty(), "{}", describe(&found));
        let alone = before.iter().all(|segment| segment.verdict.kind == Kind::ModeCoupling);
        // The law, which the mean of slow forces does not show.
        let mut read = 0;
        for segment in long(&found) {
            let friction = segment.friction.filter(|f| f.reading == FrictionReading::Within).unwrap();
            let velocity = 0.5 * segment.velocity.unwrap().iter().map(|v| v.abs()).sum::<f64>();
            let law = MU_D + (MU_S - MU_D) * (1.0 - velocity / KNEE).max(0.0);
            near("level", friction.level.value, law, 0.04 * law);
            read += 1;
            if let Some(slope) = friction.slope.filter(|_| segment.time[0] > at(KNEE) + TOLERANCE * LENGTH) {
                near("slope", slope.value, (MU_D - MU_S) / KNEE, 2.5 * slope.error);
            }
        }
        assert!(read >= 3, "{}", describe(&found));
        let lasts = found.segments[both..].iter().all(|segment| segment.verdict.kind == Kind::Both);
        ((found.segments[both].time[0] - at(KNEE)) / LENGTH, lasts, alone)
    };
    for (backwards, seed) in [(false, 5), (true, 6)] {
        let (late, lasts, alone) = told(40.0, backwards, seed);
        near("late", late, 0.0, TOLERANCE);
        assert!(lasts && alone);
    }
    let found: Vec<(f64, bool, bool)> = (1..=24).map(|seed| told(20.0, seed % 2 == 0, seed)).collect();
    assert!(found.iter().all(|(late, lasts, _)| late.abs() <= TOLERANCE && *lasts), "{found:?}");
    // In the others noise bends the law before the knee.
    assert!(found.iter().filter(|(_, _, alone)| *alone).count() >= 21, "{found:?}");
}

/// Figure 11: no instability, then a negative slope to the end.
#[test]
fn figure_11_is_stable_then_a_negative_slope_with_slow_sensors() {
    let rig = rig(0.16, 0.06, 0.025, [0.045, 0.005]);
    let samples = sampled(&rig, RATE);
    for (decibel, backwards, seed) in TRIED {
        let found =
            run(&noisy(&samples, decibel, backwards, seed), &known(&rig, backwards, [1.0; 3])).unwrap();
        assert_right(&rig, &found);
        let [quiet, loud @ ..] = &found.segments[..] else { panic!() };
        assert_eq!(quiet.verdict.kind, Kind::NoInstability, "{}", describe(&found));
        near("boundary", quiet.time[1], 0.5 * LENGTH, TOLERANCE * LENGTH);
        assert!(!loud.is_empty());
        // The first periods only lean to it.
        let leans = loud.iter().all(|segment| segment.verdict.leaning == Some(Kind::NegativeSlope));
        let decided = long(&found).skip(1).all(|segment| segment.verdict.kind == Kind::NegativeSlope);
        assert!(leans && decided && long(&found).count() > 2, "{}", describe(&found));
    }
}

/// Figure 12: mode coupling throughout, and nothing else.
#[test]
fn figure_12_is_mode_coupling_with_slow_sensors() {
    let rig = rig(MU_D, MU_D, KNEE, [0.045, 0.045]);
    let samples = sampled(&rig, RATE);
    for (decibel, backwards, seed) in TRIED {
        let found =
            run(&noisy(&samples, decibel, backwards, seed), &known(&rig, backwards, [1.0; 3])).unwrap();
        let couples = found.segments.iter().all(|segment| segment.verdict.kind == Kind::ModeCoupling);
        assert!(couples && !found.segments.is_empty(), "{}", describe(&found));
        // A flat law feeds by the normal force alone.
        let share = found.episodes[0].share.unwrap();
        near("share", share.value, 1.0, 3.0 * share.error);
        assert!(share.error < 0.08, "{share:?}");
    }
}

/// A rig that is not that of the record contradicts itself: nothing is read with it, and nothing wrong is told.
#[test]
fn another_rig_is_noticed() {
    let rig = rig(MU_S, MU_D, KNEE, [0.0472, 0.0041]);
    let samples = noisy(&sampled(&rig, RATE), 40.0, false, 5);
    for off in [
        [1.0, 1.03, 1.0],
        [1.0, 0.97, 1.0],
        [0.95, 1.0, 1.0],
        [1.05, 1.0, 1.0],
        [1.0, 1.1, 1.0],
        [1.0, 0.0025, 1.0],
        [1.3, 1.0, 1.0],
        [1.0, 1.0, 1.03],
        [1.0, 1.0, 0.97],
    ] {
        let found = run(&samples, &known(&rig, false, off)).unwrap();
        assert_right(&rig, &found);
        let notices = |segment: &&Segment| {
            let friction = segment.testimonies.iter().find(|t| t.witness == Witness::Friction).unwrap();
            friction.evidence.contains("does not fit the record")
        };
        let noticed = found.segments.iter().any(|segment| notices(&segment))
            || found.notes.iter().any(|note| note.contains("another rig"));
        assert!(noticed, "{off:?}:\n  {}", describe(&found));
    }
    let found = run(&samples, &known(&rig, false, [1.0; 3])).unwrap();
    for segment in long(&found) {
        let [stiffness, damping] = segment.across.unwrap();
        near("stiffness across", stiffness.value, 1.0, 0.01);
        near("damping across", damping.value, 1.0, 0.1_f64.max(2.0 * damping.error));
    }
    let misfit = |s: &Segment| s.friction.and_then(|friction| friction.misfit).unwrap_or_default();
    let worst = long(&found).map(misfit).fold(0.0, f64::max);
    assert!(worst < 0.05, "{worst}");
}

/// A damping across the contact that is not that of the record, and forces or accelerations in another unit, are named.
#[test]
fn another_damping_or_unit_is_named() {
    let rig = rig(MU_S, MU_D, KNEE, [0.0472, 0.0041]);
    let samples = noisy(&sampled(&rig, RATE), 40.0, false, 5);
    let right = known(&rig, false, [1.0; 3]);
    let other = |change: &dyn Fn(&mut Rig)| {
        let mut settings = right.clone();
        settings.rig.iter_mut().for_each(change);
        settings
    };
    for (settings, named) in [
        (other(&|rig| rig.c2 *= 3.0), "times the damping c2"),
        (other(&|rig| rig.c2 /= 3.0), "times the damping c2"),
        (other(&|rig| rig.load *= 1e3), "the unit of the forces"),
        (Settings { damping_ratio: 0.001, ..right.clone() }, "that of the model counts"),
    ] {
        let found = run(&samples, &settings).unwrap();
        assert!(found.notes.iter().any(|note| note.contains(named)), "{named}: {:?}", found.notes);
        assert_right(&rig, &found);
    }
    let text = String::from_utf8(samples).unwrap();
    let (head, rows) = text.split_once('\n').unwrap();
    let scaled = rows.lines().map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        format!("{},{}e3,{}e3,{}", cells[0], cells[1], cells[2], cells[3..].join(","))
    });
    let scaled: Vec<String> = scaled.collect();
    let found = run(format!("{head}\n{}\n", scaled.join("\n")).as_bytes(), &right).unwrap();
    assert!(found.notes.iter().any(|note| note.contains("the units of accelerations")), "{:?}", found.notes);
}

/// A record in which nothing stands out, or that is too short for a window, does not tell whether the rig is its own.
#[test]
fn a_quiet_record_says_nothing_of_a_rig() {
    let settings = known(&rig(MU_S, MU_D, KNEE, [0.0472, 0.0041]), false, [1.0; 3]);
    let mut random = Random::new(5);
    let mut sample = |k: u32| Sample {
        t: f64::from(k) / RATE,
        tangential_acceleration: 0.1 * random.normal(),
        normal_acceleration: 0.1 * random.normal(),
        tangential_force: 1.7 + 0.02 * random.normal(),
        normal_force: 17.0 + 0.05 * random.normal(),
        belt_velocity: 0.04 + 1e-6 * random.normal(),
    };
    let samples: Vec<Sample> = (0..20_000).map(&mut sample).collect();
    for length in [200, samples.len()] {
        let found = run(&csv(&samples[..length]), &settings).unwrap();
        assert!(found.notes.iter().all(|note| !note.contains("--model")), "{:?}", found.notes);
    }
}

/// What the rig needs and the record has not is named.
#[test]
fn what_a_rig_needs_is_named() {
    let rig = rig(MU_S, MU_D, KNEE, [0.0472, 0.0041]);
    let samples = noisy(&sampled(&rig, 120e3), 40.0, false, 5);
    let known = known(&rig, false, [1.0; 3]);
    let refused = |text: &[u8]| run(text, &known).unwrap_err();
    let few = refused(&samples);
    assert!(matches!(*few.fault, Fault::TooFewToRestore { .. }), "{few}");
    assert!(few.to_string().contains("samples per period, but --model takes 12"), "{few}");
    let text = String::from_utf8(samples).unwrap();
    for (column, flag) in [("ay1", "--normal-acceleration"), ("N", "--normal-force"), ("V", "--velocity")] {
        let header = text.lines().next().unwrap();
        let renamed: Vec<&str> =
            header.split(',').map(|name| if name == column { "other" } else { name }).collect();
        let lacks = refused(text.replacen(header, &renamed.join(","), 1).as_bytes());
        assert!(lacks.to_string().contains(flag), "{lacks}");
    }
}

/// A law without a knee is not cut at one so that what is told is wrong, whichever the draw.
#[test]
fn a_law_that_bends_gently_is_told_nothing_wrong() {
    for (mu_s, mu_d, stribeck_velocity) in [(0.55, 0.33, 0.008), (0.6, 0.3, 0.02), (0.45, 0.34, 0.004)] {
        let mut rig = rig(MU_S, MU_D, KNEE, [0.0472, 0.0041]);
        rig.law = FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity };
        let samples = sampled(&rig, RATE);
        for seed in 1..=4 {
            let (decibel, backwards) = (if seed > 3 { 40.0 } else { 20.0 }, seed % 2 == 0);
            let settings = known(&rig, backwards, [1.0; 3]);
            let found = run(&noisy(&samples, decibel, backwards, seed), &settings).unwrap();
            assert_right(&rig, &found);
        }
    }
}

/// A velocity that goes to and fro passes the knee many times: nothing wrong is told, and both where it lies below long enough, by restored forces and
/// by fast sensors.
#[test]
fn a_velocity_that_goes_to_and_fro_is_told_nothing_wrong() {
    let [fast, slow] = [0.0472, 0.006];
    for (times, length, least) in [(2_u32, LENGTH, 0.7), (5, LENGTH, 0.0), (50, 1.0, 0.0)] {
        let mut rig = rig(MU_S, MU_D, KNEE, [fast, slow]);
        let corners = (0..=2 * times)
            .map(|k| [length * f64::from(k) / f64::from(2 * times), if k % 2 == 0 { fast } else { slow }]);
        let corners: Vec<[f64; 2]> = corners.collect();
        rig.motion = table(&corners);
        let recording = Recording { rate: RATE, duration: length, skew: 0.0, force_skew: 0.0 };
        let samples = recorded(&rig, &plan(1.0, 1.0, 12), &recording).samples;
        let restored = known(&rig, false, [1.0; 3]);
        let read = Settings {
            rig: None,
            critical_friction: restored.rig.map(|rig| rig.critical[0]),
            ..restored.clone()
        };
        for (slowly, settings) in [(true, restored), (false, read)] {
            let mut samples = samples.clone();
            sensed(&mut samples, slowly, 40.0, false, &mut Random::new(5));
            let found = run(&csv(&samples), &settings).unwrap();
            assert_right(&rig, &found);
            let both = found.segments.iter().filter(|segment| segment.verdict.kind == Kind::Both);
            let told: f64 = both.map(|segment| segment.time[1] - segment.time[0]).sum();
            let below = length * (KNEE - slow) / (fast - slow);
            assert!(told >= least * below, "{times}: {told} of {below}\n{}", describe(&found));
        }
    }
}

/// A stroke that begins at rest passes all velocities of its law within some periods first: what is read there moves no boundary.
#[test]
fn a_stroke_from_rest_is_both_from_the_knee_on() {
    let mut rig = rig(MU_S, MU_D, KNEE, [0.05, 0.004]);
    rig.motion = table(&[[0.0, 0.0], [0.01, 0.05], [LENGTH, 0.004]]);
    let at = 0.01 + (LENGTH - 0.01) * (0.05 - KNEE) / (0.05 - 0.004);
    let samples = sampled(&rig, RATE);
    for seed in 1..=12 {
        let (decibel, backwards) = (if seed > 6 { 20.0 } else { 40.0 }, seed % 2 == 0);
        let found =
            run(&noisy(&samples, decibel, backwards, seed), &known(&rig, backwards, [1.0; 3])).unwrap();
        assert_right(&rig, &found);
        let both = found.segments.iter().position(|s| s.verdict.kind == Kind::Both).unwrap();
        near("both", found.segments[both].time[0], at, TOLERANCE * LENGTH);
        assert!(found.segments[both..].iter().all(|s| s.verdict.kind == Kind::Both), "{}", describe(&found));
    }
}
