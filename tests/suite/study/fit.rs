//! Materials fitted to measured friction.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::io::{Cursor, Read};

use crate::common::near;
use crate::study::strokes::Random;
use squealmap::model::Param;
use squealmap::model::friction::LawKind;
use squealmap::study::fit::made::{Wanted, made};
use squealmap::study::fit::table::material_csv;
use squealmap::study::fit::{Candidate, Fit, FitFault, compare, fit};
use squealmap::sweep::spec::Spec;
use squealmap_identify::Point;
use squealmap_identify::{FrictionColumn, Settings, read_points};

/// `sweeps/pad.csv`: rows of temperature, `mu_s`, `mu_d`; linear in between, knee at 5 m/s.
const PAD: [[f64; 3]; 3] = [[100.0, 0.10, 0.10], [300.0, 0.16, 0.12], [500.0, 0.32, 0.24]];

fn pad(velocity: f64, temperature: f64) -> f64 {
    let row = usize::from(temperature >= 300.0);
    let part = (temperature - PAD[row][0]) / 200.0;
    let at = |k: usize| PAD[row][k] + part * (PAD[row + 1][k] - PAD[row][k]);
    let w = (velocity / 5.0).min(1.0);
    at(1) * (1.0 - w) + at(2) * w
}

fn points(noise: f64) -> Vec<Point> {
    let mut random = Random::new(9);
    let point = |_| {
        let (velocity, temperature) = (random.between(0.0, 7.0), random.between(100.0, 500.0));
        Point {
            velocity,
            half_range: 0.0,
            temperature,
            friction: pad(velocity, temperature) + noise * random.normal(),
        }
    };
    (0..4000).map(point).collect()
}

#[test]
fn the_pad_is_found_again() {
    let rows = PAD.map(|row| row[0]);
    // Exact points give the material to rounding; noise of 0.01 on 4000 points leaves about 0.01/sqrt(4000/6) = 4e-4.
    for (noise, allowed, knee_allowed) in [(0.0, 1e-6, 1e-4), (0.01, 2e-3, 0.3)] {
        let found = fit(&points(noise), LawKind::Bilinear, &rows, None).unwrap();
        for (k, (param, values)) in found.columns.iter().take(2).enumerate() {
            assert_eq!(*param, [Param::MuS, Param::MuD][k]);
            for (row, value) in values.iter().enumerate() {
                near(param.info().name, *value, PAD[row][k + 1], allowed);
            }
        }
        assert_eq!(found.columns[2].0, Param::KneeVelocity);
        near("knee", found.columns[2].1[0], 5.0, knee_allowed);
        near("residual", found.residual, noise, 0.05 * noise + 1e-6);
    }
    // The comparison turns red for another pad.
    let mut wrong = points(0.0);
    for point in &mut wrong {
        point.friction += 0.01;
    }
    let found = fit(&wrong, LawKind::Bilinear, &rows, Some(5.0)).unwrap();
    near("shifted", found.columns[0].1[0], PAD[0][1] + 0.01, 1e-6);
}

/// Friction that is averaged while the velocity moves is no friction at the mean velocity, where the law bends: here two points tell its fall,
/// and one is averaged over the knee.
#[test]
fn what_is_averaged_over_the_knee_is_fitted_as_that() {
    let law = |v: f64| 0.05 + 0.1 * (1.0 - v / 5.0).max(0.0);
    let mean = |velocity: f64, half_range: f64| {
        let sum: f64 = (0..1000).map(|k| law(velocity + half_range * (f64::from(k) - 499.5) / 500.0)).sum();
        sum / 1000.0
    };
    let points: Vec<Point> = (0..9)
        .map(|k| 6.87 - 0.26 * f64::from(k))
        .map(|velocity| Point {
            velocity,
            half_range: 0.17,
            temperature: 20.0,
            friction: mean(velocity, 0.17),
        })
        .collect();
    let value =
        |points: &[Point], k: usize| fit(points, LawKind::Bilinear, &[20.0], None).unwrap().columns[k].1[0];
    for (k, expected) in [0.15, 0.05, 5.0].into_iter().enumerate() {
        near("law", value(&points, k), expected, 1e-3 * expected);
    }
    let taken_at_the_mean: Vec<Point> = points.iter().map(|p| Point { half_range: 0.0, ..*p }).collect();
    assert!((value(&taken_at_the_mean, 0) - 0.15).abs() > 0.01);
}

#[test]
fn other_laws() {
    let exponential = |v: f64| 0.2 + 0.3 * (-v / 0.8).exp();
    let points: Vec<Point> = (0..200)
        .map(|k| 0.02 * f64::from(k))
        .map(|velocity| Point {
            velocity: -velocity,
            half_range: 0.0,
            temperature: 20.0,
            friction: exponential(velocity),
        })
        .collect();
    let found = fit(&points, LawKind::Exponential, &[20.0], None).unwrap();
    let value = |k: usize| found.columns[k].1[0];
    near("mu_s", value(0), 0.5, 1e-5);
    near("mu_d", value(1), 0.2, 1e-5);
    near("stribeck_velocity", value(2), 0.8, 1e-4);
    let mean = points.iter().map(|point| point.friction).sum::<f64>() / 200.0;
    let constant = fit(&points, LawKind::Constant, &[20.0], None).unwrap();
    near("mean", constant.columns[0].1[0], mean, 1e-12);
}

#[test]
fn what_is_not_determined_is_named() {
    let at =
        |velocity: f64, temperature: f64| Point { velocity, half_range: 0.0, temperature, friction: 0.3 };
    let one_speed: Vec<Point> = (0..50).map(|k| at(2.0, f64::from(k))).collect();
    let found = fit(&one_speed, LawKind::Bilinear, &[0.0, 49.0], Some(5.0)).unwrap_err();
    assert!(matches!(found, FitFault::Undetermined { .. }), "{found}");
    assert!(found.to_string().contains("from 2 to 2 m/s"), "{found}");
    let cold: Vec<Point> = (0..50).map(|k| at(0.1 * f64::from(k), 20.0)).collect();
    let found = fit(&cold, LawKind::Bilinear, &[0.0, 40.0, 80.0], Some(5.0)).unwrap_err();
    assert!(matches!(found, FitFault::Undetermined { .. }), "{found}");
    assert!(matches!(fit(&cold[..1], LawKind::Bilinear, &[20.0], None), Err(FitFault::TooFew { .. })));
    assert!(matches!(fit(&cold, LawKind::Bilinear, &[20.0, 20.0], None), Err(FitFault::NotRising { .. })));
    assert!(matches!(fit(&cold, LawKind::Table, &[20.0], None), Err(FitFault::Law { .. })));
    let negative: Vec<Point> = cold.iter().map(|p| Point { friction: -0.1, ..*p }).collect();
    assert!(matches!(fit(&negative, LawKind::Constant, &[20.0], None), Err(FitFault::Negative { .. })));
}

#[test]
fn a_sweep_reads_the_material() {
    let mut table = "V,mu,temperature\n".to_owned();
    for point in points(0.0) {
        writeln!(table, "{},{},{}", point.velocity, point.friction, point.temperature).unwrap();
    }
    let input = Box::new(Cursor::new(table.into_bytes())) as Box<dyn Read>;
    let friction = FrictionColumn::Named("mu".to_owned());
    let read = read_points(input, "points.csv", &Settings::default(), &friction, None).unwrap().points;
    let found = fit(&read, LawKind::Bilinear, &PAD.map(|row| row[0]), None).unwrap();
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("material.csv"), material_csv(&found, &read, "points.csv")).unwrap();
    let sweep = "[friction]\nlaw = \"bilinear\"\nmaterial = \"material.csv\"\n[axes]\n\
                 temperature = { values = [200.0, 400.0] }\nbelt_velocity = { values = [3.0] }\n";
    let spec = Spec::parse(sweep, "sweep.toml", directory.path()).unwrap();
    near("mu at 200 °C", spec.instance(0).law.mu(3.0), pad(3.0, 200.0), 1e-5);
    near("mu at 400 °C", spec.instance(1).law.mu(3.0), pad(3.0, 400.0), 1e-5);
}

/// Of points of one law that law is the likeliest, and a law with more values is not preferred for its better fit alone.
#[test]
fn the_law_of_the_points_has_the_least_criteria() {
    let mut random = Random::new(21);
    let mu = |law: LawKind, v: f64| match law {
        LawKind::Bilinear => 0.4 - 0.1 * (v / 2.0).min(1.0),
        LawKind::Exponential => 0.3 + 0.1 * (-v / 0.6).exp(),
        _ => 0.3,
    };
    for law in [LawKind::Constant, LawKind::Bilinear, LawKind::Exponential] {
        let mut preferred = 0;
        for _ in 0..20 {
            let points: Vec<Point> = (0..200)
                .map(|k| 0.03 * f64::from(k))
                .map(|velocity| Point {
                    velocity,
                    half_range: 0.0,
                    temperature: 20.0,
                    friction: mu(law, velocity) + 0.003 * random.normal(),
                })
                .collect();
            let all = compare(&points, &[20.0], None);
            let of = |kind: LawKind| all.iter().find(|one| one.law == kind).unwrap();
            // By hand: n ln(Σr²/n) + 2k + 2k(k + 1)/(n − k − 1), k = 1 or 3 values of the law, and the variance.
            let found = of(law);
            let squares: f64 = found.fit.as_ref().unwrap().residuals.iter().map(|r| r * r).sum();
            let k: f64 = if law == LawKind::Constant { 2.0 } else { 4.0 };
            let fits = 200.0 * (squares / 200.0).ln();
            let [aicc, bic] = found.criteria.unwrap();
            near("AICc", aicc, fits + 2.0 * k + 2.0 * k * (k + 1.0) / (199.0 - k), 1e-9 * fits.abs());
            near("BIC", bic, fits + k * 200.0_f64.ln(), 1e-9 * fits.abs());
            let bic = |one: &Candidate| one.criteria.map_or(f64::INFINITY, |[_, bic]| bic);
            let least = all.iter().min_by(|a, b| bic(a).total_cmp(&bic(b))).unwrap();
            preferred += usize::from(least.law == law);
            let rises = |pair: &[Candidate]| pair[0].criteria.unwrap()[0] <= pair[1].criteria.unwrap()[0];
            assert!(all.windows(2).all(rises));
        }
        assert!(preferred >= 18, "{law:?}: {preferred} of 20");
    }
}

/// The best law is named with a warning where the points do not tell it from another: `AICc` less than 2 apart, or none.
#[test]
fn the_best_law_of_few_points_is_doubted() {
    let mut random = Random::new(5);
    let (mut doubted, mut sure) = (0, 0);
    for count in (3..60).step_by(3) {
        let points: Vec<Point> = (1..=count)
            .map(|k| 4.0 * f64::from(k) / f64::from(count))
            .map(|v| Point {
                velocity: v,
                half_range: 0.0,
                temperature: 20.0,
                friction: 0.4 - 0.02 * v + 0.01 * random.normal(),
            })
            .collect();
        let made = made(&points, "points", Wanted::Best, &[], None).unwrap();
        let aicc = |one: &Candidate| one.criteria.map(|[aicc, _]| aicc);
        let [first, second] = [0, 1].map(|k| aicc(&made.candidates[k]));
        let expected = first.is_none_or(|first| second.is_some_and(|second| second - first < 2.0));
        let warned = made.warnings.iter().any(|warning| warning.contains("is taken, but"));
        assert_eq!(warned, expected, "{count} points: {first:?}, {second:?}");
        assert_eq!(made.fit.law, made.candidates[0].law);
        *(if warned { &mut doubted } else { &mut sure }) += 1;
    }
    assert!(doubted > 2 && sure > 2, "{doubted}, {sure}");
}

/// Points at three temperatures with a knee each, and the fit of them.
fn with_knees(knees: [f64; 3], seed: u64) -> Fit {
    let mut random = Random::new(seed);
    let mut points = Vec::new();
    for ([temperature, mu_s, mu_d], knee) in PAD.into_iter().zip(knees) {
        for step in 1_u8..=80 {
            let velocity = 0.1 * f64::from(step);
            let w = (velocity / knee).min(1.0);
            let friction = (mu_s + 0.1) * (1.0 - w) + mu_d * w + 0.003 * random.normal();
            points.push(Point { velocity, half_range: 0.0, friction, temperature });
        }
    }
    fit(&points, LawKind::Bilinear, &PAD.map(|row| row[0]), None).unwrap()
}

#[test]
fn each_temperature_has_a_knee_of_its_own_where_the_points_ask_for_it() {
    let (knees, mut worst) = ([2.0, 4.0, 5.5], 0.0_f64);
    for seed in 0..12 {
        let found = with_knees(knees, seed);
        for (k, expected) in
            [PAD.map(|row| row[1] + 0.1), PAD.map(|row| row[2]), knees].into_iter().enumerate()
        {
            let errors = found.errors[k].clone().unwrap();
            for ((value, error), expected) in found.columns[k].1.iter().zip(errors).zip(expected) {
                worst = worst.max((value - expected).abs() / error);
            }
        }
    }
    // Of 108 values the farthest is some 2.8 standard errors off.
    assert!((1.0..4.5).contains(&worst), "{worst}");
    // Where one describes them, it is one, and better known.
    let (one, several) = (with_knees([4.0; 3], 1), with_knees(knees, 1));
    let error = |found: &Fit| found.errors[2].clone().unwrap()[1];
    assert!(
        one.columns[2].1.windows(2).all(|pair| pair[0].total_cmp(&pair[1]).is_eq()),
        "{:?}",
        one.columns[2]
    );
    assert!(error(&one) < 0.8 * error(&several), "{} and {}", error(&one), error(&several));
}

#[test]
fn a_temperature_that_is_given_takes_the_place_of_an_empty_column() {
    let text = "V (mm/s),mu,temperature [°C]\n10,0.5,\n20,0.4,\n";
    let friction = FrictionColumn::Named("mu".to_owned());
    let read = |temperature| {
        read_points(Box::new(Cursor::new(text)), "table", &Settings::default(), &friction, temperature)
    };
    let points = read(Some(500.0)).unwrap().points;
    let of: Vec<_> = points.iter().map(|point| (point.velocity, point.temperature)).collect();
    // Columns are known by their names, whatever unit stands behind.
    assert_eq!(of, [(0.01, 500.0), (0.02, 500.0)]);
    let why = read(None).unwrap_err().to_string();
    assert!(why.contains("temperature"), "{why}");
}
