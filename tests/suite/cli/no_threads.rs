//! Machines that start no more threads, or have little memory: a sentence and an exit code, never a panic or a hang.
#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::cli::program::with_sweep;

/// A user whom limits bind, unlike root; nobody on most systems.
const USER: u32 = 65_534;

/// What the program may take, s: it computes six instances.
const LONGEST: Duration = Duration::from_mins(1);

/// Runs the program as a user who may have no more threads than it begins with, or within some KiB of memory. Gives the exit code and what it said.
fn limited(directory: &Path, limit: &str, arguments: &[&str]) -> (Option<i32>, String) {
    use std::os::unix::fs::PermissionsExt;
    use std::os::unix::process::CommandExt;

    std::fs::set_permissions(directory, std::fs::Permissions::from_mode(0o777)).unwrap();
    // Another place than the build's, which others may not read.
    let program = directory.join("squealmap");
    if !program.exists() {
        // By another process: a child that another test begins meanwhile would hold a file that is being written, which cannot be run.
        let copied = Command::new("cp").arg(env!("CARGO_BIN_EXE_squealmap")).arg(&program).status();
        assert!(copied.unwrap().success());
    }
    let root =
        std::fs::metadata("/proc/self").is_ok_and(|own| std::os::unix::fs::MetadataExt::uid(&own) == 0);
    let (said, told) = (directory.join("said"), directory.join("told"));
    let mut command = Command::new("bash");
    command
        .args(["-c", &format!("{limit} && exec \"$0\" \"$@\"")])
        .arg(&program)
        .args(arguments)
        .current_dir(directory)
        .env("NO_COLOR", "1")
        .env("RUST_BACKTRACE", "1")
        .stdin(Stdio::null())
        .stdout(std::fs::File::create(&said).unwrap())
        .stderr(std::fs::File::create(&told).unwrap());
    if root && limit.contains("-u") {
        command.uid(USER).gid(USER);
    }
    let mut child = command.spawn().unwrap();
    let began = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if began.elapsed() > LONGEST {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{arguments:?} under `{limit}` hangs: {}", std::fs::read_to_string(&told).unwrap());
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    (status.code(), std::fs::read_to_string(&told).unwrap())
}

#[test]
fn a_command_without_threads_computes_on_its_own() {
    let directory = with_sweep("");
    let commands: [&[&str]; 5] = [
        &["check", "small.toml"],
        &["run", "small.toml", "--backend", "cpu"],
        &["modes", "small.toml", "-o", "modes"],
        &["plot", "out/small"],
        &["export", "out/small", "--format", "csv"],
    ];
    for arguments in commands {
        let (code, told) = limited(directory.path(), "ulimit -u 1", arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {told}");
        assert!(
            told.contains("cannot be started: Resource temporarily unavailable"),
            "{arguments:?}: {told}"
        );
        assert!(!told.contains("panicked"), "{arguments:?}: {told}");
    }
    let csv = |at: &str| std::fs::read(directory.path().join(at).join("map.csv")).unwrap();
    let ended = crate::cli::program::squealmap(
        directory.path(),
        &["run", "small.toml", "--backend", "cpu", "-o", "many"],
    );
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(csv("out/small"), csv("many"));
}

/// A sweep of many tiles, some of whose instances are computed again.
fn with_many_tiles() -> TempDir {
    let directory = with_sweep("");
    let few = std::fs::read_to_string(directory.path().join("small.toml")).unwrap();
    let many = few.replace("points = 3", "points = 3000").replace("\"2 periods\"", "\"5 periods\"");
    std::fs::write(directory.path().join("many.toml"), many).unwrap();
    directory
}

/// Tiles are checked and written beside the computation of the next ones: by the threads of the command and one that writes.
#[test]
fn many_tiles_take_no_more_threads_than_were_asked_for() {
    let directory = with_many_tiles();
    for (threads, most) in [(1, 3), (2, 4)] {
        let mut run = Command::new(env!("CARGO_BIN_EXE_squealmap"))
            .args([
                "run",
                "many.toml",
                "--backend",
                "cpu",
                "--tile",
                "100",
                "--threads",
                &threads.to_string(),
            ])
            .args(["-o", &format!("by{threads}")])
            .current_dir(directory.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let tasks = format!("/proc/{}/task", run.id());
        let mut seen = 0;
        while run.try_wait().unwrap().is_none() {
            seen = seen.max(std::fs::read_dir(&tasks).map_or(0, Iterator::count));
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(run.wait().unwrap().success());
        assert_eq!(seen, most, "with {threads} threads");
    }
}

/// A user who may start only some threads more.
#[test]
fn many_tiles_need_no_thread_that_cannot_be_had() {
    let directory = with_many_tiles();
    for most in 3..7 {
        let output = format!("most{most}");
        let arguments = ["run", "many.toml", "--backend", "cpu", "--tile", "100", "-o", &output];
        let (code, told) = limited(directory.path(), &format!("ulimit -u {most}"), &arguments);
        assert!(code == Some(0) && !told.contains("panicked"), "{most}: {code:?} {told}");
    }
}

#[test]
fn threads_that_were_asked_for_and_cannot_be_had_are_an_error() {
    let directory = with_sweep("");
    let asked: [&[&str]; 2] = [
        &["run", "small.toml", "--threads", "3"],
        &["tradeoff", "small.toml", "--threads", "3", "--no-store"],
    ];
    for arguments in asked {
        let (code, told) = limited(directory.path(), "ulimit -u 1", arguments);
        assert_eq!(code, Some(1), "{arguments:?}: {told}");
        assert!(told.contains("error: cannot start"), "{arguments:?}: {told}");
        assert!(!told.contains("panicked"), "{arguments:?}: {told}");
    }
}

#[test]
fn little_memory_never_hangs() {
    let directory = with_sweep("");
    for kib in (28_000..40_000).step_by(700) {
        let limit = format!("ulimit -v {kib}");
        for threads in ["1", "2"] {
            let arguments = ["run", "small.toml", "--backend", "cpu", "--threads", threads];
            let (code, told) = limited(directory.path(), &limit, &arguments);
            // An abort has no code, but the words of the allocator. Where not even the signal stack of a thread can be had, the
            // standard library panics within the start of that thread, before any of our code, and aborts.
            let of_std = told.contains("failed to allocate an alternative stack") && code.is_none();
            assert!(of_std || !told.contains("panicked"), "{limit}, {threads}: {code:?} {told}");
        }
    }
}
