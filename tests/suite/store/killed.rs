//! Runs that end in the middle: kill -9, a full disk, a directory that is gone.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::cli::program::squealmap;
use crate::store::resume::{COMPLETE, SWEEP, names, tiles, with};

/// Of 10 instances.
const TILES: f64 = 300.0;

pub(crate) const RUN: [&str; 8] = ["run", "s.toml", "--backend", "cpu", "--tile", "10", "--threads", "1"];

pub(crate) fn sweep() -> String {
    SWEEP.replace("points = 15", "points = 150").replace("\"2 periods\"", "\"20 periods\"")
}

fn start(directory: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(RUN).current_dir(directory).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

/// Tiles that are there by now.
pub(crate) fn done(directory: &Path) -> usize {
    let Ok(entries) = std::fs::read_dir(directory.join("out/s/tiles")) else { return 0 };
    entries.flatten().filter(|entry| entry.file_name().to_string_lossy().ends_with(".tile")).count()
}

/// Kills `processes` at a time at `kills` moments, then lets one of them come to its end; compares with a run that
/// nobody disturbed.
fn kill_and_resume(sweep: &str, processes: usize, kills: usize) {
    let undisturbed = with(sweep);
    assert_eq!(squealmap(undisturbed.path(), &RUN).code, Some(0));
    let directory = with(sweep);
    // A linear congruential sequence: moments that differ, the same in every run of the test.
    let mut state = 12_345_u64;
    let mut random = |below: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        below * (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    let mut stages = Vec::new();
    for _ in 0..kills {
        let before = done(directory.path());
        let mut children: Vec<Child> = (0..processes).map(|_| start(directory.path())).collect();
        // Some in their beginning, most after some tiles, at any moment of one.
        let wanted = before as f64 + random(2.0 * TILES / kills as f64) - 3.0;
        let first = &mut children[0];
        while (done(directory.path()) as f64) < wanted && first.try_wait().unwrap().is_none() {
            sleep(Duration::from_micros(200));
        }
        for child in &mut children {
            sleep(Duration::from_secs_f64(random(0.004)));
            // It may have come to its end.
            let _ = child.kill();
        }
        for mut child in children {
            drop(child.wait());
        }
        stages.push(done(directory.path()));
    }
    assert!(stages.is_sorted(), "a finished tile stays: {stages:?}");
    let met = stages.iter().filter(|done| (1..300).contains(*done)).count();
    assert!(2 * met >= kills, "most kills meet a run on its way: {stages:?}");
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(!ended.err.contains("set aside"), "{}", ended.err);
    assert!(tiles(directory.path()) == tiles(undisturbed.path()), "a tile differs");
    let read = |directory: &Path, name: &str| std::fs::read(directory.join("out/s").join(name)).unwrap();
    for name in ["map.csv", "map.svg", "map.png", "tiles/sweep.json"] {
        assert!(read(directory.path(), name) == read(undisturbed.path(), name), "{name} differs");
    }
    let left: Vec<String> = names(directory.path());
    assert_eq!(left, COMPLETE, "nothing half-written is left");
}

#[test]
fn killed_ten_times() {
    kill_and_resume(&sweep(), 1, 10);
}

#[test]
fn four_processes_killed_ten_times() {
    kill_and_resume(&sweep(), 4, 10);
}

#[test]
#[ignore = "takes a minute: cargo test --release --test suite -- --ignored killed_fifty"]
fn killed_fifty_times() {
    // Tiles so slow that a few of them pass while a process is killed.
    let slow = sweep().replace("\"20 periods\"", "\"200 periods\"");
    kill_and_resume(&slow, 1, 50);
    kill_and_resume(&slow, 4, 50);
}

#[test]
fn after_ctrl_c_the_same_command_goes_on() {
    stopped_by("INT");
}

#[test]
fn after_the_signal_of_a_scheduler_the_same_command_goes_on() {
    stopped_by("TERM");
}

/// Ends a run by a signal, then lets the same command go on; compares with a run that nobody disturbed.
fn stopped_by(signal: &str) {
    let undisturbed = with(&sweep());
    assert_eq!(squealmap(undisturbed.path(), &RUN).code, Some(0));
    let directory = with(&sweep());
    let mut child = start(directory.path());
    while done(directory.path()) < 20 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was interrupted");
        sleep(Duration::from_micros(200));
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status().unwrap();
    assert!(sent.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let kept = done(directory.path());
    let there = names(directory.path()).into_iter().filter(|name| !name.contains(".some"));
    assert_eq!(there.collect::<Vec<_>>(), COMPLETE, "the results of what is done are there");
    let csv = std::fs::read_to_string(directory.path().join("out/s/map.csv")).unwrap();
    let missing = csv.lines().filter(|line| line.ends_with(",not_computed")).count();
    assert_eq!(csv.lines().count(), 3001);
    // What was done of the tiles in work counts too: of seven, which keep one thread busy.
    assert!((3000 - 10 * kept - 70..=3000 - 10 * kept).contains(&missing), "{kept} tiles, {missing} missing");
    let ended = squealmap(directory.path(), &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    // What was kept of them is not computed again.
    assert!(ended.out.starts_with(&format!("{missing} of 3000 instances in ")), "{}", ended.out);
    let whole = std::fs::read(undisturbed.path().join("out/s/map.csv")).unwrap();
    assert!(std::fs::read(directory.path().join("out/s/map.csv")).unwrap() == whole);
}

#[test]
fn a_full_disk_leaves_finished_tiles() {
    let directory = with(&sweep());
    // Files of at most 4 blocks of 512 bytes: no tile fits; the signal is ignored, so that the write fails as on
    // a full disk.
    let script = "trap '' XFSZ; ulimit -f 4; exec \"$0\" \"$@\"";
    let program = env!("CARGO_BIN_EXE_squealmap");
    // One tile is there before.
    let run = [&RUN[..4], &["--tile", "2000", "--threads", "1"]].concat();
    let first = squealmap(directory.path(), &run);
    assert_eq!(first.code, Some(0), "{}", first.err);
    let tile = std::fs::read_dir(directory.path().join("out/s/tiles")).unwrap();
    let mut paths: Vec<_> = tile.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "tile"));
    paths.sort();
    std::fs::remove_file(&paths[1]).unwrap();
    let kept = std::fs::read(&paths[0]).unwrap();
    let mut limited = Command::new("sh");
    limited.args(["-c", script, program]).args(&run).current_dir(directory.path());
    let output = limited.output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(
        err.contains("; 1 of 2 tiles are done and stay; run the same command again when this is put right"),
        "{err}"
    );
    assert!(std::fs::read(&paths[0]).unwrap() == kept && !paths[1].exists());
    assert_eq!(names(directory.path()), COMPLETE, "nothing half-written is left");
    let ended = squealmap(directory.path(), &run);
    assert!(
        ended.code == Some(0) && ended.out.contains("1000 of 3000 instances in "),
        "{}{}",
        ended.out,
        ended.err
    );
}

#[test]
fn a_directory_that_is_gone_ends_the_run() {
    let directory = with(&sweep());
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(RUN).current_dir(directory.path()).stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    let results = directory.path().join("out");
    while std::fs::read_dir(results.join("s/tiles")).map_or(0, Iterator::count) < 20 {
        sleep(Duration::from_millis(1));
    }
    while results.exists() {
        let _ = std::fs::remove_dir_all(&results);
    }
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("error: cannot write `out/s/tiles/"), "{err}");
    assert!(err.contains("No such file or directory"), "{err}");
}
