//! Every branch of the classification, and both sides of every threshold.

use squealmap::engine::outcome::Outcome;
use squealmap::engine::regime::{Regime, THRESHOLDS, Thresholds, regime};
use squealmap::model::status::Status;

/// A completed outcome with the given fractions of stick, flight and reversed slip, and speeds of the halves.
fn outcome(stick: f64, free: f64, reverse: f64, speeds: [f64; 2]) -> Outcome {
    Outcome {
        status: Status::Ok,
        stick: Some(stick),
        free: Some(free),
        reverse: Some(reverse),
        speed_rms_halves: speeds,
        x2_std_halves: [1e-3, 1e-3],
        ay_rms_halves: [10.0, 10.0],
        ..Outcome::default()
    }
}

const BELT: f64 = 2.0;

/// The thresholds are part of what the columns mean: they change with the documentation only.
#[test]
fn thresholds_are_those_of_the_documentation() {
    let documented = Thresholds {
        state_counts: 0.001,
        decay: 0.99,
        small_speed: 0.01,
        small_growth: 1.01,
        settled: 0.01,
        apart: 0.05,
        outgrown: 1000.0,
    };
    assert_eq!(THRESHOLDS, documented);
}

#[test]
fn a_state_counts_from_a_thousandth_of_the_window() {
    let (under, over) = (0.000_999, 0.001);
    for (stick, free, reverse, expected) in [
        (1.0, 0.0, 0.0, Regime::Stuck),
        (1.0 - 1e-12, 0.0, 0.0, Regime::StickSlip),
        (over, over, over, Regime::DetachingStickSlip),
        (over, over, 0.0, Regime::DetachingStickSlip),
        (under, over, over, Regime::Detaching),
        (under, over, 0.0, Regime::Detaching),
        (over, under, over, Regime::StickSlip),
        (over, under, 0.0, Regime::StickSlip),
        (under, under, over, Regime::SlipReversal),
        (0.0, 0.0, 1.0, Regime::SlipReversal),
        (under, under, under, Regime::Slip),
        (0.0, 0.0, 0.0, Regime::Slip),
    ] {
        for stable in [false, true] {
            let one = outcome(stick, free, reverse, [1.0, 1.0]);
            assert_eq!(regime(&one, BELT, stable).0, expected, "{stick} {free} {reverse}");
        }
    }
    // The states count before a decay does.
    assert_eq!(regime(&outcome(0.1, 0.0, 0.0, [1.0, 0.1]), BELT, true).0, Regime::StickSlip);
    assert_eq!(regime(&outcome(0.0, 0.0, 0.1, [1.0, 0.1]), BELT, true).0, Regime::SlipReversal);
    assert_eq!(regime(&outcome(0.0, 0.1, 0.0, [1.0, 0.1]), BELT, true).0, Regime::Detaching);
}

#[test]
fn slip_or_equilibrium_on_both_sides_of_every_threshold() {
    use Regime::{Equilibrium, Slip};
    // 1 % of the belt velocity is 0.02.
    for (first, second, stable, expected) in [
        // Decay, at any amplitude.
        (1.0, 0.9899, false, Equilibrium),
        (1.0, 0.9901, false, Slip),
        (1.0, 0.9901, true, Slip),
        (1.0, 1.0, true, Slip),
        // Small and not growing.
        (0.0199, 0.0199, false, Equilibrium),
        (0.0201, 0.0201, false, Slip),
        (0.01, 0.010_099, false, Equilibrium),
        (0.01, 0.010_101, false, Slip),
        // Small in both halves and linearly stable: a beat.
        (0.01, 0.0199, true, Equilibrium),
        (0.01, 0.0199, false, Slip),
        (0.01, 0.0201, true, Slip),
        (0.0201, 0.0200, true, Slip),
        // At the limit itself.
        (0.02, 0.02, true, Slip),
        (0.0199, 0.02, false, Equilibrium),
        // Rest.
        (0.0, 0.0, false, Equilibrium),
        (1e-9, 1e-8, false, Slip),
        (1e-9, 1e-8, true, Equilibrium),
    ] {
        let (found, settled) = regime(&outcome(0.0, 0.0, 0.0, [first, second]), BELT, stable);
        assert_eq!(found, expected, "{first} → {second}, stable: {stable}");
        assert!(settled);
    }
    // The scale is the belt velocity.
    assert_eq!(regime(&outcome(0.0, 0.0, 0.0, [0.05, 0.05]), 10.0, false).0, Equilibrium);
    assert_eq!(regime(&outcome(0.0, 0.0, 0.0, [0.05, 0.05]), 1.0, false).0, Slip);
}

#[test]
fn settled_compares_both_observables_of_the_halves() {
    let with = |x2: [f64; 2], ay: [f64; 2]| {
        let base = outcome(0.1, 0.0, 0.0, [1.0, 1.0]);
        regime(&Outcome { x2_std_halves: x2, ay_rms_halves: ay, ..base }, BELT, false).1
    };
    let same = [1.0, 1.0];
    assert!(with(same, same));
    for (halves, expected) in
        [([1.0, 0.9901], true), ([0.9901, 1.0], true), ([1.0, 0.9899], false), ([0.9899, 1.0], false)]
    {
        assert_eq!(with(halves, same), expected, "x2_std {halves:?}");
        assert_eq!(with(same, halves), expected, "ay_rms {halves:?}");
        assert_eq!(with(halves, halves), expected, "both {halves:?}");
    }
    // θ = 0: y1 does not move at all.
    assert!(with(same, [0.0, 0.0]));
    // An equilibrium is settled however fast it is approached; nothing else is.
    for (speeds, expected) in [([1.0, 0.5], true), ([1.0, 1.0], false)] {
        let base = outcome(0.0, 0.0, 0.0, speeds);
        let decaying = Outcome { x2_std_halves: [1.0, 0.5], ay_rms_halves: [1.0, 0.5], ..base };
        assert_eq!(regime(&decaying, BELT, false).1, expected);
    }
}
