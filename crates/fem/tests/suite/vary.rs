//! Modes over parameters that are in the matrices, against closed forms.

use std::f64::consts::FRAC_PI_2;

use faer::c64;
use squealmap_fem::assembly::{Model, Penalty};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::vary::{Parameter, Setup, vary};

use crate::cases::{layer, pin};

/// The layer of the exact eigenvalues, pressed on the plane by a prescribed displacement of its upper side.
fn pressed(n: usize) -> Setup {
    let mut model = layer::model(Kind::Hex20, n).expect("the layer");
    let above = model.mesh.node_set("y1").expect("a side").to_vec();
    model.supports.prescribe(&above, 1, -1e-5);
    let faces = model.mesh.face_set("y0").expect("a side").to_vec();
    Setup { model, faces, mu: 0.2, ..Setup::default() }
}

/// λ = c_s/h (−ln((Z + c)/(Z − c))/2 + iπ/2) with Z = ρ c_s and c = p0 μ'(V), p0 = (λ + 2G) ε: over the slope, and over the load.
#[test]
fn slope_and_load_damp_as_they_should() {
    let (height, shear, poisson, n) = (0.01, 210e9 / 2.6, 0.3, 6.0_f64);
    let speed = f64::sqrt(shear / 7800.0);
    let pressure = shear * 2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson) * 1e-5 / height;
    let exact = |slope: f64| {
        let part = pressure * slope / (7800.0 * speed);
        speed / height * c64::new(-0.5 * ((1.0 + part) / (1.0 - part)).ln(), FRAC_PI_2)
    };
    // Quadratic elements: (k h)⁴/1440.
    let bound = 1.5 * (FRAC_PI_2 / n).powi(4) / 1440.0;
    let slope = 0.02;
    let slopes = [-slope, 0.0, slope, 2.0 * slope];
    let over_slope = vary(&pressed(6), Parameter::Slope, &slopes, 1, 1e-9).expect("modes");
    let setup = Setup { slope, ..pressed(6) };
    let over_load = vary(&setup, Parameter::Load, &[0.5, 1.0, 2.0], 1, 1e-9).expect("modes");
    let wanted = slopes.into_iter().chain([0.5 * slope, slope, 2.0 * slope]);
    for (state, slope) in over_slope[0].states.iter().chain(&over_load[0].states).zip(wanted) {
        let error = (state.lambda - exact(slope)).norm() / state.lambda.norm();
        println!("{slope} s/m: {}, error {error:e}", state.lambda);
        assert!(error < bound && state.residual <= 1e-9, "{slope}: {} {}", state.lambda, exact(slope));
    }
    assert!(exact(slope).re < -1000.0);
}

/// All eigenvalues grow with the root of the moduli, also where a mode has lost its stability, and in one large step as in small ones:
/// modes move past the old places of others, and are followed by their shapes.
#[test]
fn stiffness_moves_all_modes_alike() {
    for (mu, factors) in [(0.45, [1.0, 1.5, 4.0]), (0.4, [1.0, 4.0, 100.0]), (0.4, [0.01, 1.0, 4.0])] {
        stiffness_moves_all_modes(mu, factors);
    }
}

fn stiffness_moves_all_modes(mu: f64, factors: [f64; 3]) {
    let setup = Setup { model: pin::model(Kind::Hex20, 1).expect("the pin"), mu, ..Setup::default() };
    let modes = vary(&setup, Parameter::Stiffness(0), &factors, 7, 1e-8).expect("modes");
    assert_eq!(modes.len(), 7);
    let plain = vary(&setup, Parameter::Friction, &[mu], 7, 1e-8).expect("modes");
    for (a, b) in modes.iter().zip(&plain) {
        let expected = b.states[0].lambda * factors[0].sqrt();
        assert!((a.states[0].lambda - expected).norm() < 1e-9 * expected.norm());
    }
    assert!(modes.iter().any(|mode| mode.states[0].lambda.re > 100.0 * factors[0].sqrt()));
    for mode in &modes {
        for (state, factor) in mode.states.iter().zip(factors) {
            let expected = mode.states[0].lambda * f64::sqrt(factor / factors[0]);
            assert!((state.lambda - expected).norm() < 1e-6 * expected.norm(), "{factor}: {mode:?}");
        }
    }
}

/// Two clamped blocks that know nothing of each other: the modes of one move by the root of its modulus, past those of the other, also
/// where just as many modes are followed as it has below them.
#[test]
fn a_mode_is_followed_past_others() {
    let block = |origin: f64, height: f64| {
        let (origin, size) = ([origin, 0.0, 0.0], [0.01, 0.012, height]);
        Block { origin, size, cells: [1.into(), 1.into(), 3.into()], kind: Kind::Hex20 }.mesh()
    };
    let mut model = Model { mesh: block(0.0, 0.05).expect("a block"), ..Model::default() };
    model.materials = vec![crate::cases::steel(); 2];
    model.mesh.add(block(0.02, 0.04).expect("a block"), "other.", 1);
    for below in ["z0", "other.z0"] {
        let nodes = model.mesh.node_set(below).expect("a side").to_vec();
        model.supports.clamp(&nodes);
    }
    let setup = Setup { model, ..Setup::default() };
    let modes = vary(&setup, Parameter::Stiffness(0), &[1.0, 9.0], 2, 1e-8).expect("modes");
    for mode in &modes {
        let [before, after] = [0, 1].map(|i| mode.states[i].lambda);
        assert!((after - before * 3.0).norm() < 1e-6 * after.norm(), "{before} {after}");
    }
    let others = vary(&setup, Parameter::Stiffness(0), &[9.0], 2, 1e-8).expect("modes");
    assert!(others[1].states[0].lambda.im < modes[0].states[1].lambda.im, "the other block's are below");
}

/// With C = f α M each θ = −λ² of the undamped body becomes the roots of λ² + f α λ + θ = 0.
#[test]
fn damping_moves_each_mode_by_its_quadratic_equation() {
    let alpha = 500.0;
    let mut setup =
        Setup { model: pin::model(Kind::Hex20, 1).expect("the pin"), mu: 0.3, ..Setup::default() };
    for material in &mut setup.model.materials {
        *material = material.clone().damped(alpha, 0.0);
    }
    let modes = vary(&setup, Parameter::Damping, &[0.0, 1.0, 6.0], 5, 1e-9).expect("modes");
    for mode in &modes {
        let theta = -(mode.states[0].lambda * mode.states[0].lambda).re;
        for (state, factor) in mode.states.iter().zip([0.0, 1.0, 6.0]) {
            let half: f64 = factor * alpha / 2.0;
            let exact = c64::new(-half, (theta - half * half).sqrt());
            assert!(
                (state.lambda - exact).norm() < 1e-7 * exact.norm(),
                "{factor}: {} {exact}",
                state.lambda
            );
        }
    }
}

/// A stiffer contact comes to the tied one as 1/k.
#[test]
fn contact_stiffness_comes_to_the_tied_contact() {
    let mut setup =
        Setup { model: pin::model(Kind::Hex20, 1).expect("the pin"), mu: 0.2, ..Setup::default() };
    let tied = vary(&setup, Parameter::Friction, &[0.2], 5, 1e-9).expect("modes");
    let error = vary(&setup, Parameter::ContactStiffness, &[1e16], 5, 1e-9).expect_err("tied").to_string();
    assert!(error.contains("tied"), "{error}");
    let faces = setup.model.mesh.face_set("pin.z0").expect("a side").to_vec();
    setup.model.penalty = Some(Penalty { stiffness: 1.0, faces });
    let found = vary(&setup, Parameter::ContactStiffness, &[1e16, 1e17], 5, 1e-9).expect("modes");
    for (mode, tied) in found.iter().zip(&tied) {
        let apart = [0, 1].map(|i| (mode.states[i].lambda - tied.states[0].lambda).norm());
        assert!((8.0..12.0).contains(&(apart[0] / apart[1])), "{apart:?}");
    }
}

#[test]
fn values_that_make_no_sense_are_named() {
    let setup = Setup { model: pin::model(Kind::Hex8, 1).expect("the pin"), ..Setup::default() };
    for (parameter, value, words) in [
        (Parameter::Stiffness(3), 1.0, "material 3 is to be varied, but there are only 1"),
        (Parameter::Stiffness(0), -1.0, "multiplied by -1, which must be above 0"),
        (Parameter::Slope, 0.1, "no load presses"),
    ] {
        let error = vary(&setup, parameter, &[value], 3, 1e-6).expect_err("no sense").to_string();
        assert!(error.contains(words), "{error}");
    }
}
