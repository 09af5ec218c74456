//! Tables of friction against velocity.

use crate::model::piece::Piece;

/// Velocities of two tables that differ by less than this part of themselves are one: the piece between them would be all
/// rounding, and none in f32.
const ALIKE: f64 = 1e-6;

/// A tabulated law: strictly rising velocities (m/s), the first 0, with their friction coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct MuTable {
    /// `|v|`, m/s, strictly rising from 0.
    pub velocity: Vec<f64>,
    /// μ at each velocity.
    pub mu: Vec<f64>,
}

impl MuTable {
    /// Piece `index`: before row `index`, constant beyond the last row.
    pub(super) fn piece(&self, index: usize) -> Piece {
        match (self.velocity.get(index), self.mu.get(index)) {
            (Some(v1), Some(mu1)) => {
                let (v0, mu0) = (self.velocity[index - 1], self.mu[index - 1]);
                let slope = (mu1 - mu0) / (v1 - v0);
                Piece::Linear { at_zero: mu0 - slope * v0, slope }
            }
            _ => Piece::Linear { at_zero: self.mu[self.mu.len() - 1], slope: 0.0 },
        }
    }

    /// The table `part` (0..1) of the way to `other`: at every velocity of either, both mixed there.
    #[must_use]
    pub fn mixed(&self, other: &MuTable, part: f64) -> MuTable {
        let rows = self.velocity.len() + other.velocity.len();
        let (mut velocity, mut mu) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let (mut i, mut j) = (0, 0);
        let next = |table: &MuTable, row: usize| table.velocity.get(row).copied().unwrap_or(f64::INFINITY);
        while i < self.velocity.len() || j < other.velocity.len() {
            let (a, b) = (next(self, i), next(other, j));
            let (in_self, in_other) = (a - b <= ALIKE * b, b - a <= ALIKE * a);
            // The lower of two that are one: whatever follows in either table is above it.
            let v = a.min(b);
            let here = if in_self { self.mu[i] } else { self.before(i, v) };
            let there = if in_other { other.mu[j] } else { other.before(j, v) };
            velocity.push(v);
            mu.push(here + (there - here) * part);
            (i, j) = (i + usize::from(in_self), j + usize::from(in_other));
        }
        MuTable { velocity, mu }
    }

    /// μ at the velocity `v` between the rows `index - 1` and `index`, that of the last row beyond it.
    fn before(&self, index: usize, v: f64) -> f64 {
        let from = index.saturating_sub(1);
        let (v0, mu0) = (self.velocity[from], self.mu[from]);
        match (self.velocity.get(index), self.mu.get(index)) {
            (Some(v1), Some(mu1)) if *v1 > v0 => mu0 + (mu1 - mu0) * ((v - v0) / (v1 - v0)),
            _ => mu0,
        }
    }
}
