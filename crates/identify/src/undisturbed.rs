//! Friction against velocity in a record of vibrations, without what these blur.
//!
//! A vibration that reverses the sliding lowers the mean of `T/N`: that is not the friction at the mean velocity, however
//! slow or fast the force sensors are. It is left out, and with it what slow sensors remember of it; so is a rest, in which friction is
//! whatever holds the body.

use crate::cells::Cell;
use crate::level::SMALL;
use crate::points::{Point, RESTS};

/// How long a slow force sensor remembers a vibration or a rest, s: six time constants at 50 Hz.
const REMEMBERS: f64 = 0.02;

/// Windows that begin this many hops apart share no samples: their errors are independent.
const APART: f64 = 4.0;

/// Friction that no vibration blurs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Undisturbed {
    /// Points, and whether their temperature was recorded.
    pub points: Vec<(Point, bool)>,
    /// Share of the record that is left out, of what is not at rest.
    pub left_out: f64,
    /// Share of the record that is at rest.
    pub at_rest: f64,
}

/// Half of the range that the velocity passes within a cell and its windows, which reach over its ends, m/s.
fn half_range(cells: &[Cell], number: usize, hop: f64) -> f64 {
    let [before, after] = [number.saturating_sub(1), (number + 1).min(cells.len() - 1)].map(|k| &cells[k]);
    let pace = (after.velocity() - before.velocity()) / (after.middle() - before.middle());
    if pace.is_finite() { 0.5 * pace.abs() * hop * (cells[number].windows + APART - 1.0) } else { 0.0 }
}

/// The points of the cells of a record with velocity and forces; of a part of one, slow sensors remember what was before it (`is_part`).
pub(super) fn undisturbed(cells: &[Cell], has_temperature: bool, is_part: bool) -> Undisturbed {
    let mut points = Vec::new();
    let (mut blurred, mut all, mut rests) = (0.0, 0.0, 0.0);
    let mut since = cells.first().filter(|_| is_part).map_or(f64::NEG_INFINITY, |first| first.time[0]);
    let mut last = f64::NEG_INFINITY;
    let fastest = cells.iter().map(Cell::speed).fold(0.0, f64::max);
    for (number, cell) in cells.iter().enumerate() {
        let hop = (cell.time[1] - cell.time[0]) / cell.windows;
        let half_range = half_range(cells, number, hop);
        if cell.speed() - half_range <= RESTS * fastest {
            since = cell.time[1];
            rests += cell.windows;
            continue;
        }
        all += cell.windows;
        let vibrates = cell.is_loud() && cell.reach().is_none_or(|reach| reach >= SMALL);
        if vibrates {
            since = cell.time[1];
        }
        if vibrates || cell.time[0] < since + REMEMBERS || !cell.friction().is_finite() {
            blurred += cell.windows;
            continue;
        }
        if cell.middle() - last > (APART - 0.5) * hop {
            last = cell.middle();
            let (velocity, friction, temperature) = (cell.velocity(), cell.friction(), cell.temperature());
            points.push((Point { velocity, half_range, friction, temperature }, has_temperature));
        }
    }
    let share = |part: f64, of: f64| if of > 0.0 { part / of } else { 0.0 };
    Undisturbed { points, left_out: share(blurred, all), at_rest: share(rests, all + rests) }
}
