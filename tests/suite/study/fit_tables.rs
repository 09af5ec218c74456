//! Tables fitted to measured friction that no law describes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::fs;

use crate::cli::program::{squealmap, unwrapped};
use crate::common::near;
use crate::study::strokes::Random;
use squealmap::model::friction::FrictionLaw;
use squealmap::study::fit::FitFault;
use squealmap::study::fit::binned::{Binned, LEAST_POINTS, MOST_BINS, binned};
use squealmap::sweep::spec::Spec;
use squealmap_identify::Point;

/// Falls, and rises again from 1.2 m/s on, the more the hotter.
fn curve(velocity: f64, temperature: f64) -> f64 {
    0.2 + temperature / 2000.0 + 0.2 * (-velocity / 0.5).exp() + 0.02 * velocity
}

fn points(noise: f64, count: usize) -> Vec<Point> {
    drawn(31, noise, count)
}

fn drawn(seed: u64, noise: f64, count: usize) -> Vec<Point> {
    let mut random = Random::new(seed);
    let point = |k: usize| {
        let (velocity, temperature) = (random.between(0.0, 5.0), [100.0, 300.0, 500.0][k % 3]);
        Point {
            velocity: -velocity,
            half_range: 0.0,
            temperature,
            friction: curve(velocity, temperature) + noise * random.normal(),
        }
    };
    (0..count).map(point).collect()
}

/// How far every bin is from a curve, in its standard errors.
fn distances(found: &Binned, curve: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let of_row = |row: &squealmap::study::fit::binned::Row| {
        let temperature = row.temperature;
        let distance = |bin: &squealmap::study::fit::binned::Bin| {
            (bin.friction - curve(bin.velocity, temperature)) / bin.error
        };
        row.bins.iter().map(distance).collect::<Vec<_>>()
    };
    found.rows.iter().flat_map(of_row).collect()
}

/// Draws that are judged together: of one, with some thirty bins, a third are beyond these limits by chance.
const DRAWS: u64 = 12;

/// Whether the stated errors are those that are made: nearly all within two, their squares little above 1 in the mean. A bin knows
/// its scatter by 6 points and more, so that the distances are Student's t: of 5 degrees of freedom the squares are 5/3 in the mean, and one
/// of 240 is beyond five.
fn are_as_stated(distances: &[f64]) -> bool {
    let count = distances.len() as f64;
    let beyond = distances.iter().filter(|z| z.abs() > 2.0).count() as f64;
    let squares = distances.iter().map(|z| z * z).sum::<f64>() / count;
    println!("{count} bins, {beyond} beyond two standard errors, mean square {squares:.2}");
    beyond <= 0.1 * count && (0.5..1.6).contains(&squares)
}

/// The slowest bin holds the points down to rest: the law goes on below its mean.
#[test]
fn a_straight_law_is_straight_down_to_rest() {
    let law = |velocity: f64| 0.4 - 0.03 * velocity;
    let point = |k: u32| {
        let velocity = 0.05 * f64::from(k);
        Point { velocity, half_range: 0.0, temperature: 100.0, friction: law(velocity) }
    };
    let points: Vec<Point> = (0..60).map(point).collect();
    let found = binned(&points, &[]).unwrap();
    let course = &found.courses(&points)[0].points;
    assert_eq!(course[0][0].to_bits(), 0.0_f64.to_bits());
    let slowest = found.rows[0].bins[0].velocity;
    for [velocity, friction] in course.iter().filter(|point| point[0] <= slowest) {
        assert!((friction - law(*velocity)).abs() < 1e-12, "{velocity}: {friction}");
    }
}

/// A table at another temperature than that of its points is told.
#[test]
fn a_table_far_from_its_points_is_warned_of() {
    let points = points(0.01, 600);
    assert_eq!(binned(&points, &[100.0, 300.0, 500.0]).unwrap().elsewhere().len(), 0);
    let told = binned(&points, &[100.0, 450.0]).unwrap().elsewhere();
    assert!(told.len() == 1 && told[0].contains("at 450 °C were measured at 400 °C"), "{told:?}");
}

#[test]
fn a_curve_is_found_within_the_stated_errors() {
    for (noise, count) in [(0.01, 3000), (0.03, 1500), (0.02, 300)] {
        let found = binned(&points(noise, count), &[]).unwrap();
        assert_eq!(found.rows.iter().map(|row| row.temperature).collect::<Vec<_>>(), [100.0, 300.0, 500.0]);
        for row in &found.rows {
            assert!((2..=MOST_BINS).contains(&row.bins.len()));
            assert!(row.bins.iter().all(|bin| bin.points >= LEAST_POINTS));
            assert_eq!(row.bins.iter().map(|bin| bin.points).sum::<usize>(), count / 3);
        }
        let all = |curve: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            let found = (0..DRAWS).map(|draw| binned(&drawn(31 + draw, noise, count), &[]).unwrap());
            found.flat_map(|found| distances(&found, curve)).collect()
        };
        assert!(are_as_stated(&all(&curve)), "noise of {noise}");
        // Another curve is told from it.
        assert!(!are_as_stated(&all(&|v, t| curve(v, t) + 0.5 * noise)), "noise of {noise}");
        near("deviation", found.fit.deviation.unwrap(), noise, 0.15 * noise);
    }
    // More points or less noise bear more bins.
    let bins = |noise, count| binned(&points(noise, count), &[]).unwrap().rows[0].bins.len();
    assert!(bins(0.1, 300) < bins(0.01, 3000));
}

#[test]
fn points_at_a_few_velocities_are_bins_by_themselves() {
    let speeds = [0.0, 0.25, 0.5, 2.0, 4.0];
    let exact = |k: usize| {
        let velocity = speeds[k % 5];
        Point { velocity, half_range: 0.0, temperature: 20.0, friction: curve(velocity, 20.0) }
    };
    let found = binned(&(0..100).map(exact).collect::<Vec<_>>(), &[]).unwrap();
    let [row] = &found.rows[..] else { panic!("one temperature") };
    assert_eq!(row.bins.iter().map(|bin| bin.velocity).collect::<Vec<_>>(), speeds);
    for bin in &row.bins {
        near("mu", bin.friction, curve(bin.velocity, 20.0), 1e-15);
        near("error", bin.error, 0.0, 1e-15);
        assert_eq!(bin.points, 20);
    }
    // Set points that are not quite met are one bin each, not two with noise for a slope between them.
    let mut random = Random::new(3);
    let met = |k: usize| {
        let velocity = [1.0, 2.0, 4.0][k % 3] * (1.0 + 0.003 * random.normal());
        Point { velocity, half_range: 0.0, temperature: 20.0, friction: 0.3 + 0.02 * random.normal() }
    };
    let found = binned(&(0..600).map(met).collect::<Vec<_>>(), &[]).unwrap();
    assert!(found.rows[0].bins.len() <= 3, "{:?}", found.rows[0].bins);
}

#[test]
fn temperatures_are_those_of_the_points_or_as_asked() {
    let mut random = Random::new(4);
    let mut drift = |temperature: f64| {
        let one = |_| Point {
            velocity: random.between(0.0, 5.0),
            half_range: 0.0,
            temperature: temperature + random.between(-2.0, 2.0),
            friction: 0.3,
        };
        (0..200).map(one).collect::<Vec<_>>()
    };
    let points = [drift(100.0), drift(300.0)].concat();
    let found = binned(&points, &[]).unwrap();
    assert_eq!(found.rows.len(), 2, "temperatures between, where nothing was measured, have no table");
    near("cold", found.rows[0].temperature, 100.0, 0.3);
    let asked = binned(&points, &[90.0, 310.0]).unwrap();
    assert_eq!(asked.fit.temperature, [90.0, 310.0]);
    near("cold", asked.rows[0].measured, 100.0, 0.3);
}

#[test]
fn what_makes_no_table_is_named() {
    let at = |velocity: f64, friction: f64| Point { velocity, half_range: 0.0, temperature: 20.0, friction };
    let few: Vec<Point> = (0..11).map(|k| at(f64::from(k), 0.3)).collect();
    let why = binned(&few, &[]).unwrap_err();
    assert_eq!(
        why.to_string(),
        "11 point(s) near 20 °C, at 0 to 10 m/s, do not make a table, which takes two bins of 6 points at velocities 2 % \
         apart or more; measure more there, or ask for other rows with --temperatures"
    );
    let one_speed: Vec<Point> = (0..50).map(|_| at(2.0, 0.3)).collect();
    assert!(matches!(binned(&one_speed, &[]), Err(FitFault::FewBins { .. })));
    assert!(matches!(binned(&few, &[20.0, 40.0]), Err(FitFault::FewBins { .. })));
    assert!(matches!(binned(&[], &[]), Err(FitFault::NoPoints)));
    assert!(matches!(binned(&few, &[40.0, 20.0]), Err(FitFault::NotRising { .. })));
    let negative: Vec<Point> = (0..50).map(|k| at(f64::from(k), -0.1)).collect();
    assert!(matches!(binned(&negative, &[]), Err(FitFault::Negative { .. })));
}

#[test]
fn what_fit_writes_is_a_material_of_a_sweep() {
    let directory = tempfile::tempdir().unwrap();
    let mut text = "V,mu,temperature\n".to_owned();
    let measured = points(0.005, 3000);
    for point in &measured {
        writeln!(text, "{},{},{}", point.velocity, point.friction, point.temperature).unwrap();
    }
    fs::write(directory.path().join("p.csv"), text).unwrap();
    let ended =
        squealmap(directory.path(), &["fit", "p.csv", "--friction", "mu", "--law", "table", "-o", "pad"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("law = \"table\"\nmaterial = \"material.csv\""), "{}", ended.out);
    let figure = fs::read_to_string(directory.path().join("pad/fit.svg")).unwrap();
    assert!(figure.contains("law: table"), "the figure shows the tables");
    // No law comes near it, which the criteria say.
    assert!(
        ended.out.contains("law \"table\": root mean square residual") && ended.out.contains("AICc +0.0")
    );
    let table = ended.out.lines().find(|line| line.starts_with("law \"table\":")).unwrap();
    assert!(table.contains("AICc +0.0"), "{table}");
    let sweep = "title = \"Pad\"\n[friction]\nlaw = \"table\"\nmaterial = \"material.csv\"\n[axes]\n\
                 temperature = { from = 100, to = 500, points = 5 }\nbelt_velocity = { values = [0.5, 3.0] }\n\
                 [response]\nsettle = \"10 periods\"\nmeasure = \"10 periods\"\n";
    fs::write(directory.path().join("pad/s.toml"), sweep).unwrap();
    let ended = squealmap(directory.path(), &["run", "pad/s.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let spec = Spec::read(&directory.path().join("pad/s.toml")).unwrap();
    for index in 0..10 {
        let instance = spec.instance(index);
        let temperature = 100.0 + 100.0 * f64::from(u32::try_from(index / 2).unwrap());
        // A few standard errors of some 0.005/sqrt(33), and what a straight line leaves of the curve.
        for v in [0.3, 1.0, 2.5, 4.5] {
            near("mu", instance.law.mu(v), curve(v, temperature), 5e-3);
        }
        let FrictionLaw::Table(table) = &instance.law else { panic!("no table") };
        assert!(table.velocity.len() <= 2 * MOST_BINS + 1);
    }
    let short = squealmap(
        directory.path(),
        &["fit", "p.csv", "--friction", "mu", "--law", "table", "--temperatures", "100,900"],
    );
    assert_eq!(short.code, Some(2));
    assert!(unwrapped(&short.err).contains("0 point(s) near 900 °C"), "{}", short.err);
    // What `calibrate` makes of it is a sweep over its temperatures.
    let arguments = [
        "calibrate",
        "--frequencies",
        "14200,14700",
        "--damping-ratio",
        "0.0145",
        "--critical-friction",
        "0.23",
        "--load",
        "17",
        "--mass",
        "0.0054",
        "--velocities",
        "0.004,0.05",
        "--material",
        "pad/material.csv",
        "-o",
        "made",
    ];
    let ended = squealmap(directory.path(), &arguments);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let made = Spec::read(&directory.path().join("made/calibrated.toml")).unwrap();
    assert!(made.material.is_some_and(|material| material.has_tables()));
}
