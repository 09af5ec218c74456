//! A pin on a block: numbers of an independent program.

use faer::c64;
use squealmap_fem::assembly::{Rows, assemble};
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{
    Basis, Factor, Ordering, Pair, coalescence, coalescence_small, count_below, first_unstable, lowest, near,
    pairs, refine, residuals,
};

use crate::cases::pin;

/// The ten lowest frequencies (Hz) of CalculiX 2.20 for the file of `examples/calculix/main.rs`, with equations that tie the normal displacements.
const CALCULIX: [f64; 10] = [
    16_087.39, 16_690.00, 30_126.49, 55_767.81, 63_371.81, 63_864.10, 64_420.15, 72_715.21, 80_388.74,
    85_893.48,
];

/// At μ = 0, and that none is missing below the highest.
#[test]
fn real_modes_are_the_published_ones() {
    let (_, pencil) = assemble(&pin::model(Kind::Hex20, 1).expect("the pin")).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 12).expect("real modes");
    let found = modes.frequencies();
    println!("{} unknowns, {} contact points: {found:?}", pencil.size(), pencil.slip.rows.len());
    for (published, found) in [16_087.39, 16_690.00, 30_126.49, 55_767.81, 63_371.81].iter().zip(&found) {
        assert!((published - found).abs() < 0.006, "{published} {found}");
    }
    for (theirs, found) in CALCULIX.iter().zip(&found) {
        assert!((theirs - found).abs() < 6e-7 * theirs, "{theirs} {found}");
    }
    for k in 0..11 {
        let between = f64::midpoint(found[k], found[k + 1]);
        assert_eq!(count_below(&pencil, &ordering, between).expect("a count"), k + 1);
    }
}

#[test]
fn two_modes_coalesce_where_they_should() {
    let (_, pencil) = assemble(&pin::model(Kind::Hex20, 1).expect("the pin")).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 20).expect("real modes");
    let mut basis = Basis::new(&pencil, &modes.shapes);
    let worst =
        refine(&pencil, &factor, &mut basis, &[0.2, 0.4], &Rows::default(), 8, 1e-8, 20).expect("a space");
    println!("{} vectors, residual {worst:e}", basis.vectors.ncols());
    assert!(worst < 1e-8);
    let found = pairs(&basis.at(0.4, &Rows::default())).expect("complex modes");
    let residual = residuals(&pencil, &factor, &basis, 0.4, &Rows::default(), &found[..8]);
    assert!(residual.iter().all(|r| *r < 1e-8), "{residual:?}");
    let unstable = found.iter().find(|p| p.growth() > 1.0).expect("flutter");
    println!("{} Hz, {} 1/s", unstable.frequency(), unstable.growth());
    assert!((unstable.frequency() - 64_170.82).abs() < 0.006);
    assert!((unstable.growth() - 431.41).abs() < 0.006);
    // The same by the way that needs no projection.
    let shift = (64_000.0 * std::f64::consts::TAU).powi(2);
    let shifted = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, shift).expect("a factor");
    let direct = near(&pencil, &shifted, 0.4, 4, 1e-10).expect("complex modes");
    assert!(direct.iter().any(|mode| (mode.lambda - unstable.lambda).norm() < 1e-6 * unstable.lambda.norm()));

    let start_basis = Basis::new(&pencil, &basis.vectors);
    let mus: Vec<f64> = (0..=8).map(|i| 0.05 * f64::from(i)).collect();
    let (_, start) =
        first_unstable(&basis, &mus, &Rows::default(), 7e4, 1.0).expect("eigenvalues").expect("flutter");
    let critical = coalescence(&pencil, &factor, &mut basis, 0.4, &start).expect("a coalescence");
    println!("mu_c {} at {} Hz, last step {:e}", critical.mu, critical.frequency(), critical.step);
    assert!((critical.mu - 0.38838).abs() < 6e-6);
    // Newton's method doubles the digits in each step, if its derivatives are right.
    let again = Pair { lambda: c64::new(0.0, critical.omega2.sqrt()), vector: unstable.vector.clone() };
    let on = coalescence_small(&start_basis, critical.mu + 1e-3, &again).expect("a coalescence");
    assert!(on.steps <= 5, "{} steps", on.steps);
    // A space that knows nothing of friction yet comes to the same.
    let mut raw = Basis::new(&pencil, &modes.shapes);
    let pair = first_pair(&raw);
    let same = coalescence(&pencil, &factor, &mut raw, 0.4, &pair).expect("a coalescence");
    assert!((same.mu - critical.mu).abs() < 1e-8, "{} {}", same.mu, critical.mu);
    // Just below both are real, just above they are not.
    for (mu, grows) in [(critical.mu - 1e-6, false), (critical.mu + 1e-6, true)] {
        let near_it = near(&pencil, &shifted, mu, 4, 1e-10).expect("complex modes");
        assert_eq!(near_it.iter().any(|mode| mode.lambda.re > 0.1), grows, "{mu}");
    }
}

/// The first pair that grows on a basis, from where on any does.
fn first_pair(basis: &Basis) -> Pair {
    let mus: Vec<f64> = (0..=60).map(|i| 0.01 * f64::from(i)).collect();
    first_unstable(basis, &mus, &Rows::default(), 7e4, 1.0).expect("eigenvalues").expect("flutter").1
}
