//! Speed against error: samples, errors, the frontier and what is chosen from it, by hand-made numbers.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::{squealmap, unwrapped};
use crate::store::resume::with;
use squealmap::engine::backend::Backend;
use squealmap::engine::method::Method;
use squealmap::engine::options::Options;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::study::tradeoff::report::fastest;
use squealmap::sweep::accuracy::configuration::{Configuration, scenes};
use squealmap::sweep::accuracy::errors::{Judge, quantile, relative};
use squealmap::sweep::accuracy::frontier::{Frontier, MARGIN, mark};
use squealmap::sweep::accuracy::level::Level;
use squealmap::sweep::accuracy::row::{Rate, Row, from_csv, to_csv};
use squealmap::sweep::accuracy::sample::{Sample, subset};
use squealmap::sweep::spec::Spec;

/// A settled oscillation whose four quantities are `value`, the halves of its window 2 % of it apart.
fn oscillation(value: f64) -> Record {
    let some = Some(value);
    let outcome = Outcome {
        status: Status::Ok,
        x2_std: some,
        ax_rms: some,
        ay_rms: some,
        response_frequency: some,
        stick: Some(0.25),
        x2_std_halves: [0.98 * value, value],
        ay_rms_halves: [value, value],
        ..Outcome::default()
    };
    Record {
        status: Status::Ok,
        kind: Some(InstabilityType::NegativeSlope),
        regime: Some(Regime::StickSlip),
        settled: Some(true),
        outcome: Some(Box::new(outcome)),
        ..Record::default()
    }
}

/// The truth of 100 instances of value 1, each weighing the same.
fn judge() -> Judge {
    Judge::new(vec![oscillation(1.0); 100], vec![3.0; 100])
}

/// The records of an engine whose instance `k` is off by `k` thousandths.
fn found() -> Vec<Record> {
    (0..100).map(|k| oscillation(1.0 + 1e-3 * f64::from(k))).collect()
}

#[track_caller]
fn about(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-9, "{found:e} instead of {wanted:e}");
}

#[test]
fn errors_are_the_planted_ones() {
    // Of 0, 1, …, 99 thousandths half are at most 49, 95 % at most 94, 99 % at most 98.
    let errors = judge().errors(&found());
    for quantiles in errors.quantities.iter().chain([&errors.worst]) {
        for (found, wanted) in quantiles.iter().zip([0.049, 0.094, 0.098]) {
            about(*found, wanted);
        }
    }
    about(judge().scatter()[0], 0.02);
    about(errors.beyond_scatter, 0.074);
    assert_eq!((errors.types, errors.regimes, errors.statuses), (0.0, 0.0, 0.0));
    let exact = judge().errors(judge().truth());
    assert_eq!((exact.worst, exact.stick), ([0.0; 3], [0.0; 3]));
}

#[test]
fn every_planted_fault_is_seen() {
    type Fault = fn(&mut Record);
    let with = |share: usize, fault: Fault| {
        let mut records = judge().truth().to_vec();
        records.iter_mut().take(share).for_each(fault);
        judge().errors(&records)
    };
    let nan = with(10, |record| record.outcome.as_mut().unwrap().ax_rms = Some(f64::NAN));
    assert!(nan.worst[1].is_infinite() && nan.quantities[1][1].is_infinite(), "{nan:?}");
    let none = with(10, |record| record.outcome.as_mut().unwrap().response_frequency = None);
    assert!(none.worst[1].is_infinite() && none.quantities[3][1].is_infinite(), "{none:?}");
    let lost = with(10, |record| *record = Record::default());
    assert!(lost.worst[1].is_infinite() && lost.stick[1].is_infinite(), "{lost:?}");
    about(lost.statuses, 0.1);
    about(lost.types, 0.1);
    about(with(7, |record| record.regime = Some(Regime::Slip)).regimes, 0.07);
    about(with(7, |record| record.kind = None).types, 0.07);
    about(with(60, |record| record.outcome.as_mut().unwrap().stick = Some(0.2)).stick[0], 0.05);
    // Unwritten and failed results are no numbers, whatever stands in them.
    let failed = with(10, |record| record.status = Status::EventLimit);
    assert!(failed.worst[1].is_infinite());
}

#[test]
fn numbers_are_compared_only_where_the_truth_is_a_settled_oscillation() {
    let mut truth = vec![oscillation(1.0); 4];
    truth[1].settled = Some(false);
    truth[2].regime = Some(Regime::Equilibrium);
    truth[3].status = Status::EventLimit;
    truth[3].regime = None;
    let judge = Judge::new(truth.clone(), vec![1.0; 4]);
    let records: Vec<Record> = [1.01, 5.0, 5.0, 5.0].map(oscillation).to_vec();
    about(judge.errors(&records).worst[2], 0.01);
    about(judge.share(squealmap::sweep::accuracy::errors::is_settled_oscillation), 0.25);
    about(judge.errors(&records).regimes, 0.5);
}

#[test]
fn quantiles_count_by_weight() {
    let values = vec![(3.0, 1.0), (1.0, 98.0), (2.0, 1.0)];
    for (share, wanted) in [(0.5, 1.0), (0.98, 1.0), (0.985, 2.0), (0.999, 3.0)] {
        about(quantile(values.clone(), share), wanted);
    }
    assert!(quantile(Vec::new(), 0.5).is_nan());
    about(relative(Some(0.0), Some(0.0)), 0.0);
    assert!(relative(Some(1.0), Some(0.0)).is_infinite());
    about(relative(Some(-1.0), Some(1.0)), 2.0);
}

/// A row of this speed and error.
fn row(scene: &str, configuration: &Configuration, per_second: f64, error: f64) -> Row {
    let mut row = Row::new(
        scene,
        configuration,
        Rate { per_cpu_second: Some(per_second), per_second },
        &judge().errors(judge().truth()),
    );
    row.worst_p95 = error;
    row
}

/// Two scenes; in the second the fast one is worse.
fn rows() -> Vec<Row> {
    let [fast, middle, slow] = [3, 6, 12].map(|steps| Configuration::cpu(Precision::F32, steps));
    vec![
        row("pieces, fixed time", &fast, 900.0, 1e-3),
        row("pieces, fixed time", &middle, 600.0, 1e-5),
        row("pieces, fixed time", &Configuration::cpu(Precision::F64, 3), 500.0, 1e-3),
        row("pieces, fixed time", &slow, 300.0, 1e-6),
        row("rational, fixed time", &fast, 900.0, 4e-2),
        row("rational, fixed time", &slow, 300.0, 2e-6),
    ]
}

/// A sweep of one instance under a law.
fn law(law: &str) -> Spec {
    let keys = match law {
        "rational" => "mu_s = 0.3\ndecay = 0.2",
        "exponential" => "mu_s = 0.3\nmu_d = 0.2\nstribeck_velocity = 1",
        _ => "mu_s = 0.3\nmu_d = 0.2",
    };
    let text = format!("[friction]\nlaw = \"{law}\"\n{keys}\n[belt]\nbelt_velocity = 1\n");
    Spec::parse(&text, "s.toml", ".".as_ref()).unwrap()
}

#[test]
fn the_frontier_is_what_nothing_beats() {
    let mut rows = rows();
    mark(&mut rows);
    let marks: Vec<bool> = rows.iter().map(|row| row.frontier).collect();
    assert_eq!(marks, [true, true, false, true, true, true]);
    rows[1].worst_p95 = f64::INFINITY;
    mark(&mut rows);
    assert!(!rows[1].frontier);
}

#[test]
fn the_fastest_that_keeps_the_bound_is_chosen() {
    let frontier = Frontier::measured(rows(), "here".to_owned());
    let any = |_: &Configuration| true;
    let steps = |level, spec: &Spec| {
        frontier.choose(level, spec, &any).map(|choice| choice.configuration.steps_per_period)
    };
    let (pieces, rational) = (law("bilinear"), law("rational"));
    assert_eq!(steps(Level::Within(MARGIN * 1e-3), &pieces).unwrap(), 3);
    assert_eq!(steps(Level::Within(1e-3), &pieces).unwrap(), 6);
    assert_eq!(steps(Level::Within(1e-2), &rational).unwrap(), 12);
    // A scene that was not measured: the worst of those that were.
    assert_eq!(steps(Level::Within(1e-2), &law("exponential")).unwrap(), 12);
    let why = steps(Level::Within(1e-7), &pieces).unwrap_err().to_string();
    assert!(why.contains("keeps a relative error of 1e-7: the best keeps 2.0e-6"), "{why}");
    let only = |one: &Configuration| one.precision == Precision::F64;
    let choice = frontier.choose(Level::Within(1e-2), &pieces, &only).unwrap();
    assert_eq!(choice.configuration, Configuration::cpu(Precision::F64, 3));
    let reference = frontier.choose(Level::Reference, &pieces, &any).unwrap();
    assert_eq!(reference.configuration.backend, Backend::Reference);
}

#[test]
fn a_method_to_compare_with_is_measured_and_never_chosen() {
    for method in [Method::LocatedRk4, Method::FixedStep] {
        let compared = Configuration::scalar(method, 12);
        let mut with = rows();
        // Were it allowed, nothing would beat it.
        with.push(row("pieces, fixed time", &compared, 9000.0, 1e-9));
        with.push(row("rational, fixed time", &compared, 9000.0, 1e-9));
        assert_eq!(from_csv(&to_csv(&with).unwrap()).unwrap(), with);
        assert_eq!(with[6].configuration(), Some(compared));
        mark(&mut with);
        let mut without = rows();
        mark(&mut without);
        let marks = |rows: &[Row]| rows.iter().map(|row| row.frontier).collect::<Vec<_>>();
        assert_eq!(marks(&with), [marks(&without), vec![false; 2]].concat());
        let frontier = Frontier::measured(with.clone(), "here".to_owned());
        let choice = frontier.choose(Level::Within(1e-3), &law("bilinear"), &|_| true).unwrap();
        assert_eq!(choice.configuration, Configuration::cpu(Precision::F32, 6));
        assert!(frontier.choose(Level::Within(1e-7), &law("bilinear"), &|_| true).is_err());
        assert_eq!(fastest(&with, 1e-3), Some(&with[1]));
    }
}

#[test]
fn with_a_gpu_wall_time_counts_and_without_it_that_of_a_processor() {
    let [few, many] = [4, 6].map(|steps| Configuration::cpu(Precision::F32, steps));
    let gpu = Configuration { backend: Backend::Gpu, adapter: Some("GPU 7".to_owned()), ..few.clone() };
    let mut rows = [(&few, 900.0), (&many, 800.0), (&gpu, 700.0)]
        .map(|(one, per_second)| row("pieces, fixed time", one, per_second, 1e-5));
    // By wall time the CPU is busy, and a GPU is faster than either.
    rows[0].per_second = 300.0;
    rows[1].per_second = 400.0;
    rows[2].per_cpu_second = None;
    let frontier = Frontier::measured(rows.to_vec(), "here".to_owned());
    let chosen = |allowed: &dyn Fn(&Configuration) -> bool| {
        frontier.choose(Level::Within(1e-3), &law("bilinear"), allowed).unwrap().configuration
    };
    assert_eq!(chosen(&|_| true), gpu);
    // A GPU that is not there does not decide by what the others are measured.
    assert_eq!(chosen(&|one| one.backend == Backend::Cpu), few);
}

#[test]
fn tables_are_read_as_they_were_written_and_others_are_not() {
    let mut rows = rows();
    rows[0].worst_p99 = f64::INFINITY;
    rows[1].per_cpu_second = None;
    let bytes = to_csv(&rows).unwrap();
    assert_eq!(from_csv(&bytes).unwrap(), rows);
    let text = String::from_utf8(bytes).unwrap();
    for (from, to) in [
        ("cpu", "tpu"),
        ("f32", "f16"),
        (",900.0,", ",-1,"),
        ("worst_p95", "worst"),
        (",600.0,", ",600.0,1,"),
    ] {
        let broken = text.replacen(from, to, 1);
        assert!(broken != text && from_csv(broken.as_bytes()).is_err(), "{from} → {to}");
    }
}

#[test]
fn the_shipped_table_serves_every_scene_and_level() {
    let shipped = Frontier::shipped();
    for name in ["bilinear", "exponential", "rational"] {
        for settle_limit in [None, Some(squealmap::sweep::spec::SETTLE_LIMIT)] {
            let spec = Spec { settle_limit, ..law(name) };
            assert!(shipped.covers(&spec), "{:?}", scenes(&spec));
            for level in ["draft", "standard", "paper", "reference", "2e-5"] {
                let level = Level::parse(level).unwrap();
                let choice = shipped.choose(level, &spec, &|_| true).unwrap();
                assert!(choice.configuration.steps_per_period >= 3, "{choice:?}");
            }
        }
    }
}

#[test]
fn levels_are_named_or_numbers() {
    assert_eq!(Level::parse("standard"), Ok(Level::Within(1e-3)));
    assert_eq!(Level::parse("2e-4"), Ok(Level::Within(2e-4)));
    assert_eq!(Level::parse("standard").unwrap().to_string(), "standard (1e-3)");
    for bad in ["", "fine", "0", "-1e-3", "0.2", "nan", "inf"] {
        assert!(Level::parse(bad).is_err(), "{bad}");
    }
}

const MAP: &str = "[friction]\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 15 }\n\
    mu_d = { from = 0.0, to = 0.6, points = 15 }\nbelt_velocity = { values = [1.0, 3.0, 6.0] }\n\
    [response]\nsettle = \"40 periods\"\nmeasure = \"20 periods\"\n";

#[test]
fn a_sample_has_every_type_and_stands_for_the_whole_sweep() {
    let spec = Spec::parse(MAP, "s.toml", ".".as_ref()).unwrap();
    let sample = Sample::draw(&spec, 60, 1, &Options::default()).unwrap();
    assert!((50..=90).contains(&sample.indices.len()), "{}", sample.indices.len());
    assert!(sample.indices.windows(2).all(|pair| pair[0] < pair[1]));
    assert!((sample.weights.iter().sum::<f64>() - 675.0).abs() < 1e-6);
    assert!(sample.weights.iter().all(|weight| *weight >= 1.0));
    // Every candidate is an instance here: what any instance is, one of the sample is.
    let kinds: Vec<_> =
        (0..675).map(|index| squealmap::model::linear::analyse(&spec.instance(index)).0).collect();
    for kind in &kinds {
        assert!(sample.indices.iter().any(|index| kinds[*index] == *kind), "{kind:?}");
    }
    // By weight the sample has as much of a type as the sweep has.
    for kind in InstabilityType::ALL {
        let of_sweep = kinds.iter().filter(|one| **one == Some(kind)).count() as f64;
        let taken =
            sample.indices.iter().zip(&sample.weights).filter(|(index, _)| kinds[**index] == Some(kind));
        assert!((taken.map(|(_, weight)| weight).sum::<f64>() - of_sweep).abs() < 1e-6, "{kind:?}");
    }
    let again = Sample::draw(&spec, 60, 1, &Options::default()).unwrap();
    assert_eq!(again.indices, sample.indices);
    assert_ne!(Sample::draw(&spec, 60, 2, &Options::default()).unwrap().indices, sample.indices);
    // The sweep of the sample has its instances.
    let part = subset(&spec, &sample.indices);
    for (at, index) in sample.indices.iter().enumerate() {
        assert_eq!(part.instance(at).params, spec.instance(*index).params);
    }
}

#[test]
fn tradeoff_writes_its_files_and_keeps_its_table() {
    // Steep falls of friction, whose oscillations settle soon.
    let directory = with(
        "[friction]\n[axes]\nmu_s = { from = 0.4, to = 0.6, points = 8 }\nmu_d = { from = 0.0, to = 0.1, points = 4 }\n\
         belt_velocity = { values = [1.0, 2.0] }\n[start]\nstart_velocity = 0.3\n[response]\n\
         settle = \"200 periods\"\nmeasure = \"20 periods\"\n",
    );
    let run = |sample: &str, table: &str| {
        let arguments =
            ["tradeoff", "s.toml", "--sample", sample, "-o", "t", "--store", table, "--report", "report.md"];
        squealmap(directory.path(), &arguments)
    };
    let ended = run("40", "table.csv");
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("standard") && ended.out.contains("settled oscillations"), "{}", ended.out);
    let read = |name: &str| std::fs::read(directory.path().join(name)).unwrap();
    let rows = from_csv(&read("t/tradeoff.csv")).unwrap();
    assert!(rows.len() >= 42 && rows.iter().any(|row| row.frontier));
    let error = |backend: &str, steps: u32| {
        let found = rows.iter().find(|row| row.backend == backend && row.steps_per_period == steps);
        found.expect("a row").worst_p95
    };
    // Order 4 against order 1: with many steps the difference is a large one.
    assert!(error("located RK4", 160) < 1e-4, "{}", error("located RK4", 160));
    assert!(error("fixed step", 160) > 10.0 * error("located RK4", 160));
    assert!(error("located RK4", 20) > 10.0 * error("located RK4", 80));
    assert_eq!(from_csv(&read("table.csv")).unwrap(), rows);
    // The report names what makes it again.
    let report = String::from_utf8(read("report.md")).unwrap();
    let command = "squealmap tradeoff s.toml --output t --sample 40 --report report.md --store table.csv";
    assert!(report.contains(&format!("\n    {command}\n")), "{report}");
    assert!(directory.path().join("report/s.png").is_file());
    let json: serde_json::Value = serde_json::from_slice(&read("t/tradeoff.json")).unwrap();
    assert_eq!(json["scene"], "pieces, fixed time");
    assert_eq!(json["configurations"].as_array().map(Vec::len), Some(rows.len()));
    assert!(json["truth"]["difference"]["largest"].as_f64().unwrap() < 1e-6);
    let svg = String::from_utf8(read("t/tradeoff.svg")).unwrap();
    assert!(svg.contains("Instances per second") && svg.contains("<circle"));
    assert!(svg.contains("located RK4 f64, to compare") && svg.contains("fixed step f64, to compare"));
    // The rows of a scene are replaced, those of others stay.
    let mut table = rows.clone();
    table.retain(|row| row.backend == "reference");
    table[0].scene = "rational, fixed time".to_owned();
    std::fs::write(directory.path().join("table.csv"), to_csv(&table).unwrap()).unwrap();
    assert_eq!(run("40", "table.csv").code, Some(0));
    assert_eq!(from_csv(&read("table.csv")).unwrap().len(), rows.len() + 1);
    // One that cannot be read is not replaced, and that is told before anything is measured.
    let damaged = [&to_csv(&table).unwrap()[..], b"a line too many\n"].concat();
    std::fs::write(directory.path().join("damaged.csv"), &damaged).unwrap();
    std::fs::remove_dir_all(directory.path().join("t")).unwrap();
    let ended = run("40", "damaged.csv");
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(unwrapped(&ended.err).contains("damaged.csv`: "), "{}", ended.err);
    assert!(read("damaged.csv") == damaged && !directory.path().join("t").exists());
    // What too few were judged for is for the eye alone.
    std::fs::write(directory.path().join("s.toml"), MAP).unwrap();
    let ended = run("16", "few.csv");
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("settled oscillation(s), too few for a 95th percentile"), "{}", ended.err);
    assert!(!directory.path().join("few.csv").exists());
}

#[test]
fn tradeoff_refuses_what_it_cannot_judge() {
    let directory =
        with("analysis = [\"linear\"]\n[friction]\nmu_s = 0.3\nmu_d = 0.2\n[belt]\nbelt_velocity = 1\n");
    let ended = squealmap(directory.path(), &["tradeoff", "s.toml", "-o", "t", "--no-store"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.contains("`analysis` lacks \"response\""), "{}", ended.err);
    assert!(!directory.path().join("t").exists());
    // A table that cannot be written is told before anything is measured.
    std::fs::write(directory.path().join("m.toml"), MAP).unwrap();
    let ended =
        squealmap(directory.path(), &["tradeoff", "m.toml", "-o", "t", "--store", "m.toml/table.csv"]);
    assert_ne!(ended.code, Some(0));
    assert!(ended.err.contains("m.toml/table.csv"), "{}", ended.err);
    assert!(!directory.path().join("t").exists());
    let ended = squealmap(directory.path(), &["tradeoff", "s.toml", "./s.toml", "-o", "t", "--no-store"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.contains("are named `s`"), "{}", ended.err);
}

#[test]
fn an_accuracy_is_chosen_said_and_kept() {
    let directory = with(MAP);
    let run = |more: &[&str]| {
        let ended = squealmap(directory.path(), &[&["run", "s.toml", "--backend", "cpu"], more].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let manifest = std::fs::read(directory.path().join("out/s/manifest.json")).unwrap();
        (ended, serde_json::from_slice::<serde_json::Value>(&manifest).unwrap())
    };
    let (ended, manifest) = run(&["--accuracy", "standard"]);
    let chosen = &manifest["computation"]["accuracy"];
    assert_eq!(chosen["asked"], "standard (1e-3)");
    assert!(ended.err.contains(chosen["configuration"].as_str().unwrap()), "{}", ended.err);
    assert!(ended.err.contains(chosen["why"].as_str().unwrap()), "{}", ended.err);
    assert_eq!(chosen["bound"], 1e-3);
    let tried = chosen["trial"]["instances"].as_u64().unwrap();
    assert!(
        tried >= 192 && ended.err.contains(&format!("tried on {tried} instances of this sweep")),
        "{}",
        ended.err
    );
    let steps = manifest["spec"]["response"]["steps_per_period"].as_u64().unwrap();
    assert!(chosen["configuration"].as_str().unwrap().ends_with(&format!(", {steps} steps per period")));
    assert!(steps < 12, "{steps}");
    // Without it nothing is said and nothing changes.
    let (ended, manifest) = run(&[]);
    assert_eq!(manifest["computation"]["accuracy"], serde_json::Value::Null);
    assert_eq!(manifest["spec"]["response"]["steps_per_period"], 12);
    assert!(!ended.err.contains("accuracy"), "{}", ended.err);
}

#[test]
fn an_accuracy_needs_a_response_and_a_measurement() {
    let linear = "analysis = [\"linear\"]\n[friction]\nmu_s = 0.3\nmu_d = 0.2\n[belt]\nbelt_velocity = 1\n";
    let directory = with(linear);
    let ended = squealmap(directory.path(), &["run", "s.toml", "--accuracy", "draft"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(
        ended.err.contains("--accuracy has nothing to choose: this sweep asks for no response"),
        "{}",
        ended.err
    );
    // No GPU stands in the table that is shipped.
    let directory = with(MAP);
    let ended = squealmap(directory.path(), &["run", "s.toml", "--accuracy", "draft", "--backend", "gpu"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("there are none of the engine asked for on scenes such as"), "{}", ended.err);
}

#[test]
fn an_accuracy_beside_what_it_chooses_is_refused() {
    let steps = MAP.replace("measure", "steps_per_period = 5\nmeasure");
    for (sweep, more, message) in [
        (
            steps.as_str(),
            &[][..],
            "`steps_per_period` in [response] stands beside --accuracy standard (1e-3), which chooses it",
        ),
        (
            MAP,
            &["--precision", "f32"],
            "--precision f32 stands beside --accuracy standard (1e-3), which chooses it",
        ),
        (
            MAP,
            &["--accuracy", "reference", "--backend", "cpu"],
            "--backend cpu stands beside --accuracy reference",
        ),
        (MAP, &["--accuracy", "1e-14"], "keeps a relative error of 1e-14: the best keeps"),
        (MAP, &["--accuracy", "fine"], "must be draft (1e-2), standard (1e-3)"),
    ] {
        let directory = with(sweep);
        let default = ["--accuracy", "standard"];
        let accuracy: &[&str] = if more.contains(&"--accuracy") { &[] } else { &default };
        let ended = squealmap(directory.path(), &[&["run", "s.toml"], accuracy, more].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains(message), "{}", ended.err);
        assert!(!directory.path().join("out").exists());
    }
}
