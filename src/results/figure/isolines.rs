//! Lines of equal value on the panels of a quantity, with their values on them, and the same lines as a table.

use crate::results::csv::Table;
use crate::results::error::Result;
use crate::results::figure::field;
use crate::results::figure::outline::shape;
use crate::results::figure::panels::{Panel, Panels};
use crate::results::number::NumberColumn;
use crate::sweep::columns::Cell;
use crate::sweep::map::Map;
use squealmap_figure::frame::{Frame, TICK_SIZE};
use squealmap_figure::marching::{Place, isolines, lines_of_angle};
use squealmap_figure::scale::{Scale, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;

/// The light casing of a line and the line itself: seen on light and on dark.
const STROKES: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="1.5" stroke-linejoin="round""##,
    r##"class="isoline" fill="none" stroke="#000000" stroke-width="0.6" stroke-linejoin="round""##,
];
/// Behind a label.
pub(super) const PLATE: &str = r##"fill="#FFFFFF" fill-opacity="0.8""##;
/// Free room around a label, points.
const ROOM: f64 = 1.5;

/// Lines that reach no further than this, in cells, go around a single instance: the grid does not resolve them.
const SHORTEST: f64 = 1.0;
/// Values that are this near a level, relative to the largest of the quantity, count as the level itself: the difference is
/// rounding.
const FLAT: f64 = 1e-9;

/// A line on the page, points.
type Drawn<'a> = &'a [(f64, f64)];
/// A box on the page: left, upper, right and lower end, points.
type Area = [f64; 4];

/// Draws the lines of a panel of cells; a panel of points has none.
pub(crate) fn draw(
    svg: &mut Svg,
    panels: &Panels,
    panel: &Panel,
    (column, levels): (&NumberColumn, &[f64]),
    frame: &Frame,
) {
    let at = |[x, y]: [f64; 2]| (frame.across(x), frame.up(y));
    let lines: Vec<(f64, Vec<(f64, f64)>)> = lines(panels, panel, column, levels)
        .into_iter()
        .map(|(level, line)| (level, line.into_iter().map(at).collect()))
        .collect();
    for stroke in STROKES {
        let data = lines.iter().map(|(_, line)| polyline(line.iter().copied()));
        svg.path(&data.collect::<String>(), stroke);
    }
    let mut taken: Vec<Area> = Vec::new();
    // In the notation of the bar, whose power of ten is in the heading.
    let unit = 10_f64.powi(field::exponent(column));
    for (level, line) in &lines {
        let label = value_label(level / unit);
        let others: Vec<Drawn<'_>> = lines
            .iter()
            .map(|(_, other)| other.as_slice())
            .filter(|other| *other != line.as_slice())
            .collect();
        if let Some(area) = place(line, &label, frame, (&taken, &others)) {
            let [left, top, right, bottom] = area;
            svg.rect([left, top, right - left, bottom - top], PLATE);
            let base = bottom - ROOM;
            svg.text(0.5 * (left + right), base, &label, Style::new(TICK_SIZE, Anchor::Middle));
            taken.push(area);
        }
    }
}

/// Where the label of a line goes: as near the middle of the line as the frame and other labels let it, and off other lines
/// where that is possible. A short line has no label.
fn place(
    line: &[(f64, f64)],
    label: &Text,
    frame: &Frame,
    (taken, others): (&[Area], &[Drawn<'_>]),
) -> Option<Area> {
    let half = [0.5 * label.width(TICK_SIZE, false) + ROOM, 0.36 * TICK_SIZE + ROOM];
    // A label would hide what reaches little further than it does.
    let reach = |of: fn(&(f64, f64)) -> f64| {
        let ends = line
            .iter()
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        ends.1 - ends.0
    };
    if reach(|at| at.0).max(reach(|at| at.1)) < 2.5 * half[0] {
        return None;
    }
    let line = &closer(line);
    let middle = line.len() / 2;
    let mut order: Vec<usize> = (0..line.len()).collect();
    order.sort_by_key(|k| k.abs_diff(middle));
    let mut free = order.into_iter().filter_map(|k| {
        let (x, y) = line[k];
        let area = [x - half[0], y - half[1], x + half[0], y + half[1]];
        let [left, top, right, bottom] = area;
        let inside =
            left > frame.x && right < frame.x + frame.width && top > frame.y && bottom < frame.bottom();
        let free = |other: &Area| right < other[0] || left > other[2] || bottom < other[1] || top > other[3];
        (inside && taken.iter().all(free)).then_some(area)
    });
    let first = free.next()?;
    let clear = |area: &Area| !others.iter().any(|other| crosses(other, *area));
    Some(std::iter::once(first).chain(free).find(clear).unwrap_or(first))
}

/// A line with points no further apart than half a label is high: a long segment has room for one anywhere.
fn closer(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const APART: f64 = 0.5 * TICK_SIZE;
    let mut points: Vec<(f64, f64)> = line.iter().take(1).copied().collect();
    for pair in line.windows(2) {
        let [(x, y), (to_x, to_y)] = [pair[0], pair[1]];
        let parts = ((to_x - x).hypot(to_y - y) / APART).ceil().max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive count"
        )]
        points.extend((1..=parts as u32).map(|k| {
            let part = f64::from(k) / parts;
            (x + part * (to_x - x), y + part * (to_y - y))
        }));
    }
    points
}

/// Whether a line runs through an area.
fn crosses(line: &[(f64, f64)], [left, top, right, bottom]: Area) -> bool {
    line.windows(2).any(|pair| {
        let [(x, y), (to_x, to_y)] = [pair[0], pair[1]];
        // The part of the segment between each pair of sides.
        let within = |from: f64, to: f64, low: f64, high: f64| {
            let step = to - from;
            if step == 0.0 {
                if (low..=high).contains(&from) { [0.0, 1.0] } else { [1.0, 0.0] }
            } else {
                let ends = [(low - from) / step, (high - from) / step];
                [ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]).min(1.0)]
            }
        };
        let [across, up] = [within(x, to_x, left, right), within(y, to_y, top, bottom)];
        across[0].max(up[0]) <= across[1].min(up[1])
    })
}

/// The lines of a panel with their levels, as positions from 0 to 1 across and up.
fn lines(panels: &Panels, panel: &Panel, column: &NumberColumn, levels: &[f64]) -> Vec<(f64, Vec<Place>)> {
    let (Some(y), None, Some([columns, rows])) = (&panels.y, panels.scatter, shape(panels, panel)) else {
        return Vec::new();
    };
    let value = |i: usize, j: usize| {
        let instance = panels.instances[panel.cells.start + j * columns + i];
        column.values.get(instance).copied().flatten()
    };
    let flat = FLAT * largest(column);
    // What is the level but for rounding is the level: on a plateau of it there are no lines.
    let settled = |level: f64| {
        move |i: usize, j: usize| {
            value(i, j).map(|value| if (value - level).abs() <= flat { level } else { value })
        }
    };
    let position = |[i, j]: Place| [panels.x.between(i), y.between(j)];
    let of = |level: f64| {
        let found = if column.is_angle() {
            lines_of_angle([columns, rows], level, settled(level))
        } else {
            isolines([columns, rows], level, settled(level))
        };
        found
            .into_iter()
            .filter(|line| extent(line) >= SHORTEST)
            .map(move |line| (level, line.into_iter().map(position).collect()))
    };
    // 180° and −180° are one angle.
    let new = |k: &usize| {
        let whole = |other: &f64| (levels[*k] - other).rem_euclid(360.0) == 0.0;
        !column.is_angle() || !levels[..*k].iter().any(whole)
    };
    (0..levels.len()).filter(new).flat_map(|k| of(levels[k]).collect::<Vec<_>>()).collect()
}

/// The largest magnitude of a quantity.
fn largest(column: &NumberColumn) -> f64 {
    column.values.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// How far a line reaches across or up, in cells.
fn extent(line: &[Place]) -> f64 {
    let along = |k: usize| {
        let (low, high) = line
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at[k]), high.max(at[k])));
        high - low
    };
    along(0).max(along(1))
}

/// The lines as a table: the number of the panel (from 1, in the order of the figure), the quantity, its value, and both
/// coordinates. A row of `NaN` ends each line.
///
/// # Errors
/// When the table cannot be written.
pub fn isoline_table(map: &Map, quantities: &[(&NumberColumn, &[f64])]) -> Result<Vec<u8>> {
    let panels = Panels::new(&map.spec.grid);
    let mut table = Table::new(["panel", "quantity", "value", "x", "y"].into_iter())?;
    for (column, levels) in quantities {
        for (number, panel) in panels.all.iter().enumerate() {
            for (level, line) in lines(&panels, panel, column, levels) {
                let mut row = |x: String, y: String| {
                    let level = Cell::from(level).to_string();
                    table.row([(number + 1).to_string(), column.name.clone(), level, x, y].into_iter())
                };
                for [x, y] in line {
                    let up = panels.y.as_ref().map_or(f64::NAN, |axis| axis.scale.value(y));
                    row(Cell::from(panels.x.scale.value(x)).to_string(), Cell::from(up).to_string())?;
                }
                row("NaN".to_owned(), "NaN".to_owned())?;
            }
        }
    }
    table.finish()
}

/// At most about so many round parts of a turn, degrees, on a scale.
fn parts_of_a_turn(scale: &Scale, most: usize) -> Vec<f64> {
    /// Steps that a turn has whole numbers of.
    const STEPS: [f64; 6] = [10.0, 15.0, 30.0, 45.0, 60.0, 90.0];
    let [low, high] = [scale.value(0.0), scale.value(1.0)];
    let step = STEPS.into_iter().find(|step| (high - low) / step <= most as f64).unwrap_or(90.0);
    let first = (low / step).ceil();
    let levels = (0..).map(|k| (first + f64::from(k)) * step);
    levels.take_while(|level| *level <= high).map(|level| level + 0.0).collect()
}

/// About so many round values between the lowest and the highest of a quantity.
#[must_use]
pub fn round_levels(column: &NumberColumn, most: usize) -> Vec<f64> {
    /// Digits of a round value; further ones are rounding.
    const DIGITS: usize = 9;
    let scale = field::scale(column);
    if column.is_angle() {
        return parts_of_a_turn(&scale, most);
    }
    let [low, high] = [0.0, 1.0].map(|at| scale.value(at));
    let value = |at: f64| {
        let value = scale.value(at);
        // Zero, but for rounding.
        if low < 0.0 && value.abs() < FLAT * (high - low) {
            return 0.0;
        }
        format!("{value:.DIGITS$e}").parse().unwrap_or(value)
    };
    let inside = |at: &f64| (0.0..=1.0).contains(at);
    scale.ticks(most).into_iter().map(|tick| tick.at).filter(inside).map(value).collect()
}
