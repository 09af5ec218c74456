//! Eigenvalues of real matrices against closed forms and another program.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, Schur};
use num_complex::Complex64;
use squealmap::model::spectrum::eigenvalues;

use crate::instances::Uniform;

/// The largest distance of two sets of eigenvalues, each paired with the nearest that is left.
fn apart(found: &[Complex64], wanted: &[Complex64]) -> f64 {
    assert_eq!(found.len(), wanted.len());
    let mut left = wanted.to_vec();
    let mut worst = 0.0_f64;
    for z in found {
        let nearest = (0..left.len()).min_by(|a, b| (left[*a] - z).norm().total_cmp(&(left[*b] - z).norm()));
        worst = worst.max((left.swap_remove(nearest.expect("as many are left")) - z).norm());
    }
    worst
}

/// The companion matrix of a polynomial with these roots.
fn companion(roots: &[Complex64]) -> DMatrix<f64> {
    let mut polynomial = vec![Complex64::ONE];
    for root in roots {
        let mut next = vec![Complex64::ZERO; polynomial.len() + 1];
        for (k, c) in polynomial.iter().enumerate() {
            next[k] += c;
            next[k + 1] -= c * root;
        }
        polynomial = next;
    }
    let n = roots.len();
    DMatrix::from_fn(
        n,
        n,
        |i, j| if i == 0 { -polynomial[j + 1].re } else { f64::from(u8::from(i == j + 1)) },
    )
}

#[test]
fn roots_of_polynomials_are_found() {
    let real = |x: f64| Complex64::new(x, 0.0);
    let (a, b) = (Complex64::new(0.3, 1.2), Complex64::new(-0.5, 0.1));
    for (roots, within) in [
        (vec![real(3.0)], 1e-15),
        (vec![real(3.0), real(-2.0)], 1e-15),
        (vec![a, a.conj()], 1e-15),
        (vec![a, a.conj(), b, b.conj(), real(1.0)], 1e-14),
        (vec![real(1.0), real(2.0), real(3.0), real(4.0), real(5.0), real(6.0)], 1e-11),
        // Double roots are known to the root of the rounding.
        (vec![real(1.0), real(1.0), b, b.conj()], 1e-7),
        (vec![real(0.0), real(0.0), real(0.0), real(1.0)], 1e-4),
    ] {
        let found = eigenvalues(companion(&roots)).expect("they converge");
        assert!(apart(&found, &roots) < within, "{roots:?} {found:?}");
    }
}

/// Matrices of which double steps alone make themselves again.
#[test]
fn cycles_are_broken() {
    for n in [3, 4, 5, 8, 16, 33] {
        let cycle = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == (j + 1) % n)));
        let found = eigenvalues(cycle).expect("they converge");
        let wanted: Vec<Complex64> =
            (0..n).map(|k| Complex64::from_polar(1.0, TAU * k as f64 / n as f64)).collect();
        assert!(apart(&found, &wanted) < 1e-12, "{n}: {found:?}");
    }
    assert_eq!(eigenvalues(DMatrix::zeros(7, 7)), Some(vec![Complex64::ZERO; 7]));
    assert!(apart(&eigenvalues(DMatrix::identity(5, 5)).expect("ones"), &[Complex64::ONE; 5]) < 1e-15);
}

/// Full, sparse, graded and companion-like matrices of many sizes.
#[test]
fn another_program_finds_the_same() {
    let mut u = Uniform(11);
    for case in 0..400 {
        let n = 1 + case % 40;
        let scale = |i: usize| if case % 3 == 0 { 10_f64.powf(-3.0 * i as f64 / n as f64) } else { 1.0 };
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            let x = 2.0 * u.next() - 1.0;
            if case % 4 == 1 && x.abs() < 0.7 && i != j { 0.0 } else { x * scale(i) }
        });
        let schur = Schur::try_new(matrix.clone(), f64::EPSILON, 10_000).expect("it converges");
        let wanted: Vec<Complex64> = schur.complex_eigenvalues().iter().copied().collect();
        let found = eigenvalues(matrix.clone()).expect("they converge");
        let distance = apart(&found, &wanted);
        assert!(distance < 1e-8 * matrix.norm(), "{case}: {distance:e}");
        // The sum is that of the diagonal, and of each pair of conjugates both are there.
        let sum: Complex64 = found.iter().sum();
        assert!(
            (sum.re - matrix.trace()).abs() < 1e-12 * matrix.norm() * n as f64 && sum.im == 0.0,
            "{case}: {sum}"
        );
    }
}

/// Oscillators with frequencies over three decades, a thousandth damped, in skew coordinates: λ = ω (−ζ ± i √(1 − ζ²)).
#[test]
fn modes_far_apart_are_found() {
    const RATIO: f64 = 1e-3;
    let mut u = Uniform(5);
    for case in 0..60 {
        let n = 8 + case % 24;
        let frequencies: Vec<f64> = (0..n).map(|_| u.log(1e-3, 1.0)).collect();
        let skew = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) + 0.3 * (u.next() - 0.5));
        let inverse = skew.clone().try_inverse().expect("near the identity");
        let of = |value: fn(f64) -> f64| {
            let diagonal = DMatrix::from_fn(n, n, |i, j| if i == j { value(frequencies[i]) } else { 0.0 });
            &skew * diagonal * &inverse
        };
        let (stiffness, damping) = (of(|w| w * w), of(|w| 2.0 * RATIO * w));
        let mut companion = DMatrix::zeros(2 * n, 2 * n);
        companion.view_mut((0, n), (n, n)).fill_with_identity();
        companion.view_mut((n, 0), (n, n)).copy_from(&-stiffness);
        companion.view_mut((n, n), (n, n)).copy_from(&-damping);
        let found = eigenvalues(companion).unwrap_or_else(|| panic!("case {case} does not converge"));
        let wanted: Vec<Complex64> = frequencies
            .iter()
            .flat_map(|w| {
                [1.0, -1.0].map(|sign| w * Complex64::new(-RATIO, sign * (1.0 - RATIO * RATIO).sqrt()))
            })
            .collect();
        assert!(apart(&found, &wanted) < 1e-12, "{case}: {:e}", apart(&found, &wanted));
    }
}

#[test]
fn what_is_no_number_has_no_eigenvalues() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut matrix = DMatrix::identity(4, 4);
        matrix[(2, 1)] = bad;
        assert_eq!(eigenvalues(matrix), None);
    }
}
