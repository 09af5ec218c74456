//! Materials of tables: friction against velocity at several temperatures.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use squealmap::engine::backend::Backend;
use squealmap::engine::instances::Instances;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::model::friction::{FrictionLaw, LawKind, MuTable};
use squealmap::model::{Param, material::Outside};
use squealmap::study::explore::explorer::Explorer;
use squealmap::sweep::build::Sweep;
use squealmap::sweep::run::run;
use squealmap::sweep::spec::Spec;
use tempfile::TempDir;

use crate::cli::program::{squealmap, unwrapped};

/// Friction at 100 and 300 °C, and what lies halfway, by hand: all numbers are sums of a few powers of two.
const COLD: &str = "0,0.5\n1,0.375\n3,0.125\n6,0.25\n";
const HALFWAY: &str = "0,0.375\n1,0.359375\n2,0.34375\n3,0.1875\n6,0.25\n";
const HOT: &str = "0,0.25\n2,0.4375\n3,0.25\n";

/// The rows of a table below a temperature.
fn at(temperature: &str, rows: &str) -> String {
    rows.lines().fold(String::new(), |mut text, row| {
        writeln!(text, "{temperature},{row},0.01").unwrap();
        text
    })
}

fn pad() -> String {
    format!("# Measured\ntemperature,velocity,mu,mu_error\n°C,m/s,-,-\n{}{}", at("100", COLD), at("300", HOT))
}

/// A directory with the material, and tables by themselves.
fn directory() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("pad.csv"), pad()).unwrap();
    for (name, rows) in [("cold.csv", COLD), ("halfway.csv", HALFWAY), ("hot.csv", HOT)] {
        fs::write(directory.path().join(name), format!("velocity,mu\n{rows}")).unwrap();
    }
    directory
}

const BELT: &str = "belt_velocity = { values = [0.3, 0.7, 1.5, 2.0, 2.5, 4.0, 6.5] }\n\
    [response]\nsettle = \"20 periods\"\nmeasure = \"20 periods\"\ncheck = false\n";

fn spec(directory: &Path, friction: &str, temperature: &str) -> Spec {
    let text = format!("[friction]\nlaw = \"table\"\n{friction}\n[axes]\n{temperature}{BELT}");
    Spec::parse(&text, "s.toml", directory).unwrap_or_else(|error| panic!("{error}"))
}

fn of_material(directory: &Path, temperatures: &str) -> Spec {
    let axis = format!("temperature = {{ values = [{temperatures}] }}\n");
    spec(directory, "material = \"pad.csv\"\noutside = \"clamp\"", &axis)
}

fn table(spec: &Spec, index: usize) -> MuTable {
    match spec.instance(index).law {
        FrictionLaw::Table(table) => table.as_ref().clone(),
        other => panic!("{other:?} is no table"),
    }
}

/// Every engine of the CPU: that of `Engine::ALL` but for the kernels, which get the same laws.
const ENGINES: [(Backend, Option<Precision>); 3] =
    [(Backend::Reference, None), (Backend::Cpu, Some(Precision::F64)), (Backend::Cpu, Some(Precision::F32))];

fn records(spec: &Spec, (backend, precision): (Backend, Option<Precision>)) -> Vec<Record> {
    run(spec.clone(), &Options { backend, precision, ..Options::default() }, &|_| {}).unwrap().records
}

#[test]
fn a_material_of_tables_is_its_tables_on_every_engine() {
    let directory = directory();
    let path = directory.path();
    let tables = ["cold", "halfway", "hot"];
    let single = tables.map(|name| spec(path, &format!("table = \"{name}.csv\""), ""));
    let swept = of_material(path, "100, 200, 300");
    for engine in ENGINES {
        let found = records(&swept, engine);
        assert!(found.iter().all(|record| record.kind.is_some() && record.regime.is_some()), "{engine:?}");
        for ((name, spec), part) in tables.iter().zip(&single).zip(found.chunks(7)) {
            assert_eq!(part, records(spec, engine), "{name} by {engine:?}");
        }
        // Types and regimes differ between the tables: another one would have been seen.
        assert_ne!(found[..7], found[7..14], "{engine:?}");
        assert_ne!(found[7..14], found[14..], "{engine:?}");
    }
    // Beyond its temperatures a clamped material is that of the nearest.
    let beyond = of_material(path, "20, 900");
    let ends = [&single[0], &single[2]].map(|spec| records(spec, ENGINES[1])).concat();
    assert_eq!(records(&beyond, ENGINES[1]), ends);
}

#[test]
fn engines_agree_between_temperatures() {
    let directory = directory();
    let spec = of_material(directory.path(), "100, 130, 170, 220, 260, 299");
    let [reference, others @ ..] = ENGINES.map(|engine| records(&spec, engine));
    let agree = |(found, expected): (&Record, &Record), tolerance: f64| {
        let std = |record: &Record| record.outcome.as_ref().and_then(|outcome| outcome.x2_std).unwrap();
        let (off, size) = ((std(found) - std(expected)).abs(), std(expected).abs());
        (found.kind, found.regime) == (expected.kind, expected.regime) && off <= tolerance * size + 1e-9
    };
    for (other, tolerance) in others.iter().zip([1e-6, 2e-3]) {
        assert_eq!(other.len(), 42);
        for (index, pair) in other.iter().zip(&reference).enumerate() {
            assert!(agree(pair, tolerance), "instance {index}: {pair:?}");
        }
        // Those of another temperature are seen.
        let shifted = other.iter().zip(&reference[7..]);
        assert!(shifted.filter(|pair| !agree(*pair, tolerance)).count() > 20);
    }
}

#[test]
fn between_temperatures_friction_is_linear_at_equal_velocity() {
    let directory = directory();
    let spec = of_material(directory.path(), "150");
    let (cold, hot) = (FrictionLaw::Table(parsed(COLD).into()), FrictionLaw::Table(parsed(HOT).into()));
    for k in 0..80 {
        let v = 0.1 * f64::from(k);
        let expected = 0.75 * cold.mu(v) + 0.25 * hot.mu(v);
        let found = spec.instance(0).law.mu(v);
        assert!((found - expected).abs() < 1e-15, "at {v} m/s: {found} instead of {expected}");
    }
    assert_eq!(table(&spec, 0).velocity, [0.0, 1.0, 2.0, 3.0, 6.0]);
    assert_eq!(spec.pieces(), 5, "kernels have room for the union");
    assert_eq!(table(&of_material(directory.path(), "200"), 0), parsed(HALFWAY));
}

fn parsed(rows: &str) -> MuTable {
    let numbers = rows.lines().map(|row| row.split_once(',').unwrap());
    let (velocity, mu) =
        numbers.map(|(v, mu)| (v.parse::<f64>().unwrap(), mu.parse::<f64>().unwrap())).unzip();
    MuTable { velocity, mu }
}

/// 0.3 as a program that adds writes it is 0.3: the piece between both would be all rounding.
#[test]
fn velocities_that_differ_by_rounding_are_one() {
    let mixed = |a: &str, b: &str| parsed(a).mixed(&parsed(b), 0.5);
    let found = mixed("0,0.5\n0.3,0.25\n1,0.5", "0,0.5\n0.30000000000000004,0.5\n1.0000001,0.25");
    assert_eq!(found, parsed("0,0.5\n0.3,0.375\n1,0.375"));
    // A row of its own stays, however near it is to others of its own table.
    let step = "0,0.5\n1,0.5\n1.0000001,0.25\n2,0.25";
    assert_eq!(mixed(step, "0,0.5\n3,0.5").velocity, [0.0, 1.0, 1.000_000_1, 2.0, 3.0]);
    for (a, b) in [(step, "0,0.5\n1.00000005,0.5"), (step, step), ("0,1\n1,1", step)] {
        for part in [0.25, 0.5, 0.75] {
            let found = parsed(a).mixed(&parsed(b), part);
            assert!(found.velocity.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
            assert!(found.mu.iter().all(|mu| (0.0..=1.0).contains(mu)), "{found:?}");
        }
    }
}

#[test]
fn code_and_text_say_the_same() {
    let directory = directory();
    let built = Sweep::two_mass()
        .files_in(directory.path())
        .law(LawKind::Table)
        .material("pad.csv")
        .outside(Outside::Clamp)
        .values(Param::Temperature, [100.0, 200.0])
        .values(Param::BeltVelocity, [0.5])
        .spec()
        .unwrap();
    let text = "[friction]\nlaw = \"table\"\nmaterial = \"pad.csv\"\noutside = \"clamp\"\n[axes]\n\
                temperature = { values = [100, 200] }\nbelt_velocity = { values = [0.5] }\n";
    let read = Spec::parse(text, "s.toml", directory.path()).unwrap();
    assert_eq!(built.resolved(), read.resolved());
    let material = &read.resolved()["friction"]["material"];
    assert_eq!(material["temperature"], serde_json::json!([100.0, 300.0]));
    assert_eq!(material["tables"][1]["mu"], serde_json::json!([0.25, 0.4375, 0.25]));
}

/// The sentence of a sweep over temperature that is refused.
fn refused(friction: &str, material: &str) -> String {
    let directory = directory();
    fs::write(directory.path().join("m.csv"), material).unwrap();
    let text = format!("[friction]\n{friction}\n[belt]\nbelt_velocity = 3\n");
    let error = Spec::parse(&text, "s.toml", directory.path()).map(|_| ()).expect_err("it is bad");
    assert!(error.is_bad_input() && error.place().is_some(), "{error}");
    error.to_string().replace(&format!("{}/", directory.path().display()), "")
}

#[test]
fn what_is_wrong_in_the_file_is_one_sentence() {
    const TABLES: &str = "law = \"table\"\nmaterial = \"m.csv\"\ntemperature = 100";
    let cases = [
        (
            "temperature,velocity\n100,0\n100,1\n",
            "m.csv:1:1: `mu` is missing: a material of tables of friction has such a column, so add it to the header and to \
             every row",
        ),
        (
            "temperature,mu\n100,0\n200,1\n",
            "m.csv:1:1: `velocity` is missing: a material of tables of friction has such a column, so add it to the header \
             and to every row",
        ),
        (
            "velocity,mu\n0,0.4\n1,0.3\n",
            "m.csv:1:1: `temperature` is missing: a material has such a column, so add it to the header and to every row",
        ),
        (
            "temperature,velocity,mu\n100,0,0.4\n100,2,0.3\n100,1,0.3\n",
            "m.csv:4:5: column `velocity` is 1 but must be above 2, that of the row before at 100 °C: sort the rows of each \
             temperature, with each velocity once",
        ),
        (
            "temperature,velocity,mu\n100,0,0.4\n100,2,0.3\n200,0,0.3\n",
            "m.csv:4:5: the number of rows of a friction table at 200 °C is 1 but must be at least 2; for one value choose law \
             = \"constant\"",
        ),
        (
            "temperature,velocity,mu\n100,0,0.4\n100,-2,0.3\n",
            "m.csv:3:5: column `velocity` is -2 but must be a finite number not below 0",
        ),
        (
            "temperature,velocity,mu\n100,0.5,0.4\n100,2,0.3\n",
            "m.csv:2:5: the first `velocity` at 100 °C is 0.5 but must be 0, where the table gives the limit of stick",
        ),
        (
            "temperature,velocity,mu\n100,0,0.4\n100,2,0.3\n200,0,0.4\n200,2,0.3\n100,0,0.4\n100,2,0.3\n",
            "m.csv:6:1: column `temperature` is 100 but must be above 200, that of the rows before: put all rows of a \
             temperature together, and temperatures in rising order",
        ),
        (
            "temperature,velocity,mu\n100,0,0.4\n100,2,0.3\n100,0,0.4\n100,2,0.3\n",
            "m.csv:4:5: column `velocity` is 0 but must be above 2, that of the row before at 100 °C: sort the rows of each \
             temperature, with each velocity once",
        ),
        (
            "temperature,velocity,mu,mu_s\n100,0,0.4,0.4\n100,1,0.3,0.4\n",
            "m.csv:1:25: column `mu_s` of a law stands beside column `velocity` of tables of friction; remove one of them",
        ),
        (
            "temperature,velocity,mu\n100,0,\n100,2,0.3\n",
            "m.csv:2:7: column `mu` must be a number, found an empty cell",
        ),
    ];
    for (material, sentence) in cases {
        assert_eq!(refused(TABLES, material), sentence);
    }
}

#[test]
fn what_does_not_fit_together_is_one_sentence() {
    let law = |law: &str, more: &str| format!("law = \"{law}\"\nmaterial = \"pad.csv\"\n{more}");
    let parameters = "temperature,mu_s,mu_d\n100,0.4,0.3\n200,0.3,0.3\n";
    let cases = [
        (
            law("table", "temperature = 150\ntable = \"cold.csv\""),
            "s.toml:5:9: `table` in [friction] stands beside material `pad.csv`, which has tables of its own; remove one of \
             them",
        ),
        (
            law("table", ""),
            "s.toml:1:2: `temperature` is missing: material `pad.csv` is read at a temperature, so give it in [friction] or \
             vary it",
        ),
        (
            law("table", "temperature = 50"),
            "s.toml:4:15: `temperature` is 50 but material `pad.csv` covers 100 to 300 °C; stay inside or set outside = \
             \"clamp\" in [friction]",
        ),
        (
            law("bilinear", "temperature = 150"),
            "s.toml:1:2: `mu_s` is missing: law `bilinear` needs it, so choose law = \"table\", whose tables material \
             `pad.csv` has, or another material",
        ),
        (
            "law = \"table\"\nmaterial = \"m.csv\"\ntemperature = 100".to_owned(),
            "s.toml:1:2: `mu` is missing: law `table` needs it, so give material `m.csv` columns `temperature`, `velocity` \
             and `mu` alone, or choose the law of its columns",
        ),
        (
            law("table", "temperature = 150\nmu_s = 0.4"),
            "s.toml:5:8: `mu_s` in [friction] would have no effect: it is used only by the laws constant, bilinear, \
             exponential and rational; remove it or choose that",
        ),
    ];
    for (friction, sentence) in cases {
        assert_eq!(refused(&friction, parameters), sentence);
    }
    let axis = law("table", "temperature = 150\n[axes]\nknee_velocity = { values = [1, 2] }");
    assert_eq!(
        refused(&axis, parameters),
        "s.toml:6:1: axis `knee_velocity` would have no effect: it is used only by the law bilinear; remove it or choose \
         that"
    );
}

/// A map of several materials, of tables or parameters, each with its law.
#[test]
fn materials_of_either_kind_stand_in_a_column() {
    let directory = directory();
    let parameters = "temperature,mu_s,mu_d,knee_velocity\n100,0.4,0.3,5\n200,0.3,0.3,5\n";
    fs::write(directory.path().join("m.csv"), parameters).unwrap();
    let points = "law,material,temperature\ntable,pad.csv,100\nbilinear,m.csv,100\ntable,pad.csv,300\n";
    fs::write(directory.path().join("points.csv"), points).unwrap();
    let text = "points = \"points.csv\"\n[belt]\nbelt_velocity = 1\n";
    let spec = Spec::parse(text, "s.toml", directory.path()).unwrap();
    assert_eq!((table(&spec, 0), table(&spec, 2)), (parsed(COLD), parsed(HOT)));
    assert_eq!(spec.instance(1).law.kind(), LawKind::Bilinear);
    let wrong = points.replace("bilinear,m.csv", "table,m.csv");
    fs::write(directory.path().join("points.csv"), wrong).unwrap();
    let error = Spec::parse(text, "s.toml", directory.path()).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("`mu` is missing: law `table` needs it"), "{error}");
}

#[test]
fn every_command_takes_it() {
    let directory = directory();
    let path = directory.path();
    let text = "[friction]\nlaw = \"table\"\nmaterial = \"pad.csv\"\n[axes]\n\
                temperature = { from = 100, to = 300, points = 9 }\nbelt_velocity = { from = 0.5, to = 5, points = 9 }\n\
                [response]\nsettle = \"20 periods\"\nmeasure = \"10 periods\"\n";
    fs::write(path.join("s.toml"), text).unwrap();
    let does = |arguments: &str, said: &str| {
        let ended = squealmap(path, &arguments.split(' ').collect::<Vec<_>>());
        assert_eq!(ended.code, Some(0), "{arguments}: {}", ended.err);
        assert!(ended.out.contains(said), "{arguments}: {}", ended.out);
    };
    does("check s.toml", "material  pad.csv: 100 to 300 °C");
    does("run s.toml -o all", "");
    does("run s.toml -o one --tile 16 --shard 0/2", "");
    does("run s.toml -o two --tile 16 --shard 1/2", "");
    // The directory itself says what is left to compute, without the sweep file or the material.
    fs::rename(path.join("pad.csv"), path.join("away.csv")).unwrap();
    does("merge both one two", "");
    fs::rename(path.join("away.csv"), path.join("pad.csv")).unwrap();
    let map = |name: &str| fs::read_to_string(path.join(name).join("map.csv")).unwrap();
    assert_eq!(map("all"), map("both"));
    let steady = "[belt]\nbelt_velocity = 2\n[axes]\ntemperature = { from = 100, to = 300, points = 9 }\n";
    let friction = "[friction]\nlaw = \"table\"\nmaterial = \"pad.csv\"\n";
    fs::write(path.join("m.toml"), format!("{friction}{steady}")).unwrap();
    does("modes m.toml -o modes", "");
    does("trace s.toml --at temperature=250,belt_velocity=2 -o trace", "");
    does("refine s.toml -o refined", "");
    let beyond = squealmap(path, &["trace", "s.toml", "--at", "temperature=350,belt_velocity=2"]);
    assert_eq!(beyond.code, Some(2));
    let said = unwrapped(&beyond.err);
    assert!(said.contains("`temperature` is 350 but material `pad.csv` covers 100 to 300 °C"), "{said}");
    let spec = Spec::read(&path.join("s.toml")).unwrap();
    let explorer = Explorer::new(spec).unwrap();
    let side = |key: &str, from: f64, to: f64| serde_json::json!({ "key": key, "from": from, "to": to, "points": 3 });
    let mut asked = serde_json::json!({ "ask": "region", "x": side("belt_velocity", 0.5, 5.0),
        "y": side("temperature", 100.0, 300.0), "response": false, "columns": ["growth_rate"] });
    let found = explorer.answer(&asked.to_string());
    assert!(found.is_ok(), "{:?}", found.err());
    asked["ask"] = serde_json::json!("file");
    let why = explorer.answer(&asked.to_string()).unwrap_err();
    assert!(why.contains("`material` of [friction] stands in a file of its own"), "{why}");
}
