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
