//! Angles in figures: −180° and 180° are one, in colours and along curves.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::colour::{DICHROMACIES, lab};
use crate::results::curves::places;
use crate::results::figure::{draw, frames};
use crate::synthetic::{axis, map, paper_like, span};
use squealmap::model::Param;
use squealmap::results::cut::{Cut, cut_svg};
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::Grid;
use squealmap::sweep::map::Map;

/// The value of an attribute of an element.
pub(crate) fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

fn phase(values: Vec<Option<f64>>) -> NumberColumn {
    NumberColumn { name: "phase".to_owned(), unit: "deg".to_owned(), meaning: String::new(), values }
}

pub(crate) fn sweep(columns: usize, rows: usize) -> Map {
    let axes = vec![span(Param::MuS, 0.0, 0.6, columns), span(Param::MuD, 0.0, 0.6, rows)];
    map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0))
}

/// A map of angles and the colours of its bar, from −180° on.
pub(crate) fn drawn(sweep: &Map, column: &NumberColumn) -> (String, Vec<String>) {
    let look = Look { contents: vec![Content::quantity(column)], width: Some(90.0), ..Look::default() };
    let svg = look_svg(sweep, &look).unwrap();
    let bar = svg.lines().filter(|line| line.starts_with("<rect") && !line.contains("stroke"));
    let colours = bar.filter_map(|line| attribute(line, "fill")).filter(|fill| *fill != "#FFFFFF");
    let colours = colours.map(str::to_owned).collect();
    (svg, colours)
}

/// The colours close a circle in even steps, and angles a quarter of a turn apart are told apart by everyone.
#[test]
fn colours_of_angles_close_a_circle() {
    let (svg, bar) = drawn(&sweep(3, 3), &phase(vec![Some(10.0); 9]));
    assert_eq!(bar.len(), 48);
    for tick in ["−180", "−90", "90", "180"] {
        assert!(svg.contains(&format!(">{tick}</text>")), "{tick}");
    }
    let apart = |seen: &[[f64; 3]; 3], i: usize, j: usize| {
        let [one, other] = [i, j].map(|k| lab(&bar[k % 48], seen));
        (0..3).map(|k| (one[k] - other[k]).powi(2)).sum::<f64>().sqrt()
    };
    // The distance in CIELAB: of neighbours, the last and the first among them, and of quarters of a turn and more.
    for (name, seen) in &DICHROMACIES {
        let steps: Vec<f64> = (0..48).map(|k| apart(seen, k, k + 1)).collect();
        let [least, most] = [f64::min, f64::max].map(|of| steps.iter().copied().reduce(of).unwrap());
        assert!(least > 2.5 && most < 8.5, "{name}: {least} to {most}");
        assert!(*name != "normal" || most < 1.4 * least, "even steps: {least} to {most}");
        for (k, colour) in bar.iter().enumerate() {
            let nearest = (12..=36).map(|away| apart(seen, k, k + away)).fold(f64::INFINITY, f64::min);
            assert!(nearest > 30.0, "{name}: {nearest} from {colour}");
        }
    }
}

/// Cells of −180°, 180° and 540° are one area, those of 179° another; without ends nothing is white or black.
#[test]
fn ends_of_the_circle_have_one_colour() {
    let angles = [-180.0, 180.0, 540.0, 179.0, 0.5, 0.5];
    let (svg, bar) = drawn(&sweep(3, 2), &phase([0, 3, 1, 4, 2, 5].map(|k| Some(angles[k])).to_vec()));
    let count = |colour: &str| {
        let areas =
            svg.lines().filter(|line| line.starts_with("<path") && attribute(line, "fill") == Some(colour));
        areas.map(|line| line.matches('M').count()).sum::<usize>()
    };
    // Three cells of a row in one outline; the upper row is the next to the last colour and the middle one.
    assert_eq!([&bar[0], &bar[47], &bar[24]].map(|colour| count(colour)), [1, 1, 1]);
}

/// A phase that goes around has no line from one side of a panel to the other, in curves along one axis and in cuts.
#[test]
fn curves_of_angles_do_not_run_across_a_panel() {
    let angle = |x: f64| (-160.0 - 900.0 * x + 180.0_f64).rem_euclid(360.0) - 180.0;
    let along = |x: Vec<f64>| phase(x.into_iter().map(|x| Some(angle(x))).collect());
    let line = map(Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 61)]), |_, _| paper_like(0.1, 0.1, 1.0));
    let column = along((0..61).map(|k| 0.01 * f64::from(k)).collect());
    let (curve, _) = drawn(&line, &column);
    let axes = vec![span(Param::MuS, 0.0, 0.6, 61), axis(Param::MuD, &[0.1, 0.2])];
    let two = map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0));
    let cut = Cut::new(&two.spec.grid, "mu_d=0.1").unwrap();
    let column = along((0..122).map(|k| 0.01 * f64::from(k / 2)).collect());
    let cut = cut_svg(&two, &cut, &[&column], &Look::default());
    for (name, svg) in [("curve_of_angles", &curve), ("cut_of_angles", &cut)] {
        draw(svg, name);
        let [frame] = frames(svg)[..] else { panic!("{:?}", frames(svg)) };
        let path = svg.lines().find(|line| line.starts_with("<path") && line.contains("#1F3F8F")).unwrap();
        let data = attribute(path, "d").unwrap();
        let pieces: Vec<Vec<[f64; 2]>> =
            data.split('M').skip(1).map(|piece| places(&format!("d=\"M{piece}\""))).collect();
        // 540° in all, from −160° down: around at 20° and at 380°.
        assert_eq!(pieces.len(), 3, "{name}");
        for pair in pieces.iter().flat_map(|piece| piece.windows(2)) {
            assert!((pair[1][1] - pair[0][1]).abs() < 0.1 * frame[3], "{name}: {pair:?}");
        }
        // Each piece but the ends of the curve reaches ±180°, 8 % of the panel's scale from its ends.
        let reach =
            |piece: &[[f64; 2]]| [piece[0][1], piece[piece.len() - 1][1]].map(|y| (y - frame[1]) / frame[3]);
        let [top, bottom] = [0.08 / 1.16, 1.08 / 1.16];
        let [_, first] = reach(&pieces[0]);
        let [from, to] = reach(&pieces[1]);
        assert!(
            (first - bottom).abs() < 1e-3 && (from - top).abs() < 1e-3 && (to - bottom).abs() < 1e-3,
            "{name}"
        );
    }
}
