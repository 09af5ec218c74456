//! What has not settled is marked wherever its numbers are shown: in maps of quantities, in cuts and in curves.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{axis, map, record, span};
use squealmap::engine::record::{Others, Record};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::cut::{Cut, cut_csv, cut_svg};
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap::sweep::spec::Starts;

/// A column with the number of the instance as its value.
fn column(name: &str, instances: usize) -> NumberColumn {
    let values = (0..instances).map(|k| Some(k as f64)).collect();
    NumberColumn { name: name.to_owned(), unit: "m".to_owned(), meaning: String::new(), values }
}

/// A map in which these instances have not settled.
fn sweep(grid: Grid, unsettled: &[usize]) -> Map {
    map(grid, |k, _| record(Kind::Stable, Regime::Slip, !unsettled.contains(&k)))
}

/// How many areas or marks are drawn as not settled, and whether the legend says so.
fn marked(svg: &str) -> (usize, bool) {
    (svg.matches("class=\"unsettled\"").count(), svg.contains(">not settled"))
}

fn quantity(map: &Map, column: &NumberColumn) -> String {
    let contents = vec![Content::quantity(column)];
    look_svg(map, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap()
}

#[test]
fn unsettled_cells_are_dotted_and_no_others() {
    let axes = || Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 6), span(Param::MuD, 0.0, 0.6, 6)]);
    // One among the light cells (mu_s = 0.12), one among the dark ones (mu_s = 0.6), both at mu_d = 0.24.
    let map = sweep(axes(), &[8, 32]);
    let svg = quantity(&map, &column("x2_std", 36));
    assert_eq!(marked(&svg), (2, true), "black dots on light, white ones on dark");
    assert!(svg.contains(">not settled (2)<"));
    let picture = draw(&svg, "unsettled_map");
    let frame = frames(&svg)[0];
    // Several colours in a dotted cell, one in any other.
    let colours = |i: usize, j: usize| {
        let at = |k: usize| {
            let (right, up) = (((k % 20) as f64 + 0.5) / 20.0, ((k / 20) as f64 + 0.5) / 20.0);
            let inside = |cell: usize, part: f64| (cell as f64 + 0.1 + 0.8 * part) / 6.0;
            colour(&picture, frame, (inside(i, right), inside(j, up)))
        };
        let mut seen: Vec<[u8; 3]> = (0..400).map(at).collect();
        seen.sort_unstable();
        seen.dedup();
        seen.len()
    };
    for (i, j) in (0..36).map(|k| (k / 6, k % 6)) {
        assert_eq!(colours(i, j) > 1, (i, j) == (1, 2) || (i, j) == (5, 2), "{i} {j}");
    }
    // What belongs to the equilibrium, or is read before the window, is as good there as elsewhere.
    for name in ["growth_rate", "phase", "growth_rate_measured"] {
        assert_eq!(marked(&quantity(&map, &column(name, 36))), (0, false), "{name}");
    }
    assert_eq!(marked(&quantity(&sweep(axes(), &[]), &column("x2_std", 36))), (0, false));
}

/// What ends in the equilibrium still decays where more than a hundredth of the largest vibration is left of it: that is said of the sizes of a
/// vibration alone.
#[test]
fn what_still_decays_is_marked_like_what_has_not_settled() {
    let axes = Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 6), span(Param::MuD, 0.0, 0.6, 6)]);
    let at_rest = [0, 1, 2, 7];
    let map = map(axes, |k, _| {
        record(Kind::Stable, if at_rest.contains(&k) { Regime::Equilibrium } else { Regime::Slip }, true)
    });
    // 0 and 0.2 of 35 have died out, 2 and 7 have not.
    let mut sizes = column("x2_std", 36);
    sizes.values[1] = Some(0.2);
    assert!(quantity(&map, &sizes).contains(">not settled (2)<"));
    sizes.name = "x2_mean".to_owned();
    assert_eq!(marked(&quantity(&map, &sizes)), (0, false));
}

#[test]
fn unsettled_points_are_dotted() {
    let keys = vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::MuD)];
    let rows = (0..9).map(|k| [0.1 * f64::from(k), f64::from(k % 4)].map(Value::Number).to_vec()).collect();
    let svg = quantity(&sweep(Grid::Tuples { keys, rows }, &[3, 7]), &column("ax_rms", 9));
    assert_eq!(marked(&svg), (2, true));
}

/// A column of the large start asks the large start.
#[test]
fn every_start_has_its_own_verdict() {
    let grid = Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 6), span(Param::MuD, 0.0, 0.6, 6)]);
    let mut map = map(grid, |k, _| {
        let large = record(Kind::Stable, Regime::Slip, k != 20);
        let others = Some(Others::Large(Box::new(Record { kind: None, linear: None, ..large })));
        Record { others, ..record(Kind::Stable, Regime::Slip, k > 1) }
    });
    map.spec.analysis.starts = Starts::Both;
    assert!(quantity(&map, &column("x2_std", 36)).contains(">not settled (2)<"));
    assert!(quantity(&map, &column("x2_std_large", 36)).contains(">not settled (1)<"));
}

#[test]
fn unsettled_points_of_a_cut_have_open_marks() {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        axis(Param::MuD, &[0.1, 0.2]),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    // The first axis varies slowest: instance 4 i + 2 j + k. Instances 5 and 22 lie on the cut, 6 does not.
    let map = sweep(Grid::Axes(axes), &[5, 23, 6]);
    let cut = Cut::new(&map.spec.grid, "belt_velocity=3").unwrap();
    let (amplitude, growth) = (column("x2_std", 52), column("growth_rate", 52));
    let svg = cut_svg(&map, &cut, &[&amplitude, &growth], &Look::default());
    draw(&svg, "unsettled_cut");
    assert_eq!(marked(&svg), (2, true), "of the amplitude alone");
    assert_eq!(marked(&cut_svg(&map, &cut, &[&growth], &Look::default())), (0, false));
    let table = String::from_utf8(cut_csv(&map, &cut, &[&amplitude, &growth]).unwrap()).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][5..], ["x2_std", "x2_std_settled", "growth_rate"]);
    for row in &rows[1..] {
        assert_eq!(row[6], if ["5", "23"].contains(&row[5]) { "0" } else { "1" }, "{row:?}");
    }
}
