//! A branch beyond a change of contact states.
//!
//! There the return map has one linear form on one side and another on the other, so that the curve of fixed points has a
//! corner; where both ends of it are on the same side of the parameter, a stable and an unstable cycle meet without a
//! multiplier of +1.

use nalgebra::{DMatrix, DVector};

use crate::study::cycles::map::ReturnMap;
use crate::study::cycles::newton::{Fixed, tangent};

/// Beyond a border that is closer than this by far.
const BEYOND: f64 = 1e-6;

/// Neighbours there are this far apart.
const SPACING: f64 = 1e-7;

/// The direction of the branch beyond the border that `last` is next to, and the order of events there.
pub(super) fn beyond(map: &ReturnMap, last: &Fixed) -> Option<(DVector<f64>, u64)> {
    let place = &last.place;
    let moved = |from: &DVector<f64>, i: usize, by: f64| {
        let mut there = from.clone();
        there[i] += by;
        there
    };
    // Which way along each coordinate the border lies, and what is behind it.
    let mut order = None;
    let mut base = place.clone();
    for i in 0..place.len() {
        for by in [BEYOND, -BEYOND] {
            let there = map.fly(&moved(place, i, by)).map(|flown| flown.order);
            let is_other = |other: &u64| *other != last.order;
            if there.filter(is_other).is_some_and(|there| *order.get_or_insert(there) == there) {
                base[i] += by;
                break;
            }
        }
    }
    let order = order?;
    let there = map.fly(&base).filter(|flown| flown.order == order)?;
    let column = |i: usize| {
        [SPACING, -SPACING].into_iter().find_map(|by| {
            let flown = map.fly(&moved(&base, i, by)).filter(|flown| flown.order == order)?;
            Some((flown.end - &there.end) / by)
        })
    };
    let columns: Option<Vec<DVector<f64>>> = (0..place.len()).map(column).collect();
    let along = tangent(&DMatrix::from_columns(&columns?), &last.tangent)?;
    // The branch is where those events are.
    let is_there = |by: f64| map.fly(&(place + &along * by)).is_some_and(|flown| flown.order == order);
    match [BEYOND, -BEYOND].map(is_there) {
        [true, _] => Some((along, order)),
        [false, true] => Some((-along, order)),
        [false, false] => None,
    }
}
