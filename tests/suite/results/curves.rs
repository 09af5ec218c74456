//! Curves: sweeps of one axis, cuts at several values of an axis, and lines of equal angles.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::common::near;
use crate::results::figure::{draw, frames};
use crate::results::pictures::outside;
use crate::synthetic::{axis, map, number, paper_like, span};
use squealmap::model::Param;
use squealmap::results::cut::Cut;
use squealmap::results::error::Error;
use squealmap::results::figure::isolines::isoline_table;
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::figure::palette::Colouring;
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap_figure::marching::{isolines, lines_of_angle};

fn column(name: &str, unit: &str, values: Vec<Option<f64>>) -> NumberColumn {
    NumberColumn { name: name.to_owned(), unit: unit.to_owned(), meaning: String::new(), values }
}

/// The places of a path, points.
pub(crate) fn places(path: &str) -> Vec<[f64; 2]> {
    let data = path.split_once("d=\"").unwrap().1.split_once('"').unwrap().0;
    let pairs = data.split(['M', 'L']).filter(|pair| !pair.is_empty());
    pairs
        .map(|pair| {
            let (x, y) = pair.split_once(' ').unwrap();
            [x, y].map(|number| number.parse().unwrap())
        })
        .collect()
}

/// One axis of numbers: a quantity is a curve through its values, below it the type as a strip with the same axis.
#[test]
fn a_sweep_of_one_axis_has_curves() {
    let of = |mu: f64| 4.0 * (mu - 0.3) * (mu - 0.3) - 0.1;
    let axes = vec![span(Param::MuS, 0.0, 0.6, 25), axis(Param::BeltVelocity, &[3.0])];
    let mut sweep = map(Grid::Axes(axes), |k, at| {
        let mut record = paper_like(number(at[0]), 0.2, 3.0);
        record.settled = Some(k != 7);
        record
    });
    sweep.spec.title.clear();
    let values = (0..25).map(|k| (k != 12).then(|| of(0.025 * f64::from(k)))).collect();
    let column = column("x2_mean", "m", values);
    let quantity = Content::Quantity { column: &column, levels: &[0.0, 9.0] };
    let contents = vec![Content::classes(Colouring::Type, false), quantity];
    let svg =
        look_svg(&sweep, &Look { contents: contents.clone(), width: Some(90.0), ..Look::default() }).unwrap();
    draw(&svg, "curve_and_strip");
    assert!(outside(&svg).is_empty(), "{:?}", outside(&svg));
    let [strip, frame] = frames(&svg)[..] else { panic!("{:?}", frames(&svg)) };
    assert!(frame[3] > 100.0 && strip[3] < 30.0, "a panel of a curve, and a strip");
    let path =
        svg.lines().find(|line| line.contains("stroke=\"#1F3F8F\"") && line.starts_with("<path")).unwrap();
    let found = places(path);
    // The instance without a value interrupts the curve; the vertical scale has 8 % above and below.
    assert_eq!((found.len(), path.matches('M').count()), (24, 2));
    let (low, high) = (of(0.275), of(0.0));
    let [low, high] = [low - 0.08 * (high - low), high + 0.08 * (high - low)];
    for (at, k) in found.iter().zip((0..25).filter(|k| *k != 12)) {
        let mu = 0.025 * f64::from(k);
        // Cells reach half a step beyond the values, as in the strip.
        near("x", at[0], frame[0] + (mu + 0.0125) / 0.625 * frame[2], 0.011);
        near("y", at[1], frame[1] + (high - of(mu)) / (high - low) * frame[3], 0.011);
    }
    assert_eq!(svg.matches("class=\"isoline\"").count(), 1, "9 is beyond the axis");
    assert_eq!(svg.matches("class=\"unsettled\"").count(), 1, "one open mark");
    assert!(svg.contains("(a)") && svg.contains("(b)"));
    // Beside one another the same pieces are drawn.
    let wide = look_svg(&sweep, &Look { contents, width: Some(190.0), ..Look::default() }).unwrap();
    draw(&wide, "curve_and_strip_wide");
    assert_eq!(frames(&wide).len(), 2);
    // The cut that would leave no axis says what to do instead.
    let error = Cut::new(&sweep.spec.grid, "mu_s=0.3").unwrap_err();
    assert!(
        matches!(error, Error::Cut { .. })
            && error.to_string().contains("without it --quantity draws a curve")
    );
}

/// An axis that is named several times has a curve for each value; a value that is named twice counts once.
#[test]
fn a_cut_at_several_values_has_a_curve_for_each() {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        axis(Param::MuD, &[0.1, 0.2, 0.3, 0.4]),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    let sweep = map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0));
    let grid = &sweep.spec.grid;
    let of = |cut: &Cut| -> Vec<Vec<Value>> {
        let curves = |panel: &squealmap::results::cut::CutPanel| {
            panel
                .curves
                .iter()
                .filter_map(|curve| curve.of.as_ref().map(|(_, value)| value.clone()))
                .collect()
        };
        cut.panels.iter().map(curves).collect()
    };
    let cut = Cut::new(grid, "mu_d=0.1,mu_d=0.3,belt_velocity=3,mu_d=0.1").unwrap();
    assert_eq!(cut.held, [(AxisKey::Param(Param::BeltVelocity), Value::Number(3.0))]);
    assert_eq!(of(&cut), [[0.1, 0.3].map(Value::Number)]);
    // mu_s varies slowest, then mu_d, then the velocity.
    for (curve, j) in cut.panels[0].curves.iter().zip([0, 2]) {
        assert_eq!(curve.instances, (0..13).map(|i| 8 * i + 2 * j + 1).collect::<Vec<_>>());
    }
    // What is left free has panels, even where it is shorter.
    let cut = Cut::new(grid, "mu_d=0.1,mu_d=0.2,mu_d=0.4").unwrap();
    assert_eq!(of(&cut), vec![[0.1, 0.2, 0.4].map(Value::Number); 2]);
    assert_eq!(cut.panels[1].of, [(AxisKey::Param(Param::BeltVelocity), Value::Number(3.0))]);
}

/// An angle that winds once around a point: rays, and none along the jump from 180° to −180° but that of 180° itself.
#[test]
fn lines_of_angles_know_the_circle() {
    const N: usize = 41;
    let angle = |i: usize, j: usize| {
        let [x, y] = [i, j].map(|k| k as f64 - 20.3);
        Some(y.atan2(x).to_degrees())
    };
    for level in [-135.0_f64, -60.0, 0.0, 45.0, 120.0, 180.0] {
        let found = lines_of_angle([N, N], level, angle);
        assert_eq!(found.len(), 1, "{level}: {found:?}");
        for [i, j] in &found[0] {
            let [x, y] = [i, j].map(|k| k - 20.3);
            let away = (y.atan2(x).to_degrees() - level + 180.0).rem_euclid(360.0) - 180.0;
            // Linear interpolation near the point itself is coarse.
            assert!(away.abs() < 30.0 / x.hypot(y).max(1.0), "{level}: {away} at {x}, {y}");
        }
        // As a plain number the same field has a second line along the jump.
        if level.abs() < 180.0 {
            assert!(isolines([N, N], level, angle).iter().flatten().count() > found[0].len());
        }
    }
}

/// The table of a map uses the circle for degrees, and only for them; 180° and −180° are one line.
#[test]
fn only_degrees_are_angles() {
    let axes = vec![span(Param::MuS, -1.0, 1.0, 21), span(Param::MuD, -1.01, 1.0, 20)];
    let sweep = map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0));
    let values: Vec<Option<f64>> = (0..420)
        .map(|k| {
            let at = sweep.spec.grid.coordinates(k);
            Some((number(at[1]) - 0.003).atan2(number(at[0]) - 0.04).to_degrees())
        })
        .collect();
    let rows = |unit: &str, levels: &[f64]| {
        let table = isoline_table(&sweep, &[(&column("phase", unit, values.clone()), levels)]).unwrap();
        let text = String::from_utf8(table).unwrap();
        text.lines().skip(1).filter(|line| line.ends_with("NaN,NaN")).count()
    };
    assert_eq!([rows("deg", &[60.0]), rows("1/s", &[60.0])], [1, 1]);
    let x_of = |unit: &str| {
        let table = isoline_table(&sweep, &[(&column("phase", unit, values.clone()), &[60.0])]).unwrap();
        let text = String::from_utf8(table).unwrap();
        let x = text.lines().skip(1).filter_map(|line| line.split(',').nth(3)?.parse::<f64>().ok());
        x.filter(|x| x.is_finite()).fold(f64::INFINITY, f64::min)
    };
    assert!(x_of("deg") > -0.1 && x_of("1/s") < -0.9, "no line along the jump, at x < 0");
    assert_eq!(rows("deg", &[180.0, -180.0]), 1);
}

/// A plateau that is zero but for rounding has no lines, and a single instance has none around it; a hill of several has.
#[test]
fn rounding_and_single_instances_have_no_lines() {
    const N: usize = 30;
    let axes = vec![span(Param::MuS, 0.0, 0.6, N), span(Param::MuD, 0.0, 0.6, N)];
    let sweep = map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0));
    let lines = |of: &dyn Fn(f64, f64) -> f64, level: f64| {
        let values = (0..N * N).map(|k| Some(of((k / N) as f64, (k % N) as f64))).collect();
        let table = isoline_table(&sweep, &[(&column("growth_rate", "1/s", values), &[level])]).unwrap();
        String::from_utf8(table).unwrap().lines().filter(|line| line.ends_with("NaN,NaN")).count()
    };
    let noise = |x: f64, y: f64| 1e-12 * (97.0 * x + 31.0 * y).sin();
    // A valley along the diagonal whose floor is zero but for rounding, and a plateau.
    assert_eq!(lines(&|x, y| (x - y).abs() + noise(x, y), 0.0), 0, "the diagonal");
    assert_eq!(lines(&|x, y| -(x - y).abs() + noise(x, y), 0.0), 0, "a ridge");
    assert_eq!(lines(&|x, y| (x - 12.0).max(0.0) + noise(x, y), 0.0), 0, "nothing is below");
    assert_eq!(lines(&|x, y| (12.4 - x).min(0.0) + noise(x, y), 0.0), 1, "the end of the plateau");
    // What is far more than rounding is none, however small beside the largest value.
    assert_eq!(lines(&|x, y| if x + y < 3.0 { 30.0 } else { 1e-7 * (x - 12.4) }, 0.0), 2, "a small slope");
    // A single instance at (9, 9) that is above, by less than the grid resolves; and a hill.
    assert_eq!(lines(&|x, y| if (x, y) == (9.0, 9.0) { 0.2 } else { -1.0 }, 0.0), 0);
    assert_eq!(lines(&|x, y| 4.0 - (x - 9.0).hypot(y - 9.0), 0.0), 1);
}
