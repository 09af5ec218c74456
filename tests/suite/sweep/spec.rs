//! What a valid sweep file means.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]
#![expect(clippy::float_cmp, reason = "values of a sweep file arrive as they are written")]

use std::path::Path;

use proptest::prelude::*;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::model::Param;
use squealmap::model::friction::{FrictionLaw, LawKind};
use squealmap::sweep::grid::{Grid, Value};
use squealmap::sweep::spec::{Spec, Starts};

fn sweeps() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps"))
}

fn parse(text: &str) -> Spec {
    Spec::parse(text, "test.toml", sweeps()).unwrap_or_else(|error| panic!("{error}"))
}

/// The values of the only axis.
fn axis(text: &str) -> Vec<f64> {
    let spec = parse(&format!("[friction]\nlaw = \"constant\"\n{text}"));
    let Grid::Axes(axes) = &spec.grid else { panic!("axes were given") };
    axes[0]
        .values
        .iter()
        .map(|value| match value {
            Value::Number(number) => *number,
            Value::Text(text) => panic!("{text} is not a number"),
        })
        .collect()
}

#[test]
fn paper_map_is_the_map_of_the_readme() {
    let spec = Spec::read(&sweeps().join("paper_map.toml")).unwrap();
    assert_eq!(spec.grid.len(), 8405);
    assert_eq!(spec.title, "Stability map of the two-mass belt model");
    assert!(spec.analysis.linear && spec.analysis.response);
    assert_eq!(spec.settle_limit, Some(Duration::Periods(3000.0)), "until settled");
    // The last axis varies fastest.
    let first: Vec<_> = (0..6).map(|i| spec.instance(i).params.require(Param::BeltVelocity)).collect();
    assert_eq!(first, [0.5, 1.0, 3.0, 4.9, 6.0, 0.5]);
    let last = spec.instance(8404);
    assert_eq!(last.law, FrictionLaw::Bilinear { mu_s: 0.6, mu_d: 0.6, knee_velocity: 5.0 });
    assert_eq!(last.params.require(Param::M1), 2.12);
    assert_eq!(spec.instance(5).law, FrictionLaw::Bilinear { mu_s: 0.0, mu_d: 0.015, knee_velocity: 5.0 });
}

#[test]
fn every_shipped_sweep_is_valid() {
    let mut count = 0;
    let entries = [sweeps().to_owned(), sweeps().join("paper")].map(|path| std::fs::read_dir(path).unwrap());
    for entry in entries.into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let spec = Spec::read(&path).unwrap_or_else(|error| panic!("{error}"));
            assert!(!spec.grid.is_empty() && !spec.title.is_empty(), "{}", path.display());
            let _ = spec.instance(spec.grid.len() - 1);
            count += 1;
        }
    }
    assert_eq!(count, 13 + 8, "and those of the paper");
}

#[test]
fn a_run_until_settled_has_shorter_windows_and_a_limit() {
    let base =
        "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n[response]\nsettle = \"auto\"\n";
    let spec = parse(base);
    assert_eq!((spec.settle, spec.measure), (Duration::Periods(24.0), Duration::Periods(48.0)));
    assert_eq!(spec.settle_limit, Some(Duration::Periods(1000.0)));
    let json = spec.resolved();
    assert_eq!(json["response"]["settle"], "auto");
    assert_eq!(json["response"]["settle_limit"], "1000 periods");
    let spec = parse(&format!("{base}settle_limit = \"60 s\"\nmeasure = \"2 s\"\n"));
    assert_eq!((spec.settle_limit, spec.measure), (Some(Duration::Seconds(60.0)), Duration::Seconds(2.0)));
}

#[test]
fn a_run_that_finds_cycles_looks_early_and_is_described_as_such() {
    let base = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n[response]\n";
    let spec = parse(&format!("{base}settle = \"cycle\"\nsettle_limit = \"60 s\"\n"));
    assert!(spec.analysis.finds_cycles && spec.analysis.until_settled && Plan::new(&spec).hunts);
    assert_eq!((spec.settle, spec.settle_limit), (Duration::Periods(8.0), Some(Duration::Seconds(60.0))));
    let json = spec.resolved();
    assert_eq!(json["response"]["settle"], "cycle");
    let auto = parse(&format!("{base}settle = \"auto\"\n"));
    assert!(!auto.analysis.finds_cycles && !Plan::new(&auto).hunts);
}

#[test]
fn an_empty_friction_section_takes_the_defaults() {
    let spec = parse("[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n");
    assert_eq!(spec.grid.len(), 1);
    assert_eq!(spec.law, LawKind::Bilinear);
    assert_eq!(spec.start, StartKind::Kick);
    assert_eq!((spec.settle, spec.measure), (Duration::Periods(200.0), Duration::Periods(100.0)));
    assert_eq!(spec.steps_per_period, 12);
    assert!(spec.impact_friction && spec.analysis.linear && spec.analysis.response);
    let params = spec.instance(0).params;
    assert_eq!(params.require(Param::StartVelocity), 0.01);
    assert_eq!(params.require(Param::K2), 101_000.0);
    assert_eq!(params.get(Param::RampDuration), None);
}

#[test]
fn axis_ends_are_exact_and_steps_are_index_times_step() {
    let values =
        axis("[axes]\nbelt_velocity = { from = 0.1, to = 0.7, points = 7 }\nmu_d = { values = [0] }");
    assert_eq!((values[0], values[6]), (0.1, 0.7));
    for (index, value) in values.iter().enumerate() {
        assert!((value - (0.1 + 0.1 * index as f64)).abs() < 1e-15);
    }
    let falling = axis("[axes]\nbelt_velocity = { from = 7, to = 0, points = 8 }\nmu_d = { values = [0] }");
    assert_eq!(falling, [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.0]);
    let single = axis("[axes]\nbelt_velocity = { from = 3, to = 3, points = 1 }\nmu_d = { values = [0] }");
    assert_eq!(single, [3.0]);
}

#[test]
fn a_zero_on_an_axis_is_zero() {
    let theta =
        |of: &str| axis(&format!("mu_d = 0.2\n[axes]\ntheta = {{ {of} }}\n[belt]\nbelt_velocity = 1\n"));
    // The 21st of 61 values from −0.05 to 0.1 is zero; by rounding it was 6.9e-18.
    for of in ["from = -0.05, to = 0.1, points = 61", "from = 0.1, to = -0.05, points = 61"] {
        let values = theta(of);
        let zeros = values.iter().filter(|value| **value == 0.0 && value.is_sign_positive());
        assert_eq!(zeros.count(), 1, "{of}");
        assert!(values.iter().all(|value| *value == 0.0 || value.abs() > 0.0024), "{of}");
    }
    // A small value that is meant is a step away from zero, and stays.
    assert_eq!(theta("from = 0.0, to = 1e-12, points = 3")[1], 5e-13);
}

#[test]
fn log_axis_has_equal_ratios_and_exact_ends() {
    let values = axis(
        "[axes]\nk2 = { from = 1e3, to = 1e9, points = 7, scale = \"log\" }\nmu_d = { values = [0.1] }\n\
         [belt]\nbelt_velocity = 3",
    );
    assert_eq!((values[0], values[6]), (1e3, 1e9));
    for pair in values.windows(2) {
        assert!((pair[1] / pair[0] - 10.0).abs() < 1e-12);
    }
}

#[test]
fn law_may_be_an_axis() {
    let spec = parse(
        "[friction]\nmu_s = 0.4\nmu_d = 0.3\nstribeck_velocity = 0.5\n[belt]\nbelt_velocity = 3\n\
         [axes]\nlaw = { values = [\"bilinear\", \"exponential\", \"constant\"] }",
    );
    assert_eq!(spec.instance(0).law, FrictionLaw::Bilinear { mu_s: 0.4, mu_d: 0.3, knee_velocity: 5.0 });
    assert_eq!(
        spec.instance(1).law,
        FrictionLaw::Exponential { mu_s: 0.4, mu_d: 0.3, stribeck_velocity: 0.5 }
    );
    assert_eq!(spec.instance(2).law, FrictionLaw::Constant { mu_s: 0.4, mu_d: 0.3 });
}

#[test]
fn constant_law_sticks_as_it_slips_unless_told() {
    let spec = parse("[friction]\nlaw = \"constant\"\nmu_d = 0.3\n[belt]\nbelt_velocity = 3");
    assert_eq!(spec.instance(0).law, FrictionLaw::Constant { mu_s: 0.3, mu_d: 0.3 });
    // mu_s < mu_d is a status of the instance, not an input error.
    let spec = parse("[friction]\nlaw = \"constant\"\nmu_s = 0.2\nmu_d = 0.3\n[belt]\nbelt_velocity = 3");
    assert_eq!(spec.instance(0).law, FrictionLaw::Constant { mu_s: 0.2, mu_d: 0.3 });
}

#[test]
fn materials_are_linear_between_rows_and_exact_at_rows() {
    let at = |temperature: f64| {
        let spec = parse(&format!(
            "[friction]\nmaterial = \"pad.csv\"\ntemperature = {temperature}\noutside = \"clamp\"\n\
             [belt]\nbelt_velocity = 3"
        ));
        match spec.instance(0).law {
            FrictionLaw::Bilinear { mu_s, mu_d, .. } => (mu_s, mu_d),
            other => panic!("{other:?} is not bilinear"),
        }
    };
    assert_eq!(at(100.0), (0.10, 0.10));
    assert_eq!(at(300.0), (0.16, 0.12));
    assert_eq!(at(500.0), (0.32, 0.24));
    let (mu_s, mu_d) = at(400.0);
    assert!((mu_s - 0.24).abs() < 1e-15 && (mu_d - 0.18).abs() < 1e-15);
    assert_eq!(at(-40.0), (0.10, 0.10));
    assert_eq!(at(900.0), (0.32, 0.24));
}

#[test]
fn a_ramp_sets_the_durations() {
    let ramp = "[friction]\nmu_s = 0.4\nmu_d = 0.4\n\
                [belt]\nbelt_velocity = 7\nbelt_velocity_end = 0\nramp_duration = 10\n";
    let spec = parse(ramp);
    assert_eq!((spec.settle, spec.measure), (Duration::Seconds(0.0), Duration::Ramp));
    let spec = parse(&format!("{ramp}[response]\nmeasure = \"1 period\""));
    assert_eq!((spec.settle, spec.measure), (Duration::Seconds(0.0), Duration::Periods(1.0)));
}

#[test]
fn byte_order_mark_and_dos_line_ends_are_understood() {
    let text = std::fs::read_to_string(sweeps().join("paper_map.toml")).unwrap();
    let spec = parse(&format!("\u{feff}{}", text.replace('\n', "\r\n")));
    assert_eq!(spec.grid.len(), 8405);
}

#[test]
fn tuples_keep_their_order() {
    let spec = Spec::read(&sweeps().join("tuples.toml")).unwrap();
    assert_eq!(spec.grid.len(), 8);
    assert_eq!(spec.instance(4).law, FrictionLaw::Bilinear { mu_s: 0.4, mu_d: 0.3, knee_velocity: 5.0 });
    assert_eq!(spec.instance(7).params.require(Param::BeltVelocity), 2.0);
}

#[test]
fn resolved_writes_the_defaults_out() {
    let spec = Spec::read(&sweeps().join("temperature_map.toml")).unwrap();
    let json = spec.resolved();
    assert_eq!(json["model"]["m1"], 2.12);
    assert_eq!(json["model"]["impact_friction"], true);
    assert_eq!(json["friction"]["law"], "bilinear");
    assert_eq!(json["friction"]["material"]["mu_s"][2], 0.32);
    assert_eq!(json["friction"]["temperature"], serde_json::Value::Null);
    assert_eq!(json["axes"]["temperature"]["values"][40], 500.0);
    assert_eq!(json["start"]["kind"], "kick");
    assert_eq!(json["response"]["settle"], "6 s");
    assert_eq!(json["response"]["steps_per_period"], 12);
}

#[test]
fn starts_are_resolved_with_what_they_read() {
    let start = |start: &str| {
        let law = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";
        let spec = parse(&format!("{law}[start]\n{start}"));
        (spec.analysis.starts, spec.resolved()["start"].clone())
    };
    let kick = serde_json::json!({ "kind": "kick", "start_velocity": 0.01, "start_displacement": 0.0 });
    assert_eq!(start(""), (Starts::One, kick));
    let both = serde_json::json!({
        "kind": "both", "start_velocity": 0.01, "start_displacement": 0.0, "large_displacement": 0.0,
    });
    assert_eq!(start("kind = \"both\"\n"), (Starts::Both, both));
    let boxed = serde_json::json!({
        "kind": "box", "start_velocity": 0.01, "start_displacement": 0.0, "box_samples": 7,
        "box_displacement_from": -1.0, "box_displacement_to": 1.0, "box_velocity_from": 0.0, "box_velocity_to": 2.0,
    });
    let keys = "kind = \"box\"\nbox_samples = 7\nbox_displacement_from = -1\nbox_displacement_to = 1\n\
        box_velocity_from = 0\nbox_velocity_to = 2\n";
    assert_eq!(start(keys), (Starts::Box(7), boxed));
}

#[test]
fn instance_at_names_what_the_sweep_varies_and_more() {
    let spec = Spec::read(&sweeps().join("paper_map.toml")).unwrap();
    let instance = spec.instance_at("mu_s=0.41, mu_d=0.3,belt_velocity=3,theta=0.02").unwrap();
    assert_eq!(instance.law, FrictionLaw::Bilinear { mu_s: 0.41, mu_d: 0.3, knee_velocity: 5.0 });
    assert_eq!(instance.params.require(Param::Theta), 0.02);
    let instance = spec.instance_at("mu_s=0.4,mu_d=0.3,belt_velocity=3,law=constant").unwrap();
    assert_eq!(instance.law, FrictionLaw::Constant { mu_s: 0.4, mu_d: 0.3 });
    let hot = Spec::read(&sweeps().join("temperature_map.toml")).unwrap();
    let instance = hot.instance_at("temperature=300,belt_velocity=1").unwrap();
    assert_eq!(instance.law, FrictionLaw::Bilinear { mu_s: 0.16, mu_d: 0.12, knee_velocity: 5.0 });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// A file with a piece cut out, doubled or replaced is valid or an error of one line, never a panic.
    #[test]
    fn mutated_files_never_panic(
        file in 0_usize..5,
        start in any::<prop::sample::Index>(),
        length in 0_usize..30,
        insert in "[-a-z0-9_\\[\\]{}=\",. \n#é]{0,12}",
    ) {
        let names = ["paper_map", "paper/figure2", "mass_on_belt", "temperature_map", "tuples"];
        let text = std::fs::read_to_string(sweeps().join(names[file]).with_extension("toml")).unwrap();
        let mut chars: Vec<char> = text.chars().collect();
        let start = start.index(chars.len());
        let end = (start + length).min(chars.len());
        chars.splice(start..end, insert.chars());
        let text: String = chars.into_iter().collect();
        match Spec::parse(&text, "mutated.toml", sweeps()) {
            Ok(spec) => {
                let _ = spec.resolved();
                let _ = spec.instance(spec.grid.len() - 1);
            }
            Err(error) => {
                let message = error.to_string();
                prop_assert!(!message.contains('\n'), "{message}");
                prop_assert!(error.place().is_some(), "{message}");
            }
        }
    }

    /// No argument of `--at` panics.
    #[test]
    fn at_never_panics(text in "[-a-z0-9_=,. é]{0,40}") {
        let spec = Spec::read(&sweeps().join("paper_map.toml")).unwrap();
        let _ = spec.instance_at(&text);
        let _ = spec.instance_at(&format!("mu_s=0.4,mu_d=0.3,belt_velocity=3,{text}"));
    }
}
