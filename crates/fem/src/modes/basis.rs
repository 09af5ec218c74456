//! The projected problem: the pencil on the space that some vectors span.

use faer::Mat;

use super::real::{column, times};
use crate::assembly::{Pencil, Rows, Symmetric};

/// Vectors that are orthonormal in M, and the pencil on their space.
#[derive(Debug)]
pub struct Basis {
    /// V as columns.
    pub vectors: Mat<f64>,
    /// Vᵀ K V, Vᵀ M V and Vᵀ C V, without friction.
    symmetric: [Mat<f64>; 3],
    /// (S V)ᵀ (K_n V) and so on: what one unit of μ adds.
    friction: [Mat<f64>; 3],
    /// S V: the slip of each contact point.
    slip: Mat<f64>,
}

/// A small dense problem λ² M + λ C + K.
#[derive(Debug, Clone)]
pub struct Small {
    /// K.
    pub stiffness: Mat<f64>,
    /// M.
    pub mass: Mat<f64>,
    /// C; `None` where nothing damps.
    pub damping: Option<Mat<f64>>,
}

impl Basis {
    /// The space of these vectors; those that depend on others are dropped.
    #[must_use]
    pub fn new(pencil: &Pencil, vectors: &Mat<f64>) -> Self {
        let mut basis = Mat::zeros(pencil.size(), 0);
        append(&mut basis, &pencil.mass, vectors);
        Self::project(pencil, basis)
    }

    /// The space with more vectors. Gives how many were new.
    pub fn extend(&mut self, pencil: &Pencil, vectors: &Mat<f64>) -> usize {
        let mut basis = std::mem::replace(&mut self.vectors, Mat::zeros(0, 0));
        let before = basis.ncols();
        append(&mut basis, &pencil.mass, vectors);
        *self = Self::project(pencil, basis);
        self.vectors.ncols() - before
    }

    fn project(pencil: &Pencil, vectors: Mat<f64>) -> Self {
        let on = |matrix: &Symmetric| {
            let projected = vectors.transpose() * times(matrix, &vectors);
            // Symmetric to the last bit: at μ = 0 every eigenvalue is real.
            Mat::from_fn(projected.nrows(), projected.ncols(), |i, j| {
                f64::midpoint(projected[(i, j)], projected[(j, i)])
            })
        };
        let empty = || Mat::zeros(vectors.ncols(), vectors.ncols());
        let damping = pencil.damping.as_ref().map_or_else(empty, on);
        let slip = rows_times(&pencil.slip, &vectors);
        let normal = |rows: &Rows| slip.transpose() * rows_times(rows, &vectors);
        let friction =
            [normal(&pencil.normal_stiffness), normal(&pencil.normal_mass), normal(&pencil.normal_damping)];
        Self { symmetric: [on(&pencil.stiffness), on(&pencil.mass), damping], friction, slip, vectors }
    }

    /// The projected problem at a coefficient of friction. `slope` is the damping (N s/m) between contact points, without rows
    /// where friction has no slope.
    #[must_use]
    pub fn at(&self, mu: f64, slope: &Rows) -> Small {
        let sum = |i: usize| {
            let mut sum = self.symmetric[i].clone();
            for column in 0..sum.ncols() {
                for row in 0..sum.nrows() {
                    sum[(row, column)] += mu * self.friction[i][(row, column)];
                }
            }
            sum
        };
        let mut damping = sum(2);
        if !slope.rows.is_empty() {
            damping += self.slip.transpose() * rows_times(slope, &self.slip);
        }
        let damped = damping.norm_max() > 0.0;
        Small { stiffness: sum(0), mass: sum(1), damping: damped.then_some(damping) }
    }

    /// What one unit of μ adds to stiffness and mass.
    #[must_use]
    pub fn per_friction(&self) -> (&Mat<f64>, &Mat<f64>) {
        (&self.friction[0], &self.friction[1])
    }
}

fn rows_times(rows: &Rows, vectors: &Mat<f64>) -> Mat<f64> {
    let mut images = Mat::zeros(rows.rows.len(), vectors.ncols());
    for j in 0..vectors.ncols() {
        for (i, value) in rows.times(&column(vectors, j)).into_iter().enumerate() {
            images[(i, j)] = value;
        }
    }
    images
}

/// Appends vectors to an M-orthonormal basis, by Gram and Schmidt, twice.
pub(super) fn append(basis: &mut Mat<f64>, mass: &Symmetric, vectors: &Mat<f64>) {
    /// What is left of a vector of the space after rounding.
    const DEPENDENT: f64 = 1e-10;
    let size = vectors.nrows();
    for j in 0..vectors.ncols() {
        let mut v = column(vectors, j);
        let before = norm(mass, &v);
        if !(before > 0.0) || basis.ncols() >= size {
            continue;
        }
        // The second time takes away what rounding has left the first time.
        for _ in 0..2 {
            let image = faer::Col::from_iter(mass.times(&v));
            let known = &*basis * (basis.transpose() * image);
            v.iter_mut().zip(known.iter()).for_each(|(v, k)| *v -= k);
        }
        let after = norm(mass, &v);
        if after > DEPENDENT * before {
            let from = basis.ncols();
            basis.resize_with(size, from + 1, |i, _| v[i] / after);
        }
    }
}

fn norm(mass: &Symmetric, v: &[f64]) -> f64 {
    mass.times(v).iter().zip(v).map(|(a, b)| a * b).sum::<f64>().max(0.0).sqrt()
}
