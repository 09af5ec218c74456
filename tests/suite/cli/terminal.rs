//! What a terminal shows while a sweep runs, in terminals of three widths.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::process::Command;

use crate::store::killed::sweep;
use crate::store::resume::with;

/// The lines that a run draws in a terminal of so many columns, without what moves the cursor.
fn drawn(columns: usize) -> Vec<String> {
    let directory = with(&sweep());
    let command = format!(
        "stty cols {columns} rows 24; exec '{}' run s.toml --backend cpu --threads 1 --no-check",
        env!("CARGO_BIN_EXE_squealmap")
    );
    // `script` gives its command a terminal.
    let output = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        .current_dir(directory.path())
        .env("TERM", "xterm")
        .env_remove("NO_COLOR")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}");
    lines(&text)
}

/// The lines of what was sent to a terminal: sequences that begin with an escape are left out.
fn lines(sent: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut characters = sent.chars();
    while let Some(c) = characters.next() {
        match c {
            '\x1b' => {
                if characters.next() == Some('[') {
                    characters.by_ref().find(char::is_ascii_alphabetic);
                }
            }
            '\r' | '\n' => lines.push(String::new()),
            c => lines.last_mut().unwrap().push(c),
        }
    }
    lines
}

#[test]
fn progress_fits_its_line() {
    for (columns, words) in [(40, " left"), (80, " instances/s"), (200, " instances/s")] {
        let lines = drawn(columns);
        let progress: Vec<&String> = lines.iter().filter(|line| line.contains(" instances, ")).collect();
        assert!(!progress.is_empty(), "{columns}: {lines:?}");
        for line in progress {
            assert!(line.chars().count() <= columns, "{columns}: {line}");
            assert!(line.contains(words) && line.matches("/s").count() <= 1, "{columns}: {line}");
            // Whole numbers: no "138.98/s instances/s".
            let rate = line.split_once(" left, ").map_or("0", |(_, rate)| rate);
            let rate = rate.split_once(' ').map_or(rate, |(rate, _)| rate);
            assert!(rate.chars().all(|c| c.is_ascii_digit()), "{columns}: {line}");
        }
    }
}

#[test]
fn lines_are_those_that_a_terminal_shows() {
    assert_eq!(lines("\x1b[2Ka\r\x1b[1;31mb\x1b[0m c\n"), ["a", "b c", ""]);
}
