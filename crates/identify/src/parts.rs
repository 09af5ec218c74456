//! The parts of a stretch in each of which the friction law is a straight line.

use crate::cells::Cell;
use crate::cut::{Course, PRICE, priced};
use crate::knee::Knee;
use crate::level::{Around, LEAST, Trend, by_speed, range, reads};
use crate::within::SIDE;

/// A part of a stretch of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Its first cell, and the one after its last.
    pub(super) cells: [usize; 2],
    /// Whether the law has a knee at its beginning and at its end.
    knees: [bool; 2],
    around: Around,
}

impl Part {
    /// All of so many cells.
    pub(super) fn whole(count: usize) -> Part {
        Part { cells: [0, count], knees: [false; 2], around: Around::default() }
    }

    /// What is known of the law around the cells `from..to` of this part, where all cells of the stretch are given.
    pub(super) fn around(&self, [from, to]: [usize; 2], stretch: &[Cell]) -> Around {
        let [slowest, fastest] = range(&stretch[from..to], Cell::speed);
        let [begins, ends] = self.knees;
        let marked = [(begins && from == self.cells[0], from), (ends && to == self.cells[1], to - 1)];
        let fast = |at: usize| stretch[at].speed() > 0.5 * (slowest + fastest);
        Around { at_knee: marked.iter().any(|(knee, at)| *knee && fast(*at)), ..self.around }
    }
}

/// The parts of a stretch: a knee of the law comes first, what else changes with the velocity is cut between. What is read while the velocity
/// changes by a fifth is smeared over more than a knee is, and shows none. `least`: cells of a part.
pub(super) fn parts(cells: &[Cell], least: usize) -> Vec<Part> {
    /// The least scatter of a level that means anything.
    const SCATTER: f64 = 0.005;
    /// By how much more than two lines with a cut between them a knee may leave of the residuals: what noise alone makes of the parameter that it
    /// lacks.
    const ALIKE: f64 = 10.0;
    /// The part of its cells that may lie beyond a knee.
    const MIXED: f64 = 0.1;
    let found = reads(cells);
    if found.len() < 2 * LEAST {
        return vec![Part::whole(cells.len())];
    }
    // The law is one of the speed, however often the velocity goes to and fro.
    let begins = [0].into_iter().chain(found.iter().map(|(after, _)| *after));
    let begins: Vec<usize> = begins.collect();
    let steady = |k: usize| {
        let (after, [velocity, _]) = found[k];
        let change = cells[after.min(cells.len() - 1)].velocity() - cells[begins[k]].velocity();
        change.abs() < SIDE * velocity.abs()
    };
    let steady: Vec<usize> = (0..found.len()).filter(|k| steady(*k)).collect();
    let point = |k: &usize| [found[*k].1[0].abs(), found[*k].1[1]];
    let mut points: Vec<[f64; 2]> = steady.iter().map(point).collect();
    if points.len() < 2 * LEAST {
        return vec![Part::whole(cells.len())];
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let lines = (least * points.len()).div_ceil(cells.len());
    let course = Course::new(&points, SCATTER);
    let scale = course.scale();
    let (cuts, price) = priced(points.len(), &[course], lines);
    let read = steady.iter().flat_map(|k| &cells[begins[*k]..found[*k].0]);
    let read = Cell::sum(&read.copied().collect::<Vec<_>>());
    let width = read.within.half_width(read.velocity());
    let knee = Knee::fitted(&points, width, scale, lines).filter(|(_, left)| left + PRICE < price + ALIKE);
    let knee = knee.map(|(knee, _)| knee);
    let between = cuts.iter().filter(|cut| **cut < points.len());
    let between = between.map(|cut| 0.5 * (points[cut - 1][0] + points[*cut][0])).collect();
    let speeds: Vec<f64> = knee.map_or(between, |knee| vec![knee.below]);
    // Among which of these speeds something moves.
    let place = |speed: f64| speeds.iter().filter(|at| speed > **at).count();
    // Below a knee lies what is read wholly below it.
    let fastest = |from: usize, to: usize| range(&cells[from..to], Cell::speed)[1];
    let read = begins.iter().zip(&found).map(|(from, (after, _))| place(fastest(*from, *after)));
    let stretches = stretches(read.collect(), LEAST, false);
    // A stretch begins behind what was read before it, and the last one ends with the cells.
    let begin = |k: usize| if k == 0 { 0 } else { found[k - 1].0 };
    let end = |k: usize| if k == found.len() { cells.len() } else { begin(k) };
    let parts = stretches.iter().map(|[from, to]| {
        let own = &cells[begin(*from)..end(*to)];
        let most = place(Cell::sum(own).speed());
        let elsewhere = own.iter().filter(|cell| place(cell.speed()) != most).count();
        let around = Around { mixed: elsewhere as f64 > MIXED * own.len() as f64, ..Around::default() };
        let knees = [*from > 0, *to < found.len()];
        (Part { cells: [begin(*from), end(*to)], knees, around }, most)
    });
    let (mut parts, places): (Vec<Part>, Vec<usize>) = parts.unzip();
    // What is slower than all of these speeds, and faster than a knee, has one law.
    let sides = [(0, true)].into_iter().chain(knee.map(|_| (1, false)));
    for (side, at_knee) in sides.filter(|_| !speeds.is_empty()) {
        let of_side = || places.iter().map(move |place| *place == side);
        let own: Vec<[usize; 2]> =
            parts.iter().zip(of_side()).filter(|(_, own)| *own).map(|(part, _)| part.cells).collect();
        let own = steady
            .iter()
            .map(|k| [begins[*k], found[*k].0])
            .filter(|[from, to]| own.iter().any(|[first, after]| first <= from && to <= after));
        let own: Vec<Cell> = own.flat_map(|[from, to]| &cells[from..to]).copied().collect();
        if own.is_empty() {
            continue;
        }
        let line = Trend::new(&by_speed(&own), at_knee, knee);
        for (part, _) in parts.iter_mut().zip(of_side()).filter(|(_, own)| *own) {
            part.around = Around { knee, line, ..part.around };
        }
    }
    parts
}

/// Stretches of the same kind; one shorter than `least` goes with the longer one beside it, but for a last one that is not of kind 0 where
/// such a one may be a beginning (`begins`).
pub(super) fn stretches(mut kinds: Vec<usize>, least: usize, begins: bool) -> Vec<[usize; 2]> {
    if kinds.is_empty() {
        return Vec::new();
    }
    loop {
        let mut ends: Vec<usize> = (1..kinds.len()).filter(|k| kinds[*k] != kinds[*k - 1]).collect();
        ends.push(kinds.len());
        let starts = [0].into_iter().chain(ends.iter().copied());
        let found: Vec<[usize; 2]> = starts.zip(&ends).map(|(from, to)| [from, *to]).collect();
        let length = |k: usize| found.get(k).map_or(0, |[from, to]| to - from);
        let stays = |k: usize| begins && k + 1 == found.len() && kinds[found[k][0]] > 0;
        let short = (0..found.len()).filter(|k| length(*k) < least && !stays(*k)).min_by_key(|k| length(*k));
        let Some(short) = short.filter(|_| found.len() > 1) else { return found };
        let before = short.checked_sub(1);
        let beside = before.filter(|before| length(*before) >= length(short + 1)).unwrap_or(short + 1);
        let [[from, to], [other, _]] = [found[short], found[beside]];
        let kind = kinds[other];
        kinds[from..to].fill(kind);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_stretches_go_with_what_is_beside_them() {
        assert_eq!(stretches(vec![0, 0, 0, 1, 0, 0, 2, 2, 2], 2, false), [[0, 6], [6, 9]]);
        // Not at all what begins at the end.
        assert_eq!(stretches(vec![0, 0, 0, 1], 2, true), [[0, 3], [3, 4]]);
        assert_eq!(stretches(vec![0, 0, 0, 1], 2, false), [[0, 4]]);
        assert_eq!(stretches(vec![1, 0, 0, 0], 2, true), [[0, 4]]);
        assert_eq!(stretches(vec![1], 2, false), [[0, 1]]);
        assert!(stretches(Vec::new(), 2, true).is_empty());
    }
}
