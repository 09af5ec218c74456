//! Several processes in one directory while somebody damages, deletes and locks its files, stops and kills processes, and
//! moves the directory. One thing holds throughout: results that say they are complete are those of an undisturbed run.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::cli::program::squealmap;
use crate::store::killed::{RUN, sweep};
use crate::store::resume::with;
use squealmap::store::claim::Claim;
use tempfile::TempDir;

/// What the results of an undisturbed run are.
struct Wanted {
    directory: TempDir,
}

impl Wanted {
    fn new(sweep: &str) -> Wanted {
        let directory = with(sweep);
        let ended = squealmap(directory.path(), &RUN);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        Wanted { directory }
    }

    /// Whether the results in a directory may stand there; panics where they lie. Files are written one after the other, so
    /// that only what has a manifest before and after they were read is compared.
    fn judge(&self, out: &Path) -> bool {
        let read = |name: &str| std::fs::read(out.join(name));
        let Ok(manifest) = read("manifest.json") else { return false };
        let files = ["map.csv", "map.svg", "map.png"].map(|name| (name, read(name)));
        if read("manifest.json").ok().as_ref() != Some(&manifest) {
            return false;
        }
        let document: serde_json::Value = serde_json::from_slice(&manifest).unwrap();
        if document["complete"] != true {
            return false;
        }
        for (name, bytes) in files {
            let wanted = std::fs::read(self.directory.path().join("out/s").join(name)).unwrap();
            let found = bytes.unwrap_or_else(|why| panic!("complete, and {name} is not there: {why}"));
            assert!(found == wanted, "complete, and {name} differs in {} bytes", found.len());
            assert!(!String::from_utf8_lossy(&found).contains(",not_computed"), "{name}");
        }
        true
    }
}

fn start(directory: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(RUN).current_dir(directory).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{name} {} 2>/dev/null", child.id())]).status();
    sent.unwrap();
}

/// A linear congruential sequence.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % count.max(1)
    }
}

/// The tiles that are there.
fn tiles(out: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(out.join("tiles")).map(|entries| entries.flatten().map(|entry| entry.path()));
    let Ok(paths) = entries else { return Vec::new() };
    let mut tiles: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "tile")).collect();
    tiles.sort();
    tiles
}

/// One mischief.
fn disturb(dice: &mut Dice, directory: &Path, children: &mut [Child]) -> &'static str {
    let out = directory.join("out/s");
    let there = tiles(&out);
    let tile = (!there.is_empty()).then(|| there[dice.below(there.len())].clone());
    let child = dice.below(children.len());
    match (dice.below(9), tile) {
        (0 | 1, Some(tile)) => {
            let _ = std::fs::remove_file(tile);
            "a tile deleted"
        }
        (2, Some(tile)) => {
            if let Ok(mut bytes) = std::fs::read(&tile) {
                let at = dice.below(bytes.len());
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1;
                }
                let _ = std::fs::write(tile, bytes);
            }
            "a tile damaged"
        }
        (3, Some(tile)) => {
            let bytes = std::fs::read(&tile).unwrap_or_default();
            let _ = std::fs::write(tile, &bytes[..bytes.len() / 2]);
            "a tile cut"
        }
        (4, Some(tile)) => {
            if let Ok(Some(claim)) = Claim::take(&tile) {
                sleep(Duration::from_millis(20));
                drop(claim);
            }
            "a tile locked"
        }
        (5, _) => {
            signal(&children[child], "STOP");
            sleep(Duration::from_millis(30));
            signal(&children[child], "CONT");
            "a process stopped for a while"
        }
        (6, _) => {
            let _ = children[child].kill();
            let _ = children[child].wait();
            children[child] = start(directory);
            "a process killed and another one started"
        }
        // Mostly the end of all who write there.
        (7, _) if dice.below(8) == 0 => {
            let aside = directory.join("out/aside");
            if std::fs::rename(&out, &aside).is_ok() {
                sleep(Duration::from_millis(10));
                // Where a process has made the directory anew by now, the old one is lost with its tiles.
                if std::fs::rename(&aside, &out).is_err() {
                    let _ = std::fs::remove_dir_all(&aside);
                }
            }
            "the directory moved and back"
        }
        _ => {
            let name = ["map.csv", "map.svg", "map.png"][dice.below(3)];
            // A damage after the results were written is seen by the next run, not by a reader of the files.
            let _ = std::fs::remove_file(out.join(format!("{name}.part")));
            "a file in work removed"
        }
    }
}

/// Disturbs runs of some processes until all have ended, `rounds` times; then one comes to its end undisturbed.
fn turmoil(processes: usize, rounds: usize, seed: u64) {
    let wanted = Wanted::new(&sweep());
    let mut dice = Dice(seed);
    let mut complete = 0;
    for round in 0..rounds {
        let directory = with(&sweep());
        let out = directory.path().join("out/s");
        let mut children: Vec<Child> = (0..processes).map(|_| start(directory.path())).collect();
        let mut told = Vec::new();
        let began = Instant::now();
        let mut left = 30;
        while children.iter_mut().any(|child| child.try_wait().unwrap().is_none()) {
            assert!(began.elapsed() < Duration::from_mins(1), "round {round}: they hang after {told:?}");
            if left > 0 {
                told.push(disturb(&mut dice, directory.path(), &mut children));
                left -= 1;
            }
            sleep(Duration::from_millis(3 + dice.below(12) as u64));
        }
        for child in children {
            let output = child.wait_with_output().unwrap();
            let err = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(!err.contains("panicked") && output.status.code() != Some(101), "{told:?}: {err}");
        }
        complete += usize::from(wanted.judge(&out));
        let ended = squealmap(directory.path(), &RUN);
        assert_eq!(ended.code, Some(0), "round {round}, {told:?}: {}", ended.err);
        assert!(wanted.judge(&out), "round {round}, {told:?}: the last run leaves complete results");
        let verified = squealmap(directory.path(), &["verify", "out/s"]);
        assert_eq!(verified.code, Some(0), "round {round}, {told:?}: {}{}", verified.out, verified.err);
    }
    assert!(complete > 0, "some of the disturbed runs come to an end of their own");
    println!("{complete} of {rounds} rounds with {processes} processes were complete before the last run");
}

#[test]
fn two_processes_in_turmoil() {
    turmoil(2, 4, 1);
}

#[test]
fn three_processes_in_turmoil() {
    turmoil(3, 4, 2);
}

#[test]
#[ignore = "takes minutes: cargo test --release --test suite -- --ignored turmoil"]
fn long_turmoil() {
    turmoil(2, 60, 3);
    turmoil(3, 60, 4);
}
