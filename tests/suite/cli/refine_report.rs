//! What `refine` reports is what was computed; what its lines say of the rest is called that.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use serde_json::Value as Json;

use crate::cli::program::{squealmap, unwrapped};
use crate::store::refine_parts::{REFINE, arguments, undisturbed, with};

/// How many rows of the table of computed points have this in a column.
fn rows(directory: &Path, column: &str, value: &str) -> usize {
    let table = std::fs::read_to_string(directory.join("out/s/points.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let at = reader.headers().unwrap().iter().position(|name| name == column).unwrap();
    reader.records().filter(|row| &row.as_ref().unwrap()[at] == value).count()
}

/// The words of a figure.
fn words(directory: &Path, file: &str) -> String {
    let svg = std::fs::read_to_string(directory.join("out/s").join(file)).unwrap();
    let mut words = String::new();
    for part in svg.split('<') {
        words += part.split_once('>').map_or("", |(_, text)| text);
        words += " ";
    }
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn counts_are_of_what_was_computed() {
    let directory = undisturbed();
    let path = directory.path();
    let document: Json =
        serde_json::from_slice(&std::fs::read(path.join("out/s/refine.json")).unwrap()).unwrap();
    let computed = rows(path, "status", "ok") + rows(path, "status", "no_equilibrium");
    assert_eq!(document["computed"], computed);
    let unsettled = rows(path, "settled", "0");
    assert!((1..computed).contains(&unsettled) && computed < 65 * 65 / 2, "{unsettled} of {computed}");
    assert_eq!(document["counts"]["unsettled"], unsettled);
    assert_eq!(document["counts"]["type"]["mode_coupling"], rows(path, "type", "mode_coupling"));
    assert_eq!(document["counts"]["status"]["ok"], rows(path, "status", "ok"));

    // Another directory of the same parts: what was computed before is reported alike.
    std::fs::remove_file(path.join("out/s/refine.json")).unwrap();
    let ended = squealmap(path, &arguments(&REFINE));
    let said = unwrapped(&ended.out);
    assert!(said.contains(&format!("{unsettled} of {computed} instances had not settled")), "{said}");
    // The table of the whole map says what it is.
    assert!(said.contains("by its lines") && said.contains("4225"), "{said}");

    // The figure, and the one drawn again.
    let plotted = squealmap(path, &["plot", "out/s"]);
    assert_eq!(plotted.code, Some(0), "{}", plotted.err);
    for file in ["refined.svg", "plot.svg"] {
        let words = words(path, file);
        let share = 100.0 * unsettled as f64 / computed as f64;
        assert!(words.contains(&format!("unsettled {share:.1} % of {computed} computed")), "{file}: {words}");
        assert!(words.contains(&format!("{computed} of 4225 instances were computed")), "{file}: {words}");
    }
}

/// Where everything was computed there is nothing else to tell apart.
#[test]
fn a_map_that_was_computed_as_a_whole_needs_no_words() {
    let directory = with(&crate::store::refine_parts::SWEEP.replace("65", "9"));
    let ended = squealmap(directory.path(), &arguments(&REFINE));
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("computed all of 81 instances"), "{}", ended.out);
    assert!(!ended.out.contains("by its lines"), "{}", ended.out);
    let words = words(directory.path(), "refined.svg");
    assert!(words.contains("unsettled") && !words.contains("of 81 computed"), "{words}");
    assert!(!words.contains("were computed"), "{words}");
}
