//! A run that stops before its end: what is done is kept, bit by bit, and the rest says that it is not.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::colour::rgb;
use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{failed, map, record, span};
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Stopped;
use squealmap::engine::computed::Computed;
use squealmap::engine::error::Error;
use squealmap::engine::gpu::run::{ChunkResult, check};
use squealmap::engine::kernel::linear;
use squealmap::engine::kernel::places::{place, room};
use squealmap::engine::march::kernel::kernel_for;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::model::status::Status;
use squealmap::results::csv::map_csv;
use squealmap::results::figure::map::map_svg;
use squealmap::results::manifest::manifest_json;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

/// Instances of the sweep.
const TOTAL: usize = 300;

fn spec() -> Spec {
    let text = "[friction]\nmu_s = 0.4\n[axes]\nmu_d = { from = 0.1, to = 0.4, points = 20 }\n\
        belt_velocity = { from = 1, to = 8, points = 15 }\n\
        [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\ncheck = false\n";
    Spec::parse(text, "stopped.toml", ".".as_ref()).expect("a valid sweep")
}

/// Runs on `threads` threads and sets the cancel flag as soon as `after` instances are done.
fn cancelled(backend: Backend, after: usize, threads: usize) -> squealmap::sweep::error::Result<Map> {
    let (cancel, done) = (AtomicBool::new(after == 0), AtomicUsize::new(0));
    let options = Options { backend, cancel: Some(&cancel), ..Options::default() };
    let progress = |count| {
        if done.fetch_add(count, Ordering::Relaxed) + count >= after {
            cancel.store(true, Ordering::Relaxed);
        }
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| run::run(spec(), &options, &progress))
}

/// `status` and all other cells of every row.
fn rows(csv: &[u8]) -> Vec<(String, Vec<String>)> {
    let mut reader = csv::Reader::from_reader(csv);
    let row = |row: csv::StringRecord| {
        let mut cells: Vec<String> = row.iter().map(str::to_owned).collect();
        (cells.pop().expect("a status"), cells)
    };
    reader.records().map(|one| row(one.expect("an even row"))).collect()
}

fn manifest(map: &Map) -> serde_json::Value {
    serde_json::from_slice(&manifest_json(map).expect("a map to export")).expect("JSON")
}

#[test]
fn what_is_done_equals_a_full_run_and_the_rest_is_empty() {
    // Each other thread may have begun one more.
    stopped_and_full(Backend::Reference, [(1, 1), (60, 1), (60, 2), (TOTAL - 5, 3)], 1);
    // Each may have finished one more batch.
    stopped_and_full(Backend::Cpu, [(1, 1), (60, 1), (60, 2), (130, 3)], 75);
}

/// Runs that stop after some instances on some threads, which each finish `batch` at a time.
fn stopped_and_full(backend: Backend, cases: [(usize, usize); 4], batch: usize) {
    let full = cancelled(backend, usize::MAX, 2).expect("a full run");
    assert_eq!((full.computed(), &full.stopped), (TOTAL, &None));
    let expected = rows(&map_csv(&full).expect("a complete map"));
    for (after, threads) in cases {
        let part = cancelled(backend, after, threads).expect("a part");
        let done = part.computed();
        assert!((after..after + threads * batch).contains(&done), "{done} of {after} on {threads} threads");
        assert_eq!(part.stopped, Some(Stopped::Cancelled));
        let found = rows(&map_csv(&part).expect("a stopped map"));
        assert_eq!(found.len(), TOTAL);
        for (index, (record, whole)) in part.records.iter().zip(&full.records).enumerate() {
            let (status, cells) = &found[index];
            if record.status == Status::NotComputed {
                assert_eq!(*record, Record::NOT_COMPUTED);
                assert_eq!(status, "not_computed");
                assert_eq!(cells[..3], expected[index].1[..3], "the inputs are there");
                assert!(cells[3..].iter().all(String::is_empty), "{cells:?}");
            } else {
                assert_eq!(record, whole, "instance {index}");
                assert_eq!(found[index], expected[index]);
            }
        }
    }
}

#[test]
fn the_manifest_says_how_far_it_came_and_why() {
    let full = manifest(&cancelled(Backend::Reference, usize::MAX, 2).expect("a full run"));
    assert_eq!(full["complete"], true);
    assert_eq!(full["computation"]["computed"], TOTAL);
    assert!(full["computation"]["stopped"].is_null());
    assert!(full["counts"]["status"]["not_computed"].is_null());
    let part = cancelled(Backend::Reference, 40, 1).expect("a part");
    let json = manifest(&part);
    assert_eq!(json["complete"], false);
    let computation = &json["computation"];
    assert_eq!((&computation["instances"], &computation["computed"]), (&TOTAL.into(), &40.into()));
    assert_eq!(computation["stopped"], "cancelled");
    let rate = computation["instances_per_second"].as_f64().expect("a rate");
    assert!((rate * part.provenance.elapsed.as_secs_f64() - 40.0).abs() < 1e-9, "only what is done counts");
    assert_eq!(json["counts"]["status"]["not_computed"], TOTAL - 40);
    let kinds = json["counts"]["type"].as_object().expect("types");
    assert_eq!(kinds.values().filter_map(serde_json::Value::as_u64).sum::<u64>(), 40);
}

#[test]
fn a_run_cancelled_before_its_first_instance_is_an_error() {
    for backend in [Backend::Reference, Backend::Cpu] {
        assert!(matches!(
            cancelled(backend, 0, 2),
            Err(squealmap::sweep::error::Error::OfEngine(Error::Cancelled { done: 0, total: TOTAL }))
        ));
    }
}

#[test]
fn a_failed_device_leaves_what_it_did_before() {
    let good = record(Kind::Stable, Regime::Slip, true);
    let lost = || Error::DeviceLostAgain { why: "gone".to_owned(), done: 2, total: 5 };
    let part = Computed::new(vec![good.clone(), good.clone()], 5, Err(lost())).expect("a part");
    let rest = Record::NOT_COMPUTED;
    assert_eq!(part.records, [good.clone(), good, rest.clone(), rest.clone(), rest]);
    assert_eq!(part.stopped, Some(Stopped::Failed(lost().to_string())));
    let none = Computed::new(Vec::new(), 5, Err(lost()));
    assert!(matches!(none, Err(Error::DeviceLostAgain { .. })));
    let mut stopped = map(Grid::Axes(vec![span(Param::MuD, 0.0, 0.4, 5)]), |i, _| part.records[i].clone());
    stopped.stopped = part.stopped;
    assert_eq!(manifest(&stopped)["computation"]["stopped"], lost().to_string());
}

#[test]
fn a_result_in_doubt_leaves_nothing() {
    let good = record(Kind::Stable, Regime::Slip, true);
    let faults = [
        || Error::Unwritten { instance: 3 },
        || Error::Miscounted { kernel: "linear", found: 1, wanted: 2 },
        || Error::ShortBuffer { name: "state", found: 1, wanted: 2 },
        || Error::Endless { kernel: "linear", finished: 1, count: 2, dispatches: 4 },
    ];
    for fault in faults {
        let ended = Computed::new(vec![good.clone()], 5, Err(fault()));
        let found = ended.map(|part| part.records.len()).map_err(|why| why.to_string());
        assert_eq!(found, Err(fault().to_string()));
    }
}

#[test]
fn no_kernel_may_say_that_it_did_not_compute() {
    assert!(!Status::ALL.contains(&Status::NotComputed) && !Status::ALL.contains(&Status::Unwritten));
    assert_eq!(Status::IN_MAP[..7], Status::ALL);
    assert_eq!(Status::IN_MAP[7..], [Status::NotComputed]);
    let chunk = |code: u32| {
        let mut flags = vec![Status::Ok as u32; room(3)];
        flags[place([0, 1], 2)] = code;
        ChunkResult { state: vec![0.0_f32; room(3)], flags, cancelled: false }
    };
    assert!(check(&chunk(Status::Ok as u32), 3, [1, 1, 1]).is_ok());
    let said = check(&chunk(Status::NotComputed as u32), 3, [1, 1, 1]);
    assert!(matches!(said, Err(Error::Unwritten { instance: 2 })));
    for kernel in [&linear::KERNEL, kernel_for(1).expect("a kernel").0] {
        assert!(!kernel.source(Precision::F32, &[]).contains("NOT_COMPUTED"));
    }
}

#[test]
fn what_is_missing_without_a_reason_is_refused() {
    let with = |missing: Record, stopped: Option<Stopped>| {
        let good = record(Kind::Stable, Regime::Slip, true);
        let mut map = map(Grid::Axes(vec![span(Param::MuD, 0.0, 0.4, 5)]), |i, _| {
            if i == 3 { missing.clone() } else { good.clone() }
        });
        map.stopped = stopped;
        [map_csv(&map).map(drop), manifest_json(&map).map(drop), map_svg(&map).map(drop)]
    };
    for ended in with(Record::NOT_COMPUTED, Some(Stopped::Cancelled)) {
        assert!(ended.is_ok(), "{ended:?}");
    }
    let refused = [
        (Record::default(), None),
        (Record::default(), Some(Stopped::Cancelled)),
        (Record::NOT_COMPUTED, None),
    ];
    for (missing, stopped) in refused {
        for ended in with(missing, stopped) {
            assert_eq!(
                ended.expect_err("as the test has set it up").to_string(),
                "instance 3 was never computed; nothing was exported"
            );
        }
    }
}

#[test]
fn cells_that_were_not_computed_are_blank_and_named() {
    // Stable below, not computed above, one failed instance; a border only beside the failed one.
    let axes = vec![span(Param::MuS, 0.0, 0.6, 4), span(Param::MuD, 0.0, 0.6, 6)];
    let mut sweep = map(Grid::Axes(axes), |i, _| match (i / 6, i % 6) {
        (_, 3..) => Record::NOT_COMPUTED,
        (2, 1) => failed(Status::Painleve),
        _ => record(Kind::Stable, Regime::Equilibrium, true),
    });
    sweep.stopped = Some(Stopped::Cancelled);
    let svg = map_svg(&sweep).expect("a stopped map");
    let picture = draw(&svg, "stopped");
    for frame in frames(&svg) {
        let seen: Vec<[u8; 3]> = (0..900)
            .map(|k| (f64::from(k % 30) / 30.0, f64::from(k / 30) / 30.0))
            .map(|(right, up)| colour(&picture, frame, (0.05 + 0.9 * right, 0.55 + 0.4 * up)))
            .collect();
        assert!(seen.iter().all(|[r, g, b]| r == g && g == b && *r > 150), "white and light grey");
        assert!(seen.iter().filter(|pixel| **pixel == [255; 3]).count() > 600, "mostly white");
        assert!(seen.iter().any(|pixel| pixel[0] < 220), "hatched");
        let edge = (-10..10).map(|k| colour(&picture, frame, (0.1, 0.5 + 0.001 * f64::from(k))));
        assert!(edge.into_iter().all(|pixel| pixel[0] > 150), "no border where the run stopped");
        assert_eq!(colour(&picture, frame, (0.12, 0.2)), rgb("#F2F2EE"));
    }
    assert_eq!(svg.matches(">not computed (n = 12)<").count(), 2);
    assert_eq!(svg.matches(">no result: Painlevé (n = 1)<").count(), 2);
    assert!(svg.contains("24 instances, 12 of them computed"));
    sweep.stopped = None;
    sweep.records.fill(record(Kind::Stable, Regime::Equilibrium, true));
    let svg = map_svg(&sweep).expect("a complete map");
    assert!(!svg.contains("not computed") && !svg.contains("of them computed"));
}

#[test]
fn points_that_were_not_computed_are_blank() {
    let keys = vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::MuD)];
    let rows = (0..12).map(|i| [0.05 * f64::from(i), 0.3].map(Value::Number).to_vec()).collect();
    let mut sweep = map(Grid::Tuples { keys, rows }, |i, _| match i {
        0..4 => record(Kind::ModeCoupling, Regime::StickSlip, i > 1),
        4 => failed(Status::Painleve),
        _ => Record::NOT_COMPUTED,
    });
    sweep.stopped = Some(Stopped::Cancelled);
    let svg = map_svg(&sweep).expect("a stopped map");
    draw(&svg, "stopped_points");
    assert_eq!(svg.matches(r#"class="not_computed""#).count(), 2 * 7);
    assert_eq!(svg.matches(r#"class="failed""#).count(), 2);
    assert!(svg.contains(">not computed (n = 7)<"));
}

#[test]
fn a_stopped_paper_map() {
    use crate::synthetic::{axis, number, paper_like};
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 41),
        span(Param::MuD, 0.0, 0.6, 41),
        axis(Param::BeltVelocity, &[0.5, 1.0, 3.0, 4.9, 6.0]),
    ];
    // What two threads have done of a grid whose first axis varies slowest.
    let done = |i: usize| i % 4203 < 1800;
    let mut sweep = map(Grid::Axes(axes), |i, at| {
        if done(i) { paper_like(number(at[0]), number(at[1]), number(at[2])) } else { Record::NOT_COMPUTED }
    });
    sweep.stopped = Some(Stopped::Cancelled);
    draw(&map_svg(&sweep).expect("a stopped map"), "stopped_paper_map");
}
