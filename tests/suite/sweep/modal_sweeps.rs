//! Sweeps over the modes of a structure: what tells them apart, the program, code, modes that are followed, the shipped map.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;
use std::path::Path;

use squealmap::Sweep;
use squealmap::engine::options::Options;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::{analyse, eigenvalues};
use squealmap::model::modal::{At, EACH};
use squealmap::store::description::Description;
use squealmap::store::identity::identity;
use squealmap::study::modes::follow::{Mode, modes_of};
use squealmap::sweep::grid::{Axis, Grid};
use squealmap::sweep::run::run;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;

use crate::cli::program::{squealmap, unwrapped};
use crate::sweep::modal::THREE;

fn sweep_of_three(directory: &Path) -> Spec {
    std::fs::write(directory.join("three.toml"), THREE).unwrap();
    let text = "[model]\nkind = \"modal\"\nmodes = \"three.toml\"\n[friction]\nknee_velocity = 2\n[belt]\nbelt_velocity = 1\n\
                [axes]\nmu_s = { from = 0, to = 0.4, points = 5 }\nmu_d = { from = 0, to = 0.4, points = 5 }\n";
    std::fs::write(directory.join("map.toml"), text).unwrap();
    Spec::read(&directory.join("map.toml")).unwrap()
}

/// What stands in the file is part of what a sweep is, and enough to compute it again.
#[test]
fn another_file_is_another_sweep() {
    let directory = tempfile::tempdir().unwrap();
    let spec = sweep_of_three(directory.path());
    assert!((spec.base.require(Param::FExt) - 10.0).abs() < 1e-15, "the load of the file");
    let options = Options::default();
    let computations = Solver::new(&spec, &options).unwrap().computations();
    let described = Description::new(&spec, computations.clone(), 8);
    assert_eq!(described.computations[0].as_ref().unwrap().method, squealmap::model::modal::METHOD);
    // A description alone gives the sweep again.
    std::fs::remove_file(directory.path().join("three.toml")).unwrap();
    let again = Description::from_bytes(&described.to_bytes()).unwrap().spec().unwrap();
    assert_eq!(identity(&again, &computations), identity(&spec, &computations));
    for index in 0..25 {
        assert_eq!(analyse(&again.instance(index)), analyse(&spec.instance(index)));
    }
    // One digit more is another sweep.
    let text = THREE.replace("900.0", "900.1");
    std::fs::write(directory.path().join("three.toml"), text).unwrap();
    let other = Spec::read(&directory.path().join("map.toml")).unwrap();
    assert_ne!(Description::new(&other, computations, 8).id, described.id);
}

#[test]
fn the_program_maps_a_structure_and_refuses_what_it_has_not() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    sweep_of_three(here);
    let ended = squealmap(here, &["run", "map.toml", "--output", "a"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let table = std::fs::read_to_string(here.join("a/map.csv")).unwrap();
    let header =
        "instance,mu_s,mu_d,type,growth_rate,frequency,phase,growth_rate_flat,growth_rate_frozen,status";
    assert_eq!(table.lines().next(), Some(header));
    assert!(table.contains("mode_coupling") && table.contains("negative_slope"), "{table}");
    let figure = std::fs::read_to_string(here.join("a/map.svg")).unwrap();
    assert!(figure.contains("Type"), "{}", &figure[..400]);
    let manifest = std::fs::read_to_string(here.join("a/manifest.json")).unwrap();
    assert!(manifest.contains(&blake3::hash(THREE.as_bytes()).to_hex().to_string()), "{manifest}");
    let refined = squealmap(here, &["refine", "map.toml", "--output", "b"]);
    assert_eq!(refined.code, Some(0), "{}", refined.err);
    let checked = squealmap(here, &["check", "map.toml"]);
    assert!(
        checked.out.contains("model     three.toml: 3 mode(s) in the space of 3 vector(s)"),
        "{}",
        checked.out
    );
    // The third mode knows nothing of friction.
    let ended = squealmap(here, &["modes", "map.toml", "--output", "c"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let table = std::fs::read_to_string(here.join("c/modes.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let third = reader.headers().unwrap().iter().position(|name| name == "frequency_3").unwrap();
    let thirds: Vec<f64> = reader.records().map(|row| row.unwrap()[third].parse().unwrap()).collect();
    assert_eq!(thirds.len(), 25);
    assert!(thirds.iter().all(|hertz| (hertz * TAU - 30.0).abs() < 1e-9), "{thirds:?}");
    let drawn = |path: &str| std::fs::read_to_string(here.join(path)).unwrap();
    let figure = drawn("c/modes.svg");
    assert!(figure.contains(">unstable<") && !figure.contains(">mode 1<"), "{}", &figure[..2000]);
    let ended = squealmap(here, &["plot", "c"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let curves = |text: &str| {
        text.lines().filter(|line| line.starts_with("<path")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(curves(&drawn("c/plot.svg")), curves(&figure));
    // Friction beyond that of the vectors is said, and computed.
    assert!(!checked.err.contains("vectors"), "{}", checked.err);
    let far = std::fs::read_to_string(here.join("map.toml"))
        .unwrap()
        .replace("to = 0.4, points = 5 }\nmu_d", "to = 2.4, points = 5 }\nmu_d");
    std::fs::write(here.join("far.toml"), far).unwrap();
    for command in ["check", "run"] {
        let ended = squealmap(here, &[command, "far.toml"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let wanted = "warning: the coefficient of friction is 1.4000 in this sweep, but the vectors of `three.toml` were chosen for 0 to 1";
        assert!(unwrapped(&ended.err).contains(wanted), "{}", ended.err);
    }
    for (arguments, wanted) in [
        (
            vec!["trace", "map.toml", "--at", "mu_s=0.1,mu_d=0.1"],
            "`trace` needs two masses, but the model is the modes of three.toml: a modal model has eigenvalues alone, which `run` maps",
        ),
        (vec!["tradeoff", "map.toml"], "`tradeoff` needs two masses"),
        (
            vec!["run", "map.toml", "--backend", "gpu"],
            "no kernel of a GPU computes a modal model, which --backend cpu does",
        ),
        (
            vec!["run", "map.toml", "--require-gpu"],
            "--require-gpu: this needs a GPU, but no kernel of one computes a modal model; compute it on the CPU, or remove --require-gpu",
        ),
    ] {
        let ended = squealmap(here, &arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?} {}", ended.err);
        let said = unwrapped(&ended.err);
        assert!(said.contains(wanted), "{said}\ndoes not say\n{wanted}");
    }
    assert!(
        eigenvalues(&Spec::read(&here.join("map.toml")).unwrap().instance(0)).is_none(),
        "it has no four"
    );
}

/// A sweep in code is that of the file.
#[test]
fn code_names_the_file_of_modes() {
    let directory = tempfile::tempdir().unwrap();
    let spec = sweep_of_three(directory.path());
    let built = Sweep::modal("three.toml")
        .files_in(directory.path())
        .set(Param::KneeVelocity, 2.0)
        .set(Param::BeltVelocity, 1.0)
        .axis(Param::MuS, 0.0..=0.4, 5)
        .axis(Param::MuD, 0.0..=0.4, 5);
    let same = built.spec().unwrap();
    assert_eq!(same.resolved(), spec.resolved());
    assert_eq!(built.run().unwrap().records, run(spec, &Options::default(), &|_| {}).unwrap().records);
    let wrong = Sweep::modal("none.toml").spec().unwrap_err().to_string();
    assert!(
        wrong.starts_with("Sweep::modal(\"none.toml\"): ") || wrong.starts_with("modal(\"none.toml\"): "),
        "{wrong}"
    );
    let wrong = built.set(Param::Theta, 0.1).spec().unwrap_err().to_string();
    assert!(wrong.starts_with(".set(Param::Theta, 0.1): `theta` in [model] would have no effect"), "{wrong}");
}

/// `modes` finds the critical friction of the study (`docs/fem_paper.md`) by bisection, and each mode goes on as it has come.
#[test]
fn modes_of_a_structure_are_followed() {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/fem");
    let text = "analysis = [\"linear\"]\n[model]\nkind = \"modal\"\nmodes = \"fem_modes.toml\"\n[friction]\nlaw = \"constant\"\n[belt]\n\
                belt_velocity = 1\n[axes]\nmu_d = { from = 0, to = 0.4, points = 21 }\n";
    let found = modes_of(&Spec::parse(text, "test.toml", directory.as_ref()).unwrap()).unwrap();
    let branch = &found.branches[0];
    assert_eq!((found.count(), branch.critical.len()), (6, 1));
    assert!((branch.critical[0] - 0.199_213).abs() < 1e-6, "{:?}", branch.critical);
    let rows: Vec<&Vec<_>> = branch.modes.iter().flatten().collect();
    assert_eq!(rows.len(), 21);
    for k in 0..6 {
        for pair in rows.windows(2) {
            let moved = (pair[1][k].frequency() - pair[0][k].frequency()).abs();
            // Least apart at the beginning are two that lie 238 Hz from each other.
            assert!(moved < 200.0, "mode {k} jumps by {moved} Hz");
        }
    }
    let growth = rows[20].iter().map(Mode::growth_rate).fold(0.0, f64::max);
    assert!((growth - 4821.2).abs() < 0.1, "{growth}");
}

/// The shipped map is that of the study's own numbers (`docs/fem_paper.md`), and has the types that its page names.
#[test]
fn the_shipped_map_is_that_of_the_papers_model() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/fem/fem_map.toml");
    let mut spec = Spec::read(path.as_ref()).unwrap();
    let modal = spec.modal.clone().unwrap();
    assert_eq!((modal.modes(), modal.size()), (6, 16));
    assert!((modal.load - 17.0).abs() < 1e-10);
    let growth = |mu: f64| {
        let all = modal.eigenvalues(At { mu, slope: 0.0, ratio: 0.0, each: [0.0; EACH], kn: None }).unwrap();
        all.iter().map(|z| z.re).fold(0.0, f64::max)
    };
    // Growth rises as the root of the distance from the critical friction.
    let critical = 0.199_212_7;
    assert!(growth(critical - 2e-7) == 0.0 && growth(critical + 2e-7) > 0.1);
    assert!((growth(0.4) - 4821.2).abs() < 0.1, "{}", growth(0.4));
    let frequency = modal
        .eigenvalues(At { mu: 0.4, slope: 0.0, ratio: 0.0, each: [0.0; EACH], kn: None })
        .unwrap()
        .iter()
        .max_by(|a, b| a.re.total_cmp(&b.re))
        .unwrap()
        .im
        .abs()
        / TAU;
    assert!((frequency - 14_527.17).abs() < 0.01, "{frequency}");
    let Grid::Axes(axes) = &mut spec.grid else { panic!("it has axes") };
    for Axis { values, .. } in axes {
        *values = values.iter().step_by(15).cloned().collect();
    }
    let kinds: Vec<_> = run(spec, &Options::default(), &|_| {})
        .unwrap()
        .records
        .iter()
        .map(|one| one.kind.unwrap())
        .collect();
    let of = |mu_s: usize, mu_d: usize| kinds[18 * mu_s + mu_d];
    assert_eq!(kinds.len(), 18 * 18);
    assert_eq!(of(0, 0), InstabilityType::Stable);
    assert_eq!(of(6, 0), InstabilityType::NegativeSlope);
    assert_eq!(of(17, 17), InstabilityType::ModeCoupling);
    assert_eq!(of(17, 0), InstabilityType::Coexistence);
    assert!(kinds.contains(&InstabilityType::Interaction));
}
