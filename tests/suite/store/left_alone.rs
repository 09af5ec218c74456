//! What a command leaves as it is: files that its user may not read, what another sweep has kept, results when it is to stop.
#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs::{self, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::cli::program::{squealmap, unwrapped};
use crate::store::resume::{SWEEP, tiles, with};
use crate::store::submit::copy_program;

/// 10 tiles of 32 instances.
const RUN: [&str; 6] = ["run", "s.toml", "--backend", "cpu", "--tile", "32"];

/// A user whom permissions bind; nobody on most systems.
const NOBODY: u32 = 65_534;

fn mode(path: &Path, mode: u32) {
    fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
}

/// Runs the program as a user who may write in `out/s` and may not read files of mode 000: exit code and what it said.
fn as_another(directory: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let program = directory.join("program");
    if !program.exists() {
        copy_program(Path::new(env!("CARGO_BIN_EXE_squealmap")), &program);
    }
    let mut command = Command::new(program);
    if fs::metadata(directory).unwrap().uid() == 0 {
        command.uid(NOBODY).gid(NOBODY);
    }
    let output = command.args(arguments).current_dir(directory).env("NO_COLOR", "1").output().unwrap();
    (output.status.code(), unwrapped(&String::from_utf8_lossy(&output.stderr)))
}

#[test]
fn what_cannot_be_read_may_be_good() {
    let directory = with(SWEEP);
    let top = directory.path();
    assert_eq!(squealmap(top, &RUN).code, Some(0));
    let other = SWEEP.replace("mu_s = 0.4", "mu_s = 0.5");
    fs::write(top.join("other.toml"), other).unwrap();
    let before = tiles(top);
    let out = top.join("out/s");
    mode(top, 0o755);
    mode(&out, 0o777);
    mode(&out.join("tiles"), 0o777);
    let tile = out.join("tiles").join(before.keys().nth(3).unwrap());
    let description = out.join("tiles/sweep.json");
    let refused = |arguments: &[&str]| {
        let (code, said) = as_another(top, arguments);
        assert_eq!(code, Some(1), "{arguments:?}: {said}");
        assert!(said.contains("Permission denied"), "{arguments:?}: {said}");
        assert!(said.contains("it may be good and is left as it is"), "{arguments:?}: {said}");
        assert!(!out.join("tiles/bad").exists(), "{arguments:?}");
    };
    for hidden in [&tile, &description] {
        mode(hidden, 0o000);
        refused(&RUN);
        refused(&["merge", "out/s"]);
        refused(&["verify", "out/s", "--repair"]);
        refused(&["export", "out/s", "--format", "csv"]);
        mode(hidden, 0o644);
        assert!(tiles(top) == before);
    }
    // Nothing says whose tiles these are, neither their description nor results beside them.
    let text = fs::read(&description).unwrap();
    for gone in [&description, &out.join("manifest.json"), &out.join("map.csv")] {
        fs::remove_file(gone).unwrap();
    }
    mode(&tile, 0o000);
    for (name, _) in before.iter().filter(|(name, _)| !tile.ends_with(name)) {
        fs::rename(out.join("tiles").join(name), top.join(name)).unwrap();
    }
    refused(&["run", "other.toml", "--backend", "cpu", "--tile", "32", "-o", "out/s"]);
    mode(&tile, 0o644);
    for (name, _) in before.iter().filter(|(name, _)| !tile.ends_with(name)) {
        fs::rename(top.join(name), out.join("tiles").join(name)).unwrap();
    }
    fs::write(&description, text).unwrap();
    let ended = squealmap(top, &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(tiles(top) == before);
}

/// Of a sweep that was stopped within its first tile nothing is whole yet.
#[test]
fn what_another_sweep_has_kept_is_not_given_up() {
    let slow = SWEEP.replace("points = 15", "points = 150").replace("\"2 periods\"", "\"60 periods\"");
    let directory = with(&slow);
    let top = directory.path();
    let run = ["run", "s.toml", "--backend", "cpu", "--threads", "1", "--tile", "2000"];
    fs::write(top.join("other.toml"), SWEEP).unwrap();
    let kept = || {
        let names = fs::read_dir(top.join("out/s/tiles")).into_iter().flatten().flatten();
        let is_kept = |path: &Path| path.extension().is_some_and(|end| end == "some");
        names.map(|entry| entry.path()).filter(|path| is_kept(path)).collect::<Vec<_>>()
    };
    let mut delay = Duration::from_millis(50);
    while kept().is_empty() {
        let mut child = begin(top, &run);
        sleep(delay);
        send(&mut child);
        drop(child.wait_with_output());
        let none = !top.join("out/s/tiles").is_dir() || tiles(top).is_empty();
        assert!(none, "a tile was done before {delay:?}: no stop met the first");
        delay = delay * 5 / 4;
    }
    let files = kept();
    let bytes: Vec<_> = files.iter().map(|path| fs::read(path).unwrap()).collect();
    let csv = fs::read(top.join("out/s/map.csv")).unwrap();
    let ended = squealmap(top, &["run", "other.toml", "--backend", "cpu", "--tile", "32", "-o", "out/s"]);
    assert_eq!(ended.code, Some(2), "{}{}", ended.out, ended.err);
    let said = unwrapped(&ended.err);
    assert!(said.contains("`out/s` holds the results of another sweep, program version or engine"), "{said}");
    assert!(said.contains("0 of 2 tiles, ") && said.contains(" instances kept of others"), "{said}");
    assert_eq!(files.iter().map(|path| fs::read(path).unwrap()).collect::<Vec<_>>(), bytes);
    assert!(fs::read(top.join("out/s/map.csv")).unwrap() == csv);
}

fn begin(directory: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(arguments).current_dir(directory).stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Asks a process to stop, as a scheduler does.
fn send(child: &mut Child) {
    if child.try_wait().unwrap().is_none() {
        let sent = Command::new("sh").args(["-c", &format!("kill -TERM {}", child.id())]).status().unwrap();
        assert!(sent.success());
    }
}

/// The results of millions of instances take minutes.
#[test]
fn what_writes_results_heeds_a_signal() {
    let directory = with(
        "analysis = [\"linear\"]\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = { from = 0.1, to = 0.4, points = 400 }\n\
         belt_velocity = { from = 1, to = 8, points = 1000 }\n",
    );
    let top = directory.path();
    let run = ["run", "s.toml", "--backend", "cpu", "--tile", "1000"];
    let shard = [&run[..], &["--shard", "0/1"]].concat();
    assert_eq!(squealmap(top, &shard).code, Some(0));
    let out = top.join("out/s");
    for (command, words) in [
        (&["merge", "out/s"][..], "stopped; the tiles that were brought stay, and no results are written"),
        (&run[..], "stopped while the results were written; all tiles are in out/s"),
    ] {
        let mut child = begin(top, command);
        while !out.join("map.csv.part").metadata().is_ok_and(|file| file.len() > 0) {
            assert!(child.try_wait().unwrap().is_none(), "{command:?} ended before it was to stop");
            sleep(Duration::from_micros(200));
        }
        send(&mut child);
        let output = child.wait_with_output().unwrap();
        let said = unwrapped(&String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.status.code(), Some(130), "{command:?}: {said}");
        assert!(said.contains(words), "{command:?}: {said}");
        let mut left: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        left.sort();
        assert_eq!(left, ["source.txt", "tiles"], "{command:?} leaves no results");
    }
    let ended = squealmap(top, &["merge", "out/s"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
}
