//! Segments of a record and their verdicts: strokes like the source paper's Figures 11 to 14, its ramp of Figure 6, and
//! signals made by hand whose parts are known.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;

use crate::common::{bilinear, instance, near, plan};
use crate::study::confusion::{Fate, TOLERANCE, table};
use crate::study::laboratory::{RATE, Sensors, coalescence, right, sensed, settings};
use crate::study::strokes::{Random, csv, run};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params, linear};
use squealmap::study::signals::sensors::{Recording, Sample, record};
use squealmap_identify::{
    DAMPING_RATIO, FrictionReading, Identification, Kind, Mechanism, Segment, Settings, State, Witness,
};

/// Length of a stroke, s.
pub(crate) const LENGTH: f64 = 0.3;

/// The calibrated model at 14.5 kHz, damped with 1.4 %, under 17 N.
pub(crate) fn rig(mu_s: f64, mu_d: f64, knee_velocity: f64, [first, last]: [f64; 2]) -> Instance {
    let compression = 14.5e3 / 34.0;
    let damping = |mass: f64| 2.0 * 0.0145 * mass * TAU * 33.6;
    let values = [
        (Param::M1, 2.12 / compression),
        (Param::M2, 0.18 / compression),
        (Param::K1, 1e5 * compression),
        (Param::K2, 1.019e5 * compression),
        (Param::C1, damping(2.3)),
        (Param::C2, damping(2.12)),
        (Param::Theta, 0.0237),
        (Param::FExt, 17.0),
        (Param::BeltVelocity, first),
        (Param::BeltVelocityEnd, last),
        (Param::RampDuration, LENGTH),
        (Param::StartVelocity, 1e-3 * first),
    ];
    instance(FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity }, &values)
}

/// What is found in a stroke with slow force sensors.
fn found(instance: &Instance, decibel: f64, backwards: bool) -> Identification {
    let recording = Recording { rate: *RATE, duration: LENGTH, skew: 0.0, force_skew: 0.0 };
    let mut samples = record(instance, &plan(1.0, 1.0, 12), &recording).samples;
    sensed(&mut samples, true, decibel, backwards, &mut Random::new(5));
    run(&csv(&samples), &settings(coalescence(instance), 0.02)).unwrap()
}

pub(crate) fn describe(found: &Identification) -> String {
    let words = |s: &Segment| {
        let testimonies: Vec<String> = s
            .testimonies
            .iter()
            .map(|t| format!("{:?} {}", t.chances.map(|c| c.leading()), t.evidence))
            .collect();
        format!(
            "{:?} {:?} {:?} {:?} {:?} {:?}\n    {}",
            s.time,
            s.state,
            s.reach,
            s.verdict,
            s.shared,
            s.contradictions,
            testimonies.join("\n    ")
        )
    };
    found.segments.iter().map(words).collect::<Vec<_>>().join("\n  ")
}

/// Noise (dB) and direction of the strokes that are tried.
const TRIED: [(f64, bool); 4] = [(40.0, false), (40.0, true), (20.0, false), (20.0, true)];

/// Figure 11: at 300 °C stable first, then unstable where friction falls. The knee is at 0.025 of 0.045 to 0.005 m/s. What
/// follows the onset leans to the slope, and the end of the stroke is certain.
#[test]
fn figure_11_is_stable_then_a_negative_slope() {
    let rig = rig(0.16, 0.06, 0.025, [0.045, 0.005]);
    assert_eq!(right(&rig, 0.1 * LENGTH), [Kind::NoInstability]);
    assert_eq!(right(&rig, 0.9 * LENGTH), [Kind::NegativeSlope]);
    for (decibel, backwards) in TRIED {
        let found = found(&rig, decibel, backwards);
        let [quiet, loud @ ..] = &found.segments[..] else { panic!() };
        assert_eq!(quiet.verdict.kind, Kind::NoInstability, "{decibel} dB:\n  {}", describe(&found));
        near("boundary", quiet.time[1], 0.5 * LENGTH, TOLERANCE * LENGTH);
        for segment in loud.iter().filter(|s| s.time[1] - s.time[0] > TOLERANCE * LENGTH) {
            assert_eq!(segment.verdict.leaning, Some(Kind::NegativeSlope), "{}", describe(&found));
        }
        let last = &loud[loud.len() - 1];
        assert_eq!(last.verdict.kind, Kind::NegativeSlope, "{decibel} dB:\n  {}", describe(&found));
    }
}

/// Whether mode coupling acts in a segment, whatever the slope does.
pub(crate) fn couples(segment: &Segment) -> bool {
    let shared = segment.shared.is_some_and(|(mechanism, _)| mechanism == Mechanism::ModeCoupling);
    shared || matches!(segment.verdict.kind, Kind::ModeCoupling | Kind::Both)
}

/// Figure 12: at 500 °C and constant velocity mode coupling throughout. Slow forces at one velocity show no slope, so that
/// a slope acts beside it stays open to the phase: what is told is that mode coupling acts.
#[test]
fn figure_12_is_mode_coupling_throughout() {
    let rig = rig(0.3423, 0.3423, 0.0228, [0.045, 0.045]);
    assert_eq!(right(&rig, 0.5 * LENGTH), [Kind::ModeCoupling]);
    for (decibel, backwards) in TRIED {
        let found = found(&rig, decibel, backwards);
        for segment in found.segments.iter().filter(|s| s.time[1] - s.time[0] > TOLERANCE * LENGTH) {
            assert!(couples(segment), "{}", describe(&found));
            assert!(segment.verdict.kind != Kind::Both, "{}", describe(&found));
        }
    }
}

/// Figures 13 and 14: at 500 °C and falling velocity mode coupling, then both.
#[test]
fn figure_13_is_mode_coupling_then_both() {
    let rig = rig(0.51, 0.3423, 0.0228, [0.0472, 0.0041]);
    assert_eq!(right(&rig, 0.1 * LENGTH), [Kind::ModeCoupling]);
    assert_eq!(right(&rig, 0.9 * LENGTH), [Kind::Both]);
    let knee = LENGTH * (0.0472 - 0.0228) / (0.0472 - 0.0041);
    for (decibel, backwards) in TRIED {
        let found = found(&rig, decibel, backwards);
        let late = found.segments.last().unwrap();
        assert_eq!(late.verdict.kind, Kind::Both, "{decibel} dB:\n  {}", describe(&found));
        for segment in found.segments.iter().filter(|s| s.time[1] - s.time[0] > TOLERANCE * LENGTH) {
            // Near 15° a slope alone is not excluded.
            let leans = segment.verdict.leaning == Some(Kind::Both);
            assert!(couples(segment) || leans, "{}", describe(&found));
            // None that says both begins before the knee.
            let both = segment.verdict.kind == Kind::Both;
            assert!(!both || segment.time[0] > knee - TOLERANCE * LENGTH, "{}", describe(&found));
        }
    }
}

/// The ramp of Figure 6, with fast forces: mode coupling above the knee, both below, up to where it sticks for most of a period.
/// The contact opens in every period; level, slope and mass are read all the same.
#[test]
fn the_ramp_of_figure_6_ends_in_both() {
    let mut params = Params::default();
    for (param, value) in [
        (Param::BeltVelocity, 7.0),
        (Param::BeltVelocityEnd, 0.0),
        (Param::RampDuration, 10.0),
        (Param::StartDisplacement, 1e-4),
        (Param::StartVelocity, 0.0),
    ] {
        params.set(param, value);
    }
    let ramp = Instance {
        params,
        law: bilinear(0.4, 0.3),
        impact_friction: true,
        motion: Motion::Ramp,
        heating: None,
        modal: None,
    };
    let recording = Recording { rate: 1000.0, duration: 10.0, skew: 0.0, force_skew: 0.0 };
    let samples = record(&ramp, &plan(1.0, 1.0, 12), &recording).samples;
    let open = samples.iter().filter(|sample| sample.normal_force < 1.0).count();
    assert!(open > 1000, "the contact is open in {open} samples");
    let found = run(&csv(&samples), &settings(coalescence(&ramp), DAMPING_RATIO)).unwrap();
    // 7 − 0.7 t = 5 m/s.
    let knee = 20.0 / 7.0;
    let growth = found.segments.iter().find(|s| s.state == State::Growing).unwrap();
    assert_eq!(growth.verdict.kind, Kind::ModeCoupling, "{}", describe(&found));
    let loud: Vec<&Segment> = found.segments.iter().filter(|s| s.state == State::Sustained).collect();
    assert!(loud[..loud.len() - 1].iter().all(|segment| couples(segment)), "{}", describe(&found));
    let both: Vec<&&Segment> = loud.iter().filter(|s| s.verdict.kind == Kind::Both).collect();
    assert!(!both.is_empty(), "{}", describe(&found));
    near("both from", both[0].time[0], knee, TOLERANCE * 10.0);
    let joined = |pair: &[&&Segment]| (pair[0].time[1] - pair[1].time[0]).abs() < 1e-9;
    assert!(both.windows(2).all(joined), "{}", describe(&found));
    assert!(both[both.len() - 1].time[1] > 9.0, "{}", describe(&found));
    let last = loud[loud.len() - 1];
    assert_eq!(last.verdict.leaning, Some(Kind::Both), "{}", describe(&found));
    // The law is 0.4 − 0.02 V, and what moves is m1 + m2: as much damping as they may have, or none.
    let below: Vec<&&&Segment> = both.iter().filter(|s| s.time[0] > knee).collect();
    assert!(!below.is_empty(), "{}", describe(&found));
    for segment in below {
        let friction = segment.friction.unwrap();
        assert_eq!(friction.reading, FrictionReading::Within);
        let [first, last] = segment.velocity.unwrap();
        let velocity = 0.5 * (first + last);
        near("level", friction.level.value, 0.4 - 0.02 * velocity, 0.002);
        near("slope", friction.slope.unwrap().value, -0.02, 0.002);
        let omega = TAU * segment.frequency.unwrap();
        near("damping", friction.damping.unwrap().value, DAMPING_RATIO * omega * 2.3 / 1000.0, 5e-5);
    }
}

/// A tone of 14.5 kHz at 1.1 times the sliding velocity whose phase jumps from −90° to −5° at `jump` (s).
fn tone(jump: f64, length: f64) -> Vec<Sample> {
    let omega = TAU * 14.5e3;
    let sample = |k: u32| {
        let t = f64::from(k) / *RATE;
        let belt_velocity = 0.05 - 0.04 * t / length;
        let phase = f64::to_radians(if t < jump { -90.0 } else { -5.0 });
        let size = 1.1 * belt_velocity * omega;
        Sample {
            t,
            tangential_acceleration: size * (omega * t).cos(),
            normal_acceleration: 0.3 * size * (omega * t + phase).cos(),
            tangential_force: 17.0 * 0.4,
            normal_force: 17.0,
            belt_velocity,
        }
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of samples")]
    (0..(length * *RATE) as u32).map(sample).collect()
}

#[test]
fn a_jump_of_the_phase_is_where_a_segment_ends() {
    for jump in [0.09, 0.15, 0.22] {
        let mut samples = tone(jump, LENGTH);
        sensed(&mut samples, true, 20.0, false, &mut Random::new(9));
        let found = run(&csv(&samples), &settings(0.2, DAMPING_RATIO)).unwrap();
        assert_eq!(found.segments.len(), 2, "{}", describe(&found));
        let [first, second] = &found.segments[..] else { panic!() };
        near("boundary", first.time[1], jump, 0.01 * LENGTH);
        near("before", first.phase.unwrap().value, -90.0, 1.0);
        near("after", second.phase.unwrap().value, -5.0, 1.0);
    }
    // Without a jump there is one segment.
    let mut samples = tone(2.0 * LENGTH, LENGTH);
    sensed(&mut samples, true, 20.0, false, &mut Random::new(9));
    let found = run(&csv(&samples), &settings(0.2, DAMPING_RATIO)).unwrap();
    assert_eq!(found.segments.len(), 1, "{}", describe(&found));
}

/// A vibration far from reversing the sliding may be driven: no witness speaks of its phase.
#[test]
fn a_weak_steady_tone_has_no_mechanism() {
    let mut samples = tone(0.15, LENGTH);
    for sample in &mut samples {
        sample.tangential_acceleration *= 0.1;
        sample.normal_acceleration *= 0.1;
    }
    sensed(&mut samples, true, 40.0, false, &mut Random::new(9));
    let found = run(&csv(&samples), &settings(0.2, DAMPING_RATIO)).unwrap();
    for segment in &found.segments {
        assert_eq!(segment.verdict.kind, Kind::Undecided, "{}", describe(&found));
        let phase = segment.testimonies.iter().find(|t| t.witness == Witness::Phase).unwrap();
        assert!(phase.chances.is_none() && phase.evidence.contains("may be driven"), "{}", phase.evidence);
    }
}

/// A mass on a spring with a damper, driven along two harmonics by what friction gives: forces that belong to its motion.
fn cycle(damping: f64, slope: f64) -> Vec<Sample> {
    const RATE: f64 = 2000.0;
    let (mass, omega, belt_velocity, length) = (2.3, TAU * 34.0, 3.0, 12.0);
    // A little beside the resonance, so that the forces swing.
    let stiffness = 1.05 * mass * omega * omega;
    let sample = |k: u32| {
        let t = f64::from(k) / RATE;
        let motion = |size: f64, harmonic: f64, phase: f64| {
            let (w, angle) = (harmonic * omega, harmonic * omega * t + phase);
            [size / w * angle.sin(), size * angle.cos(), -size * w * angle.sin()]
        };
        let [one, two] = [motion(0.75 * belt_velocity, 1.0, 0.0), motion(0.04 * belt_velocity, 2.0, 0.6)];
        let [x, v, a] = [0, 1, 2].map(|n| one[n] + two[n]);
        let tangential_force = 340.0 + mass * a + damping * v + stiffness * x;
        let friction = 0.34 + slope * (belt_velocity - v - belt_velocity);
        Sample {
            t,
            tangential_acceleration: a,
            normal_acceleration: 0.3 * a,
            tangential_force,
            normal_force: tangential_force / friction,
            belt_velocity,
        }
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of samples")]
    (0..(length * RATE) as u32).map(sample).collect()
}

/// The damping along the contact comes out of the power of friction, and decides whether a falling slope exceeds it.
#[test]
fn damping_is_read_within_the_oscillation() {
    for (damping, slope, exceeds) in
        [(2.0, -0.02, true), (2.0, 0.0, false), (40.0, -0.02, false), (10.0, -0.03, true)]
    {
        let mut samples = cycle(damping, slope);
        let normal = samples.iter().map(|sample| sample.normal_force).sum::<f64>() / samples.len() as f64;
        sensed(&mut samples, false, 60.0, false, &mut Random::new(4));
        let found = run(&csv(&samples), &settings(0.25, DAMPING_RATIO)).unwrap();
        let [segment] = &found.segments[..] else { panic!("{}", describe(&found)) };
        let friction = segment.friction.unwrap();
        assert_eq!(friction.reading, FrictionReading::Within, "{}", describe(&found));
        let (read, law) = friction.damping.zip(friction.slope).unwrap_or_else(|| panic!("{friction:?}"));
        near("slope", law.value, slope, 2.0 * law.error);
        near("damping", read.value, damping / normal, 2.0 * read.error);
        near("damping", read.value, damping / normal, 0.004);
        let expected = if exceeds { Kind::Both } else { Kind::ModeCoupling };
        assert_eq!(segment.verdict.leaning, Some(expected), "{}", describe(&found));
    }
}

/// What a wide swing shows of a slope may begin below the velocity that it goes about: "both" has less confidence then, and says so.
#[test]
fn a_wide_swing_says_both_with_less_confidence() {
    let mut rig = rig(0.168, 0.16, 0.0228, [0.02, 0.02]);
    for param in [Param::C1, Param::C2] {
        let damping = rig.params.require(param);
        rig.params.set(param, 0.05 * damping);
    }
    assert_eq!(right(&rig, 0.0), [Kind::Both]);
    let growth = linear::analyse(&rig).1.unwrap().growth_rate;
    let told = |reach: f64| {
        let duration = (reach / 1e-3).ln() / growth;
        let recording = Recording { rate: *RATE, duration, skew: 0.0, force_skew: 0.0 };
        let mut samples = record(&rig, &plan(1.0, 1.0, 12), &recording).samples;
        sensed(&mut samples, false, 60.0, false, &mut Random::new(3));
        let found = run(&csv(&samples), &settings(coalescence(&rig), DAMPING_RATIO)).unwrap();
        let grown = found.segments.last().unwrap();
        let power = grown.testimonies.iter().find(|t| t.witness == Witness::Power).unwrap();
        let (kind, confidence) = power.chances.unwrap_or_else(|| panic!("{}", describe(&found))).leading();
        assert_eq!(kind, Kind::Both, "{}", describe(&found));
        (confidence, power.evidence.contains("may begin below"))
    };
    let [(small, small_says), (wide, wide_says)] = [0.05, 0.8].map(told);
    assert!(small > 0.95 && !small_says, "{small}");
    assert!(wide < small - 0.04 && wide_says, "{wide}");
}

/// Without the velocity, or without forces, what can be told is told.
#[test]
fn lone_accelerometers_give_frequency_and_phase() {
    let mut samples = tone(0.15, LENGTH);
    sensed(&mut samples, true, 40.0, false, &mut Random::new(9));
    let text = String::from_utf8(csv(&samples)).unwrap();
    let only = |columns: usize| -> String {
        text.lines().map(|line| line.split(',').take(columns).collect::<Vec<_>>().join(",") + "\n").collect()
    };
    let found = run(only(3).as_bytes(), &Settings::default()).unwrap();
    near("boundary", found.segments[0].time[1], 0.15, 0.01 * LENGTH);
    near("phase", found.segments[1].phase.unwrap().value, -5.0, 1.0);
    let found = run(only(2).as_bytes(), &Settings::default()).unwrap();
    let segment = &found.segments[0];
    near("frequency", segment.frequency.unwrap(), 14.5e3, 5.0);
    assert_eq!((segment.state, segment.verdict.kind), (State::Sustained, Kind::Undecided));
    assert!(segment.testimonies.iter().all(|testimony| testimony.chances.is_none()));
    // That it becomes five times weaker with a velocity that nobody recorded is no decay, wherever it is cut.
    for tenths in [3, 5, 8, 10] {
        let own: Vec<&str> = text.lines().collect();
        let own = &own[..own.len() * tenths / 10];
        let rows = own.iter().map(|line| line.split(',').take(2).collect::<Vec<_>>().join(",") + "\n");
        let found = run(rows.collect::<String>().as_bytes(), &Settings::default()).unwrap();
        assert!(found.segments.iter().all(|s| s.verdict.kind == Kind::Undecided), "{}", describe(&found));
    }
}

/// A few strokes of the confusion table, of another seed: next to none is confidently wrong, and the judge turns red.
#[test]
fn few_strokes_are_confidently_wrong() {
    let judged = table(77, 2, &[Sensors::Slow, Sensors::Fast]);
    let count = |judged: &[crate::study::confusion::Judged], judge: usize, fate: Fate| {
        judged.iter().filter(|stroke| stroke.fate(judge) == fate).count()
    };
    assert_eq!(judged.len(), 40);
    // All together, and the mechanism that they are sure of.
    for (judge, least) in [(3, 8), (4, 20)] {
        let wrong = count(&judged, judge, Fate::ConfidentlyWrong);
        assert!(wrong <= 1, "{wrong} of 40");
        let right = count(&judged, judge, Fate::Right);
        assert!(right >= least, "{right} of 40");
    }
    // Slow sensors on a rig that is known to some per cent.
    let modelled = table(78, 2, &[Sensors::Model]);
    assert_eq!(modelled.len(), 20);
    let wrong = count(&modelled, 3, Fate::ConfidentlyWrong);
    assert!(wrong <= 1 && count(&modelled, 4, Fate::Right) >= 8, "{wrong} of 20");
    let mut planted = judged;
    for statement in planted.iter_mut().flat_map(|stroke| &mut stroke.statements) {
        statement.right = !statement.right;
    }
    assert!(count(&planted, 4, Fate::ConfidentlyWrong) >= 20);
}

/// At one velocity and friction what has not become visible yet is unstable: nothing says that it was stable until then.
#[test]
fn what_is_quiet_before_it_grows_is_not_stable() {
    for (mu, fast) in [(0.19, false), (0.30, true)] {
        let mut rig = rig(mu, mu, 0.025, [0.03; 2]);
        rig.params.set(Param::StartVelocity, 1e-12);
        assert!(linear::analyse(&rig).1.unwrap().growth_rate > 0.0);
        let recording = Recording { rate: *RATE, duration: LENGTH, skew: 0.0, force_skew: 0.0 };
        let mut samples = record(&rig, &plan(1.0, 1.0, 12), &recording).samples;
        sensed(&mut samples, !fast, 40.0, false, &mut Random::new(5));
        let settings = Settings { damping_ratio: 0.015, inclination: 0.024, ..Settings::default() };
        let found = run(&csv(&samples), &settings).unwrap();
        assert_eq!(found.segments[0].state, State::Quiet, "{}", describe(&found));
        let stable = found.segments.iter().any(|segment| segment.verdict.kind == Kind::NoInstability);
        assert!(!stable, "{mu}: {}", describe(&found));
    }
}
