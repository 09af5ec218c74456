//! Lines of equal value over a grid of points: marching squares with linear interpolation along the edges.
//!
//! Points are `(column, row)`. An edge joins two neighbours; a line crosses it where its ends lie on different sides of
//! the level. Squares with an undefined corner have no lines.

use std::collections::BTreeMap;

/// An edge: its lower or left point, and whether it goes up.
type Edge = (usize, usize, bool);

/// A point of a line, in columns and rows: between `(2, 5)` and `(3, 5)` it is `[2.x, 5.0]`.
pub type Place = [f64; 2];

/// The lines of an angle over `columns` × `rows` angles in degrees. Angles are told apart along the shorter arc: where
/// they jump from 180° to −180° there is no line, and the line of 180° is found there. Neighbours more than a quarter of
/// a turn apart have no line between them: which way the angle goes there, the points do not tell.
#[must_use]
pub fn lines_of_angle(
    size: [usize; 2],
    level: f64,
    value: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<Vec<Place>> {
    /// Half a turn, and a quarter, degrees.
    const HALF: f64 = 180.0;
    const QUARTER: f64 = 90.0;
    let away = |i: usize, j: usize| {
        let from = |angle: f64| (angle - level + HALF).rem_euclid(2.0 * HALF) - HALF;
        value(i, j).filter(|angle| angle.is_finite()).map(from)
    };
    squares(size, 0.0, away, |corners| {
        (0..4).all(|side| (corners[side] - corners[(side + 1) % 4]).abs() < QUARTER)
    })
}

/// The lines of a level over `columns` × `rows` values; `value` gives that of a column and row, `None` where it is
/// undefined. The last place of a closed line is the first again. A value that is the level counts as above it.
#[must_use]
pub fn isolines(
    size: [usize; 2],
    level: f64,
    value: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<Vec<Place>> {
    squares(size, level, value, |_| true)
}

/// The lines of a level as [`isolines`] gives them, but only through squares that `smooth` accepts. It gets the values at
/// the four corners, anticlockwise from the lower left one.
fn squares(
    [columns, rows]: [usize; 2],
    level: f64,
    value: impl Fn(usize, usize) -> Option<f64>,
    smooth: impl Fn([f64; 4]) -> bool,
) -> Vec<Vec<Place>> {
    let value = |i: usize, j: usize| value(i, j).filter(|value| value.is_finite());
    let mut joined: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for j in 0..rows.saturating_sub(1) {
        for i in 0..columns.saturating_sub(1) {
            let corners = [value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)];
            let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
            if !smooth([a, b, c, d]) {
                continue;
            }
            for [one, other] in segments([a, b, c, d], level) {
                // Edges of a square: below, right, above, left.
                let edge =
                    |side: usize| [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)][side];
                joined.entry(edge(one)).or_default().push(edge(other));
                joined.entry(edge(other)).or_default().push(edge(one));
            }
        }
    }
    let place = |(i, j, up): Edge| {
        let (k, l) = if up { (i, j + 1) } else { (i + 1, j) };
        let [from, to] = [value(i, j), value(k, l)].map(|end| end.unwrap_or(level));
        // The ends of a crossed edge lie on different sides of the level, and differ.
        let part = (level - from) / (to - from);
        [i as f64 + part * (k - i) as f64, j as f64 + part * (l - j) as f64]
    };
    chains(joined).into_iter().map(|chain| chain.into_iter().map(place).collect()).collect()
}

/// The pairs of sides of a square that a level joins. The corners are given anticlockwise from the lower left one.
fn segments(corners: [f64; 4], level: f64) -> Vec<[usize; 2]> {
    let above = corners.map(|value| value >= level);
    // A side is crossed where its ends differ.
    let crossed: Vec<usize> = (0..4).filter(|side| above[*side] != above[(side + 1) % 4]).collect();
    match crossed[..] {
        [one, other] => vec![[one, other]],
        // A saddle: the middle says which two corners belong together.
        [below, right, top, left] => {
            let middle = corners.iter().sum::<f64>() / 4.0 >= level;
            if middle == above[0] {
                vec![[below, right], [top, left]]
            } else {
                vec![[left, below], [right, top]]
            }
        }
        _ => Vec::new(),
    }
}

/// Joins edges to lines: first the open ones, from their ends, then the closed ones.
fn chains(mut joined: BTreeMap<Edge, Vec<Edge>>) -> Vec<Vec<Edge>> {
    let ends: Vec<Edge> =
        joined.iter().filter(|(_, others)| others.len() == 1).map(|(edge, _)| *edge).collect();
    let all: Vec<Edge> = joined.keys().copied().collect();
    let mut lines = Vec::new();
    for start in ends.into_iter().chain(all) {
        let mut line = vec![start];
        let mut at = start;
        while let Some(next) = joined.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = joined.get_mut(&next) {
                back.retain(|edge| *edge != at);
            }
            line.push(next);
            at = next;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}
