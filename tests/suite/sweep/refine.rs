//! Lines of a large map from few of its instances: against the whole map.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::sweep::accuracy::sample::subset;
use squealmap::sweep::error::Error;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::label::Label;
use squealmap::sweep::refine::{Refined, refine};
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;
use squealmap::sweep::spec::refine::Settings;

const SETTINGS: Settings = Settings { coarse: 16, sample: 0, seed: 1 };

/// Two planes of `columns` × `rows` points.
fn grid(columns: u32, rows: u32) -> Grid {
    let axis = |param, count: u32| {
        let values = (0..count).map(|i| Value::Number(f64::from(i))).collect();
        Axis { key: AxisKey::Param(param), values, log: false }
    };
    let axes = [(Param::MuS, columns), (Param::BeltVelocity, 2), (Param::MuD, rows)];
    Grid::Axes(axes.into_iter().map(|(param, count)| axis(param, count)).collect())
}

/// Refines a map whose types come from a function of the coordinates `μ_s, μ_d, V`; the labels that differ from it.
fn drawn(grid: &Grid, settings: Settings, inside: impl Fn([f64; 3]) -> bool) -> (Refined, usize) {
    let label = |index: usize| {
        let number = |value: &&Value| if let Value::Number(x) = value { *x } else { f64::NAN };
        let at: Vec<f64> = grid.coordinates(index).iter().map(number).collect();
        let kind = if inside([at[0], at[2], at[1]]) {
            InstabilityType::ModeCoupling
        } else {
            InstabilityType::Stable
        };
        Record { status: Status::Ok, kind: Some(kind), ..Record::default() }
    };
    let mut computed = 0;
    let refined = refine::<Error>(grid, settings, &mut |instances| {
        assert!(instances.windows(2).all(|pair| pair[0] < pair[1]), "each once, in the order of the grid");
        computed += instances.len();
        Ok(instances.iter().map(|index| Label::from(&label(*index))).collect())
    })
    .unwrap();
    assert_eq!(refined.computed, computed);
    assert_eq!(refined.labels.len(), grid.len());
    let wrong = (0..grid.len()).filter(|index| refined.labels[*index] != Label::from(&label(*index))).count();
    (refined, wrong)
}

#[test]
fn lines_are_followed_wherever_they_go() {
    // Sides that are no power of two; a circle cut by the border, another one in the second plane; a wedge with a tip.
    for (columns, rows) in [(257, 257), (200, 131), (259, 100), (3, 300), (5, 4)] {
        let grid = grid(columns, rows);
        let (w, h) = (f64::from(columns), f64::from(rows));
        let circle = |[x, y, v]: [f64; 3]| {
            let (cx, cy, r) = if v > 0.0 { (0.2 * w, 0.9 * h, 0.5) } else { (0.5 * w, 0.4 * h, 0.35) };
            ((x - cx) / w).powi(2) + ((y - cy) / h).powi(2) < r * r
        };
        let (refined, wrong) = drawn(&grid, SETTINGS, circle);
        assert_eq!(wrong, 0, "circle on {columns} x {rows}");
        if columns > 256 && rows > 256 {
            assert!(refined.computed * 12 < grid.len(), "{} of {}", refined.computed, grid.len());
        }
        let wedge = |[x, y, _]: [f64; 3]| (y / h - 0.5).abs() < 0.3 * (x / w - 0.37);
        // Behind its tip the wedge is thinner than a coarse cell, and is followed there from where it is not.
        assert_eq!(drawn(&grid, SETTINGS, wedge).1, 0, "wedge on {columns} x {rows}");
    }
}

/// Neighbours are those by value, in whatever order the values stand in the sweep file.
#[test]
fn the_order_of_the_values_does_not_matter() {
    let rising = grid(130, 70);
    let Grid::Axes(mut axes) = rising.clone() else { panic!("axes") };
    for axis in &mut axes {
        // Every second value first, the others backwards after them.
        let odd = axis.values.iter().skip(1).step_by(2).rev();
        axis.values = axis.values.iter().step_by(2).chain(odd).cloned().collect();
    }
    let shuffled = Grid::Axes(axes);
    let circle = |[x, y, v]: [f64; 3]| ((x - 60.0) / 130.0).powi(2) + ((y - 30.0 - v) / 70.0).powi(2) < 0.1;
    let [(expected, _), (found, wrong)] = [&rising, &shuffled].map(|grid| drawn(grid, SETTINGS, circle));
    assert_eq!((wrong, found.computed), (0, expected.computed));
}

/// Whether an instance has settled is known of every one: its own, or that of the nearest corner that was computed.
#[test]
fn what_has_not_settled_is_told_of_every_instance() {
    let grid = grid(257, 257);
    let settled = |index: usize| {
        let Value::Number(x) = grid.coordinates(index)[0] else { panic!("numbers") };
        *x > 100.0
    };
    let mut known = Vec::new();
    let refined = refine::<Error>(&grid, SETTINGS, &mut |instances| {
        known.extend_from_slice(instances);
        let record = |index: &usize| Record {
            status: Status::Ok,
            regime: Some(Regime::Slip),
            settled: Some(settled(*index)),
            ..Record::default()
        };
        Ok(instances.iter().map(|index| Label::from(&record(index))).collect())
    })
    .unwrap();
    assert!(known.iter().all(|index| refined.labels[*index].settled() == Some(settled(*index))));
    let wrong = |index: &usize| refined.labels[*index].settled() != Some(settled(*index));
    let wrong: Vec<usize> = (0..grid.len()).filter(wrong).collect();
    // One region for the lines; the coarse cells are 16 points wide, so that the end is found within 8.
    let end = |index: &usize| {
        let Value::Number(x) = grid.coordinates(*index)[0] else { panic!("numbers") };
        (*x - 100.0).abs() <= 8.0
    };
    assert!(wrong.iter().all(end) && wrong.len() < 5 * 2 * 257, "{}", wrong.len());
}

#[test]
fn an_island_inside_a_coarse_cell_is_missed_and_a_sample_says_so() {
    let grid = grid(257, 257);
    // The coarse cells are 16 points wide.
    let island = |[x, y, v]: [f64; 3]| v > 0.0 && (x - 40.0).hypot(y - 40.0) < 6.5;
    let (refined, wrong) = drawn(&grid, SETTINGS, island);
    assert!(wrong > 100, "the island is not seen");
    assert_eq!((refined.sampled, refined.missed_at_most()), (0, None));
    let (refined, wrong) = drawn(&grid, Settings { sample: 4000, ..SETTINGS }, island);
    assert_eq!((refined.sampled, wrong), (4000, 0));
    // 133 of 131 564 instances that were not computed before lie on it: of 4000 some 4.
    assert!((1..=12).contains(&refined.missed), "{}", refined.missed);
    let most = refined.missed_at_most().unwrap();
    assert!(most > 133.0 / 131_564.0 && most < 0.01, "{most}");
    let (refined, _) = drawn(&grid, Settings { sample: 1000, ..SETTINGS }, |_| false);
    // Wilson's score without a hit: z²/(n + z²).
    assert!((refined.missed_at_most().unwrap() - 1.645 * 1.645 / (1000.0 + 1.645 * 1.645)).abs() < 1e-12);
    // Everything drawn: nothing is left to be missed.
    let (refined, wrong) = drawn(&grid, Settings { sample: 1_000_000, ..SETTINGS }, island);
    assert_eq!((refined.computed, wrong), (grid.len(), 0));
}

/// Refines the paper's map over three belt velocities; how many labels differ from those of the whole grid.
fn paper(points: u32, analysis: &str, share: usize) -> (Refined, usize) {
    let axis = format!("{{ from = 0.0, to = 0.6, points = {points} }}");
    let text = format!(
        "analysis = {analysis}\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5.0\n[axes]\n\
         belt_velocity = {{ values = [1, 3, 6] }}\nmu_s = {axis}\nmu_d = {axis}\n"
    );
    let mut spec = Spec::parse(&text, "planes.toml", "".as_ref()).unwrap();
    spec.analysis.checked = false;
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let mut solver = Solver::new(&spec, &options).unwrap();
    let settings = Settings { coarse: 32, sample: 1000, seed: 1 };
    let refined = refine::<Error>(&spec.grid, settings, &mut |instances| {
        let made = solver.records_of(&subset(&spec, instances), 0..instances.len(), &|_| ())?;
        Ok(made.records.iter().map(Label::from).collect())
    })
    .unwrap();
    let total = spec.grid.len();
    let mut wrong = 0;
    for first in (0..total).step_by(1 << 17) {
        let range = first..(first + (1 << 17)).min(total);
        let records = solver.records(range.clone(), &|_| ()).unwrap().records;
        assert_eq!(records.len(), range.len());
        wrong += range
            .zip(&records)
            .filter(|(i, record)| refined.labels[*i].class() != Label::from(*record).class())
            .count();
    }
    println!(
        "{} of {total} computed, {} of a sample missed, {wrong} wrong",
        refined.computed, refined.missed
    );
    assert!(refined.computed * share < total, "{} of {total}", refined.computed);
    assert_eq!(refined.missed, 0);
    (refined, wrong)
}

#[test]
fn the_types_of_the_papers_map_are_those_of_the_whole_grid() {
    assert_eq!(paper(1025, "[\"linear\"]", 20).1, 0);
}

#[test]
#[ignore = "minutes: every instance of the whole grid is integrated"]
fn no_more_regimes_are_missed_than_the_sample_allows() {
    // Islands of some instances where the motion is chaotic: 97 of three millions when this was written.
    let (refined, wrong) = paper(1025, "[\"linear\", \"response\"]", 20);
    assert!(wrong as f64 <= refined.missed_at_most().unwrap() * refined.labels.len() as f64, "{wrong}");
}

#[test]
fn the_command_writes_its_files_or_says_what_is_missing() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = |name: &str, axes: &str| {
        let text = format!(
            "analysis = [\"linear\"]\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5.0\n\
             {axes}\n[belt]\nbelt_velocity = 3.0\n"
        );
        std::fs::write(directory.path().join(name), text).unwrap();
    };
    sweep(
        "plane.toml",
        "[axes]\nmu_s = { from = 0.0, to = 0.6, points = 65 }\nmu_d = { from = 0.0, to = 0.6, points = 65 }",
    );
    let arguments = ["refine", "plane.toml", "--coarse", "8", "--backend", "cpu"];
    let ended = squealmap(directory.path(), &arguments);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let out = directory.path().join("out/plane");
    for name in ["boundaries.csv", "points.csv", "refined.png", "refined.svg"] {
        assert!(std::fs::metadata(out.join(name)).unwrap().len() > 100, "{name}");
    }
    let document: serde_json::Value =
        serde_json::from_slice(&std::fs::read(out.join("refine.json")).unwrap()).unwrap();
    let points = std::fs::read_to_string(out.join("points.csv")).unwrap();
    assert_eq!(document["computed"], points.lines().count() - 1);
    assert_eq!(document["instances"], 65 * 65);
    // physics.md: with constant friction (the diagonal) the modes couple from 0.2264 on. A vertex of the lines lies at
    // most half a cell, 0.0047, from there in both directions.
    let lines = std::fs::read_to_string(out.join("boundaries.csv")).unwrap();
    let near = |line: &str| {
        let at: Vec<f64> = line.split(',').skip(2).filter_map(|x| x.parse().ok()).collect();
        at.len() == 2 && at.iter().all(|x| (x - 0.2264).abs() < 0.0048)
    };
    assert!(lines.lines().any(near), "the four regions meet at the critical friction");

    sweep("line.toml", "mu_d = 0.3\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 65 }");
    sweep(
        "large.toml",
        "[axes]\nmu_s = { from = 0.0, to = 0.6, points = 20000 }\nmu_d = { from = 0.0, to = 0.6, points = 20000 }",
    );
    for (name, says) in [("line.toml", "two numeric axes"), ("large.toml", "400000000 instances")] {
        let ended = squealmap(directory.path(), &["refine", name, "-o", "none"]);
        assert_eq!(ended.code, Some(2), "{name}");
        assert!(ended.err.contains(says), "{}", ended.err);
        assert!(!directory.path().join("none").exists(), "nothing is left");
    }
}
