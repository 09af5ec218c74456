//! The lowest real modes by shift-invert block Lanczos.

use super::columns::times;
use faer::Mat;

use super::columns::append;
use super::dense::symmetric;
use super::{Factor, Ordering};
use crate::Error;
use crate::assembly::Pencil;

/// Real modes of the symmetric problem K φ = ω² M φ.
#[derive(Debug)]
pub struct RealModes {
    /// ω², rising, 1/s².
    pub omega2: Vec<f64>,
    /// Shapes as columns, φᵀ M φ = 1.
    pub shapes: Mat<f64>,
    /// ‖(K − σ M)⁻¹ (K − ω² M) φ‖_M of each mode over ω² − σ: the relative error of ω² is its square at most.
    pub residual: Vec<f64>,
}

impl RealModes {
    /// Frequencies, Hz.
    #[must_use]
    pub fn frequencies(&self) -> Vec<f64> {
        self.omega2.iter().map(|w| w.max(0.0).sqrt() / std::f64::consts::TAU).collect()
    }
}

/// Vectors that are multiplied at once. Symmetric bodies have modes of the same frequency, of which a single vector sees one.
const BLOCK: usize = 4;

/// The `count` lowest modes, by Lanczos vectors kept orthogonal to all before.
///
/// # Errors
/// Where they do not converge, or their residuals are too large.
pub fn lowest(pencil: &Pencil, factor: &Factor, count: usize) -> Result<RealModes, Error> {
    /// The residual to which Ritz values are followed.
    const CONVERGED: f64 = 1e-9;
    /// The part of the vectors that is added before Ritz values are looked at again.
    const PART: usize = 16;
    let size = pencil.size();
    if count == 0 || count > size {
        let what =
            format!("{count} modes are asked for, but the model has {size} unknowns: ask for 1 to {size}");
        return Err(Error::Solver { what });
    }
    let most = size.min(20 * count + 100);
    let mut basis = Mat::<f64>::zeros(size, 0);
    let mut block = start(size);
    append(&mut basis, &pencil.mass, &block);
    // T = Vᵀ M (K − σ M)⁻¹ M V, column by column.
    let mut projected: Vec<Vec<f64>> = Vec::new();
    // Of many vectors the eigenvalues of T cost more than a few vectors too many.
    let mut next = count + BLOCK;
    loop {
        let from = projected.len();
        let width = basis.ncols() - from;
        block = times(&pencil.mass, &basis.subcols(from, width).to_owned());
        factor.solve(block.as_mut());
        let images = times(&pencil.mass, &block);
        let known = basis.transpose() * &images;
        for j in 0..width {
            projected.push((0..basis.ncols()).map(|i| known[(i, j)]).collect());
        }
        let done = projected.len();
        if done < most {
            append(&mut basis, &pencil.mass, &block);
        }
        // Nothing is left to add, or no more is allowed: the residuals decide.
        let exhausted = basis.ncols() == done;
        if !(done >= next || exhausted) {
            continue;
        }
        next = done + done / PART;
        let t = Mat::from_fn(done, done, |i, j| projected[i.max(j)][i.min(j)]);
        let (values, vectors) = symmetric(&t)?;
        // The part of the image of a Ritz vector that leaves the space.
        let new = basis.subcols(done, basis.ncols() - done);
        let leaves = new.transpose() * &images;
        let mut order: Vec<usize> = (0..done).collect();
        // 1/(ω² − σ) from the largest on is ω² from the lowest on.
        order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
        order.truncate(count);
        let converged = order.iter().all(|k| {
            let tail = vectors.get(from..done, *k).to_owned();
            (&leaves * tail).norm_l2() <= CONVERGED * values[*k].abs()
        });
        if (converged && order.len() == count) || exhausted {
            let chosen = Mat::from_fn(done, order.len(), |i, j| vectors[(i, order[j])]);
            let shapes = basis.subcols(0, done) * chosen;
            let omega2 = order.iter().map(|k| factor.shift + 1.0 / values[*k]).collect();
            return checked(pencil, factor, omega2, shapes, count);
        }
    }
}

/// Residuals of the full problem, none of which may be large.
fn checked(
    pencil: &Pencil,
    factor: &Factor,
    omega2: Vec<f64>,
    shapes: Mat<f64>,
    count: usize,
) -> Result<RealModes, Error> {
    /// A larger residual is not a mode: frequencies would be wrong by more than 1e-12.
    const LARGEST: f64 = 1e-6;
    let mut defect = times(&pencil.stiffness, &shapes);
    let images = times(&pencil.mass, &shapes);
    for j in 0..shapes.ncols() {
        for i in 0..shapes.nrows() {
            defect[(i, j)] -= omega2[j] * images[(i, j)];
        }
    }
    factor.solve(defect.as_mut());
    let images = times(&pencil.mass, &defect);
    let residual: Vec<f64> =
        (0..shapes.ncols()).map(|j| (defect.col(j).transpose() * images.col(j)).max(0.0).sqrt()).collect();
    if residual.len() < count || residual.iter().any(|r| !(*r <= LARGEST)) {
        let worst = residual.iter().copied().fold(0.0, f64::max);
        let what = format!(
            "{} of {count} real modes were found, with a residual of up to {worst:.1e} (limit {LARGEST:e}): check the units of \
             the mesh and the materials",
            residual.len()
        );
        return Err(Error::Solver { what });
    }
    Ok(RealModes { omega2, shapes, residual })
}

/// How many modes lie below a frequency (Hz), by Sylvester's law of inertia: whether Lanczos has missed one.
///
/// # Errors
/// Where the frequency is that of a mode.
pub fn count_below(pencil: &Pencil, ordering: &Ordering, frequency: f64) -> Result<usize, Error> {
    let omega = std::f64::consts::TAU * frequency;
    Ok(Factor::new(ordering, &pencil.stiffness, &pencil.mass, omega * omega)?.below)
}

/// Vectors that no symmetry makes orthogonal to a mode: a fixed sequence of pseudo-random numbers (splitmix64), so that every run is
/// the same.
fn start(size: usize) -> Mat<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    Mat::from_fn(size, BLOCK.min(size), |_, _| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    })
}
