//! Two masses, written as a pencil: all is known in closed form.

use std::sync::Arc;

use faer::{Mat, c64};
use squealmap_fem::assembly::{Pattern, Pencil, Rows, Symmetric};
use squealmap_fem::modes::{Alone, Basis, Pair, alone, coalescence_small, pairs};

const K: [f64; 3] = [2.0, 0.4, 3.0];
/// Rows of the normal force: stiffness and mass.
const K_N: [f64; 2] = [0.3, -2.5];
const M_N: [f64; 2] = [0.5, 1.2];

/// M = 1, K = [K0 K1; K1 K2], friction on the first row.
fn pencil() -> Pencil {
    let pattern = Arc::new(Pattern::of(2, &[vec![0, 1]]));
    let matrix = |values: [f64; 4]| Symmetric { pattern: pattern.clone(), values: values.to_vec() };
    let row = |values: [f64; 2]| Rows { rows: vec![vec![(0, values[0]), (1, values[1])]] };
    Pencil {
        stiffness: matrix([K[0], K[1], K[1], K[2]]),
        mass: matrix([1.0, 0.0, 0.0, 1.0]),
        damping: None,
        modal: Vec::new(),
        slip: row([1.0, 0.0]),
        normal_stiffness: row(K_N),
        normal_mass: row(M_N),
        normal_damping: row([0.0; 2]),
    }
}

/// det = a θ² + b θ + c.
fn polynomial(mu: f64) -> [f64; 3] {
    let (k, m) = (K[0] + mu * K_N[0], 1.0 + mu * M_N[0]);
    [m, -k - m * K[2] + mu * M_N[1] * K[1], k * K[2] - K[1] * (K[1] + mu * K_N[1])]
}

#[test]
fn eigenvalues_are_the_roots_of_the_characteristic_equation() {
    let basis = Basis::new(&pencil(), &Mat::identity(2, 2));
    for mu in [0.0, 0.1, 0.3, 0.6, 1.0] {
        let [a, b, c] = polynomial(mu);
        let root = c64::new(b * b - 4.0 * a * c, 0.0).sqrt();
        for theta in [(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)] {
            let omega = theta.sqrt();
            let exact = c64::new(-omega.im, omega.re);
            let found = pairs(&basis.at(mu, &Rows::default())).expect("eigenvalues");
            let error = found.iter().map(|p| (p.lambda - exact).norm()).fold(f64::INFINITY, f64::min);
            assert!(error < 1e-13, "{exact} at mu = {mu}: {error:e}");
        }
    }
}

/// The discriminant vanishes at μ_c, found by halving an interval; Newton's method on the bordered matrix doubles its digits there.
#[test]
fn the_coalescence_is_the_root_of_the_discriminant() {
    let discriminant = |mu: f64| {
        let [a, b, c] = polynomial(mu);
        b * b - 4.0 * a * c
    };
    let (mut below, mut above) = (0.0, 1.0);
    assert!(discriminant(below) > 0.0 && discriminant(above) < 0.0);
    for _ in 0..60 {
        let middle = f64::midpoint(below, above);
        if discriminant(middle) > 0.0 { below = middle } else { above = middle }
    }
    let [a, b, _] = polynomial(below);
    let basis = Basis::new(&pencil(), &Mat::identity(2, 2));
    let near = below * 1.02;
    let small = basis.at(near, &Rows::default());
    let start: Pair = pairs(&small).expect("eigenvalues").remove(0);
    let found = coalescence_small(&basis, near, &start).expect("a coalescence");
    assert!((found.mu - below).abs() < 1e-12, "{} {below}", found.mu);
    assert!((found.omega2 + b / (2.0 * a)).abs() < 1e-11, "{}", found.omega2);
    assert!(found.steps <= 5, "{} steps", found.steps);
}

/// λ with one mechanism alone are roots of the determinant without the other, and those of the same mode: nearer to it than the other mode's.
#[test]
fn each_mechanism_alone_has_its_determinant() {
    let (mu, fall) = (0.2, -0.15);
    let slope = Rows { rows: vec![vec![(0, fall)]] };
    let basis = Basis::new(&pencil(), &Mat::identity(2, 2));
    let modes = pairs(&basis.at(mu, &slope)).expect("eigenvalues");
    assert_eq!(modes.len(), 2);
    let determinant = |lambda: c64, mu: f64, fall: f64| {
        let entry = |m: f64, c: f64, k: f64| lambda * lambda * m + lambda * c + k;
        entry(1.0 + mu * M_N[0], fall, K[0] + mu * K_N[0]) * entry(1.0, 0.0, K[2])
            - entry(mu * M_N[1], 0.0, K[1] + mu * K_N[1]) * entry(0.0, 0.0, K[1])
    };
    let found = alone(&basis, mu, &slope, &modes).expect("eigenvalues");
    for (i, (mode, Alone { flat, frozen })) in modes.iter().zip(&found).enumerate() {
        println!("{}: flat {flat}, frozen {frozen}", mode.lambda);
        assert!(determinant(*flat, mu, 0.0).norm() < 1e-13, "{flat}");
        assert!(determinant(*frozen, 0.0, fall).norm() < 1e-13, "{frozen}");
        let other = modes[1 - i].lambda;
        for lambda in [flat, frozen] {
            assert!((lambda - mode.lambda).norm() < (lambda - other).norm(), "{lambda} {}", mode.lambda);
        }
        // Falling friction makes both grow; without it nothing does below the coalescence.
        assert!(frozen.re > 1e-3 && flat.re.abs() < 1e-13);
    }
}
