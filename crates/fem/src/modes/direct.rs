//! Complex modes of the full undamped problem near a frequency: shift-invert Arnoldi, friction as a correction of low rank.
//!
//! With A = K − σ M factorised, N = K_n − σ M_n and W = A⁻¹ Sᵀ, Woodbury's identity gives
//! (A + μ Sᵀ N)⁻¹ b = y − μ W (1 + μ N W)⁻¹ N y with y = A⁻¹ b.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};

use super::Factor;
use super::columns::column;
use crate::Error;
use crate::assembly::Pencil;

/// A complex mode of the full problem.
#[derive(Debug, Clone)]
pub struct Near {
    /// λ, 1/s, with a frequency that is not negative.
    pub lambda: c64,
    /// ‖(K(μ) − σ M(μ))⁻¹ (K(μ) + λ² M(μ)) x‖ over |−λ² − σ|, as the iteration knows it.
    pub residual: f64,
    /// Real and imaginary part of x.
    pub shape: [Vec<f64>; 2],
}

/// An operator (K(μ) − σ M(μ))⁻¹.
struct Inverse<'a> {
    pencil: &'a Pencil,
    factor: &'a Factor,
    mu: f64,
    /// W = A⁻¹ Sᵀ.
    responses: Mat<f64>,
    /// 1 + μ N W.
    small: PartialPivLu<f64>,
}

impl<'a> Inverse<'a> {
    fn new(pencil: &'a Pencil, factor: &'a Factor, mu: f64) -> Self {
        let points = pencil.slip.rows.len();
        let mut responses = Mat::zeros(pencil.size(), points);
        for (j, row) in pencil.slip.rows.iter().enumerate() {
            for (i, v) in row {
                responses[(*i, j)] = *v;
            }
        }
        factor.solve(responses.as_mut());
        let mut small = Mat::<f64>::identity(points, points);
        for j in 0..points {
            for (i, force) in normal(pencil, factor.shift, &column(&responses, j)).into_iter().enumerate() {
                small[(i, j)] += mu * force;
            }
        }
        Self { pencil, factor, mu, responses, small: small.partial_piv_lu() }
    }

    fn apply(&self, b: &[f64]) -> Vec<f64> {
        let mut y = Mat::from_fn(b.len(), 1, |i, _| b[i]);
        self.factor.solve(y.as_mut());
        let force = normal(self.pencil, self.factor.shift, &column(&y, 0));
        let force = Mat::from_fn(force.len(), 1, |i, _| self.mu * force[i]);
        y -= &self.responses * self.small.solve(&force);
        column(&y, 0)
    }
}

/// N x = (K_n − σ M_n) x.
fn normal(pencil: &Pencil, shift: f64, x: &[f64]) -> Vec<f64> {
    let (k, m) = (pencil.normal_stiffness.times(x), pencil.normal_mass.times(x));
    k.iter().zip(m).map(|(k, m)| k - shift * m).collect()
}

/// The modes of the full undamped problem whose −λ² are nearest to the factor's shift, nearest first.
///
/// # Errors
/// Where fewer than `count` converge to a residual of `bound`.
pub fn near(pencil: &Pencil, factor: &Factor, mu: f64, count: usize, bound: f64) -> Result<Vec<Near>, Error> {
    let size = pencil.size();
    let most = size.min(8 * count + 200);
    let inverse = Inverse::new(pencil, factor, mu);
    let mut vectors: Vec<Vec<f64>> = vec![first(size)];
    let mut hessenberg: Vec<Vec<f64>> = Vec::new();
    loop {
        let step = hessenberg.len();
        let mut w = inverse.apply(&pencil.mass_times(mu, &vectors[step]));
        let mut row = vec![0.0; step + 1];
        for _ in 0..2 {
            for (h, v) in row.iter_mut().zip(&vectors) {
                let part = dot(v, &w);
                *h += part;
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= part * v);
            }
        }
        let next = dot(&w, &w).sqrt();
        row.push(next);
        hessenberg.push(row);
        let done = hessenberg.len();
        let last = done == most || next == 0.0;
        if last || (done > 2 * count && done.is_multiple_of(10)) {
            let h = Mat::from_fn(done, done, |i, j| hessenberg[j].get(i).copied().unwrap_or(0.0));
            let failed =
                |_| Error::Solver { what: format!("the {done} Ritz values near the shift did not converge") };
            let eigen = h.eigen().map_err(failed)?;
            let mut order: Vec<usize> = (0..done).filter(|k| eigen.S()[*k].norm() > 0.0).collect();
            order.sort_by(|a, b| eigen.S()[*b].norm().total_cmp(&eigen.S()[*a].norm()));
            order.truncate(count);
            let residual = |k: usize| {
                let length = (0..done).map(|i| eigen.U()[(i, k)].norm_sqr()).sum::<f64>().sqrt();
                next * eigen.U()[(done - 1, k)].norm() / length / eigen.S()[k].norm()
            };
            let worst = order.iter().map(|k| residual(*k)).fold(0.0, f64::max);
            if order.len() == count && worst <= bound {
                let mode = |k: &usize| {
                    let root = (factor.shift + eigen.S()[*k].inv()).sqrt();
                    let part = |of: fn(c64) -> f64| {
                        (0..size)
                            .map(|i| (0..done).map(|j| of(eigen.U()[(j, *k)]) * vectors[j][i]).sum())
                            .collect::<Vec<f64>>()
                    };
                    let shape = [part(|z| z.re), part(|z| z.im)];
                    Near { lambda: c64::new(-root.im, root.re), residual: residual(*k), shape }
                };
                return Ok(order.iter().map(mode).collect());
            }
            if last {
                let what = format!(
                    "of {count} complex modes near the shift {:.6e} 1/s2 the worst has a residual of {worst:.1e} (limit {bound:e}) \
                     after {done} Arnoldi vectors: ask for fewer",
                    factor.shift
                );
                return Err(Error::Solver { what });
            }
        }
        for w in &mut w {
            *w /= next;
        }
        vectors.push(w);
    }
}

/// A vector with a part in every mode: entries of all sizes and both signs without a pattern that a symmetry could share.
fn first(size: usize) -> Vec<f64> {
    let v: Vec<f64> = (0..size).map(|i| ((i as f64 + 1.0) * 0.618_033_988_749_895).fract() - 0.43).collect();
    let norm = dot(&v, &v).sqrt();
    v.iter().map(|x| x / norm).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
