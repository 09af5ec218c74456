//! The temperatures of a material whose user names none.

use crate::study::fit::range;
use squealmap_identify::Point;

/// Rows of a material over temperatures that are not repeated.
const ROWS: u16 = 5;
/// As many temperatures of a campaign are rows of its material, each with as many points or more: a law has up to three
/// parameters, and their errors need some more.
const MOST_MEASURED: usize = 20;
const ENOUGH_POINTS: usize = 6;

/// The temperatures of the points where these are few with enough points each; else evenly spaced ones over them.
#[must_use]
pub fn rows(points: &[Point]) -> Vec<f64> {
    let mut measured: Vec<f64> = points.iter().map(|point| point.temperature).collect();
    measured.sort_by(f64::total_cmp);
    let groups: Vec<usize> = measured.chunk_by(|a, b| a.total_cmp(b).is_eq()).map(<[f64]>::len).collect();
    measured.dedup();
    if measured.len() <= MOST_MEASURED && groups.iter().all(|points| *points >= ENOUGH_POINTS) {
        return measured;
    }
    let [low, high] = range(points, |point| point.temperature);
    if low < high {
        let last = ROWS - 1;
        (0..=last)
            .map(|k| if k == last { high } else { low + (high - low) * f64::from(k) / f64::from(last) })
            .collect()
    } else {
        points.first().map(|point| point.temperature).into_iter().collect()
    }
}
