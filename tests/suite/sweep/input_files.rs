//! Files of the user: what is read of them, how much, and what is said of their content.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::path::Path;

use crate::cli::program::{squealmap, unwrapped};
use squealmap::sweep::spec::{MAX_ROWS, MAX_SWEEP_BYTES, MAX_TABLE_ROWS, Spec};
use tempfile::TempDir;

/// A sweep with a table of friction and what a test adds.
const TABLE: &str = "[friction]\nlaw = \"table\"\ntable = \"t.csv\"\n[belt]\nbelt_velocity = 1\n";

/// The longest error that is no listing of a file, bytes.
const SHORT: usize = 2000;

fn with(files: &[(&str, &str)]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    directory
}

/// What `check` says of `s.toml` in words, which it must refuse as bad input.
fn refused(directory: &Path) -> String {
    let ended = squealmap(directory, &["check", "s.toml"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.len() < SHORT, "{} bytes: {}", ended.err.len(), &ended.err[..SHORT]);
    assert!(!ended.err.contains(['\u{1b}', '\u{7}', '\u{202e}']), "{:?}", ended.err);
    unwrapped(&ended.err)
}

#[test]
fn only_files_are_read() {
    let directory = with(&[("s.toml", TABLE)]);
    std::fs::create_dir(directory.path().join("t.csv")).unwrap();
    assert!(
        refused(directory.path())
            .contains("cannot read the table file `t.csv`: it is a directory; name a file in it")
    );
    #[cfg(unix)]
    for endless in ["/dev/zero", "/dev/urandom"] {
        let sweep = TABLE.replace("t.csv", endless);
        std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
        assert!(refused(directory.path()).contains("it is a pipe or a device, not a file"), "{endless}");
        let points = format!("points = \"{endless}\"\n");
        std::fs::write(directory.path().join("s.toml"), points).unwrap();
        assert!(refused(directory.path()).contains("it is a pipe or a device, not a file"), "{endless}");
        for command in
            [&["check", endless][..], &["identify", endless, "-o", "out"], &["fit", endless, "-o", "out"]]
        {
            let ended = squealmap(directory.path(), command);
            assert_eq!(ended.code, Some(2), "{command:?}: {}", ended.err);
            assert!(ended.err.contains("it is a pipe or a device"), "{command:?}: {}", ended.err);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_is_not_waited_for() {
    let directory = with(&[("s.toml", TABLE)]);
    let made = std::process::Command::new("mkfifo").arg(directory.path().join("t.csv")).status();
    if made.is_ok_and(|status| status.success()) {
        assert!(refused(directory.path()).contains("it is a pipe or a device, not a file"));
    }
}

#[test]
fn limits_of_size_are_told() {
    let directory = with(&[("s.toml", TABLE)]);
    let mut table = "velocity,mu\n".to_owned();
    for row in 0..=MAX_TABLE_ROWS {
        writeln!(table, "{row},0.3").unwrap();
    }
    std::fs::write(directory.path().join("t.csv"), &table).unwrap();
    let rows =
        format!("it has {} rows but at most {MAX_TABLE_ROWS} are allowed; take fewer", MAX_TABLE_ROWS + 1);
    let said = refused(directory.path());
    assert!(said.contains(&rows), "{said}");
    // One row fewer is read.
    let last = table.trim_end().rfind('\n').unwrap();
    std::fs::write(directory.path().join("t.csv"), &table[..last]).unwrap();
    Spec::read(&directory.path().join("s.toml")).unwrap();
    // Sparse files: no disk is filled.
    let long = |name: &str, bytes: u64| {
        std::fs::File::create(directory.path().join(name)).unwrap().set_len(bytes).unwrap();
    };
    long("t.csv", 17 << 20);
    assert!(refused(directory.path()).contains("but at most 16 MiB are read"));
    long("s.toml", MAX_SWEEP_BYTES + 1);
    assert!(
        refused(directory.path())
            .contains("cannot read the sweep file `s.toml`: it has 4194305 bytes but at most 4 MiB")
    );
    std::fs::write(directory.path().join("s.toml"), "points = \"t.csv\"\n").unwrap();
    long("t.csv", (1 << 30) + 1);
    assert!(refused(directory.path()).contains("but at most 1024 MiB are read"));
}

#[test]
fn rows_of_points_take_little_memory() {
    // Two numbers of 16 bytes a row, one vector of them.
    assert_eq!(size_of::<squealmap::sweep::grid::Value>(), 16);
    const { assert!(MAX_ROWS <= 20_000_000) };
    let directory = with(&[("s.toml", "points = \"p.csv\"\n[friction]\nlaw=\"rational\"\ndecay=0.1\n")]);
    let mut rows = "mu_s,belt_velocity\n".to_owned();
    for row in 0..100_000 {
        writeln!(rows, "0.{row:05},1").unwrap();
    }
    std::fs::write(directory.path().join("p.csv"), rows).unwrap();
    let spec = Spec::read(&directory.path().join("s.toml")).unwrap();
    assert_eq!(spec.grid.coordinates(99_999)[0], &squealmap::sweep::grid::Value::Number(0.99999));
    // A copy shares them.
    let copy = spec.grid.clone();
    assert!(std::ptr::eq(copy.coordinates(7)[0], spec.grid.coordinates(7)[0]));
}

#[test]
fn excerpts_are_clipped_and_escaped() {
    let long = "x".repeat(3_000_000);
    let hostile = "\u{1b}[31m\u{7}\u{202e}";
    let points = "points = \"p.csv\"\n";
    for (sweep, rows) in [
        (points, format!("mu_s,{long}\n0.1,0.2\n")),
        (points, format!("mu_s\n{long}\n")),
        (points, format!("mu_s\n0.1,{long}\n")),
        (points, format!("mu_s\n\"{long}\n")),
        (points, format!("law\n{long}\n")),
        (points, format!("mu_s\n{hostile}\n")),
        (points, format!("{hostile}\n1\n")),
        (points, format!("mu_s\n{hostile},1\n")),
        (&format!("{long} = 1\n"), String::new()),
        (&format!("title = \"{long}\"\n[{long}]\n"), String::new()),
        (&format!("[friction]\nlaw = \"{long}\"\n"), String::new()),
        (&format!("[friction]\nmu_s = \"{long}\"\n"), String::new()),
        (&format!("# {long}\n[friction\n"), String::new()),
        (&format!("title = \"{hostile}\"\n"), String::new()),
        ("title = \"\\u001b]0;owned\\u0007\"\n", String::new()),
        ("title = \"two\\nlines\"\n", String::new()),
        ("points = \"\\u001b[31m.csv\"\n", String::new()),
        ("[friction]\nlaw = \"\\u001b[31m\"\n", String::new()),
    ] {
        let directory = with(&[("s.toml", sweep), ("p.csv", &rows)]);
        refused(directory.path());
    }
}

#[test]
fn of_a_file_that_is_no_table_only_a_cell_is_told() {
    let secret = "root:x:0:0:root:/root:/bin/sh\nsecret:x:1:1::/home/secret:/bin/sh\n";
    for sweep in [
        "points = \"f\"\n".to_owned(),
        TABLE.replace("t.csv", "f"),
        "[friction]\nmaterial = \"f\"\ntemperature = 20\n[belt]\nbelt_velocity = 1\n".to_owned(),
    ] {
        let directory = with(&[("s.toml", &sweep), ("f", secret)]);
        let said = refused(directory.path());
        assert!(
            said.contains("its header begins with `root:x:0:0:root:/root:/bin/sh` and names none"),
            "{said}"
        );
        assert!(!said.contains("secret"), "{said}");
    }
}

#[test]
fn the_place_of_a_long_line_is_still_shown() {
    let row = format!("{}oops{}", "1,".repeat(3000), ",1".repeat(3000));
    let header = "mu_s".to_owned() + &",mu_s".repeat(6000);
    let directory = with(&[("s.toml", "points = \"p.csv\"\n"), ("p.csv", &format!("{header}\n{row}\n"))]);
    let said = refused(directory.path());
    assert!(said.contains("p.csv:1:6: column `mu_s` stands beside"), "{said}");
    let text = format!("mu_s = 0.1\n# a\nx = {}{}\n", "0".repeat(500), "@".repeat(500));
    let directory = with(&[("s.toml", &format!("[friction]\n{text}"))]);
    let ended = squealmap(directory.path(), &["check", "s.toml"]);
    // The head of the excerpt names line and column of the file, and the line has its own number.
    let place = ended.err.split(" not valid").next().unwrap().split_whitespace().last().unwrap();
    let place = place.trim_start_matches("error:").trim_end_matches(':');
    assert!(place.starts_with("s.toml:4:"), "{}", ended.err);
    assert!(ended.err.contains(&format!("[{place}]")), "{}", ended.err);
    assert!(ended.err.lines().any(|line| line.trim_start().starts_with("4 │")), "{}", ended.err);
}

#[test]
fn a_signal_without_end_of_line_is_given_up() {
    for content in ["t,ax2\n\"1".to_owned() + &"2".repeat(4_000_000), "t".repeat(4_000_000)] {
        let directory = with(&[("x.csv", &content)]);
        let ended = squealmap(directory.path(), &["identify", "x.csv", "--rate", "1000"]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains("a row is longer than 1048576 bytes"), "{}", ended.err);
        assert!(ended.err.len() < SHORT);
    }
    let names: Vec<String> = (0..5000).map(|k| format!("\u{1b}[3{k}m")).collect();
    let directory = with(&[("x.csv", &format!("{}\n", names.join(",")))]);
    let ended = squealmap(directory.path(), &["identify", "x.csv"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.len() < SHORT && !ended.err.contains('\u{1b}'), "{}", ended.err);
    assert!(ended.err.contains("name one with"), "{}", ended.err);
}

#[test]
fn a_name_without_a_stem_asks_for_a_directory() {
    let sweep = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 1\n";
    for name in ["...toml", "..toml"] {
        let directory = with(&[(name, sweep)]);
        for command in ["run", "modes", "trace", "refine", "tradeoff", "identify", "fit"] {
            let ended = squealmap(directory.path(), &[command, name]);
            assert_eq!(ended.code, Some(2), "{command} {name}: {}", ended.err);
            let left = std::fs::read_dir(directory.path()).unwrap().count();
            assert_eq!(left, 1, "{command} {name} wrote something");
        }
        let ended = squealmap(directory.path(), &["run", name]);
        assert!(
            ended.err.contains("gives the results no directory of their own; name one with -o"),
            "{}",
            ended.err
        );
        let ended = squealmap(directory.path(), &["run", name, "-o", "here"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
    }
}
