//! A complex mode of the full problem near a guess, whatever damps: Arnoldi's method for problems that are not linear in λ (Voss, An Arnoldi
//! method for nonlinear eigenvalue problems, BIT Numer. Math. 44, 2004).
//!
//! The space takes in (K − σ M)⁻¹ P(λ) x, where σ lies near −λ². Damping and friction are in P only, so that the factor stays real and
//! symmetric; they cost steps, not precision.

use faer::{Mat, c64};

use super::residual::left;
use super::{Basis, Factor, Ordering, Pair, dense, likeness};
use crate::Error;
use crate::assembly::{Pencil, Rows};

/// The mode that is most like a pair of the projected problem, and its residual. The basis takes in what the mode lacked; `factor` is the one by
/// which residuals are measured.
///
/// # Errors
/// Where the residual does not come below the bound.
#[expect(clippy::too_many_arguments, reason = "the problem, the space, and the pair with its bound")]
pub fn nearby(
    pencil: &Pencil,
    ordering: &Ordering,
    factor: &Factor,
    basis: &mut Basis,
    mu: f64,
    slope: &Rows,
    pair: &Pair,
    bound: f64,
) -> Result<(Pair, f64), Error> {
    /// So far beside the guess, as a mode that friction does not change is one of K − σ M, too, which would be singular.
    const BESIDE: f64 = 1e-3;
    const STEPS: usize = 100;
    let shift = -(pair.lambda * pair.lambda).re * (1.0 - BESIDE);
    let near = Factor::new(ordering, &pencil.stiffness, &pencil.mass, shift)?;
    let mut now = pair.clone();
    let mut residual = f64::INFINITY;
    for _ in 0..STEPS {
        let found = left(pencil, factor, basis, mu, slope, std::slice::from_ref(&now));
        residual = found.residual[0];
        if residual <= bound {
            return Ok((now, residual));
        }
        let mut corrections = Mat::from_fn(pencil.size(), 4, |i, j| {
            if j < 2 { found.forces[(i, j)] } else { found.corrections[(i, j - 2)] }
        });
        near.solve(corrections.as_mut().subcols_mut(0, 2));
        if basis.extend(pencil, &corrections) == 0 {
            break;
        }
        now.vector.resize(basis.vectors.ncols(), c64::new(0.0, 0.0));
        let score = |other: &Pair| {
            likeness(&now.vector, &other.vector) - (other.lambda - now.lambda).norm() / now.lambda.norm()
        };
        let best =
            dense::pairs(&basis.at(mu, slope))?.into_iter().max_by(|a, b| score(a).total_cmp(&score(b)));
        now = best.unwrap_or(now);
    }
    let what = format!(
        "the complex mode near {:.1} Hz has a residual of {residual:.1e} (limit {bound:e}): use more real modes",
        pair.frequency()
    );
    Err(Error::Solver { what })
}
