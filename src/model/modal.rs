//! A few modes of any structure in sliding contact, in the place of two masses: its eigenvalues.
//!
//! In the coordinates x of n vectors, as `squealmap fem` writes them,
//!
//! ```text
//! λ² (M + μ M_f) x + λ (C + μ C_f + μ'(V) F/F0 D/(1 + w μ) + 2 ζ (M + μ M_f) Ω) x + (K + μ K_f) x = 0
//! ```
//!
//! with μ = μ(V): friction adds to all three matrices, since the normal force holds back stiffness, inertia and damping of
//! the surface. D is what a slope of 1 s/m is under the load F0, F the load (`f_ext`), w what friction takes off the normal
//! forces. ζ (`damping_ratio`) damps the modes without friction, Ω = Σ ω φ (M φ)ᵀ. Attribution is that of
//! [`crate::model::linear`]: without the slope, and without the feedback of the normal force (μ = 0 in the matrices).

use nalgebra::{Cholesky, DMatrix, SymmetricEigen};
use num_complex::Complex64;

use crate::model::spectrum::eigenvalues;

/// How the eigenvalues are computed, in a manifest.
pub const METHOD: &str = "QR algorithm, linearised where something damps";

/// Turns for each frequency without friction; it takes two or three.
const TURNS: usize = 60;

/// The matrices of a structure, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// K, M and C without friction, symmetric.
    pub symmetric: [DMatrix<f64>; 3],
    /// `K_f`, `M_f` and `C_f`: what one unit of friction adds.
    pub friction: [DMatrix<f64>; 3],
    /// D: what a slope of 1 s/m adds to C under the load.
    pub slope: DMatrix<f64>,
}

/// A structure by some of its modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Modal {
    /// The file as written in the sweep file.
    pub name: String,
    /// What stands in the file.
    pub text: String,
    /// First and last coefficient of friction for which its vectors were chosen.
    pub mu: [f64; 2],
    /// F0, N.
    pub load: f64,
    wedge: f64,
    /// So many modes of the lowest frequencies are the structure's; those above are what the vectors make of others.
    modes: usize,
    /// With s^-1 replaced by the highest frequency, so that numbers are about 1.
    scaled: Matrices,
    /// 2 Ω in that unit.
    ratio: DMatrix<f64>,
    /// The unit of λ, 1/s.
    unit: f64,
}

impl Modal {
    /// A structure; `name` and `text` are those of its file.
    ///
    /// # Errors
    /// When the mass matrix is not positive definite, or the modes without friction are beyond numbers; as the end of a
    /// sentence.
    pub fn new(
        [name, text]: [String; 2],
        matrices: &Matrices,
        mu: [f64; 2],
        [load, wedge]: [f64; 2],
        modes: usize,
    ) -> Result<Modal, String> {
        let [stiffness, mass, _] = &matrices.symmetric;
        let wrong =
            || "its mass matrix is not positive definite: every motion has to move some mass".to_owned();
        let factor = Cholesky::new(mass.clone()).ok_or_else(wrong)?.unpack();
        let beyond = || "its modes without friction are beyond the range of numbers".to_owned();
        // L⁻¹ K L⁻ᵀ has the squares of the frequencies.
        let half = factor.solve_lower_triangular(stiffness).ok_or_else(beyond)?;
        let squares = factor.solve_lower_triangular(&half.transpose()).ok_or_else(beyond)?;
        let eigen =
            SymmetricEigen::try_new(squares, f64::EPSILON, TURNS * mass.nrows()).ok_or_else(beyond)?;
        let highest = eigen.eigenvalues.iter().fold(0.0_f64, |most, square| most.max(square.abs()));
        let unit = if highest > 0.0 { highest.sqrt() } else { 1.0 };
        let frequencies = eigen.eigenvalues.map(|square| 2.0 * square.max(0.0).sqrt() / unit);
        // Ω = L⁻ᵀ Y ω Yᵀ Lᵀ.
        let within = &eigen.eigenvectors
            * DMatrix::from_diagonal(&frequencies)
            * eigen.eigenvectors.transpose()
            * factor.transpose();
        let ratio = factor.transpose().solve_upper_triangular(&within).ok_or_else(beyond)?;
        let per = [1.0 / (unit * unit), 1.0, 1.0 / unit];
        let scale = |all: &[DMatrix<f64>; 3]| [0, 1, 2].map(|i: usize| &all[i] * per[i]);
        let scaled = Matrices {
            symmetric: scale(&matrices.symmetric),
            friction: scale(&matrices.friction),
            slope: &matrices.slope / unit,
        };
        let is_finite = scaled.symmetric.iter().chain(&scaled.friction).chain([&scaled.slope, &ratio]);
        if !is_finite.flatten().all(|entry| entry.is_finite()) {
            return Err(beyond());
        }
        Ok(Modal { name, text, mu, load, wedge, modes, scaled, ratio, unit })
    }

    /// How many vectors there are.
    #[must_use]
    pub fn size(&self) -> usize {
        self.ratio.nrows()
    }

    /// How many of the lowest modes count.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.modes.min(self.size())
    }

    /// The eigenvalues (1/s) of the modes that count, with friction `mu`, the part `slope` of D and damping ratios `ratio`;
    /// `None` beyond the range of numbers.
    #[must_use]
    pub fn eigenvalues(&self, mu: f64, slope: f64, ratio: f64) -> Option<Vec<Complex64>> {
        let Matrices { symmetric, friction, slope: per_slope } = &self.scaled;
        let sum = |i: usize| &symmetric[i] + &friction[i] * mu;
        let lu = sum(1).lu();
        let stiffness = lu.solve(&sum(0))?;
        let damping = lu.solve(&(sum(2) + per_slope * slope))? + &self.ratio * ratio;
        let mut all = if damping.iter().all(|entry| *entry == 0.0) {
            // λ² = −θ: what does not grow, does not grow to the last bit.
            eigenvalues(stiffness)?.iter().flat_map(|theta| [-(-theta).sqrt(), (-theta).sqrt()]).collect()
        } else {
            let n = self.size();
            let mut companion = DMatrix::zeros(2 * n, 2 * n);
            companion.view_mut((0, n), (n, n)).fill_with_identity();
            companion.view_mut((n, 0), (n, n)).copy_from(&-stiffness);
            companion.view_mut((n, n), (n, n)).copy_from(&-damping);
            eigenvalues(companion)?
        };
        all.sort_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        all.truncate(2 * self.modes());
        let all: Vec<Complex64> = all.into_iter().map(|z| z * self.unit).collect();
        all.iter().all(|z| z.is_finite()).then_some(all)
    }

    /// The part of D under a load (N) at a coefficient of friction, for a slope of 1 s/m; `None` where the contact cannot
    /// slide steadily, since friction presses it ever harder.
    #[must_use]
    pub fn pressed(&self, load: f64, mu: f64) -> Option<f64> {
        let reach = 1.0 + self.wedge * mu;
        (reach > 0.0).then(|| load / self.load / reach)
    }
}
