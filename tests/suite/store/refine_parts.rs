//! A refined map in parts: killed, spoilt, asked for once more, asked for by the sweep itself.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::TempDir;

use crate::cli::program::{squealmap, unwrapped};

/// A plane with response, long enough to be killed in.
pub(crate) const SWEEP: &str = "[friction]\nlaw = \"bilinear\"\nknee_velocity = 5.0\n[axes]\n\
    mu_s = { from = 0.0, to = 0.6, points = 65 }\nmu_d = { from = 0.0, to = 0.6, points = 65 }\n\
    [belt]\nbelt_velocity = 3.0\n[response]\nsettle = \"20 periods\"\nmeasure = \"20 periods\"\n";

/// The same asked for by the sweep itself.
const SECTION: &str = "[refine]\ncoarse = 8\nsample = 100\nseed = 7\n";

pub(crate) const REFINE: [&str; 10] =
    ["refine", "s.toml", "--coarse", "8", "--sample", "100", "--seed", "7", "--backend", "cpu"];

pub(crate) const FILES: [&str; 5] =
    ["boundaries.csv", "points.csv", "refine.json", "refined.png", "refined.svg"];

pub(crate) fn with(sweep: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
    directory
}

/// Parts of so few instances that there are many.
pub(crate) fn arguments<'a>(base: &[&'a str]) -> Vec<&'a str> {
    [base, &["--tile", "30", "--threads", "1"]].concat()
}

/// Refines without disturbance.
pub(crate) fn undisturbed() -> TempDir {
    let directory = with(SWEEP);
    let ended = squealmap(directory.path(), &arguments(&REFINE));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    directory
}

/// Names and bytes of the parts, sorted.
pub(crate) fn parts(directory: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let Ok(entries) = std::fs::read_dir(directory.join("out/s/parts")) else { return Vec::new() };
    let paths = entries.flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "tile")).collect();
    paths.sort();
    let name = |path: &Path| PathBuf::from(path.file_name().unwrap());
    paths.into_iter().map(|path| (name(&path), std::fs::read(&path).unwrap())).collect()
}

pub(crate) fn results(directory: &Path) -> Vec<Vec<u8>> {
    FILES.iter().map(|name| std::fs::read(directory.join("out/s").join(name)).unwrap()).collect()
}

/// Everything in the output directory but its parts.
fn names(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory.join("out/s")).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn killed_anywhere_it_goes_on_to_the_same_bytes() {
    let whole = undisturbed();
    let wanted = parts(whole.path());
    assert!(wanted.len() > 20, "{} parts", wanted.len());
    let directory = with(SWEEP);
    let mut stages = Vec::new();
    for kill in 1..=12 {
        let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
        command.args(arguments(&REFINE)).current_dir(directory.path());
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let least = wanted.len() * kill / 14;
        while parts(directory.path()).len() < least && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_micros(300));
        }
        // At any moment of a part.
        sleep(Duration::from_micros(700 * kill as u64));
        child.kill().unwrap();
        child.wait().unwrap();
        stages.push(parts(directory.path()).len());
    }
    assert!(stages.is_sorted(), "a finished part stays: {stages:?}");
    let met = stages.iter().filter(|done| (1..wanted.len()).contains(*done)).count();
    assert!(met >= 6, "most kills meet a refinement on its way: {stages:?}");
    let ended = squealmap(directory.path(), &arguments(&REFINE));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(!ended.err.contains("set aside"), "{}", ended.err);
    assert!(ended.out.contains(" of them before"), "{}", ended.out);
    assert!(parts(directory.path()) == wanted, "a part differs");
    assert!(results(directory.path()) == results(whole.path()), "results differ");
    assert_eq!(names(directory.path()), names(whole.path()), "nothing half-written is left");
}

#[test]
fn a_part_that_vanishes_meanwhile_is_computed_again() {
    let whole = undisturbed();
    let wanted = parts(whole.path());
    let directory = with(SWEEP);
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(arguments(&REFINE)).current_dir(directory.path());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while parts(directory.path()).len() < 5 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before a part was deleted");
        sleep(Duration::from_micros(300));
    }
    let gone = parts(directory.path()).remove(0).0;
    std::fs::remove_file(directory.path().join("out/s/parts").join(&gone)).unwrap();
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{err}");
    assert!(err.contains("was removed or changed meanwhile; it is computed again"), "{err}");
    let verified = squealmap(directory.path(), &["verify", "out/s"]);
    assert_eq!(verified.code, Some(0), "{}", verified.out);
    assert!(parts(directory.path()) == wanted && results(directory.path()) == results(whole.path()));
}

#[test]
fn what_is_there_is_not_computed_again() {
    let directory = undisturbed();
    let before = results(directory.path());
    let computed = |out: &str| -> Vec<usize> {
        let line = out.lines().next().unwrap().replace(',', " ");
        line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    let written =
        || std::fs::metadata(directory.path().join("out/s/refine.json")).unwrap().modified().unwrap();
    let first = written();
    let ended = squealmap(directory.path(), &arguments(&REFINE));
    assert!(ended.out.ends_with("nothing is left to do in out/s\n"), "{}", ended.out);
    assert_eq!(written(), first, "nothing is written either");
    std::fs::remove_file(directory.path().join("out/s/refined.svg")).unwrap();
    let ended = squealmap(directory.path(), &arguments(&REFINE));
    let [all, _, old] = computed(&ended.out)[..3] else { panic!("{}", ended.out) };
    assert_eq!(all, old, "{}", ended.out);
    assert!(results(directory.path()) == before);
    let status = squealmap(directory.path(), &["status", "out/s"]).out;
    let [_, counted] = computed(&status)[..2] else { panic!("{status}") };
    assert_eq!(counted, all, "{status}");
    // A larger sample begins after the lines, which are known.
    let more = [&REFINE[..4], &["--sample", "200", "--seed", "7", "--backend", "cpu"]].concat();
    let ended = squealmap(directory.path(), &arguments(&more));
    let [more, _, known] = computed(&ended.out)[..3] else { panic!("{}", ended.out) };
    assert!(known + 200 >= more && known < more, "{}", ended.out);
    // Another engine takes nothing over.
    let other = [&REFINE[..8], &["--backend", "cpu", "--precision", "f32"]].concat();
    let ended = squealmap(directory.path(), &arguments(&other));
    assert!(!ended.out.contains("before"), "{}", ended.out);
    assert!(ended.err.contains("parts of other sweeps"), "{}", ended.err);
}

#[test]
fn spoilt_parts_are_named_and_computed_again() {
    let whole = undisturbed();
    let wanted = parts(whole.path());
    let folder = whole.path().join("out/s/parts");
    let at = |number: usize| folder.join(&wanted[number].0);
    let bytes = |number: usize| wanted[number].1.clone();
    let mut flipped = bytes(1);
    let middle = flipped.len() / 2;
    flipped[middle] ^= 4;
    let spoilt = [
        (0, bytes(0)[..100].to_vec(), "bytes"),
        (1, flipped, "its checksum does not match"),
        (2, Vec::new(), "it is empty"),
        (3, bytes(4), "it belongs to another sweep"),
        (5, b"a text".to_vec(), "it is no tile"),
    ];
    for (number, content, _) in &spoilt {
        std::fs::write(at(*number), content).unwrap();
    }
    let before = results(whole.path());
    let ended = squealmap(whole.path(), &arguments(&REFINE));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for (number, _, why) in &spoilt {
        let name = wanted[*number].0.display().to_string();
        let line = ended.err.lines().find(|line| line.contains(&name)).unwrap_or_default();
        assert!(line.contains(why) && line.contains("computed again"), "{number}: {}", ended.err);
    }
    assert!(parts(whole.path()) == wanted && results(whole.path()) == before);
    assert_eq!(std::fs::read_dir(folder.join("bad")).unwrap().count(), spoilt.len());
    // Again, a directory in the place of one and a pipe in that of another: what was set aside stays there.
    std::fs::remove_file(at(0)).unwrap();
    std::fs::create_dir(at(0)).unwrap();
    std::fs::write(at(0).join("inside"), "kept").unwrap();
    std::fs::remove_file(at(1)).unwrap();
    assert!(Command::new("mkfifo").arg(at(1)).status().unwrap().success());
    let status = squealmap(whole.path(), &["status", "out/s"]);
    assert!(status.out.contains("done, 2 bad; its results are written"), "{}", status.out);
    let ended = squealmap(whole.path(), &arguments(&REFINE));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(ended.err.matches("it is no file; it is computed again").count(), 2, "{}", ended.err);
    assert!(parts(whole.path()) == wanted && results(whole.path()) == before);
    assert_eq!(std::fs::read_dir(folder.join("bad")).unwrap().count(), spoilt.len() + 2);
}

/// Results are all of one refinement, also where the disk is full at their end.
#[test]
fn a_full_disk_at_the_end_leaves_the_results_of_before() {
    let directory = undisturbed();
    let before = results(directory.path());
    let other = arguments(&["refine", "s.toml", "--coarse", "16", "--sample", "0", "--backend", "cpu"]);
    // Files of at most so many blocks of 512 bytes: parts fit, pictures do not.
    let script = "trap '' XFSZ; ulimit -f 50; exec \"$0\" \"$@\"";
    let mut limited = Command::new("sh");
    limited.args(["-c", script, env!("CARGO_BIN_EXE_squealmap")]).args(&other).current_dir(directory.path());
    let output = limited.output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("cannot write `out/s/"), "{err}");
    assert!(results(directory.path()) == before, "{err}");
    // They are still what they say, though another refinement was asked for since.
    let said = squealmap(directory.path(), &["verify", "out/s"]);
    assert_eq!(said.code, Some(0), "{}", said.out);
}

#[test]
fn what_cannot_be_refined_is_refused_by_check_too() {
    let one = "mu_d = 0.3\n[belt]\nbelt_velocity = 3.0\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 65 }\n[refine]\n";
    let directory = with(&format!("[friction]\nlaw = \"bilinear\"\nknee_velocity = 5.0\n{one}"));
    for command in ["check", "run"] {
        let ended = squealmap(directory.path(), &[command, "s.toml"]);
        assert_eq!(ended.code, Some(2), "{command}: {}", ended.out);
        assert!(unwrapped(&ended.err).contains("two numeric axes"), "{}", ended.err);
    }
    let bounds = "box_displacement_from = -0.1\nbox_displacement_to = 0.1\nbox_velocity_from = 0\nbox_velocity_to = 1\n";
    let boxed = with(&format!("{SWEEP}[start]\nkind = \"box\"\nbox_samples = 3\n{bounds}{SECTION}"));
    let checked = squealmap(boxed.path(), &["check", "s.toml"]);
    assert!(checked.out.contains("not from a box, which [refine] leaves out"), "{}", checked.out);
    let ended = squealmap(boxed.path(), &["run", "s.toml", "--backend", "cpu"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("no starts from a box"), "{}", ended.err);
}

#[test]
fn a_sweep_asks_for_it_itself() {
    let whole = undisturbed();
    let asked = with(&format!("{SWEEP}{SECTION}"));
    let ended = squealmap(asked.path(), &arguments(&["run", "s.toml", "--backend", "cpu"]));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(results(asked.path()) == results(whole.path()));
    // The keys of the section are what `refine` begins with, and its options come before them.
    let ended = squealmap(asked.path(), &["refine", "s.toml", "--backend", "cpu", "-o", "again"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let document = |directory: &str| -> serde_json::Value {
        let bytes = std::fs::read(asked.path().join(directory).join("refine.json")).unwrap();
        let mut document: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
        // How it was cut into parts is no matter of the results.
        for key in ["parts", "checksum", "sweep"] {
            assert!(document.as_object_mut().unwrap().remove(key).is_some(), "{key}");
        }
        document
    };
    assert_eq!(document("again"), document("out/s"));
    let options = ["refine", "s.toml", "--backend", "cpu", "--coarse", "16", "-o", "finer"];
    assert_eq!(squealmap(asked.path(), &options).code, Some(0));
    assert_eq!(document("finer")["coarse_cells_per_side"], 16);
    assert_eq!(document("finer")["sample"]["seed"], 7);
    let checked = squealmap(asked.path(), &["check", "s.toml"]);
    assert!(checked.out.contains("refines   from 8 cells along each side"), "{}", checked.out);

    for (options, says) in [
        (&["run", "s.toml", "--shard", "0/2"][..], "--shard cannot be used for a sweep with [refine]"),
        (&["run", "s.toml", "--accuracy", "draft"], "--accuracy cannot be used"),
        (&["run", "s.toml", "--reuse", "again"], "--reuse cannot be used"),
        (&["submit", "s.toml", "--slurm", "--dry-run"], "`submit` cannot be used"),
    ] {
        let ended = squealmap(asked.path(), &[options, &["-o", "none"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(unwrapped(&ended.err).contains(says), "{}", ended.err);
    }
    for (section, says) in [
        ("[refine]\ncoarse = 1\n", "`coarse` in [refine] is 1 but must be an integer between 2 and 4096"),
        ("[refine]\nseed = -1\n", "`seed` in [refine] is -1"),
        ("[refine]\nlevels = 3\n", "unknown key `levels` in [refine]"),
        ("refine = true\n", "a table, written as a line [refine]"),
        ("[start]\ncoarse = 8\n", "it belongs to [refine]"),
    ] {
        let text =
            if section.starts_with('[') { format!("{SWEEP}{section}") } else { format!("{section}{SWEEP}") };
        let wrong = with(&text);
        let ended = squealmap(wrong.path(), &["run", "s.toml", "-o", "none"]);
        assert_eq!(ended.code, Some(2), "{section}: {}", ended.err);
        assert!(unwrapped(&ended.err).contains(says), "{section}: {}", ended.err);
    }
    assert!(!asked.path().join("none").exists(), "nothing is left");
}
