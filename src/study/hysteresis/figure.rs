//! The figure of both branches: amplitude against the parameter, with the equilibrium and where both exist.

use std::fmt::Write as _;

use crate::engine::record::{Attractor, Record};
use crate::model::kind::InstabilityType;
use crate::results::figure::heading::Heading;
use crate::results::figure::look::Look;
use crate::results::figure::picture_axis::{Direction as Along, PictureAxis};
use crate::study::hysteresis::cycles;
use crate::study::hysteresis::follow::{Direction, Hysteresis};
use crate::sweep::grid::{Axis, Grid};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use squealmap_figure::key;
use squealmap_figure::key::Sample;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN};
use squealmap_figure::plot::{FIRST, Plot, SECOND};
use squealmap_figure::scale::{Scale, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// Height of the panel, points.
const HEIGHT: f64 = 150.0;
/// Right of the panel, points.
const RIGHT: f64 = 8.0;
/// Above the highest amplitude and below zero, as fractions of the panel.
const HEADROOM: f64 = 0.08;
/// Left and right of the branches, as a fraction of the panel: marks stay inside.
const MARGIN_ACROSS: f64 = 0.02;
/// A tick of the vertical axis takes about this much, points.
const TICK_HEIGHT: f64 = 24.0;
/// Half the width of a mark, points.
const MARK: f64 = 2.0;
/// Branches of more values than this are lines without marks.
const MOST_MARKS: usize = 80;
/// Amplitudes below this are shown in millimetres, m.
const METRES: f64 = 0.1;
/// Where both branches exist.
const BOTH: &str = r##"class="bistable" fill="#F4E3D7""##;
/// The equilibrium where it is stable, and where it is not.
const EQUILIBRIUM: [&str; 2] = [
    r##"class="stable" fill="none" stroke="#000000" stroke-width="1.8""##,
    r##"class="unstable" fill="none" stroke="#000000" stroke-width="1.1" stroke-dasharray="1.6 2""##,
];
/// Where a branch jumps.
const JUMP: &str = r##"class="jump" fill="none" stroke="#555555" stroke-width="0.5""##;
/// Strokes and fills of the marks of both branches.
const MARKS: [&str; 2] = [
    r##"fill="#1F3F8F" stroke="#1F3F8F" stroke-width="0.5""##,
    r##"fill="#FFFFFF" stroke="#D55E00" stroke-width="0.7""##,
];

/// Marks of what has not settled: its amplitude is not that of the branch.
const UNSETTLED: [&str; 2] = [
    r##"class="unsettled" fill="none" stroke="#1F3F8F" stroke-width="0.9""##,
    r##"class="unsettled" fill="none" stroke="#D55E00" stroke-width="0.9""##,
];

/// The figure of both branches as an SVG document, single column width unless the look says otherwise.
#[must_use]
pub fn hysteresis_svg(hysteresis: &Hysteresis, heading: &Heading, look: &Look<'_>) -> String {
    let heading = look.headed(heading);
    let draw = |part: f64| draw(hysteresis, &heading, look, part * HEIGHT);
    look.fitted(heading.name("Hysteresis"), HEIGHT, draw)
}

/// The picture and its size, with a panel of this height.
fn draw(hysteresis: &Hysteresis, heading: &Heading, look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let Grid::Axes(axes) = hysteresis.grid() else { return (Svg::new(), [0.0; 2]) };
    let largest = Direction::ALL
        .iter()
        .flat_map(|direction| hysteresis.branch(*direction).iter().map(amplitude))
        .chain(hysteresis.cycles.iter().flat_map(|branch| branch.points.iter().map(cycles::amplitude)))
        .filter(|amplitude| amplitude.is_finite())
        .fold(0.0, f64::max);
    let (factor, unit) = if largest < METRES { (1e3, "mm") } else { (1.0, "m") };
    let x = Scale::spanning(hysteresis.values.iter().copied()).widened(MARGIN_ACROSS);
    let y = Scale::spanning([0.0, largest * factor]).widened(HEADROOM);
    let page = look.points().unwrap_or(SINGLE_COLUMN);
    let mut svg = Svg::new();
    let mut top = MARGIN + heading.draw(&mut svg, page - 2.0 * MARGIN);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let y_ticks = y.ticks((height / TICK_HEIGHT) as usize);
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&y_ticks);
    let width = page - left - RIGHT;
    top = legend(&mut svg, hysteresis, [left, top], width);
    let frame = Frame { x: left, y: top, width, height };
    let plot = Plot { frame, x: &x, y: &y };
    both(&mut svg, hysteresis, &plot);
    equilibrium(&mut svg, hysteresis, &plot);
    cycles::draw(&mut svg, &hysteresis.cycles, &plot, factor);
    for (direction, (stroke, mark)) in Direction::ALL.into_iter().zip([FIRST, SECOND].into_iter().zip(MARKS))
    {
        let points: Vec<(f64, f64)> = hysteresis
            .values
            .iter()
            .zip(hysteresis.branch(direction))
            .map(|(value, record)| (*value, factor * amplitude(record)))
            .collect();
        let jumps = [hysteresis.jumps(direction), hysteresis.jumps_of_amplitude(direction)].concat();
        let jumped = |a: f64, b: f64| jumps.iter().any(|[from, to]| from.min(*to) <= a && b <= from.max(*to));
        // A branch is interrupted where it jumps; a thin line says where to.
        let pieces = points.chunk_by(|a, b| !jumped(a.0, b.0));
        let nothing = (f64::NAN, f64::NAN);
        plot.curve(&mut svg, pieces.flat_map(|piece| piece.iter().copied().chain([nothing])), stroke);
        let pairs = points.windows(2).filter(|pair| jumped(pair[0].0, pair[1].0));
        plot.curve(&mut svg, pairs.flat_map(|pair| [pair[0], pair[1], nothing]), JUMP);
        if points.len() <= MOST_MARKS {
            let at = |(value, amplitude): (f64, f64)| {
                (frame.across(x.position(value)), frame.up(y.position(amplitude)))
            };
            let (mut settled, mut crosses) = (String::new(), String::new());
            for (point, record) in points.iter().zip(hysteresis.branch(direction)) {
                if is_unsettled(record) {
                    crosses += &key::cross(at(*point), MARK);
                } else if point.1.is_finite() {
                    settled += &triangle(direction, at(*point));
                }
            }
            svg.path(&settled, mark);
            if !crosses.is_empty() {
                svg.path(&crosses, UNSETTLED[direction as usize]);
            }
        }
    }
    frame.border(&mut svg);
    let axis = axis(&axes[0], &x);
    frame.x_ticks(&mut svg, &axis.ticks(width, Along::Horizontal, TICK_SIZE), true);
    frame.y_ticks(&mut svg, &y_ticks, true);
    let label = Text::from("Standard deviation of ").symbol("x_2").then(axis_unit(unit, y.exponent()));
    let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
    svg.text(MARGIN + LABEL_SIZE, top + 0.5 * height, &label, upwards);
    let base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
    let label = axis.label(width, LABEL_SIZE);
    svg.text(left + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    (svg, [page, base + MARGIN + 2.0])
}

/// The parameter from edge to edge of the panel.
fn axis(axis: &Axis, x: &Scale) -> PictureAxis {
    PictureAxis::cells(axis).edge_to_edge(x)
}

/// The amplitude of a record in the figure, m. It is 0 at the equilibrium: a run sees only the beginning of the decay there.
fn amplitude(record: &Record) -> f64 {
    if Attractor::of(record, record.kind) == Some(Attractor::Equilibrium) {
        return 0.0;
    }
    record.outcome.as_ref().and_then(|outcome| outcome.x2_std).unwrap_or(f64::NAN)
}

/// Whether a record has an amplitude, but not that in which it would end.
fn is_unsettled(record: &Record) -> bool {
    amplitude(record).is_finite() && Attractor::of(record, record.kind).is_none()
}

/// Shades the values at which the branches end differently, half a step to each side; neighbours are one area.
fn both(svg: &mut Svg, hysteresis: &Hysteresis, plot: &Plot<'_>) {
    let bistable = hysteresis.bistable();
    let at = |value: f64| plot.frame.across(plot.x.position(value));
    let mut number = 0;
    for run in bistable.chunk_by(|a, b| a == b) {
        let last = number + run.len() - 1;
        if run[0] == Some(true) {
            let [from, to] =
                [edges(&hysteresis.values, number)[0], edges(&hysteresis.values, last)[1]].map(at);
            svg.rect([from, plot.frame.y, to - from, plot.frame.height], BOTH);
        }
        number = last + 1;
    }
}

/// Half way to the neighbours of a value; the first and the last have none beyond them.
fn edges(values: &[f64], number: usize) -> [f64; 2] {
    let here = values[number];
    let middle = |other: Option<&f64>| other.map_or(here, |other| 0.5 * (here + other));
    [middle(number.checked_sub(1).and_then(|before| values.get(before))), middle(values.get(number + 1))]
}

/// Whether the equilibrium is stable at each value; `None` where it has no type.
fn stable(hysteresis: &Hysteresis) -> Vec<Option<bool>> {
    let stable = |record: &Record| record.kind.map(|kind| kind == InstabilityType::Stable);
    hysteresis.up.iter().map(stable).collect()
}

/// The equilibrium as a line at 0, where its eigenvalues say stable and where not.
fn equilibrium(svg: &mut Svg, hysteresis: &Hysteresis, plot: &Plot<'_>) {
    let stable = stable(hysteresis);
    for (wanted, stroke) in [true, false].into_iter().zip(EQUILIBRIUM) {
        // From the middle between two values on, the next one counts.
        let line = (0..hysteresis.values.len()).flat_map(|at| {
            let height = if stable[at] == Some(wanted) { 0.0 } else { f64::NAN };
            edges(&hysteresis.values, at).map(|value| (value, height))
        });
        plot.curve(svg, line, stroke);
    }
}

/// A mark that points where its branch goes.
fn triangle(direction: Direction, (x, y): (f64, f64)) -> String {
    let tip = if direction == Direction::Up { 1.25 * MARK } else { -1.25 * MARK };
    let mut data = String::new();
    let _ = write!(
        data,
        "M{} {}V{}L{} {}Z",
        number(x - 0.5 * tip),
        number(y - MARK),
        number(y + MARK),
        number(x + 0.75 * tip),
        number(y)
    );
    data
}

/// Draws the legend. Returns where the panel begins.
fn legend(svg: &mut Svg, hysteresis: &Hysteresis, [left, top]: [f64; 2], width: f64) -> f64 {
    let symbol = hysteresis.param.info().symbol;
    let branch = |words: &str| Text::default().symbol(symbol).plain(words);
    let base = top + LABEL_SIZE;
    let mut x = left;
    for (direction, (words, stroke)) in
        Direction::ALL.into_iter().zip([(" rising", FIRST), (" falling", SECOND)])
    {
        let at = (x + 0.5 * key::SAMPLE, base - key::MIDDLE * LABEL_SIZE);
        x = key::lines(svg, x, base, LABEL_SIZE, &[(branch(words), stroke)]);
        svg.path(&triangle(direction, at), MARKS[direction as usize]);
    }
    let stable = stable(hysteresis);
    let is_at_rest = stable.contains(&Some(true));
    let of_both = if is_at_rest && cycles::are_stable(&hysteresis.cycles) {
        "stable equilibrium, stable cycle"
    } else {
        "stable equilibrium"
    };
    let lines = [(true, of_both), (false, "unstable equilibrium")].into_iter().zip(EQUILIBRIUM);
    let mut entries: Vec<(Text, Sample<'_>)> = lines
        .filter(|((wanted, _), _)| stable.contains(&Some(*wanted)))
        .map(|((_, words), stroke)| (Text::from(words), Sample::Line(stroke)))
        .collect();
    entries.extend(cycles::entries(&hysteresis.cycles, is_at_rest));
    if hysteresis.bistable().contains(&Some(true)) {
        entries.push((Text::from("bistable"), Sample::Area(BOTH)));
    }
    let marked = hysteresis.values.len() <= MOST_MARKS;
    let crossed = |direction: &Direction| marked && hysteresis.branch(*direction).iter().any(is_unsettled);
    let crosses: Vec<&str> =
        Direction::ALL.into_iter().filter(crossed).map(|direction| UNSETTLED[direction as usize]).collect();
    if !crosses.is_empty() {
        entries.push((Text::from("not settled"), Sample::Crosses(MARK, &crosses)));
    }
    base + 4.0 + key::rows(svg, [left, base + 4.0], width, LABEL_SIZE, &entries) + 5.0
}
