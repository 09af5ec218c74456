//! Figures of many panels or on little room: every word on the page and none on another, tables of panels whole, no empty
//! quarter, and axes with two labels at least.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeSet;
use std::path::Path;

use crate::results::figure::{draw, frames};
use crate::results::pictures::{boxes, outside};
use crate::results::plot::size;
use crate::synthetic::{axis, map, number, paper_like, record, span};
use squealmap::engine::record::{Basin, Others, Record};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::cut::{Cut, cut_svg};
use squealmap::results::figure::look::{Content, Journal, Look};
use squealmap::results::figure::map::{computed, look_svg};
use squealmap::results::number::NumberColumn;
use squealmap::study::modes::follow::{draw as draw_modes, modes_of};
use squealmap::sweep::grid::{Axis, Grid};
use squealmap::sweep::map::Map;
use squealmap::sweep::spec::{Spec, Starts};

/// Pairs of words of a document that lie on one another.
fn touching(svg: &str) -> Vec<String> {
    /// Boxes have the room for descenders, which most words do not use, points.
    const SLACK: f32 = 0.5;
    let all = boxes(svg);
    let mut found = Vec::new();
    for (k, (words, [left, top, right, bottom])) in all.iter().enumerate() {
        for (others, other) in &all[k + 1..] {
            let apart = *right - SLACK < other[0]
                || other[2] - SLACK < *left
                || *bottom - SLACK < other[1]
                || other[3] - SLACK < *top;
            if !apart {
                found.push(format!("`{words}` on `{others}`"));
            }
        }
    }
    found
}

fn fits(svg: &str, journal: Journal, name: &str) {
    draw(svg, name);
    assert!(size(svg)[1] <= journal.height() + 0.01, "{name}: {:?}", size(svg));
    assert!(outside(svg).is_empty(), "{name}: {:?}", outside(svg));
    assert!(touching(svg).is_empty(), "{name}: {:?}", touching(svg));
}

/// The different left ends of frames, or upper ones, to a tenth of a point.
fn ends(svg: &str, side: usize) -> usize {
    let rounded = frames(svg).into_iter().map(|frame| format!("{:.1}", frame[side]));
    rounded.collect::<BTreeSet<_>>().len()
}

fn column(name: &str, values: Vec<f64>) -> NumberColumn {
    let (name, values) = (name.to_owned(), values.into_iter().map(Some).collect());
    NumberColumn { name, unit: "1/s".to_owned(), meaning: String::new(), values }
}

#[test]
fn modes_of_many_values_are_an_even_choice_without_collisions() {
    let text = "title = \"Eigenvalues\"\nanalysis = [\"linear\"]\n[friction]\nlaw = \"bilinear\"\nmu_s = 0.5\n[axes]\n\
                mu_d = { from = 0.0, to = 0.6, points = 13 }\nbelt_velocity = { from = 0.0, to = 6.0, points = 61 }\n";
    let spec = Spec::parse(text, "test", Path::new(".")).unwrap();
    let modes = modes_of(&spec).unwrap();
    for (width, shown) in [(60.0, 1), (90.0, 2), (120.0, 3), (190.0, 4)] {
        let svg = draw_modes(&spec, &modes, &Look { width: Some(width), ..Look::default() });
        draw(&svg, &format!("modes_61_{width}"));
        assert!(outside(&svg).is_empty() && touching(&svg).is_empty(), "{width}: {:?}", touching(&svg));
        assert_eq!(frames(&svg).len(), 2 * shown, "{width}");
        // At rest there are no modes; of the other 60 velocities the first and the last are there, as far as two are.
        assert!(
            svg.contains(&format!("{shown} of 61 panels shown")) && svg.contains(" = 0.1 m/s"),
            "{width}"
        );
        assert_eq!(svg.contains(" = 6 m/s"), shown > 1, "{width}");
        assert!(!svg.contains(" = 0.2 m/s") && !svg.contains(" = 0 m/s"), "{width}");
    }
}

/// Two starts of a map, as in the bistable band.
fn bistable() -> Map {
    let axes = vec![span(Param::C1, 0.02, 0.3, 29), span(Param::BeltVelocity, 0.1, 3.0, 30)];
    let mut map = map(Grid::Axes(axes), |k, at| {
        let (damping, velocity) = (number(at[0]), number(at[1]));
        let [falls, sticks] = [0.1, 0.2].map(|most| damping * velocity < most);
        let kind = if falls { Kind::NegativeSlope } else { Kind::Stable };
        let ended = |sticks: bool| match (sticks, k % 40) {
            (true, 0) => Regime::Slip,
            (true, _) => Regime::StickSlip,
            (false, _) => Regime::Equilibrium,
        };
        let large = Record { kind: None, linear: None, ..record(kind, ended(sticks), true) };
        let bistable = (k % 40 > 0).then_some(sticks != falls);
        let others = Some(Others::Large(Box::new(large)));
        Record { others, bistable, ..record(kind, ended(falls), k % 40 > 0) }
    });
    map.spec.analysis.starts = Starts::Both;
    map
}

/// The ends of starts from a box along an axis: from all in oscillation to none, with some that have not settled and one
/// that has failed.
fn basins() -> Map {
    const STARTS: u32 = 200;
    let axes = vec![span(Param::BeltVelocity, 1.0, 2.0, 41)];
    let mut map = map(Grid::Axes(axes), |k, _| {
        let left = 40 - u32::try_from(k).unwrap();
        let oscillation = if k < 30 { 5 * left } else { 0 };
        let [other, failed] = [u32::from((5..8).contains(&k)), u32::from(k == 9)];
        let basin = Basin { equilibrium: STARTS - oscillation - other - failed, oscillation, other, failed };
        let bistable = basin.is_bistable();
        let kind = if k < 7 { Kind::NegativeSlope } else { Kind::Stable };
        Record { others: Some(Others::Basin(basin)), bistable, ..record(kind, Regime::StickSlip, k != 3) }
    });
    map.spec.analysis.starts = Starts::Box(STARTS);
    map
}

#[test]
fn four_blocks_fit_a_slide() {
    for (map, name) in [(bistable(), "slide_bistable"), (basins(), "slide_basins")] {
        for journal in Journal::ALL {
            let svg = look_svg(&map, &Look::of_journal(journal)).unwrap();
            fits(&svg, journal, &format!("{name}_{}", journal.name()));
            assert_eq!(frames(&svg).len(), 4, "{name}");
        }
    }
}

/// Panels of the values of two axes: a row for each of the shorter one, wherever that fits the page.
#[test]
fn a_table_of_panels_is_not_broken() {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[0.5, 1.0, 3.0, 5.0]),
        axis(Param::Theta, &[-0.01, 0.0, 0.01]),
    ];
    let mut map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
    map.spec.analysis.response = false;
    for journal in Journal::ALL {
        let svg = look_svg(&map, &Look::of_journal(journal)).unwrap();
        fits(&svg, journal, &format!("table_{}", journal.name()));
        assert_eq!((ends(&svg, 0), ends(&svg, 1)), (4, 3), "{}", journal.name());
    }
}

#[test]
fn three_quantities_leave_no_quarter_empty() {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 21), span(Param::BeltVelocity, 0.5, 6.0, 21)];
    let map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), 0.2, number(at[1])));
    let of = |name: &str| column(name, (0..441).map(|k| 0.001 * f64::from(k) - 0.1).collect());
    let columns = ["growth_rate", "x2_std", "stick"].map(of);
    let contents: Vec<Content<'_>> = columns.iter().map(Content::quantity).collect();
    for (look, name) in [
        (Look { width: Some(180.0), ..Look::default() }, "three"),
        (Look::of_journal(Journal::Elsevier2Col), "three_journal"),
        (Look::of_journal(Journal::Slide), "three_slide"),
    ] {
        let svg = look_svg(&map, &Look { contents: contents.clone(), ..look }).unwrap();
        draw(&svg, name);
        assert!(outside(&svg).is_empty() && touching(&svg).is_empty(), "{name}: {:?}", touching(&svg));
        // Three pictures beside one another, and their bars.
        assert_eq!((frames(&svg).len(), ends(&svg, 0), ends(&svg, 1)), (6, 3, 2), "{name}");
    }
}

/// Below every lowest panel there are two labels or more, and beside every first one.
fn axes_are_scales(svg: &str, name: &str) {
    let frames = frames(svg);
    let marks: Vec<[f64; 2]> = svg
        .lines()
        .filter(|line| line.starts_with("<text") && line.contains("font-size=\"7\""))
        .map(|line| {
            ["x", "y"].map(|name| {
                let rest = line.split_once(&format!(" {name}=\"")).unwrap().1;
                rest.split_once('"').unwrap().0.parse().unwrap()
            })
        })
        .collect();
    let lowest = frames.iter().map(|frame| frame[1] + frame[3]).fold(0.0, f64::max);
    let first = frames.iter().map(|frame| frame[0]).fold(f64::INFINITY, f64::min);
    for [x, y, width, height] in frames {
        if (y + height - lowest).abs() < 0.1 {
            let below = |[at, base]: &&[f64; 2]| {
                (x - 0.1..=x + width + 0.1).contains(at) && (0.0..15.0).contains(&(base - y - height))
            };
            assert!(marks.iter().filter(below).count() > 1, "{name}: below {x} {y}");
        }
        if (x - first).abs() < 0.1 {
            let beside = |[at, base]: &&[f64; 2]| *at < x && (y..y + height + 4.0).contains(base);
            assert!(marks.iter().filter(beside).count() > 1, "{name}: beside {x} {y}");
        }
    }
}

#[test]
fn no_axis_has_a_single_label() {
    for end in [0.3, 0.4, 0.5, 0.6, 0.9, 1.1] {
        for velocities in [2_u32, 4, 5, 6] {
            let of: Vec<f64> = (0..velocities).map(f64::from).collect();
            let axes = vec![
                span(Param::MuS, 0.0, end, 21),
                span(Param::MuD, 0.0, end, 21),
                axis(Param::BeltVelocity, &of),
            ];
            let mut map =
                map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
            map.spec.analysis.response = false;
            for (look, place) in [
                (Look::of_journal(Journal::Slide), "slide"),
                (Look::of_journal(Journal::Elsevier1Col), "column"),
                (Look { width: Some(70.0), ..Look::default() }, "narrow"),
            ] {
                let name = format!("labels_{end}_{velocities}_{place}");
                axes_are_scales(&look_svg(&map, &look).unwrap(), &name);
            }
        }
    }
    // Curves on a slide, of values whose only round one might be 0.
    let line = Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 25), axis(Param::MuD, &[0.1, 0.2])]);
    let map = map(line, |_, at| paper_like(number(at[0]), 0.2, 1.0));
    for (low, high) in [(-3.0, 4.4), (-0.4, 0.47), (0.0, 1.9), (-4.9, 3.0), (9.0, 11.9), (-0.02, 23.0)] {
        let values = (0..50).map(|k| low + (high - low) * f64::from(k) / 49.0).collect();
        let column = column("growth_rate", values);
        let cut = Cut::new(&map.spec.grid, "mu_d=0.1").unwrap();
        for quantities in [1, 2, 3, 4] {
            let columns = vec![&column; quantities];
            let svg = cut_svg(&map, &cut, &columns, &Look::of_journal(Journal::Slide));
            let name = format!("labels_cut_{low}_{high}_{quantities}");
            draw(&svg, &name);
            axes_are_scales(&svg, &name);
        }
    }
}

/// The places of the corners of a curve.
fn corners(svg: &str, stroke: &str) -> Vec<Vec<[f64; 2]>> {
    let paths = svg.lines().filter(|line| line.starts_with("<path") && line.contains(stroke));
    paths.filter(|path| !path.contains("class=")).map(crate::results::curves::places).collect()
}

/// Friction that ends at 5 m/s: the growth drops from one instance to the next, the amplitude of the other curve does not.
#[test]
fn a_jump_is_a_step_not_a_slope() {
    let axes = vec![span(Param::BeltVelocity, 0.0, 10.0, 21), axis(Param::MuD, &[0.1, 0.4])];
    let sweep = map(Grid::Axes(axes), |_, at| {
        let kind = if number(at[0]) < 5.0 { Kind::NegativeSlope } else { Kind::Stable };
        record(kind, Regime::Slip, true)
    });
    let jump = |k: i32| if k / 2 < 10 { 18.0 - 0.1 * f64::from(k / 2) } else { -0.02 };
    let slope = |k: i32| 18.0 - f64::from(k / 2);
    let values = (0..42).map(|k| if k % 2 == 0 { jump(k) } else { slope(k) }).collect();
    let column = column("growth_rate", values);
    let cut = Cut::new(&sweep.spec.grid, "mu_d=0.1,mu_d=0.4").unwrap();
    let svg = cut_svg(&sweep, &cut, &[&column], &Look { width: Some(140.0), ..Look::default() });
    draw(&svg, "jump");
    let [frame] = frames(&svg)[..] else { panic!("{:?}", frames(&svg)) };
    // Of the samples in the legend too, which come first.
    let curve = corners(&svg, "stroke=\"#1F3F8F\"").pop().unwrap();
    let level: Vec<&[[f64; 2]]> =
        curve.windows(2).filter(|pair| (pair[1][0] - pair[0][0]).abs() < 0.02).collect();
    let [step] = level[..] else { panic!("{curve:?}") };
    // Halfway between 4.5 and 5 m/s, over all of the jump.
    assert!((step[0][0] - frame[0] - 0.475 * frame[2]).abs() < 0.02, "{step:?}");
    assert!((step[1][1] - step[0][1]) > 0.7 * frame[3], "{step:?}");
    let other = corners(&svg, "stroke=\"#D55E00\"").pop().unwrap();
    assert!(other.windows(2).all(|pair| pair[1][0] - pair[0][0] > 0.02), "{other:?}");
    // The line of 0 is there, as growth has a sign.
    assert!(svg.contains("stroke=\"#777777\""));
    // Along one axis, too.
    let line = map(Grid::Axes(vec![span(Param::BeltVelocity, 0.0, 10.0, 21)]), |k, _| {
        record(if k < 10 { Kind::NegativeSlope } else { Kind::Stable }, Regime::Slip, true)
    });
    let along = self::column("growth_rate", (0..21).map(|k| jump(2 * k)).collect());
    let contents = vec![Content::quantity(&along)];
    let svg = look_svg(&line, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    let curve = corners(&svg, "stroke=\"#1F3F8F\"").pop().unwrap();
    assert_eq!(
        curve.windows(2).filter(|pair| (pair[1][0] - pair[0][0]).abs() < 0.02).count(),
        1,
        "{curve:?}"
    );
}

/// What decays does not look like what stands still: the sign is a hue of its own, and the bar says how far it goes.
#[test]
fn growth_below_zero_is_seen() {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 10), span(Param::MuD, 0.0, 0.6, 3)];
    let sweep = map(Grid::Axes(axes), |_, _| record(Kind::Stable, Regime::Slip, true));
    let of = |k: usize| [-0.02, -0.01, -0.001, 0.0, 0.001, 1.0, 5.0, 10.0, 20.0, 25.0][k / 3];
    let column = column("growth_rate", (0..30).map(of).collect());
    let contents = vec![Content::quantity(&column)];
    let svg = look_svg(&sweep, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    let picture = draw(&svg, "growth_below_zero");
    let [frame, bar] = frames(&svg)[..] else { panic!("{:?}", frames(&svg)) };
    let at = |k: usize| crate::results::figure::colour(&picture, frame, ((k as f64 + 0.5) / 10.0, 0.5));
    let warm = |[red, _, blue]: [u8; 3]| red > blue.saturating_add(10);
    assert_eq!(
        (0..10).map(|k| warm(at(k))).collect::<Vec<_>>(),
        [[true; 3].as_slice(), &[false; 7]].concat()
    );
    // Ever darker from the lowest to the highest, for a grey print.
    let light = |[red, green, blue]: [u8; 3]| {
        let name = format!("#{red:02X}{green:02X}{blue:02X}");
        crate::colour::lab(&name, &crate::colour::DICHROMACIES[0].1)[0]
    };
    let along: Vec<f64> = (0..60)
        .map(|k| light(crate::results::figure::colour(&picture, bar, ((f64::from(k) + 0.5) / 60.0, 0.5))))
        .collect();
    assert!(along.windows(2).all(|pair| pair[1] < pair[0] + 0.3) && along[59] < 20.0, "{along:?}");
    assert!(svg.contains(">−0.02</text>") && svg.contains(">20</text>"));
    // Without a sign, or without values below 0, the scale is one.
    let other = NumberColumn { name: "x2_mean".to_owned(), ..column.clone() };
    let contents = vec![Content::quantity(&other)];
    let svg = look_svg(&sweep, &Look { contents, width: Some(90.0), ..Look::default() }).unwrap();
    assert!(!svg.contains(">−0.02</text>"));
}

/// Of what the fractions are, how sure they are, and what became of the other starts.
#[test]
fn fractions_of_starts_say_what_they_are_of() {
    let map = basins();
    let svg = look_svg(&map, &Look::default()).unwrap();
    draw(&svg, "basins_along");
    for words in [
        ">Ends of 200 starts drawn from a box</text>",
        ">stuck or not settled</text>",
        ">failed</text>",
        ">± standard error</text>",
        ">one end met (n = ",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    // From 0 to 1: the curve begins in the upper left corner and ends on the lower side.
    let frame = frames(&svg)[3];
    let curve = corners(&svg, "stroke=\"#1F3F8F\" stroke-width=\"0.9\"").pop().unwrap();
    let [first, last] = [curve[0], curve[curve.len() - 1]].map(|at| (at[1] - frame[1]) / frame[3]);
    assert!(first.abs() < 1e-3 && (last - 1.0).abs() < 1e-3, "{first} {last}");
    // sqrt(p (1 - p)/n) at 100 of 200 is 0.035 up and down, of the 110 points of the panel.
    let bars =
        svg.lines().find(|line| line.contains("class=\"error\"") && line.matches('V').count() > 2).unwrap();
    let longest = bars.split('M').filter_map(|bar| {
        let (low, high) = bar.split_once(' ')?.1.split_once('V')?;
        Some((low.parse::<f64>().ok()? - high.split('"').next()?.parse::<f64>().ok()?) / frame[3])
    });
    let longest = longest.fold(0.0, f64::max);
    assert!((longest - 2.0 * (0.25_f64 / 200.0).sqrt()).abs() < 2e-3, "{longest}");
    // On a plane the bar says it, and cells with other ends are dotted.
    let axes = vec![span(Param::MuS, 0.0, 0.6, 7), span(Param::MuD, 0.0, 0.6, 3)];
    let mut plane = crate::synthetic::map(Grid::Axes(axes), |k, _| {
        let other = u32::from(k == 4);
        let basin = Basin { equilibrium: 50, oscillation: 50 - other, other, failed: 0 };
        Record { others: Some(Others::Basin(basin)), ..record(Kind::Stable, Regime::Slip, true) }
    });
    plane.spec.analysis.starts = Starts::Box(100);
    let svg = look_svg(&plane, &Look { width: Some(190.0), ..Look::default() }).unwrap();
    draw(&svg, "basins_plane");
    assert!(
        svg.contains("standard error at most 0.05")
            && svg.contains("with other ends (1); of all starts 0.0 %")
    );
    assert!(outside(&svg).is_empty() && touching(&svg).is_empty(), "{:?}", touching(&svg));
    // What is shown where nothing is asked for is as before: classes first.
    assert_eq!(computed(plane.spec.analysis, false).len(), 4);
}

/// A single panel has one label of its own title, whatever its axes.
#[test]
fn legends_of_narrow_blocks_go_on_in_the_next_line() {
    let log = Axis { log: true, ..span(Param::K2, 1e4, 1e6, 20) };
    let map = map(Grid::Axes(vec![log, span(Param::MuD, 0.0, 0.6, 20)]), |k, _| {
        record(Kind::ALL[k % 7], Regime::ALL[k % 7], k % 2 == 0)
    });
    for width in [60.0, 70.0, 90.0] {
        let svg = look_svg(&map, &Look { width: Some(width), ..Look::default() }).unwrap();
        draw(&svg, &format!("legend_{width}"));
        assert!(outside(&svg).is_empty() && touching(&svg).is_empty(), "{width}: {:?}", touching(&svg));
    }
}
