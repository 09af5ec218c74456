//! Directories that hold the results of something else: nothing is replaced that somebody has not asked to be.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::cli::program::{Ended, squealmap, tree, unwrapped};

/// 2 × 3 instances with this friction.
fn sweep(title: &str, mu_s: &str, more: &str) -> String {
    format!(
        "title = \"{title}\"\n[friction]\nmu_s = {mu_s}\n[axes]\nmu_d = {{ values = [0.3, 0.4] }}\n\
         belt_velocity = {{ from = 1, to = 3, points = 3 }}\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n\
         {more}"
    )
}

/// Two sweeps of one name: `a/map.toml` and `b/map.toml`.
fn two(more: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (folder, mu_s) in [("a", "0.5"), ("b", "0.6")] {
        fs::create_dir(directory.path().join(folder)).unwrap();
        fs::write(directory.path().join(folder).join("map.toml"), sweep(folder, mu_s, more)).unwrap();
    }
    directory
}

/// Every file of a folder with its bytes.
fn content(directory: &Path, folder: &str) -> BTreeMap<PathBuf, Vec<u8>> {
    let folder = directory.join(folder);
    let files = tree(&folder).into_iter().filter(|path| folder.join(path).is_file());
    files.map(|path| (path.clone(), fs::read(folder.join(&path)).unwrap())).collect()
}

fn done(directory: &TempDir, arguments: &[&str]) -> Ended {
    let ended = squealmap(directory.path(), arguments);
    assert_eq!(ended.code, Some(0), "{arguments:?}: {}", ended.err);
    ended
}

/// Refused with these words, and nothing of `folder` is another.
fn refused(directory: &TempDir, folder: &str, arguments: &[&str], words: &[&str]) {
    let before = content(directory.path(), folder);
    let ended = squealmap(directory.path(), arguments);
    assert_eq!(ended.code, Some(2), "{arguments:?}: {}{}", ended.out, ended.err);
    for words in words {
        assert!(unwrapped(&ended.err).contains(words), "{words}: {}", ended.err);
    }
    assert!(content(directory.path(), folder) == before, "{arguments:?} changed something");
}

const CPU: [&str; 2] = ["--backend", "cpu"];

fn run(file: &'static str, more: &[&'static str]) -> Vec<&'static str> {
    [&["run", file], &CPU[..], more].concat()
}

#[test]
fn results_of_another_sweep_are_replaced_only_when_asked_for() {
    for tile in ["1000", "2"] {
        let directory = two("");
        let more = ["-o", "here", "--tile", tile];
        done(&directory, &run("a/map.toml", &more));
        let tiles = if tile == "2" { "3 of 3 tiles" } else { "1 of 1 tiles" };
        let what = format!("\"a\", 6 instances, {tiles}, cpu f64, from `a/map.toml`; choose another");
        refused(&directory, "here", &run("b/map.toml", &more), &["`here` holds", &what, "--force"]);
        let ended = done(&directory, &[&run("b/map.toml", &more)[..], &["--force"]].concat());
        assert!(ended.err.contains("replaces what is in `here`: \"a\", 6 instances"), "{}", ended.err);
        done(&directory, &run("b/map.toml", &["-o", "alone", "--tile", tile]));
        let names = |folder: &str| content(directory.path(), folder).into_keys().collect::<Vec<_>>();
        assert_eq!(names("here"), names("alone"), "nothing of the other sweep is left");
        assert_eq!(
            content(directory.path(), "here")[Path::new("map.csv")],
            content(directory.path(), "alone")[Path::new("map.csv")]
        );
    }
}

#[test]
fn results_without_their_tiles_are_results() {
    let directory = two("");
    done(&directory, &run("a/map.toml", &["-o", "here"]));
    fs::remove_dir_all(directory.path().join("here/tiles")).unwrap();
    refused(
        &directory,
        "here",
        &run("b/map.toml", &["-o", "here"]),
        &["\"a\", 6 instances, from `a/map.toml`"],
    );
    // The same sweep computes its tiles again.
    done(&directory, &run("a/map.toml", &["-o", "here"]));
    // A table that nobody describes.
    fs::create_dir(directory.path().join("mine")).unwrap();
    fs::write(directory.path().join("mine/map.csv"), "mine\n").unwrap();
    refused(
        &directory,
        "mine",
        &run("b/map.toml", &["-o", "mine"]),
        &["`mine` holds", "of an unknown sweep file"],
    );
}

#[test]
fn a_second_sweep_of_a_name_has_a_directory_of_its_own_and_finds_it_again() {
    let directory = two("");
    done(&directory, &run("a/map.toml", &[]));
    let first = content(directory.path(), "out/map");
    assert_eq!(first[Path::new("source.txt")], b"../../a/map.toml\n");
    for again in [false, true] {
        let ended = done(&directory, &run("b/map.toml", &[]));
        let note = "`out/map` is of `a/map.toml`; the results go to `out/map-2`";
        assert!(ended.err.contains(note), "{}", ended.err);
        assert_eq!(ended.out.contains("nothing is left to do in out/map-2"), again, "{}", ended.out);
        assert!(content(directory.path(), "out/map") == first);
    }
    // From elsewhere, by another path of the same file.
    let ended = done(&directory, &run("./b/../b/map.toml", &[]));
    assert!(ended.out.contains("nothing is left to do in out/map-2"), "{}", ended.out);
    done(&directory, &["modes", "b/map.toml"]);
    assert!(directory.path().join("out/map-2/modes.csv").is_file());
    // Moved together they still know one another.
    let moved = tempfile::tempdir().unwrap();
    for folder in ["a", "b", "out"] {
        fs::rename(directory.path().join(folder), moved.path().join(folder)).unwrap();
    }
    let ended = done(&moved, &run("b/map.toml", &[]));
    assert!(ended.out.contains("nothing is left to do in out/map-2"), "{}", ended.out);
    // A sweep file that was renamed goes on where its results are; another one may not replace them.
    fs::rename(moved.path().join("a"), moved.path().join("c")).unwrap();
    let ended = done(&moved, &run("c/map.toml", &[]));
    assert!(ended.out.contains("nothing is left to do in out/map\n"), "{}", ended.out);
}

#[test]
fn a_changed_sweep_replaces_what_is_cheap_and_says_so() {
    let directory = two("");
    done(&directory, &run("a/map.toml", &[]));
    fs::write(directory.path().join("a/map.toml"), sweep("a", "0.7", "")).unwrap();
    let ended = done(&directory, &run("a/map.toml", &[]));
    assert!(
        ended.err.contains("replaces what is in `out/map`: \"a\", 6 instances, 1 of 1 tiles"),
        "{}",
        ended.err
    );
    // Of several tiles it is not cheap.
    done(&directory, &run("b/map.toml", &["--tile", "2"]));
    fs::write(directory.path().join("b/map.toml"), sweep("b", "0.8", "")).unwrap();
    let changed = run("b/map.toml", &["--tile", "2"]);
    refused(&directory, "out/map-2", &changed, &["3 of 3 tiles", "from `b/map.toml`", "--force"]);
    done(&directory, &[&changed[..], &["--force"]].concat());
}

#[test]
fn refine_and_merge_ask_too() {
    let refine = "[refine]\ncoarse = 2\nsample = 0\n";
    let directory = two(refine);
    for folder in ["a", "b"] {
        let path = directory.path().join(folder).join("map.toml");
        let text = fs::read_to_string(&path)
            .unwrap()
            .replace("values = [0.3, 0.4]", "from = 0.1, to = 0.4, points = 4");
        fs::write(&path, text).unwrap();
    }
    let [a, b] = ["a/map.toml", "b/map.toml"].map(|file| run(file, &["-o", "here"]));
    done(&directory, &a);
    refused(&directory, "here", &b, &["\"a\", 12 instances, from `a/map.toml`"]);
    done(&directory, &[&b[..], &["--force"]].concat());
    // Its parts are still there.
    let ended = done(&directory, &[&a[..], &["--force"]].concat());
    assert!(ended.out.contains("of them before"), "{}", ended.out);

    let directory = two("");
    for folder in ["a", "b"] {
        let file = format!("{folder}/map.toml");
        done(&directory, &["run", &file, "--backend", "cpu", "-o", folder]);
    }
    refused(&directory, "a", &["merge", "a", "b"], &["`a` and `b` hold tiles of different sweeps"]);
    done(&directory, &["merge", "a", "b", "--force"]);
    assert!(
        fs::read(directory.path().join("a/map.csv")).unwrap()
            == fs::read(directory.path().join("b/map.csv")).unwrap()
    );
    // Results whose tiles are gone are no less.
    fs::remove_dir_all(directory.path().join("a/tiles")).unwrap();
    done(&directory, &["run", "a/map.toml", "--backend", "cpu", "-o", "a", "--force"]);
    fs::remove_dir_all(directory.path().join("a/tiles")).unwrap();
    refused(
        &directory,
        "a",
        &["merge", "a", "b"],
        &["`a` holds the results of another sweep", "\"a\", 6 instances"],
    );
    done(&directory, &["merge", "new", "b"]);
    assert_eq!(fs::read_to_string(directory.path().join("new/source.txt")).unwrap(), "../b/map.toml\n");
}

#[test]
fn measured_files_of_one_name_do_not_share_a_directory() {
    let directory = tempfile::tempdir().unwrap();
    for (folder, mu) in [("monday", "0.31"), ("tuesday", "0.47")] {
        fs::create_dir(directory.path().join(folder)).unwrap();
        let points = format!("V,mu,temperature\n1,{mu},20\n2,{mu},20\n6,{mu},20\n8,{mu},20\n");
        fs::write(directory.path().join(folder).join("stop.csv"), points).unwrap();
    }
    let fit = |folder: &str| {
        let file = format!("{folder}/stop.csv");
        done(&directory, &["fit", &file, "--friction", "mu", "--law", "constant"]);
    };
    ["monday", "tuesday", "monday"].into_iter().for_each(fit);
    for (out, mu) in [("out/stop", "0.31"), ("out/stop-2", "0.47")] {
        let text = fs::read_to_string(directory.path().join(out).join("material.csv")).unwrap();
        assert!(text.contains(mu), "{out}: {text}");
    }
}

#[test]
fn nothing_is_left_of_what_did_not_begin() {
    let directory = two("");
    let ended = squealmap(directory.path(), &run("a/map.toml", &["--reuse", "nowhere"]));
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(!directory.path().join("out").exists());
    // Refused when the tiles were to begin, after the source was noted.
    let tiles = directory.path().join("out/map/tiles");
    fs::create_dir_all(&tiles).unwrap();
    fs::write(tiles.join("sweep.json"), "{ \"format\": 99 }").unwrap();
    let ended = squealmap(directory.path(), &run("a/map.toml", &[]));
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("its format is 99"), "{}", ended.err);
    assert_eq!(
        tree(&directory.path().join("out")),
        ["map", "map/tiles", "map/tiles/sweep.json"].map(PathBuf::from)
    );
}
