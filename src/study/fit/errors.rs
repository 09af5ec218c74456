//! Standard errors of a fit: how far its values would scatter if the same points were measured again.
//!
//! With the derivatives `J` of the fitted friction by the values at every point, residuals `r`, `n` points and `p` values
//!
//! ```text
//! s² = Σ r²/(n − p)        covariance of the values = s² (JᵀJ)⁻¹
//! ```
//!
//! Exact for a velocity that is given, as the law is linear then; of first order in the noise where it was found and is one of
//! the values.

use nalgebra::{DMatrix, DVector};

use crate::study::fit::problem::{DETERMINED, Problem, speeds};

/// Standard errors of the values of a solution, in their order, followed by that of the velocity (m/s) where it was found.
/// `variance` is that of the friction coefficients. `None` where the points do not determine all values together.
pub(super) fn standard_errors(
    problem: &Problem,
    solution: &DVector<f64>,
    (velocity, is_found): (f64, bool),
    variance: f64,
) -> Option<Vec<f64>> {
    let values = solution.len() + usize::from(is_found);
    let mut normal = DMatrix::<f64>::zeros(values, values);
    for point in problem.points {
        let mut derivatives = problem.weights(point, velocity);
        if is_found {
            let change = problem.part.map_or(0.0, |part| part.shift(speeds(point), velocity));
            let fall = |(row, share): (usize, f64)| share * (solution[2 * row + 1] - solution[2 * row]);
            let by_velocity = problem.rows(point.temperature).into_iter().map(fall).sum::<f64>() * change;
            derivatives.push((solution.len(), by_velocity));
        }
        for &(i, a) in &derivatives {
            for &(j, b) in &derivatives {
                normal[(i, j)] += a * b;
            }
        }
    }
    // In units of their own size, as a velocity and a friction coefficient cannot be compared.
    let size: Vec<f64> = normal.diagonal().iter().map(|square| square.sqrt()).collect();
    let scaled = DMatrix::from_fn(values, values, |i, j| normal[(i, j)] / (size[i] * size[j]));
    if scaled.iter().any(|value| !value.is_finite()) || scaled.symmetric_eigenvalues().min() <= DETERMINED {
        return None;
    }
    let inverse = scaled.cholesky()?.inverse();
    Some((0..values).map(|i| (variance * inverse[(i, i)]).sqrt() / size[i]).collect())
}
