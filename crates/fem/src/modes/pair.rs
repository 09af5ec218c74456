//! A complex mode in the coordinates of a basis.

use faer::c64;

/// An eigenvalue and its vector.
#[derive(Debug, Clone)]
pub struct Pair {
    /// λ, 1/s: growth rate and angular frequency. Of each pair of conjugates the one with a frequency that is not negative.
    pub lambda: c64,
    /// x in the coordinates of the basis, xᴴ x = 1.
    pub vector: Vec<c64>,
}

impl Pair {
    /// Frequency, Hz.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.lambda.im / std::f64::consts::TAU
    }

    /// Growth rate, 1/s.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.lambda.re
    }
}

/// |xᴴ y|² of two unit vectors: 1 for the same shape, 0 for shapes that have nothing in common in M.
#[must_use]
pub fn likeness(x: &[c64], y: &[c64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a.conj() * b).sum::<c64>().norm_sqr()
}

/// Joins things of two kinds by offers, each with its worth: the best first, each thing once. Gives the partner of each of the first kind; `counts`
/// are how many there are of both.
pub(super) fn matched(mut offers: Vec<(f64, usize, usize)>, counts: [usize; 2]) -> Vec<Option<usize>> {
    offers.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut partner, mut taken) = (vec![None; counts[0]], vec![false; counts[1]]);
    for (_, one, other) in offers {
        if partner[one].is_none() && !taken[other] {
            partner[one] = Some(other);
            taken[other] = true;
        }
    }
    partner
}
