//! Machines that start no more threads, or have little memory: a sentence and an exit code, never a panic or a hang.
#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

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
        std::fs::copy(env!("CARGO_BIN_EXE_squealmap"), &program).unwrap();
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
