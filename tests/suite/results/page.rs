//! The page of a figure: letters of its panels, its title, its height, and the ends of its axes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::results::figure::{draw, frames};
use crate::results::gallery::all;
use crate::results::pictures::outside;
use crate::results::plot::size;
use crate::synthetic::{axis, map, number, paper_like, span};
use squealmap::model::Param;
use squealmap::results::cut::{Cut, cut_svg};
use squealmap::results::error::Error;
use squealmap::results::figure::look::{Content, Journal, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::figure::palette::Colouring;
use squealmap::results::figure::tikz::map_tikz;
use squealmap::study::{Kind, Picture};
use squealmap::sweep::grid::{Axis, Grid};
use squealmap_figure::scale::Scale;

/// The letters of a figure that stand by themselves, from the first on.
fn letters(svg: &str) -> usize {
    ('a'..='z').take_while(|letter| svg.contains(&format!(">({letter})<"))).count()
}

#[test]
fn rows_of_panels_have_letters() {
    for piece in all() {
        let expected = match piece.kind {
            Kind::Map | Kind::Refined | Kind::Modes | Kind::Fit | Kind::Fem | Kind::Vary => 2,
            Kind::Shapes => 1,
            Kind::Trace | Kind::Campaign => 4,
            // Five over time, three close ones.
            Kind::Identify => 8,
            Kind::Hysteresis | Kind::Curves | Kind::Tradeoff | Kind::Mesh => 0,
            Kind::Paper(figure) => match figure.name() {
                "figure2" => 2,
                "figure4" | "figure5" | "figure6" => 3,
                // Their letters stand before words.
                _ => 0,
            },
        };
        assert_eq!(letters(&piece.svg), expected, "{}", piece.kind.name());
    }
}

/// Every figure takes another title, or none: what stands above it is gone, and with it its room.
#[test]
fn every_figure_takes_another_title() {
    for piece in all() {
        let name = piece.kind.name();
        let picture = Picture::read(piece.directory.path(), piece.kind).unwrap();
        let with = |title: Option<&str>| {
            picture.svg(&Look { title: title.map(str::to_owned), ..Look::default() }).unwrap()
        };
        let (own, other, none) = (with(None), with(Some("Words of my own")), with(Some("")));
        assert!(other.contains(">Words of my own</text>"), "{name}");
        assert!(other.contains("<title>Words of my own</title>"), "{name}");
        let bold =
            |svg: &str| svg.lines().filter(|line| line.contains("font-size=\"9\" font-weight")).count();
        assert!(bold(&own) >= 1 && bold(&none) == 0, "{name}: {} {}", bold(&own), bold(&none));
        assert!(size(&none)[1] < size(&own)[1] - 3.0, "{name}");
        assert!(!none.contains("<title></title>"), "{name}: a document has a name all the same");
    }
}

#[test]
fn the_title_is_an_option_of_plot() {
    let piece = all().into_iter().find(|piece| piece.kind == Kind::Map).unwrap();
    let svg = |arguments: &[&str]| {
        let ended = squealmap(piece.directory.path(), &[&["plot", "."], arguments].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        std::fs::read_to_string(piece.directory.path().join("plot.svg")).unwrap()
    };
    let own = svg(&["--title", "It's mine"]);
    assert!(own.contains(">It's mine</text>") && own.contains("--title &quot;It's mine&quot;"), "{own:.900}");
    let none = svg(&["--title", "", "--tikz"]);
    assert!(!none.contains(">Stability map</text>") && none.contains("--title ''"), "{none:.900}");
    let tex = std::fs::read_to_string(piece.directory.path().join("plot.tex")).unwrap();
    assert!(!tex.contains("\\textbf{Stability map}"), "{tex:.900}");
    let map = map(Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 5), span(Param::MuD, 0.0, 0.6, 5)]), |_, _| {
        paper_like(0.1, 0.1, 1.0)
    });
    let look = Look { title: Some("Mine".to_owned()), ..Look::default() };
    assert!(map_tikz(&map, &look).unwrap().contains("\\textbf{Mine}"));
}

/// Up to twelve panels of two blocks fit a page, the five of the paper's map a slide, and all of one block: with every word
/// on the page, and panels in which two labels and the cells can be read. Refused is only what has no higher panels left.
#[test]
fn maps_fit_the_page() {
    /// The least height of a panel, points: two labels of 7 pt beside it, and half a line between and around them.
    const READABLE: f64 = 22.0;
    let velocities = |count: u32| -> Vec<f64> { (0..count).map(|k| 0.5 + 0.25 * f64::from(k)).collect() };
    for (count, on_slide, elsewhere) in [(1, true, true), (3, true, true), (5, true, true), (12, false, true)]
    {
        let axes = vec![
            span(Param::MuS, 0.0, 0.6, 21),
            span(Param::MuD, 0.0, 0.6, 21),
            axis(Param::BeltVelocity, &velocities(count)),
        ];
        let map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
        for journal in Journal::ALL {
            let name = format!("page_{count}_{}", journal.name());
            let look = Look::of_journal(journal);
            let svg = look_svg(&map, &look).unwrap();
            let fits = size(&svg)[1] <= journal.height() + 0.01;
            let expected = if journal == Journal::Slide { on_slide } else { elsewhere };
            assert_eq!(fits, expected, "{name}: {:?}", size(&svg));
            assert_eq!(look.check_height(&svg, "").is_ok(), fits, "{name}");
            let heights: Vec<f64> = frames(&svg).iter().map(|frame| frame[3]).collect();
            let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
            assert!(lowest >= READABLE - 0.01 && (fits || lowest < READABLE + 0.01), "{name}: {heights:?}");
            draw(&svg, &name);
            assert!(outside(&svg).is_empty(), "{name}: {:?}", outside(&svg));
            assert_eq!(frames(&svg).len(), 2 * count as usize, "{name}");
        }
        let one = Look {
            contents: vec![Content::classes(Colouring::Type, false)],
            ..Look::of_journal(Journal::Slide)
        };
        let svg = look_svg(&map, &one).unwrap();
        assert!(size(&svg)[1] <= Journal::Slide.height() + 0.01, "{count}: {:?}", size(&svg));
        draw(&svg, &format!("page_{count}_slide_type"));
    }
}

#[test]
fn what_fits_no_page_is_refused_with_a_way_out() {
    let look = Look { height: Some(50.0), width: Some(90.0), ..Look::default() };
    let piece = all().into_iter().find(|piece| piece.kind == Kind::Trace).unwrap();
    let svg = Picture::read(piece.directory.path(), piece.kind).unwrap().svg(&look).unwrap();
    let error = look.check_height(&svg, "do something else").unwrap_err();
    assert!(error.is_bad_input() && matches!(error, Error::TooTall { .. }), "{error}");
    let words = error.to_string();
    assert!(words.contains("a page holds 50 mm; do something else"), "{words}");
    // Without a limit, and on the page of a journal, it passes.
    for look in [Look::default(), Look::of_journal(Journal::Slide)] {
        let svg = Picture::read(piece.directory.path(), piece.kind).unwrap().svg(&look).unwrap();
        look.check_height(&svg, "").unwrap();
    }
}

/// Axes end in a labelled tick where their last value is one: also those of a panel with another one beside it, and
/// where the last value is off by rounding.
#[test]
fn the_last_tick_has_its_label() {
    for points in [13, 41, 61, 121] {
        let axes = vec![
            span(Param::MuS, 0.0, 0.6, points),
            span(Param::MuD, 0.0, 0.6, 13),
            axis(Param::BeltVelocity, &[0.5, 1.0, 3.0, 4.9, 6.0]),
        ];
        let mut map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
        map.spec.analysis.response = false;
        for (width, last) in [(140.0, ">0.5</text>"), (190.0, ">0.6</text>")] {
            let svg = look_svg(&map, &Look { width: Some(width), ..Look::default() }).unwrap();
            draw(&svg, &format!("last_tick_{points}_{width}"));
            // Of each of the five panels; the vertical axis ends in 0.6.
            let vertical = usize::from(width > 150.0);
            assert_eq!(svg.matches(last).count(), 5 + vertical, "{points} values, {width} mm");
        }
        let cut = Cut::new(&map.spec.grid, "belt_velocity=3,mu_d=0.3").unwrap();
        let column = squealmap::results::number::NumberColumn {
            name: "growth_rate".to_owned(),
            unit: "1/s".to_owned(),
            meaning: String::new(),
            values: vec![Some(1.0); map.spec.grid.len()],
        };
        let svg = cut_svg(&map, &cut, &[&column], &Look::default());
        assert_eq!(svg.matches(">0.6</text>").count(), 1, "a cut of {points} values");
    }
    // Ends that are sums of steps, and powers whose logarithms are rounded.
    for steps in [3_u32, 6, 7, 12, 30, 60] {
        let end = (0..steps).fold(0.0, |sum, _| sum + 0.6 / f64::from(steps));
        for high in [end, end - 1e-12, end + 1e-12] {
            let ticks = Scale::Linear { low: 0.0, high }.ticks(6);
            let last = ticks.last().unwrap();
            assert!(last.label == "0.6".into() && (0.0..=1.0).contains(&last.at), "{high}: {ticks:?}");
        }
    }
    for decades in 1..9 {
        for low in [1e-6_f64, 1e-3, 2e-3, 1.0, 1e3] {
            let (low, high) = (low, low * 10_f64.powi(decades));
            // As the borders of cells are found: from the logarithm and back.
            let scale = Scale::Log { low: low.ln().exp(), high: high.ln().exp() };
            let ticks = scale.ticks(20);
            assert!(ticks.iter().all(|tick| (0.0..=1.0).contains(&tick.at)));
            let whole = (low.log10() - low.log10().round()).abs() < 1e-9;
            let ends = ticks.first().unwrap().at < 1e-9 && ticks.last().unwrap().at > 1.0 - 1e-9;
            assert!(ends || !whole, "{low} to {high}: {ticks:?}");
        }
    }
    // An axis of few values has its ticks at them.
    let log = Axis { log: true, ..axis(Param::K2, &[1e3, 1e4, 1e5]) };
    let map = map(Grid::Axes(vec![log, span(Param::MuD, 0.0, 0.6, 7)]), |_, _| paper_like(0.1, 0.1, 1.0));
    let svg = look_svg(&map, &Look::default()).unwrap();
    assert!(["3", "4", "5"].iter().all(|power| svg.contains(&format!(">{power}</tspan>"))), "{svg:.3000}");
}
