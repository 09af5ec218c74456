//! A report prints what its run measured and nothing else.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value as Json;
use squealmap::engine::options::Options;
use squealmap::study::tradeoff::report::{Section, head, to_json, to_markdown};
use squealmap::sweep::accuracy::level::{Level, NAMES};
use squealmap::sweep::accuracy::measure::{CHECK_STEPS, Measurement, Settings, TRUTH_STEPS, measure};
use squealmap::sweep::spec::Spec;

/// What made the reports of these tests.
const COMMAND: &str = "squealmap tradeoff s.toml --report r.md";

/// The numbers of a text: `5.32`, `1e-2`; not those within words, such as `x2_std`, `p95` or `f32`.
fn numbers(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_alphanumeric() || c == '_') {
        let word = &rest[start..];
        let end = word.find(|c: char| !(c.is_alphanumeric() || "_.".contains(c))).unwrap_or(word.len());
        // The sign of an exponent.
        let minus = word[..end].ends_with('e') && word.starts_with(|c: char| c.is_ascii_digit());
        let end = match word[end..].strip_prefix('-') {
            Some(exponent) if minus => {
                let digits = exponent.find(|c: char| !c.is_ascii_digit()).unwrap_or(exponent.len());
                end + 1 + digits
            }
            _ => end,
        };
        let word = word[..end].trim_end_matches('.');
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            found.push(word.to_owned());
        }
        rest = &rest[start + end..];
    }
    found
}

/// Every number of a document.
fn leaves(json: &Json, into: &mut Vec<f64>) {
    match json {
        Json::Number(number) => into.push(number.as_f64().unwrap()),
        Json::Array(list) => list.iter().for_each(|one| leaves(one, into)),
        Json::Object(map) => map.values().for_each(|one| leaves(one, into)),
        _ => {}
    }
}

/// The numbers of a report that are neither of the run nor of the words that say what is measured.
fn unmeasured(report: &str, measured: &Measurement) -> Vec<String> {
    let mut values = Vec::new();
    leaves(&serde_json::from_slice(&to_json("", measured).unwrap()).unwrap(), &mut values);
    let formats = |x: f64| [format!("{x:.0}"), format!("{x:.1}"), format!("{x:.2}"), format!("{x:.1e}")];
    let mut known: HashSet<String> = values.iter().flat_map(|x| [*x, 100.0 * x]).flat_map(formats).collect();
    // Steps of the truth and of its check, the quantile, and the named accuracies.
    known.extend([TRUTH_STEPS, CHECK_STEPS, 95].map(|x| x.to_string()));
    known.extend(NAMES.into_iter().filter_map(|(_, level)| match level {
        Level::Within(bound) => Some(format!("{bound:e}")),
        Level::Reference => None,
    }));
    let report = report.replace(COMMAND, "");
    numbers(&report).into_iter().filter(|number| !known.contains(number)).collect()
}

#[test]
fn numbers_are_found_in_a_text() {
    let text = "At 12 steps `x2_std` of cpu f32 is 6.3e-5, p95; RK4: 1e-2 (5.32 s, 91 %). 10 280.";
    assert_eq!(numbers(text), ["12", "6.3e-5", "1e-2", "5.32", "91", "10", "280"]);
}

#[test]
fn a_report_on_accuracy_prints_numbers_of_its_run_alone() {
    // Steep falls of friction, whose oscillations settle soon.
    let text = "[friction]\n[axes]\nmu_s = { from = 0.4, to = 0.6, points = 8 }\nmu_d = { from = 0.0, to = 0.1, points = 4 }\n\
                [belt]\nbelt_velocity = 1.0\n[start]\nstart_velocity = 0.3\n[response]\nsettle = \"200 periods\"\nmeasure = \"20 periods\"\n";
    let spec = Spec::parse(text, "s.toml", Path::new("")).unwrap();
    let settings = Settings { sample: 16, seed: 3, threads: 2, software: false };
    let measured = measure(&spec, settings, &Options::default(), &|_| ()).unwrap();
    let section = Section { title: "Steep falls", figure: "r/s.png".to_owned(), measured: &measured };
    let report = to_markdown(&[section], COMMAND);
    assert!(report.contains(&format!("    {COMMAND}\n")) && numbers(&report).len() > 100);
    let none: Vec<String> = Vec::new();
    assert_eq!(unmeasured(&report, &measured), none);
    // What another run measured is seen. Its numbers have more digits than a report prints, so that no time of this
    // run can be among them.
    let planted =
        report + "\nMeasured: 129600.125 instances take 5.325 s of a processor; 91.725 % keep 3.14e-3.\n";
    assert_eq!(unmeasured(&planted, &measured), ["129600.125", "5.325", "91.725", "3.14e-3"]);
}

#[test]
fn the_shipped_reports_on_accuracy_begin_as_the_command_begins_them() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for (page, option) in [("accuracy_measured.md", "--store"), ("accuracy_software.md", "--software")] {
        let text = std::fs::read_to_string(docs.join(page)).unwrap();
        let command = text.lines().find_map(|line| line.strip_prefix("    ")).unwrap();
        assert!(command.contains(&format!("--report docs/{page}")) && command.contains(option), "{command}");
        let head = head(command);
        assert!(text.starts_with(&head), "{page} does not begin as the command begins it:\n{head}");
        let pictures: Vec<&str> = text.lines().filter(|line| line.starts_with("![")).collect();
        for picture in &pictures {
            let path = picture.split_once("](").unwrap().1.trim_end_matches(')');
            assert!(docs.join(path).is_file(), "{path}");
        }
        assert!(!pictures.is_empty());
    }
}
