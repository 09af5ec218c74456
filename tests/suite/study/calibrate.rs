//! Models made from what an impact test and the onset of squeal tell: known ones are found again.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;
use std::path::Path;

use crate::common::{instance, near};
use crate::study::laboratory::coalescence;
use crate::study::strokes::Random;
use nalgebra::DMatrix;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::{Param, Params};
use squealmap::study::calibrate::sweep::{Plane, sweep_toml};
use squealmap::study::calibrate::{Calibrated, Fault, Measured, calibrate};
use squealmap::sweep::spec::Spec;

/// A model of the given masses, stiffnesses, dampers and inclination.
fn model(values: [f64; 7]) -> Instance {
    let [m1, m2, k1, k2, c1, c2, theta] = values;
    let params = [
        (Param::M1, m1),
        (Param::M2, m2),
        (Param::K1, k1),
        (Param::K2, k2),
        (Param::C1, c1),
        (Param::C2, c2),
        (Param::Theta, theta),
        (Param::FExt, 17.0),
        (Param::BeltVelocity, 0.05),
    ];
    instance(FrictionLaw::Constant { mu_s: 0.0, mu_d: 0.0 }, &params)
}

/// Frequencies (Hz) and damping ratios without friction, from the matrices of docs/physics.md as a system of first order.
fn impact_test(values: [f64; 7]) -> ([f64; 2], [f64; 2]) {
    let [m1, m2, k1, k2, c1, c2, theta] = values;
    let (s, c) = theta.sin_cos();
    let mass = [m2 + m1 * c * c, m1];
    let of = |tangential: f64, normal: f64| {
        [[tangential * c * c + normal * s * s, -normal * s], [-normal * s, normal]]
    };
    let (k, d) = (of(k1, k2), of(c1, c2));
    // In a unit of time in which all entries are of one size.
    let rate = (k[0][0] / mass[0]).sqrt();
    let mut system = DMatrix::<f64>::zeros(4, 4);
    for i in 0..2 {
        system[(i, i + 2)] = 1.0;
        for j in 0..2 {
            system[(i + 2, j)] = -k[i][j] / mass[i] / (rate * rate);
            system[(i + 2, j + 2)] = -d[i][j] / mass[i] / rate;
        }
    }
    let all = nalgebra::linalg::Schur::try_new(system, 1e-15, 10_000).unwrap().complex_eigenvalues();
    let mut above: Vec<_> = all.iter().filter(|z| z.im > 0.0).map(|z| rate * z).collect();
    above.sort_by(|a, b| a.im.total_cmp(&b.im));
    ([0, 1].map(|i| above[i].im / TAU), [0, 1].map(|i| -above[i].re / above[i].norm()))
}

fn measured(values: [f64; 7], normal_above: bool) -> Measured {
    let [m1, m2, ..] = values;
    let (frequencies, damping_ratios) = impact_test(values);
    Measured {
        frequencies,
        damping_ratios,
        critical_friction: coalescence(&model(values)),
        mass: m1 + m2,
        mass_ratio: m2 / m1,
        load: 17.0,
        normal_above,
    }
}

/// The values of a calibrated model.
fn values(found: &Calibrated) -> [f64; 7] {
    [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2, Param::Theta]
        .map(|param| found.params.require(param))
}

/// Thirty drawn models, with the normal mode above and below the tangential one, damped with 0.02 to 2 %.
#[test]
fn known_models_are_found_again() {
    let mut random = Random::new(11);
    let names = ["m1", "m2", "k1", "k2", "c1", "c2", "theta"];
    let mut tried = [0, 0];
    while tried.iter().sum::<usize>() < 30 {
        let m1 = random.decades(1e-3, 3.0);
        let m2 = m1 * random.between(0.05, 0.3);
        let omega = TAU * random.decades(30.0, 15e3);
        let gap = random.between(0.01, 0.05) * if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let damper = |mass: f64, ratio: f64| 2.0 * ratio * mass * omega;
        let ratio = random.decades(2e-4, 2e-2);
        let values_in = [
            m1,
            m2,
            (m1 + m2) * omega * omega,
            m1 * omega * omega * (1.0 + gap),
            damper(m1 + m2, ratio),
            damper(m1, ratio * random.between(0.8, 1.2)),
            random.between(0.0005, 0.2) * gap.abs(),
        ];
        let asked = measured(values_in, gap > 0.0);
        if asked.critical_friction > 1.0 {
            continue;
        }
        tried[usize::from(gap > 0.0)] += 1;
        let found = calibrate(&asked).unwrap_or_else(|why| panic!("{values_in:?}: {why}"));
        for ((name, found), expected) in names.into_iter().zip(values(&found)).zip(values_in) {
            near(name, found, expected, 1e-5 * expected);
        }
        near("friction", found.critical_friction, asked.critical_friction, 1e-7);
    }
    assert!(tried.iter().all(|count| *count >= 5), "{tried:?}");
}

/// Close modes that are damped very differently: an impact test on what is found has all of it. At the steepest inclination they
/// have no model.
#[test]
fn unlike_dampings_have_their_model() {
    for (frequencies, damping_ratios, critical_friction) in [
        ([131.053, 131.462], [0.005_323, 0.014_92], 0.8691),
        ([131.053, 131.462], [0.014_92, 0.005_323], 0.8691),
        ([14_145.9, 14_872.9], [0.0001, 0.1], 0.3),
        // Steeper than the distance of the modes without damping allows.
        ([14_200.0, 14_242.6], [0.0147, 0.0147], 0.1271),
        ([14_200.0, 14_700.0], [0.0145, 0.0145], 0.05),
        ([14_200.0, 14_370.4], [0.022, 0.0917], 0.1),
        ([14_145.9, 14_177.5], [0.0243, 0.0754], 0.8),
    ] {
        let asked = Measured {
            frequencies,
            damping_ratios,
            critical_friction,
            mass: 0.08489,
            mass_ratio: 0.18 / 2.12,
            load: 4.0,
            normal_above: true,
        };
        let found = calibrate(&asked).unwrap_or_else(|why| panic!("{why}"));
        let (made, damped) = impact_test(values(&found));
        for mode in 0..2 {
            near("frequency", made[mode], frequencies[mode], 1e-9 * frequencies[mode]);
            near("damping ratio", damped[mode], damping_ratios[mode], 1e-7);
        }
        let with = |mu: f64| {
            let law = FrictionLaw::Constant { mu_s: mu, mu_d: mu };
            let found = Instance { law, ..model(values(&found)) };
            squealmap::model::linear::analyse(&found).1.unwrap().growth_rate
        };
        assert!(with(0.999 * critical_friction) < 0.0 && with(1.001 * critical_friction) > 0.0);
    }
}

/// The model is another one if any of what was measured changes: none of it is passed over.
#[test]
fn each_measurement_counts() {
    let at = [0.00497, 0.00042, 4.26e7, 4.34e7, 14.0, 13.0, 0.005];
    let asked = measured(at, true);
    let base = values(&calibrate(&asked).unwrap());
    let moved = |change: &dyn Fn(&mut Measured)| {
        let mut other = asked;
        change(&mut other);
        let found = values(&calibrate(&other).unwrap());
        found.iter().zip(base).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    };
    assert!(moved(&|m| m.frequencies[0] *= 1.001) > 1e-3);
    assert!(moved(&|m| m.frequencies[1] *= 1.001) > 1e-3);
    assert!(moved(&|m| m.damping_ratios[0] *= 1.05) > 1e-2);
    assert!(moved(&|m| m.damping_ratios[1] *= 1.05) > 1e-2);
    assert!(moved(&|m| m.critical_friction *= 1.05) > 1e-2);
    assert!(moved(&|m| m.mass *= 1.05) > 1e-2);
    assert!(moved(&|m| m.mass_ratio *= 1.05) > 1e-2);
}

/// What no model has is told: which limits there are, and what to do.
#[test]
fn what_no_model_has_is_told() {
    let asked = measured([0.00497, 0.00042, 4.26e7, 4.34e7, 14.0, 13.0, 0.005], true);
    let why = |asked: Measured| calibrate(&asked).unwrap_err();
    let [first, second] = asked.frequencies;
    assert!(matches!(why(Measured { frequencies: [second, first], ..asked }), Fault::NotRising { .. }));
    let far = Measured { frequencies: [first, 1.5 * second], critical_friction: 0.05, ..asked };
    let Fault::Coalescence { low, wanted, .. } = why(far) else { panic!() };
    assert!(low > wanted, "{low}");
    let unlike = Measured { damping_ratios: [0.00225, 0.000_418], critical_friction: 0.0123, ..asked };
    let unlike = Measured { frequencies: [14_145.9, 14_387.3], ..unlike };
    let Fault::Coalescence { low, .. } = why(unlike) else { panic!("{}", why(unlike)) };
    assert!(
        low > 0.0123 && calibrate(&Measured { critical_friction: 1.01 * low, ..unlike }).is_ok(),
        "{low}"
    );
    let apart = why(Measured { frequencies: [100.0, 14_200.0], ..asked });
    assert!(
        apart
            .to_string()
            .starts_with("modes at 100 and 14200 Hz do not coalesce at any friction coefficient up to 5"),
        "{apart}"
    );
}

/// The sweep file of a model is one, and its instances have the model's parameters.
#[test]
fn the_sweep_file_is_one() {
    let asked = measured([0.00497, 0.00042, 4.26e7, 4.34e7, 14.0, 13.0, 0.005], true);
    let found = calibrate(&asked).unwrap();
    let plane = Plane::Friction { knee: 0.05, velocities: vec![0.01, 0.02, 0.05] };
    let spec = Spec::parse(&sweep_toml(&found, &asked, &plane), "calibrated.toml", Path::new(".")).unwrap();
    assert_eq!(spec.grid.len(), 61 * 61 * 3);
    let instance = spec.instance(0);
    let params: &Params = &instance.params;
    for param in [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2, Param::Theta, Param::FExt]
    {
        assert_eq!(params.get(param), found.params.get(param), "{}", param.info().name);
    }
}
