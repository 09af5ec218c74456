//! Displacements of contact points along a direction, in the unknowns.

use std::collections::BTreeMap;

use super::{Numbering, Point, Rows};

/// v·(u_s − Σ w u_m) of each contact point along a direction v of it: S for the direction of sliding.
pub(super) fn along(
    numbering: &Numbering,
    contact: &[Point],
    direction: impl Fn(&Point) -> [f64; 3],
) -> Rows {
    let row = |point: &Point| {
        let v = direction(point);
        let sides = std::iter::once((point.slave, 1.0)).chain(point.masters.iter().map(|(m, w)| (*m, -w)));
        weighted(
            sides.flat_map(|(node, w)| {
                (0..3).map(move |axis| (w * v[axis], &numbering.rows[3 * node + axis]))
            }),
        )
    };
    Rows { rows: contact.iter().map(row).collect() }
}

/// The sum of some rows, each with a factor.
pub(super) fn weighted<'a>(rows: impl Iterator<Item = (f64, &'a Vec<(usize, f64)>)>) -> Vec<(usize, f64)> {
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for (factor, row) in rows {
        for (unknown, f) in row {
            *sums.entry(*unknown).or_default() += factor * f;
        }
    }
    sums.into_iter().filter(|(_, v)| v.abs() > 0.0).collect()
}
