//! `run --reuse`: instances of another directory, taken over as they are.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::cli::program::{Ended, squealmap, unwrapped};
use crate::store::resume::{names, tiles, with};
use serde_json::Value as Json;
use squealmap::store::direct::Room;
use squealmap::store::directory::Store;
use tempfile::TempDir;

/// 4 × 8 instances, or what a test makes of the axes.
const SWEEP: &str = "title = \"Reuse\"\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = { values = [0.1, 0.2, 0.3, 0.35] }\n\
    belt_velocity = { from = 1, to = 8, points = 8 }\n[response]\nsettle = \"40 periods\"\nmeasure = \"20 periods\"\n";

/// The same with another end of the second axis and other values of the first: 3 × 8 instances of 5 × 15 are there.
fn wider(sweep: &str) -> String {
    let first = sweep.replace("[0.1, 0.2, 0.3, 0.35]", "[0.05, 0.1, 0.3, 0.35, 0.15]");
    first.replace("to = 8, points = 8", "to = 15, points = 15")
}

const COMMON: usize = 3 * 8;

fn run(directory: &Path, more: &[&str]) -> Ended {
    squealmap(directory, &[&["run", "s.toml", "--tile", "10"], more].concat())
}

/// A directory in which `old` was computed to `old`, and `s.toml` is now `new`.
fn after(old: &str, new: &str, engine: &[&str]) -> TempDir {
    let directory = with(old);
    let ended = run(directory.path(), &[engine, &["-o", "old"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    fs::write(directory.path().join("s.toml"), new).unwrap();
    directory
}

fn manifest(directory: &Path, output: &str) -> Json {
    serde_json::from_slice(&fs::read(directory.join(output).join("manifest.json")).unwrap()).unwrap()
}

/// Instances of the old sweep with a common place in the new one of which a check has replaced the record, by the table.
fn replaced(directory: &Path) -> usize {
    let mut table = csv::Reader::from_path(directory.join("old/map.csv")).unwrap();
    let headers = table.headers().unwrap().clone();
    let at = |name: &str| headers.iter().position(|one| one == name).unwrap();
    let (mu_d, checked) = (at("mu_d"), at("checked"));
    table.records().map(Result::unwrap).filter(|row| &row[mu_d] != "0.2" && &row[checked] == "2").count()
}

#[test]
fn what_coincides_is_taken_over_and_the_bytes_are_those_of_a_whole_run() {
    let auto = SWEEP.replace("settle = \"40 periods\"", "settle = \"auto\"");
    let linear = SWEEP
        .split("[response]")
        .next()
        .unwrap()
        .replace("[friction]", "analysis = [\"linear\"]\n[friction]");
    for (sweep, engine) in [
        (SWEEP, &["--backend", "cpu"][..]),
        (SWEEP, &["--backend", "cpu", "--precision", "f32"]),
        (&auto, &["--backend", "cpu", "--no-check"]),
        (&linear, &["--backend", "cpu"]),
    ] {
        let whole = with(&wider(sweep));
        assert_eq!(run(whole.path(), engine).code, Some(0));
        let directory = after(sweep, &wider(sweep), engine);
        let ended = run(directory.path(), &[engine, &["--reuse", "old"]].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(tiles(directory.path()) == tiles(whole.path()), "a tile differs: {engine:?}");
        for name in ["map.csv", "map.svg", "tiles/sweep.json"] {
            let read = |directory: &Path| fs::read(directory.join("out/s").join(name)).unwrap();
            assert!(read(directory.path()) == read(whole.path()), "{name} differs: {engine:?}");
        }
        let replaced = if sweep == SWEEP { replaced(directory.path()) } else { 0 };
        let said = &manifest(directory.path(), "out/s")["computation"]["reused"];
        assert_eq!(said["instances"], COMMON - replaced, "{engine:?}");
        assert_eq!(said["from_sweep"], manifest(directory.path(), "old")["sweep_id"]);
        let sentence = format!("{} of 75 instances in ", 75 - COMMON + replaced);
        assert!(ended.out.starts_with(&sentence), "{}", ended.out);
        assert!(ended.out.contains(&format!("; {} were taken over\n", COMMON - replaced)), "{}", ended.out);
        assert!(manifest(whole.path(), "out/s")["computation"]["reused"].is_null());
    }
}

const UNCHECKED: [&str; 3] = ["--backend", "cpu", "--no-check"];

/// The wider sweep computed as a whole, a directory that is to compute it with `old` at hand, and that.
fn unchecked() -> (TempDir, TempDir, Store) {
    let whole = with(&wider(SWEEP));
    assert_eq!(run(whole.path(), &UNCHECKED).code, Some(0));
    let directory = after(SWEEP, &wider(SWEEP), &UNCHECKED);
    let old = Store::open(&directory.path().join("old")).unwrap();
    (whole, directory, old)
}

#[test]
fn what_is_bad_or_missing_there_is_computed() {
    let (whole, directory, old) = unchecked();
    // Instances 0 to 9 are not there, a byte of 20 to 29 is another; the last tile has 30 and 31.
    fs::remove_file(old.path(0)).unwrap();
    let mut bytes = fs::read(old.path(2)).unwrap();
    bytes[150] ^= 1;
    fs::write(old.path(2), &bytes).unwrap();
    let ended = run(directory.path(), &[&UNCHECKED[..], &["--reuse", "old"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("is not reused: its checksum does not match its content"), "{}", ended.err);
    assert!(tiles(directory.path()) == tiles(whole.path()));
    assert!(fs::read(old.path(2)).unwrap() == bytes, "what is reused is left as it is");
    // 10 to 19 without 0.2 (8 to 15): 16 to 19; and 30, 31.
    assert_eq!(manifest(directory.path(), "out/s")["computation"]["reused"]["instances"], 6);
}

#[test]
fn the_comparison_sees_a_record_that_was_changed() {
    let (whole, directory, old) = unchecked();
    let mut records = old.read(3).unwrap().unwrap();
    let outcome = records[1].outcome.as_mut().unwrap();
    outcome.x2_std = outcome.x2_std.map(|value| value * (1.0 + f64::EPSILON));
    old.write(old.claim(3).unwrap().unwrap(), 3, records, &mut Room::default()).unwrap();
    let ended = run(directory.path(), &[&UNCHECKED[..], &["--reuse", "old"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let (found, wanted) = (tiles(directory.path()), tiles(whole.path()));
    let differ = found.iter().zip(&wanted).filter(|(one, two)| one != two).count();
    assert_eq!(differ, 1);
}

#[test]
fn what_differs_in_more_than_values_of_axes_is_refused() {
    let other_order = "belt_velocity = { from = 1, to = 8, points = 8 }\nmu_d = { values = [0.1, 0.2] }\n";
    let axes = SWEEP.split_once("[axes]\n").unwrap().1.split_once("[response]").unwrap().0;
    let cpu: &[&str] = &["--backend", "cpu"];
    let settings = "it was computed with other parameters, settings, engine or version";
    for (new, engine, output, sentence) in [
        (SWEEP.replace("mu_s = 0.4", "mu_s = 0.5"), cpu, "out/s", settings),
        (SWEEP.replace("\"20 periods\"", "\"21 periods\""), cpu, "out/s", settings),
        (SWEEP.to_owned(), &["--backend", "cpu", "--precision", "f32"], "out/s", settings),
        (SWEEP.to_owned(), &["--backend", "cpu", "--no-check"], "out/s", settings),
        (SWEEP.to_owned(), &["--backend", "reference"], "out/s", settings),
        (
            SWEEP.replace("[response]", "[start]\nkind = \"both\"\n[response]"),
            cpu,
            "out/s",
            "only sweeps with one start for each instance",
        ),
        (SWEEP.replace(axes, other_order), cpu, "out/s", "its [axes] are others or in another order"),
        (
            SWEEP.replace(axes, &format!("{axes}theta = {{ values = [0.01] }}\n")),
            cpu,
            "out/s",
            "its [axes] are others",
        ),
        (wider(SWEEP), cpu, "old", "it is the output directory itself; choose another one with -o"),
    ] {
        let directory = after(SWEEP, &new, cpu);
        let before = tree(directory.path());
        let ended = run(directory.path(), &[engine, &["--reuse", "old", "-o", output]].concat());
        assert_eq!(ended.code, Some(2), "{sentence}: {}{}", ended.out, ended.err);
        let sentence = format!("--reuse `old`: {sentence}");
        assert!(unwrapped(&ended.err).contains(&sentence), "{sentence}: {}", ended.err);
        assert_eq!(tree(directory.path()), before, "{sentence}");
    }
    let directory = with(SWEEP);
    let ended = run(directory.path(), &["--backend", "cpu", "--reuse", "nowhere"]);
    assert!(ended.code == Some(2) && ended.err.contains("nowhere"), "{}", ended.err);
    assert!(!directory.path().join("out").exists() && names_of(directory.path()) == ["s.toml"]);
}

/// Files of `old` and what else is in a directory.
fn tree(directory: &Path) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for inside in [".", "old", "old/tiles"] {
        all.extend(names_of(&directory.join(inside)).iter().map(|name| format!("{inside}/{name}")));
    }
    all
}

fn names_of(directory: &Path) -> Vec<String> {
    fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn nothing_is_left_over() {
    let directory = after(SWEEP, &wider(SWEEP), &["--backend", "cpu"]);
    assert_eq!(run(directory.path(), &["--backend", "cpu", "--reuse", "old"]).code, Some(0));
    assert_eq!(names(directory.path()), crate::store::resume::COMPLETE);
}
