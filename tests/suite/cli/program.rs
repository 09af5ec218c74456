//! The program itself: exit codes, messages, and what it leaves on the disk.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::says_mode_coupling;
use tempfile::TempDir;

/// What a run of the program said and left behind.
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Runs the program in `directory`.
pub(crate) fn squealmap(directory: &Path, arguments: &[&str]) -> Ended {
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory)
        .env("NO_COLOR", "1")
        // What a user has measured must not decide a test.
        .env("XDG_CACHE_HOME", directory.join("no-cache"))
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Ended { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// An error report without its breaks of lines.
pub(crate) fn unwrapped(err: &str) -> String {
    err.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

/// A directory with a small sweep `small.toml` (with `extra` in `[model]`) in it.
pub(crate) fn with_sweep(extra: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let sweep = format!(
        "title = \"Small\"\n[model]\n{extra}\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = {{ values = [0.3, 0.4] }}\n\
         belt_velocity = {{ from = 1, to = 3, points = 3 }}\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n"
    );
    std::fs::write(directory.path().join("small.toml"), sweep).unwrap();
    directory
}

/// Everything in a directory tree, relative to it.
pub(crate) fn tree(directory: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    let mut open = vec![directory.to_owned()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path.clone());
            }
            paths.push(path.strip_prefix(directory).unwrap().to_owned());
        }
    }
    paths.sort();
    paths
}

fn only_the_sweep(directory: &TempDir) {
    assert_eq!(tree(directory.path()), [PathBuf::from("small.toml")]);
}

#[test]
fn run_writes_all_files_and_counts() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["run", "small.toml", "--threads", "2"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let files = ["manifest.json", "map.csv", "map.png", "map.svg", "source.txt", "tiles", "tiles/sweep.json"];
    let mut found = tree(directory.path());
    let tile = found.iter().position(|path| path.to_string_lossy().ends_with(".tile")).unwrap();
    assert!(found.remove(tile).starts_with("out/small/tiles"));
    let expected: Vec<PathBuf> = ["out".into(), "out/small".into()]
        .into_iter()
        .chain(files.iter().map(|name| Path::new("out/small").join(name)))
        .chain(["small.toml".into()])
        .collect();
    found.sort();
    assert_eq!(found, expected);
    assert!(ended.out.starts_with("6 instances in "), "{}", ended.out);
    assert!(ended.out.contains("wrote out/small/map.csv\n"), "{}", ended.out);
    let csv = std::fs::read_to_string(directory.path().join("out/small/map.csv")).unwrap();
    assert_eq!(csv.lines().count(), 7);
    assert!(csv.starts_with("instance,mu_d,belt_velocity,type,"), "{csv}");
    // Not a terminal: lines, no bar.
    assert!(!ended.err.contains('\r'), "{}", ended.err);
}

#[test]
fn output_may_be_placed_anywhere() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["run", "small.toml", "-o", "a/b"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(directory.path().join("a/b/map.svg").is_file());
    assert!(!directory.path().join("out").exists());
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let directory = with_sweep("");
    for (threads, output) in [("1", "one"), ("3", "three")] {
        squealmap(directory.path(), &["run", "small.toml", "--threads", threads, "-o", output]);
    }
    let read = |output: &str| std::fs::read(directory.path().join(output).join("map.csv")).unwrap();
    assert_eq!(read("one"), read("three"));
}

#[test]
fn bad_input_ends_with_2_and_writes_nothing() {
    let directory = with_sweep("m1 = -1");
    for command in ["run", "check", "modes", "trace"] {
        let ended = squealmap(directory.path(), &[command, "small.toml"]);
        assert_eq!(ended.code, Some(2), "{command}: {}", ended.err);
        let first = ended.err.lines().next().unwrap();
        assert_eq!(
            first,
            "error: small.toml:3:6: `m1` in [model] is -1 but must be a finite number greater than 0"
        );
        // The place is shown and underlined.
        assert!(ended.err.contains("m1 = -1\n") && ended.err.contains("─"), "{}", ended.err);
        assert!(ended.out.is_empty(), "{}", ended.out);
        only_the_sweep(&directory);
    }
}

#[test]
fn a_missing_sweep_file_ends_with_2() {
    let directory = tempfile::tempdir().unwrap();
    let ended = squealmap(directory.path(), &["run", "none.toml"]);
    assert_eq!(ended.code, Some(2));
    assert_eq!(
        ended.err,
        "error: cannot read the sweep file `none.toml`: No such file or directory (os error 2)\n"
    );
    assert!(tree(directory.path()).is_empty());
}

#[test]
fn an_unwritable_output_directory_is_refused_before_the_run() {
    let directory = with_sweep("");
    // A path below a regular file cannot be made by anyone, not even by an administrator.
    for command in [&["run"][..], &["modes"], &["trace", "--at", "mu_d=0.3,belt_velocity=1"]] {
        let arguments = [command, &["small.toml", "-o", "small.toml/out"]].concat();
        let ended = squealmap(directory.path(), &arguments);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(
            ended.err.starts_with("error: cannot write to the output directory `small.toml/out`: "),
            "{}",
            ended.err
        );
        assert_eq!(ended.err.lines().count(), 1, "{}", ended.err);
        only_the_sweep(&directory);
    }
}

#[test]
fn a_directory_in_the_place_of_a_file_is_refused_before_the_run() {
    for (command, file) in [
        (&["run"][..], "map.csv"),
        (&["run"], "manifest.json"),
        (&["modes"], "modes.svg"),
        (&["trace", "--at", "mu_d=0.3,belt_velocity=1"], "trace.png"),
    ] {
        let directory = with_sweep("");
        std::fs::create_dir_all(directory.path().join("full").join(file)).unwrap();
        let ended = squealmap(directory.path(), &[command, &["small.toml", "-o", "full"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        let expected = format!(
            "error: cannot write to the output directory `full`: `{file}`, a file to be written there, \
             is a directory; choose another one\n"
        );
        assert_eq!(ended.err, expected);
        assert_eq!(tree(&directory.path().join("full")), [PathBuf::from(file)]);
    }
}

#[test]
fn check_describes_and_writes_nothing() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["check", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for part in [
        "small.toml is valid: 6 instance(s)\n",
        "title     Small\n",
        "settle 2 periods, measure 2 periods, at least 12 steps per period\n",
        "axis      mu_d: 2 values from 0.3 to 0.4\n",
        "axis      belt_velocity: 3 values from 1 to 3 m/s\n",
        "cost      about ",
        "measured on 6 of the instances",
    ] {
        assert!(ended.out.contains(part), "`{part}` is not in\n{}", ended.out);
    }
    only_the_sweep(&directory);
}

#[test]
fn modes_and_trace_write_their_files() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["modes", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let at = "mu_d=0.35,belt_velocity=2.5";
    let ended = squealmap(directory.path(), &["trace", "small.toml", "--at", at]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for file in ["modes.csv", "modes.svg", "modes.png", "trace.csv", "trace.svg", "trace.png"] {
        assert!(directory.path().join("out/small").join(file).is_file(), "{file}");
    }
}

#[test]
fn plot_draws_what_a_directory_holds() {
    let directory = with_sweep("");
    let at = "mu_d=0.35,belt_velocity=2.5";
    for command in [&["modes", "small.toml"][..], &["trace", "small.toml", "--at", at]] {
        let ended = squealmap(directory.path(), command);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
    }
    let read = |path: &str| std::fs::read(directory.path().join(path)).unwrap();
    let picture = |path: &str| {
        let svg = String::from_utf8(read(path)).unwrap();
        let lines = svg.lines().filter(|line| !line.starts_with("<metadata>"));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    // The first of several, and the others are named.
    let ended = squealmap(directory.path(), &["plot", "out/small"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("with --figure there is also modes"), "{}", ended.err);
    assert!(picture("out/small/plot.svg") == picture("out/small/trace.svg"), "the command's own picture");
    // Another at the width of a journal, with the command in every file.
    let command = ["plot", "out/small", "--figure", "modes", "--journal", "nature-1col"];
    let ended = squealmap(directory.path(), &[&command[..], &["-o", "print"]].concat());
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    assert_eq!(
        tree(&directory.path().join("print")),
        ["plot.pdf", "plot.png", "plot.svg"].map(PathBuf::from)
    );
    let words = format!("squealmap {}, of results of squealmap 0.2.0", command.join(" "));
    for file in ["plot.pdf", "plot.png", "plot.svg"] {
        let bytes = read(&format!("print/{file}"));
        assert!(String::from_utf8_lossy(&bytes).contains(&words), "{file}");
    }
    // What only maps have is refused, and so is what is not there.
    for (option, words) in [
        ("--levels=3", "--levels is of maps, but the figure of `out/small` is that of `trace`"),
        ("--figure=figure4", "looked for figure4.csv and figure4.json for `figure4`"),
    ] {
        let ended = squealmap(directory.path(), &["plot", "out/small", option]);
        let said = ended.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(ended.code == Some(2) && said.contains(words), "{said}");
    }
}

#[test]
fn trace_lists_what_is_missing() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["trace", "small.toml", "--at", "mu_d=0.3"]);
    assert_eq!(ended.code, Some(2));
    assert!(
        ended.err.starts_with(
            "error: --at: no value for `belt_velocity`, which the sweep varies; add belt_velocity=1\n"
        ),
        "{}",
        ended.err
    );
    only_the_sweep(&directory);
}

#[test]
fn help_names_every_command_and_argument() {
    let directory = tempfile::tempdir().unwrap();
    let ended = squealmap(directory.path(), &["--help"]);
    assert_eq!(ended.code, Some(0));
    for command in ["run", "check", "modes", "trace"] {
        assert!(ended.out.contains(&format!("\n  {command} ")), "{}", ended.out);
        let help = squealmap(directory.path(), &[command, "--help"]);
        assert_eq!(help.code, Some(0));
        assert!(help.out.contains("Sweep file (TOML)"), "{}", help.out);
    }
    let ended = squealmap(directory.path(), &["run", "x.toml", "--threads", "0"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.contains("0 is not in 1..=1024"), "{}", ended.err);
}

#[test]
fn what_trace_writes_identify_reads() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "[friction]\nlaw = \"constant\"\nmu_s = 0.4\nmu_d = 0.4\n[belt]\nbelt_velocity = 3.0\n\
                 [start]\nkind = \"kick\"\nstart_velocity = 0.01\n[response]\nsettle = \"1 s\"\nmeasure = \"1 s\"\n";
    std::fs::write(directory.path().join("stroke.toml"), sweep).unwrap();
    let ended = squealmap(directory.path(), &["trace", "stroke.toml", "--rate", "2000", "-o", "traced"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("wrote traced/signals.csv\n"), "{}", ended.out);
    let ended = squealmap(directory.path(), &["identify", "traced/signals.csv", "-o", "found"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(says_mode_coupling(&ended.out), "{}", ended.out);
    let report = std::fs::read(directory.path().join("found/identify.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    assert_eq!(report["growth_verdict"]["kind"], "mode_coupling");
    // docs/physics.md, section 6: growth 4.339 1/s, 33.949 Hz, phase -40.74 degrees.
    let episode = &report["episodes"][0];
    let near = |value: &serde_json::Value, expected: f64, allowed: f64| {
        let value = value.as_f64().unwrap();
        assert!((value - expected).abs() < allowed, "{value} instead of {expected}");
    };
    near(&episode["growth_rate"]["value"], 4.339, 0.02 * 4.339);
    near(&episode["frequency"], 33.949, 0.05);
    near(&episode["phase"]["value"], -40.74, 0.5);
    for file in ["identify.png", "identify.svg", "windows.csv"] {
        assert!(directory.path().join("found").join(file).is_file(), "{file}");
    }
    // A trajectory has rows at its events: no even steps.
    let ended = squealmap(directory.path(), &["identify", "traced/trace.csv", "-o", "refused"]);
    assert_eq!(ended.code, Some(2), "{}", ended.out);
    assert!(ended.err.starts_with("error: traced/trace.csv: line "), "{}", ended.err);
    assert!(!directory.path().join("refused").exists());
}

#[test]
fn paper_writes_what_is_asked_for() {
    let directory = tempfile::tempdir().unwrap();
    let ended = squealmap(directory.path(), &["paper", "--only", "figure2,figure3", "-o", "a/b"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let figures = ["figure2", "figure3"];
    let files = figures
        .iter()
        .flat_map(|name| ["csv", "json", "png", "svg"].map(|kind| format!("a/b/paper/{name}.{kind}")));
    let expected: Vec<PathBuf> =
        ["a", "a/b", "a/b/paper"].into_iter().map(PathBuf::from).chain(files.map(PathBuf::from)).collect();
    assert_eq!(tree(directory.path()), expected, "no paper.md, which needs all figures");
}

#[test]
fn paper_refuses_with_one_sentence_and_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    for (arguments, words) in [
        (["--only", "figure9"], "[possible values: figure2,"),
        (["--ramp-duration", "0.1"], "a number of seconds from 0.5 to 100"),
        (["--ramp-duration", "nan"], "a number of seconds from 0.5 to 100"),
        (["--kick", "1"], "a length in metres from 1e-9 to 0.01"),
    ] {
        let ended = squealmap(directory.path(), &["paper", arguments[0], arguments[1]]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains(words), "{}", ended.err);
        assert!(tree(directory.path()).is_empty(), "{arguments:?}");
    }
    std::fs::create_dir_all(directory.path().join("out/paper/figure2.svg")).unwrap();
    let ended = squealmap(directory.path(), &["paper", "--only", "figure2"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(
        ended.err.contains("`paper/figure2.svg`, a file to be written there, is a directory"),
        "{}",
        ended.err
    );
    assert_eq!(tree(directory.path()).len(), 3);
}

#[test]
fn plot_draws_a_run_again() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["run", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let ended = squealmap(
        directory.path(),
        &["plot", "out/small", "--journal", "elsevier-1col", "--quantity", "type,growth,amplitude"],
    );
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for (options, file) in [
        (&["--quantity=growth", "--isolines=-1,0,2"][..], "isolines.csv"),
        (&["--cut=mu_d=0.3"], "cut.csv"),
        (&["--tikz"], "plot.tex"),
    ] {
        let all = [&["plot", "out/small", "-o", "other"], options].concat();
        let ended = squealmap(directory.path(), &all);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(directory.path().join("other").join(file).exists(), "{file}");
    }
    for file in ["plot.svg", "plot.pdf", "plot.png", "boundaries.csv"] {
        assert!(directory.path().join("out/small").join(file).exists(), "{file}");
    }
    let svg = std::fs::read_to_string(directory.path().join("out/small/plot.svg")).unwrap();
    assert!(
        svg.contains("squealmap plot out/small --journal elsevier-1col --quantity type,growth,amplitude")
    );
    let before = tree(directory.path());
    for (arguments, words) in [
        (["out/small", "--quantity=colour"], "no quantity `colour`; choose from type, regime, growth_rate"),
        (["out/small", "--width=20mm"], "a width in millimetres from 60 to 400"),
        (["out", "--hatch"], "there is nothing to draw in `out`: looked for manifest.json and map.csv"),
    ] {
        let ended = squealmap(directory.path(), &["plot", arguments[0], arguments[1]]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        let said = ended.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(words), "{said}");
    }
    assert_eq!(tree(directory.path()), before, "what is refused leaves nothing");
}
