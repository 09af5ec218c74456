//! What an editor would send back: words beyond the page, boxes for letters, axes without a scale, two notations in one
//! figure, edges that nearly meet.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::results::angles::attribute;
use crate::results::figure::{draw, frames};
use crate::results::gallery::all;
use crate::results::gallery_plots::plots;
use crate::results::pictures::outside;
use crate::synthetic::{map, number, paper_like, span};
use squealmap::model::Param;
use squealmap::results::figure::look::{Content, Journal, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::figure::palette::Colouring;
use squealmap::results::number::NumberColumn;
use squealmap::study::Picture;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap_figure::glyphs::missing;

/// The figures of every kind, and what `plot` makes of maps, have no letter without a glyph; a title may.
#[test]
fn every_letter_has_a_glyph_or_is_named() {
    for (name, svg) in all().into_iter().map(|piece| (piece.kind.name(), piece.svg)).chain(plots()) {
        assert_eq!(missing(&svg).unwrap(), [' '; 0], "{name}");
    }
    let piece = &all()[0];
    let picture = Picture::read(piece.directory.path(), piece.kind).unwrap();
    let look = Look { title: Some("Bremse <漢字> & Größe µ 漢 😀".to_owned()), ..Look::default() };
    assert_eq!(missing(&picture.svg(&look).unwrap()).unwrap(), ['漢', '字', '😀']);
}

/// A word longer than the page goes on in the next line.
#[test]
fn long_words_stay_on_the_page() {
    let word = "Reibungsschwingungsstabilitätskarte".repeat(6);
    for piece in all() {
        let picture = Picture::read(piece.directory.path(), piece.kind).unwrap();
        let look = Look { title: Some(format!("A {word} B")), ..Look::of_journal(Journal::Elsevier1Col) };
        let svg = picture.svg(&look).unwrap();
        assert!(outside(&svg).is_empty(), "{}: {:?}", piece.kind.name(), outside(&svg));
        let bold = svg
            .lines()
            .filter(|line| line.contains("font-weight=\"bold\"") && line.contains("font-size=\"9\""));
        let lines: Vec<&str> = bold.filter_map(|line| line.split_once('>')?.1.split('<').next()).collect();
        assert_eq!(lines.concat().replace(' ', ""), format!("A{word}B"), "{}", piece.kind.name());
    }
}

/// Wherever an axis has two values it has two labels, however narrow its panel.
#[test]
fn every_axis_has_two_ticks() {
    for (low, high) in [(0.1, 0.5), (0.21, 0.34), (0.05, 0.35), (0.38, 0.42), (0.011, 0.019), (0.3, 0.9)] {
        let rows: Vec<Vec<Value>> = (0..24)
            .map(|k| {
                let at = |part: u32| low + (high - low) * f64::from(part) / 3.0;
                [at(k % 4), at(k / 2 % 4), f64::from(k / 4)].map(Value::Number).to_vec()
            })
            .collect();
        let keys = [Param::MuS, Param::MuD, Param::BeltVelocity].map(AxisKey::Param).to_vec();
        let sweep = map(Grid::Tuples { keys, rows: rows.into() }, |_, at| {
            paper_like(number(at[0]), number(at[1]), 1.0)
        });
        for journal in [Journal::Elsevier1Col, Journal::Elsevier2Col] {
            let contents = vec![Content::classes(Colouring::Type, false)];
            let svg = look_svg(&sweep, &Look { contents, ..Look::of_journal(journal) }).unwrap();
            draw(&svg, &format!("two_ticks_{low}_{}", journal.name()));
            let frames = frames(&svg);
            let last = frames.iter().map(|frame| frame[1] + frame[3]).fold(0.0, f64::max);
            let place = |line: &str, name: &str| attribute(line, name).unwrap().parse::<f64>().unwrap();
            let words =
                || svg.lines().filter(|line| line.starts_with("<text") && line.contains("font-size=\"7\""));
            for frame in frames.iter().filter(|frame| (frame[1] + frame[3] - last).abs() < 0.1) {
                let below = |line: &&str| {
                    let (x, y) = (place(line, "x"), place(line, "y"));
                    y > last && y < last + 12.0 && x >= frame[0] - 0.1 && x <= frame[0] + frame[2] + 0.1
                };
                assert!(words().filter(below).count() >= 2, "{low} to {high}, {}: {frame:?}", journal.name());
            }
            let first = frames.iter().map(|frame| frame[0]).fold(f64::INFINITY, f64::min);
            let left = words().filter(|line| place(line, "x") < first && line.contains("\"end\"")).count();
            let rows = frames.iter().filter(|frame| (frame[0] - first).abs() < 0.1).count();
            assert!(left >= 2 * rows, "{low} to {high}, {}: {left} labels of {rows} rows", journal.name());
        }
    }
}

/// A plane of amplitudes with a power of ten in their bar.
fn amplitudes(sweep: &Map) -> NumberColumn {
    let value = |k: usize| {
        let at = sweep.spec.grid.coordinates(k);
        Some(5e-3 * number(at[0]) + at.get(1).map_or(0.0, |y| 4e-3 * number(y)))
    };
    let values = (0..sweep.spec.grid.len()).map(value).collect();
    NumberColumn { name: "x2_std".to_owned(), unit: "m".to_owned(), meaning: String::new(), values }
}

/// The values on lines are those of the bar, with the power of ten of the heading, and stand in the bar too; short lines have theirs.
#[test]
fn a_map_has_one_notation() {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 5), span(Param::MuD, 0.0, 0.6, 5)];
    let sweep = map(Grid::Axes(axes), |_, _| paper_like(0.1, 0.1, 1.0));
    let column = amplitudes(&sweep);
    let levels = [0.0012, 0.0027, 0.0046];
    let contents = vec![Content::Quantity { column: &column, levels: &levels }];
    let svg = look_svg(&sweep, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    draw(&svg, "one_notation");
    assert!(!svg.contains(">0.00"), "{svg:.3000}");
    for label in ["1.2", "2.7", "4.6"] {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
    let factor = svg.lines().find(|line| line.starts_with("<text") && line.contains("(10<")).unwrap();
    let words: String = factor.split('>').filter_map(|part| part.split('<').next()).collect();
    assert_eq!(words.trim(), "Standard deviation of x2 (10−3 m)");
    let marks = svg.lines().rfind(|line| line.contains("class=\"level\"")).unwrap();
    assert_eq!(marks.matches('M').count(), 3, "three lines across the bar");
}

/// The light line below the dashes of the limit is no wider than they are: what is beside it is seen.
#[test]
fn the_limit_hides_nothing() {
    let svg = &all()[0].svg;
    let limit: Vec<&str> = svg.lines().filter(|line| line.contains("stroke-dasharray=\"2.2 1.2\"")).collect();
    assert!(!limit.is_empty());
    for dashes in limit.into_iter().filter(|line| line.starts_with("<path")) {
        let below = attribute(dashes, "d").unwrap();
        let both: Vec<f64> = svg
            .lines()
            .filter(|line| attribute(line, "d") == Some(below))
            .filter_map(|line| attribute(line, "stroke-width")?.parse().ok())
            .collect();
        assert!(both.iter().all(|width| *width <= 0.75), "{both:?}");
    }
}

/// Strips and curves that stand one below the other begin and end together.
#[test]
fn stacked_panels_are_aligned() {
    let sweep =
        map(Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 25)]), |_, at| paper_like(number(at[0]), 0.2, 1.0));
    let small = amplitudes(&sweep);
    let values = small.values.iter().map(|value| value.map(|x| 1e6 * x - 300.0)).collect();
    let large =
        NumberColumn { name: "growth_rate".to_owned(), unit: "1/s".to_owned(), values, ..small.clone() };
    let contents = vec![
        Content::classes(Colouring::Type, false),
        Content::quantity(&small),
        Content::quantity(&large),
        Content::classes(Colouring::Regime, false),
    ];
    let svg = look_svg(&sweep, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    draw(&svg, "aligned");
    let ends: Vec<[f64; 2]> = frames(&svg).iter().map(|frame| [frame[0], frame[0] + frame[2]]).collect();
    assert_eq!(ends.len(), 4);
    assert!(ends.iter().all(|end| (end[0] - ends[0][0]).hypot(end[1] - ends[0][1]) < 0.02), "{ends:?}");
    assert!(outside(&svg).is_empty(), "{:?}", outside(&svg));
}
