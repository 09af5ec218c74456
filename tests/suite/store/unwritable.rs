//! Directories that can no longer be written in the middle of a run: read-only, gone, or a file in their place.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs::{self, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::cli::program::squealmap;
use crate::store::killed::{RUN, done, sweep};
use crate::store::resume::{COMPLETE, names, tiles, with};
use crate::store::submit::copy_program;

/// A user whom permissions bind; nobody on most systems.
const NOBODY: u32 = 65_534;

/// Starts the sweep, does `spoil` to the directory when some tiles are done, expects an error that has all of the
/// `words` in it, undoes it by `mend`, and lets the same command go on: tiles that were done stay byte by byte, and
/// the rest becomes that of a run that nobody disturbed.
fn disturbed(spoil: &dyn Fn(&Path), mend: &dyn Fn(&Path), words: &[&str]) {
    let undisturbed = with(&sweep());
    assert_eq!(squealmap(undisturbed.path(), &RUN).code, Some(0));
    let directory = with(&sweep());
    let top = directory.path();
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    // Root writes everywhere, so the program runs as somebody else then, from where that user may read it.
    if fs::metadata(top).unwrap().uid() == 0 {
        let copy = top.join("program");
        copy_program(Path::new(env!("CARGO_BIN_EXE_squealmap")), &copy);
        command = Command::new(copy);
        fs::set_permissions(top, Permissions::from_mode(0o755)).unwrap();
        fs::create_dir(top.join("out")).unwrap();
        chown(top.join("out"), Some(NOBODY), Some(NOBODY)).unwrap();
        command.uid(NOBODY).gid(NOBODY);
    }
    command.args(RUN).current_dir(top).env("NO_COLOR", "1").stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    while done(top) < 20 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was disturbed");
        sleep(Duration::from_micros(200));
    }
    spoil(top);
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    mend(top);
    assert_eq!(output.status.code(), Some(1), "{err}");
    for word in words {
        assert!(err.contains(word), "{word}: {err}");
    }
    let (kept, wanted) = (tiles(top), tiles(undisturbed.path()));
    assert!((20..300).contains(&kept.len()), "{} tiles", kept.len());
    assert!(kept.iter().all(|(name, bytes)| wanted[name] == *bytes), "a finished tile was damaged");
    let ended = squealmap(top, &RUN);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(!ended.err.contains("set aside"), "{}", ended.err);
    assert!(tiles(top) == wanted, "a tile differs");
    assert_eq!(names(top), COMPLETE, "nothing half-written is left");
}

#[test]
fn a_directory_that_becomes_read_only() {
    let mode = |directory: &Path, mode| {
        fs::set_permissions(directory.join("out/s/tiles"), Permissions::from_mode(mode)).unwrap();
    };
    disturbed(
        &|directory| mode(directory, 0o555),
        &|directory| mode(directory, 0o755),
        &[
            "cannot write `out/s/tiles/",
            "Permission denied",
            "of 300 tiles are done and stay; run the same command again",
        ],
    );
}

#[test]
fn a_directory_that_goes_and_comes_back() {
    let (here, away) = ("out/s", "out/away");
    let move_it = |directory: &Path, from: &str, to: &str| {
        fs::rename(directory.join(from), directory.join(to)).unwrap();
    };
    disturbed(
        &|directory| move_it(directory, here, away),
        &|directory| move_it(directory, away, here),
        &["cannot write `out/s/tiles/", "No such file or directory", "run the same command again"],
    );
}

#[test]
fn a_file_in_the_place_of_a_directory() {
    disturbed(
        &|directory| {
            // A run that fails removes an empty output directory that it made; here it would be gone too early.
            fs::write(directory.join("out/s/stays"), "").unwrap();
            fs::rename(directory.join("out/s/tiles"), directory.join("away")).unwrap();
            fs::write(directory.join("out/s/tiles"), "").unwrap();
        },
        &|directory| {
            fs::remove_file(directory.join("out/s/tiles")).unwrap();
            fs::rename(directory.join("away"), directory.join("out/s/tiles")).unwrap();
            fs::remove_file(directory.join("out/s/stays")).unwrap();
        },
        &["cannot write `out/s/tiles/", "run the same command again"],
    );
}
