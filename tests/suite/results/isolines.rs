//! Lines of equal value and cuts, against planes, cones and functions that are known.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::common::near;
use crate::results::figure::draw;
use crate::results::pictures::outside;
use crate::synthetic::{axis, map, number, paper_like, span};
use squealmap::model::Param;
use squealmap::results::cut::{Cut, cut_csv, cut_svg};
use squealmap::results::error::Error;
use squealmap::results::figure::isolines::{isoline_table, round_levels};
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap_figure::marching::isolines;

/// A map of these axes, and a quantity that is a function of their values.
fn quantity(axes: Vec<Axis>, of: impl Fn(&[f64]) -> Option<f64>) -> (Map, NumberColumn) {
    let grid = Grid::Axes(axes);
    let at = |k: usize| grid.coordinates(k).into_iter().map(number).collect::<Vec<_>>();
    let values = (0..grid.len()).map(|k| of(&at(k))).collect();
    let column = NumberColumn {
        name: "growth_rate".to_owned(),
        unit: "1/s".to_owned(),
        meaning: String::new(),
        values,
    };
    (map(grid, |_, _| paper_like(0.1, 0.1, 1.0)), column)
}

/// The lines of a table: panel, value and places of each.
fn lines(table: &[u8]) -> Vec<(usize, f64, Vec<[f64; 2]>)> {
    let text = std::str::from_utf8(table).unwrap();
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    assert_eq!(rows.next().unwrap(), ["panel", "quantity", "value", "x", "y"]);
    let mut found = Vec::new();
    let mut line = Vec::new();
    for row in rows {
        assert_eq!(row[1], "growth_rate");
        let [value, x, y] = [2, 3, 4].map(|k| row[k].parse::<f64>().unwrap());
        if x.is_nan() {
            assert!(y.is_nan());
            found.push((row[0].parse().unwrap(), value, std::mem::take(&mut line)));
        } else {
            line.push([x, y]);
        }
    }
    assert!(line.is_empty(), "every line ends");
    found
}

/// Linear interpolation is exact on a plane: `2x − 3y + v/10` is the level everywhere on its lines, from edge to edge.
#[test]
fn lines_of_a_plane_are_straight() {
    let plane = |[x, y, v]: [f64; 3]| 2.0 * x - 3.0 * y + 0.1 * v;
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 14),
        span(Param::MuD, 0.0, 0.6, 9),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    let (map, column) = quantity(axes, |at| Some(plane([at[0], at[1], at[2]])));
    let levels = [-0.5, 0.0, 0.25];
    let found = lines(&isoline_table(&map, &[(&column, &levels)]).unwrap());
    assert_eq!(found.len(), 2 * levels.len(), "one line of each in each panel");
    for (panel, value, line) in &found {
        let v = [1.0, 3.0][panel - 1];
        for [x, y] in line {
            near("the plane on its line", plane([*x, *y, v]), *value, 1e-12);
        }
        // Both ends lie on the border of the picture's points.
        for end in [line[0], line[line.len() - 1]] {
            let on_border = end.iter().any(|x| [0.0, 0.6].iter().any(|border| (x - border).abs() < 1e-12));
            assert!(on_border, "{end:?}");
        }
    }
    // A plane that is a little steeper does not pass.
    let (_, steeper) = quantity(
        vec![
            span(Param::MuS, 0.0, 0.6, 14),
            span(Param::MuD, 0.0, 0.6, 9),
            axis(Param::BeltVelocity, &[1.0, 3.0]),
        ],
        |at| Some(2.01 * at[0] - 3.0 * at[1] + 0.1 * at[2]),
    );
    let worst = lines(&isoline_table(&map, &[(&steeper, &levels)]).unwrap())
        .into_iter()
        .flat_map(|(panel, value, line)| line.into_iter().map(move |at| (panel, value, at)))
        .map(|(panel, value, [x, y])| (plane([x, y, [1.0, 3.0][panel - 1]]) - value).abs())
        .fold(0.0, f64::max);
    assert!(worst > 1e-3, "{worst}");
}

/// Round values of an angle are parts of a turn.
#[test]
fn levels_of_angles_are_parts_of_a_turn() {
    let of = |low: f64, high: f64, unit: &str, most: usize| {
        let values = vec![Some(low), None, Some(high)];
        let (name, meaning) = ("phase".to_owned(), String::new());
        round_levels(&NumberColumn { name, unit: unit.to_owned(), meaning, values }, most)
    };
    assert_eq!(of(-71.8, 176.2, "deg", 4), [0.0, 90.0]);
    assert_eq!(of(-71.8, 176.2, "deg", 6), [-45.0, 0.0, 45.0, 90.0, 135.0]);
    assert_eq!(of(-180.0, 180.0, "deg", 2), [-180.0, -90.0, 0.0, 90.0, 180.0]);
    assert_eq!(of(-71.8, 176.2, "1/s", 4), [0.0, 100.0]);
}

/// A cone has circles: closed, each once, within the error h²/(8 r) of linear interpolation.
#[test]
fn lines_of_a_cone_are_circles() {
    const POINTS: usize = 101;
    let h = 2.0 / (POINTS - 1) as f64;
    let at = |i: usize, j: usize| [i, j].map(|k| -1.0 + h * k as f64);
    let cone = |i: usize, j: usize| {
        let [x, y] = at(i, j);
        Some(x.hypot(y))
    };
    for radius in [0.15, 0.5, 0.93] {
        let found = isolines([POINTS; 2], radius, cone);
        assert_eq!(found.len(), 1, "radius {radius}");
        assert_eq!(found[0].first(), found[0].last(), "closed");
        for [i, j] in &found[0] {
            let [x, y] = [i, j].map(|k| -1.0 + h * k);
            near("distance from the middle", x.hypot(y), radius, h * h / (8.0 * (radius - h)));
        }
        // Straight pieces of a circle are shorter than it by (h/r)²/24 at most.
        let length: f64 = found[0]
            .windows(2)
            .map(|pair| h * (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]))
            .sum();
        near("circumference", length / radius, std::f64::consts::TAU, 0.01);
    }
    assert!(isolines([POINTS; 2], 2.0, cone).is_empty(), "beyond the corners there is none");
}

#[test]
fn saddles_and_gaps() {
    // Two corners above, across each other: two lines, never one through the other.
    let saddle = |i: usize, j: usize| Some(if i == j { 1.0 } else { 0.0 });
    for level in [0.4, 0.6] {
        let found = isolines([2, 2], level, saddle);
        assert_eq!(found.len(), 2, "{found:?}");
        // The middle is 0.5: it joins the corners that are above where the level is below it.
        let through = |corner: [f64; 2]| {
            found.iter().any(|line| {
                line.iter().all(|at| (at[0] - corner[0]).abs() + (at[1] - corner[1]).abs() <= 1.0)
            })
        };
        assert_eq!(through([1.0, 0.0]), level < 0.5, "level {level}: {found:?}");
    }
    // An undefined point interrupts a line.
    let ramp = |i: usize, j: usize| (j != 2).then_some(i as f64);
    let found = isolines([4, 6], 1.5, ramp);
    assert_eq!(found.len(), 2);
    assert!(
        found.iter().flatten().all(|[i, j]| (*i - 1.5).abs() < 1e-12 && !(1.0 < *j && *j < 3.0)),
        "{found:?}"
    );
    assert!(isolines([1, 5], 0.5, |_, j| Some(j as f64)).is_empty(), "a column has no squares");
}

#[test]
fn lines_are_drawn_and_labelled_on_a_log_axis_too() {
    let k2 = Axis { log: true, ..axis(Param::K2, &[1e3, 1e4, 1e5, 1e6, 1e7]) };
    let (mut map, column) =
        quantity(vec![k2, span(Param::MuD, 0.0, 0.6, 31)], |at| Some(at[0].log10() + 10.0 * at[1]));
    map.spec.title = "Lines of equal value".to_owned();
    // In the logarithm the quantity is a plane.
    let levels = [5.0, 7.5, 10.0];
    let found = lines(&isoline_table(&map, &[(&column, &levels)]).unwrap());
    assert_eq!(found.len(), 3);
    for (_, value, line) in &found {
        for [x, y] in line {
            near("the plane on its line", x.log10() + 10.0 * y, *value, 1e-9);
        }
    }
    let contents = vec![Content::Quantity { column: &column, levels: &levels }];
    let svg = look_svg(&map, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    draw(&svg, "isolines");
    assert_eq!(svg.matches("class=\"isoline\"").count(), 1, "one path for all lines of a panel");
    for label in [">5<", ">7.5<", ">10<"] {
        assert!(svg.contains(label), "{label}");
    }
    // From 3 to 13.
    assert_eq!(round_levels(&column, 6), [4.0, 6.0, 8.0, 10.0, 12.0]);
}

/// Three axes: a cut at one velocity has a curve for each value of the shorter of the two others.
#[test]
fn a_cut_is_the_function_along_its_axis() {
    let axes = vec![
        axis(Param::MuS, &[0.5, 0.1, 0.3]),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    let of = |at: &[f64]| at[0] + 10.0 * at[1] * at[1] + 100.0 * at[2];
    let (map, column) = quantity(axes, |at| (at[1] < 0.57).then(|| of(at)));
    let grid = &map.spec.grid;
    let cut = Cut::new(grid, "belt_velocity = 3").unwrap();
    assert_eq!(cut.axis.key, AxisKey::Param(Param::MuD));
    assert_eq!(cut.held, [(AxisKey::Param(Param::BeltVelocity), Value::Number(3.0))]);
    assert_eq!((cut.panels.len(), cut.panels[0].curves.len()), (1, 3));
    let table = String::from_utf8(cut_csv(&map, &cut, &[&column]).unwrap()).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["panel", "curve", "mu_s", "mu_d", "belt_velocity", "growth_rate"]);
    assert_eq!(rows.len(), 1 + 3 * 13);
    for (k, row) in rows[1..].iter().enumerate() {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        assert_eq!((row[0], row[1].parse::<usize>().unwrap(), row[4]), ("1", k / 13 + 1, "3"));
        near("mu_d", number(3), 0.05 * (k % 13) as f64, 1e-12);
        near("mu_s", number(2), [0.5, 0.1, 0.3][k / 13], 0.0);
        if k % 13 == 12 {
            assert_eq!(row[5], "", "undefined there");
        } else {
            near("the function", number(5), of(&[number(2), number(3), 3.0]), 1e-12);
        }
    }
    // Without anything beyond there is one curve; with nothing held there are panels.
    let one = Cut::new(grid, "mu_s=0.3,belt_velocity=1").unwrap();
    assert_eq!((one.panels.len(), one.panels[0].curves.len()), (1, 1));
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 40),
        axis(Param::MuD, &[0.1, 0.2, 0.3]),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
        axis(Param::Theta, &[0.01, 0.02]),
    ];
    let (map, column) = quantity(axes, |at| Some(at[0] * (at[1] + at[2]) / at[3]));
    let cut = Cut::new(&map.spec.grid, "theta=0.02").unwrap();
    assert_eq!((cut.panels.len(), cut.panels[0].curves.len()), (3, 2), "the shortest has the curves");
    for (width, name) in [(None, "cut"), (Some(90.0), "cut_narrow")] {
        let svg = cut_svg(&map, &cut, &[&column, &column], &Look { width, ..Look::default() });
        draw(&svg, name);
        assert!(outside(&svg).is_empty(), "{:?}", outside(&svg));
    }
}

#[test]
fn what_is_no_cut_is_refused() {
    let (map, _) = quantity(vec![span(Param::MuS, 0.0, 0.6, 7), span(Param::MuD, 0.0, 0.6, 7)], |_| None);
    for (cut, words) in [
        ("mu_d", "write name=value"),
        ("theta=1", "the map has no axis `theta`; choose from mu_s and mu_d"),
        ("mu_sd=0.1", "the map has no axis `mu_sd`; did you mean `mu_s`?"),
        ("mu_d=0.7", "`mu_d` has no value 0.7; its values go from 0 to 0.6"),
        ("mu_d=-0.06", "`mu_d` has no value -0.06; its values go from 0 to 0.6"),
        ("mu_d=nan", "`mu_d` has numbers, which `nan` is not"),
        ("mu_d=0.2,mu_s=0.1", "no axis of numbers is left"),
    ] {
        let error = Cut::new(&map.spec.grid, cut).unwrap_err();
        assert!(error.is_bad_input() && matches!(error, Error::Cut { .. }), "{error}");
        assert!(error.to_string().contains(words) && error.to_string().contains(cut), "{error}");
    }
    // A step times an index is off by its rounding, and still that value.
    assert_eq!(Cut::new(&map.spec.grid, "mu_d=0.3").unwrap().taken, []);
}
