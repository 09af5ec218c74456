//! Damping of materials and of a slope of friction, against closed forms.

use faer::c64;
use squealmap_fem::assembly::{Rows, assemble};
use squealmap_fem::contact::Surface;
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{
    Basis, Factor, Judge, Ordering, Small, damp, loss_ratios, lowest, pairs, refine, residuals,
};

use crate::cases::{layer, pin};

/// With C = α M + β K each undamped θ = −λ² becomes the roots of λ² + (α + β θ) λ + θ = 0, also with friction: C has its row of
/// friction as M and K have theirs.
#[test]
fn rayleigh_damping_shifts_each_eigenvalue_as_it_should() {
    // With the larger β what is above 160 kHz cannot vibrate: it may not hide the modes.
    let mu = 0.4;
    let solve = |damped: bool, alpha: f64, beta: f64| {
        let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
        if damped {
            model.materials = model.materials.into_iter().map(|m| m.damped(alpha, beta)).collect();
        }
        let (_, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        let modes = lowest(&pencil, &factor, 20).expect("real modes");
        let mut basis = Basis::new(&pencil, &modes.shapes);
        let none = Rows::default();
        let worst = refine(&pencil, &factor, &mut basis, &[mu], &none, 7, 1e-8, 20).expect("a space");
        assert!(worst < 1e-8, "{worst:e}");
        let mut found = pairs(&basis.at(mu, &none)).expect("complex modes");
        found.truncate(7);
        found.into_iter().map(|p| p.lambda).collect::<Vec<c64>>()
    };
    let undamped = solve(false, 0.0, 0.0);
    for (alpha, beta) in [(300.0, 2e-8), (300.0, 2e-6)] {
        let damped = solve(true, alpha, beta);
        for undamped in &undamped {
            let theta = -(undamped * undamped);
            let half = (alpha + beta * theta) / 2.0;
            let roots = [1.0, -1.0].map(|sign| sign * (half * half - theta).sqrt() - half);
            let close =
                |a: c64| damped.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min) / a.norm();
            let best = roots.into_iter().filter(|r| r.im > 0.0).map(close).fold(f64::INFINITY, f64::min);
            assert!(best < 1e-7, "{beta} {undamped}: {best:e}");
        }
    }
}

/// Oscillators, some so damped that they have two real eigenvalues, or that damping drives so far: one pair each, the lasting one, in the order
/// of their frequencies without damping, also of two that are alike.
#[test]
fn a_mode_that_cannot_vibrate_is_one_pair() {
    // ω and 2 ζ ω, in the order of ω.
    for modes in [
        &[(1e3, 20.0), (1e5, 3e5)][..],
        &[(1e3, -3e3), (1e5, 20.0)],
        &[(1e3, -3e3), (1e3, -3e3), (2e3, 10.0), (3e3, -8e4)],
        &[(1e3, 4e3), (1e3, 4e3), (1e3, 4e3), (5e3, 1e2), (6e3, 1e6), (7e3, 1e5)],
    ] {
        let size = modes.len();
        // In other coordinates, or all shapes were unit vectors.
        let turned = faer::Mat::from_fn(size, size, |i, j| {
            f64::from(u8::from(i == j)) + 0.3 * f64::sin((7 * i + 3 * j) as f64)
        });
        let matrix = |of: &dyn Fn((f64, f64)) -> f64| {
            let diagonal = faer::Mat::from_fn(size, size, |i, j| if i == j { of(modes[i]) } else { 0.0 });
            turned.transpose() * diagonal * &turned
        };
        let small = Small {
            stiffness: matrix(&|(omega, _)| omega * omega),
            mass: matrix(&|_| 1.0),
            damping: Some(matrix(&|(_, damping)| damping)),
        };
        let found = pairs(&small).expect("complex modes");
        assert_eq!(found.len(), size);
        for (pair, (omega, damping)) in found.iter().zip(modes) {
            let root = c64::new(damping * damping / 4.0 - omega * omega, 0.0).sqrt();
            let expected = root - damping / 2.0;
            assert!((pair.lambda - expected).norm() < 1e-7 * expected.norm(), "{} {expected}", pair.lambda);
        }
    }
}

/// A layer in uniform shear, clamped above, with a damping of c per area below: λ = c_s/h (−ln((Z + c)/(Z − c))/2 + iπ/2) with
/// Z = ρ c_s. A falling friction is a negative c.
#[test]
fn a_slope_of_friction_damps_as_it_should() {
    let (height, shear, density) = (0.01, 210e9 / 2.6, 7800.0);
    let speed = f64::sqrt(shear / density);
    let impedance = density * speed;
    let (numbering_model, n) = (layer::model(Kind::Hex20, 6).expect("the layer"), 6.0_f64);
    let (numbering, pencil) = assemble(&numbering_model).expect("matrices");
    let faces = numbering_model.mesh.face_set("y0").expect("a side");
    let surface = Surface::new(&numbering_model, &numbering, faces, &numbering_model.contact);
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 12).expect("real modes");
    for part in [0.1, -0.1] {
        let damping = part * impedance;
        let slope = surface.matrix(&vec![damping; numbering_model.contact.len()]);
        let mut basis = Basis::new(&pencil, &modes.shapes);
        let worst = refine(&pencil, &factor, &mut basis, &[0.0], &slope, 2, 1e-9, 40).expect("a space");
        let found = pairs(&basis.at(0.0, &slope)).expect("complex modes");
        let residual = residuals(&pencil, &factor, &basis, 0.0, &slope, &found[..2]);
        assert!(worst < 1e-9 && residual.iter().all(|r| *r < 1e-9), "{worst:e} {residual:?}");
        let decay = -0.5 * ((1.0 + part) / (1.0 - part)).ln();
        let exact = speed / height * c64::new(decay, std::f64::consts::FRAC_PI_2);
        let error =
            found.iter().map(|p| (p.lambda - exact).norm()).fold(f64::INFINITY, f64::min) / exact.norm();
        // Quadratic elements: (k h)⁴/1440.
        let expected = (std::f64::consts::FRAC_PI_2 / n).powi(4) / 1440.0;
        assert!(error < 1.5 * expected, "{part}: {error:e}, not {expected:e}");
    }
}

/// With ζ = (α/ω + β ω)/2 for every mode that a coarse pin has, damping mode by mode is Rayleigh's: that of the mass with friction, too, as
/// its forces act on the nodes as inertia does.
#[test]
fn damped_modes_together_are_a_damped_material() {
    let plain = pin::model(Kind::Hex8, 1).expect("the pin");
    let none = Rows::default();
    let solve = |[alpha, beta, mu]: [f64; 3], modal: bool| {
        let mut model = plain.clone();
        if !modal {
            model.materials = model.materials.into_iter().map(|m| m.damped(alpha, beta)).collect();
        }
        let (_, mut pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        let modes = lowest(&pencil, &factor, pencil.size()).expect("all modes");
        if modal {
            let ratio = |w: &f64| 0.5 * (alpha / w.sqrt() + beta * w.sqrt());
            damp(&mut pencil, &modes, &modes.omega2.iter().map(ratio).collect::<Vec<f64>>()).expect("ratios");
        }
        let basis = Basis::new(&pencil, &modes.shapes);
        let found = pairs(&basis.at(mu, &none)).expect("complex modes");
        let residual = residuals(&pencil, &factor, &basis, mu, &none, &found[..10]);
        let judge = Judge::new(&pencil, &factor, &basis, &none).expect("a judge");
        assert!(residual.iter().all(|r| *r < 1e-8), "{residual:?}");
        assert!(found[..10].iter().all(|pair| judge.residual(mu, pair) < 1e-6));
        found.into_iter().map(|pair| pair.lambda).collect::<Vec<c64>>()
    };
    for case in [[3e3, 2e-7, 0.0], [3e3, 0.0, 0.4]] {
        let (expected, found) = (solve(case, false), solve(case, true));
        assert_eq!(expected.len(), found.len());
        // Of two that have coalesced either may come first.
        for a in &expected {
            let apart = found.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
            assert!(apart < 1e-7 * a.norm(), "{case:?}: {a} by {apart:e}");
        }
        assert!(case[2] > 0.0 || found.iter().all(|lambda| lambda.re < 0.0));
    }
    let (_, mut pencil) = assemble(&plain).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, 2).expect("modes");
    for (ratios, words) in [(vec![0.01; 3], "3 damping ratios are given for 2"), (vec![f64::NAN], "is NaN")] {
        let error = damp(&mut pencil, &modes, &ratios).expect_err("no damping").to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// A material's share of the strain energy is twice the relative change of a frequency by a relative change of its stiffness.
#[test]
fn loss_factors_count_by_the_share_of_energy() {
    let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
    model.materials.push(model.materials[0].clone());
    model.mesh.groups[1].material = 1;
    let solve = |model: &_| {
        let (numbering, pencil) = assemble(model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        (numbering, lowest(&pencil, &factor, 5).expect("real modes"))
    };
    let (numbering, modes) = solve(&model);
    let loss = [0.02, 0.3];
    let ratios = loss_ratios(&model, &numbering, &modes, &loss).expect("ratios");
    let changed = |sign: f64, material: usize| {
        let mut model = model.clone();
        for modulus in model.materials[material].stiffness.iter_mut().flatten() {
            *modulus *= 1.0 + sign * 1e-4;
        }
        solve(&model).1.frequencies()
    };
    for (k, ratio) in ratios.iter().enumerate() {
        let share = |material| {
            let [up, down] = [1.0, -1.0].map(|sign| changed(sign, material)[k]);
            2.0 * (up / down).ln() / 2e-4
        };
        let shares = [share(0), share(1)];
        let expected = 0.5 * (loss[0] * shares[0] + loss[1] * shares[1]);
        println!("{shares:?}: {ratio}, {expected}");
        assert!((shares[0] + shares[1] - 1.0).abs() < 1e-6);
        assert!((ratio / expected - 1.0).abs() < 1e-5, "{ratio} {expected}");
    }
    let error = loss_ratios(&model, &numbering, &modes, &[0.1]).expect_err("one of two").to_string();
    assert!(error.contains("1 loss factors are given for 2 materials"), "{error}");
}
