//! The modes of a structure without friction, and what damps them one by one.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// Turns for each frequency; it takes two or three.
const TURNS: usize = 60;

/// Real modes of K and M.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Natural {
    /// Angular frequencies, in the order of the columns of `vectors`.
    frequencies: DVector<f64>,
    /// Which of them is the lowest, the next, and so on.
    rising: Vec<usize>,
    /// Y, the eigenvectors of L⁻¹ K L⁻ᵀ.
    vectors: DMatrix<f64>,
    /// Lᵀ of M = L Lᵀ.
    upper: DMatrix<f64>,
}

impl Natural {
    /// The modes; `None` beyond the range of numbers, or where the mass matrix is not positive definite.
    pub(super) fn new(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Option<Natural> {
        let lower = Cholesky::new(mass.clone())?.unpack();
        // L⁻¹ K L⁻ᵀ has the squares of the frequencies.
        let half = lower.solve_lower_triangular(stiffness)?;
        let squares = lower.solve_lower_triangular(&half.transpose())?;
        let eigen = SymmetricEigen::try_new(squares, f64::EPSILON, TURNS * mass.nrows())?;
        let mut rising: Vec<usize> = (0..mass.nrows()).collect();
        rising.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let frequencies = eigen.eigenvalues.map(|square| square.abs().sqrt().copysign(square));
        Some(Natural { frequencies, rising, vectors: eigen.eigenvectors, upper: lower.transpose() })
    }

    /// The highest frequency, rad per unit of time; also that of a motion that falls apart.
    pub(super) fn highest(&self) -> f64 {
        self.frequencies.iter().fold(0.0_f64, |most, frequency| most.max(frequency.abs()))
    }

    /// The same with a longer unit of time: frequencies are divided by `unit`.
    pub(super) fn per(self, unit: f64) -> Natural {
        Natural { frequencies: self.frequencies / unit, ..self }
    }

    /// Σ 2 ζ ω φ (M φ)ᵀ, of which C is M times as much; `ratio` gives ζ of a mode, from 0 for the lowest.
    pub(super) fn damping(&self, ratio: impl Fn(usize) -> f64) -> Option<DMatrix<f64>> {
        let mut doubled = DVector::zeros(self.rising.len());
        for (k, at) in self.rising.iter().enumerate() {
            doubled[*at] = 2.0 * ratio(k) * self.frequencies[*at].max(0.0);
        }
        // L⁻ᵀ Y ω Yᵀ Lᵀ.
        let within =
            &self.vectors * DMatrix::from_diagonal(&doubled) * self.vectors.transpose() * &self.upper;
        self.upper.solve_upper_triangular(&within)
    }
}
