//! One small figure of everything that `plot` makes of a map beside its classes: quantities with lines of equal value,
//! cuts, curves of one axis, and the source for LaTeX.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::synthetic::{axis, map, number, paper_like, span};
use squealmap::model::Param;
use squealmap::results::cut::{Cut, cut_svg};
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map::look_svg;
use squealmap::results::figure::palette::Colouring;
use squealmap::results::figure::tikz::map_tikz;
use squealmap::results::number::NumberColumn;
use squealmap::sweep::grid::Grid;
use squealmap::sweep::map::Map;

/// Names of files and what they hold.
pub(crate) fn plots() -> Vec<(&'static str, String)> {
    let sweep = sweep();
    let [growth, phase, amplitude] = columns(&sweep);
    let (levels, angles) = ([0.0, 2.0, 5.0], [-90.0, 0.0, 90.0, 180.0]);
    let contents = vec![
        Content::Quantity { column: &growth, levels: &levels },
        Content::Quantity { column: &phase, levels: &angles },
        Content::quantity(&amplitude),
    ];
    let look = Look { contents, width: Some(140.0), ..Look::default() };
    let cut = Cut::new(&sweep.spec.grid, "mu_d=0.1,mu_d=0.3").unwrap();
    let line =
        map(Grid::Axes(vec![span(Param::MuS, 0.0, 0.6, 25)]), |_, at| paper_like(number(at[0]), 0.2, 1.0));
    let [_, _, along] = columns(&line);
    let strip = vec![Content::classes(Colouring::Type, false), Content::quantity(&along)];
    let narrow = |contents| Look { contents, width: Some(90.0), ..Look::default() };
    vec![
        ("isolines.svg", look_svg(&sweep, &look).unwrap()),
        (
            "cut.svg",
            cut_svg(&sweep, &cut, &[&growth, &amplitude], &Look { width: Some(140.0), ..Look::default() }),
        ),
        ("curve.svg", look_svg(&line, &narrow(strip)).unwrap()),
        ("plot.tex", map_tikz(&sweep, &Look { width: Some(140.0), ..Look::default() }).unwrap()),
    ]
}

/// A map like the paper's, of two velocities.
fn sweep() -> Map {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])))
}

/// A growth with a plateau at 0, a phase that winds around a point, and an amplitude.
fn columns(map: &Map) -> [NumberColumn; 3] {
    let grid = &map.spec.grid;
    let at = |k: usize| {
        let at: Vec<f64> = grid.coordinates(k).into_iter().map(number).collect();
        [at[0], at.get(1).copied().unwrap_or(0.2), at.get(2).copied().unwrap_or(1.0)]
    };
    let column = |name: &str, unit: &str, of: &dyn Fn([f64; 3]) -> f64| NumberColumn {
        name: name.to_owned(),
        unit: unit.to_owned(),
        meaning: String::new(),
        values: (0..grid.len()).map(|k| Some(of(at(k)))).collect(),
    };
    [
        column("growth_rate", "1/s", &|[x, y, v]| {
            (12.0 * x - 2.0 * v * y).max(0.0) + 1e-13 * (70.0 * x * y).sin()
        }),
        column("phase", "deg", &|[x, y, _]| (y - 0.27).atan2(x - 0.32).to_degrees()),
        column("x2_std", "m", &|[x, y, v]| 1e-3 * v * (x + y * y)),
    ]
}
