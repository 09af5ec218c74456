//! Motions of the belt: in closed form, against another integrator, and on every engine.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::common::{bilinear, close, constant, instance, near, plan};
use crate::engines::Engine;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::{Motion, MotionTable};
use squealmap::model::status::Status;

/// The velocity of a belt over time.
type Velocity<'a> = &'a dyn Fn(f64) -> f64;

/// A stroke is measured as a whole.
pub(crate) fn stroke() -> Plan {
    Plan { settle: Duration::Seconds(0.0), measure: Duration::Ramp, ..plan(0.0, 1.0, 12) }
}

fn table(corners: &[[f64; 2]]) -> Motion {
    Motion::Table(Arc::new(MotionTable {
        name: "stroke.csv".to_owned(),
        corners: corners.into(),
        temperature: None,
    }))
}

pub(crate) fn run(engine: Engine, one: &Instance) -> Outcome {
    let outcome = engine.run(one, &stroke());
    assert_eq!(outcome.status, Status::Ok, "{}", engine.name());
    outcome
}

/// What an engine may be off by: rounding, the truncation of steps, and in f32 that of a long sum.
fn digits(engine: Engine) -> f64 {
    match engine {
        Engine::Reference | Engine::CpuF64 | Engine::KernelF64 => 1e-7,
        Engine::CpuF32 | Engine::KernelF32 => 1e-4,
    }
}

/// The velocity at a time on straight lines between corners.
fn straight(corners: &[[f64; 2]; 4], t: f64) -> f64 {
    let at = corners.windows(2).find(|pair| t <= pair[1][0]).unwrap_or(&corners[2..]);
    at[0][1] + (at[1][1] - at[0][1]) * (t - at[0][0]) / (at[1][0] - at[0][0])
}

/// Mean and standard deviation of what a belt has moved, by Simpson's rule on its velocity between corners.
fn moved(velocity: Velocity, duration: f64, parts: usize) -> (f64, f64) {
    let h = duration / parts as f64;
    let (mut x, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for part in 0..parts {
        let t = part as f64 * h;
        // Within a part of one slope x is a parabola.
        let (a, b) = (velocity(t), velocity(t + h));
        let middle = x + h * (3.0 * a + b) / 8.0;
        let end = x + h * (a + b) / 2.0;
        sum += h * (x + 4.0 * middle + end) / 6.0;
        squares += h * (x * x + 4.0 * middle * middle + end * end) / 6.0;
        x = end;
    }
    let mean = sum / duration;
    (mean, (squares / duration - mean * mean).sqrt())
}

/// A body that sticks moves with the belt: its standard deviation is that of the belt's position.
#[test]
fn what_sticks_goes_with_the_belt() {
    // It starts where sliding balances it, and sticking holds 800 N more: the spring's 0.6 mm at 1e5 N/m are 60 N.
    let (velocity, duration) = (0.01, 0.09);
    let values = [
        (Param::BeltVelocity, velocity),
        (Param::RampDuration, duration),
        (Param::StartVelocity, 0.0),
        (Param::Theta, 0.0),
        (Param::RiseDuration, 0.02),
    ];
    let held = FrictionLaw::Constant { mu_s: 0.9, mu_d: 0.1 };
    let stuck = |motion: Motion| Instance { motion, ..instance(held.clone(), &values) };
    let trapeze = move |t: f64| velocity * (t / 0.02).min((duration - t) / 0.02).clamp(0.0, 1.0);
    let sine = move |t: f64| velocity * (PI * t / duration).sin();
    let corners = [[0.0, 0.0], [0.03, 0.01], [0.045, 0.002], [0.09, 0.006]];
    let jagged = move |t: f64| straight(&corners, t);
    let all: [(Motion, Velocity, f64); 3] =
        [(Motion::Trapeze, &trapeze, 0.0), (Motion::Sine, &sine, 4e-4), (table(&corners), &jagged, 0.0)];
    for (motion, velocity, chords) in all {
        let one = stuck(motion.clone());
        let (_, expected) = moved(velocity, duration, 90_000);
        for engine in Engine::ALL {
            let outcome = run(engine, &one);
            let what = format!("{} {}", motion.name(), engine.name());
            close(&format!("{what}, time"), outcome.simulated_time, duration, 1e-12);
            close(&what, outcome.x2_std.expect("a value"), expected, digits(engine) + chords);
            assert_eq!(outcome.stick, Some(1.0), "{what}");
        }
    }
}

/// Sliding on a falling law is linear: `m ẍ = −k x − c ẋ + N μ(V − ẋ)`, here by Runge's and Kutta's method.
#[test]
fn what_slides_is_as_another_integrator_has_it() {
    let (velocity, duration) = (3.0, 0.4);
    let values = [
        (Param::BeltVelocity, velocity),
        (Param::RampDuration, duration),
        (Param::Theta, 0.0),
        (Param::C1, 5.0),
        (Param::StartVelocity, 0.05),
    ];
    let corners = [[0.0, 1.0], [0.1, 3.0], [0.25, 2.0], [0.4, 2.5]];
    let one = Instance { motion: table(&corners), ..instance(bilinear(0.3, 0.2), &values) };
    let belt = |t: f64| straight(&corners, t);
    let value = |param| one.params.require(param);
    let (m, k, c, n) =
        (value(Param::M1) + value(Param::M2), value(Param::K1), value(Param::C1), value(Param::FExt));
    let mu = |speed: f64| 0.3 - 0.1 * speed / 5.0;
    let acceleration = |t: f64, x: f64, v: f64| (n * mu(belt(t) - v) - k * x - c * v) / m;
    // The equilibrium of the largest velocity, and the kick.
    let (mut x, mut v, mut sum, mut squares) = (n * mu(velocity) / k, 0.05, 0.0, 0.0);
    let parts = 40_000;
    let h = duration / f64::from(parts);
    let begun = x;
    for part in 0..parts {
        let t = f64::from(part) * h;
        let (k1x, k1v) = (v, acceleration(t, x, v));
        let (k2x, k2v) = (v + 0.5 * h * k1v, acceleration(t + 0.5 * h, x + 0.5 * h * k1x, v + 0.5 * h * k1v));
        let (k3x, k3v) = (v + 0.5 * h * k2v, acceleration(t + 0.5 * h, x + 0.5 * h * k2x, v + 0.5 * h * k2v));
        let (k4x, k4v) = (v + h * k3v, acceleration(t + h, x + h * k3x, v + h * k3v));
        let before = x - begun;
        let middle = before + h * v / 2.0 + h * h * k1v / 8.0;
        x += h * (k1x + 2.0 * k2x + 2.0 * k3x + k4x) / 6.0;
        v += h * (k1v + 2.0 * k2v + 2.0 * k3v + k4v) / 6.0;
        let after = x - begun;
        sum += h * (before + 4.0 * middle + after) / 6.0;
        squares += h * (before * before + 4.0 * middle * middle + after * after) / 6.0;
    }
    let mean = sum / duration;
    let expected = (squares / duration - mean * mean).sqrt();
    for engine in Engine::ALL {
        let outcome = run(engine, &one);
        close(engine.name(), outcome.x2_std.expect("a value"), expected, digits(engine).max(1e-6));
        assert_eq!((outcome.stick, outcome.free), (Some(0.0), Some(0.0)), "{}", engine.name());
    }
}

/// A table of two corners is a ramp, to the bit; another corner on its line changes rounding alone.
#[test]
fn a_table_of_two_corners_is_a_ramp() {
    let values = [
        (Param::BeltVelocity, 7.0),
        (Param::BeltVelocityEnd, 1.0),
        (Param::RampDuration, 0.5),
        (Param::StartDisplacement, 1e-3),
    ];
    let ramp = instance(bilinear(0.4, 0.3), &values);
    for engine in Engine::ALL {
        let expected = run(engine, &ramp);
        let same = Instance { motion: table(&[[0.0, 7.0], [0.5, 1.0]]), ..ramp.clone() };
        assert_eq!(run(engine, &same), expected, "{}", engine.name());
        let split = Instance { motion: table(&[[0.0, 7.0], [0.25, 4.0], [0.5, 1.0]]), ..ramp.clone() };
        let other = Instance { motion: table(&[[0.0, 7.0], [0.25, 4.5], [0.5, 1.0]]), ..ramp.clone() };
        let std = |one: &Instance| run(engine, one).x2_std.expect("a value");
        let expected = expected.x2_std.expect("a value");
        close(engine.name(), std(&split), expected, 100.0 * digits(engine));
        assert!(
            (std(&other) / expected - 1.0).abs() > 0.01,
            "{}: a corner off the line is seen",
            engine.name()
        );
    }
}

/// Strokes that stick, slip back and lift off are alike on all engines of f64, on a motion with many corners.
#[test]
fn engines_agree_on_strokes() {
    for (mu_s, mu_d, theta) in [(0.4, 0.3, 0.01), (0.5, 0.2, 0.05), (0.6, 0.6, 0.01)] {
        let values = [
            (Param::BeltVelocity, 3.0),
            (Param::RampDuration, 0.6),
            (Param::RiseDuration, 0.1),
            (Param::Theta, theta),
            (Param::StartDisplacement, 1e-4),
        ];
        for motion in [Motion::Sine, Motion::Trapeze] {
            let one = Instance { motion, ..instance(bilinear(mu_s, mu_d), &values) };
            let expected = run(Engine::Reference, &one);
            assert!(expected.stick.expect("a value") > 0.0, "it sticks");
            for engine in Engine::ALL {
                let outcome = run(engine, &one);
                let what = format!("{} on a {}", engine.name(), one.motion.name());
                let (x, e) = (outcome.x2_std.expect("a value"), expected.x2_std.expect("a value"));
                close(&what, x, e, if digits(engine) > 1e-6 { 2e-2 } else { 1e-4 });
            }
        }
    }
}

#[test]
fn corners_are_where_they_should_be() {
    let values = [
        (Param::BeltVelocity, 2.0),
        (Param::RampDuration, 1.0),
        (Param::RiseDuration, 0.25),
        (Param::BeltVelocityEnd, 1.0),
    ];
    let params = instance(constant(0.3), &values).params;
    assert_eq!(*Motion::Ramp.corners(&params), [[0.0, 2.0], [1.0, 1.0]]);
    assert_eq!(*Motion::Trapeze.corners(&params), [[0.0, 0.0], [0.25, 2.0], [0.75, 2.0], [1.0, 0.0]]);
    let sine = Motion::Sine.corners(&params);
    assert_eq!((sine[0], sine[sine.len() - 1]), ([0.0, 0.0], [1.0, 0.0]));
    let farthest = (0..1000).map(|k| f64::from(k) / 1000.0);
    let off = farthest
        .map(|t| (Motion::Sine.velocity(&params, t) - 2.0 * (PI * t).sin()).abs())
        .fold(0.0, f64::max);
    assert!((1e-4..=2.0 * 3.1e-4).contains(&off), "{off}");
    // More than half of the time to rise is a triangle.
    let mut steep = params;
    steep.set(Param::RiseDuration, 0.7);
    assert_eq!(*Motion::Trapeze.corners(&steep), [[0.0, 0.0], [0.5, 2.0], [1.0, 0.0]]);
    near("before", Motion::Trapeze.velocity(&params, 0.125), 1.0, 1e-15);
    near("after", Motion::Ramp.velocity(&params, 3.0), 1.0, 0.0);
    let steady = instance(constant(0.3), &[(Param::BeltVelocity, 2.0)]).params;
    assert!(
        Motion::Ramp.is_steady(&steady)
            && !Motion::Ramp.is_steady(&params)
            && !Motion::Sine.is_steady(&steady)
    );
}
