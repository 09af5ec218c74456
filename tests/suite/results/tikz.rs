//! The source for LaTeX: its structure; where `pdflatex` is at hand, it is compiled too.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::common::near;
use crate::synthetic::{axis, map, number, paper_like, record, span};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::error::Error;
use squealmap::results::figure::look::Look;
use squealmap::results::figure::tikz::map_tikz;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;

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
    let law = ["bilinear", "rational", "constant"].map(|name| Value::Text(name.to_owned().into())).to_vec();
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

/// pdflatex knows no letters beyond ASCII in formulas: every label of an axis is written in commands.
#[test]
fn every_axis_is_written_in_commands() {
    for param in squealmap::model::PARAMS.iter().map(|row| row.param) {
        let axes = vec![span(param, 1.0, 2.0, 3), span(Param::MuD, 0.0, 0.6, 3)];
        let map = map(Grid::Axes(axes), |_, _| record(Kind::Stable, Regime::Slip, true));
        let tex = map_tikz(&map, &Look::default()).unwrap();
        let labels: Vec<&str> = tex.lines().filter(|line| line.contains("label={")).collect();
        assert!(labels.len() == 4 && labels.iter().all(|label| label.is_ascii()), "{labels:?}");
        assert_eq!(unbalanced(&tex), None);
    }
}

/// Hatching is in the legend where it occurs.
#[test]
fn hatching_has_its_words() {
    let tex = map_tikz(&sweep(), &Look::default()).unwrap();
    assert_eq!(tex.matches("~not settled}").count(), 1);
    assert_eq!(tex.matches("~no result}").count(), 1, "of the regime alone");
    let axes = vec![span(Param::MuS, 0.0, 0.6, 3), span(Param::MuD, 0.0, 0.6, 3)];
    let plain = map(Grid::Axes(axes), |_, _| record(Kind::Stable, Regime::Slip, true));
    let tex = map_tikz(&plain, &Look::default()).unwrap();
    assert!(!tex.contains("~not settled}") && !tex.contains("~no result}"));
}

#[test]
fn points_are_no_source() {
    let rows = (0..3).map(|k| vec![Value::Number(f64::from(k))]).collect();
    let grid = Grid::Tuples { keys: vec![AxisKey::Param(Param::MuS)], rows };
    let map = map(grid, |_, _| record(Kind::Stable, Regime::Slip, true));
    let error = map_tikz(&map, &Look::default()).unwrap_err();
    assert!(error.is_bad_input() && matches!(error, Error::Tikz { .. }), "{error}");
}

/// `pdflatex` makes one page of every kind of source, without an error or a word beyond the page. Machines without it, or
/// without its packages, have the tests of the structure alone.
#[test]
fn pdflatex_makes_a_page_of_it() {
    let k2 = Axis { log: true, ..axis(Param::K2, &[1e3, 1e4, 1e5, 1e6]) };
    let law = ["bilinear", "rational"].map(|name| Value::Text(name.to_owned().into())).to_vec();
    let law = Axis { key: AxisKey::Law, values: law, log: false };
    let named =
        map(Grid::Axes(vec![k2, law]), |k, _| record(Kind::ALL[k % 7], Regime::ALL[k % 7], k % 2 == 0));
    let axes = vec![span(Param::Decay, 0.1, 0.6, 5), span(Param::StartVelocity, 0.1, 0.6, 5)];
    let greek = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), 3.0));
    for (name, map) in [("three axes", sweep()), ("log and names", named), ("greek", greek)] {
        let tex = map_tikz(&map, &Look { width: Some(190.0), ..Look::default() }).unwrap();
        let Some(said) = compiled(&tex) else { return };
        assert!(said.contains("Output written on plot.pdf (1 page"), "{name}: {said}");
        assert!(!said.contains("\n! ") && !said.contains("Overfull"), "{name}: {said}");
    }
    // A mistake is seen.
    let tex = map_tikz(&sweep(), &Look::default()).unwrap();
    let broken = compiled(&tex.replacen("\\begin{groupplot}", "\\begin{groupplots}", 1)).unwrap();
    assert!(broken.contains("\n! "), "{broken}");
}

/// What `pdflatex` says of a source; `None` where it, or a package that the source needs, is not there.
fn compiled(tex: &str) -> Option<String> {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("plot.tex"), tex).unwrap();
    let ended = std::process::Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "plot.tex"])
        .current_dir(directory.path())
        .output()
        .ok()?;
    let said = String::from_utf8_lossy(&ended.stdout).into_owned();
    (!said.contains("not found")).then_some(said)
}
