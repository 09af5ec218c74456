//! `map.svg` and its PNG: what is drawn where, and that nothing makes it crash.

use crate::colour::{DICHROMACIES, delta_e, lab, rgb};
use crate::synthetic::{axis, failed, map, number, paper_like, record, span};
use resvg::tiny_skia::Pixmap;
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::model::status::Status;
use squealmap::results::figure::map::map_svg;
use squealmap::results::figure::palette::{BISTABILITY, Class, REGIMES, TYPES};
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap_figure::boundaries::{borders, outlines};
use squealmap_figure::png;

/// Renders a figure; with `SQUEALMAP_GALLERY` set to a directory, also leaves the picture there to be looked at.
pub(crate) fn draw(svg: &str, name: &str) -> Pixmap {
    let bytes = png::render(svg).expect("a drawable figure");
    if let Some(gallery) = std::env::var_os("SQUEALMAP_GALLERY") {
        let path = std::path::Path::new(&gallery).join(name);
        std::fs::write(path.with_extension("png"), &bytes).expect("a writable gallery");
        std::fs::write(path.with_extension("svg"), svg).expect("a writable gallery");
    }
    Pixmap::decode_png(&bytes).expect("a PNG")
}

fn figure(map: &Map, name: &str) -> (String, Pixmap) {
    let svg = map_svg(map).expect("a complete map");
    let picture = draw(&svg, name);
    (svg, picture)
}

fn three_axes(points: usize, velocities: &[f64]) -> Map {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, points),
        span(Param::MuD, 0.0, 0.6, points),
        axis(Param::BeltVelocity, velocities),
    ];
    map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])))
}

/// The plot rectangles of a figure, `[x, y, width, height]` in points, in the order of drawing.
pub(crate) fn frames(svg: &str) -> Vec<[f64; 4]> {
    let mark = r##"fill="none" stroke="#000000" stroke-width="0.6""##;
    svg.lines()
        .filter(|line| line.starts_with("<rect") && line.contains(mark))
        .map(|line| {
            ["x", "y", "width", "height"].map(|name| {
                let rest = line.split_once(&format!(" {name}=\"")).expect("an attribute").1;
                rest.split_once('"').expect("a value").0.parse().expect("a number")
            })
        })
        .collect()
}

/// The colour at a position of a frame, `(0, 0)` at its lower left corner.
pub(crate) fn colour(picture: &Pixmap, [x, y, width, height]: [f64; 4], (right, up): (f64, f64)) -> [u8; 3] {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the picture")]
    let pixel = |points: f64| (points * 300.0 / 72.0) as u32;
    let pixel = picture.pixel(pixel(x + right * width), pixel(y + (1.0 - up) * height)).expect("inside");
    [pixel.red(), pixel.green(), pixel.blue()]
}

/// All colours of a part of a frame between two corners.
fn colours(picture: &Pixmap, frame: [f64; 4], low: (f64, f64), high: (f64, f64)) -> Vec<[u8; 3]> {
    /// Samples across the part.
    const N: usize = 60;
    let between = |a: f64, b: f64, i: usize| a + (b - a) * (i as f64 + 0.5) / N as f64;
    let at = |k: usize| (between(low.0, high.0, k % N), between(low.1, high.1, k / N));
    (0..N * N).map(|k| colour(picture, frame, at(k))).collect()
}

/// A 4 × 3 map of two axes.
fn grid(make: impl Fn(usize, usize) -> Record) -> Map {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 4), span(Param::MuD, 0.0, 0.6, 3)];
    map(Grid::Axes(axes), |i, _| make(i / 3, i % 3))
}

#[test]
fn the_paper_map_has_a_panel_for_each_velocity() {
    let mut sweep = three_axes(41, &[0.5, 1.0, 3.0, 4.9, 6.0]);
    sweep.spec.title = "Stability map of the two-mass belt model".to_owned();
    let (svg, _) = figure(&sweep, "paper_map");
    assert_eq!(frames(&svg).len(), 2 * 5, "types and regimes");
    assert!(svg.contains("Stability map of the two-mass belt model"));
    for velocity in ["0.5", "1", "3", "4.9", "6"] {
        assert_eq!(svg.matches(&format!(" = {velocity} m/s")).count(), 2, "{velocity} m/s");
    }
}

#[test]
fn one_velocity_has_one_panel_for_each_analysis() {
    let sweep = three_axes(41, &[3.0]);
    assert_eq!(frames(&figure(&sweep, "one_velocity").0).len(), 2, "types and regimes");
    let mut linear = sweep.clone();
    linear.spec.analysis.response = false;
    assert_eq!(frames(&figure(&linear, "one_velocity_linear").0).len(), 1, "types alone");
}

#[test]
fn two_further_axes_make_a_matrix_of_panels() {
    let axes = vec![
        axis(Param::Theta, &[0.005, 0.01, 0.02]),
        span(Param::MuS, 0.0, 0.6, 21),
        span(Param::MuD, 0.0, 0.6, 11),
        axis(Param::BeltVelocity, &[0.5, 3.0, 6.0, 9.0]),
    ];
    let mut sweep = map(Grid::Axes(axes), |_, at| paper_like(number(at[1]), number(at[2]), number(at[3])));
    let (svg, _) = figure(&sweep, "theta_first");
    assert_eq!(frames(&svg).len(), 2 * 12, "theta has few values: the others are the picture");
    let Grid::Axes(axes) = &mut sweep.spec.grid else { panic!("axes") };
    axes.rotate_left(1);
    sweep = map(sweep.spec.grid, |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
    let (svg, _) = figure(&sweep, "matrix");
    assert_eq!(frames(&svg).len(), 2 * 12);
    assert!(svg.contains(" = 0.005 rad") && svg.contains(" = 9 m/s"));
}

#[test]
fn many_panels_are_thinned_and_it_says_so() {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 9),
        span(Param::MuD, 0.0, 0.6, 9),
        span(Param::BeltVelocity, 0.5, 9.5, 700),
    ];
    let sweep = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
    let (svg, _) = figure(&sweep, "thinned");
    assert_eq!(frames(&svg).len(), 2 * 40);
    assert!(svg.contains("40 of 700 panels shown"));
}

#[test]
fn seven_panels_wrap_into_two_rows() {
    let (svg, _) = figure(&three_axes(15, &[0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), "seven");
    let frames = frames(&svg);
    assert_eq!(frames.len(), 2 * 7, "types and regimes");
    for block in frames.chunks(7) {
        let (first, second) = block.split_at(4);
        let [top, below] = [first[0], second[0]].map(|[_, y, _, height]| [y, y + height]);
        let same = |a: f64, b: f64| (a - b).abs() < 0.01;
        assert!(first.iter().all(|frame| same(frame[1], top[0])), "{block:?}");
        assert!(second.iter().all(|frame| same(frame[1], below[0])), "{block:?}");
        assert!(below[0] > top[1], "the second row stands below the first: {block:?}");
        // From left to right, and the second row under the first.
        assert!(first.windows(2).all(|pair| pair[0][0] + pair[0][2] < pair[1][0]), "{block:?}");
        assert!(first.iter().zip(second).all(|(above, under)| same(above[0], under[0])), "{block:?}");
    }
}

#[test]
fn log_and_uneven_axes_have_their_cells_around_the_values() {
    let k2 = Axis { log: true, ..axis(Param::K2, &[1e3, 1e4, 1e5, 1e6, 1e7]) };
    let axes = vec![k2, axis(Param::BeltVelocity, &[0.5, 1.0, 3.0, 4.9, 6.0])];
    let sweep = map(Grid::Axes(axes), |i, _| {
        let kind = if i / 5 == 1 && i % 5 == 2 { Kind::ModeCoupling } else { Kind::Stable };
        record(kind, Regime::Equilibrium, true)
    });
    let (svg, picture) = figure(&sweep, "log");
    let frame = frames(&svg)[0];
    // The cell of k2 = 1e4 is the second of five equal ones; V = 3 reaches from 2 to 3.95 in 0.25 to 6.55.
    let up = |v: f64| (v - 0.25) / 6.3;
    assert_eq!(colour(&picture, frame, (0.3, up(3.0))), rgb(TYPES[2].fill));
    for inside in [(0.22, up(2.1)), (0.38, up(3.85))] {
        assert_eq!(colour(&picture, frame, inside), rgb(TYPES[2].fill), "{inside:?}");
    }
    for outside in [(0.18, up(3.0)), (0.42, up(3.0)), (0.3, up(1.9)), (0.3, up(4.05))] {
        assert_eq!(colour(&picture, frame, outside), rgb(TYPES[0].fill), "{outside:?}");
    }
    let linear = axis(Param::K1, &[5e4, 1e5, 1.5e5, 2e5, 2.5e5, 3e5, 3.5e5, 4e5]);
    let axes = vec![linear, span(Param::Theta, -0.05, 0.05, 9)];
    figure(&map(Grid::Axes(axes), |i, _| record(Kind::ALL[i % 7], Regime::ALL[i % 7], true)), "large_values");
}

#[test]
fn ticks_are_round_where_values_are_not() {
    let axes = vec![span(Param::MuS, 0.0, 1.0, 7), axis(Param::MuD, &[0.1, 0.25, 0.6])];
    let svg = map_svg(&map(Grid::Axes(axes), |_, _| paper_like(0.4, 0.3, 3.0))).expect("a complete map");
    assert!(
        !svg.contains(">0.1666") && svg.contains(">0.2<") && svg.contains(">0.25<") && !svg.contains(">0.3<")
    );
}

#[test]
fn unsorted_values_are_drawn_in_rising_order() {
    let axes = vec![axis(Param::MuS, &[0.4, 0.0, 0.2]), span(Param::MuD, 0.0, 0.6, 2)];
    let sweep = map(Grid::Axes(axes), |i, _| record(Kind::ALL[i / 2], Regime::Slip, true));
    let (svg, picture) = figure(&sweep, "unsorted");
    let shown = [0.16, 0.5, 0.83].map(|right| colour(&picture, frames(&svg)[0], (right, 0.25)));
    assert_eq!(shown, [1, 2, 0].map(|k| rgb(TYPES[k].fill)));
}

#[test]
fn strips_names_and_single_instances() {
    let line =
        map(Grid::Axes(vec![span(Param::MuD, 0.0, 0.6, 61)]), |_, at| paper_like(0.4, number(at[0]), 3.0));
    figure(&line, "strip");
    let short = map(Grid::Axes(vec![axis(Param::MuS, &[0.3]), span(Param::MuD, 0.0, 0.6, 9)]), |_, at| {
        paper_like(number(at[0]), number(at[1]), 3.0)
    });
    let (svg, _) = figure(&short, "one_by_n");
    assert!(svg.contains(" = 0.3"));
    let laws =
        ["bilinear", "exponential", "rational"].map(|name| Value::Text(name.to_owned().into())).to_vec();
    let law = Axis { key: AxisKey::Law, values: laws, log: false };
    let axes = vec![law.clone(), span(Param::BeltVelocity, 0.1, 7.0, 70)];
    let named = map(Grid::Axes(axes), |i, at| paper_like(0.3 + 0.1 * (i / 70) as f64, 0.2, number(at[1])));
    figure(&named, "laws");
    figure(&map(Grid::Axes(vec![law]), |i, _| record(Kind::ALL[i], Regime::ALL[i], true)), "laws_only");
    figure(&map(Grid::Axes(Vec::new()), |_, _| paper_like(0.4, 0.3, 3.0)), "single");
    let one = vec![axis(Param::MuS, &[0.4]), axis(Param::MuD, &[0.3])];
    figure(&map(Grid::Axes(one), |_, _| paper_like(0.4, 0.3, 3.0)), "one_by_one");
}

#[test]
fn tuples_are_points() {
    let keys =
        vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::MuD), AxisKey::Param(Param::BeltVelocity)];
    let tuples = [
        (0.15, 0.05, 3.0),
        (0.15, 0.05, 6.0),
        (0.4, 0.4, 3.0),
        (0.4, 0.3, 3.0),
        (0.07, 0.02, 3.0),
        (0.8, 0.8, 3.0),
    ];
    let rows = tuples.map(|(s, d, v)| [s, d, v].map(Value::Number).to_vec()).to_vec();
    let make = |at: &[&Value]| paper_like(number(at[0]), number(at[1]), number(at[2]));
    let sweep = map(Grid::Tuples { keys: keys.clone(), rows: rows.into() }, |i, at| {
        if i == 2 { failed(Status::NonFinite) } else { make(at) }
    });
    let (svg, _) = figure(&sweep, "tuples");
    assert_eq!(svg.matches("<circle").count() - svg.matches(r#"class="unsettled""#).count(), 12);
    let rows = (0..60)
        .map(|i| {
            [0.01 * f64::from(i % 50), 0.7 - 0.01 * f64::from(i), f64::from(i)].map(Value::Number).to_vec()
        })
        .collect();
    let sweep = map(Grid::Tuples { keys, rows }, |_, at| make(at));
    let (svg, _) = figure(&sweep, "many_tuples");
    assert!(svg.contains("Also varying between the points: belt_velocity."));
    let none =
        Grid::Tuples { keys: vec![AxisKey::Param(Param::MuS)], rows: vec![vec![Value::Number(0.1)]].into() };
    figure(&map(none, |_, _| failed(Status::Painleve)), "one_tuple");
}

#[test]
fn cells_have_the_colour_of_their_class() {
    let sweep = grid(|i, j| record(Kind::ALL[(i + 2 * j) % 7], Regime::ALL[(3 * i + j) % 8], true));
    let (svg, picture) = figure(&sweep, "all_classes");
    let frames = frames(&svg);
    assert_eq!(frames.len(), 2);
    for (i, j) in (0..4_usize).flat_map(|i| (0..3_usize).map(move |j| (i, j))) {
        let centre = ((i as f64 + 0.5) / 4.0, (j as f64 + 0.5) / 3.0);
        let (kind, regime) = ((i + 2 * j) % 7, (3 * i + j) % 8);
        assert_eq!(colour(&picture, frames[0], centre), rgb(TYPES[kind].fill), "type {i} {j}");
        assert_eq!(colour(&picture, frames[1], centre), rgb(REGIMES[regime].fill), "regime {i} {j}");
    }
}

#[test]
fn unsettled_cells_are_hatched_in_a_tone_that_shows() {
    let sweep = grid(|i, j| {
        let regime = if i < 2 { Regime::Slip } else { Regime::DetachingStickSlip };
        record(Kind::Stable, regime, j != 1)
    });
    let (svg, picture) = figure(&sweep, "unsettled");
    let regimes = frames(&svg)[1];
    let marked = |low, high| {
        let seen = colours(&picture, regimes, low, high);
        let light = |c: &&[u8; 3]| c.iter().all(|channel| *channel > 200);
        let dark = |c: &&[u8; 3]| c.iter().all(|channel| *channel < 60);
        (seen.iter().filter(light).count(), seen.iter().filter(dark).count())
    };
    let (_, black_on_slip) = marked((0.05, 0.37), (0.45, 0.63));
    let (white_on_wine, _) = marked((0.55, 0.37), (0.95, 0.63));
    assert!(black_on_slip > 50 && white_on_wine > 50, "{black_on_slip} {white_on_wine}");
    assert_eq!(marked((0.05, 0.03), (0.45, 0.30)), (0, 0), "settled cells are plain");
    assert!(svg.contains(">unsettled (n = 4)<"));
    let plain = grid(|_, _| record(Kind::Stable, Regime::Slip, true));
    assert!(!map_svg(&plain).expect("a complete map").contains(">unsettled"));
}

#[test]
fn failed_instances_are_crossed_and_named() {
    let sweep = grid(|i, j| match (i, j) {
        (2, 1) => failed(Status::Painleve),
        // Types survive a failed response.
        (0, 0) => {
            Record { regime: None, status: Status::EventLimit, ..record(Kind::Stable, Regime::Slip, true) }
        }
        _ => record(Kind::Stable, Regime::Slip, true),
    });
    let (svg, picture) = figure(&sweep, "failed");
    let frames = frames(&svg);
    for frame in &frames {
        let seen = colours(&picture, *frame, (0.52, 0.37), (0.73, 0.63));
        let share = |hits: usize| hits as f64 / seen.len() as f64;
        let red = share(seen.iter().filter(|c| c[0] > 150 && c[1] < 100).count());
        let white = share(seen.iter().filter(|c| **c == [255; 3]).count());
        assert!((0.1..0.8).contains(&red) && white > 0.05, "{red} {white}");
    }
    assert_eq!(colour(&picture, frames[0], (0.125, 0.16)), rgb(TYPES[0].fill));
    assert!(svg.contains(">no result: Painlevé (n = 1)<"));
    assert!(svg.contains(">no result: Painlevé, event limit (n = 2)<"));
}

#[test]
fn maps_without_any_result_are_drawn() {
    for status in Status::ALL {
        figure(&grid(|_, _| failed(status)), "nothing");
    }
    let mut sweep = grid(|_, _| failed(Status::Ok));
    sweep.spec.title = String::new();
    let (svg, _) = figure(&sweep, "nothing");
    assert!(svg.contains("no result (n = 12)"));
    sweep.spec.analysis.linear = false;
    assert_eq!(frames(&map_svg(&sweep).expect("a complete map")).len(), 1);
}

#[test]
fn an_unwritten_instance_is_no_picture() {
    let sweep = grid(|i, j| if (i, j) == (1, 1) { Record::default() } else { paper_like(0.1, 0.1, 1.0) });
    assert_eq!(
        map_svg(&sweep).expect_err("as the test has set it up").to_string(),
        "instance 4 was never computed; nothing was exported"
    );
}

#[test]
fn titles_are_escaped_and_wrapped_and_the_picture_is_repeatable() {
    let mut sweep = grid(|_, _| record(Kind::Stable, Regime::Slip, true));
    sweep.spec.title = "Pads <A> & \"B\" \u{1} ".repeat(12);
    let (svg, _) = figure(&sweep, "title");
    assert!(svg.contains("Pads &lt;A&gt; &amp; &quot;B&quot;"));
    let mut other = sweep.clone();
    other.provenance.threads = 64;
    other.provenance.elapsed *= 3;
    assert_eq!(svg, map_svg(&other).expect("a complete map"), "the same sweep is the same text");
}

#[test]
fn a_large_map_stays_small() {
    let sweep = three_axes(500, &[3.0]);
    let svg = map_svg(&sweep).expect("a complete map");
    assert!(svg.len() < 400_000, "{} bytes", svg.len());
}

#[test]
fn the_png_says_300_dots_per_inch() {
    let bytes = png::render(r#"<svg xmlns="http://www.w3.org/2000/svg" width="25.4mm" height="25.4mm"/>"#);
    let bytes = bytes.expect("a drawable figure");
    let picture = Pixmap::decode_png(&bytes).expect("a PNG with right checksums");
    assert_eq!((picture.width(), picture.height()), (300, 300));
    assert_eq!(&bytes[37..41], b"pHYs");
    assert_eq!(&bytes[41..50], &[0, 0, 0x2E, 0x23, 0, 0, 0x2E, 0x23, 1]);
    assert!(matches!(png::render("not a picture"), Err(squealmap_figure::Error::ReadSvg(_))));
    let nested = |depth: usize| {
        let [open, close] = [r#"<g opacity=".5">"#, "</g>"].map(|tag| tag.repeat(depth - 2));
        let rect = r#"<rect width="5" height="5"/>"#;
        png::render(&format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{open}{rect}{close}</svg>"#
        ))
    };
    assert!(nested(100).is_ok());
    for depth in [101, 100_000] {
        assert!(matches!(nested(depth), Err(squealmap_figure::Error::Nested { most: 100, .. })), "{depth}");
    }
}

#[test]
fn colours_survive_colour_blindness_and_grey_print() {
    /// CIEDE2000 below about 10 is hard to name apart across a page.
    const LEAST_DIFFERENCE: f64 = 11.0;
    /// Steps of lightness L* in a grey print.
    const LEAST_STEP: f64 = 12.0;
    let check = |classes: &[Class]| {
        for (name, seen) in &DICHROMACIES {
            for (i, one) in classes.iter().enumerate() {
                for other in &classes[i + 1..] {
                    let distance = delta_e(lab(one.fill, seen), lab(other.fill, seen));
                    assert!(distance > LEAST_DIFFERENCE, "{name}: {} {} {distance}", one.name, other.name);
                }
            }
        }
        let grey = |class: &Class| lab(class.fill, &DICHROMACIES[0].1)[0];
        for class in classes {
            assert_eq!(class.dark, grey(class) < 50.0, "{}", class.name);
        }
        let apart = |classes: &mut dyn Iterator<Item = &Class>, least: f64| {
            let mut grey: Vec<f64> = classes.map(grey).collect();
            grey.sort_by(f64::total_cmp);
            assert!(grey.windows(2).all(|pair| pair[1] - pair[0] > least), "{grey:?}");
        };
        // What has not yet grown is hatched wherever it is drawn, which tells it where its lightness hardly does.
        apart(&mut classes.iter().filter(|class| class.name != Regime::NotYetGrown.name()), LEAST_STEP);
        apart(&mut classes.iter(), 0.5 * LEAST_STEP);
    };
    check(&TYPES);
    check(&REGIMES);
    check(&BISTABILITY);
    assert_eq!(TYPES.map(|class| class.name), Kind::ALL.map(Kind::name));
    assert_eq!(REGIMES.map(|class| class.name), Regime::ALL.map(Regime::name));
}

#[test]
fn outlines_enclose_exactly_the_cells() {
    // Even-odd: a cell is inside when a ray to its left crosses an odd number of vertical edges.
    let pattern = |i: usize, j: usize| (i * 7 + j * 5 + i * j).is_multiple_of(3);
    let loops = outlines(9, 8, pattern);
    for (i, j) in (0..9).flat_map(|i| (0..8).map(move |j| (i, j))) {
        let crossings = loops
            .iter()
            .flat_map(|path| path.windows(2))
            .filter(|pair| {
                let (low, high) = (pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1));
                pair[0].0 == pair[1].0 && pair[0].0 <= i && (low..high).contains(&j)
            })
            .count();
        assert_eq!(crossings % 2 == 1, pattern(i, j), "{i} {j}");
    }
    assert!(loops.iter().all(|path| path.first() == path.last()));
    assert_eq!(outlines(5, 4, |_, _| true), vec![vec![(0, 0), (5, 0), (5, 4), (0, 4), (0, 0)]]);
}

#[test]
fn border_lines_cover_every_differing_edge_once() {
    let class = |(i, j): (usize, usize)| (i * 7 + j * 5 + i * j) % 4;
    let lines = borders(9, 8, |a, b| class(a) != class(b));
    let length: usize = lines
        .iter()
        .flat_map(|path| path.windows(2))
        .map(|pair| pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1))
        .sum();
    let across = (0..8).flat_map(|i| (0..8).map(move |j| ((i, j), (i + 1, j))));
    let down = (0..9).flat_map(|i| (0..7).map(move |j| ((i, j), (i, j + 1))));
    let expected = across.chain(down).filter(|(a, b)| class(*a) != class(*b)).count();
    assert_eq!(length, expected);
    // A square inside is one closed line of four corners; straight lines are merged.
    let square = borders(6, 6, |a, b| {
        let inside = |(i, j): (usize, usize)| (2..4).contains(&i) && (2..4).contains(&j);
        inside(a) != inside(b)
    });
    assert_eq!(square, vec![vec![(2, 2), (4, 2), (4, 4), (2, 4), (2, 2)]]);
}
