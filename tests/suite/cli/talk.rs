//! How much a command says and where: quiet, verbose, one object for scripts, a full disk behind standard output.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value as Json;

use crate::cli::program::{Ended, squealmap, unwrapped, with_sweep};
use crate::store::resume::{SWEEP, with};

/// The one object on standard output.
fn object(directory: &Path, arguments: &[&str]) -> (Option<i32>, Json) {
    let Ended { code, out, err } = squealmap(directory, arguments);
    let json: Json =
        serde_json::from_str(&out).unwrap_or_else(|why| panic!("{arguments:?}: {why}: {out}{err}"));
    assert_eq!(json["exit_code"].as_i64(), code.map(i64::from), "{arguments:?}: {json}");
    assert_eq!(json["command"], arguments[0], "{json}");
    (code, json)
}

const RUN: [&str; 4] = ["run", "small.toml", "--backend", "cpu"];

#[test]
fn a_script_reads_one_object() {
    let directory = with_sweep("");
    let here = directory.path();
    let (code, found) = object(here, &["check", "small.toml", "--json"]);
    assert_eq!((code, &found["valid"], &found["instances"]), (Some(0), &true.into(), &6.into()));
    assert_eq!(found["varies"], serde_json::json!(["mu_d", "belt_velocity"]));
    assert!(found["cost"]["cpu_seconds"].as_f64().unwrap() > 0.0, "{found}");
    assert!(found.get("text").is_none(), "{found}");

    let (code, found) = object(here, &[&RUN[..], &["--json"]].concat());
    assert_eq!((code, &found["complete"]), (Some(0), &true.into()), "{found}");
    assert_eq!(found["computation"]["computed"], 6);
    assert_eq!(found["directory"], "out/small");
    let counted = found["counts"]["type"].as_object().unwrap().values().filter_map(Json::as_u64);
    assert_eq!(counted.sum::<u64>(), 6, "{found}");
    let files: Vec<&str> = found["files"].as_array().unwrap().iter().filter_map(Json::as_str).collect();
    assert_eq!(files.len(), 4);
    assert!(files.iter().all(|file| here.join(file).is_file()), "{files:?}");

    let (_, found) = object(here, &["status", "out/small", "--json"]);
    assert_eq!(found["instances"], serde_json::json!({ "total": 6, "done": 6, "kept": 0 }));
    assert_eq!((&found["tiles"]["done"], &found["complete"]), (&1.into(), &true.into()));
    let (code, found) = object(here, &["verify", "out/small", "--json"]);
    assert_eq!((code, &found["good"]), (Some(0), &true.into()), "{found}");
    fs::write(here.join("out/small/map.csv"), "").unwrap();
    let (code, found) = object(here, &["verify", "out/small", "--json"]);
    assert_eq!((code, &found["good"]), (Some(1), &false.into()), "{found}");
    assert!(found["results"]["faults"][0].as_str().unwrap().contains("map.csv"), "{found}");

    // A mistake is an object too, and its sentence stands on standard error as ever.
    let (code, found) = object(here, &["run", "nowhere.toml", "--json"]);
    assert_eq!(code, Some(2));
    assert!(found["error"].as_str().unwrap().contains("nowhere.toml"), "{found}");
    // What has nothing else to tell tells its words.
    let (_, found) = object(here, &["modes", "small.toml", "--json"]);
    assert_eq!(found["files"].as_array().unwrap().len(), 4, "{found}");
    assert!(found["text"].as_str().unwrap().contains("wrote "), "{found}");
}

#[test]
fn a_refinement_is_told_to_scripts() {
    let sweep = SWEEP.to_owned() + "[refine]\ncoarse = 4\nsample = 20\n";
    let directory = with(&sweep);
    let (code, found) = object(directory.path(), &["refine", "s.toml", "--backend", "cpu", "--json"]);
    assert_eq!((code, &found["instances"]), (Some(0), &300.into()), "{found}");
    let document: Json =
        serde_json::from_slice(&fs::read(directory.path().join("out/s/refine.json")).unwrap()).unwrap();
    assert_eq!(found["computed"], document["computed"]);
    let (_, found) = object(directory.path(), &["status", "out/s", "--json"]);
    assert_eq!((&found["complete"], &found["instances"]["done"]), (&true.into(), &document["computed"]));
    let (code, found) = object(directory.path(), &["verify", "out/s", "--json"]);
    assert_eq!((code, &found["good"]), (Some(0), &true.into()), "{found}");
}

#[test]
fn quiet_says_nothing_but_errors() {
    let directory = with_sweep("");
    let here = directory.path();
    // `auto` has a remark on what computes.
    let ended = squealmap(here, &["run", "small.toml"]);
    assert!(!ended.out.is_empty() && !ended.err.is_empty());
    let ended = squealmap(here, &["run", "small.toml", "--quiet", "-o", "other"]);
    assert_eq!((ended.code, ended.out.as_str(), ended.err.as_str()), (Some(0), "", ""));
    assert!(here.join("other/map.csv").is_file());
    // What a command is there for is no word beside it.
    for command in [&["completions", "bash"][..], &["keys"]] {
        assert!(!squealmap(here, &[command, &["--quiet"]].concat()).out.is_empty(), "{command:?}");
    }
    let ended = squealmap(here, &["--quiet", "run", "nowhere.toml"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(2), ""));
    assert!(ended.err.starts_with("error: "), "{}", ended.err);
    let ended = squealmap(here, &["run", "small.toml", "-q", "-v"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
}

#[test]
fn verbose_says_how_the_work_is_cut_and_where_the_time_goes() {
    let directory = with_sweep("");
    let plain = squealmap(directory.path(), &[&RUN[..], &["-o", "plain"]].concat());
    let more = squealmap(directory.path(), &[&RUN[..], &["-o", "more", "--verbose", "--tile", "4"]].concat());
    for words in
        [": 2 tile(s) of up to 4 instances on ", "2 tile(s) to do, 6 instances computed and 0 taken over in "]
    {
        assert!(more.err.contains(words), "{words}: {}", more.err);
        assert!(!plain.err.contains("tile(s)"), "{}", plain.err);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn what_cannot_be_printed_is_an_error_but_a_reader_that_left_is_none() {
    let directory = with_sweep("");
    for arguments in [&["keys"][..], &["check", "small.toml"], &["--help"], &["keys", "--json"]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
        command.args(arguments).current_dir(directory.path()).stdout(full);
        let output = command.output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {err}");
        assert!(err.contains("error: cannot write to standard output: No space left on device"), "{err}");
        // A pipe whose reader is gone.
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(
            output.status.code(),
            Some(0),
            "{arguments:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}

#[test]
fn status_watches_until_all_is_done() {
    let directory = with(SWEEP);
    let here = directory.path();
    let run = ["run", "s.toml", "--backend", "cpu", "--tile", "32", "-o", "out/s"];
    assert_eq!(squealmap(here, &[&run[..], &["--shard", "0/2"]].concat()).code, Some(0));
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.args(["status", "--watch=1", "out/s"]).current_dir(here);
    let watch = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let began = Instant::now();
    std::thread::sleep(Duration::from_millis(1500));
    assert_eq!(squealmap(here, &[&run[..], &["--shard", "1/2"]].concat()).code, Some(0));
    let output = watch.wait_with_output().unwrap();
    let out = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{out}");
    assert!(began.elapsed() > Duration::from_secs(1), "it has not waited");
    assert!(out.contains("5 of 10 done") && out.contains("10 of 10 done"), "{out}");
    assert!(out.find("5 of 10 done") < out.find("10 of 10 done"), "{out}");
}

#[test]
fn a_trace_of_a_numbered_instance_is_that_of_its_values() {
    let directory = with_sweep("");
    let here = directory.path();
    assert_eq!(squealmap(here, &RUN).code, Some(0));
    let table = fs::read_to_string(here.join("out/small/map.csv")).unwrap();
    let row = table.lines().nth(5).unwrap();
    assert!(row.starts_with("4,0.4,2,"), "{row}");
    let trace = |arguments: &[&str], output: &str| {
        let ended = squealmap(here, &[&["trace", "small.toml", "-o", output], arguments].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        (
            ended.out,
            fs::read(here.join(output).join("trace.csv")).unwrap(),
            fs::read(here.join(output).join("trace.svg")).unwrap(),
        )
    };
    let (out, csv, svg) = trace(&["--instance", "4"], "numbered");
    assert!(out.starts_with("at mu_d=0.4,belt_velocity=2\n"), "{out}");
    let (_, csv_at, svg_at) = trace(&["--at", "mu_d=0.4,belt_velocity=2"], "at");
    assert!(csv == csv_at && svg == svg_at);
    assert!(csv != trace(&["--instance", "0"], "other").1);
    let beyond = squealmap(here, &["trace", "small.toml", "--instance", "6"]);
    assert_eq!(beyond.code, Some(2));
    let words = "--instance 6: the sweep has 6 instances, numbered from 0 to 5";
    assert!(unwrapped(&beyond.err).contains(words), "{}", beyond.err);
}

#[test]
fn shells_and_man_know_every_command() {
    let here = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let ended = squealmap(here.path(), &["completions", shell]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        for word in ["sweep-up-down", "require-gpu", "completions", "status"] {
            assert!(ended.out.contains(word), "{shell}: {word}");
        }
    }
    let ended = squealmap(here.path(), &["man", "pages/man1"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let help = squealmap(here.path(), &["--help"]).out;
    let commands = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let commands: Vec<&str> = commands.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(commands.len() > 15, "{help}");
    for command in commands.iter().filter(|command| **command != "help") {
        let page = fs::read_to_string(here.path().join(format!("pages/man1/squealmap-{command}.1"))).unwrap();
        assert!(page.contains(&format!(".TH squealmap-{command} 1")), "{page}");
    }
    let page = fs::read_to_string(here.path().join("pages/man1/squealmap.1")).unwrap();
    assert!(page.contains("refine") && page.contains("brake contact"), "{page}");
}
