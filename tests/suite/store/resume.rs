//! Sweeps of several tiles by the program: run again, bad tiles, other sweeps, several processes, no room.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::cli::program::squealmap;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::results::csv::map_csv;
use squealmap::results::figure::map::map_svg;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;
use tempfile::TempDir;

/// 15 × 20 instances.
pub(crate) const SWEEP: &str = "title = \"Tiles\"\n[friction]\nmu_s = 0.4\n[axes]\n\
    mu_d = { from = 0.1, to = 0.4, points = 15 }\nbelt_velocity = { from = 1, to = 8, points = 20 }\n\
    [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";

/// Runs the sweep in tiles of 32 instances: 10 of them.
const RUN: [&str; 6] = ["run", "s.toml", "--backend", "cpu", "--tile", "32"];

/// A directory with a sweep `s.toml`.
pub(crate) fn with(sweep: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
    directory
}

/// The tiles of `out/s` by name.
pub(crate) fn tiles(directory: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = std::fs::read_dir(directory.join("out/s/tiles")).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|end| end == "tile"))
        .map(|path| (path.file_name().unwrap().into(), std::fs::read(&path).unwrap()))
        .collect()
}

/// What is in `out/s` beside the tiles, in a directory where nothing may be left over.
pub(crate) fn names(directory: &Path) -> Vec<String> {
    let list = |path: &Path| {
        let entries = std::fs::read_dir(path).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
    };
    let is_tile = |name: &String| Path::new(name).extension().is_some_and(|end| end == "tile");
    let mut names = list(&directory.join("out/s"));
    names.extend(list(&directory.join("out/s/tiles")).into_iter().filter(|name| !is_tile(name)));
    names.sort();
    names
}

pub(crate) const COMPLETE: [&str; 7] =
    ["manifest.json", "map.csv", "map.png", "map.svg", "source.txt", "sweep.json", "tiles"];

fn read(directory: &Path, name: &str) -> Vec<u8> {
    std::fs::read(directory.join("out/s").join(name)).unwrap()
}

#[test]
fn tiles_change_nothing_of_the_results() {
    let directory = with(SWEEP);
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(
        (tiles(directory.path()).len(), names(directory.path())),
        (10, COMPLETE.map(str::to_owned).to_vec())
    );
    // The library, in memory, without any tile.
    let spec = Spec::parse(SWEEP, "s.toml", ".".as_ref()).unwrap();
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let map = run::run(spec, &options, &|_| {}).unwrap();
    assert!(read(directory.path(), "map.csv") == map_csv(&map).unwrap(), "map.csv differs");
    assert!(read(directory.path(), "map.svg") == map_svg(&map).unwrap().into_bytes(), "map.svg differs");
    let manifest: serde_json::Value =
        serde_json::from_slice(&read(directory.path(), "manifest.json")).unwrap();
    assert_eq!(manifest["spec"], map.spec.resolved());
    assert_eq!((&manifest["complete"], &manifest["computation"]["computed"]), (&true.into(), &300.into()));
    for (option, value) in [("--tile", "7"), ("--tile", "1000"), ("--threads", "1")] {
        let other = with(SWEEP);
        let arguments = ["run", "s.toml", "--backend", "cpu", option, value];
        assert_eq!(squealmap(other.path(), &arguments).code, Some(0));
        assert!(read(other.path(), "map.csv") == read(directory.path(), "map.csv"), "{option} {value}");
    }
}

#[test]
fn a_complete_directory_is_left_alone() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let times = || {
        let paths = COMPLETE[..4].iter().map(|name| directory.path().join("out/s").join(name));
        paths.map(|path| path.metadata().unwrap().modified().unwrap()).collect::<Vec<_>>()
    };
    let (before, made) = (times(), tiles(directory.path()));
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(ended.out, "all 300 instances were computed before; nothing is left to do in out/s\n");
    assert_eq!((times(), tiles(directory.path())), (before, made));
    // Lost results are written again from the tiles.
    let csv = read(directory.path(), "map.csv");
    std::fs::remove_file(directory.path().join("out/s/map.csv")).unwrap();
    let ended = squealmap(directory.path(), &RUN);
    assert!(ended.out.starts_with("0 of 300 instances in "), "{}", ended.out);
    assert!(ended.out.contains("; 300 were there before\n"), "{}", ended.out);
    assert!(read(directory.path(), "map.csv") == csv);
}

#[test]
fn bad_tiles_are_named_set_aside_and_computed_again() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let (good, csv) = (tiles(directory.path()), read(directory.path(), "map.csv"));
    let other = with(&SWEEP.replace("mu_s = 0.4", "mu_s = 0.5"));
    squealmap(other.path(), &RUN);
    let foreign: Vec<Vec<u8>> = tiles(other.path()).into_values().collect();
    let paths: Vec<&PathBuf> = good.keys().collect();
    let damage = |number: usize, bytes: &[u8]| {
        std::fs::write(directory.path().join("out/s/tiles").join(paths[number]), bytes).unwrap();
    };
    damage(0, &good[paths[0]][..100]);
    let mut flipped = good[paths[3]].clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 16;
    damage(3, &flipped);
    damage(5, b"");
    damage(7, &foreign[7]);
    damage(8, &good[paths[9]][..]);
    std::fs::write(directory.path().join("out/s/tiles/00000001-0123456789abcdef.tile"), &foreign[1]).unwrap();
    std::fs::remove_file(directory.path().join("out/s/tiles").join(paths[2])).unwrap();
    std::fs::remove_file(directory.path().join("out/s/map.csv")).unwrap();

    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for (number, fault) in [
        (0, "it has 100 of 7416 bytes"),
        (3, "its checksum does not match its content"),
        (5, "it is empty"),
        (7, "it belongs to another sweep, version or engine"),
        // The last tile is shorter.
        (8, "it has 2856 of 7416 bytes"),
    ] {
        let name = paths[number].display();
        let sentence =
            format!("`out/s/tiles/{name}` is set aside in `tiles/bad`: {fault}; it is computed again\n");
        assert!(ended.err.contains(&sentence), "{sentence}{}", ended.err);
        assert!(directory.path().join("out/s/tiles/bad").join(paths[number]).is_file());
    }
    assert!(ended.err.contains(
        "00000001-0123456789abcdef.tile` is set aside in `tiles/bad`: it is no tile of this sweep\n"
    ));
    // Five that were bad and one that was missing, of 32 instances each.
    assert!(ended.out.starts_with("192 of 300 instances in "), "{}", ended.out);
    assert!(ended.out.contains("; 108 were there before\n"), "{}", ended.out);
    assert!(tiles(directory.path()) == good && read(directory.path(), "map.csv") == csv);
}

#[test]
fn a_directory_of_another_sweep_is_refused() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let before = tiles(directory.path());
    for arguments in
        [[&RUN[..], &["--precision", "f32"]].concat(), ["run", "s.toml", "--backend", "reference"].to_vec()]
    {
        let ended = squealmap(directory.path(), &arguments);
        assert_eq!(ended.code, Some(2), "{}", ended.out);
        assert!(
            ended.err.ends_with(
                "error: `out/s` holds the results of another sweep, program version or engine: \"Tiles\", 300 instances, \
                 10 of 10 tiles, cpu f64, from `s.toml`; choose another directory with -o, or replace them with --force\n"
            ),
            "{}",
            ended.err
        );
        assert!(tiles(directory.path()) == before);
    }
    // A single tile is cheap: it gives way.
    let small = with(SWEEP);
    squealmap(small.path(), &["run", "s.toml", "--backend", "cpu"]);
    std::fs::write(small.path().join("s.toml"), SWEEP.replace("mu_s = 0.4", "mu_s = 0.5")).unwrap();
    let ended = squealmap(small.path(), &["run", "s.toml", "--backend", "cpu"]);
    assert!(
        ended.code == Some(0) && ended.out.starts_with("300 instances in "),
        "{}{}",
        ended.out,
        ended.err
    );
    assert_eq!((tiles(small.path()).len(), names(small.path())), (1, COMPLETE.map(str::to_owned).to_vec()));
}

#[test]
fn a_broken_description_is_written_again() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let (path, before) = (directory.path().join("out/s/tiles/sweep.json"), tiles(directory.path()));
    let good = std::fs::read(&path).unwrap();
    std::fs::write(&path, &good[..good.len() / 2]).unwrap();
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("`out/s/tiles/sweep.json` is set aside in `tiles/bad`: EOF"), "{}", ended.err);
    assert!(ended.out.starts_with("all 300 instances were computed before"), "{}", ended.out);
    assert!(std::fs::read(&path).unwrap() == good && tiles(directory.path()) == before);
}

#[test]
fn processes_in_one_directory_share_the_work() {
    let sweep = SWEEP.replace("points = 15", "points = 150").replace("\"2 periods\"", "\"20 periods\"");
    let alone = with(&sweep);
    assert_eq!(squealmap(alone.path(), &RUN).code, Some(0));
    let directory = with(&sweep);
    let start = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
        command.args(RUN).args(["--threads", "1"]).current_dir(directory.path());
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let all: Vec<_> = (0..4).map(|_| start()).collect();
    let mut computed = 0;
    for child in all {
        let output = child.wait_with_output().unwrap();
        let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.status.code(), Some(0), "{err}");
        let first = out.split_whitespace().next().unwrap();
        computed += if first == "all" { 0 } else { first.parse::<usize>().unwrap() };
    }
    assert_eq!(computed, 3000, "no tile is computed twice");
    assert!(tiles(directory.path()) == tiles(alone.path()));
    assert!(read(directory.path(), "map.csv") == read(alone.path(), "map.csv"));
    assert_eq!(names(directory.path()), COMPLETE);
}

#[test]
fn a_sweep_without_room_is_refused_before_it_begins() {
    let directory = with(
        "analysis = [\"linear\"]\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = { from = 0.1, to = 0.4, points = 10_000 }\n\
         belt_velocity = { from = 1, to = 8, points = 10_000 }\ntheta = { from = 0.01, to = 0.1, points = 10_000 }\n",
    );
    let ended = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    // 44 bytes of each instance and 120 of each tile: 44.0 TB.
    assert!(
        ended
            .err
            .contains("error: the sweep needs about 44 TB in `out/s`, 64 MB of it to leave free, where "),
        "{}",
        ended.err
    );
    assert!(!directory.path().join("out").exists());
    let ended = squealmap(directory.path(), &["check", "s.toml"]);
    assert!(ended.out.contains("disk      about 44 TB of tiles"), "{}", ended.out);
}
