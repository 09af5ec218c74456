//! How fast signals are sampled: units of time, rates that no sensor has, rates too low for the motion.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value as Json;

use crate::cli::program::{Ended, squealmap, unwrapped};
use crate::common::{close, says_mode_coupling};
use crate::study::strokes::{Random, Wanted, stroke};

/// Rate of the stroke, Hz.
const RATE: f64 = 51.2e3;

/// A stroke under this header, its time given in units of which `per_second` are a second.
fn table(header: &str, per_second: f64) -> String {
    let mut text = format!("{header},ax2,ay1,T,N,V\n");
    for sample in stroke(Wanted::Coupling, RATE, 0.0, &mut Random::new(21)).samples {
        let t = sample.t * per_second;
        let [x, y] = [sample.tangential_acceleration, sample.normal_acceleration];
        let [tangential, normal] = [sample.tangential_force, sample.normal_force];
        writeln!(text, "{t},{x},{y},{tangential},{normal},{}", sample.belt_velocity).unwrap();
    }
    text
}

fn identify(directory: &Path, table: &str, arguments: &[&str]) -> Ended {
    std::fs::write(directory.join("signals.csv"), table).unwrap();
    squealmap(directory, &[&["identify", "signals.csv", "-o", "found"], arguments].concat())
}

/// The signals are read with their own rate, and are what they are.
fn is_right(directory: &Path, ended: &Ended, what: &str) {
    assert_eq!(ended.code, Some(0), "{what}: {}", ended.err);
    assert!(says_mode_coupling(&ended.out), "{what}: {}", ended.out);
    let report = std::fs::read(directory.join("found/identify.json")).unwrap();
    let report: Json = serde_json::from_slice(&report).unwrap();
    close(what, report["rate"].as_f64().unwrap(), RATE, 1e-6);
    let frequency = report["frequency"].as_f64().unwrap();
    assert!((5e3..20e3).contains(&frequency), "{what}: {frequency} Hz");
    std::fs::remove_dir_all(directory.join("found")).unwrap();
}

/// Nothing is said of the signals, and what to do is.
fn is_asked(directory: &Path, ended: &Ended, remedies: &[&str]) {
    let said = unwrapped(&ended.err);
    assert_eq!(ended.code, Some(2), "{said} {}", ended.out);
    assert!(!ended.out.contains("confidence"), "{}", ended.out);
    for remedy in remedies {
        assert!(said.contains(remedy), "`{remedy}` is not in: {said}");
    }
    assert!(!directory.join("found").exists());
}

#[test]
fn a_time_that_no_sensor_has_is_asked_about() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    // 51.2 kHz in milliseconds and microseconds, and in hours, which is faster than any sensor.
    for (per_second, shown) in [(1e3, "51.2"), (1e6, "0.0512"), (1.0 / 3600.0, "18432")] {
        let ended = identify(path, &table("t", per_second), &[]);
        is_asked(path, &ended, &[shown, "--time-unit", "--rate", "`t`"]);
    }
    let ended = identify(path, &table("t", 1e3), &["--time-unit", "ms"]);
    is_right(path, &ended, "--time-unit ms");
}

#[test]
fn a_slow_record_is_read_where_its_unit_is_said() {
    let directory = tempfile::tempdir().unwrap();
    // 33.9 Hz at 200 Hz: the paper's own model, which no squeal is.
    let sweep = "[friction]\nlaw = \"constant\"\nmu_s = 0.4\nmu_d = 0.4\n[belt]\nbelt_velocity = 3.0\n\
                 [start]\nkind = \"kick\"\nstart_velocity = 0.01\n[response]\nsettle = \"1 s\"\nmeasure = \"1 s\"\n";
    std::fs::write(directory.path().join("stroke.toml"), sweep).unwrap();
    let traced = squealmap(directory.path(), &["trace", "stroke.toml", "--rate", "500", "-o", "traced"]);
    assert_eq!(traced.code, Some(0), "{}", traced.err);
    let asked = squealmap(directory.path(), &["identify", "traced/signals.csv", "-o", "found"]);
    is_asked(directory.path(), &asked, &["500", "--time-unit s"]);
    let arguments = ["identify", "traced/signals.csv", "-o", "found", "--time-unit", "s"];
    let ended = squealmap(directory.path(), &arguments);
    assert!(says_mode_coupling(&ended.out), "{}{}", ended.out, ended.err);
}

#[test]
fn the_unit_in_the_header_is_heeded() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    for (header, per_second) in [
        ("time [ms]", 1e3),
        ("t_ms", 1e3),
        ("Time (ms)", 1e3),
        ("TIME/ms", 1e3),
        ("t in ms", 1e3),
        ("time_us", 1e6),
        ("Time [µs]", 1e6),
        ("t (min)", 1.0 / 60.0),
        ("t [s]", 1.0),
        ("Time", 1.0),
    ] {
        let ended = identify(path, &table(header, per_second), &[]);
        is_right(path, &ended, header);
        let named = identify(path, &table(header, per_second), &["--time", header]);
        is_right(path, &named, header);
    }
    // What is said outright comes before the header, and is remarked.
    let ended = identify(path, &table("t_ms", 1.0), &["--time-unit", "s"]);
    is_right(path, &ended, "seconds under `t_ms`");
    assert!(ended.out.contains("`t_ms`") && ended.out.contains("--time-unit s"), "{}", ended.out);
}

#[test]
fn a_given_rate_that_no_sensor_has_is_asked_about() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let signals = table("clock", 1.0);
    let ended = identify(path, &signals, &["--rate", "51.2"]);
    is_asked(path, &ended, &["--rate", "51.2kHz", "51.2Hz"]);
    is_right(path, &identify(path, &signals, &["--rate", "51.2kHz"]), "in kHz");
    is_right(path, &identify(path, &signals, &["--rate", "51200"]), "in Hz");
    // Where there is a column of time, both are held against each other in its unit.
    is_right(path, &identify(path, &table("t_ms", 1e3), &["--rate", "51200"]), "both");
    let ended = identify(path, &table("t", 1e3), &["--rate", "51200"]);
    is_asked(path, &ended, &["51.2", "--time-unit ms"]);
}

/// Times of day are no numbers: what to do is not to cut the record.
#[test]
fn times_of_day_are_told_what_to_be_read_by() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let (header, rows) =
        table("Time", 1.0).split_once('\n').map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let with_clock = |row: &str| format!("12:30:00,{}\n", row.split_once(',').unwrap().1);
    let signals = header + "\n" + &rows.lines().map(with_clock).collect::<String>();
    let ended = identify(path, &signals, &[]);
    is_asked(path, &ended, &["`Time`", "`12:30:00`", "--time", "--rate"]);
    is_right(path, &identify(path, &signals, &["--rate", "51200"]), "a rate beside");
}

#[test]
fn a_trace_sampled_too_slowly_says_what_would_do() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3.0\n\
                 [response]\nsettle = \"0.2 s\"\nmeasure = \"0.2 s\"\n";
    std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
    let at = |rate: &str| {
        let ended = squealmap(directory.path(), &["trace", "s.toml", "--rate", rate, "-o", "out"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(directory.path().join("out/signals.csv").is_file());
        unwrapped(&ended.err)
    };
    let said = at("10");
    // docs/physics.md, section 6: the modes of (0.4, 0.3) are near 34 Hz, so that 68 Hz is the limit of sampling.
    assert!(said.contains("warning") && said.contains("--rate 10") && said.contains("34"), "{said}");
    let rate = said.split("--rate ").nth(2).unwrap().split(|c: char| !c.is_ascii_digit()).next().unwrap();
    assert!(rate.parse::<f64>().unwrap() > 2.0 * 34.5, "{said}");
    assert!(at("60").contains("warning"));
    assert_eq!(at(rate), "", "what it advises is enough");
}
