//! Instances computed again while a sweep is computed: which, what is found, and that nothing else changes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::store::resume::with;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::{By, Check, Record};
use squealmap::sweep::accuracy::check::Counts;
use squealmap::sweep::accuracy::configuration::{Configuration, finer};
use squealmap::sweep::accuracy::errors::{is_settled_oscillation, worst};
use squealmap::sweep::accuracy::frontier::Frontier;
use squealmap::sweep::accuracy::sample::{records, subset};
use squealmap::sweep::checks::Checks;
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

/// 2400 instances of all types, many of them near a border.
const SWEEP: &str = "[friction]\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 20 }\n\
    mu_d = { from = 0.0, to = 0.6, points = 20 }\nbelt_velocity = { values = [0.5, 1.0, 2.0, 3.0, 4.0, 6.0] }\n\
    [start]\nstart_velocity = 0.3\n[response]\nsettle = \"120 periods\"\nmeasure = \"40 periods\"\n";

fn spec() -> Spec {
    Spec::parse(SWEEP, "s.toml", ".".as_ref()).unwrap()
}

fn run(spec: Spec, backend: Backend, precision: Precision) -> Map {
    let options = Options { backend, precision: Some(precision), ..Options::default() };
    run::run(spec, &options, &|_| {}).unwrap()
}

/// The coarsest run in f32, whose errors are far above those of its judges.
fn coarse() -> (Map, Map) {
    let spec = Spec { steps_per_period: 3, ..spec() };
    let mut unchecked = spec.clone();
    unchecked.analysis.checked = false;
    (run(spec, Backend::Cpu, Precision::F32), run(unchecked, Backend::Cpu, Precision::F32))
}

#[test]
fn checks_find_the_errors_that_an_independent_run_finds() {
    let (map, unchecked) = coarse();
    let checked: Vec<usize> = (0..2400).filter(|index| map.records[*index].check.is_some()).collect();
    // By the shares: 3 % of the time for what costs some 4 to 6 times as much.
    assert!((8..60).contains(&checked.len()), "{}", checked.len());
    let truth =
        records(&Configuration::reference(24), &subset(&map.spec, &checked), &Options::default()).unwrap();
    let mut errors = 0;
    for (index, truth) in checked.iter().zip(&truth) {
        let (record, plain) = (&map.records[*index], &unchecked.records[*index]);
        let check = record.check.unwrap();
        let label = |record: &Record| (record.status, record.kind, record.regime);
        assert_eq!(check.changed, label(plain) != label(truth), "instance {index}");
        if let Some(error) = check.error {
            let wanted = worst(plain, truth);
            assert!((error / wanted - 1.0).abs() < 0.05, "instance {index}: {error:e} instead of {wanted:e}");
            assert!(is_settled_oscillation(truth));
            errors += 1;
        }
        if check.taken {
            // The finer result: a thousandth of the error of the coarse one.
            assert!(!is_settled_oscillation(truth) || worst(record, truth) < 1e-6, "instance {index}");
        }
    }
    assert!(errors >= 5, "{errors}");
    // All others are what they are without any check, and so are those that were only looked at.
    for (index, (record, plain)) in map.records.iter().zip(&unchecked.records).enumerate() {
        if record.check.is_none_or(|check| !check.taken) {
            assert!(Record { check: None, ..record.clone() } == *plain, "instance {index}");
        }
    }
}

#[test]
fn what_is_near_a_border_takes_the_finer_result() {
    // A single mass that decays by c/2m = 0.001/s: over 20.1 s the halves of the window differ by the factor 0.99 that
    // tells equilibrium from slip, whatever the kick.
    let text = "[model]\ntheta = 0.0\nm1 = 0.9\nm2 = 0.1\nk1 = 1e4\nc1 = 0.002\n[friction]\nlaw = \"constant\"\n\
        mu_s = 0.2\nmu_d = 0.2\n[axes]\nbelt_velocity = { from = 1.0, to = 2.0, points = 10 }\n\
        start_velocity = { from = 0.05, to = 0.2, points = 30 }\n\
        [response]\nsettle = \"0 s\"\nmeasure = \"20.1 s\"\nsteps_per_period = 4\n";
    let map = run(Spec::parse(text, "s.toml", ".".as_ref()).unwrap(), Backend::Cpu, Precision::F32);
    let drawn: Vec<usize> = (0..300).filter(|index| map.records[*index].check.is_some()).collect();
    let taken: Vec<usize> =
        drawn.iter().copied().filter(|index| map.records[*index].check.unwrap().taken).collect();
    assert!(!taken.is_empty() && taken == drawn, "{taken:?} of {drawn:?}");
    let judge = finer(&Configuration::cpu(Precision::F32, 4));
    let finer = records(&judge, &subset(&map.spec, &taken), &Options::default()).unwrap();
    for (index, finer) in taken.iter().zip(&finer) {
        assert!(Record { check: None, ..map.records[*index].clone() } == *finer, "instance {index}");
    }
    // Far from it: over 2 s the halves differ by 0.1 %, over 60 s by 3 %.
    for measure in ["2 s", "60 s"] {
        let text = text.replace("20.1 s", measure);
        let map = run(Spec::parse(&text, "s.toml", ".".as_ref()).unwrap(), Backend::Cpu, Precision::F32);
        let checks: Vec<Check> = map.records.iter().filter_map(|record| record.check).collect();
        assert!(!checks.is_empty() && checks.iter().all(|check| !check.taken), "{measure}: {checks:?}");
    }
}

#[test]
fn the_time_of_checks_is_bounded_by_their_number() {
    let shipped = Frontier::shipped();
    let total = 1_000_000;
    for precision in [Precision::F32, Precision::F64] {
        for steps in [3, 5, 8, 12, 24] {
            let engine = Configuration::cpu(precision, steps);
            let counts = Counts::new(&engine, false, total);
            let time = |count: usize, of: &Configuration| count as f64 / shipped.cpu_rate(of);
            let checks =
                time(counts.fine, &finer(&engine)) + time(counts.reference, &Configuration::reference(12));
            let share = checks / time(total, &engine);
            assert!(share > 0.03 && share < 0.05, "{engine}: {share}");
            assert!(counts.fine > 1000 && counts.reference > 50, "{engine}: {counts:?}");
        }
    }
    let reference = Counts::new(&Configuration::reference(12), false, total);
    assert_eq!((reference.fine, reference.reference), (0, 0));
}

#[test]
fn the_reference_checks_nothing_and_is_the_judge() {
    let text = SWEEP.replace("points = 20", "points = 3");
    let map = run(Spec::parse(&text, "s.toml", ".".as_ref()).unwrap(), Backend::Reference, Precision::F64);
    assert!(map.records.iter().all(|record| record.check.is_none()));
}

#[test]
fn what_was_found_is_counted() {
    let mut checks = Checks::default();
    let check = |by, taken, changed, error| Record {
        check: Some(Check { by, taken, changed, error }),
        ..Record::default()
    };
    for record in [
        Record::default(),
        check(By::Fine, false, false, Some(1e-4)),
        check(By::Fine, true, true, Some(1e-3)),
        check(By::Fine, true, false, None),
        check(By::Reference, false, true, Some(2e-3)),
    ] {
        checks.add(&record);
    }
    let json = checks.to_json();
    assert_eq!(json[0]["checked"], 3);
    assert_eq!(json[0]["settled_oscillations"], 2);
    assert_eq!(json[0]["labels_changed"], 1);
    assert_eq!((&json[0]["near_a_border"], &json[0]["near_a_border_changed"]), (&2.into(), &1.into()));
    let largest = json[0]["error"]["largest"].as_f64().unwrap();
    assert!((1e-3..1.13e-3).contains(&largest), "{largest:e}");
    assert_eq!((&json[1]["checked"], &json[1]["labels_changed_share"]), (&1.into(), &1.0.into()));
    let text = checks.summary(false);
    assert!(
        text.contains("3 instances, 2 settled oscillations") && text.contains("of 2 near a border"),
        "{text}"
    );
}

#[test]
fn a_run_says_what_its_checks_found_unless_told_not_to() {
    let directory = with(SWEEP);
    let run = |more: &[&str], code| {
        let ended = squealmap(directory.path(), &[&["run", "s.toml", "--backend", "cpu"], more].concat());
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        let read = |name: &str| std::fs::read(directory.path().join("out/s").join(name)).unwrap();
        let manifest: serde_json::Value = serde_json::from_slice(&read("manifest.json")).unwrap();
        (ended.out, manifest, String::from_utf8(read("map.csv")).unwrap())
    };
    let (out, manifest, table) = run(&[], 0);
    assert!(out.contains("checked by the CPU engine in f64: "), "{out}");
    let found = manifest["checks"][0]["checked"].as_u64().unwrap();
    let at = table.lines().next().unwrap().split(',').position(|name| name == "checked").unwrap();
    let marked =
        table.lines().skip(1).filter(|row| matches!(row.split(',').nth(at), Some("1" | "2"))).count();
    assert!(found > 0 && marked as u64 == found, "{found} {marked}");
    // Checks are part of the method: another id.
    let (out, without, table) = run(&["--no-check"], 0);
    assert!(!out.contains("checked by") && without.get("checks").is_none(), "{out}");
    assert!(!table.lines().next().unwrap().contains("checked"));
    assert_ne!(manifest["sweep_id"], without["sweep_id"]);
    std::fs::write(directory.path().join("s.toml"), SWEEP.to_owned() + "check = false\n").unwrap();
    let (_, by_key, _) = run(&[], 0);
    assert_eq!(by_key["sweep_id"], without["sweep_id"]);
}
