//! The projected problem: the pencil on the space that some vectors span.

use super::Small;
use super::columns::append;
use faer::Mat;

use super::columns::{column, times};
use super::modal::{add, damping_columns};
use crate::assembly::{Pencil, Rows};

/// Vectors that are orthonormal in M, and the pencil on their space.
#[derive(Debug, Clone)]
pub struct Basis {
    /// V as columns.
    pub vectors: Mat<f64>,
    /// Vᵀ K V, Vᵀ M V and Vᵀ C V, without friction.
    symmetric: [Mat<f64>; 3],
    /// S V: the slip of each contact point.
    slip: Mat<f64>,
    /// K_n V, M_n V and C_n V: the normal force at each contact point.
    normal: [Mat<f64>; 3],
    /// (S V)ᵀ (K_n V) and so on: what one unit of μ adds.
    friction: [Mat<f64>; 3],
}

impl Basis {
    /// The space of these vectors; those that depend on others are dropped.
    #[must_use]
    pub fn new(pencil: &Pencil, vectors: &Mat<f64>) -> Self {
        let empty = || Mat::zeros(0, 0);
        let rows = || Mat::zeros(pencil.slip.rows.len(), 0);
        let mut basis = Self {
            vectors: Mat::zeros(pencil.size(), 0),
            symmetric: [empty(), empty(), empty()],
            slip: rows(),
            normal: [rows(), rows(), rows()],
            friction: [empty(), empty(), empty()],
        };
        basis.extend(pencil, vectors);
        basis
    }

    /// The space with more vectors. Gives how many were new.
    pub fn extend(&mut self, pencil: &Pencil, vectors: &Mat<f64>) -> usize {
        let before = self.vectors.ncols();
        append(&mut self.vectors, &pencil.mass, vectors);
        let new = self.vectors.subcols(before, self.vectors.ncols() - before).to_owned();
        let images = [
            Some(times(&pencil.stiffness, &new)),
            Some(times(&pencil.mass, &new)),
            damping_columns(pencil, &new),
        ];
        for (projected, image) in self.symmetric.iter_mut().zip(images) {
            let Some(image) = image else {
                *projected = Mat::zeros(self.vectors.ncols(), self.vectors.ncols());
                continue;
            };
            let columns = self.vectors.transpose() * image;
            *projected = Mat::from_fn(self.vectors.ncols(), self.vectors.ncols(), |i, j| {
                match (i.checked_sub(before), j.checked_sub(before)) {
                    (None, None) => projected[(i, j)],
                    (None, Some(j)) => columns[(i, j)],
                    (Some(i), None) => columns[(j, i)],
                    // Symmetric to the last bit: at μ = 0 every eigenvalue is real.
                    (Some(k), Some(l)) => f64::midpoint(columns[(i, l)], columns[(j, k)]),
                }
            });
        }
        widen(&mut self.slip, &rows_times(&pencil.slip, &new));
        let [stiffness, mass, mut damping] =
            [&pencil.normal_stiffness, &pencil.normal_mass, &pencil.normal_damping]
                .map(|rows| rows_times(rows, &new));
        add(&mut damping, pencil, &new, |modal| &modal.normal);
        for (normal, columns) in self.normal.iter_mut().zip([stiffness, mass, damping]) {
            widen(normal, &columns);
        }
        self.friction = [0, 1, 2].map(|i| self.slip.transpose() * &self.normal[i]);
        new.ncols()
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
            damping += self.slip.transpose() * self.damped(slope);
        }
        let damped = damping.norm_max() > 0.0;
        Small { stiffness: sum(0), mass: sum(1), damping: damped.then_some(damping) }
    }

    /// The problem on a space within this one, by coordinates as columns: K, M, C; what one unit of μ adds to each; what the damping
    /// `slope` (N s/m) between contact points adds to C.
    pub(crate) fn within(
        &self,
        coordinates: &Mat<f64>,
        slope: &Rows,
    ) -> ([Mat<f64>; 3], [Mat<f64>; 3], Mat<f64>) {
        let project = |matrix: &Mat<f64>| coordinates.transpose() * matrix * coordinates;
        // Symmetric to the last bit.
        let both = |matrix: Mat<f64>| {
            Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| f64::midpoint(matrix[(i, j)], matrix[(j, i)]))
        };
        let symmetric = [0, 1, 2].map(|i| both(project(&self.symmetric[i])));
        let friction = [0, 1, 2].map(|i| project(&self.friction[i]));
        let damping = if slope.rows.is_empty() {
            Mat::zeros(coordinates.ncols(), coordinates.ncols())
        } else {
            project(&(self.slip.transpose() * rows_times(slope, &self.slip)))
        };
        (symmetric, friction, damping)
    }

    /// Vᵀ K V of any vectors.
    pub(crate) fn projected_stiffness(pencil: &Pencil, vectors: &Mat<f64>) -> Mat<f64> {
        vectors.transpose() * times(&pencil.stiffness, vectors)
    }

    /// What one unit of μ adds to stiffness and mass.
    #[must_use]
    pub fn per_friction(&self) -> (&Mat<f64>, &Mat<f64>) {
        (&self.friction[0], &self.friction[1])
    }

    /// Vᵀ (K − σ M) V.
    pub(super) fn energy(&self, shift: f64) -> Mat<f64> {
        let [stiffness, mass, _] = &self.symmetric;
        Mat::from_fn(mass.nrows(), mass.ncols(), |i, j| stiffness[(i, j)] - shift * mass[(i, j)])
    }

    /// K_n V, M_n V and C_n V.
    pub(super) fn normal(&self) -> &[Mat<f64>; 3] {
        &self.normal
    }

    /// D S V.
    pub(super) fn damped(&self, slope: &Rows) -> Mat<f64> {
        rows_times(slope, &self.slip)
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

/// Puts columns beside those of a matrix.
fn widen(matrix: &mut Mat<f64>, columns: &Mat<f64>) {
    let before = matrix.ncols();
    matrix.resize_with(columns.nrows(), before + columns.ncols(), |i, j| columns[(i, j - before)]);
}
