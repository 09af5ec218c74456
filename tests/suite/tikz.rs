//! The source for LaTeX: its structure, since no LaTeX is at hand.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use squealmap::Error;
use squealmap::classify::{InstabilityType as Kind, Regime};
use squealmap::export::look::Look;
use squealmap::export::tikz::map_tikz;
use squealmap::grid::{Axis, AxisKey, Grid, Value};
use squealmap::map::Map;
use squealmap::model::Param;

use crate::common::near;
use crate::synthetic::{axis, map, number, paper_like, record, span};

/// A map like the paper's, of three velocities.
fn sweep() -> Map {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[0.5, 3.0, 6.0]),
    ];
    let mut map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
    "100 % of {all} & more_".clone_into(&mut map.spec.title);
    map
}

/// What is not closed, or closed twice: environments, braces and formulas.
fn unbalanced(tex: &str) -> Option<String> {
    let mut open: Vec<&str> = Vec::new();
    for (number, line) in tex.lines().enumerate().filter(|(_, line)| !line.starts_with('%')) {
        let mut rest = line;
        while let Some(at) = rest.find(r"\begin{").into_iter().chain(rest.find(r"\end{")).min() {
            let begins = rest[at..].starts_with(r"\begin{");
            let name = rest[at..].split_once('{')?.1.split_once('}')?.0;
            if begins {
                open.push(name);
            } else if open.pop() != Some(name) {
                return Some(format!("line {}: {name}", number + 1));
            }
            rest = &rest[at + 5..];
        }
    }
    let bare = tex.replace(r"\{", "").replace(r"\}", "").replace(r"\$", "");
    let mut depth = 0_i32;
    for c in bare.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth < 0 {
            return Some("a brace too many".to_owned());
        }
    }
    let formulas = bare.matches('$').count().is_multiple_of(2);
    (depth != 0 || !open.is_empty() || !formulas).then(|| format!("{depth} braces, {open:?}, {formulas}"))
}

/// Every place of a document, `(axis cs:x,y)`.
fn places(tex: &str) -> Vec<[f64; 2]> {
    let parts = tex.split("(axis cs:").skip(1);
    parts
        .map(|part| {
            let (x, y) = part.split_once(')').unwrap().0.split_once(',').unwrap();
            [x, y].map(|number| number.parse().unwrap())
        })
        .collect()
}

#[test]
fn the_source_of_a_map_is_whole() {
    let map = sweep();
    let tex = map_tikz(&map, &Look { width: Some(190.0), ..Look::default() }).unwrap();
    assert_eq!(unbalanced(&tex), None);
    assert_eq!(tex.matches(r"\nextgroupplot").count(), 2 * 3, "types and regimes at three velocities");
    assert_eq!(tex.matches("group size=3 by 1").count(), 2);
    assert!(tex.contains(r"\textbf{100 \% of \{all\} \& more\_}"), "the title");
    assert!(tex.contains(r"title={$V$ = 0.5 m/s}"), "the title of a panel");
    assert!(tex.contains(r"$\mu _{\mathrm{s}}$") || tex.contains(r"$\mu_{\mathrm{s}}$"), "{tex}");
    // Half a cell beyond the values, and nothing beyond that.
    let [low, high] = [-0.025, 0.625];
    assert!(tex.contains("xmin=-0.02") && tex.contains("xmax=0.62"));
    let places = places(&tex);
    assert!(places.len() > 200);
    for [x, y] in &places {
        for at in [x, y] {
            assert!((low - 1e-12..=high + 1e-12).contains(at), "{x}, {y}");
        }
    }
    // Every colour that is used is defined, once.
    for name in tex.split("\\fill[class-").skip(1).map(|rest| rest.split(',').next().unwrap()) {
        assert_eq!(tex.matches(&format!("\\definecolor{{class-{name}}}")).count(), 1, "{name}");
    }
    // The comparers see what is not closed, and what lies beyond.
    assert!(unbalanced(&tex.replacen("\\end{groupplot}", "", 1)).is_some());
    assert!(unbalanced(&tex.replacen('}', "", 1)).is_some());
    assert!(unbalanced(&tex.replacen('$', "", 1)).is_some());
}

/// One class in the left half, one in the right: the areas have their corners where the classes have.
#[test]
fn areas_are_where_their_classes_are() {
    let k2 = Axis { log: true, ..axis(Param::K2, &[1e3, 1e4, 1e5, 1e6]) };
    let law = ["bilinear", "rational", "constant"].map(|name| Value::Text(name.to_owned())).to_vec();
    let law = Axis { key: AxisKey::Law, values: law, log: false };
    let mut map = map(Grid::Axes(vec![k2, law]), |k, _| {
        record(if k < 6 { Kind::Stable } else { Kind::ModeCoupling }, Regime::Slip, true)
    });
    map.spec.analysis.response = false;
    let tex = map_tikz(&map, &Look::default()).unwrap();
    assert_eq!(unbalanced(&tex), None);
    assert!(
        tex.contains("xmode=log") && tex.contains("ytick={0,1,2}, yticklabels={bilinear,rational,constant}")
    );
    let area = |class: &str| {
        let line = tex.lines().find(|line| line.starts_with(&format!("\\fill[class-{class},"))).unwrap();
        let all = places(line);
        let ends = |k: usize| {
            let of = all.iter().map(|place| place[k]);
            [of.clone().fold(f64::INFINITY, f64::min), of.fold(f64::NEG_INFINITY, f64::max)]
        };
        [ends(0), ends(1)]
    };
    // Cells end half way between the values, in the logarithm; three names are -0.5 to 2.5.
    for (class, [low, high]) in [("stable", [2.5, 4.5]), ("mode-coupling", [4.5, 6.5])] {
        let [x, y] = area(class);
        assert!((x[0].log10() - low).abs() < 1e-9 && (x[1].log10() - high).abs() < 1e-9, "{class}: {x:?}");
        near(class, y[0], -0.5, 1e-12);
        near(class, y[1], 2.5, 1e-12);
    }
    assert_eq!(tex.matches("\\draw[line width=0.4pt] (axis").count(), 1, "one line between them");
}

#[test]
fn points_are_no_source() {
    let rows = (0..3).map(|k| vec![Value::Number(f64::from(k))]).collect();
    let grid = Grid::Tuples { keys: vec![AxisKey::Param(Param::MuS)], rows };
    let map = map(grid, |_, _| record(Kind::Stable, Regime::Slip, true));
    let error = map_tikz(&map, &Look::default()).unwrap_err();
    assert!(error.is_bad_input() && matches!(error, Error::Tikz { .. }), "{error}");
}
