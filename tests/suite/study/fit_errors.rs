//! What `fit` says of its own errors: residuals, standard errors, and values beyond what was measured.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::path::Path;

use crate::cli::program::{squealmap, unwrapped};
use crate::common::close;
use crate::study::strokes::Random;
use squealmap::model::friction::LawKind;
use squealmap::study::fit::{Fit, fit};
use squealmap_identify::Point;

/// Points of a bilinear law, 0.4 at rest and 0.3 from 5 m/s on, at temperatures from 100 to 300 °C, with noise.
fn write_points(directory: &Path, noise: f64) -> Vec<[f64; 3]> {
    let mut random = Random::new(5);
    let mut text = "V,mu,temperature\n".to_owned();
    let mut points = Vec::new();
    for k in 0..600 {
        // The extremes are met exactly.
        let temperature = if k < 2 { 100.0 + 200.0 * f64::from(k) } else { random.between(100.0, 300.0) };
        let velocity = random.between(0.0, 7.0);
        let mu = 0.4 - 0.1 * (velocity / 5.0).min(1.0) + noise * random.normal();
        writeln!(text, "{velocity},{mu},{temperature}").unwrap();
        points.push([velocity, mu, temperature]);
    }
    std::fs::write(directory.join("p.csv"), text).unwrap();
    points
}

fn command(directory: &Path, arguments: &[&str]) -> (String, String) {
    let base = ["fit", "p.csv", "--friction", "mu", "-o", "out"];
    let ended = squealmap(directory, &[&base, arguments].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    (ended.out, unwrapped(&ended.err))
}

/// A campaign at three temperatures has three rows: between them nothing was measured.
#[test]
fn repeated_temperatures_are_the_rows() {
    let directory = tempfile::tempdir().unwrap();
    let mut text = "V,mu,temperature\n".to_owned();
    for (temperature, mu_s) in [(300, 0.5), (100, 0.4), (200, 0.45)] {
        for velocity in (1..=28).map(|k| 0.25 * f64::from(k)) {
            let mu = mu_s - 0.1 * (velocity / 5.0).min(1.0);
            writeln!(text, "{velocity},{mu},{temperature}").unwrap();
        }
    }
    std::fs::write(directory.path().join("p.csv"), text).unwrap();
    let (_, said) = command(directory.path(), &[]);
    assert_eq!(said, "");
    let material = std::fs::read_to_string(directory.path().join("out/material.csv")).unwrap();
    let rows: Vec<Vec<f64>> = material
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 3, "{material}");
    for (row, [temperature, mu_s]) in rows.iter().zip([[100.0, 0.4], [200.0, 0.45], [300.0, 0.5]]) {
        close("temperature", row[0], temperature, 1e-12);
        close("mu_s", row[1], mu_s, 1e-4);
        close("mu_d", row[2], mu_s - 0.1, 1e-4);
    }
}

#[test]
fn rows_beyond_the_measured_temperatures_are_told() {
    let directory = tempfile::tempdir().unwrap();
    write_points(directory.path(), 0.01);
    let (_, said) = command(directory.path(), &[]);
    assert_eq!(said, "", "the rows of its own lie within");
    let (_, said) = command(directory.path(), &["--temperatures", "100,200,300"]);
    assert_eq!(said, "");
    let (_, said) = command(directory.path(), &["--temperatures", "20,200,500"]);
    for part in ["warning", "20", "500", "100 to 300 °C", "extrapolated", "--temperatures"] {
        assert!(said.contains(part), "`{part}` is not in: {said}");
    }
    // Points beyond the rows count for the nearest one.
    let (_, said) = command(directory.path(), &["--temperatures", "150,250"]);
    for part in ["warning", "150 to 250 °C", "nearest row", "of 600"] {
        assert!(said.contains(part), "`{part}` is not in: {said}");
    }
}

#[test]
fn residuals_and_standard_errors_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let points = write_points(directory.path(), 0.01);
    let (out, _) = command(directory.path(), &["--temperatures", "100,300"]);
    assert!(out.contains("# Standard errors") && out.contains("wrote out/residuals.csv"), "{out}");
    let material = std::fs::read_to_string(directory.path().join("out/material.csv")).unwrap();
    for part in ["# Standard errors", "100 to 300 °C", "m/s"] {
        assert!(material.contains(part), "`{part}` is not in: {material}");
    }
    let rows: Vec<Vec<f64>> = std::fs::read_to_string(directory.path().join("out/residuals.csv"))
        .unwrap()
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), points.len());
    // The material itself, read by hand: straight between its two rows, and between rest and the knee.
    let table: Vec<Vec<f64>> = material
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with("temperature"))
        .map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
        .collect();
    let mut squares = 0.0;
    for (row, [velocity, mu, temperature]) in rows.iter().zip(points) {
        let part = (temperature - 100.0) / 200.0;
        let at = |k: usize| table[0][k] + part * (table[1][k] - table[0][k]);
        let fitted = at(1) + (at(2) - at(1)) * (velocity / at(3)).min(1.0);
        let expected = [velocity, temperature, mu, fitted, mu - fitted];
        for (found, expected) in row.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{row:?} instead of {expected:?}");
        }
        squares += (mu - fitted).powi(2);
    }
    // Noise of 0.01 from 600 points is known to 3 %.
    let deviation = (squares / 595.0).sqrt();
    assert!(
        (deviation / 0.01 - 1.0).abs() < 0.1 && out.contains(&format!("{deviation:.2e}")),
        "{deviation}: {out}"
    );
}

/// A table of friction coefficients has no forces: the remedy is the column that it has.
#[test]
fn a_table_of_friction_coefficients_is_told_how_to_be_read() {
    let directory = tempfile::tempdir().unwrap();
    write_points(directory.path(), 0.01);
    let ended = squealmap(directory.path(), &["fit", "p.csv"]);
    assert_eq!(ended.code, Some(2));
    assert!(unwrapped(&ended.err).contains("with --friction"), "{}", ended.err);
}

/// `outside = "clamp"` allows temperatures that were not measured; how many there are is told before the sweep is run.
#[test]
fn a_sweep_beyond_its_material_is_told() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("m.csv"), "temperature,mu_s,mu_d\n100,0.4,0.3\n300,0.3,0.2\n")
        .unwrap();
    let check = |axis: &str| {
        let sweep = format!(
            "[friction]\nmaterial = \"m.csv\"\noutside = \"clamp\"\n[belt]\nbelt_velocity = 1\n\
             [axes]\ntemperature = {axis}\n"
        );
        std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
        let ended = squealmap(directory.path(), &["check", "s.toml"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        ended.out
    };
    let said = check("{ values = [50, 100, 200, 300, 301] }");
    assert!(said.contains("m.csv: 100 to 300 °C; 2 of 5 temperature(s)"), "{said}");
    let said = check("{ values = [100, 200] }");
    assert!(said.contains("m.csv: 100 to 300 °C\n"), "{said}");
}

/// Where every point is slower than the knee, nothing tells where it is.
#[test]
fn a_knee_that_was_not_reached_is_told() {
    let directory = tempfile::tempdir().unwrap();
    let mut random = Random::new(6);
    let mut text = "V,mu\n".to_owned();
    for _ in 0..200 {
        let velocity = random.between(0.0, 4.0);
        writeln!(text, "{velocity},{}", 0.4 - 0.02 * velocity + 0.001 * random.normal()).unwrap();
    }
    std::fs::write(directory.path().join("p.csv"), text).unwrap();
    let (out, said) = command(directory.path(), &["--at-temperature", "20"]);
    for part in ["warning", "knee_velocity", "--law-velocity"] {
        assert!(said.contains(part), "`{part}` is not in: {said}");
    }
    assert!(!out.contains("NaN") && !out.contains("inf"), "{out}");
}

/// Points of one temperature.
fn at_20(velocity: f64, friction: f64) -> Point {
    Point { velocity, half_range: 0.0, friction, temperature: 20.0 }
}

fn errors(found: &Fit, column: usize) -> f64 {
    found.errors[column].as_ref().unwrap()[0]
}

/// The mean of `n` values has the standard error `s/√n`; a straight line those of simple regression.
#[test]
fn standard_errors_are_those_of_textbooks() {
    let mut random = Random::new(3);
    let points: Vec<Point> =
        (0..50).map(|_| at_20(random.between(0.0, 4.0), 0.3 + 0.02 * random.normal())).collect();
    let n = points.len() as f64;
    let mean = points.iter().map(|point| point.friction).sum::<f64>() / n;
    let s = (points.iter().map(|point| (point.friction - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let found = fit(&points, LawKind::Constant, &[20.0], None).unwrap();
    close("s", found.deviation.unwrap(), s, 1e-12);
    close("mean", errors(&found, 0), s / n.sqrt(), 1e-12);

    // Below its given knee the bilinear law is the line a + b v, mu_s = a at v = 0 and mu_d = a + b v_k at v = v_k.
    let knee = 5.0;
    let found = fit(&points, LawKind::Bilinear, &[20.0], Some(knee)).unwrap();
    let (sum, square) =
        points.iter().fold((0.0, 0.0), |(sum, square), p| (sum + p.velocity, square + p.velocity.powi(2)));
    let (middle, spread) = (sum / n, square - sum * sum / n);
    let b = points.iter().map(|p| (p.velocity - middle) * p.friction).sum::<f64>() / spread;
    let left = |p: &Point| p.friction - mean - b * (p.velocity - middle);
    let s = (points.iter().map(|p| left(p).powi(2)).sum::<f64>() / (n - 2.0)).sqrt();
    close("s of the line", found.deviation.unwrap(), s, 1e-10);
    for (column, at) in [(0, 0.0), (1, knee)] {
        let expected = s * (1.0 / n + (at - middle).powi(2) / spread).sqrt();
        close("value of the line", errors(&found, column), expected, 1e-9);
    }
    // A velocity that was given is not measured.
    assert_eq!(found.errors[2], None);
    for (point, residual) in points.iter().zip(&found.residuals) {
        assert!((left(point) - residual).abs() < 1e-12);
    }
    // As many points as values say nothing of errors.
    let two = fit(&[at_20(0.0, 0.4), at_20(4.0, 0.3)], LawKind::Bilinear, &[20.0], Some(knee)).unwrap();
    assert!(two.deviation.is_none() && two.errors.iter().all(Option::is_none));
}

/// Noise drawn anew again and again: values are off by their standard errors.
#[test]
fn standard_errors_cover_what_is_true() {
    const DRAWS: usize = 300;
    let (mu_s, mu_d, velocity, noise) = (0.5, 0.3, 1.2, 0.01);
    for law in [LawKind::Exponential, LawKind::Bilinear] {
        let mut random = Random::new(17);
        let mut off = [const { Vec::new() }; 3];
        for _ in 0..DRAWS {
            let points: Vec<Point> = (0..120)
                .map(|k| {
                    let v = 0.05 * f64::from(k);
                    let w = if law == LawKind::Bilinear {
                        (v / velocity).min(1.0)
                    } else {
                        1.0 - (-v / velocity).exp()
                    };
                    at_20(v, mu_s + (mu_d - mu_s) * w + noise * random.normal())
                })
                .collect();
            let found = fit(&points, law, &[20.0], None).unwrap();
            assert!(!found.open);
            for (k, truth) in [mu_s, mu_d, velocity].into_iter().enumerate() {
                off[k].push((found.columns[k].1[0] - truth) / errors(&found, k));
            }
        }
        for (k, off) in off.iter().enumerate() {
            let rms = (off.iter().map(|z| z * z).sum::<f64>() / DRAWS as f64).sqrt();
            let within = off.iter().filter(|z| z.abs() < 1.96).count() as f64 / DRAWS as f64;
            // Of 300 draws: 1 ± 0.04 and 0.95 ± 0.013; three times that.
            assert!((rms - 1.0).abs() < 0.125, "{law:?} {k}: {rms}");
            assert!((within - 0.95).abs() < 0.04, "{law:?} {k}: {within}");
        }
    }
}

/// Each row of several has its own.
#[test]
fn a_row_with_fewer_points_is_known_less() {
    let mut random = Random::new(4);
    // Only at the temperatures of the rows: each row is the mean of its own points.
    let mut points = Vec::new();
    for (temperature, count) in [(0.0, 100), (50.0, 4)] {
        points.extend((0..count).map(|_| Point { temperature, ..at_20(1.0, 0.3 + 0.01 * random.normal()) }));
    }
    let found = fit(&points, LawKind::Constant, &[0.0, 50.0], None).unwrap();
    let errors = found.errors[0].as_ref().unwrap();
    let s = found.deviation.unwrap();
    close("100 points", errors[0], s / 10.0, 1e-12);
    close("4 points", errors[1], s / 2.0, 1e-12);
}
