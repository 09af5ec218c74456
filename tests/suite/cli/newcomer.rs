//! What a newcomer begins with: `init` writes sweeps that run, `keys` says what may stand in them.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs;
use std::path::Path;

use crate::cli::program::{squealmap, tree, unwrapped};
use squealmap::model::PARAMS;
use squealmap::sweep::columns::{Values, computed};
use squealmap::sweep::spec::Spec;
use squealmap::sweep::spec::keys::{SECTIONS, all};

/// Presets with the files that they write.
const PRESETS: [(&str, &[&str]); 8] = [
    ("map", &["map.toml"]),
    ("temperature", &["pad.csv", "temperature.toml"]),
    ("bistable", &["bistable.toml"]),
    ("basin", &["basin.toml"]),
    ("hysteresis", &["hysteresis.toml"]),
    ("single-mass", &["single-mass.toml"]),
    ("tuples", &["tuples.csv", "tuples.toml"]),
    ("trace", &["trace.toml"]),
];

/// The sweep with few values on its axes, few starts and a few periods.
fn small(text: &str) -> String {
    // A limit belongs to runs until they are settled.
    let kept = text.lines().filter(|line| !line.starts_with("settle_limit = "));
    let mut lines: Vec<String> = kept.map(str::to_owned).collect();
    for line in &mut lines {
        if let Some((before, after)) = line.split_once("points = ").filter(|_| line.contains("from = ")) {
            let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
            *line = format!("{before}points = 2{rest}");
        }
        for (key, value) in [("box_samples", "2"), ("settle", "\"3 periods\""), ("measure", "\"3 periods\"")]
        {
            if line.starts_with(&format!("{key} = ")) {
                *line = format!("{key} = {value}");
            }
        }
    }
    lines.join("\n")
}

#[test]
fn every_preset_is_written_checked_and_run() {
    for (preset, files) in PRESETS {
        let directory = tempfile::tempdir().unwrap();
        let here = directory.path();
        let ended = squealmap(here, &["init", preset]);
        assert_eq!(ended.code, Some(0), "{preset}: {}", ended.err);
        assert_eq!(tree(here), files.iter().map(Into::into).collect::<Vec<std::path::PathBuf>>(), "{preset}");
        let file = format!("{preset}.toml");
        let text = fs::read_to_string(here.join(&file)).unwrap();
        assert!(text.starts_with("# "), "{preset} is not explained");
        assert!(!text.contains("sweeps/"), "{preset} names a file of the repository: {text}");
        let ended = squealmap(here, &["check", &file]);
        assert_eq!(ended.code, Some(0), "{preset}: {}", ended.err);
        fs::write(here.join(&file), small(&text)).unwrap();
        let ended = squealmap(here, &["run", &file, "--backend", "cpu"]);
        assert_eq!(ended.code, Some(0), "{preset}: {}", ended.err);
        let table = fs::read_to_string(here.join("out").join(preset).join("map.csv")).unwrap();
        let wanted = Spec::read(&here.join(&file)).unwrap().grid.len();
        assert_eq!(table.lines().count(), wanted + 1, "{preset}");
    }
}

#[test]
fn a_trace_of_the_preset_is_identified() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    for command in [
        &["init", "trace", "-o", "stops/growth.toml"][..],
        &["trace", "stops/growth.toml", "--rate", "20000"],
        &["identify", "out/growth/signals.csv"],
    ] {
        let ended = squealmap(here, command);
        assert_eq!(ended.code, Some(0), "{command:?}: {}", ended.err);
    }
    // The commands in the file are those that were run.
    let text = fs::read_to_string(here.join("stops/growth.toml")).unwrap();
    assert!(text.contains("squealmap trace stops/growth.toml --rate 20000\n"), "{text}");
    assert!(text.contains("squealmap identify out/growth/signals.csv\n"), "{text}");
    let found = fs::read(here.join("out/signals/identify.json")).unwrap();
    let found: serde_json::Value = serde_json::from_slice(&found).unwrap();
    assert_eq!(found["growth_verdict"]["kind"], "mode_coupling", "{found}");
}

#[test]
fn what_is_there_is_not_replaced() {
    for (preset, mine) in [("map", "map.toml"), ("tuples", "tuples.csv")] {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join(mine), "mine").unwrap();
        let ended = squealmap(directory.path(), &["init", preset]);
        assert_eq!(ended.code, Some(2), "{preset}: {}", ended.out);
        assert!(ended.err.contains(&format!("`./{mine}` is there already")), "{}", ended.err);
        assert_eq!(tree(directory.path()), [Path::new(mine)]);
        assert_eq!(fs::read_to_string(directory.path().join(mine)).unwrap(), "mine");
    }
    // Without a name it is the map.
    let directory = tempfile::tempdir().unwrap();
    let ended = squealmap(directory.path(), &["init"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("squealmap run map.toml\n"), "{}", ended.out);
}

#[test]
fn every_key_of_the_shipped_sweeps_is_listed_and_no_other_is_read() {
    let names: Vec<&str> = all().iter().map(|key| key.name).collect();
    for row in PARAMS {
        assert!(names.contains(&row.name), "{}", row.name);
    }
    // Each key that is listed is known to the reader: what it refuses is its value.
    for key in all() {
        let section = if key.section.is_empty() { String::new() } else { format!("[{}]\n", key.section) };
        let text = format!("{section}{} = {{}}\n", key.name);
        let why = Spec::parse(&text, "s.toml", ".".as_ref()).unwrap_err().to_string();
        assert!(!why.contains("unknown"), "{}: {why}", key.name);
        assert!(why.contains(&format!("`{}`", key.name)), "{}: {why}", key.name);
    }
    // A key that is not listed is not known.
    for (section, _) in SECTIONS.iter().filter(|(section, _)| !["", "axes"].contains(section)) {
        let why =
            Spec::parse(&format!("[{section}]\nqqq = 1\n"), "s.toml", ".".as_ref()).unwrap_err().to_string();
        assert!(why.contains("unknown key `qqq`"), "{why}");
    }
}

/// Defaults as the reader takes them.
#[test]
fn defaults_are_those_that_hold() {
    let text = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 1\n";
    let bare = Spec::parse(text, "s.toml", ".".as_ref()).unwrap().resolved();
    let mut seen = 0;
    for key in all() {
        let Some(default) = key.default.as_deref().filter(|value| !value.contains(';')) else { continue };
        let found = match key.section {
            "" => &bare[key.name],
            section => &bare[section][key.name],
        };
        if found.is_null() {
            continue;
        }
        let default: serde_json::Value = serde_json::from_str(default).unwrap();
        let alike = found == &default || found.as_f64().is_some_and(|one| Some(one) == default.as_f64());
        assert!(alike, "{}: {found} is not {default}", key.name);
        seen += 1;
    }
    assert!(seen >= 14, "only {seen} defaults were compared");
}

#[test]
fn keys_are_found_by_name_and_section() {
    let here = tempfile::tempdir().unwrap();
    let keys = |arguments: &[&str]| squealmap(here.path(), &[&["keys"], arguments].concat());
    let one = keys(&["knee_velocity"]);
    let card = "knee_velocity, [friction]\n  meaning  relative velocity from which the bilinear law is constant\n  \
                unit     m/s\n  default  5\n  range    a finite number greater than 0\n  read by  law `bilinear`\n";
    assert!(one.out.starts_with(card), "{}", one.out);
    let section = keys(&["friction"]);
    assert!(section.out.contains("\n  stribeck_velocity  m/s "), "{}", section.out);
    assert!(!section.out.contains("start_velocity"), "{}", section.out);
    let wrong = keys(&["stribek_velocity"]);
    assert_eq!(wrong.code, Some(2), "{}", wrong.out);
    assert!(unwrapped(&wrong.err).contains("did you mean `stribeck_velocity`?"), "{}", wrong.err);
    let dotted = keys(&["friction.knee_velocity"]);
    assert_eq!(dotted.out, one.out);
    let varied = keys(&["axes"]);
    assert!(varied.out.contains("\n  mu_s ") && varied.out.contains("\n  law "), "{}", varied.out);
    assert!(!varied.out.contains("steps_per_period"), "{}", varied.out);
    let all = keys(&[]);
    assert!(all.out.lines().count() > PARAMS.len(), "{}", all.out);
    assert!(all.out.lines().all(|line| line.chars().count() <= 180), "{}", all.out);
}

#[test]
fn the_page_on_columns_is_made_of_the_table() {
    let here = tempfile::tempdir().unwrap();
    let table = squealmap(here.path(), &["keys", "--columns", "--markdown"]).out;
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/columns.md")).unwrap();
    assert!(table.contains("| `x2_std` | m |"), "{table}");
    assert!(
        page.ends_with(&table),
        "docs/columns.md is older than the table of columns; put the output of `squealmap keys --columns --markdown` at its \
         end"
    );
    // Its sections explain every value of a class, in the order of the table, and no other.
    for column in computed().filter(|column| !column.is_of_large_start) {
        let Some(Values::Name(class)) = column.values() else { continue };
        let section = page.split(&format!("\n| `{}` |", column.name)).nth(1).unwrap();
        let rows = section.split("\n\n").next().unwrap().lines().skip(2);
        let named: Vec<&str> = rows.map(|row| row.split('`').nth(1).unwrap()).collect();
        assert_eq!(named, class.names().collect::<Vec<_>>(), "{}", column.name);
    }
    let listed = squealmap(here.path(), &["keys", "--columns"]).out;
    assert_eq!(listed.lines().count() + 2, table.lines().count(), "{listed}");
    assert_eq!(squealmap(here.path(), &["keys", "mu_s", "--columns"]).code, Some(2));
}

#[test]
fn the_page_on_sweep_files_is_made_of_the_table() {
    let here = tempfile::tempdir().unwrap();
    let tables = squealmap(here.path(), &["keys", "--markdown"]).out;
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/sweeps.md")).unwrap();
    assert!(tables.contains("| `mu_s` |"), "{tables}");
    assert!(
        page.ends_with(&tables),
        "docs/sweeps.md is older than the table of keys; put the output of `squealmap keys --markdown` at its end"
    );
    // The presets of the page are those of the program.
    for (preset, _) in PRESETS {
        assert!(page.contains(&format!("\n| `{preset}` |")), "{preset}");
    }
    // Its first sweep is one.
    let sweep = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    assert_eq!(Spec::parse(sweep, "s.toml", ".".as_ref()).unwrap().grid.len(), 21 * 21 * 2);
}
