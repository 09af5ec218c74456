//! The parts of a stretch in each of which the friction law is a straight line.

use crate::cells::Cell;
use crate::cut::{Course, PRICE, priced};
use crate::knee::Knee;
use crate::level::{LEAST, Trend, range, reads};
use crate::within::SIDE;

/// A part of a stretch of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Its first cell, and the one after its last.
    pub(super) cells: [usize; 2],
    /// Whether the law has a knee at its beginning and at its end.
    knees: [bool; 2],
    /// The knee below which it lies, where that explains what is read better than straight lines do.
    pub(super) knee: Option<Knee>,
    /// The law of all parts as slow as this one, where they are the slowest: it is one, however often the velocity comes there.
    pub(super) line: Option<Trend>,
    /// Whether a part of it lies beyond a knee, for too short a time to be cut off: it has no slope.
    pub(super) mixed: bool,
}

impl Part {
    /// All of so many cells.
    pub(super) fn whole(count: usize) -> Part {
        Part { cells: [0, count], knees: [false; 2], knee: None, line: None, mixed: false }
    }

    /// Whether the cells `from..to` of this part are fastest at a knee, where all cells of the stretch are given.
    pub(super) fn fastest_at_knee(&self, [from, to]: [usize; 2], stretch: &[Cell]) -> bool {
        let [slowest, fastest] = range(&stretch[from..to], Cell::speed);
        let [begins, ends] = self.knees;
        let marked = [(begins && from == self.cells[0], from), (ends && to == self.cells[1], to - 1)];
        marked.iter().any(|(knee, at)| *knee && stretch[*at].speed() > 0.5 * (slowest + fastest))
    }
}

/// The parts of a stretch: a knee of the law comes first, what else changes with the velocity is cut between. What is read while the velocity
/// changes by a fifth is smeared over more than a knee is, and shows none. `least`: cells of a part.
pub(super) fn parts(cells: &[Cell], least: usize) -> Vec<Part> {
    /// The least scatter of a level that means anything.
    const SCATTER: f64 = 0.005;
    /// By how much less a knee has to leave of the residuals than lines do.
    const CLEARLY: f64 = 4.0;
    /// The part of its cells that may lie beyond a knee.
    const MIXED: f64 = 0.1;
    let found = reads(cells);
    if found.len() < 2 * LEAST {
        return vec![Part::whole(cells.len())];
    }
    // The law is one of the speed, however often the velocity goes to and fro.
    let begins = [0].into_iter().chain(found.iter().map(|(after, _)| *after));
    let begins: Vec<usize> = begins.collect();
    let steady = begins.iter().zip(&found).filter(|(from, (after, [velocity, _]))| {
        let change = cells[*after.min(&(cells.len() - 1))].velocity() - cells[**from].velocity();
        change.abs() < SIDE * velocity.abs()
    });
    let mut points: Vec<[f64; 2]> =
        steady.map(|(_, (_, [velocity, level]))| [velocity.abs(), *level]).collect();
    if points.len() < 2 * LEAST {
        return vec![Part::whole(cells.len())];
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let lines = (least * points.len()).div_ceil(cells.len());
    let course = Course::new(&points, SCATTER);
    let scale = course.scale();
    let (cuts, price) = priced(points.len(), &[course], lines);
    let knee = Knee::fitted(&points, scale, lines).filter(|(_, left)| left + PRICE + CLEARLY < price);
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
    let last = stretches.len() - 1;
    let starts = [0].into_iter().chain(stretches.iter().skip(1).map(|[from, _]| found[from - 1].0));
    let starts: Vec<usize> = starts.collect();
    let mut parts: Vec<Part> = (0..=last)
        .map(|k| Part {
            cells: [starts[k], starts.get(k + 1).copied().unwrap_or(cells.len())],
            knees: [k > 0, k < last],
            knee: None,
            line: None,
            mixed: false,
        })
        .collect();
    let of = |part: &Part| &cells[part.cells[0]..part.cells[1]];
    for part in &mut parts {
        let most = place(Cell::sum(of(part)).speed());
        let elsewhere = of(part).iter().filter(|cell| place(cell.speed()) != most).count();
        part.mixed = elsewhere as f64 > MIXED * of(part).len() as f64;
    }
    let Some(slowest) = speeds.first() else { return parts };
    let (slow, all): (Vec<&mut Part>, Vec<&[Cell]>) = parts
        .iter_mut()
        .filter(|part| Cell::sum(of(part)).speed() < *slowest)
        .map(|part| {
            let cells = of(part);
            (part, cells)
        })
        .unzip();
    let line = if slow.is_empty() { None } else { Trend::new(&all.concat(), true, knee) };
    for part in slow {
        (part.knee, part.line) = (knee, line);
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
