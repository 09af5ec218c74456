//! Runs whose material changes its temperature: in closed form, against another integrator, and on every engine.

use std::sync::Arc;

use crate::common::{close, instance, plan};
use crate::engine::motions::{run, stroke};
use crate::engines::Engine;
use crate::instances::Uniform;
use smallvec::SmallVec;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::model::Param;
use squealmap::model::friction::{LawKind, MuTable};
use squealmap::model::heating::{Heating, STAIRS};
use squealmap::model::instance::Instance;
use squealmap::model::material::{Material, Outside};
use squealmap::model::motion::{Corners, Motion};
use squealmap::model::status::Status;

/// A material with these temperatures and columns, and tables where there are any.
fn material(temperature: &[f64], columns: &[(Param, &[f64])], tables: Vec<Arc<MuTable>>) -> Arc<Material> {
    Arc::new(Material {
        name: "pad.csv".to_owned(),
        temperature: temperature.to_vec(),
        columns: columns.iter().map(|(param, values)| (*param, values.to_vec())).collect(),
        tables,
        outside: Outside::Error,
    })
}

/// An instance of a law of a material, at these corners of time and temperature.
fn heated(kind: LawKind, of: &Arc<Material>, corners: &[[f64; 2]], values: &[(Param, f64)]) -> Instance {
    let mut one = instance(crate::common::constant(0.0), values);
    one.params.set(Param::Temperature, corners[0][1]);
    let corners = Corners::Own(SmallVec::from_slice(corners));
    let heating = Heating::new(Arc::clone(of), kind, None, corners);
    one.law = heating.law_at(one.params.require(Param::Temperature), &mut one.params);
    one.heating = Some(Arc::new(heating));
    one
}

/// What an engine may be off by beside another: rounding, the truncation of steps, and in f32 that of a long sum.
fn digits(engine: Engine) -> f64 {
    match engine {
        Engine::Reference | Engine::CpuF64 | Engine::KernelF64 => 1e-6,
        Engine::CpuF32 | Engine::KernelF32 => 1e-4,
    }
}

/// Sliding on a law that falls more and more is linear with a coefficient that changes:
/// `m ẍ = −k x − c ẋ + N μ(V − ẋ, ϑ(t))`, here by Runge's and Kutta's method with the temperature as it is, not in stairs.
#[test]
fn what_slides_is_as_another_integrator_has_it() {
    let (duration, velocity) = (1.5, 2.0);
    let of = material(
        &[100.0, 300.0, 500.0],
        &[(Param::MuS, &[0.3, 0.32, 0.5]), (Param::MuD, &[0.3, 0.25, 0.35])],
        Vec::new(),
    );
    let corners = [[0.0, 100.0], [1.0, 500.0], [duration, 250.0]];
    let values = [
        (Param::BeltVelocity, velocity),
        (Param::RampDuration, duration),
        (Param::Theta, 0.0),
        (Param::C1, 8.0),
        (Param::StartVelocity, 0.02),
    ];
    let one = heated(LawKind::Bilinear, &of, &corners, &values);
    let value = |param| one.params.require(param);
    let (m, k, c, n) =
        (value(Param::M1) + value(Param::M2), value(Param::K1), value(Param::C1), value(Param::FExt));
    let between = |x: f64, [a, b]: [f64; 2], [u, v]: [f64; 2]| u + (v - u) * (x - a) / (b - a);
    let temperature = |t: f64| {
        if t <= 1.0 {
            between(t, [0.0, 1.0], [100.0, 500.0])
        } else {
            between(t, [1.0, duration], [500.0, 250.0])
        }
    };
    let column = |t: f64, [low, middle, high]: [f64; 3]| {
        let at = temperature(t);
        if at <= 300.0 {
            between(at, [100.0, 300.0], [low, middle])
        } else {
            between(at, [300.0, 500.0], [middle, high])
        }
    };
    let mu = |t: f64, speed: f64| {
        let (mu_s, mu_d) = (column(t, [0.3, 0.32, 0.5]), column(t, [0.3, 0.25, 0.35]));
        mu_s + (mu_d - mu_s) * speed / 5.0
    };
    let acceleration = |t: f64, x: f64, v: f64| (n * mu(t, velocity - v) - k * x - c * v) / m;
    let (mut x, mut v) = (n * mu(0.0, velocity) / k, 0.02);
    let (mut sum, mut squares) = (0.0, 0.0);
    let parts = 60_000;
    let h = duration / f64::from(parts);
    for part in 0..parts {
        let t = f64::from(part) * h;
        let (k1x, k1v) = (v, acceleration(t, x, v));
        let (k2x, k2v) = (v + 0.5 * h * k1v, acceleration(t + 0.5 * h, x + 0.5 * h * k1x, v + 0.5 * h * k1v));
        let (k3x, k3v) = (v + 0.5 * h * k2v, acceleration(t + 0.5 * h, x + 0.5 * h * k2x, v + 0.5 * h * k2v));
        let (k4x, k4v) = (v + h * k3v, acceleration(t + h, x + h * k3x, v + h * k3v));
        let (before, middle) = (x, x + h * v / 2.0 + h * h * k1v / 8.0);
        x += h * (k1x + 2.0 * k2x + 2.0 * k3x + k4x) / 6.0;
        v += h * (k1v + 2.0 * k2v + 2.0 * k3v + k4v) / 6.0;
        sum += h * (before + 4.0 * middle + x) / 6.0;
        squares += h * (before * before + 4.0 * middle * middle + x * x) / 6.0;
    }
    let mean = sum / duration;
    let std = (squares / duration - mean * mean).sqrt();
    for engine in Engine::ALL {
        let outcome = run(engine, &one);
        let what = engine.name();
        assert_eq!((outcome.stick, outcome.free), (Some(0.0), Some(0.0)), "{what}");
        // Stairs of 1/1024 of all rises and falls are not quite the temperature.
        close(&format!("{what}, mean"), outcome.x2_mean.expect("a value"), mean, 1e-5);
        close(&format!("{what}, deviation"), outcome.x2_std.expect("a value"), std, 5e-4);
    }
}

/// A body that sticks lets go when cooling has brought the limit of stick down to the force of its spring.
#[test]
fn what_sticks_lets_go_as_it_cools() {
    let (velocity, duration) = (0.01, 0.05);
    let of = material(&[0.0, 100.0], &[(Param::MuS, &[0.2, 0.9]), (Param::MuD, &[0.2, 0.2])], Vec::new());
    let values = [
        (Param::BeltVelocity, velocity),
        (Param::RampDuration, duration),
        (Param::Theta, 0.0),
        // It starts with the velocity of the belt.
        (Param::StartVelocity, velocity),
    ];
    let one = heated(LawKind::Constant, &of, &[[0.0, 100.0], [duration, 0.0]], &values);
    let (k, c, n) = (1e5, 0.1, 1000.0);
    // k (x0 + V t) + c V = N μ_s(t), where x0 balances μ_d.
    let falling = n * (0.9 - 0.2) / duration;
    let released = (n * (0.9 - 0.2) - c * velocity) / (k * velocity + falling);
    for engine in Engine::ALL {
        let outcome = run(engine, &one);
        // It does not stick again: the limit is at last that of sliding.
        let error = (outcome.stick.expect("a value") * duration - released).abs();
        let stair = duration / f64::from(STAIRS);
        assert!(error <= stair, "{}: {error} s off, a stair is of {stair} s", engine.name());
        assert!(error > 0.0 && released < 0.97 * duration);
    }
}

/// Strokes that stick, slip and lift off while the law changes, also in the number of its pieces, are alike on all engines.
#[test]
fn engines_agree_while_it_warms() {
    let table =
        |velocity: &[f64], mu: &[f64]| Arc::new(MuTable { velocity: velocity.to_vec(), mu: mu.to_vec() });
    let rows = [100.0, 300.0, 500.0];
    let mu_s: (Param, &[f64]) = (Param::MuS, &[0.3, 0.36, 0.6]);
    let mu_d: (Param, &[f64]) = (Param::MuD, &[0.2, 0.22, 0.3]);
    let tables = vec![
        table(&[0.0, 2.0], &[0.3, 0.2]),
        table(&[0.0, 1.0, 3.0, 6.0], &[0.4, 0.36, 0.25, 0.26]),
        table(&[0.0, 0.5, 4.0], &[0.6, 0.5, 0.3]),
    ];
    let cases = [
        (LawKind::Constant, material(&rows, &[mu_s, mu_d], Vec::new())),
        (LawKind::Bilinear, material(&rows, &[mu_s, mu_d], Vec::new())),
        (
            LawKind::Exponential,
            material(&rows, &[mu_s, mu_d, (Param::StribeckVelocity, &[1.0, 0.6, 0.3])], Vec::new()),
        ),
        (LawKind::Rational, material(&rows, &[mu_s, (Param::Decay, &[0.1, 0.3, 0.2])], Vec::new())),
        (LawKind::Table, material(&rows, &[], tables)),
    ];
    let mut seen = [0.0; 2];
    for (kind, of) in cases {
        for (motion, velocity, theta) in
            [(Motion::Ramp, 0.3, 0.0), (Motion::Sine, 3.0, 0.05), (Motion::Ramp, 2.0, 0.3)]
        {
            let values = [
                (Param::BeltVelocity, velocity),
                (Param::RampDuration, 0.5),
                (Param::Theta, theta),
                (Param::StartDisplacement, 2e-4),
            ];
            let corners = [[0.0, 480.0], [0.2, 120.0], [0.5, 500.0]];
            let one = Instance { motion, ..heated(kind, &of, &corners, &values) };
            let expected = run(Engine::Reference, &one);
            let stick = expected.stick.expect("a value");
            seen = [seen[0] + stick, seen[1] + expected.free.expect("a value")];
            for engine in Engine::ALL {
                let outcome = run(engine, &one);
                let what = format!("{} of {} at {velocity} m/s", engine.name(), kind.name());
                for (found, wanted) in [
                    (outcome.x2_std, expected.x2_std),
                    (outcome.ax_rms, expected.ax_rms),
                    (outcome.x2_mean, expected.x2_mean),
                    (outcome.friction_mean, expected.friction_mean),
                ] {
                    close(&what, found.expect("a value"), wanted.expect("a value"), 20.0 * digits(engine));
                }
                assert!((outcome.stick.expect("a value") - stick).abs() < 2e-3, "{what}");
            }
        }
    }
    assert!(seen[0] > 0.5 && seen[1] > 0.0, "sticks and flies: {seen:?}");
}

/// A temperature that comes back to where it was leaves the law as it was: half below and half above on every stair.
#[test]
fn stairs_lie_about_the_temperature() {
    let of = material(&[0.0, 100.0], &[(Param::MuD, &[0.2, 0.4])], Vec::new());
    let corners = Corners::Own(SmallVec::from_slice(&[[0.0, 10.0], [2.0, 90.0], [3.0, 90.0], [5.0, 50.0]]));
    let heating = Heating::new(of, LawKind::Constant, None, corners);
    let (mut time, mut stairs, mut farthest, mut area) = (0.0, 0, 0.0_f64, 0.0);
    while time < 5.0 {
        let (temperature, end) = heating.stair(time);
        assert!(end > time, "{time}");
        for part in [0.0, 0.3, 1.0 - 1e-9] {
            let at = time + part * (end.min(5.0) - time);
            farthest = farthest.max((heating.temperature(at) - temperature).abs());
        }
        area += temperature * (end.min(5.0) - time);
        (time, stairs) = (end, stairs + 1);
    }
    let height = 120.0 / f64::from(STAIRS);
    assert!(farthest <= 0.5 * height * (1.0 + 1e-9) && farthest > 0.49 * height, "{farthest}");
    close("area", area, 2.0 * 50.0 + 90.0 + 2.0 * 70.0, 1e-12);
    assert!((STAIRS..STAIRS + 8).contains(&stairs), "{stairs}");
    assert_eq!(heating.stair(7.0), (50.0, f64::INFINITY));
}

/// Random strokes of random pads: of every law, up and down in temperature, with fewer and more stairs than periods. Where two
/// step lengths of the reference agree, all engines of f64 do, and those of f32 but for what an event on its edge may decide.
#[test]
fn engines_agree_on_random_courses() {
    let mut u = Uniform(20_261_127);
    let (mut compared, mut apart) = (0, 0);
    for number in 0..40 {
        let kind = LawKind::ALL[number % LawKind::ALL.len()];
        let rows = [0.0, 100.0, 200.0];
        let mut three = |low: f64, high: f64| -> Vec<f64> {
            rows.iter().map(|_| low + (high - low) * u.next()).collect()
        };
        let (mu_d, above, scale) = (three(0.05, 0.3), three(0.0, 0.4), three(0.1, 2.0));
        let mu_s: Vec<f64> = mu_d.iter().zip(&above).map(|(mu, above)| mu + above).collect();
        let of = if kind == LawKind::Table {
            let tables = (0..rows.len()).map(|row| {
                let (top, end, knee) = (mu_s[row], mu_d[row], scale[row]);
                let (mut velocity, mut mu) = (vec![0.0, knee, 3.0 * knee], vec![top, 0.5 * (top + end), end]);
                // Another number of pieces in every row.
                (velocity, mu) = (velocity.drain(..=row.max(1)).collect(), mu.drain(..=row.max(1)).collect());
                Arc::new(MuTable { velocity, mu })
            });
            material(&rows, &[], tables.collect())
        } else {
            let columns: [(Param, &[f64]); 5] = [
                (Param::MuS, &mu_s),
                (Param::MuD, &mu_d),
                (Param::KneeVelocity, &scale),
                (Param::StribeckVelocity, &scale),
                (Param::Decay, &scale),
            ];
            material(&rows, &columns, Vec::new())
        };
        let duration = u.log(0.02, 3.0);
        let values = [
            (Param::BeltVelocity, u.log(0.05, 5.0)),
            (Param::RampDuration, duration),
            (Param::RiseDuration, 0.2 * duration),
            (Param::Theta, 0.6 * u.next() - 0.2),
            (Param::C1, u.log(0.1, 50.0)),
            (Param::C2, u.log(0.1, 50.0)),
            (Param::StartVelocity, u.next()),
            (Param::Restitution, if u.next() < 0.5 { 0.0 } else { 0.5 }),
        ];
        let mut corners = vec![[0.0, 200.0 * u.next()]];
        for at in [0.4, 0.7, 1.0] {
            corners.push([at * duration, 200.0 * u.next()]);
        }
        let motion = [Motion::Ramp, Motion::Sine, Motion::Trapeze][number % 3].clone();
        let one = Instance { motion, ..heated(kind, &of, &corners, &values) };
        let reference = |steps| Engine::Reference.run(&one, &Plan { steps_per_period: steps, ..stroke() });
        let [expected, finer] = [12, 17].map(reference);
        let std = |outcome: &Outcome| outcome.x2_std.unwrap_or(f64::NAN);
        if expected.status != Status::Ok || (std(&finer) / std(&expected) - 1.0).abs() > 1e-7 {
            continue;
        }
        compared += 1;
        for engine in Engine::ALL.into_iter().filter(|engine| engine.slower() < 2.0 || duration < 0.2) {
            let outcome = engine.run(&one, &stroke());
            let what = format!("{number}: {} of {}", engine.name(), kind.name());
            assert_eq!(outcome.status, Status::Ok, "{what}");
            let off = (std(&outcome) / std(&expected) - 1.0).abs();
            if digits(engine) < 1e-5 {
                assert!(off < 1e-5, "{what}: {off}");
            } else if off > 1e-3 {
                apart += 1;
            }
        }
    }
    assert!(compared >= 20 && apart <= 2, "{compared} compared, {apart} apart in f32");
}

/// Stairs that come in step with the vibration do not push what slides: a single mass, one period of which is as long as a stair,
/// goes with its equilibrium, and its standard deviation is that of a straight line.
#[test]
fn stairs_push_nothing_that_slides() {
    let of = material(&[0.0, 100.0], &[(Param::MuS, &[0.1, 0.2]), (Param::MuD, &[0.1, 0.2])], Vec::new());
    let (duration, window) = (30.86, 1.0);
    let values = [
        (Param::BeltVelocity, 0.1),
        (Param::RampDuration, duration),
        (Param::Theta, 0.0),
        (Param::StartVelocity, 1e-6),
    ];
    let one = heated(LawKind::Constant, &of, &[[0.0, 0.0], [duration, 100.0]], &values);
    // The spring gives way by 1e-3 m in all; a straight line over a part of it has its length over the root of 12.
    let expected = 1e-3 * (window / duration) / 12.0_f64.sqrt();
    for engine in [Engine::Reference, Engine::CpuF64, Engine::CpuF32] {
        let outcome = engine.run(&one, &plan(duration - window, window, 12));
        close(engine.name(), outcome.x2_std.expect("a value"), expected, 1e-3);
        assert_eq!(outcome.stick, Some(0.0), "{}", engine.name());
        assert!(outcome.ax_peak.expect("a value") < 0.01, "{}: {:?}", engine.name(), outcome.ax_peak);
    }
}

/// A body that flies while the law loses pieces slides on one of those that are left when it lands.
#[test]
fn a_law_may_lose_pieces_during_a_flight() {
    let table = |rows: &[[f64; 2]]| {
        let (velocity, mu) = rows.iter().map(|[velocity, mu]| (*velocity, *mu)).unzip();
        Arc::new(MuTable { velocity, mu })
    };
    let tables = vec![
        table(&[[0.0, 0.446], [0.7914, 0.4936]]),
        table(&[[0.0, 0.0298], [0.3783, 0.537]]),
        table(&[[0.0, 0.2955], [0.0014, 0.0647], [0.3497, 0.4425]]),
    ];
    let of = material(&[0.0, 275.221_316_943_280_67, 600.0], &[], tables);
    for duration in [0.12, 0.18, 0.22, 0.46, 0.88] {
        let values = [
            (Param::BeltVelocity, 2.5),
            (Param::RampDuration, duration),
            (Param::Theta, 0.1),
            (Param::C1, 0.0),
            (Param::C2, 10.0),
            (Param::StartVelocity, -1.0),
        ];
        let one =
            heated(LawKind::Table, &of, &[[0.0, 272.3], [duration, 0.0], [2.0 * duration, 0.0]], &values);
        for engine in Engine::ALL {
            let outcome = run(engine, &one);
            assert_eq!(outcome.status, Status::Ok, "{} {duration}", engine.name());
        }
    }
}
