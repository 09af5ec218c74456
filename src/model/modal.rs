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
//! forces. Where the file knows what the contact stiffness k (`kn`) changes, K is that of the file's `k0` with `(k − k0) K_c` added, and `K_f`
//! is multiplied by `k/k0`. ζ (`damping_ratio`) damps the modes without friction, Ω = Σ ω φ (M φ)ᵀ; a mode may have more of it
//! (`damping_ratio_1` and so on). Attribution is that of [`crate::model::linear`]: without the slope, and without the feedback of the
//! normal force (μ = 0 in the matrices).

use nalgebra::{Cholesky, DMatrix};
use num_complex::Complex64;

use crate::model::counted::counted;
use crate::model::natural::Natural;
use crate::model::spectrum::eigenvalues;

/// How the eigenvalues are computed, in a manifest.
pub const METHOD: &str = "QR algorithm, linearised where something damps";

/// So many of the lowest modes may have a damping ratio each.
pub const EACH: usize = 8;

/// The matrices of a structure, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// K, M and C without friction, symmetric.
    pub symmetric: [DMatrix<f64>; 3],
    /// `K_f`, `M_f` and `C_f`: what one unit of friction adds.
    pub friction: [DMatrix<f64>; 3],
    /// D: what a slope of 1 s/m adds to C under the load.
    pub slope: DMatrix<f64>,
    /// `K_c`: what 1 Pa/m of contact stiffness adds to K; zero where the file has none.
    pub contact: DMatrix<f64>,
}

/// The contact stiffness of a file, Pa/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// That of K and `K_f`.
    pub stiffness: f64,
    /// The least and the largest for which the vectors were chosen.
    pub range: [f64; 2],
}

/// What the matrices are asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// The coefficient of friction in the matrices.
    pub mu: f64,
    /// The part of D.
    pub slope: f64,
    /// Damping ratio of every mode without friction.
    pub ratio: f64,
    /// What the lowest modes have of it in addition.
    pub each: [f64; EACH],
    /// Contact stiffness, Pa/m; `None` for that of the file.
    pub kn: Option<f64>,
}

impl At {
    /// The same with other friction.
    #[must_use]
    pub fn with(mut self, mu: f64, slope: f64) -> At {
        (self.mu, self.slope) = (mu, slope);
        self
    }
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
    /// Its contact stiffness, where that may vary.
    pub contact: Option<Contact>,
    wedge: f64,
    /// So many modes of the lowest frequencies are the structure's; those above are what the vectors make of others.
    modes: usize,
    /// With s^-1 replaced by the highest frequency, so that numbers are about 1.
    scaled: Matrices,
    /// The modes without friction in that unit, with the contact stiffness of the file.
    natural: Natural,
    /// 2 Ω of them.
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
        contact: Option<Contact>,
        modes: usize,
    ) -> Result<Modal, String> {
        let [stiffness, mass, _] = &matrices.symmetric;
        let wrong =
            || "its mass matrix is not positive definite: every motion has to move some mass".to_owned();
        Cholesky::new(mass.clone()).ok_or_else(wrong)?;
        let beyond = || "its modes without friction are beyond the range of numbers".to_owned();
        let natural = Natural::new(stiffness, mass).ok_or_else(beyond)?;
        let unit = if natural.highest() > 0.0 { natural.highest() } else { 1.0 };
        let natural = natural.per(unit);
        let ratio = natural.damping(|_| 1.0).ok_or_else(beyond)?;
        let per = [1.0 / (unit * unit), 1.0, 1.0 / unit];
        let scale = |all: &[DMatrix<f64>; 3]| [0, 1, 2].map(|i: usize| &all[i] * per[i]);
        let scaled = Matrices {
            symmetric: scale(&matrices.symmetric),
            friction: scale(&matrices.friction),
            slope: &matrices.slope / unit,
            contact: &matrices.contact * per[0],
        };
        let is_finite =
            scaled.symmetric.iter().chain(&scaled.friction).chain([&scaled.slope, &scaled.contact, &ratio]);
        if !is_finite.flatten().all(|entry| entry.is_finite()) {
            return Err(beyond());
        }
        Ok(Modal { name, text, mu, load, contact, wedge, modes, scaled, natural, ratio, unit })
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

    /// The eigenvalues (1/s) of the modes that count; `None` beyond the range of numbers.
    #[must_use]
    pub fn eigenvalues(&self, at: At) -> Option<Vec<Complex64>> {
        let Matrices { symmetric, friction, slope: per_slope, contact } = &self.scaled;
        let sum = |i: usize| &symmetric[i] + &friction[i] * at.mu;
        let other = at.kn.zip(self.contact).filter(|(kn, file)| kn.to_bits() != file.stiffness.to_bits());
        let lu = sum(1).lu();
        let ratio_of = |k: usize| at.ratio + at.each.get(k).copied().unwrap_or(0.0);
        let alike = at.each.iter().all(|more| *more == 0.0);
        let (stiffness, ratios) = match other {
            None if alike => (sum(0), &self.ratio * at.ratio),
            None => (sum(0), self.natural.damping(ratio_of)?),
            Some((kn, file)) => {
                let plain = &symmetric[0] + contact * (kn - file.stiffness);
                let ratios = if alike && at.ratio == 0.0 {
                    DMatrix::zeros(self.size(), self.size())
                } else {
                    Natural::new(&plain, &symmetric[1])?.damping(ratio_of)?
                };
                (plain + &friction[0] * (at.mu * kn / file.stiffness), ratios)
            }
        };
        let viscous = sum(2) + per_slope * at.slope;
        let [stiffness_per, damping_per] = [lu.solve(&stiffness)?, lu.solve(&viscous)? + &ratios];
        let all = if damping_per.iter().all(|entry| *entry == 0.0) {
            // λ² = −θ: what does not grow, does not grow to the last bit.
            let squares = eigenvalues(stiffness_per)?;
            let mut all: Vec<Complex64> =
                squares.iter().flat_map(|theta| [-(-theta).sqrt(), (-theta).sqrt()]).collect();
            all.sort_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
            all.truncate(2 * self.modes());
            all
        } else {
            let n = self.size();
            let mut companion = DMatrix::zeros(2 * n, 2 * n);
            companion.view_mut((0, n), (n, n)).fill_with_identity();
            companion.view_mut((n, 0), (n, n)).copy_from(&-stiffness_per);
            companion.view_mut((n, n), (n, n)).copy_from(&-damping_per);
            let mass = sum(1);
            let damping = viscous + &mass * ratios;
            counted(eigenvalues(companion)?, [&stiffness, &mass, &damping], self.modes())
        };
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
