//! Figures of explicit tuples: how large points are, what is on top, what is told apart, and in which order panels stand.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::common::near;
use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{failed, map, record};
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::model::status::Status;
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::{look_svg, map_svg};
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::map::Map;

/// Points along an edge of a panel that is full of them.
const SIDE: usize = 80;

/// Tuples of static and dynamic friction and belt velocity.
fn tuples(rows: impl Iterator<Item = [f64; 3]>) -> Grid {
    let keys = [Param::MuS, Param::MuD, Param::BeltVelocity].map(AxisKey::Param).to_vec();
    Grid::Tuples { keys, rows: rows.map(|row| row.map(Value::Number).to_vec()).collect() }
}

/// Two panels of 6400 points on a grid.
fn dense(make: impl Fn(usize) -> Record) -> Map {
    let row = |i: usize| [(i / 2 % SIDE) as f64, (i / 2 / SIDE) as f64, [6.0, 3.0][i % 2]];
    map(tuples((0..2 * SIDE * SIDE).map(row)), |i, _| make(i))
}

/// How many marks of a class are drawn without outlines.
fn marks(svg: &str, class: &str) -> usize {
    let own = |line: &&str| line.starts_with("<path") && line.contains(&format!("class=\"{class}\""));
    svg.lines().filter(own).map(|line| line.matches('M').count()).sum()
}

/// The part of a frame that is nearer to a dark colour than to white, by green and blue.
fn painted(svg: &str, name: &str, frame: usize, dark: [u8; 3]) -> f64 {
    const N: usize = 500;
    let (picture, frame) = (draw(svg, name), frames(svg)[frame]);
    let sum = |[_, g, b]: [u8; 3]| u32::from(g) + u32::from(b);
    let place = |i: usize| (i as f64 + 0.5) / N as f64;
    let is_dark =
        |k: &usize| 2 * sum(colour(&picture, frame, (place(k % N), place(k / N)))) < sum(dark) + 2 * 255;
    (0..N * N).filter(is_dark).count() as f64 / (N * N) as f64
}

fn quantity(map: &Map, values: Vec<Option<f64>>) -> String {
    let (name, unit) = ("x2_std".to_owned(), "m".to_owned());
    let column = NumberColumn { name, unit, meaning: String::new(), values };
    let contents = vec![Content::quantity(&column)];
    look_svg(map, &Look { contents, ..Look::default() }).unwrap()
}

#[test]
fn many_points_shrink() {
    // One in a hundred of a panel is stable, one failed, half have not settled.
    let map = dense(|i| match i {
        6 => failed(Status::NonFinite),
        _ if i % 200 == 0 => record(Kind::Stable, Regime::Equilibrium, true),
        _ => record(Kind::ModeCoupling, Regime::Detaching, i % 4 > 0),
    });
    let svg = map_svg(&map).unwrap();
    assert!(!svg.contains("<circle"));
    let (all, stable) = (2 * SIDE * SIDE, 2 * SIDE * SIDE / 200);
    // A rim and its inside.
    assert_eq!(marks(&svg, "stable"), 2 * stable);
    assert_eq!(marks(&svg, "mode_coupling"), all - stable - 1);
    assert_eq!(marks(&svg, "detaching"), all - stable - 1);
    assert_eq!(marks(&svg, "unsettled"), all / 4 - stable);
    // A ring, its inside and a cross, in both blocks.
    assert_eq!(marks(&svg, "failed"), 6);
    let first = |class: &str| svg.find(&format!("class=\"{class}\"")).unwrap();
    let last = |class: &str| svg.rfind(&format!("class=\"{class}\"")).unwrap();
    assert!(last("mode_coupling") < first("stable") && last("stable") < first("failed"), "the rare on top");
    // Discs of 0.4 of their distance that nowhere meet cover π 0.4² of the frame of settled points.
    let mode_coupling = [0xB5, 0x44, 0x1A];
    near("painted", painted(&svg, "dense", 0, mode_coupling), 0.16 * std::f64::consts::PI, 0.015);
}

#[test]
fn the_size_is_that_of_different_points() {
    let radius = |rows: &mut dyn Iterator<Item = [f64; 3]>| {
        let map = map(tuples(rows), |_, _| record(Kind::Stable, Regime::Slip, true));
        let svg = map_svg(&map).unwrap();
        let after = svg.split_once(r#"" r=""#).expect("an outlined point").1;
        after.split_once('"').unwrap().0.parse::<f64>().unwrap()
    };
    let few = radius(&mut [[0.1, 0.2, 3.0], [0.2, 0.1, 3.0]].into_iter());
    assert!(few > 3.0);
    let same = (0..2000).map(|i| [0.1 + 0.1 * f64::from(i % 2), 0.2, 3.0]);
    near("of two places", radius(&mut same.into_iter()), few, 1e-9);
    let some = (0..1600).map(|i| [f64::from(i % 40), f64::from(i / 40), 3.0]);
    let smaller = radius(&mut some.into_iter());
    assert!(smaller < 0.95 * few, "{smaller} {few}");
}

#[test]
fn points_without_a_value_are_not_those_of_the_lowest() {
    let all = 2 * SIDE * SIDE;
    // A quarter has none, a quarter the lowest; what has not settled and has a value gets a dot.
    let values = || (0..all).map(|i| (i % 4 > 0).then_some((i % 4 - 1) as f64));
    let map = dense(|i| record(Kind::ModeCoupling, Regime::Detaching, i % 8 > 0 && i % 8 != 3));
    let svg = quantity(&map, values().collect());
    draw(&svg, "dense_quantity");
    assert!(!svg.contains("<circle") && svg.contains(&format!(">undefined ({})<", all / 4)));
    assert_eq!(marks(&svg, "undefined"), all / 4);
    // A rim and its inside.
    assert_eq!(marks(&svg, "value"), 2 * (all - all / 4));
    assert_eq!(marks(&svg, "unsettled"), all / 8);
    // The same of few points with outlines: hatched.
    let few = tuples((0..8).map(|i| [f64::from(i), f64::from(i * i), 3.0]));
    let map = self::map(few, |_, _| record(Kind::ModeCoupling, Regime::Detaching, true));
    let svg = quantity(&map, values().take(8).collect());
    draw(&svg, "points_quantity");
    assert_eq!(svg.matches("<circle").count(), 6 + 2 * 2);
    assert_eq!(svg.matches(r#"class="undefined""#).count(), 2);
}

#[test]
fn panels_ascend_and_names_stay() {
    let keys = vec![
        AxisKey::Param(Param::MuS),
        AxisKey::Param(Param::MuD),
        AxisKey::Law,
        AxisKey::Param(Param::BeltVelocity),
    ];
    let row = |i: usize| {
        let law = Value::Text(["exponential", "bilinear"][i / 20].to_owned().into());
        let [mu_s, mu_d, velocity] = [i as f64, (i * i % 7) as f64, [10.0, 9.0][i % 2]].map(Value::Number);
        vec![mu_s, mu_d, law, velocity]
    };
    let grid = Grid::Tuples { keys, rows: (0..40).map(row).collect() };
    let svg = map_svg(&map(grid, |_, _| record(Kind::Stable, Regime::Slip, true))).unwrap();
    draw(&svg, "panels_of_names");
    let words = ["exponential", "bilinear", "= 9", "= 10"];
    let titles = svg
        .match_indices('>')
        .filter_map(|(at, _)| words.iter().find(|word| svg[at + 1..].trim_start().starts_with(**word)));
    let titles: Vec<&str> = titles.take(8).copied().collect();
    // The lines of a title from the lower one up.
    let expected = ["= 9", "exponential", "= 10", "exponential", "= 9", "bilinear", "= 10", "bilinear"];
    assert_eq!(titles, expected);
}

#[test]
fn points_have_no_areas_and_all_their_rows() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "title = \"t\"\npoints = \"x.csv\"\nanalysis = [\"linear\"]\n[belt]\nbelt_velocity = 3.0\n";
    std::fs::write(directory.path().join("s.toml"), sweep).unwrap();
    std::fs::write(directory.path().join("x.csv"), "mu_s,mu_d\n0.1,0.2\n0.4,0.3\n0.5,0.1\n").unwrap();
    let run = squealmap(directory.path(), &["run", "s.toml", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    let refused = |arguments: &[&str], words: &str| {
        let all: Vec<&str> = ["plot", "out"].iter().chain(arguments).copied().collect();
        let ended = squealmap(directory.path(), &all);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.err);
        let said = crate::cli::program::unwrapped(&ended.err);
        assert!(said.contains(words), "{words}: {said}");
        assert!(!directory.path().join("out/plot.svg").exists());
    };
    refused(&["--hatch"], "--hatch needs axes");
    refused(&["--quantity", "growth", "--levels", "3"], "--levels needs axes");
    refused(&["--quantity", "growth", "--isolines", "0"], "--isolines needs axes");
    refused(&["--quantity", "foo"], "growth");
    let path = directory.path().join("out/map.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    std::fs::write(&path, rows[..3].join("\n")).unwrap();
    refused(&[], "map.csv`: it is not the file that manifest.json names: its checksum is another one");
    // A manifest of before there were checksums.
    let manifest = directory.path().join("out/manifest.json");
    let written = std::fs::read(&manifest).unwrap();
    let mut document: serde_json::Value = serde_json::from_slice(&written).unwrap();
    for of_the_whole in ["files", "checksum"] {
        document.as_object_mut().unwrap().remove(of_the_whole).unwrap();
    }
    std::fs::write(&manifest, document.to_string()).unwrap();
    refused(&[], "map.csv`: 2 rows for 3 instances");
    std::fs::write(&path, text.replacen(",0.4,", ",nan,", 1)).unwrap();
    refused(&[], "map.csv`: row 2: `mu_s` is `nan`, no number");
    std::fs::write(&path, text).unwrap();
    std::fs::write(&manifest, written).unwrap();
    assert_eq!(squealmap(directory.path(), &["plot", "out"]).code, Some(0));
}
