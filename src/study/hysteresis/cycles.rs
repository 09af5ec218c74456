//! Branches of cycles in the figure: lines where they are stable, dashes where not, and marks where they change.

use crate::study::cycles::branch::{Branch, BranchPoint};
use crate::study::cycles::special::Special;
use squealmap_figure::frame::TICK_SIZE;
use squealmap_figure::key::Sample;
use squealmap_figure::plot::Plot;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// A cycle where it is stable, and where it is not.
const CYCLE: [&str; 2] = [
    r##"class="stable-cycle" fill="none" stroke="#000000" stroke-width="1.8" stroke-linejoin="round""##,
    r##"class="unstable-cycle" fill="none" stroke="#000000" stroke-width="0.8" stroke-dasharray="3 2" stroke-linejoin="round""##,
];

/// Where a branch changes, and where it ends.
const MARKS: [&str; 2] = [r##"fill="#000000""##, r##"fill="#FFFFFF" stroke="#000000" stroke-width="0.6""##];

/// Radius of such a mark, points.
const RADIUS: f64 = 1.6;

/// A label stands so far beside its mark and above it, points.
const BESIDE: f64 = 2.5;

/// What is marked: the label in the figure, and the words of the legend.
const MARKED: [(Special, &str, &str); 6] = [
    (Special::Fold, "LP", "fold (LP)"),
    (Special::Doubling, "PD", "period doubling (PD)"),
    (Special::Torus, "NS", "torus (NS)"),
    (Special::Corner, "C", "fold at a change of contact (C)"),
    (Special::Hopf, "H", "Hopf (H)"),
    (Special::End, "", "end of a branch"),
];

/// The amplitude of a cycle in the figure, m.
pub(super) fn amplitude(point: &BranchPoint) -> f64 {
    let shrunk = point.special == Some(Special::Hopf);
    if shrunk { 0.0 } else { point.x2_std().unwrap_or(f64::NAN) }
}

/// Draws the branches; amplitudes are multiplied by `factor`.
pub(super) fn draw(svg: &mut Svg, branches: &[Branch], plot: &Plot<'_>, factor: f64) {
    let at = |point: &BranchPoint| (point.value, factor * amplitude(point));
    for branch in branches {
        // A piece has the stability of its second point, as a change belongs to what follows it.
        let steps: Vec<[&BranchPoint; 2]> =
            branch.points.windows(2).map(|pair| [&pair[0], &pair[1]]).collect();
        for (unstable, stroke) in CYCLE.into_iter().enumerate() {
            let pieces = steps.chunk_by(|a, b| is_unstable(a) == is_unstable(b));
            let line =
                pieces.filter(|piece| usize::from(is_unstable(&piece[0])) == unstable).flat_map(|piece| {
                    let first = at(piece[0][0]);
                    std::iter::once(first)
                        .chain(piece.iter().map(|step| at(step[1])))
                        .chain([(f64::NAN, f64::NAN)])
                });
            plot.curve(svg, line, stroke);
        }
    }
    for ((branch, number), (special, label, _)) in marks(branches) {
        let point = &branch.points[number];
        let (value, amplitude) = at(point);
        let (x, y) = (plot.frame.across(plot.x.position(value)), plot.frame.up(plot.y.position(amplitude)));
        if !x.is_finite() || !y.is_finite() {
            continue;
        }
        svg.circle(x, y, RADIUS, MARKS[usize::from(special == Special::End)]);
        // On the side that the branch leaves free, inside the frame.
        let beside = [number.saturating_sub(1), number + 1];
        let other = beside.into_iter().filter_map(|other| branch.points.get(other));
        let turns_back = other.map(|other| other.value - value).sum::<f64>() > 0.0;
        let (room, frame) = (2.0 * BESIDE + TICK_SIZE, plot.frame);
        let left = turns_back && x - room > frame.x || x + room > frame.x + frame.width;
        let (x, anchor) = if left { (x - BESIDE, Anchor::End) } else { (x + BESIDE, Anchor::Start) };
        svg.text(x, y - BESIDE, &Text::from(label), Style::new(TICK_SIZE, anchor));
    }
}

/// Whether two neighbours are joined by unstable cycles.
fn is_unstable(step: &[&BranchPoint; 2]) -> bool {
    // Of a change of stability only the other point tells.
    let [before, after] = step;
    let changes = |point: &BranchPoint| point.special.is_some_and(|special| special != Special::End);
    if changes(after) { before.unstable > 0 } else { after.unstable > 0 }
}

/// The points that are marked, each with its branch and its number there.
fn marks(
    branches: &[Branch],
) -> impl Iterator<Item = ((&Branch, usize), (Special, &'static str, &'static str))> {
    let points =
        branches.iter().flat_map(|branch| (0..branch.points.len()).map(move |number| (branch, number)));
    points.filter_map(|(branch, number)| {
        let special = branch.points[number].special?;
        let marked = MARKED.into_iter().find(|(marked, ..)| *marked == special)?;
        Some(((branch, number), marked))
    })
}

/// Whether a cycle of the branches is stable.
pub(super) fn are_stable(branches: &[Branch]) -> bool {
    branches.iter().any(|branch| branch.points.iter().any(|point| point.unstable == 0))
}

/// What the legend says of the branches; the stable ones have the line of a stable equilibrium, which the legend may have already.
pub(super) fn entries(branches: &[Branch], with_equilibrium: bool) -> Vec<(Text, Sample<'static>)> {
    let points = || branches.iter().flat_map(|branch| &branch.points);
    let lines = [("stable cycle", false), ("unstable cycle", true)].into_iter().zip(CYCLE);
    let there = |unstable: bool| {
        (unstable || !with_equilibrium) && points().any(|point| (point.unstable > 0) == unstable)
    };
    let lines = lines
        .filter(|((_, unstable), _)| there(*unstable))
        .map(|((words, _), stroke)| (Text::from(words), Sample::Line(stroke)));
    let marks = MARKED
        .into_iter()
        .filter(|(special, ..)| points().any(|point| point.special == Some(*special)))
        .map(|(special, _, words)| {
            let fill = MARKS[usize::from(special == Special::End)];
            (Text::from(words), Sample::Mark(RADIUS, fill))
        });
    lines.chain(marks).collect()
}
