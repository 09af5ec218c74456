//! The twin of the response kernel against the reference: is the method right, and is f32 enough?

use crate::common::{bilinear, paper, plan};
use crate::twin::outcomes as twin;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::reference::respond::respond;
use squealmap::engine::regime::regime;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// 5 × 5 friction coefficients at four velocities, or the same numbers in another law.
pub(crate) fn scenes(law: fn(f64, f64) -> FrictionLaw) -> Vec<Instance> {
    let mut scenes = Vec::new();
    for velocity in [0.5, 1.0, 3.0, 6.0] {
        for i in 0..25 {
            let (mu_s, mu_d) = (0.15 * f64::from(i / 5), 0.15 * f64::from(i % 5));
            let mut instance = Instance { law: law(mu_s, mu_d), ..paper(0.1, 0.1, velocity) };
            instance.params.set(Param::StartVelocity, 0.3 * velocity);
            scenes.push(instance);
        }
    }
    scenes
}

pub(crate) fn periods() -> Plan {
    Plan { settle: Duration::Periods(60.0), measure: Duration::Periods(40.0), ..plan(1.0, 1.0, 12) }
}

/// Relative differences of the amplitudes, and how many regimes differ.
pub(crate) fn compare(
    law: fn(f64, f64) -> FrictionLaw,
    run: fn(&[Instance], &Plan) -> Vec<Outcome>,
) -> (Vec<f64>, usize) {
    let (mut errors, mut regimes) = (Vec::new(), 0);
    let scenes = scenes(law);
    for (instance, other) in scenes.iter().zip(run(&scenes, &periods())) {
        let reference = respond(instance, &periods());
        assert_eq!(other.status, reference.status, "{instance:?}");
        if reference.status != Status::Ok {
            continue;
        }
        assert!((other.simulated_time / reference.simulated_time - 1.0).abs() < 1e-12);
        let velocity = instance.params.require(Param::BeltVelocity);
        regimes += usize::from(regime(&other, velocity, false).0 != regime(&reference, velocity, false).0);
        // Without friction the mean friction coefficient is 0 but for rounding.
        for (a, b, floor) in [
            (other.x2_std, reference.x2_std, 1e-12),
            (other.ax_rms, reference.ax_rms, 1e-12),
            (other.ay_rms, reference.ay_rms, 1e-12),
            (other.n_peak, reference.n_peak, 1e-12),
            (other.friction_mean, reference.friction_mean, 1e-2),
            (other.impacts_per_second, reference.impacts_per_second, 1.0),
        ] {
            let (a, b) = (a.expect("a value"), b.expect("a value"));
            // A NaN must not pass for a small difference.
            errors.push(if a.is_finite() { (a - b).abs() / b.abs().max(floor) } else { f64::INFINITY });
        }
    }
    errors.sort_by(f64::total_cmp);
    (errors, regimes)
}

fn agree(law: fn(f64, f64) -> FrictionLaw, run: fn(&[Instance], &Plan) -> Vec<Outcome>) {
    let (errors, regimes) = compare(law, run);
    let quantile = |share: usize| errors[(errors.len() - 1) * share / 100];
    assert!(errors.len() > 400 && regimes <= 1, "{} numbers, {regimes} regimes differ", errors.len());
    assert!(quantile(50) < 1e-4 && quantile(99) < 2e-3, "{:e} {:e}", quantile(50), quantile(99));
}

#[test]
fn f32_and_f64_agree_with_the_reference() {
    agree(bilinear, twin::<f64>);
    agree(bilinear, twin::<f32>);
}

#[test]
fn smooth_laws_agree_with_the_reference() {
    agree(|mu_s, mu_d| FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: 2.0 }, twin::<f32>);
    agree(|mu_s, decay| FrictionLaw::Rational { mu_s, decay }, twin::<f32>);
}

#[test]
fn the_comparer_sees_a_wrong_scene() {
    // Planted fault: the twin integrates another normal stiffness.
    let wrong = |instances: &[Instance], plan: &Plan| {
        let mut instances = instances.to_vec();
        for one in &mut instances {
            one.params.set(Param::K2, 1.02e5);
        }
        twin::<f32>(&instances, plan)
    };
    let (errors, _) = compare(bilinear, wrong);
    assert!(errors[(errors.len() - 1) * 99 / 100] > 2e-3);
}
