//! Where the starts of a box have ended, along an axis: a curve for each end that occurs, with the standard error of the
//! oscillations.

use std::fmt::Write as _;

use crate::engine::record::Basin;
use crate::results::figure::panels::Panels;
use squealmap_figure::jumps::stepped;
use squealmap_figure::key::Sample;
use squealmap_figure::plot::{FIRST, Plot, SECOND, THIRD};
use squealmap_figure::svg::Svg;
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// One standard error up and down.
const ERROR: &str = r##"class="error" fill="none" stroke="#1F3F8F" stroke-width="0.6""##;
/// The stroke of starts that have failed.
const FAILED: &str = r##"fill="none" stroke="#C00000" stroke-width="0.9" stroke-dasharray="6 1.4 1 1.4" stroke-linejoin="round""##;

/// An end, its words and its stroke.
type End = (fn(&Basin) -> u32, &'static str, &'static str);

const ENDS: [End; 4] = [
    (|basin| basin.oscillation, "oscillation", FIRST),
    (|basin| basin.equilibrium, "steady sliding", SECOND),
    (|basin| basin.other, "stuck or not settled", THIRD),
    (|basin| basin.failed, "failed", FAILED),
];

/// The ends that occur, and that of the block in any case.
fn met(basins: &[Option<Basin>]) -> impl Iterator<Item = End> {
    let occurs = |of: fn(&Basin) -> u32| basins.iter().flatten().any(|basin| of(basin) > 0);
    let kept = ENDS.into_iter().enumerate().map(move |(number, end)| (number == 0 || occurs(end.0), end));
    kept.filter(|(kept, _)| *kept).map(|(_, end)| end).collect::<Vec<_>>().into_iter()
}

/// The heading above the curves.
pub(crate) fn heading(basins: &[Option<Basin>]) -> Text {
    let starts = basins.iter().flatten().map(|basin| basin.total()).max().unwrap_or(0);
    Text::from(format!("Ends of {starts} starts drawn from a box"))
}

/// The entries that name the curves; none where there are no starts.
pub(crate) fn entries(basins: &[Option<Basin>]) -> Vec<(Text, Sample<'static>)> {
    let all = met(basins).map(|(_, words, stroke)| (Text::from(words), Sample::Line(stroke)));
    let error = (Text::from("± standard error"), Sample::Bar(ERROR));
    if basins.is_empty() { Vec::new() } else { all.chain([error]).collect() }
}

/// Draws them over positions along the axis of a panel, with a step where `same` says that two neighbours are of different
/// classes and their fractions jump.
pub(crate) fn curves(
    svg: &mut Svg,
    plot: &Plot<'_>,
    panels: &Panels,
    basins: &[Option<Basin>],
    same: impl Fn(usize) -> bool,
) {
    let at = |cell: usize| panels.x.between(cell as f64);
    let mut bars = String::new();
    for (cell, basin) in basins.iter().enumerate() {
        let Some((basin, part)) = basin.and_then(|one| Some((one, one.fraction(one.oscillation)?))) else {
            continue;
        };
        let error = basin.standard_error(basin.oscillation).unwrap_or(0.0);
        if error > 0.0 {
            let [x, low, high] = [
                plot.frame.across(at(cell)),
                plot.frame.up(plot.y.position(part - error)),
                plot.frame.up(plot.y.position(part + error)),
            ];
            let _ = write!(bars, "M{} {}V{}", number(x), number(low), number(high));
        }
    }
    svg.path(&bars, ERROR);
    for (of, _, stroke) in met(basins) {
        let part = |basin: &Option<Basin>| basin.and_then(|one| one.fraction(of(&one))).unwrap_or(f64::NAN);
        let points: Vec<(f64, f64)> =
            basins.iter().enumerate().map(|(cell, basin)| (at(cell), part(basin))).collect();
        plot.curve(svg, stepped(&points, 1.0, &same), stroke);
    }
}
