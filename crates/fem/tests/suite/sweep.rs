//! Modes followed over friction.

use faer::c64;
use squealmap_fem::assembly::{Rows, assemble};
use squealmap_fem::contact::Surface;
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{Basis, Factor, Judge, Ordering, Pair, follow, lowest, pairs, refine, residuals};
use squealmap_fem::sweep::{Range, sweep};

use crate::cases::pin;

/// Two modes whose frequencies cross keep their shapes, and so their branches; sorted by frequency they would change places.
#[test]
fn modes_that_cross_keep_their_branches() {
    let (one, zero) = (c64::new(1.0, 0.0), c64::new(0.0, 0.0));
    let step = |i: f64| {
        let mut pairs = vec![
            Pair { lambda: c64::new(0.0, 10.0 + i), vector: vec![one, zero] },
            Pair { lambda: c64::new(0.0, 14.5 - i), vector: vec![zero, one] },
        ];
        pairs.sort_by(|a, b| a.lambda.im.total_cmp(&b.lambda.im));
        pairs
    };
    let steps: Vec<Vec<Pair>> = (0..6).map(|i| step(f64::from(i))).collect();
    let branches = follow(&steps, 2);
    for (i, pairs) in steps.iter().enumerate() {
        assert!((pairs[branches[0].at[i]].lambda.im - (10.0 + i as f64)).abs() < 1e-12);
        assert!((pairs[branches[1].at[i]].lambda.im - (14.5 - i as f64)).abs() < 1e-12);
    }
}

/// A space that is too small gives way to the direct solution, which is what a good space gives.
#[test]
fn bad_projections_are_computed_directly() {
    let (_, pencil) = assemble(&pin::model(Kind::Hex20, 1).expect("the pin")).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 12).expect("real modes");
    let none = Rows::default();
    let mus: Vec<f64> = (0..=10).map(|i| 0.05 * f64::from(i)).collect();
    let range = Range { mus: &mus, slope: &none, count: 7, bound: 1e-7 };
    let small = Basis::new(&pencil, &modes.shapes);
    let direct = sweep(&pencil, &ordering, &factor, &small, range).expect("a sweep");
    let mut large = Basis::new(&pencil, &modes.shapes);
    refine(&pencil, &factor, &mut large, &[0.1, 0.3, 0.5], &none, 8, 1e-9, 30).expect("a space");
    let projected = sweep(&pencil, &ordering, &factor, &large, range).expect("a sweep");
    assert!(direct.iter().flat_map(|m| &m.states).filter(|s| s.direct).count() > 30);
    let (mut grows, mut checked) = (0, 0);
    for (a, b) in direct.iter().zip(&projected) {
        for (a, b) in a.states.iter().zip(&b.states) {
            assert!(a.residual <= 1e-7 && b.residual <= 1e-7, "{a:?} {b:?}");
            // Of a pair with two signs of growth either may be found first.
            let apart = (a.lambda - b.lambda).norm().min((a.lambda + b.lambda.conj()).norm());
            assert!(apart < 1e-6 * b.lambda.norm(), "{a:?} {b:?}");
            grows += usize::from(b.lambda.re > 1.0);
            checked += 1;
        }
    }
    assert_eq!(checked, 77);
    // From μ_c = 0.388 on one mode grows.
    assert_eq!(grows, 3);
    // Each mode moves smoothly.
    for mode in &projected {
        for pair in mode.states.windows(2) {
            assert!((pair[1].lambda.im / pair[0].lambda.im - 1.0).abs() < 0.01, "{mode:?}");
        }
    }
}

/// Residuals for many coefficients of friction are those of the full problem, with all that damps and all that is shifted.
#[test]
fn the_judge_knows_the_residuals() {
    let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
    for (damped, shift) in [(false, 0.0), (true, -1e10)] {
        if damped {
            model.materials = model.materials.into_iter().map(|m| m.damped(3e3, 2e-7)).collect();
        }
        let (numbering, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, shift).expect("a factor");
        let mut basis = Basis::new(&pencil, &lowest(&pencil, &factor, 15).expect("real modes").shapes);
        let faces = model.mesh.face_set("pin.z0").expect("a side");
        let surface = Surface::new(&model, &numbering, faces, &model.contact);
        let slope = if damped { surface.matrix(&vec![-3e6; model.contact.len()]) } else { Rows::default() };
        // Vectors that are no real modes, too.
        refine(&pencil, &factor, &mut basis, &[0.4], &slope, 3, 1e-9, 1).expect("a space");
        let judge = Judge::new(&pencil, &factor, &basis, &slope).expect("a judge");
        for mu in [0.0, 0.2, 0.6] {
            let found = pairs(&basis.at(mu, &slope)).expect("pairs");
            let exact = residuals(&pencil, &factor, &basis, mu, &slope, &found);
            assert!(mu == 0.0 || exact.iter().filter(|r| **r > 1e-5).count() > 10, "{exact:?}");
            for (pair, exact) in found.iter().zip(exact) {
                let residual = judge.residual(mu, pair);
                assert!(
                    (residual - exact).abs() < 1e-6 * exact + 1e-8,
                    "{damped} {mu}: {residual:e}, not {exact:e}"
                );
            }
        }
    }
}

/// The same with damping: each undamped θ = −λ² becomes the roots of λ² + (α + β θ) λ + θ = 0, also in a space that is too small.
#[test]
fn bad_projections_of_damped_modes_are_computed_directly() {
    let (alpha, beta) = (300.0, 2e-8);
    let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
    let none = Rows::default();
    let mus = [0.1, 0.3, 0.5];
    let [undamped, damped] = [0.0, 1.0].map(|on| {
        let materials = model.materials.clone();
        model.materials = materials.into_iter().map(|m| m.damped(on * alpha, on * beta)).collect();
        let (_, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        let basis = Basis::new(&pencil, &lowest(&pencil, &factor, 12).expect("real modes").shapes);
        let range = Range { mus: &mus, slope: &none, count: 7, bound: 1e-8 };
        sweep(&pencil, &ordering, &factor, &basis, range).expect("a sweep")
    });
    for i in 0..mus.len() {
        for mode in &undamped {
            let theta = -(mode.states[i].lambda * mode.states[i].lambda);
            let half = (alpha + beta * theta) / 2.0;
            let root = (half * half - theta).sqrt();
            let close = |a: c64| {
                let states = damped.iter().map(|mode| mode.states[i]);
                let apart = states.map(|state| (state.lambda - a).norm()).fold(f64::INFINITY, f64::min);
                apart / a.norm()
            };
            let best = [root - half, -root - half].into_iter().filter(|r| r.im > 0.0).map(close);
            let best = best.fold(f64::INFINITY, f64::min);
            assert!(best < 1e-6, "{theta} at {}: {best:e}", mus[i]);
        }
    }
    let states: Vec<_> = damped.iter().flat_map(|mode| &mode.states).collect();
    assert!(states.iter().all(|state| state.residual <= 1e-8));
    assert!(states.iter().filter(|state| state.direct).count() > 15);
}
