//! How the belt moves: what sweeps say of it, what is refused, and what is kept of it.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]
#![expect(clippy::float_cmp, reason = "values of a sweep file arrive as they are written")]

use std::path::Path;
use std::sync::Arc;

use crate::cli::program::squealmap;
use squealmap::engine::plan::Duration;
use squealmap::model::motion::MotionTable;
use squealmap::{InstabilityType, Motion, Param, Regime, Spec, Sweep};

/// A sweep with this `[belt]`, beside a file of a stroke.
fn read(belt: &str) -> Result<Spec, String> {
    with("time,velocity\ns,m/s\n0,0\n0.1,0.04\n0.3,0.01\n", belt, "")
}

fn with(stroke: &str, belt: &str, rest: &str) -> Result<Spec, String> {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("stroke.csv"), stroke).unwrap();
    let text = format!("[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\n{belt}\n{rest}");
    Spec::parse(&text, "s.toml", directory.path()).map_err(|why| why.to_string())
}

#[track_caller]
fn refused(belt: &str, words: &str) {
    let why = read(belt).err().unwrap_or_else(|| panic!("{belt} is taken"));
    assert!(why.contains(words), "{why}");
}

#[test]
fn motions_are_read() {
    let sine = read("motion = \"sine\"\nbelt_velocity = 0.05\nramp_duration = 0.3").unwrap();
    assert_eq!((sine.motion.clone(), sine.measure), (Motion::Sine, Duration::Ramp));
    assert_eq!(sine.settle, Duration::Seconds(0.0));
    assert_eq!(sine.instance(0).motion, Motion::Sine);
    let trapeze = "motion = \"trapeze\"\nramp_duration = 0.3\nrise_duration = 0.02\n";
    let trapeze = with("", trapeze, "[axes]\nbelt_velocity = { values = [0.01, 0.05] }\n").unwrap();
    let one = trapeze.instance(1);
    assert_eq!(*one.motion.corners(&one.params), [[0.0, 0.0], [0.02, 0.05], [0.3 - 0.02, 0.05], [0.3, 0.0]]);
    let table = read("motion = \"table\"\nmotion_table = \"stroke.csv\"").unwrap();
    let one = table.instance(0);
    assert_eq!(*one.motion.corners(&one.params), [[0.0, 0.0], [0.1, 0.04], [0.3, 0.01]]);
    assert_eq!(one.params.require(Param::BeltVelocity), 0.04, "the largest, at which eigenvalues are taken");
    assert_eq!(read("motion = \"ramp\"\nbelt_velocity = 3").unwrap().instance(0).motion, Motion::Ramp);
}

#[test]
fn what_a_motion_does_not_read_or_lacks_is_said() {
    let table = "motion = \"table\"\nmotion_table = \"stroke.csv\"\n";
    refused("motion = \"circle\"\nbelt_velocity = 1", "motion `circle`");
    refused("motion = \"sine\"\nbelt_velocity = 1", "`ramp_duration`");
    refused("motion = \"sine\"\nramp_duration = 1", "`belt_velocity`");
    refused("motion = \"trapeze\"\nbelt_velocity = 1\nramp_duration = 1", "`rise_duration`");
    refused("motion = \"sine\"\nbelt_velocity = 1\nramp_duration = 1\nrise_duration = 0.1", "\"trapeze\"");
    // Half of the time is a triangle; more would not come to rest.
    let trapeze = "motion = \"trapeze\"\nbelt_velocity = 1\nramp_duration = 1\n";
    assert!(with("", &format!("{trapeze}rise_duration = 0.5\n"), "").is_ok());
    refused(
        &format!("{trapeze}rise_duration = 0.6"),
        "is 0.6 s but must be at most half of `ramp_duration`, 0.5 s",
    );
    let axes = "[axes]\nrise_duration = { values = [0.1, 0.7] }\n";
    let why = with("", trapeze, axes).err().unwrap();
    assert!(why.contains("axis `rise_duration`") && why.contains("0.7 s"), "{why}");
    refused(
        "motion = \"sine\"\nbelt_velocity = 1\nramp_duration = 1\nbelt_velocity_end = 0",
        "motion = \"ramp\"",
    );
    refused("belt_velocity = 1\nbelt_velocity_end = 0", "describes a ramp");
    refused("motion = \"table\"", "`motion_table`");
    refused("motion_table = \"stroke.csv\"\nbelt_velocity = 1", "motion = \"table\"");
    refused(&format!("{table}belt_velocity = 1"), "`belt_velocity`");
    refused(&format!("{table}ramp_duration = 1"), "`ramp_duration`");
    refused("motion = \"table\"\nmotion_table = \"none.csv\"", "cannot read the motion file");
    refused("motion = 3\nbelt_velocity = 1", "`motion` in [belt]");
    let auto =
        with("", "motion = \"sine\"\nbelt_velocity = 1\nramp_duration = 1", "[response]\nsettle = \"auto\"");
    assert!(auto.unwrap_err().contains("during which nothing settles"));
    let spec = read(table).unwrap();
    let why = spec.instance_at("belt_velocity=1").unwrap_err().to_string();
    assert!(why.contains("`belt_velocity`") && why.contains("motion"), "{why}");
    assert!(spec.moving_belt().is_some() && read("belt_velocity = 1").unwrap().moving_belt().is_none());
}

#[test]
fn a_file_of_a_motion_that_is_none_is_refused() {
    let table = "motion = \"table\"\nmotion_table = \"stroke.csv\"";
    for (stroke, words) in [
        ("time,velocity\n0,1\n", "at least 2"),
        ("time,velocity\n0.1,1\n0.2,1\n", "the first `time`"),
        ("time,velocity\n0,1\n0,2\n", "time"),
        ("time,velocity\n0,1\n1,-2\n", "`velocity`"),
        ("time,velocity\n0,0\n1,0\n", "above 0 somewhere"),
        ("time,velocity\n0,1\n1,nan\n", "velocity"),
        ("time,speed\n0,1\n1,2\n", "speed"),
        ("time\n0\n1\n", "`velocity`"),
        ("time,velocity\n", "row"),
        ("", ""),
    ] {
        let why = with(stroke, table, "").err().unwrap_or_else(|| panic!("{stroke} is taken"));
        assert!(why.contains(words), "{stroke}: {why}");
    }
}

/// The sweep that a directory describes is the sweep that was computed.
#[test]
fn a_motion_is_kept_with_its_corners() {
    let spec = read("motion = \"table\"\nmotion_table = \"stroke.csv\"").unwrap();
    let belt = spec.resolved()["belt"].clone();
    assert_eq!(belt["motion"], "table");
    assert_eq!(belt["motion_table"]["time"], serde_json::json!([0.0, 0.1, 0.3]));
    assert_eq!(belt["motion_table"]["velocity"], serde_json::json!([0.0, 0.04, 0.01]));
    let steady = read("belt_velocity = 1").unwrap().resolved()["belt"].clone();
    assert_eq!(steady, serde_json::json!({ "belt_velocity": 1.0 }), "as before there were others");
}

#[test]
fn a_motion_built_in_code_is_that_of_a_file() {
    let spec = read("motion = \"table\"\nmotion_table = \"stroke.csv\"").unwrap();
    let corners: Arc<[[f64; 2]]> = Arc::new([[0.0, 0.0], [0.1, 0.04], [0.3, 0.01]]);
    let table = |corners| {
        Motion::Table(Arc::new(MotionTable { name: "stroke.csv".to_owned(), corners, temperature: None }))
    };
    let sweep = |motion| Sweep::two_mass().set(Param::MuS, 0.4).set(Param::MuD, 0.3).motion(motion);
    let built = sweep(table(corners)).spec().unwrap();
    assert_eq!(built.resolved(), spec.resolved());
    let warm = MotionTable {
        name: "warm.csv".to_owned(),
        corners: Arc::new([[0.0, 0.5], [1.0, 2.0], [3.0, 1.0]]),
        temperature: Some(Arc::new([[0.0, 100.0], [1.0, 500.0], [3.0, 200.0]])),
    };
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("pad.csv"), PAD).unwrap();
    let built = Sweep::two_mass()
        .files_in(directory.path())
        .material("pad.csv")
        .motion(Motion::Table(Arc::new(warm)));
    let read =
        warmed("material = \"pad.csv\"", "motion = \"table\"\nmotion_table = \"warm.csv\"", "").unwrap();
    assert_eq!(built.spec().unwrap().resolved(), read.resolved());
    let why = sweep(table(Arc::new([[0.5, 1.0], [1.0, 1.0]]))).spec().unwrap_err().to_string();
    assert!(why.contains("the first `time`"), "{why}");
    let why = sweep(Motion::Sine).spec().unwrap_err().to_string();
    assert!(why.contains("`ramp_duration`"), "{why}");
}

/// A run in tiles is completed from what its directory holds, without the sweep file.
#[test]
fn a_run_of_strokes_is_completed_from_its_tiles() {
    completed(
        "time,velocity\n0,0\n0.1,3\n0.3,1\n",
        "mu_d = 0.2",
        "mu_s = { from = 0.1, to = 0.6, points = 12 }",
    );
    let (warm, pad) =
        ("time,velocity,temperature\n0,0,100\n0.1,3,500\n0.3,1,300\n", "material = \"pad.csv\"");
    completed(warm, pad, "theta = { from = 0.01, to = 0.3, points = 12 }");
}

fn completed(stroke: &str, friction: &str, axis: &str) {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    std::fs::write(at.join("stroke.csv"), stroke).unwrap();
    std::fs::write(at.join("pad.csv"), "temperature,mu_s,mu_d\n100,0.2,0.1\n500,0.5,0.3\n").unwrap();
    let text = format!(
        "[friction]\n{friction}\n[belt]\nmotion = \"table\"\nmotion_table = \"stroke.csv\"\n\
         [axes]\n{axis}\n[response]\ncheck = false\n"
    );
    std::fs::write(at.join("s.toml"), text).unwrap();
    let ran = |args: &[&str]| {
        let ended = squealmap(Path::new(at), args);
        assert_eq!(ended.code, Some(0), "{args:?}: {}", ended.err);
    };
    ran(&["run", "s.toml", "-o", "whole", "--backend", "cpu"]);
    ran(&["run", "s.toml", "-o", "tiles", "--backend", "cpu", "--tile", "4", "--shard", "0/2"]);
    ran(&["run", "s.toml", "-o", "tiles", "--backend", "cpu", "--tile", "4", "--shard", "1/2"]);
    ran(&["merge", "tiles"]);
    let map = |name: &str| std::fs::read(at.join(name).join("map.csv")).unwrap();
    assert_eq!(map("whole"), map("tiles"));
}

/// A pad.
const PAD: &str = "temperature,mu_s,mu_d\n100,0.1,0.1\n300,0.2,0.1\n500,0.4,0.2\n";

/// A sweep of a pad with this `[belt]`, and further lines of `[friction]`.
fn warmed(friction: &str, belt: &str, rest: &str) -> Result<Spec, String> {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(directory.path().join(name), text).unwrap();
    write("pad.csv", PAD);
    write("warm.csv", "time,velocity,temperature\n0,0.5,100\n1,2,500\n3,1,200\n");
    write("hot.csv", "time,velocity,temperature\n0,0.5,100\n1,2,501\n");
    let text = format!("[friction]\n{friction}\n[belt]\n{belt}\n{rest}");
    Spec::parse(&text, "s.toml", directory.path()).map_err(|why| why.to_string())
}

#[test]
fn temperatures_over_a_run_are_read() {
    let pad = "material = \"pad.csv\"\n";
    let straight = format!("{pad}temperature = 100\ntemperature_end = 500");
    let spec = warmed(&straight, "belt_velocity = 2\nramp_duration = 4", "").unwrap();
    assert_eq!((spec.settle, spec.measure), (Duration::Seconds(0.0), Duration::Ramp), "all of the course");
    let one = spec.instance(0);
    assert_eq!([0.0, 1.0, 4.0, 9.0].map(|t| one.temperature(t).unwrap()), [100.0, 200.0, 500.0, 500.0]);
    assert_eq!(one.law.mu(0.0), 0.1, "eigenvalues are those at the start");
    let hot = one.heated(400.0).law;
    assert!((hot.mu(0.0) - 0.3).abs() < 1e-15 && (hot.mu(9.0) - 0.15).abs() < 1e-15);
    let axis = "[axes]\ntemperature_end = { values = [100, 300] }";
    let ends =
        warmed(&format!("{pad}temperature = 100"), "belt_velocity = 2\nramp_duration = 4", axis).unwrap();
    assert_eq!([0, 1].map(|index| ends.instance(index).temperature(2.0).unwrap()), [100.0, 200.0]);
    let table = "motion = \"table\"\nmotion_table = \"warm.csv\"";
    let spec = warmed(pad, table, "").unwrap();
    let one = spec.instance(0);
    assert_eq!([0.0, 0.5, 2.0, 3.5].map(|t| one.temperature(t).unwrap()), [100.0, 300.0, 350.0, 200.0]);
    assert_eq!(one.motion.velocity(&one.params, 2.0), 1.5);
    // Without a course it stays.
    let still = warmed(&format!("{pad}temperature = 300"), "belt_velocity = 2", "").unwrap().instance(0);
    assert!(still.heating.is_none() && still.temperature(5.0) == Some(300.0));
}

#[test]
fn temperatures_that_do_not_fit_are_refused() {
    let pad = "material = \"pad.csv\"\n";
    let ramp = "belt_velocity = 2\nramp_duration = 4";
    let table = "motion = \"table\"\nmotion_table = \"warm.csv\"";
    let cases = [
        ("mu_s = 0.4\nmu_d = 0.3\ntemperature_end = 200", ramp, "only by a `material`"),
        (&format!("{pad}temperature = 100\ntemperature_end = 200"), "belt_velocity = 2", "`ramp_duration`"),
        (&format!("{pad}temperature_end = 200"), ramp, "`temperature`"),
        (&format!("{pad}temperature = 100\ntemperature_end = 501"), ramp, "501"),
        (&format!("{pad}temperature = 100\ntemperature_end = nan"), ramp, "finite"),
        (&format!("{pad}temperature = 100"), table, "column `temperature` of `motion_table`"),
        (&format!("{pad}temperature_end = 200"), table, "motion = \"ramp\""),
        ("mu_s = 0.4\nmu_d = 0.3", table, "only by a `material`"),
        (pad, "motion = \"table\"\nmotion_table = \"hot.csv\"", "501"),
    ];
    for (friction, belt, words) in cases {
        let why = warmed(friction, belt, "").err().unwrap_or_else(|| panic!("{friction} {belt} is taken"));
        assert!(why.contains(words), "{why}");
    }
    let settles = format!("{pad}temperature = 100\ntemperature_end = 200");
    let why = warmed(&settles, ramp, "[response]\nsettle = \"auto\"").unwrap_err();
    assert!(why.contains("nothing settles"), "{why}");
}

/// What a run decays to is the equilibrium of the temperature at its end: a pad that has cooled down is stable.
#[test]
fn a_regime_is_that_of_the_temperature_at_the_end() {
    let run = |from: f64, to: f64| {
        let friction = format!("material = \"pad.csv\"\ntemperature = {from}\ntemperature_end = {to}");
        let rest = "[response]\nsettle = \"1 s\"\nmeasure = \"1 s\"\n[start]\nstart_velocity = 1e-3\n[model]\nc1 = 5\nc2 = 5";
        let spec = warmed(&friction, "belt_velocity = 2\nramp_duration = 1.5", rest).unwrap();
        let map = squealmap::sweep::run::run(spec, &squealmap::Options::default(), &|_| {}).unwrap();
        (map.records[0].kind, map.records[0].regime)
    };
    assert_eq!(run(300.0, 100.0), (Some(InstabilityType::NegativeSlope), Some(Regime::Equilibrium)));
    assert_eq!(run(100.0, 300.0), (Some(InstabilityType::Stable), Some(Regime::NotYetGrown)));
}
