//! The line `μ_s = μ_d` of a map over both coefficients, and shares of both its sides.

use std::path::Path;

use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{map, number, record, span};
use squealmap::engine::options::Options;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::figure::map::map_svg;
use squealmap::sweep::grid::{Axis, Grid};
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

/// Stable from `μ_s = 0.3` on, whatever `μ_d`.
fn drawn(axes: Vec<Axis>) -> String {
    let map = map(Grid::Axes(axes), |_, at| {
        let kind = if number(at[0]) >= 0.3 - 1e-9 { Kind::Stable } else { Kind::ModeCoupling };
        record(kind, Regime::Slip, number(at[0]) > 0.01)
    });
    map_svg(&map).expect("a complete map")
}

#[test]
fn shares_are_of_each_side_of_the_line() {
    // 21 x 21 cells 0.03 apart: 231 with μ_s ≥ μ_d, 210 below.
    let svg = drawn(vec![span(Param::MuS, 0.0, 0.6, 21), span(Param::MuD, 0.0, 0.6, 21)]);
    // Stable: μ_s of the numbers 10 to 20, with 11 to 21 values of μ_d at or below it and 10 to 0 above.
    let falling = (11..=21).sum::<u32>();
    let rising = (0..=10).sum::<u32>();
    let share = |n: u32, total: u32| format!("{:.1}", 100.0 * f64::from(n) / f64::from(total));
    for (label, [n, other]) in [
        ("stable", [falling, rising]),
        ("mode coupling", [231 - falling, 210 - rising]),
        // μ_s = 0: one cell on the line, 20 below.
        ("unsettled", [1, 20]),
    ] {
        let words = format!(">{label} {} | {} %<", share(n, 231), share(other, 210));
        assert!(svg.contains(&words), "{words}");
    }
    assert!(svg.contains(">slip 100.0 | 100.0 %<"), "of its own side");
    // From corner to corner of both pictures, where the axes are the same; headings this long stand in the legends.
    let picture = draw(&svg, "equal_coefficients");
    assert_eq!(svg.matches("class=\"equal_coefficients\"").count(), 4);
    for frame in frames(&svg) {
        for at in [0.021, 0.26, 0.74, 0.979] {
            let on = colour(&picture, frame, (at, at));
            assert!(on.iter().all(|channel| *channel < 130), "{at} {on:?}");
        }
    }
}

#[test]
fn no_line_where_it_means_nothing() {
    let has = |axes| drawn(axes).contains("equal_coefficients");
    let square = |from: f64, to: f64| vec![span(Param::MuS, from, to, 21), span(Param::MuD, 0.0, 0.3, 21)];
    assert!(has(square(0.1, 0.6)));
    assert!(!has(square(0.4, 0.6)), "all on one side");
    assert!(!has(vec![span(Param::MuS, 0.0, 0.6, 21), span(Param::BeltVelocity, 0.0, 0.6, 21)]));
    // Few instances are counted, not shared.
    assert!(!has(vec![span(Param::MuS, 0.0, 0.6, 14), span(Param::MuD, 0.0, 0.6, 14)]));
}

/// The shipped map, every fourth coefficient: settled where friction falls, hardly anything open elsewhere.
#[test]
fn the_shipped_map_is_settled() {
    let text = std::fs::read_to_string("sweeps/paper_map.toml").expect("the shipped map");
    let text = text.replace("points = 41", "points = 11");
    let spec = Spec::parse(&text, "paper_map.toml", Path::new(".")).expect("a valid sweep");
    let map = run::run(spec, &Options::default(), &|_| {}).expect("a map");
    let [mut falling, mut rising] = [[0, 0]; 2];
    for (index, record) in map.records.iter().enumerate() {
        let params = map.spec.instance(index).params;
        let rises = params.require(Param::MuS) < params.require(Param::MuD);
        let side = if rises { &mut rising } else { &mut falling };
        side[usize::from(record.settled == Some(false))] += 1;
    }
    assert_eq!(falling[0] + falling[1], 5 * 66);
    assert!(100 * falling[1] <= 5 * 66 && 100 * rising[1] <= 4 * 5 * 55, "{falling:?} {rising:?}");
}
