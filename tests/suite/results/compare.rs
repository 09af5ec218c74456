//! Two result directories beside one another: labels that differ, quantiles of differences that are known, and what cannot
//! be compared.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::{squealmap, tree, unwrapped};
use crate::common::near;
use crate::results::figure::{draw, frames};
use crate::results::pictures::outside;
use crate::results::plot::directory;
use crate::synthetic::{axis, map, record, span};
use serde_json::{Value as Json, json};
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use tempfile::TempDir;

fn grid() -> Grid {
    Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 10), span(Param::MuD, 0.0, 0.6, 10)])
}

/// A hundred instances whose growth is 1 + their number.
fn one() -> Map {
    let mut map = map(grid(), |_, _| record(Kind::Stable, Regime::Equilibrium, true));
    for (k, record) in map.records.iter_mut().enumerate() {
        record.linear.as_mut().unwrap().growth_rate = 1.0 + k as f64;
    }
    map
}

/// The same, where 7 have another type, 2 of them another regime too, 1 has no regime, and the growth of instance k is
/// less by the part k/1000, of the first none.
fn other() -> Map {
    let mut map = one();
    for (k, record) in map.records.iter_mut().enumerate() {
        record.linear.as_mut().unwrap().growth_rate *= 1.0 - k as f64 / 1000.0;
        record.kind = Some(if (10..17).contains(&k) { Kind::Divergence } else { Kind::Stable });
        match k {
            15 | 16 => record.regime = Some(Regime::Slip),
            40 => *record = Record { regime: None, settled: None, ..record.clone() },
            _ => {}
        }
    }
    map
}

/// Both maps in directories of their own, and the directory around them.
fn both(first: &Map, second: &Map) -> TempDir {
    let around = tempfile::tempdir().unwrap();
    for (map, name) in [(first, "a"), (second, "b")] {
        let from = directory(map);
        std::fs::create_dir(around.path().join(name)).unwrap();
        for file in ["map.csv", "manifest.json"] {
            std::fs::copy(from.path().join(file), around.path().join(name).join(file)).unwrap();
        }
    }
    around
}

#[test]
fn what_differs_is_counted_and_measured() {
    let around = both(&one(), &other());
    let ended = squealmap(around.path(), &["compare", "a", "b", "-o", "c"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for words in [
        "type: 7 of 100 instances differ",
        "7  stable -> divergence",
        "regime: 3 of 100 instances differ",
        "2  equilibrium -> slip",
        "1  equilibrium -> -",
        "status: 0 of 100 instances differ",
    ] {
        assert!(ended.out.contains(words), "{words}: {}", ended.out);
    }
    let read = |name: &str| std::fs::read_to_string(around.path().join("c").join(name)).unwrap();
    let document: Json = serde_json::from_str(&read("compare.json")).unwrap();
    assert_eq!(document["labels"]["type"]["differ"], 7);
    let changes = json!([{ "from": "equilibrium", "to": "slip", "count": 2 }, { "from": "equilibrium", "to": "", "count": 1 }]);
    assert_eq!(document["labels"]["regime"]["changes"], changes);
    // Of the parts 0, 0.001 … 0.099: half of the instances are at 0.049 or less, and so on.
    let growth = &document["relative_differences"]["growth_rate"];
    assert_eq!((&growth["compared"], &growth["equal"]), (&json!(100), &json!(1)));
    for (share, expected) in [("0.5", 0.049), ("0.9", 0.089), ("0.99", 0.098), ("1", 0.099)] {
        near(share, growth["quantiles"][share].as_f64().unwrap(), expected, 1e-12);
    }
    let phase = &document["relative_differences"]["phase"];
    assert_eq!((&phase["equal"], &phase["quantiles"]["1"]), (&json!(100), &json!(0.0)));
    // The table has every instance with both labels.
    let table = read("compare.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let place = |name: &str| rows[0].iter().position(|header| *header == name).unwrap();
    assert_eq!(rows.len(), 101);
    assert_eq!([rows[16][place("type_1")], rows[16][place("type_2")]], ["stable", "divergence"]);
    near("of instance 50", rows[51][place("growth_rate_difference")].parse().unwrap(), 0.05, 1e-12);
    // The figure: what differs, and by how much.
    let svg = read("compare.svg");
    draw(&svg, "compare");
    for words in [">same labels (92)", ">another type (5)", ">both (2)", ">another regime (1)"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(frames(&svg).len() > 2 && outside(&svg).is_empty(), "{:?}", outside(&svg));
}

#[test]
fn the_same_directory_differs_in_nothing() {
    let around = both(&one(), &one());
    let before = tree(around.path());
    let ended = squealmap(around.path(), &["compare", "a", "b"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(!ended.out.contains("->") && !ended.out.contains(" 1 of"), "{}", ended.out);
    assert_eq!(tree(around.path()), before, "without -o nothing is written");
}

#[test]
fn what_is_not_of_the_same_grid_is_refused() {
    let with = |axes: Vec<Axis>| map(Grid::Axes(axes), |_, _| record(Kind::Stable, Regime::Slip, true));
    let law = ["bilinear", "rational"].map(|name| Value::Text(name.to_owned().into())).to_vec();
    let law = Axis { key: AxisKey::Law, values: law, log: false };
    let keys = vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::MuD)];
    let rows = (0..4).map(|k| [0.1 * f64::from(k), 0.2].map(Value::Number).to_vec()).collect();
    let mut uneven = span(Param::MuD, 0.0, 0.6, 10);
    uneven.values[4] = Value::Number(0.27);
    for (second, words) in [
        (
            with(vec![span(Param::MuS, 0.0, 0.6, 10), span(Param::MuD, 0.0, 0.6, 11)]),
            "`mu_d` has 10 values in the first, 11 in the second",
        ),
        (
            with(vec![span(Param::MuD, 0.0, 0.6, 10), span(Param::MuS, 0.0, 0.6, 10)]),
            "the first sweeps mu_s, mu_d, the second mu_d, mu_s",
        ),
        (
            with(vec![span(Param::MuS, 0.0, 0.6, 10), law]),
            "the first sweeps mu_s, mu_d, the second mu_s, law",
        ),
        (with(vec![span(Param::MuS, 0.0, 0.6, 10), uneven]), "where the second has 0.27"),
        (
            map(Grid::Tuples { keys, rows }, |_, _| record(Kind::Stable, Regime::Slip, true)),
            "one has axes, the other lists its instances",
        ),
    ] {
        let around = both(&one(), &second);
        let ended = squealmap(around.path(), &["compare", "a", "b", "-o", "c"]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        let said = unwrapped(&ended.err);
        assert!(said.contains("`a` and `b` cannot be compared: ") && said.contains(words), "{words}: {said}");
        assert!(!around.path().join("c").exists());
    }
    // A zero that rounding has left is a zero.
    let zero = |x: f64| with(vec![axis(Param::Theta, &[-0.02, x, 0.02]), span(Param::MuD, 0.0, 0.6, 4)]);
    let around = both(&zero(0.0), &zero(6.9e-18));
    assert_eq!(squealmap(around.path(), &["compare", "a", "b"]).code, Some(0));
    let ended = squealmap(around.path(), &["compare", "a", "nowhere"]);
    assert_eq!(ended.code, Some(2));
    assert!(unwrapped(&ended.err).contains("cannot read `nowhere/manifest.json`"), "{}", ended.err);
}
