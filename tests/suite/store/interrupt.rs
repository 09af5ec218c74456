//! Ctrl-C in the middle of a run of the program.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Starts the program in `directory`, its output piped.
fn start(directory: &Path, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory)
        .env("NO_COLOR", "1")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Sends SIGINT to it, which is what Ctrl-C does.
fn interrupt(child: &Child) {
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(sent.success());
}

/// A sweep of `points` instances of a few milliseconds each.
fn sweep(points: usize) -> String {
    format!(
        "title = \"Long\"\n[friction]\nmu_s = 0.4\nmu_d = 0.3\n[axes]\n\
         belt_velocity = {{ from = 1, to = 3, points = {points} }}\n\
         [response]\nsettle = \"200 periods\"\nmeasure = \"100 periods\"\n"
    )
}

#[test]
fn what_is_done_is_written() {
    /// Half a minute of work or more.
    const POINTS: usize = 20_000;
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("long.toml"), sweep(POINTS)).unwrap();
    let mut child = start(directory.path(), &["run", "long.toml", "--backend", "cpu", "--threads", "2"]);
    let mut err = BufReader::new(child.stderr.take().unwrap());
    let mut said = String::new();
    while !said.contains(" left, ") {
        assert_ne!(err.read_line(&mut said).unwrap(), 0, "it ended before its first line: {said}");
    }
    interrupt(&child);
    // A second one changes nothing.
    interrupt(&child);
    let mut rest = String::new();
    err.read_to_string(&mut rest).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{rest}");

    let sentence = rest.lines().last().unwrap();
    let (done, end) = sentence.strip_prefix("stopped after ").unwrap().split_once(" of ").unwrap();
    let done: usize = done.parse().unwrap();
    assert!((1..POINTS).contains(&done), "{sentence}");
    assert_eq!(
        end,
        "20000 instances; wrote what is done, the others are `not_computed`; \
         run the same command again to compute the rest"
    );
    let out = String::from_utf8(output.stdout).unwrap();
    assert!(out.starts_with(&format!("{done} of 20000 instances in ")), "{out}");
    let row = out.lines().find(|line| line.starts_with("not_computed")).unwrap();
    assert!(row.ends_with(&(POINTS - done).to_string()), "{out}");

    let results = directory.path().join("out/long");
    let mut names: Vec<_> =
        std::fs::read_dir(&results).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["manifest.json", "map.csv", "map.png", "map.svg", "source.txt", "tiles"]);
    let csv = std::fs::read_to_string(results.join("map.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + POINTS);
    assert_eq!(csv.lines().filter(|line| line.ends_with(",not_computed")).count(), POINTS - done);
    assert_eq!(csv.lines().filter(|line| line.ends_with(",ok")).count(), done);
    let manifest: serde_json::Value =
        serde_json::from_slice(&std::fs::read(results.join("manifest.json")).unwrap()).unwrap();
    assert_eq!(manifest["complete"], false);
    assert_eq!(manifest["computation"]["computed"], done);
    assert_eq!(manifest["computation"]["stopped"], "cancelled");
    let svg = std::fs::read_to_string(results.join("map.svg")).unwrap();
    assert!(svg.trim_end().ends_with("</svg>") && svg.contains(">not computed "), "{}", svg.len());
    resvg::tiny_skia::Pixmap::decode_png(&std::fs::read(results.join("map.png")).unwrap()).unwrap();
}

/// Whether a process has a handler of SIGINT, the second bit of a mask that the system shows.
#[cfg(target_os = "linux")]
fn catches_interrupts(process: u32) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or_default();
    u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & 2 != 0)
}

#[cfg(target_os = "linux")]
#[test]
fn before_anything_is_done_nothing_is_left() {
    // So many points take longer to read than it takes to see that the signal is listened to.
    const POINTS: usize = 1_000_000;
    let directory = tempfile::tempdir().unwrap();
    let rows = "1\n".repeat(POINTS);
    std::fs::write(directory.path().join("points.csv"), "belt_velocity\n".to_owned() + &rows).unwrap();
    let text = "points = \"points.csv\"\n[friction]\nmu_s = 0.4\nmu_d = 0.3\n";
    std::fs::write(directory.path().join("long.toml"), text).unwrap();
    let child = start(directory.path(), &["run", "long.toml", "--backend", "cpu", "-o", "a/b"]);
    while !catches_interrupts(child.id()) {
        std::thread::sleep(Duration::from_millis(1));
    }
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let err = String::from_utf8(output.stderr).unwrap();
    assert!(err.ends_with("error: stopped after 0 of 1000000 instances; nothing was written\n"), "{err}");
    assert!(output.stdout.is_empty());
    assert!(!directory.path().join("a").exists(), "the directories that it made are removed");
}
