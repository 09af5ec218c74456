//! Sweeps in which nothing comes to an end: they are told apart from sweeps with results, by a sentence and by the exit code.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use tempfile::TempDir;

use crate::cli::program::{squealmap, unwrapped};

/// The values of `mu_s` and other lines of a sweep of two axes.
fn sweep(analysis: &str, model: &str, friction: &str, mu_s: &str, end: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let text = format!(
        "analysis = {analysis}\n[model]\n{model}\n[friction]\n{friction}\n[axes]\nmu_s = {mu_s}\n\
         belt_velocity = {{ from = 1.0, to = 3.0, points = 3 }}\n\
         [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n{end}"
    );
    std::fs::write(directory.path().join("s.toml"), text).unwrap();
    directory
}

const BOTH: &str = r#"["linear", "response"]"#;
const RISING: &str = "law = \"constant\"\nmu_d = 0.3";
const LOW: &str = "{ from = 0.1, to = 0.2, points = 3 }";

/// Every instance of `status`: `check` and `run` say so with the words, `run` writes its results, and both end with 1.
fn all_fail(directory: &Path, status: &str, words: &str) {
    let checked = squealmap(directory, &["check", "s.toml"]);
    let said = unwrapped(&checked.err);
    assert!(said.contains("no instance") && said.contains(&format!("9 `{status}`")), "{said}");
    assert!(said.contains(words), "{said}");
    assert_eq!(checked.code, Some(1), "{said}");
    for again in [false, true] {
        let ended = squealmap(directory, &["run", "s.toml"]);
        let said = unwrapped(&ended.err);
        assert!(said.contains("no instance") && said.contains(&format!("9 `{status}`")), "{again}: {said}");
        assert!(said.contains(words), "{said}");
        assert_eq!(ended.code, Some(1), "{again}: {said}");
        // What failed is data.
        let table = std::fs::read_to_string(directory.join("out/s/map.csv")).unwrap();
        assert_eq!(table.matches(status).count(), 9, "{table}");
        assert!(directory.join("out/s/manifest.json").is_file());
    }
}

#[test]
fn a_law_that_is_nowhere_valid_is_told() {
    all_fail(sweep(BOTH, "", RISING, LOW, "").path(), "invalid_law", "mu_s");
    all_fail(sweep(r#"["linear"]"#, "", RISING, LOW, "").path(), "invalid_law", "mu_s");
}

#[test]
fn equilibria_that_are_nowhere_are_told() {
    // cos θ + μ sin θ < 0 at θ = −1.2 from μ = 0.39 on.
    let high = "{ from = 0.5, to = 0.6, points = 3 }";
    let friction = "law = \"constant\"\nmu_d = 0.45";
    all_fail(sweep(BOTH, "theta = -1.2", friction, high, "").path(), "no_equilibrium", "theta");
    // Divergence is what the linear analysis was asked for.
    let linear = sweep(r#"["linear"]"#, "theta = -1.2", friction, high, "");
    let ended = squealmap(linear.path(), &["run", "s.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("divergence"), "{}", ended.out);
}

#[test]
fn too_many_steps_everywhere_are_told() {
    let directory = sweep(BOTH, "", "mu_d = 0.1", LOW, "");
    let path = directory.path().join("s.toml");
    let text = std::fs::read_to_string(&path).unwrap().replace("\"2 periods\"", "\"1e9 periods\"");
    std::fs::write(path, text).unwrap();
    all_fail(directory.path(), "step_too_large", "settle");
}

#[test]
fn several_failures_without_a_result_are_all_told() {
    // −1.2: no equilibrium above 0.39; mu_s below mu_d: no law.
    let directory =
        sweep(BOTH, "theta = -1.2", "law = \"constant\"\nmu_d = 0.45", "{ values = [0.4, 0.5, 0.6] }", "");
    for command in ["check", "run"] {
        let ended = squealmap(directory.path(), &[command, "s.toml"]);
        let said = unwrapped(&ended.err);
        assert!(said.contains("3 `invalid_law`") && said.contains("6 `no_equilibrium`"), "{said}");
        assert_eq!(ended.code, Some(1), "{said}");
    }
}

#[test]
fn one_result_is_enough() {
    let directory = sweep(BOTH, "", RISING, "{ values = [0.1, 0.2, 0.4] }", "");
    for command in ["check", "run", "run"] {
        let ended = squealmap(directory.path(), &[command, "s.toml"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(!ended.err.contains("no instance"), "{}", ended.err);
    }
}

#[test]
fn a_refined_map_without_a_result_is_told() {
    let many = "{ from = 0.1, to = 0.2, points = 9 }";
    let directory = sweep(BOTH, "", RISING, many, "[refine]\ncoarse = 2\nsample = 0\n");
    // What was there before ends alike.
    for _ in 0..2 {
        let ended = squealmap(directory.path(), &["run", "s.toml"]);
        let said = unwrapped(&ended.err);
        assert!(said.contains("no instance") && said.contains("`invalid_law`"), "{said}");
        assert_eq!(ended.code, Some(1), "{said}");
        assert!(directory.path().join("out/s/refine.json").is_file());
    }
}

/// A part of a sweep may lie where nothing comes to an end; the whole is judged when it is there.
#[test]
fn shards_are_not_judged_but_what_they_merge_to_is() {
    let directory = sweep(BOTH, "", RISING, LOW, "");
    for shard in ["0/2", "1/2"] {
        let ended = squealmap(directory.path(), &["run", "s.toml", "--tile", "4", "--shard", shard]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
    }
    let merged = squealmap(directory.path(), &["merge", "out/s"]);
    assert_eq!(merged.code, Some(1), "{}", merged.err);
    assert!(unwrapped(&merged.err).contains("9 `invalid_law`"), "{}", merged.err);
    assert!(directory.path().join("out/s/map.csv").is_file());
}

/// A trace, and one that rises and falls, of what has no result.
#[test]
fn a_trace_of_an_instance_without_a_result_is_told() {
    let directory = sweep(BOTH, "", RISING, LOW, "");
    let at = ["trace", "s.toml", "--at", "mu_s=0.1,belt_velocity=1"];
    let ended = squealmap(directory.path(), &at);
    let said = unwrapped(&ended.err);
    assert!(said.contains("`invalid_law`") && said.contains("mu_s"), "{said}");
    assert_eq!(ended.code, Some(1), "{said}");
    assert!(directory.path().join("out/s/trace.csv").is_file());
    let up_down = |range: &str| {
        let at = ["trace", "s.toml", "--at", "belt_velocity=1", "--points", "5", "--sweep-up-down", range];
        squealmap(directory.path(), &at)
    };
    let ended = up_down("mu_s=0.1..0.2");
    assert_eq!(ended.code, Some(1), "{}", ended.err);
    assert!(
        ended.err.contains("`invalid_law`") && !ended.out.contains("settled"),
        "{}{}",
        ended.out,
        ended.err
    );
    // The law is valid from 0.3 on: 0.3, 0.4 and 0.5 of the five.
    let ended = up_down("mu_s=0.1..0.5");
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("4 of 10 values have no result: 4 `invalid_law`"), "{}", ended.out);
}
