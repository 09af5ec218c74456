//! A sweep built in code is the sweep of its file, and is refused in the same words.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::sync::Arc;

use squealmap::FrictionLaw::{Bilinear, Exponential, Rational};
use squealmap::model::PARAMS;
use squealmap::model::friction::MuTable;
use squealmap::model::material::Outside;
use squealmap::sweep::grid::Grid;
use squealmap::sweep::spec::refine::Settings;
use squealmap::{Duration, FrictionLaw, LawKind, Param, Settle, Spec, Start, Sweep};

fn sweeps() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps"))
}

/// Every field of both is the same.
#[track_caller]
fn same(built: &Sweep, read: &Spec) {
    let built = built.spec().unwrap_or_else(|why| panic!("{why}"));
    assert_eq!(format!("{built:#?}"), format!("{read:#?}"));
    assert_eq!(built.resolved(), read.resolved());
}

#[track_caller]
fn same_text(built: &Sweep, text: &str) {
    same(built, &Spec::parse(text, "test.toml", sweeps()).unwrap_or_else(|why| panic!("{why}")));
}

fn shipped(name: &str) -> Spec {
    Spec::read(&sweeps().join(name)).unwrap()
}

/// The single mass of the shipped sweeps.
fn mass_on_belt() -> Sweep {
    Sweep::two_mass()
        .set(Param::M1, 0.9)
        .set(Param::M2, 0.1)
        .set(Param::K1, 1.0)
        .set(Param::K2, 1.0)
        .set(Param::C2, 0.1)
        .set(Param::FExt, 1.0)
        .set(Param::Theta, 0.0)
        .friction(Exponential { mu_s: 1.0, mu_d: 0.5, stribeck_velocity: 0.5 })
}

#[test]
fn shipped_sweeps_are_built_in_code() {
    let band = mass_on_belt()
        .title("Bistable band of a mass on a belt, exponential friction law")
        .axis(Param::C1, 0.02..=0.3, 29)
        .axis(Param::BeltVelocity, 0.1..=3.0, 59)
        .start(Start::Both)
        .set(Param::StartVelocity, 0.01)
        .response(Settle::Auto);
    same(&band, &shipped("bistable_band.toml"));
    let basin = mass_on_belt()
        .title("Basins of sliding and stick-slip of a mass on a belt")
        .set(Param::C1, 0.1)
        .axis(Param::BeltVelocity, 1.0..=2.0, 41)
        .start(Start::Box { samples: 200 })
        .set(Param::BoxDisplacementFrom, -2.5)
        .set(Param::BoxDisplacementTo, 1.5)
        .set(Param::BoxVelocityFrom, 0.0)
        .set(Param::BoxVelocityTo, 2.0)
        .response(Settle::After(Duration::Periods(150.0)))
        .measure(Duration::Periods(50.0));
    same(&basin, &shipped("basin.toml"));
    let six =
        |sweep: Sweep| sweep.response(Settle::After(Duration::Seconds(6.0))).measure(Duration::Seconds(3.0));
    let temperature = six(Sweep::two_mass())
        .title("Stability of an illustrative pad over temperature and belt velocity")
        .files_in(sweeps())
        .law(LawKind::Bilinear)
        .material("pad.csv")
        .outside(Outside::Error)
        .axis(Param::Temperature, 100.0..=500.0, 41)
        .axis(Param::BeltVelocity, 0.25..=7.0, 28);
    same(&temperature, &shipped("temperature_map.toml"));
    let refined = six(Sweep::two_mass())
        .title("Lines of the stability map, 1025 by 1025 by 3")
        .friction(Bilinear { mu_s: 0.5, mu_d: 0.3, knee_velocity: 5.0 })
        .axis(Param::MuS, 0.0..=0.6, 1025)
        .axis(Param::MuD, 0.0..=0.6, 1025)
        .values(Param::BeltVelocity, [1.0, 3.0, 6.0])
        .refine(Settings { coarse: 32, sample: 1000, ..Settings::default() });
    same(&refined, &shipped("refined_map.toml"));
    let tuples = six(Sweep::two_mass())
        .title("The paper's friction cases")
        .files_in(sweeps())
        .points_file("tuples.csv")
        .set(Param::KneeVelocity, 5.0);
    same(&tuples, &shipped("tuples.toml"));
}

#[test]
fn what_no_shipped_sweep_has_is_built_in_code() {
    let laws = Sweep::two_mass()
        .laws([LawKind::Rational, LawKind::Bilinear])
        .set(Param::MuS, 0.4)
        .set(Param::MuD, 0.2)
        .set(Param::Decay, 0.1)
        .log_axis(Param::BeltVelocity, 0.01..=10.0, 7)
        .without_eigenvalues()
        .impact_friction(false)
        .check(false)
        .response(Settle::AutoWithin(Duration::Seconds(40.0)));
    same_text(
        &laws,
        "analysis = [\"response\"]\n[model]\nimpact_friction = false\n[friction]\nmu_s = 0.4\nmu_d = 0.2\ndecay = 0.1\n\
         [axes]\nlaw = { values = [\"rational\", \"bilinear\"] }\n\
         belt_velocity = { from = 0.01, to = 10.0, points = 7, scale = \"log\" }\n\
         [response]\nsettle = \"auto\"\nsettle_limit = \"40 s\"\ncheck = false\n",
    );
    let materials = Sweep::two_mass()
        .files_in(sweeps())
        .materials(["pad.csv"])
        .outside(Outside::Clamp)
        .set(Param::Temperature, 1e4)
        .set(Param::BeltVelocity, 2.0)
        .without_response();
    same_text(
        &materials,
        "analysis = [\"linear\"]\n[friction]\noutside = \"clamp\"\ntemperature = 1e4\n[belt]\nbelt_velocity = 2\n\
         [axes]\nmaterial = { values = [\"pad.csv\"] }\n",
    );
    let ramp = Sweep::two_mass()
        .friction(Rational { mu_s: 0.4, decay: 0.1 })
        .set(Param::BeltVelocity, 7.0)
        .set(Param::BeltVelocityEnd, 0.0)
        .values(Param::RampDuration, [2.0, 1.0])
        .start(Start::Mode)
        .set(Param::StartFraction, 0.1);
    same_text(
        &ramp,
        "[friction]\nlaw = \"rational\"\nmu_s = 0.4\ndecay = 0.1\n[belt]\nbelt_velocity = 7.0\nbelt_velocity_end = 0\n\
         [start]\nkind = \"mode\"\nstart_fraction = 0.1\n[axes]\nramp_duration = { values = [2.0, 1.0] }\n",
    );
}

#[test]
fn numbers_of_code_stand_for_those_of_files() {
    let directory = std::env::temp_dir().join(format!("squealmap-build-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    std::fs::write(directory.join("mu.csv"), "velocity,mu\n0,0.5\n0.125,0.3333333333333333\n").unwrap();
    std::fs::write(directory.join("points.csv"), "mu_d,belt_velocity\n0.1,3\n1e-7,0.30000000000000004\n")
        .unwrap();
    let table = MuTable { velocity: vec![0.0, 0.125], mu: vec![0.5, 1.0 / 3.0] };
    let of_table =
        Sweep::two_mass().friction(FrictionLaw::Table(Arc::new(table))).set(Param::BeltVelocity, 1.0);
    let text = "[friction]\nlaw = \"table\"\ntable = \"mu.csv\"\n[belt]\nbelt_velocity = 1.0\n";
    same(&of_table, &Spec::parse(text, "test.toml", &directory).unwrap());
    let by_file =
        Sweep::two_mass().files_in(&directory).friction_table("mu.csv").set(Param::BeltVelocity, 1.0);
    same(&by_file, &of_table.spec().unwrap());
    let points = Sweep::two_mass()
        .law(LawKind::Constant)
        .points([Param::MuD, Param::BeltVelocity], [[0.1, 3.0], [1e-7, 0.1 + 0.2]]);
    let text = "points = \"points.csv\"\n[friction]\nlaw = \"constant\"\n";
    same(&points, &Spec::parse(text, "test.toml", &directory).unwrap());
    std::fs::remove_dir_all(directory).unwrap();
}

#[test]
fn the_last_of_two_calls_counts() {
    let base = Sweep::two_mass()
        .friction(Bilinear { mu_s: 0.5, mu_d: 0.3, knee_velocity: 5.0 })
        .set(Param::BeltVelocity, 3.0);
    let again = base
        .clone()
        .set(Param::MuS, 0.2)
        .response(Settle::Auto)
        .response(Settle::After(Duration::Seconds(1.0)));
    let once = Sweep::two_mass()
        .friction(Bilinear { mu_s: 0.2, mu_d: 0.3, knee_velocity: 5.0 })
        .set(Param::BeltVelocity, 3.0)
        .response(Settle::After(Duration::Seconds(1.0)));
    same(&again, &once.spec().unwrap());
    assert_ne!(format!("{:?}", base.spec().unwrap()), format!("{:?}", again.spec().unwrap()));
}

/// A whole sweep but for what a case adds.
fn sound() -> Sweep {
    Sweep::two_mass()
        .friction(Bilinear { mu_s: 0.5, mu_d: 0.3, knee_velocity: 5.0 })
        .set(Param::BeltVelocity, 3.0)
}

#[test]
fn errors_are_those_of_files_at_the_place_of_a_call() {
    let whole = "[friction]\nmu_s = 0.5\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";
    let cases = [
        (sound().set(Param::K1, 0.0), ".set(Param::K1, 0)", "[model]\nk1 = 0"),
        (
            sound().axis(Param::BeltVelocity, 1.0..=2.0, 5),
            ".axis(Param::BeltVelocity, 1..=2, 5)",
            "[axes]\nbelt_velocity = { from = 1, to = 2, points = 5 }",
        ),
        (
            sound().axis(Param::C1, 1.0..=1.0, 5),
            ".axis(Param::C1, 1..=1, 5)",
            "[axes]\nc1 = { from = 1, to = 1, points = 5 }",
        ),
        (
            sound().log_axis(Param::C1, 0.0..=1.0, 5),
            ".log_axis(Param::C1, 0..=1, 5)",
            "[axes]\nc1 = { from = 0, to = 1, points = 5, scale = \"log\" }",
        ),
        (
            sound().axis(Param::C1, 0.0..=1.0, 0),
            ".axis(Param::C1, 0..=1, 0)",
            "[axes]\nc1 = { from = 0, to = 1, points = 0 }",
        ),
        (
            sound().axis(Param::C1, 0.0..=1.0, 2_000_000).axis(Param::C2, 0.0..=1.0, 1_000_000),
            ".axis(Param::C2, 0..=1, 1000000)",
            "[axes]\nc1 = { from = 0, to = 1, points = 2000000 }\nc2 = { from = 0, to = 1, points = 1000000 }",
        ),
        (
            sound().values(Param::Theta, [0.0, 0.1, 2.0]),
            ".values(Param::Theta, [0, 0.1, 2])",
            "[axes]\ntheta = { values = [0, 0.1, 2] }",
        ),
        (sound().values(Param::Theta, []), ".values(Param::Theta, [])", "[axes]\ntheta = { values = [] }"),
        (sound().set(Param::Decay, 1.0), ".set(Param::Decay, 1)", "[friction]\ndecay = 1"),
        (sound().set(Param::RampDuration, 1.0), ".set(Param::RampDuration, 1)", "[belt]\nramp_duration = 1"),
        (
            sound().start(Start::Box { samples: 0 }),
            ".start(Start::Box { samples: 0 })",
            "[start]\nkind = \"box\"\nbox_samples = 0",
        ),
        (sound().start(Start::Box { samples: 9 }), "Sweep::two_mass()", "[start]\nkind = \"box\""),
        (sound().steps_per_period(2), ".steps_per_period(2)", "[response]\nsteps_per_period = 2"),
        (sound().title("a\u{7}b"), ".title(\"a\\u{7}b\")", "title = \"a\\u0007b\""),
        (
            sound().refine(Settings { coarse: 1, ..Settings::default() }),
            ".refine(Settings { coarse: 1, sample: 1000, seed: 1 })",
            "[refine]\ncoarse = 1",
        ),
    ];
    for (built, place, added) in cases {
        let (section, key) = added.split_once('\n').unwrap_or(("", added));
        let text = match whole.find(section).filter(|_| !section.is_empty()) {
            Some(at) => format!("{}\n{key}\n{}", &whole[..at + section.len()], &whole[at + section.len()..]),
            None if section.is_empty() => format!("{added}\n{whole}"),
            None => format!("{whole}{added}\n"),
        };
        let of_file = Spec::parse(&text, "test.toml", sweeps()).unwrap_err();
        let said = of_file.to_string();
        let sentence = said.split_once(": ").unwrap().1;
        let found = built.spec().unwrap_err();
        let numbers = |text: &str| text.replace("\\u0007", "\\u{7}").replace("\"a", "a").replace("b\"", "b");
        assert_eq!(numbers(&found.to_string()), numbers(&format!("{place}: {sentence}")), "{text}");
        assert!(found.is_bad_input() && found.place().is_some(), "{found}");
    }
}

#[test]
fn what_only_code_can_say_is_refused_in_a_sentence() {
    let table = |velocity: &[f64], mu: &[f64]| {
        FrictionLaw::Table(Arc::new(MuTable { velocity: velocity.to_vec(), mu: mu.to_vec() }))
    };
    let both = "axis `theta` stands beside an axis of the same name; remove one of them";
    let cases = [
        (
            sound().measure(Duration::Ramp),
            ".measure(Duration::Ramp): `measure` in [response] is ramp_duration but",
        ),
        (
            sound().response(Settle::After(Duration::Seconds(f64::NAN))),
            "): `settle` in [response] is NaN s but must be",
        ),
        (sound().without_response().without_eigenvalues(), ".without_eigenvalues(): `analysis` is empty"),
        (sound().values(Param::Theta, [0.0]).values(Param::Theta, [0.1]), both),
        (sound().values(Param::Theta, [0.0]).points([Param::C1], [[1.0]]), "`points` stands beside [axes]"),
        (sound().points([Param::C1], [[1.0]]).axis(Param::C2, 0.0..=1.0, 2), "`points` stands beside [axes]"),
        (sound().points([Param::C1], []), "has a header but no rows"),
        (
            sound().points([Param::C1, Param::C1], [[1.0, 2.0]]),
            "column `c1` stands beside a column of the same name",
        ),
        (sound().points([Param::C1], [[1.0], [-2.0]]), ".points(…):3:1: column `c1` is -2 but must be"),
        (Sweep::two_mass(), "Sweep::two_mass(): `belt_velocity` is missing"),
        (sound().law(LawKind::Exponential), "knee_velocity` in [friction] would have no effect"),
        (sound().friction(table(&[0.0, 1.0], &[0.5])), "mu` must be a number, found an empty cell"),
        (
            sound().friction(table(&[0.0], &[0.5])),
            "number of rows of a friction table is 1 but must be at least 2",
        ),
        (sound().friction(table(&[], &[])), "has a header but no rows"),
        (
            sound().friction(table(&[0.0, 2.0, 1.0], &[0.5; 3])),
            ".friction(Table(…)):4:1: `velocity` is 1 after 2",
        ),
        (sound().friction(table(&[0.0, 1.0], &[0.5, f64::INFINITY])), "column `mu` is inf but must be"),
        (
            sound().material("no such file.csv"),
            ".material(\"no such file.csv\"): cannot read the material file",
        ),
    ];
    for (built, words) in cases {
        let found = built.spec().unwrap_err().to_string();
        assert!(found.contains(words), "{found} does not say: {words}");
        assert!(!found.contains('\n'), "{found}");
    }
}

#[test]
fn no_number_panics() {
    let numbers = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0, 5e-324, 1.0, 1e308, f64::MAX];
    let mut accepted = 0;
    for param in PARAMS.iter().map(|row| row.param) {
        for one in numbers {
            let _ = sound().set(param, one).spec();
            for other in numbers {
                for points in [0, 1, 2, 5, usize::MAX] {
                    for sweep in [
                        sound().axis(param, one..=other, points),
                        sound().log_axis(param, one..=other, points),
                    ] {
                        let Ok(spec) = sweep.spec() else { continue };
                        let Grid::Axes(axes) = &spec.grid else { panic!("axes were given") };
                        assert_eq!(axes[0].values.len(), points);
                        assert!(
                            (0..points).all(|index| spec
                                .instance(index)
                                .params
                                .get(param)
                                .is_some_and(f64::is_finite))
                        );
                        accepted += 1;
                    }
                }
            }
        }
    }
    assert!(accepted > 300, "{accepted}");
}
