//! The clamped layer on a moving plane, whose eigenvalues are known exactly.

use faer::c64;
use squealmap_fem::assembly::{Rows, assemble};
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{Basis, Factor, Near, Ordering, lowest, near, pairs, refine};

use crate::cases::{layer, plane_waves};

/// λ with a frequency in Hz as its imaginary part.
fn in_hz(lambda: c64) -> (f64, f64) {
    (lambda.im / std::f64::consts::TAU, lambda.re)
}

/// The root search of this suite finds the published eigenvalues.
#[test]
fn the_exact_eigenvalues_are_the_published_ones() {
    let found: Vec<_> = plane_waves::exact(1, 0.3, 4e5).into_iter().map(in_hz).collect();
    for published in [(248_059.474_569, 81_738.075_155), (320_145.907_546, 20_551.137_376)] {
        let close = |f: &(f64, f64)| (f.0 - published.0).abs() < 1e-6 && (f.1 - published.1).abs() < 1e-6;
        assert!(found.iter().any(close), "{published:?} is not in {found:?}");
    }
    for mu in [0.0, 0.7] {
        let found: Vec<_> = plane_waves::exact(0, mu, 3.5e5).into_iter().map(in_hz).collect();
        for published in [80_448.079_474, 241_344.238_423, 301_009.150_817] {
            assert!(
                found.iter().any(|f| (f.0 - published).abs() < 1e-6 && f.1.abs() < 1e-6),
                "{published} is not in {found:?}"
            );
        }
    }
}

/// The eigenvalue of the finite elements nearest to an exact one.
fn nearest(kind: Kind, n: usize, mu: f64, exact: c64) -> c64 {
    let (_, pencil) = assemble(&layer::model(kind, n).expect("the layer")).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let shift = -(exact * exact).re;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, shift).expect("a factor");
    let found = near(&pencil, &factor, mu, 6, 1e-10).expect("complex modes");
    let apart = |mode: &Near| (mode.lambda - exact).norm();
    found.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("some").lambda
}

/// The errors fall by two to the power of twice the degree of the elements' polynomials when their size halves.
#[test]
fn elements_converge_to_the_exact_eigenvalues() {
    for mu in [0.3, 0.55] {
        for exact in plane_waves::exact(1, mu, 3.5e5) {
            for (kind, sizes, order) in
                [(Kind::Hex20, [4, 8], 3.8), (Kind::Tet10, [4, 8], 3.5), (Kind::Hex8, [16, 32], 1.8)]
            {
                let errors = sizes.map(|n| {
                    let found = nearest(kind, n, mu, exact);
                    [(found.im - exact.im).abs() / exact.im, (found.re - exact.re).abs() / exact.im]
                });
                for part in 0..2 {
                    let measured = (errors[0][part] / errors[1][part]).log2();
                    assert!(
                        measured > order,
                        "{} {exact} at mu = {mu}: order {measured}, {errors:?}",
                        kind.name()
                    );
                }
            }
        }
    }
}

/// Friction is strong here, and no real mode has shear on the plane: the projection still comes to the eigenvalues of the full problem,
/// with less than a hundred vectors.
#[test]
fn the_projection_comes_to_the_full_problem() {
    let mu = 0.3;
    let (_, pencil) = assemble(&layer::model(Kind::Hex20, 6).expect("the layer")).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 24).expect("real modes");
    let mut basis = Basis::new(&pencil, &modes.shapes);
    let none = Rows::default();
    let before = refine(&pencil, &factor, &mut basis, &[mu], &none, 8, 1e-8, 0).expect("residuals");
    let after = refine(&pencil, &factor, &mut basis, &[mu], &none, 8, 1e-8, 30).expect("a space");
    assert!(before > 1e-2 && after <= 1e-8, "{before:e} {after:e}");
    assert!(basis.vectors.ncols() < 100, "{} vectors", basis.vectors.ncols());
    let found = pairs(&basis.at(mu, &none)).expect("complex modes");
    for pair in &found[..8] {
        // Beside it, as waves that friction does not change are modes of K − σ M, too.
        let shift = -(pair.lambda * pair.lambda).re * (1.0 - 1e-5);
        let shifted = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, shift).expect("a factor");
        let full = near(&pencil, &shifted, mu, 4, 1e-11).expect("complex modes");
        let error = full.iter().map(|f| (f.lambda - pair.lambda).norm()).fold(f64::INFINITY, f64::min);
        assert!(error < 1e-9 * pair.lambda.norm(), "{}: {error:e}", pair.lambda);
    }
}

/// Where the layer does not vary along the plane, friction changes nothing. What is left is the error of quadratic elements on a
/// line, (k h)⁴/1440 of the frequency, with k h = q π/2 over the number of
/// elements for q quarters of a wave.
#[test]
fn friction_does_not_change_uniform_modes() {
    const ELEMENTS: u8 = 6;
    for mu in [0.0, 0.3, 0.7] {
        for (hz, quarters) in [(80_448.079_474, 1.0), (241_344.238_423, 3.0), (301_009.150_817, 2.0)] {
            let exact = c64::new(0.0, hz * std::f64::consts::TAU);
            let found = nearest(Kind::Hex20, ELEMENTS.into(), mu, exact);
            assert!(found.re.abs() < 1e-6 * found.im, "{found} at mu = {mu}");
            let error = (found.im - exact.im) / exact.im;
            let predicted = (quarters * std::f64::consts::FRAC_PI_2 / f64::from(ELEMENTS)).powi(4) / 1440.0;
            assert!(
                (error / predicted - 1.0).abs() < 0.05,
                "{hz} Hz at mu = {mu}: {error:e}, not {predicted:e}"
            );
        }
    }
}
