//! Which eigenvalues are those of the lowest modes, where something damps.
//!
//! The vectors of a structure make more modes than count. A vibration has its place among them by |λ|, the frequency that it had without damping. A mode
//! that cannot vibrate has two real eigenvalues, a slow and a fast one, which lie as far apart as its damping is strong: they are found by their
//! shapes. With `e = xᵀ K x/xᵀ M x` the other eigenvalue of an oscillator of the shape `x` is `e/λ`, so that λ is the slow one where `λ² ≤ e`. A fast one
//! belongs to the slow one whose shape is most like its own; both have the place `√e` of that.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// Of an eigenvalue, what rounding makes of no frequency.
const ROUNDING: f64 = 1e-8;

/// A real eigenvalue with its shape.
struct Real {
    lambda: f64,
    shape: DVector<f64>,
    energy: f64,
}

/// The eigenvalues of the `modes` lowest modes of `λ² M + λ C + K` among `all`, by the matrices K, M and C.
pub(super) fn counted(all: Vec<Complex64>, matrices: [&DMatrix<f64>; 3], modes: usize) -> Vec<Complex64> {
    let (real, vibrating): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|lambda| lambda.im.abs() <= ROUNDING * lambda.norm());
    let upper = vibrating.into_iter().filter(|lambda| lambda.im > 0.0);
    let mut placed: Vec<(f64, Vec<Complex64>)> =
        upper.map(|lambda| (lambda.norm(), vec![lambda, lambda.conj()])).collect();
    let real: Vec<Real> = real.iter().map(|lambda| shaped(lambda.re, matrices)).collect();
    let mut left: Vec<&Real> = real.iter().filter(|one| one.energy <= 0.0).collect();
    for grows in [false, true] {
        let of_sign = real.iter().filter(|one| (one.lambda > 0.0) == grows && one.energy > 0.0);
        let (slow, fast): (Vec<&Real>, Vec<&Real>) =
            of_sign.partition(|one| one.lambda.powi(2) <= one.energy);
        let (both, alone) = matched(slow, fast);
        placed.extend(both.iter().map(|[slow, fast]| (slow.energy.sqrt(), vec![slow.value(), fast.value()])));
        left.extend(alone);
    }
    // Of what is left, such as what stiffness itself drives away, each mode has two as well.
    left.sort_by(|a, b| a.lambda.abs().total_cmp(&b.lambda.abs()));
    placed.extend(left.chunks(2).map(|some| {
        let product: f64 = some.iter().map(|one| one.lambda).product();
        (product.max(0.0).sqrt(), some.iter().map(|one| one.value()).collect())
    }));
    placed.sort_by(|a, b| a.0.total_cmp(&b.0));
    placed.into_iter().take(modes).flat_map(|(_, both)| both).collect()
}

impl Real {
    fn value(&self) -> Complex64 {
        Complex64::from(self.lambda)
    }
}

/// Slow and fast eigenvalues of one sign by their modes, and those that are left.
fn matched<'a>(slow: Vec<&'a Real>, fast: Vec<&'a Real>) -> (Vec<[&'a Real; 2]>, Vec<&'a Real>) {
    let mut offers: Vec<(f64, usize, usize)> = (0..slow.len())
        .flat_map(|s| (0..fast.len()).map(move |f| (s, f)))
        .map(|(s, f)| (slow[s].shape.dot(&fast[f].shape).powi(2), s, f))
        .collect();
    offers.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut both, mut of_slow, mut of_fast) = (Vec::new(), vec![false; slow.len()], vec![false; fast.len()]);
    for (_, s, f) in offers {
        if !of_slow[s] && !of_fast[f] {
            (of_slow[s], of_fast[f]) = (true, true);
            both.push([slow[s], fast[f]]);
        }
    }
    let left = slow.into_iter().zip(of_slow).chain(fast.into_iter().zip(of_fast));
    (both, left.filter(|(_, taken)| !taken).map(|(one, _)| one).collect())
}

/// The shape of a real eigenvalue: what the matrix at it all but takes away, by inverse iteration.
fn shaped(lambda: f64, [stiffness, mass, damping]: [&DMatrix<f64>; 3]) -> Real {
    /// Steps of the iteration, of which the first brings some ten digits.
    const STEPS: usize = 3;
    let size = mass.nrows();
    let lu = (mass * (lambda * lambda) + damping * lambda + stiffness).lu();
    // No symmetry makes it orthogonal to a shape.
    let mut shape = DVector::from_fn(size, |i, _| 1.0 + 0.618 * (i as f64).sin());
    for _ in 0..STEPS {
        // Singular to the last bit: what was found before stays.
        let Some(next) = lu.solve(&shape).filter(|next| next.iter().all(|entry| entry.is_finite())) else {
            break;
        };
        shape = next.normalize();
    }
    let form = |matrix: &DMatrix<f64>| shape.dot(&(matrix * &shape));
    let energy = form(stiffness) / form(mass);
    Real { lambda, shape, energy }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oscillators that do not know of each other, in coordinates that mix them: those that count have their roots, and no others do.
    #[test]
    fn roots_are_those_of_the_lowest_oscillators() {
        // ω and 2 ζ ω; of the first two.
        for oscillators in [
            [(1.0, 0.01), (2.0, 0.02), (3.0, -0.002)],
            [(1.0, 4.8), (2.0, 0.02), (3.0, -0.002)],
            [(1.0, -4.8), (2.0, -3.6), (3.0, 0.1)],
            [(1.0, 5.0), (1.0, 5.0), (3.0, -60.0)],
        ] {
            let turned = DMatrix::from_fn(3, 3, |i, j| {
                f64::from(u8::from(i == j)) + 0.3 * f64::sin((7 * i + 3 * j) as f64)
            });
            let matrix = |of: &dyn Fn((f64, f64)) -> f64| {
                let diagonal = DVector::from_fn(3, |i, _| of(oscillators[i]));
                turned.transpose() * DMatrix::from_diagonal(&diagonal) * &turned
            };
            let stiffness = matrix(&|(omega, _)| omega * omega);
            let [mass, damping] = [matrix(&|_| 1.0), matrix(&|(_, damping)| damping)];
            let roots = |(omega, damping): (f64, f64)| {
                let root = Complex64::from(damping * damping / 4.0 - omega * omega).sqrt();
                [root - damping / 2.0, -root - damping / 2.0]
            };
            let all = oscillators.iter().rev().flat_map(|one| roots(*one)).collect();
            let found = counted(all, [&stiffness, &mass, &damping], 2);
            assert_eq!(found.len(), 4);
            for root in oscillators[..2].iter().flat_map(|one| roots(*one)) {
                let nearest = found.iter().map(|other| (root - other).norm()).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-12, "{root}: {found:?}");
            }
        }
    }
}
