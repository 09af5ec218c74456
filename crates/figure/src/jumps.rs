//! Jumps in curves. Where two neighbouring instances belong to different classes, and their values are further apart than
//! those around them, the curve has a step halfway between them, as a border has in a map, instead of a slope.

/// A step is a jump from this multiple of the steps beside it on. A square root that starts between two instances, as the
/// amplitude beyond a Hopf bifurcation, has 2.4 at most.
const RATIO: f64 = 3.0;
/// A jump is also at least this part of the range of all curves of a panel.
const LEAST: f64 = 0.05;

/// The points of a curve with a step in place of every jump. `same` says of a place whether it and the next one are of one
/// class; `reach` is the length of the vertical axis.
pub fn stepped(points: &[(f64, f64)], reach: f64, same: impl Fn(usize) -> bool) -> Vec<(f64, f64)> {
    let change = |place: usize| match (points.get(place), points.get(place + 1)) {
        (Some((_, a)), Some((_, b))) => (b - a).abs(),
        _ => f64::NAN,
    };
    let is_jump = |place: usize| {
        let beside = [place.checked_sub(1), Some(place + 1)].into_iter().flatten();
        // What changes its class, too, says nothing of how steep a class is.
        let around = beside.filter(|place| same(*place)).map(change).filter(|change| change.is_finite());
        let around = around.fold(0.0, f64::max);
        !same(place) && change(place) > LEAST * reach && change(place) > RATIO * around
    };
    let mut stepped = Vec::with_capacity(points.len());
    for (place, (x, y)) in points.iter().copied().enumerate() {
        stepped.push((x, y));
        if let (true, Some((next, to))) = (is_jump(place), points.get(place + 1)) {
            let middle = 0.5 * (x + next);
            stepped.extend([(middle, y), (middle, *to)]);
        }
    }
    stepped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(values: &[f64]) -> Vec<(f64, f64)> {
        values.iter().enumerate().map(|(k, value)| (k as f64, *value)).collect()
    }

    #[test]
    fn a_jump_between_classes_is_a_step() {
        let points = curve(&[0.0, 0.1, 5.0, 5.1]);
        let with_step = [(0.0, 0.0), (1.0, 0.1), (1.5, 0.1), (1.5, 5.0), (2.0, 5.0), (3.0, 5.1)];
        assert_eq!(stepped(&points, 5.1, |place| place != 1), with_step);
        // The same values of one class, or another class at another place, are a slope.
        assert_eq!(stepped(&points, 5.1, |_| true), points);
        assert_eq!(stepped(&points, 5.1, |place| place != 2), points);
        // A class of one instance has a step on both sides.
        assert_eq!(stepped(&curve(&[0.0, 5.0, 0.0]), 5.0, |_| false).len(), 3 + 4);
    }

    #[test]
    fn what_is_steep_throughout_is_no_jump() {
        assert_eq!(stepped(&curve(&[0.0, 2.0, 4.0, 6.0]), 6.0, |place| place != 1).len(), 4);
        // A square root from between two instances on, wherever it starts.
        for start in [0.0, 0.01, 0.5, 0.99] {
            let of = |k: i32| f64::from(k) - 2.0 - start;
            let values: Vec<f64> = (0..8).map(|k| of(k).max(0.0).sqrt()).collect();
            let is_same =
                |place: usize| (values.get(place) > Some(&0.0)) == (values.get(place + 1) > Some(&0.0));
            assert_eq!(stepped(&curve(&values), 2.5, is_same).len(), 8, "{start}");
        }
        // What is undefined stays a gap.
        assert_eq!(stepped(&curve(&[0.0, f64::NAN, 5.0]), 5.0, |_| false).len(), 3);
    }
}
