//! Materials fitted to records of strokes that squeal: what the vibration blurs is left out.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::io::{Cursor, Read};
use std::sync::Arc;

use crate::cli::program::{squealmap, unwrapped};
use crate::common::{bilinear, near, plan};
use crate::study::laboratory::{RATE, sensed};
use crate::study::segments::{LENGTH, rig};
use crate::study::strokes::{Random, csv};
use squealmap::model::friction::LawKind;
use squealmap::model::instance::Instance;
use squealmap::model::motion::{Motion, MotionTable};
use squealmap::model::{Param, Params};
use squealmap::study::fit::fit;
use squealmap::study::signals::sensors::{Recording, Sample, record};
use squealmap_identify::{Channel, FrictionColumn, Measurements, Settings, read_measurements, read_points};

fn read(bytes: &[u8]) -> Measurements {
    let open = || Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Read>);
    read_measurements(open, "stroke.csv", &Settings::default(), &FrictionColumn::Forces, Some(20.0)).unwrap()
}

/// The ramp of Figure 4: it squeals from about 4 m/s on, the knee of the law is at 5 m/s.
#[test]
fn a_squealing_ramp_gives_the_law_within_its_errors() {
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
        law: bilinear(0.15, 0.05),
        impact_friction: true,
        motion: Motion::Ramp,
        heating: None,
        modal: None,
    };
    let recording = Recording { rate: 1000.0, duration: 10.0, skew: 0.0, force_skew: 0.0 };
    let mut samples = record(&ramp, &plan(1.0, 1.0, 12), &recording).samples;
    sensed(&mut samples, false, 60.0, false, &mut Random::new(3));
    let bytes = csv(&samples);
    let measured = read(&bytes);
    assert!((0.4..0.8).contains(&measured.left_out), "{}", measured.left_out);
    let fitted = fit(&measured.points, LawKind::Bilinear, &[20.0], None).unwrap();
    let law = [(Param::MuS, 0.15), (Param::MuD, 0.05), (Param::KneeVelocity, 5.0)];
    for (k, (param, expected)) in law.into_iter().enumerate() {
        let (name, values) = &fitted.columns[k];
        assert_eq!(*name, param);
        let error = fitted.errors[k].as_ref().unwrap()[0];
        near(param.info().name, values[0], expected, 3.0 * error);
        assert!(error < 0.1 * expected, "{} ± {error}", param.info().name);
    }
    // Taken as it stands, the record gives another law, or none.
    let table = Box::new(Cursor::new(bytes)) as Box<dyn Read>;
    let rows =
        read_points(table, "stroke.csv", &Settings::default(), &FrictionColumn::Forces, Some(20.0)).unwrap();
    let naive = fit(&rows.points, LawKind::Bilinear, &[20.0], None);
    let knee = naive.map_or(f64::INFINITY, |naive| naive.columns[2].1[0]);
    assert!((knee - 5.0).abs() > 1.0, "{knee}");
}

/// Slow forces and a squeal from the knee on: what is left lies on the law.
#[test]
fn what_squeals_under_slow_forces_is_left_out() {
    let stroke = rig(0.16, 0.06, 0.025, [0.045, 0.005]);
    let recording = Recording { rate: *RATE, duration: LENGTH, skew: 0.0, force_skew: 0.0 };
    let mut samples = record(&stroke, &plan(1.0, 1.0, 12), &recording).samples;
    sensed(&mut samples, true, 40.0, false, &mut Random::new(5));
    let measured = read(&csv(&samples));
    assert!((0.3..0.6).contains(&measured.left_out), "{}", measured.left_out);
    for point in &measured.points {
        near("friction", point.friction, stroke.law.mu(point.velocity), 0.01 * point.friction);
    }
}

/// A record of a stroke there and one back gives the points of both.
#[test]
fn strokes_there_and_back_are_read_together() {
    let stroke = rig(0.16, 0.06, 0.025, [0.045, 0.005]);
    let recording = Recording { rate: *RATE, duration: LENGTH, skew: 0.0, force_skew: 0.0 };
    let there = record(&stroke, &plan(1.0, 1.0, 12), &recording).samples;
    let sensed_by = |backwards: bool, seed: u64| {
        let mut samples = there.clone();
        sensed(&mut samples, true, 40.0, backwards, &mut Random::new(seed));
        samples
    };
    let [alone, mut both, mut back] = [sensed_by(false, 5), sensed_by(false, 5), sensed_by(true, 7)];
    // A rest of 50 ms between them, held by a tenth of the load.
    let rest = (1..2500_u32).map(|k| Sample {
        t: LENGTH + f64::from(k) / *RATE,
        belt_velocity: 0.0,
        tangential_force: 0.1 * alone[0].normal_force,
        ..alone[0]
    });
    both.extend(rest);
    let start = both[both.len() - 1].t + 1.0 / *RATE;
    for sample in &mut back {
        sample.t += start;
    }
    both.extend(back);
    let [one, two] = [alone, both].map(|samples| read(&csv(&samples)));
    // The first 20 ms of each stroke are left out: slow forces may remember what was before it.
    let there_alone = one.points.len();
    assert!((there_alone * 17 / 10..2 * there_alone).contains(&two.points.len()), "{}", two.points.len());
    near("left out", two.left_out, one.left_out + 0.02 / LENGTH, 0.02);
    assert!(two.at_rest < 0.01, "{}", two.at_rest);
    for point in &two.points {
        near("friction", point.friction, stroke.law.mu(point.velocity), 0.01 * point.friction);
    }
}

/// In a table a force that opposes a body on its way back has the other sign.
#[test]
fn rows_of_a_way_back_are_turned() {
    for sign in [-1.0, 1.0] {
        let mut table = "V,T,N\n".to_owned();
        for k in -40..40 {
            let v = 0.2 * (f64::from(k) + 0.5);
            let mu = 0.4 - 0.1 * (v.abs() / 5.0).min(1.0);
            writeln!(table, "{v},{},10", 10.0 * mu * if v < 0.0 { sign } else { 1.0 }).unwrap();
        }
        let fitted = fit(&read(table.as_bytes()).points, LawKind::Bilinear, &[20.0], None).unwrap();
        near("mu_s", fitted.columns[0].1[0], 0.4, 1e-6);
        near("knee", fitted.columns[2].1[0], 5.0, 1e-4);
    }
}

/// A rest before and after the stroke, in which friction is whatever holds the body, is no point of the law.
#[test]
fn a_rest_is_left_out() {
    let mut stroke = rig(0.06, 0.06, 0.025, [0.045, 0.005]);
    let corners = Arc::new([[0.0, 0.0], [0.1, 0.0], [0.11, 0.045], [0.4, 0.005], [0.41, 0.0], [0.5, 0.0]]);
    stroke.motion =
        Motion::Table(Arc::new(MotionTable { name: "stroke".to_owned(), corners, temperature: None }));
    let recording = Recording { rate: *RATE, duration: 0.5, skew: 0.0, force_skew: 0.0 };
    let mut samples = record(&stroke, &plan(1.0, 1.0, 12), &recording).samples;
    // Not the load that falls on at first.
    samples.retain(|sample| sample.t > 0.03);
    sensed(&mut samples, true, 40.0, false, &mut Random::new(5));
    let measured = read(&csv(&samples));
    assert!(measured.points.len() > 20, "{}", measured.points.len());
    for point in &measured.points {
        assert!((0.0004..0.046).contains(&point.velocity), "{point:?}");
        near("friction", point.friction, 0.06, 0.03 * point.friction);
    }
}

#[test]
fn rows_without_contact_are_passed_over() {
    let mut table = "V,T,N,temperature\n".to_owned();
    for k in 0..40 {
        let v = 0.2 * f64::from(k);
        let normal = if k % 4 == 0 { 0.0 } else { 10.0 };
        let mu = 0.4 - 0.1 * (v / 5.0).min(1.0);
        writeln!(table, "{v},{},{normal},20", mu * normal).unwrap();
    }
    let measured = read(table.as_bytes());
    assert_eq!((measured.without_contact, measured.points.len()), (10, 30));
    let fitted = fit(&measured.points, LawKind::Bilinear, &[20.0], None).unwrap();
    near("knee", fitted.columns[2].1[0], 5.0, 1e-4);
}

/// Forces at rest are no friction of sliding: in rows over time, and in a table where it says 0.
#[test]
fn rows_at_rest_are_left_out() {
    let mut rows = "t,V,T,N\n".to_owned();
    let mut table = "V,T,N\n".to_owned();
    let law = |v: f64| 0.4 - 0.2 * (v / 0.02).min(1.0);
    for k in 0..200 {
        let v = if k < 50 { 1e-5 * f64::from(k % 3) } else { 0.0002 * f64::from(k - 49) };
        let mu = if k < 50 { 0.1 } else { law(v) };
        writeln!(rows, "{},{v},{},10", 0.01 * f64::from(k), 10.0 * mu).unwrap();
        writeln!(table, "{},{},10", if k < 50 { 0.0 } else { v }, 10.0 * mu).unwrap();
    }
    for text in [rows, table] {
        let measured = read(text.as_bytes());
        near("share at rest", measured.at_rest, 0.25, 0.01);
        let fitted = fit(&measured.points, LawKind::Bilinear, &[20.0], None).unwrap();
        near("mu_s", fitted.columns[0].1[0], 0.4, 1e-3);
        near("knee", fitted.columns[2].1[0], 0.02, 1e-4);
    }
    // A table of speeds over decades keeps its slow ones.
    let mut table = "V,T,N\n".to_owned();
    for k in 0..40 {
        let v = 10_f64.powf(-4.0 + 0.1 * f64::from(k));
        writeln!(table, "{v},{},10", 10.0 * law(v)).unwrap();
    }
    let measured = read(table.as_bytes());
    assert_eq!((measured.points.len(), measured.at_rest), (40, 0.0));
}

/// What a header says of units is heeded, and said.
#[test]
fn units_in_headers_are_heeded() {
    let mut table = "t,V (mm/s),T (kN),N\n".to_owned();
    for k in 1..100 {
        let v = 0.0005 * f64::from(k);
        let mu = 0.4 - 0.2 * (v / 0.02).min(1.0);
        writeln!(table, "{},{},{},1000", 0.1 * f64::from(k), 1e3 * v, mu).unwrap();
    }
    let mut settings = Settings::default();
    for (channel, name) in [(Channel::Velocity, "V (mm/s)"), (Channel::TangentialForce, "T (kN)")] {
        settings.columns[channel as usize] = Some(name.to_owned());
    }
    let open = || Ok(Box::new(Cursor::new(table.clone().into_bytes())) as Box<dyn Read>);
    let measured =
        read_measurements(open, "table.csv", &settings, &FrictionColumn::Forces, Some(20.0)).unwrap();
    let fitted = fit(&measured.points, LawKind::Bilinear, &[20.0], None).unwrap();
    near("knee", fitted.columns[2].1[0], 0.02, 1e-6);
    near("mu_s", fitted.columns[0].1[0], 0.4, 1e-6);
    let said = squealmap::study::fit::told::remarks(&measured).join("; ");
    assert!(said.contains("`V (mm/s)` is read in mm/s") && said.contains("`T (kN)` is read in kN"), "{said}");
}

/// One file for each temperature, as laboratories have them.
#[test]
fn files_of_one_temperature_each_make_one_material() {
    let directory = tempfile::tempdir().unwrap();
    let records = directory.path().join("records");
    std::fs::create_dir(&records).unwrap();
    for (name, mu_s) in [("a", 0.5), ("b", 0.4), ("c", 0.3)] {
        let mut table = "V,T,N\n".to_owned();
        for k in 1..30 {
            let v = 0.25 * f64::from(k);
            let normal = if k == 3 { 0.0 } else { 10.0 };
            writeln!(table, "{v},{},{normal}", 10.0 * (mu_s - 0.1 * (v / 5.0).min(1.0))).unwrap();
        }
        std::fs::write(records.join(format!("{name}.csv")), table).unwrap();
    }
    let fitted = |temperatures: &str| {
        squealmap(directory.path(), &["fit", "records", "--at-temperature", temperatures, "-o", "out"])
    };
    let ended = fitted("100,300,500");
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let said = unwrapped(&ended.err);
    assert!(said.contains("b.csv: 1 row(s) without contact are passed over"), "{said}");
    let text = std::fs::read_to_string(directory.path().join("out/material.csv")).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|value| value.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), [100.0, 300.0, 500.0]);
    for (row, mu_s) in rows.iter().zip([0.5, 0.4, 0.3]) {
        near("mu_s", row[1], mu_s, 1e-6);
        near("knee", row[3], 5.0, 1e-4);
    }
    let ended = fitted("100,300");
    assert_eq!(ended.code, Some(2));
    let said = unwrapped(&ended.err);
    assert!(said.contains("2 temperatures are given for 3 file(s); give --at-temperature"), "{said}");
}

/// A speed without a sign and a force with one: friction would drive the sliding on the way back.
#[test]
fn friction_of_both_signs_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let mut table = "V,T,N\n".to_owned();
    for k in 1..60 {
        let v = 0.1 * f64::from(k);
        let sign = if k % 3 == 0 { -1.0 } else { 1.0 };
        writeln!(table, "{v},{},10", sign * 10.0 * (0.4 - 0.1 * (v / 5.0).min(1.0))).unwrap();
    }
    std::fs::write(directory.path().join("p.csv"), table).unwrap();
    let ended = squealmap(directory.path(), &["fit", "p.csv", "--at-temperature", "20"]);
    assert_eq!(ended.code, Some(2), "{}", ended.out);
    let said = unwrapped(&ended.err);
    assert!(
        said.contains("below 0 at 19 of 59 points") && said.contains("the velocity needs a sign"),
        "{said}"
    );
}
