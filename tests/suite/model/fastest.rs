//! The fastest mode of each contact state against eigenvalues by nalgebra and closed forms; no step passes it.

use crate::common::{close, constant, instance};
use crate::engine::exact;
use crate::instances::random;
use nalgebra::Schur;
use squealmap::engine::method::pace::{Turns, longest_turn};
use squealmap::engine::plan::StartKind;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::instance::Instance;

/// The fastest modes of slip, reversed slip, stick and flight, 1/s.
fn fastest(instance: &Instance) -> [f64; 4] {
    let scene = Scene::new(instance, StartKind::Kick).expect("an equilibrium");
    scene.model.fastest.map(|rate| rate / scene.units.time)
}

/// The largest magnitude of an eigenvalue of slip against `mu`.
fn by_schur(instance: &Instance, mu: f64) -> f64 {
    let matrix = exact::sliding(instance, mu, 0.0);
    // Of displacements times a frequency: entries of one size.
    let scale = (matrix[(2, 0)].abs() + matrix[(3, 1)].abs()).sqrt();
    let mut balanced = matrix;
    for i in 0..2 {
        for j in 2..4 {
            balanced[(i, j)] *= scale;
            balanced[(j, i)] /= scale;
        }
    }
    let schur = Schur::try_new(balanced, 1e-14, 10_000).expect("converged");
    schur.complex_eigenvalues().iter().map(|z| z.norm()).fold(0.0, f64::max)
}

#[test]
fn slip_is_that_of_the_eigenvalues() {
    let mut sharp = 0;
    for one in random(2000) {
        let value = |param| one.params.get(param).expect("a value");
        let mu = one.law.mu(value(Param::BeltVelocity));
        let one = Instance { law: constant(mu), ..one.clone() };
        for (sigma, found) in [(1.0, fastest(&one)[0]), (-1.0, fastest(&one)[1])] {
            let expected = by_schur(&one, sigma * mu);
            // Modes that attract each other, or a damper of one on both, are slower than the bound has them.
            assert!(found >= 0.99 * expected && found <= 3.0 * expected, "{found} for {expected}: {one:?}");
            sharp += usize::from(found <= 1.1 * expected);
        }
    }
    assert!(sharp > 3000, "{sharp} of 4000 within 10 %");
}

#[test]
fn stick_and_flight_are_closed_forms() {
    let one = instance(constant(0.3), &[(Param::BeltVelocity, 1.0), (Param::C1, 0.0), (Param::C2, 0.0)]);
    let [_, _, stick, free] = fastest(&one);
    close("stick", stick, (101_000.0_f64 / 2.12).sqrt(), 1e-12);
    close("flight", free, (101_000.0_f64 * 2.3 / (2.12 * 0.18)).sqrt(), 1e-12);
    // At θ = 0 nothing moves m1 in contact: k2 costs no step.
    let mut upright = one.clone();
    upright.params.set(Param::Theta, 0.0);
    upright.params.set(Param::K2, 1e12);
    let [slip, reverse, stick, _] = fastest(&upright);
    close("slip", slip, (1e5_f64 / 2.3).sqrt(), 1e-12);
    assert_eq!((reverse, stick), (slip, 0.0));
    // A rising law holds the motion: its slope is a damper. A falling one is none.
    for (slope, expected) in [(1000.0, 1000.0 * 1000.0 / 2.3), (-1000.0, (1e5_f64 / 2.3).sqrt())] {
        let law = squealmap::model::friction::FrictionLaw::Bilinear {
            mu_s: 1.0,
            mu_d: 1.0 + slope * 1e-3,
            knee_velocity: 1e-3,
        };
        let mut steep = Instance { law, ..upright.clone() };
        steep.params.set(Param::BeltVelocity, 1e-6);
        close("slope", fastest(&steep)[0], expected, 1e-3);
    }
    // Beyond Painlevé's limit there is no such slip.
    let mut tilted = Instance { law: constant(1.5), ..one };
    tilted.params.set(Param::Theta, std::f64::consts::FRAC_PI_4);
    assert!(fastest(&tilted)[1].is_infinite() && fastest(&tilted)[0].is_finite());
}

/// The amplification of a step of an undamped mode by its truncated series: never above 1 up to the bound, for every
/// order in use; above it soon after.
#[test]
fn the_stable_turn_is_that_of_the_series() {
    let growth = |order: i32, turn: f64| {
        // x'' = −x: cosine and sine to that order; the velocity is the derivative of what is left.
        let sum = |first: i32, last: i32| {
            let mut term = (1..=first).fold(1.0, |term, k| term * turn / f64::from(k));
            let mut sum = 0.0;
            let mut degree = first;
            while degree <= last {
                sum += term;
                term *= -turn * turn / f64::from((degree + 1) * (degree + 2));
                degree += 2;
            }
            sum
        };
        let [a, b, c, d] = [sum(0, order), sum(1, order), -sum(1, order - 1), sum(0, order - 1)];
        let (half, det) = (0.5 * (a + d), a * d - b * c);
        let root = half * half - det;
        if root > 0.0 { half.abs() + root.sqrt() } else { det.sqrt() }
    };
    let steps = |from: f64, to: f64| (0..1000).map(move |i| from + (to - from) * f64::from(i) / 1000.0);
    for (order, soon) in [(8, 3.5), (12, 3.5), (13, 4.0), (16, 3.5)] {
        let stable = longest_turn(order);
        let growth = |turn| growth(i32::try_from(order).expect("small"), turn);
        assert!(steps(0.01, stable).all(|turn| growth(turn) <= 1.0 + 1e-11), "order {order}");
        assert!(steps(stable, soon).any(|turn| growth(turn) > 1.0 + 1e-9), "order {order}");
    }
    assert!(steps(0.01, 3.6).all(|turn| growth(13, turn) <= 1.0), "order 13 damps");

    let turns = |order, tolerance| Turns::new(order, tolerance).longest_steps(&[1.0, 2.0, 0.0, 100.0]);
    let longest = turns(12, 1e-3);
    assert!(longest[0] <= longest_turn(12) && longest[2].is_infinite());
    close("twice as fast", longest[1], 0.5 * longest[0], 1e-15);
    close("in flight", longest[3], 0.01 * longest_turn(12), 1e-15);
    assert!(turns(12, f64::INFINITY).iter().all(|step| step.is_infinite()));
    // (5e-7 · 8!)^(1/8) and (1e-7 · 13!)^(1/13).
    close("kept by order 8", turns(8, 2e-4)[0], 0.613_848_7, 1e-6);
    close("kept by order 13", turns(13, 1e-5)[0], 1.640_381, 1e-6);
    // (1e-5 · 13!)^(1/13) where the tolerance is coarse, not of modes that ring more often.
    close("kept of a coarse tolerance", turns(13, 1e-3)[0], 2.337_711, 1e-6);
    close("seen in flight", turns(13, 1e-3)[3], 0.01 * 2.35, 1e-15);
    let stiff = Turns::new(13, 1e-3).longest_steps(&[1e3; 4]);
    close("kept of a stiff mode", stiff[0], 1e-3 * 1.640_381, 1e-6);
}
