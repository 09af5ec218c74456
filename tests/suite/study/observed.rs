//! Measured strokes over a map: where they are drawn, and what is wrong with a table of them.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::common::instance;
use crate::study::laboratory::{coalescence, right};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::{Param, linear};
use squealmap::results::figure::palette::TYPES;
use squealmap::study::calibrate::sweep::{Plane, sweep_toml};
use squealmap::study::calibrate::{Calibrated, Measured, calibrate};
use squealmap::study::campaign::row::strokes_csv;
use squealmap::study::observed::Strokes;
use squealmap::sweep::grid::{AxisKey, Value};
use squealmap::sweep::spec::Spec;
use squealmap_identify::Kind;
use tempfile::TempDir;

const SWEEP: &str = "[axes]\nmu_s = { from = 0.0, to = 0.6, points = 13 }\nmu_d = { from = 0.0, to = 0.6, points = 13 }\n\
                     belt_velocity = { values = [0.01, 0.02, 0.05] }\n";

fn spec(text: &str) -> Spec {
    Spec::parse(text, "sweep.toml", Path::new(".")).unwrap()
}

fn table(text: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("strokes.csv");
    std::fs::write(&path, text).unwrap();
    (directory, path)
}

#[test]
fn a_stroke_is_drawn_where_it_was_measured() {
    let (_directory, path) = table(
        "# a campaign\nmu_s, mu_d, belt_velocity, mu_s_error, mu_d_error, observed\n0.40,0.30,0.021,0.02,0.01,both\n\
         0.35,0.35,0.05,0.01,0.01,mode_coupling\n0.90,0.30,0.05,0.01,0.01,both\n",
    );
    let found = Strokes::over(&path, &spec(SWEEP).grid).unwrap();
    assert_eq!(found.outside, 1);
    let [side, up] = [Param::MuS, Param::MuD].map(AxisKey::Param);
    let of = |class: &str| {
        let class = format!("class=\"{class}\"");
        found.lines.iter().filter(move |line| line.stroke.attributes.contains(&class)).collect::<Vec<_>>()
    };
    let marks = of("observed");
    assert_eq!(marks.len(), 2);
    assert_eq!(marks[0].axes, [side, up]);
    assert_eq!(marks[0].points, [[0.40, 0.30]; 2]);
    let velocity = AxisKey::Param(Param::BeltVelocity);
    assert_eq!(marks[0].others, [(velocity, Value::Number(0.02))]);
    assert_eq!(marks[1].others, [(velocity, Value::Number(0.05))]);
    let bars = of("error");
    assert_eq!(bars.len(), 4);
    let ends: Vec<[[f64; 2]; 2]> = bars.iter().map(|bar| [bar.points[0], bar.points[1]]).collect();
    assert_eq!(ends[0], [[0.40 - 0.02, 0.30], [0.40 + 0.02, 0.30]]);
    assert_eq!(ends[1], [[0.40, 0.30 - 0.01], [0.40, 0.30 + 0.01]]);
}

/// A verdict has the colour that maps give the same type.
#[test]
fn marks_have_the_colours_of_the_types() {
    for (observed, class) in [
        ("no_instability", "stable"),
        ("negative_slope", "negative_slope"),
        ("mode_coupling", "mode_coupling"),
        ("both", "coexistence"),
    ] {
        let (_directory, path) =
            table(&format!("mu_s,mu_d,belt_velocity,observed\n0.4,0.3,0.02,{observed}\n"));
        let found = Strokes::over(&path, &spec(SWEEP).grid).unwrap();
        let fill = TYPES.iter().find(|one| one.name == class).unwrap().fill;
        let mark = found.lines.last().unwrap();
        assert!(mark.stroke.attributes.contains(&format!("stroke=\"{fill}\"")), "{observed}");
    }
}

#[test]
fn what_is_wrong_with_a_table_is_told() {
    let why = |text: &str, sweep: &str| {
        let (_directory, path) = table(text);
        Strokes::over(&path, &spec(sweep).grid).unwrap_err().to_string()
    };
    for (text, words) in [
        ("mu_s,observed\n0.4,both\n", "no column `mu_d`, only `mu_s`, `observed`"),
        ("mu_s,mu_d,observed\n0.4,0.3,both\n", "no column `belt_velocity`"),
        ("mu_s,mu_d,belt_velocity\n0.4,0.3,0.02\n", "no column `observed`"),
        ("mu_s,mu_d,belt_velocity,observed\n0.4,x,0.02,both\n", "`x` as `mu_d` in row 1"),
        ("mu_s,mu_d,belt_velocity,observed\n0.4,0.3,fast,both\n", "`fast` as `belt_velocity` in row 1"),
        ("mu_s,mu_d,belt_velocity,observed\n0.4,0.3,0.02,squeal\n", "it must be one of no_instability"),
    ] {
        let told = why(text, SWEEP);
        assert!(told.contains(words), "{told}");
    }
    let one = why(
        "mu_s,observed\n0.4,both\n",
        "friction.mu_d = 0.3\nbelt.belt_velocity = 0.02\naxes.mu_s = { values = [0.1, 0.2] }\n",
    );
    assert!(one.contains("plane"), "{one}");
}

/// A campaign of a known structure: the model calibrated to it predicts of every stroke what was observed.
#[test]
fn a_calibrated_map_predicts_a_campaign() {
    let known = [0.00497, 0.00042, 4.26e7, 4.34e7, 14.0, 13.0, 0.005];
    let names = [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2, Param::Theta];
    let structure = |mu_s: f64, mu_d: f64, velocity: f64| {
        let mut values: Vec<(Param, f64)> = names.into_iter().zip(known).collect();
        values.extend([(Param::FExt, 17.0), (Param::BeltVelocity, velocity)]);
        instance(FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 0.05 }, &values)
    };
    let flat = structure(0.0, 0.0, 0.05);
    // What an impact test and the onset of squeal tell of it.
    let modes = linear::eigenvalues(&flat).unwrap();
    let mut above: Vec<_> = modes.into_iter().filter(|z| z.im > 0.0).collect();
    above.sort_by(|a, b| a.im.total_cmp(&b.im));
    let asked = Measured {
        frequencies: [0, 1].map(|k| above[k].im / std::f64::consts::TAU),
        damping_ratios: [0, 1].map(|k| -above[k].re / above[k].norm()),
        critical_friction: coalescence(&flat),
        mass: known[0] + known[1],
        mass_ratio: known[1] / known[0],
        load: 17.0,
        normal_above: true,
    };
    let found: Calibrated = calibrate(&asked).unwrap();
    let plane = Plane::Friction { knee: 0.05, velocities: vec![0.01, 0.02, 0.04] };
    let text = sweep_toml(&found, &asked, &plane);
    let map = spec(&text);
    let (mut rows, mut seen) = ("mu_s,mu_d,belt_velocity,observed\n".to_owned(), Vec::new());
    let cells: Vec<usize> = (0..map.grid.len()).step_by(97).collect();
    for cell in &cells {
        let at: Vec<f64> = map
            .grid
            .coordinates(*cell)
            .into_iter()
            .filter_map(|value| if let Value::Number(number) = value { Some(*number) } else { None })
            .collect();
        let kinds = right(&structure(at[0], at[1], at[2]), 0.0);
        assert_eq!(right(&map.instance(*cell), 0.0), kinds, "{at:?}");
        let [kind] = kinds[..] else { continue };
        let name = match kind {
            Kind::NoInstability => "no_instability",
            Kind::NegativeSlope => "negative_slope",
            Kind::ModeCoupling => "mode_coupling",
            Kind::Both => "both",
            Kind::Undecided => continue,
        };
        seen.push(name);
        writeln!(rows, "{},{},{},{name}", at[0], at[1], at[2]).unwrap();
    }
    for name in ["no_instability", "negative_slope", "mode_coupling", "both"] {
        assert!(seen.iter().filter(|other| **other == name).count() >= 3, "{name}: {seen:?}");
    }
    let (_directory, path) = table(&rows);
    let drawn = Strokes::over(&path, &map.grid).unwrap();
    assert_eq!((drawn.outside, drawn.lines.len()), (0, 2 * seen.len()));
    // A model of another structure predicts something else.
    let other = calibrate(&Measured { critical_friction: 1.5 * asked.critical_friction, ..asked }).unwrap();
    let other = spec(&sweep_toml(&other, &asked, &plane));
    let wrong =
        cells.iter().filter(|cell| right(&other.instance(**cell), 0.0) != right(&map.instance(**cell), 0.0));
    assert!(wrong.count() > 5);
}

#[test]
fn the_table_of_a_campaign_is_one_of_strokes() {
    let header = String::from_utf8(strokes_csv(&[]).unwrap()).unwrap();
    let row = |temperature: &str, shares: &str, status: &str| {
        format!(
            "r.csv,1,0,0.3,forward,{temperature},0.03,0.05,0.01,falling,0.3,1,14500,100,{shares},{status}\n"
        )
    };
    let rows = [
        row("480", "0,0,0,0.2,0.5,0.3,0", "ok"),
        row("310", "0.6,0,0,0,0,0,0.4", "ok"),
        row("", ",,,,,,", "broken"),
    ];
    let (_directory, path) = table(&format!("{}{}", header, rows.concat()));
    let text = "[friction]\nknee_velocity = 0.02\nmaterial = \"sweeps/pad.csv\"\n[axes]\n\
                temperature = { from = 100.0, to = 500.0, points = 5 }\n\
                belt_velocity = { from = 0.004, to = 0.05, points = 5 }\n";
    let found = Strokes::over(&path, &spec(text).grid).unwrap();
    let marks: Vec<_> =
        found.lines.iter().filter(|line| line.stroke.attributes.contains("class=\"observed\"")).collect();
    let said: Vec<_> = marks.iter().map(|line| (line.stroke.words, line.points[0])).collect();
    assert_eq!(found.outside, 1, "what has no verdict is counted");
    assert_eq!(
        said,
        [("measured: mode coupling at least", [480.0, 0.03]), ("measured: no instability", [310.0, 0.03]),]
    );
}

/// Far from every panel is outside: half a step beyond their ends, a quarter of a single value.
#[test]
fn what_is_far_from_every_panel_is_outside() {
    for (velocities, near) in [("0.01, 0.02, 0.05", ["0.006", "0.06"]), ("0.02", ["0.016", "0.024"])] {
        let grid = spec(&SWEEP.replace("0.01, 0.02, 0.05", velocities)).grid;
        for (at, outside) in [(near[0], 0), (near[1], 0), ("0.004", 1), ("0.07", 1), ("3", 1)] {
            let (_directory, path) = table(&format!("mu_s,mu_d,belt_velocity,observed\n0.4,0.3,{at},both\n"));
            assert_eq!(Strokes::over(&path, &grid).unwrap().outside, outside, "{velocities}: {at}");
        }
    }
}

#[test]
fn an_error_that_is_not_known_may_be_empty() {
    let (_directory, path) =
        table("mu_s,mu_d,belt_velocity,mu_s_error,observed\n0.4,0.3,0.02,,both\n0.4,0.3,0.02,0.01,both\n");
    let found = Strokes::over(&path, &spec(SWEEP).grid).unwrap();
    let bars = found.lines.iter().filter(|line| line.stroke.attributes.contains("class=\"error\"")).count();
    assert_eq!(bars, 1);
}
