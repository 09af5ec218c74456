//! The matrices of the quadratic eigenvalue problem with friction.

use super::{Rows, Symmetric};

/// The damping of one real mode φ: f (M φ)(M φ)ᵀ.
#[derive(Debug, Clone)]
pub struct Modal {
    /// f = 2 ζ ω, 1/s.
    pub factor: f64,
    /// M φ.
    pub image: Vec<f64>,
    /// M_n φ.
    pub normal: Vec<f64>,
}

/// P(λ, μ) = λ² (M + μ Sᵀ M_n) + λ (C + μ Sᵀ C_n + Sᵀ D S) + (K + μ Sᵀ K_n).
///
/// K, M, C are symmetric: the bodies with tied normal displacements. A row of S is the slip of a contact point as a function of
/// the unknowns; a row of K_n, M_n, C_n is the normal force there (`docs/fem.md`).
#[derive(Debug, Clone)]
pub struct Pencil {
    /// K, N/m.
    pub stiffness: Symmetric,
    /// M, kg.
    pub mass: Symmetric,
    /// C of the materials, N s/m; `None` where they do not damp.
    pub damping: Option<Symmetric>,
    /// What is damped mode by mode, a part of C.
    pub modal: Vec<Modal>,
    /// S.
    pub slip: Rows,
    /// K_n.
    pub normal_stiffness: Rows,
    /// M_n.
    pub normal_mass: Rows,
    /// C_n; rows without entries where nothing damps.
    pub normal_damping: Rows,
}

impl Pencil {
    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.stiffness.pattern.size()
    }

    /// Whether materials or modes damp.
    #[must_use]
    pub fn is_damped(&self) -> bool {
        self.damping.is_some() || !self.modal.is_empty()
    }

    /// (K + μ Sᵀ K_n) x.
    #[must_use]
    pub fn stiffness_times(&self, mu: f64, x: &[f64]) -> Vec<f64> {
        self.with_friction(&self.stiffness, &self.normal_stiffness, mu, x)
    }

    /// (M + μ Sᵀ M_n) x.
    #[must_use]
    pub fn mass_times(&self, mu: f64, x: &[f64]) -> Vec<f64> {
        self.with_friction(&self.mass, &self.normal_mass, mu, x)
    }

    /// (C + μ Sᵀ C_n + Sᵀ D S) x, with the damping D = `slope` (N s/m) between contact points; no rows where friction has no slope.
    #[must_use]
    pub fn damping_times(&self, mu: f64, slope: &Rows, x: &[f64]) -> Vec<f64> {
        let mut y = match &self.damping {
            Some(damping) => self.with_friction(damping, &self.normal_damping, mu, x),
            None => vec![0.0; x.len()],
        };
        for modal in &self.modal {
            let part = modal.factor * modal.image.iter().zip(x).map(|(m, x)| m * x).sum::<f64>();
            y.iter_mut().zip(&modal.image).for_each(|(y, m)| *y += part * m);
            let force: Vec<f64> = modal.normal.iter().map(|n| mu * part * n).collect();
            self.slip.add_transposed(&force, &mut y);
        }
        if !slope.rows.is_empty() {
            let force = slope.times(&self.slip.times(x));
            self.slip.add_transposed(&force, &mut y);
        }
        y
    }

    fn with_friction(&self, matrix: &Symmetric, normal: &Rows, mu: f64, x: &[f64]) -> Vec<f64> {
        let mut y = matrix.times(x);
        if mu != 0.0 {
            let force: Vec<f64> = normal.times(x).iter().map(|n| mu * n).collect();
            self.slip.add_transposed(&force, &mut y);
        }
        y
    }
}
