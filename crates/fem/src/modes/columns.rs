//! Columns of matrices.

use faer::Mat;

use crate::assembly::Symmetric;

/// A column as a vector.
pub(super) fn column(matrix: &Mat<f64>, j: usize) -> Vec<f64> {
    matrix.col(j).iter().copied().collect()
}

/// A X for a sparse A, several columns at a time: the entries of A come from memory once for all of them.
pub(super) fn times(matrix: &Symmetric, columns: &Mat<f64>) -> Mat<f64> {
    /// Columns at a time.
    const WIDTH: usize = 8;
    let mut images = Mat::zeros(columns.nrows(), columns.ncols());
    for from in (0..columns.ncols()).step_by(WIDTH) {
        let width = WIDTH.min(columns.ncols() - from);
        let mut x = vec![[0.0; WIDTH]; columns.nrows()];
        for j in 0..width {
            x.iter_mut().zip(columns.col(from + j).iter()).for_each(|(x, c)| x[j] = *c);
        }
        let y = matrix.times_rows(&x);
        for j in 0..width {
            images.col_mut(from + j).iter_mut().zip(&y).for_each(|(image, y)| *image = y[j]);
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
        let mut lengths = Vec::with_capacity(3);
        // The second time takes away what rounding has left the first time.
        for _ in 0..2 {
            let image = faer::Col::from_iter(mass.times(&v));
            let squared: f64 = image.iter().zip(&v).map(|(a, b)| a * b).sum();
            let inside = basis.transpose() * &image;
            let known = &*basis * &inside;
            v.iter_mut().zip(known.iter()).for_each(|(v, k)| *v -= k);
            lengths.push(squared.max(0.0).sqrt());
            // By Pythagoras.
            lengths.push((squared - inside.squared_norm_l2()).max(0.0).sqrt());
        }
        let (before, after) = (lengths[0], lengths[3]);
        if after > DEPENDENT * before && basis.ncols() < size {
            let from = basis.ncols();
            basis.resize_with(size, from + 1, |i, _| v[i] / after);
        }
    }
}
