//! Complete means complete: what a directory says of itself is what is in it.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::cli::program::{squealmap, unwrapped};
use crate::store::killed::{RUN as SLOW, done, sweep as slow};
use crate::store::resume::{COMPLETE, SWEEP, names, tiles, with};
use serde_json::Value as Json;
use squealmap::store::claim::Claim;
use squealmap::store::cut::tile_of;
use squealmap::store::directory::Store;
use squealmap::sweep::spec::Spec;

/// 10 tiles of 32 instances.
const RUN: [&str; 6] = ["run", "s.toml", "--backend", "cpu", "--tile", "32"];

fn read(directory: &Path, name: &str) -> Vec<u8> {
    std::fs::read(directory.join("out/s").join(name)).unwrap()
}

fn manifest(directory: &Path) -> Json {
    serde_json::from_slice(&read(directory, "manifest.json")).unwrap()
}

fn begin(directory: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command
        .args(arguments)
        .current_dir(directory)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn send(child: &Child, signal: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn a_tile_that_vanishes_while_a_sweep_runs_is_computed_again() {
    let undisturbed = with(&slow());
    assert_eq!(squealmap(undisturbed.path(), &SLOW).code, Some(0));
    let directory = with(&slow());
    let mut child = begin(directory.path(), &SLOW);
    let first = tiles(undisturbed.path()).into_keys().next().unwrap();
    let first = directory.path().join("out/s/tiles").join(first);
    while done(directory.path()) < 5 || std::fs::remove_file(&first).is_err() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before a tile was deleted");
        sleep(Duration::from_micros(200));
    }
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(read(directory.path(), "map.csv") == read(undisturbed.path(), "map.csv"));
    assert_eq!(manifest(directory.path())["complete"], true);
}

#[test]
fn results_are_those_of_the_tiles_that_are_there() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let csv = read(directory.path(), "map.csv");
    let store = Store::open(&directory.path().join("out/s")).unwrap();
    let named = manifest(directory.path());
    assert_eq!(named["tiles"]["blake3"], store.fingerprint().unwrap().to_string());
    // The checksum of a file, by the hash's own library, not by what wrote it.
    assert_eq!(named["files"]["map.csv"]["blake3"], blake3_of(&csv));
    assert_eq!(named["files"]["map.csv"]["bytes"], csv.len());
    // As a result of half the tiles would be: no error of any file alone.
    std::fs::remove_file(store.path(3)).unwrap();
    assert!(store.fingerprint().is_none());
    let mut lying = named.clone();
    lying["tiles"] = Json::Null;
    lying.as_object_mut().unwrap().remove("checksum").unwrap();
    let sealed = squealmap::store::seal::sealed(format!("{lying:#}\n").into_bytes());
    assert!(squealmap::store::seal::is_intact(&sealed));
    std::fs::write(directory.path().join("out/s/manifest.json"), sealed).unwrap();
    let ended = squealmap(directory.path(), &RUN);
    assert!(ended.out.starts_with("32 of 300 instances in "), "{}{}", ended.out, ended.err);
    assert_eq!(manifest(directory.path())["tiles"], named["tiles"]);
    assert!(read(directory.path(), "map.csv") == csv);
}

fn blake3_of(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

#[test]
fn damaged_results_are_seen_named_and_written_again() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let verify = || squealmap(directory.path(), &["verify", "out/s"]);
    let good = verify();
    assert_eq!(good.code, Some(0), "{}", good.err);
    assert!(good.out.contains("tiles        10 of 10 are there and good, 0 bad\n"), "{}", good.out);
    assert!(good.out.contains("results      good, and those of all tiles\n"), "{}", good.out);
    for name in ["map.csv", "map.svg", "map.png", "manifest.json"] {
        let path = directory.path().join("out/s").join(name);
        let whole = std::fs::read(&path).unwrap();
        let mut flipped = whole.clone();
        let middle = whole.len() / 2;
        flipped[middle] ^= 1;
        for (bad, how) in [(&whole[..middle], "cut"), (&flipped[..], "one bit changed"), (&[], "empty")] {
            std::fs::write(&path, bad).unwrap();
            let said = verify();
            assert_eq!(said.code, Some(1), "{name}, {how}: {}", said.out);
            assert!(said.out.contains(&format!("`{name}`")), "{name}, {how}: {}", said.out);
            // In turn by the two commands that put it right.
            let again = match how {
                "cut" => squealmap(directory.path(), &RUN),
                _ => squealmap(directory.path(), &["verify", "out/s", "--repair"]),
            };
            assert_eq!(again.code, Some(0), "{name}, {how}: {}", again.err);
            assert!(again.out.starts_with("0 of 300 instances"), "{name}, {how}: {}", again.out);
            assert!(name == "manifest.json" || std::fs::read(&path).unwrap() == whole, "{name}, {how}");
            assert_eq!(verify().code, Some(0), "{name}, {how}");
        }
    }
}

#[test]
fn a_repair_needs_no_sweep_file() {
    for text in [
        SWEEP.to_owned(),
        SWEEP.replace("settle = \"2 periods\"", "settle = \"auto\"") + "[start]\nkind = \"both\"\n",
        SWEEP
            .replace("mu_s = 0.4", "law = \"exponential\"\nmu_s = 0.4\nstribeck_velocity = 0.7\nmu_d = 0.1")
            .replace(
                "mu_d = { from = 0.1, to = 0.4, points = 15 }",
                "theta = { from = 0.01, to = 0.4, points = 15 }",
            ),
        SWEEP.replace("analysis", "").replace("[friction]", "analysis = [\"linear\"]\n[friction]"),
    ] {
        let directory = with(&text);
        let ended = squealmap(directory.path(), &RUN);
        assert_eq!(ended.code, Some(0), "{text}: {}", ended.err);
        std::fs::remove_file(directory.path().join("s.toml")).unwrap();
        let (good, csv) = (tiles(directory.path()), read(directory.path(), "map.csv"));
        let mut paths = good.keys().map(|name| directory.path().join("out/s/tiles").join(name));
        std::fs::remove_file(paths.next().unwrap()).unwrap();
        std::fs::write(paths.next().unwrap(), "no tile").unwrap();
        let said = squealmap(directory.path(), &["verify", "out/s"]);
        assert_eq!(said.code, Some(1));
        assert!(said.out.contains("tiles        8 of 10 are there and good, 1 bad\n"), "{}", said.out);
        let repaired = squealmap(directory.path(), &["verify", "out/s", "--repair"]);
        assert_eq!(repaired.code, Some(0), "{text}: {}", repaired.err);
        assert!(tiles(directory.path()) == good && read(directory.path(), "map.csv") == csv, "{text}");
    }
}

#[test]
fn a_changed_description_is_named_and_moves_no_tile() {
    for (from, to) in [("\"tile\": 32", "\"tile\": 64"), ("\"title\": \"Tiles\"", "\"title\": \"Other\"")] {
        let directory = with(SWEEP);
        squealmap(directory.path(), &RUN);
        let (good, path) = (tiles(directory.path()), directory.path().join("out/s/tiles/sweep.json"));
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(from));
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        for command in
            [&["merge", "out/s"][..], &["export", "out/s", "--format", "csv"], &["verify", "out/s"]]
        {
            let refused = squealmap(directory.path(), command);
            assert_eq!(refused.code, Some(2), "{command:?}: {}", refused.out);
            let said = unwrapped(&refused.err);
            assert!(said.contains("it was changed: its content does not have its checksum"), "{said}");
        }
        assert!(tiles(directory.path()) == good, "no tile is moved");
        // Cut in another size, as far as this command knows: nothing is touched.
        let other = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu", "--tile", "50"]);
        assert_eq!(other.code, Some(2), "{}", other.out);
        assert!(unwrapped(&other.err).contains("is a good tile of this sweep"), "{}", other.err);
        assert!(tiles(directory.path()) == good, "no tile is moved");
        std::fs::write(&path, text).unwrap();
        assert_eq!(squealmap(directory.path(), &RUN).code, Some(0));
        assert!(tiles(directory.path()) == good);
    }
}

#[test]
fn a_description_of_the_first_format_is_read() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let path = directory.path().join("out/s/tiles/sweep.json");
    let mut old: Json = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    old["format"] = 1.into();
    old.as_object_mut().unwrap().remove("checksum").unwrap();
    std::fs::write(&path, old.to_string()).unwrap();
    let merged = squealmap(directory.path(), &["merge", "out/s"]);
    assert_eq!(merged.code, Some(0), "{}", merged.err);
    old["format"] = 3.into();
    std::fs::write(&path, old.to_string()).unwrap();
    old["entry_of_tomorrow"] = true.into();
    std::fs::write(&path, old.to_string()).unwrap();
    let good = tiles(directory.path());
    for command in [&["merge", "out/s"][..], &RUN, &["verify", "out/s", "--repair"], &["status", "out/s"]] {
        let refused = squealmap(directory.path(), command);
        assert_eq!(refused.code, Some(2), "{command:?}: {}", refused.out);
        let said = unwrapped(&refused.err);
        assert!(said.contains("sweep.json`: its format is 3, which this version"), "{command:?}: {said}");
        assert_eq!(std::fs::read(&path).unwrap(), old.to_string().into_bytes(), "{command:?}");
    }
    assert!(tiles(directory.path()) == good, "no tile is moved");
}

/// Whoever computed tiles keeps them, whatever became of the file beside them that describes them.
#[test]
fn tiles_without_their_description_are_not_taken_for_rubbish() {
    let other = SWEEP.replace("mu_s = 0.4", "mu_s = 0.5");
    for spoil in [None, Some("{")] {
        let directory = with(SWEEP);
        squealmap(directory.path(), &RUN);
        let (good, csv) = (tiles(directory.path()), read(directory.path(), "map.csv"));
        let path = directory.path().join("out/s/tiles/sweep.json");
        match spoil {
            None => std::fs::remove_file(&path).unwrap(),
            Some(text) => std::fs::write(&path, text).unwrap(),
        }
        std::fs::write(directory.path().join("s.toml"), &other).unwrap();
        let refused = squealmap(directory.path(), &RUN);
        assert_eq!(refused.code, Some(2), "{}", refused.out);
        // Where no description is, the results say it.
        let words = match spoil {
            None => "`out/s` holds the results of another sweep",
            Some(_) => "is a good tile of another sweep",
        };
        assert!(unwrapped(&refused.err).contains(words), "{}", refused.err);
        assert!(tiles(directory.path()) == good && read(directory.path(), "map.csv") == csv);
        // What reads the directory says how the description is healed, and that is true.
        if spoil.is_some() {
            let said = squealmap(directory.path(), &["verify", "out/s", "--repair"]);
            assert!(unwrapped(&said.err).contains("run its sweep file once more"), "{}", said.err);
        }
        std::fs::write(directory.path().join("s.toml"), SWEEP).unwrap();
        let healed = squealmap(directory.path(), &RUN);
        assert_eq!(healed.code, Some(0), "{}", healed.err);
        assert!(healed.out.contains("nothing is left to do"), "{}", healed.out);
        assert_eq!(squealmap(directory.path(), &["verify", "out/s"]).code, Some(0));
        assert!(tiles(directory.path()) == good && read(directory.path(), "map.csv") == csv);
    }
}

/// A run that is stopped early in a directory that has lost tiles leaves the results of before, which have more.
#[test]
fn fuller_results_stay() {
    let undisturbed = with(&slow());
    assert_eq!(squealmap(undisturbed.path(), &SLOW).code, Some(0));
    let directory = undisturbed;
    let (csv, all) = (read(directory.path(), "map.csv"), tiles(directory.path()));
    for name in all.keys().skip(10) {
        std::fs::remove_file(directory.path().join("out/s/tiles").join(name)).unwrap();
    }
    let said = squealmap(directory.path(), &["verify", "out/s"]);
    let first_missing = all.keys().filter(|name| name.to_string_lossy().ends_with(".tile")).nth(10).unwrap();
    assert!(
        said.out.contains(&format!("missing      `out/s/tiles/{}`\n", first_missing.display())),
        "{}",
        said.out
    );
    let child = begin(directory.path(), &SLOW);
    while done(directory.path()) < 15 {
        sleep(Duration::from_micros(200));
    }
    send(&child, "INT");
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{err}");
    assert!(unwrapped(&err).contains("have more instances than the tiles there; they stay"), "{err}");
    assert!(read(directory.path(), "map.csv") == csv);
    assert_eq!(squealmap(directory.path(), &SLOW).code, Some(0));
    assert!(read(directory.path(), "map.csv") == csv && tiles(directory.path()) == all);
}

/// Where all instances are computed and their checks are not, the results are not yet those of the sweep.
#[test]
fn a_stop_during_the_checks_is_not_complete() {
    // One instance of few steps, which is checked with many.
    let directory = with(
        "analysis = [\"response\"]\n[friction]\nlaw = \"exponential\"\nmu_s = 0.5\nmu_d = 0.2\nstribeck_velocity = 1\n\
         [belt]\nbelt_velocity = 2\n[response]\nsettle = \"20000 periods\"\nmeasure = \"10 periods\"\nsteps_per_period = 3\n",
    );
    let run = ["run", "s.toml", "--backend", "cpu", "--precision", "f32", "--threads", "1"];
    let mut delay = Duration::from_millis(40);
    let said = loop {
        let mut child = begin(directory.path(), &run);
        sleep(delay);
        assert!(child.try_wait().unwrap().is_none(), "it ended before {delay:?}: no stop met the checks");
        send(&child, "TERM");
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if directory.path().join("out/s/manifest.json").exists() {
            assert_eq!(output.status.code(), Some(130), "{said}");
            break said;
        }
        delay = delay * 5 / 4;
    };
    assert!(unwrapped(&said).contains("stopped before the checks of 1 instances were done"), "{said}");
    let stopped = manifest(directory.path());
    assert_eq!(
        (&stopped["complete"], &stopped["computation"]["computed"]),
        (&Json::from(false), &Json::from(1))
    );
    assert_eq!(squealmap(directory.path(), &run).code, Some(0));
    let whole = manifest(directory.path());
    assert_eq!((&whole["complete"], &whole["computation"]["stopped"]), (&Json::from(true), &Json::Null));
    assert_ne!(whole["tiles"], stopped["tiles"]);
}

/// A figure is drawn of the description that the run has written, or not at all.
#[test]
fn plot_refuses_a_changed_manifest() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let path = directory.path().join("out/s/manifest.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let changed = text.replacen("\"title\": \"T", "\"title\": \"t", 1);
    assert_ne!(changed, text);
    std::fs::write(&path, changed).unwrap();
    let said = squealmap(directory.path(), &["plot", "out/s"]);
    assert_eq!(said.code, Some(2), "{}{}", said.out, said.err);
    assert!(unwrapped(&said.err).contains("its content does not have its checksum"), "{}", said.err);
}

/// What an export is written to beside its name may be a link: it goes, and what it points to stays.
#[cfg(unix)]
#[test]
fn an_export_leaves_what_links_point_to() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let mine = directory.path().join("mine");
    std::fs::create_dir(&mine).unwrap();
    std::fs::write(mine.join("zarr.json"), "mine").unwrap();
    for name in ["map.zarr.part", "map.zarr.old", "map.zarr"] {
        std::os::unix::fs::symlink(&mine, directory.path().join("out/s").join(name)).unwrap();
    }
    let ended = squealmap(directory.path(), &["export", "out/s", "--format", "zarr"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
    assert_eq!(std::fs::read_to_string(mine.join("zarr.json")).unwrap(), "mine");
    assert!(directory.path().join("out/s/map.zarr").symlink_metadata().unwrap().is_dir());
    assert_eq!(names(directory.path()).iter().filter(|name| name.contains("zarr")).count(), 1);
}

/// A manifest of which a part is missing has a sentence; found by fuzzing.
#[test]
fn a_manifest_without_its_analysis_is_named() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let mut damaged = manifest(directory.path());
    for of_the_whole in ["files", "checksum"] {
        damaged.as_object_mut().unwrap().remove(of_the_whole).unwrap();
    }
    damaged["spec"].as_object_mut().unwrap().remove("analysis").unwrap();
    std::fs::write(directory.path().join("out/s/manifest.json"), damaged.to_string()).unwrap();
    let said = squealmap(directory.path(), &["plot", "out/s"]);
    assert_eq!(said.code, Some(2), "{}{}", said.out, said.err);
    assert!(unwrapped(&said.err).contains("has no `analysis` in `spec`"), "{}", said.err);
}

#[test]
fn a_new_title_needs_no_new_tiles() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let good = tiles(directory.path());
    std::fs::write(directory.path().join("s.toml"), SWEEP.replace("Tiles", "Another title")).unwrap();
    let ended = squealmap(directory.path(), &RUN);
    assert!(ended.out.starts_with("0 of 300 instances"), "{}{}", ended.out, ended.err);
    assert!(String::from_utf8_lossy(&read(directory.path(), "map.svg")).contains("Another title"));
    assert!(tiles(directory.path()) == good);
}

#[test]
fn what_waits_heeds_a_signal_and_says_what_it_waits_for() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let out = directory.path().join("out/s");
    let store = Store::open(&out).unwrap();
    for (held, words) in [
        (out.join("manifest.json"), "waiting for another process that writes the results"),
        (store.path(4), "waiting for 1 tile(s) that other processes compute"),
    ] {
        std::fs::remove_file(store.path(4)).unwrap();
        let claim = Claim::take(&held).unwrap().unwrap();
        let mut child = begin(directory.path(), &RUN);
        sleep(Duration::from_millis(700));
        assert!(child.try_wait().unwrap().is_none(), "it waits");
        send(&child, "TERM");
        let asked = Instant::now();
        while child.try_wait().unwrap().is_none() {
            assert!(
                asked.elapsed() < Duration::from_secs(5),
                "{}: it does not heed the signal",
                held.display()
            );
            sleep(Duration::from_millis(10));
        }
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{err}");
        assert!(err.contains(words), "{words}: {err}");
        drop(claim);
        let ended = squealmap(directory.path(), &RUN);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
    }
}

#[test]
fn a_tile_is_some_seconds_of_work_whatever_an_instance_costs() {
    let by = |by_reference: bool, rest: &str| {
        let text = format!(
            "[friction]\nmu_s = 0.4\n[axes]\nmu_d = {{ from = 0, to = 0.4, points = 99 }}\n[belt]\nbelt_velocity = 3\n{rest}"
        );
        tile_of(&Spec::parse(&text, "s.toml", ".".as_ref()).unwrap(), by_reference)
    };
    let of = |rest: &str| by(false, rest);
    // 900 periods of 12 steps each: 1.2e8 steps hold 11 111 of them.
    let periods = "[response]\nsettle = \"600 periods\"\nmeasure = \"300 periods\"\n";
    assert_eq!(of(periods), 8192);
    // With 3 and with 1000 steps: 44 444 and 133. The reference takes 16 times as long: 694 with 12 steps.
    assert_eq!(of(&format!("{periods}steps_per_period = 3\n")), 32_768);
    assert_eq!(of(&format!("{periods}steps_per_period = 1000\n")), 128);
    assert_eq!(by(true, periods), 512);
    // 201 starts of 348 periods with 12 steps each: 8.4e5 steps, of which 1.2e8 hold 143.
    assert_eq!(
        of("[start]\nkind = \"box\"\nbox_samples = 200\nbox_velocity_from = -1\nbox_velocity_to = 1\n\
        box_displacement_from = 0\nbox_displacement_to = 0.01\n[response]\nsettle = \"auto\"\n"),
        128
    );
    assert_eq!(of("[response]\nsettle = \"1e6 periods\"\n"), 16);
}

/// A run that is stopped keeps what it has of a tile, and the next one goes on from there: nothing that was done is lost,
/// however early that one is stopped.
#[test]
fn a_stop_never_reduces_what_is_done() {
    for start in ["", "[start]\nkind = \"both\"\n"] {
        let text = slow().replace("\"20 periods\"", "\"60 periods\"") + start;
        let run = ["run", "s.toml", "--backend", "cpu", "--threads", "1", "--tile", "3000"];
        let undisturbed = with(&text);
        assert_eq!(squealmap(undisturbed.path(), &run).code, Some(0));
        let directory = with(&text);
        let mut kept = 0;
        for stop in 0..3 {
            let mut child = begin(directory.path(), &run);
            sleep(Duration::from_millis([300, 120, 60][stop]));
            if child.try_wait().unwrap().is_none() {
                send(&child, "INT");
            }
            let output = child.wait_with_output().unwrap();
            if output.status.code() == Some(0) {
                // The signal came too late: with what was kept the run is done, and nothing is kept aside any more.
                kept = 0;
                break;
            }
            assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
            let Ok(bytes) = std::fs::read(directory.path().join("out/s/manifest.json")) else { continue };
            let said: Json = serde_json::from_slice(&bytes).unwrap();
            let computed = said["computation"]["computed"].as_u64().unwrap();
            assert!(computed >= kept, "stop {stop}: {computed} after {kept}");
            let csv = String::from_utf8(read(directory.path(), "map.csv")).unwrap();
            let rows = csv.lines().skip(1).filter(|line| !line.ends_with(",not_computed")).count();
            assert_eq!((rows as u64, &said["complete"]), (computed, &Json::from(false)));
            kept = computed;
        }
        let status = squealmap(directory.path(), &["status", "out/s"]);
        assert!(kept == 0 || status.out.contains(&format!("kept       {kept} instances")), "{}", status.out);
        let ended = squealmap(directory.path(), &run);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(read(directory.path(), "map.csv") == read(undisturbed.path(), "map.csv"), "{start}");
        assert!(tiles(directory.path()) == tiles(undisturbed.path()), "{start}");
        assert_eq!(names(directory.path()), COMPLETE, "nothing is left");
    }
}

#[cfg(unix)]
#[test]
fn a_link_in_place_of_a_file_in_work_is_not_followed() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let tile = Store::open(&directory.path().join("out/s")).unwrap().path(2);
    let mine = directory.path().join("mine.txt");
    std::fs::write(&mine, "mine").unwrap();
    std::fs::remove_file(&tile).unwrap();
    std::os::unix::fs::symlink(&mine, format!("{}.part", tile.display())).unwrap();
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(1), "{}{}", ended.out, ended.err);
    assert!(unwrapped(&ended.err).contains(".tile.part` is a link or no file; remove it"), "{}", ended.err);
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine");
}

/// All that is kept goes through one door: no other file of the sources opens, writes or renames anything.
#[test]
fn nothing_passes_by_the_door() {
    // What a user names as input is read where it is parsed; the clock reads what the system says of itself.
    const READERS: [&str; 1] = ["src/sweep/accuracy/clock.rs"];
    const WORDS: [&str; 5] = ["std::fs", "fs::", "File::open", "OpenOptions", "tempfile"];
    const HOUSE: [&str; 3] = ["src", "crates/figure/src", "crates/identify/src"];
    let mut folders = HOUSE.map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).to_vec();
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name =
                path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap().to_string_lossy().replace('\\', "/");
            if name.starts_with("src/disk/") || READERS.contains(&name.as_str()) {
                continue;
            }
            seen += 1;
            let text = std::fs::read_to_string(&path).unwrap();
            for (line, code) in
                text.lines().enumerate().filter(|(_, code)| !code.trim_start().starts_with("//"))
            {
                let by = WORDS.iter().find(|word| {
                    code.match_indices(*word)
                        .any(|(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
                });
                assert!(
                    by.is_none() || code.contains("TryLockError"),
                    "{name}:{}: {}",
                    line + 1,
                    code.trim()
                );
            }
        }
    }
    assert!(seen > 200, "{seen} files");
}
