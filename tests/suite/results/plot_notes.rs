//! What `plot` says beside the figure: what it leaves out, what it removes, and why it refuses.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use tempfile::TempDir;

use crate::cli::program::{Ended, squealmap, tree, unwrapped, with_sweep};

/// A directory with the results of a small sweep in `out/small`.
fn results() -> TempDir {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["run", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    directory
}

fn plot(directory: &Path, options: &[&str]) -> Ended {
    squealmap(directory, &[&["plot", "out/small"], options].concat())
}

/// The tables of the picture before go with it, unless somebody has changed them.
#[test]
fn tables_of_another_picture_do_not_stay() {
    let directory = results();
    let there = |name: &str| directory.path().join("out/small").join(name).exists();
    let ended = plot(directory.path(), &["--tikz"]);
    assert_eq!((ended.code, there("plot.tex"), there("boundaries.csv")), (Some(0), true, true));
    let ended = plot(directory.path(), &["--cut=mu_d=0.3"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(["plot.tex", "boundaries.csv", "cut.csv"].map(there), [false, false, true]);
    assert!(
        unwrapped(&ended.err).contains("plot.tex`, which belonged to the picture before"),
        "{}",
        ended.err
    );
    // The same again leaves everything as it is.
    let before = tree(directory.path());
    assert!(!plot(directory.path(), &["--cut=mu_d=0.3"]).err.contains("picture"));
    assert_eq!(tree(directory.path()), before);
    // What was changed is somebody's own.
    let path = directory.path().join("out/small/cut.csv");
    std::fs::write(&path, "my own").unwrap();
    let ended = plot(directory.path(), &[]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(
        unwrapped(&ended.err).contains("cut.csv` does not belong to this picture; it stays"),
        "{}",
        ended.err
    );
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "my own");
    // Nor does another directory lose anything.
    let other = directory.path().join("other");
    std::fs::create_dir(&other).unwrap();
    std::fs::write(other.join("isolines.csv"), "my own too").unwrap();
    assert_eq!(plot(directory.path(), &["-o", "other"]).code, Some(0));
    assert_eq!(std::fs::read_to_string(other.join("isolines.csv")).unwrap(), "my own too");
}

/// What a figure does not show is named; so are lines that are nowhere, and letters without a glyph.
#[test]
fn what_is_not_drawn_is_said() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "analysis = [\"linear\"]\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = { from = 0.1, to = 0.4, points = 20 }\n\
                 belt_velocity = { from = 1, to = 3, points = 7 }\ntheta = { from = 0.01, to = 0.02, points = 8 }\n";
    std::fs::write(directory.path().join("small.toml"), sweep).unwrap();
    let ended = squealmap(directory.path(), &["run", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let said = |options: &[&str]| {
        let ended = plot(directory.path(), options);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        unwrapped(&ended.err)
    };
    let words = said(&["--cut=theta=0.01"]);
    assert!(words.contains("the figure shows 6 of 7 curves, cut.csv has all"), "{words}");
    let words = said(&["--cut=belt_velocity=1,belt_velocity=3"]);
    assert!(words.contains("of 8 panels, cut.csv has all"), "{words}");
    assert!(words.contains("such as theta=0.01"), "{words}");
    assert_eq!(said(&["--cut=theta=0.01,belt_velocity=3"]).matches("shows").count(), 0);
    let all: Vec<String> = (0..7).map(|k| format!("belt_velocity={}", 1.0 + f64::from(k) / 3.0)).collect();
    let ended = plot(directory.path(), &["--cut", &format!("theta=0.01,{}", all.join(","))]);
    assert_eq!(ended.code, Some(2));
    assert!(
        unwrapped(&ended.err).contains("7 values of `belt_velocity` are named, but a panel shows 6 curves")
    );
    let words = said(&["--quantity=growth", "--isolines=1e300,10"]);
    assert!(
        words.contains("`growth_rate` has no line at 1e300; its values")
            && words.contains("its values go from"),
        "{words}"
    );
    let words = said(&["--title", "漢 Bremse"]);
    assert!(words.contains("has no `漢` (U+6F22)"), "{words}");
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_reason() {
    let directory = results();
    let before = tree(directory.path());
    for (options, words) in [
        (&["--cut=mu_d=0.3", "--quantity=growth,type"][..], "curves are of numbers, which `type` is not"),
        (&["--width", "-90mm"], "a width in millimetres from 60 to 400"),
        (&["--quantity=regime_large"], "no quantity `regime_large`"),
    ] {
        let ended = plot(directory.path(), options);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(unwrapped(&ended.err).contains(words), "{}", ended.err);
    }
    for (path, words) in
        [("nowhere", "`nowhere` does not exist"), ("small.toml", "`small.toml` is no directory")]
    {
        let ended = squealmap(directory.path(), &["plot", path]);
        assert_eq!(ended.code, Some(2));
        let said = unwrapped(&ended.err);
        assert!(said.contains(words) && !said.contains("map.csv"), "{said}");
    }
    assert_eq!(tree(directory.path()), before);
}

/// The regime from the large start is a quantity like the others, where there are two starts.
#[test]
fn the_regime_of_the_large_start_can_be_asked_for() {
    let directory = with_sweep("");
    let path = directory.path().join("small.toml");
    let sweep = std::fs::read_to_string(&path).unwrap() + "[start]\nkind = \"both\"\n";
    std::fs::write(&path, sweep).unwrap();
    let ended = squealmap(directory.path(), &["run", "small.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let ended = plot(directory.path(), &["--quantity=regime_large"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let svg = std::fs::read_to_string(directory.path().join("out/small/plot.svg")).unwrap();
    assert!(svg.contains("Regime from the large start") && !svg.contains("Regime from the small start"));
    let ended = plot(directory.path(), &["--quantity=nothing"]);
    assert!(unwrapped(&ended.err).contains("regime_large,"), "{}", ended.err);
    let ended = plot(directory.path(), &["--quantity=regime_large", "--isolines=1"]);
    assert!(unwrapped(&ended.err).contains("which `regime_large` has none of"), "{}", ended.err);
    // Beside a quantity that has numbers the lines are that one's.
    let ended = plot(directory.path(), &["--quantity=regime_large,type,growth", "--isolines=0"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let lines = std::fs::read_to_string(directory.path().join("out/small/isolines.csv")).unwrap();
    assert!(lines.lines().skip(1).all(|line| line.contains(",growth_rate,0,")), "{lines}");
}

/// A table that ends early at the end of a line is not drawn.
#[test]
fn a_trace_that_was_cut_short_is_not_drawn() {
    let directory = with_sweep("");
    let ended = squealmap(directory.path(), &["trace", "small.toml", "--at", "mu_d=0.35,belt_velocity=2.5"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(plot(directory.path(), &[]).code, Some(0));
    let path = directory.path().join("out/small/trace.csv");
    let table = std::fs::read_to_string(&path).unwrap();
    let rows = table.lines().count() - 1;
    let short: Vec<&str> = table.split_inclusive('\n').take(rows).collect();
    std::fs::write(&path, short.concat()).unwrap();
    let ended = plot(directory.path(), &[]);
    assert_eq!(ended.code, Some(2));
    let words = format!("has {} rows, but `trace.json` says {rows}", rows - 1);
    assert!(unwrapped(&ended.err).contains(&words), "{}", ended.err);
}

#[test]
fn status_says_what_it_did_not_look_at() {
    let directory = results();
    let hint = "--verify reads them and compares their checksums";
    let ended = squealmap(directory.path(), &["status", "out/small"]);
    assert!(ended.code == Some(0) && ended.out.contains(hint), "{}", ended.out);
    let ended = squealmap(directory.path(), &["status", "out/small", "--verify"]);
    assert!(ended.code == Some(0) && !ended.out.contains(hint), "{}", ended.out);
}
