//! The server of `explore`: the page, answers beside those of the library and of a run, and the command.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value as Json, json};
use squealmap::results::csv::map_csv;
use squealmap::results::manifest::manifest_json;
use squealmap::study::explore::{Explorer, archive};
use squealmap::sweep::map::Map;
use squealmap::sweep::run::run;
use squealmap::{Backend, Options};

use crate::cli::http::{MAP, Served, parse, region, same};
use crate::cli::program::{squealmap, unwrapped};

const COLUMNS: [&str; 5] = ["type", "regime", "growth_rate", "x2_std", "stick"];

fn computed(text: &str) -> Map {
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    run(parse(text), &options, &|_| ()).unwrap()
}

/// A column of the map with names by their codes, where the belt moves at 3 m/s.
fn column(map: &Map, about: &Json, name: &str) -> Vec<f64> {
    let known = about["columns"].as_array().unwrap().iter().find(|column| column["name"] == name).unwrap();
    let codes: Vec<&str> =
        known["names"].as_array().unwrap().iter().map(|one| one.as_str().unwrap()).collect();
    let all = if codes.is_empty() {
        map.column(name).unwrap()
    } else {
        let code = |found: Option<String>| {
            codes.iter().position(|one| Some(*one) == found.as_deref()).map_or(f64::NAN, |place| place as f64)
        };
        map.names(name).unwrap().into_iter().map(code).collect()
    };
    let belt = map.column("belt_velocity").unwrap();
    let at_three = |(value, belt): (f64, f64)| (belt > 2.0).then_some(value);
    all.into_iter().zip(belt).filter_map(at_three).collect()
}

#[test]
fn the_page_is_served_with_what_it_needs_and_no_more() {
    let served = Served::of(MAP);
    let (one, two) = (served.get("/"), served.get("/"));
    assert_eq!(one.status, 200);
    let word = |head: &str| head.split_once("'nonce-").unwrap().1.split_once('\'').unwrap().0.to_owned();
    for answered in [&one, &two] {
        let (text, word) = (answered.text(), word(&answered.head));
        assert!(word.len() >= 32 && text.contains(&format!("<script nonce=\"{word}\">1</script>")), "{text}");
        assert!(text.contains("connect-src 'self'") && text.contains("id=\"sweep\""), "{text}");
        for part in ["nosniff", "no-store", "frame-ancestors 'none'", "text/html", "Connection: close"] {
            assert!(answered.head.contains(part), "{part}: {}", answered.head);
        }
        let policy = answered.head.lines().find(|line| line.starts_with("Content-Security-Policy")).unwrap();
        assert!(
            !policy.split("script-src").nth(1).unwrap().split(';').next().unwrap().contains("unsafe-inline")
        );
    }
    assert_ne!(word(&one.head), word(&two.head));
    assert_ne!(served.token, Served::of(MAP).token);
}

/// Cells are those of a run: every name, and every number to the bit; for two clients at once.
#[test]
fn the_server_answers_what_a_run_computes() {
    let served = Served::of(MAP);
    let map = computed(MAP);
    let about = served.ask(&json!({ "ask": "about" })).parts().0;
    let ask = || served.ask(&region(true, &COLUMNS)).parts();
    let answers =
        std::thread::scope(|scope| [(); 2].map(|()| scope.spawn(ask)).map(|one| one.join().unwrap()));
    for (head, numbers) in answers {
        assert_eq!((&head["shape"], &head["of_run"]), (&json!([7, 6]), &json!(0)));
        for (name, found) in COLUMNS.into_iter().zip(numbers.chunks(42)) {
            let known = column(&map, &about, name);
            assert!(same(found, &known), "{name}: {found:?} {known:?}");
            // The comparer sees a planted fault.
            let mut other = known.clone();
            other[17] += 1.0;
            assert!(!same(found, &other));
        }
    }
    let sentence = served.ask(&json!({ "ask": "nothing" })).parts().0;
    assert!(sentence["error"].as_str().unwrap().contains("no question"), "{sentence}");
}

/// A directory as a run without tiles leaves it.
fn written(map: &Map, directory: &Path) {
    std::fs::write(directory.join("map.csv"), map_csv(map).unwrap()).unwrap();
    std::fs::write(directory.join("manifest.json"), manifest_json(map).unwrap()).unwrap();
}

fn opened(directory: &Path) -> Explorer {
    let (spec, finished) = archive::read(directory).unwrap();
    Explorer::new(spec).unwrap().with(finished)
}

/// What a run has is taken from its table: a number that is changed there is changed in the answer.
#[test]
fn a_directory_answers_by_its_table() {
    let directory = tempfile::tempdir().unwrap();
    let map = computed(MAP);
    written(&map, directory.path());
    let served = Served::new(&opened(directory.path()), 2);
    let about = served.ask(&json!({ "ask": "about" })).parts().0;
    let (head, numbers) = served.ask(&region(true, &COLUMNS)).parts();
    assert_eq!(head["of_run"], 42);
    for (name, found) in COLUMNS.into_iter().zip(numbers.chunks(42)) {
        assert!(same(found, &column(&map, &about, name)), "{name}");
    }
    // Other values of the same grid, some of which the run has; a parameter that it does not vary; transients in f32.
    let mut mixed = region(true, &COLUMNS);
    mixed["x"] = json!({ "key": "mu_d", "from": 0.0, "to": 0.25, "points": 3, "values": [0.0, 0.2, 0.25] });
    let (head, numbers) = served.ask(&mixed).parts();
    assert_eq!(head["of_run"], 14);
    let fresh = Served::of(MAP).ask(&mixed).parts();
    assert_eq!(fresh.0["of_run"], 0);
    assert!(same(&numbers, &fresh.1), "what is computed beside the run is what is computed alone");
    let with = |key: &str, value: f64| {
        let mut other = region(true, &["x2_std"]);
        other["at"][key] = json!(value);
        served.ask(&other).parts().0["of_run"].clone()
    };
    assert_eq!(
        [with("theta", 0.01), with("theta", 0.02), with("belt_velocity", 2.0)],
        [json!(42), json!(0), json!(0)]
    );
    // A planted value.
    let path = directory.path().join("map.csv");
    let table = std::fs::read_to_string(&path).unwrap();
    let place = table.lines().next().unwrap().split(',').position(|name| name == "x2_std").unwrap();
    let mut rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let row = (1..rows.len()).find(|row| rows[*row][3] == "3" && !rows[*row][place].is_empty()).unwrap();
    rows[row][place] = "7.5";
    let lines: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    std::fs::write(&path, lines.join("\n") + "\n").unwrap();
    let (_, planted) = Served::new(&opened(directory.path()), 2).ask(&region(true, &["x2_std"])).parts();
    let known = column(&map, &about, "x2_std");
    let differ: Vec<usize> = (0..42).filter(|k| !same(&planted[*k..=*k], &known[*k..=*k])).collect();
    assert_eq!(differ.iter().map(|k| planted[*k]).collect::<Vec<_>>(), [7.5]);
}

/// Without a table the tiles that are there are taken, and what is in none of them is computed.
#[test]
fn a_directory_without_a_table_answers_by_its_tiles() {
    let directory = tempfile::tempdir().unwrap();
    let (here, map) = (directory.path(), directory.path().join("map"));
    std::fs::write(here.join("s.toml"), MAP).unwrap();
    let ran = squealmap(here, &["run", "s.toml", "-o", "map", "--quiet", "--backend", "cpu"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let answer = || Served::new(&opened(&map), 2).ask(&region(true, &COLUMNS)).parts();
    let (head, by_table) = answer();
    assert_eq!(head["of_run"], 42);
    std::fs::remove_file(map.join("map.csv")).unwrap();
    let (head, by_tiles) = answer();
    assert!(head["of_run"] == 42 && same(&by_tiles, &by_table));
    for entry in std::fs::read_dir(map.join("tiles")).unwrap() {
        let path = entry.unwrap().path();
        if !path.ends_with("sweep.json") {
            std::fs::remove_file(path).unwrap();
        }
    }
    let (head, computed) = answer();
    assert!(head["of_run"] == 0 && same(&computed, &by_table));
}

/// The sentence of a command that cannot serve this, and that it is bad input. A program without the page says that instead.
fn refused(directory: &Path, arguments: &[&str], part: &str) {
    let ended = squealmap(directory, &[&["explore"], arguments].concat());
    let err = unwrapped(&ended.err);
    assert_eq!(ended.code, Some(2), "{err}");
    assert!(err.contains(part) || err.contains("built without the page"), "{arguments:?}: {err}");
    assert_eq!(ended.out, "");
}

#[test]
fn the_command_refuses_what_it_cannot_serve() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    std::fs::write(here.join("s.toml"), MAP).unwrap();
    let ran = squealmap(here, &["run", "s.toml", "-o", "map", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    refused(here, &["nothing.toml"], "nothing.toml");
    refused(here, &["map", "-o", "page"], "name its sweep file");
    refused(here, &["s.toml", "-o", "page", "--port", "80"], "--port");
    std::fs::create_dir(here.join("empty")).unwrap();
    refused(here, &["empty", "--no-open"], "holds no tiles");
    let taken = TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    refused(here, &["s.toml", "--no-open", "--port", &port], &format!("cannot listen on 127.0.0.1:{port}"));
    // A table that was changed, with the sentence of `plot`.
    let table = std::fs::read_to_string(here.join("map/map.csv")).unwrap();
    std::fs::write(here.join("map/map.csv"), table.replacen("stable", "divergence", 1)).unwrap();
    let plot = squealmap(here, &["plot", "map"]);
    assert!(unwrapped(&plot.err).contains("its checksum is another one"), "{}", plot.err);
    let explore = squealmap(here, &["explore", "map", "--no-open"]);
    assert_eq!((unwrapped(&explore.err), explore.code), (unwrapped(&plot.err), plot.code));
}

/// Says where it listens, answers there, and ends at Ctrl-C with a sentence.
#[cfg(unix)]
#[test]
fn the_command_serves_until_it_is_stopped() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("s.toml"), MAP).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(["explore", "s.toml", "--backend", "cpu"])
        .current_dir(directory.path())
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let Some(first) = lines.next() else {
        let ended = child.wait_with_output().unwrap();
        let err = unwrapped(&String::from_utf8(ended.stderr).unwrap());
        assert!(err.contains("built without the page"), "{err}");
        return;
    };
    let first = first.unwrap();
    let port = first.strip_prefix("http://127.0.0.1:").and_then(|rest| rest.split_once('/')).unwrap().0;
    let served = Served { port: port.parse().unwrap(), token: String::new() };
    let page = served.get("/");
    assert!(page.status == 200 && page.body.len() > 100_000);
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(sent.success());
    assert!(lines.next().unwrap().unwrap().contains("ended"));
    let ended = child.wait_with_output().unwrap();
    let err = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(0), "{err}");
    if cfg!(target_os = "linux") {
        assert!(err.contains("no browser was opened: there is no screen here"), "{err}");
    }
}
