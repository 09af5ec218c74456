//! θ = 0: the engine steps the single mass on a belt by less code, and by fewer steps while it sticks.

use std::sync::atomic::AtomicBool;

use crate::common::{instance, plan};
use crate::instances::Uniform;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// Single masses with bilinear and constant laws, some with a ramp, inclined by `theta`.
fn instances(theta: f64) -> Vec<Instance> {
    let mut u = Uniform(29);
    (0..200)
        .map(|k| {
            let (mu_s, mu_d) = (0.3 + 0.5 * u.next(), 0.3 * u.next());
            let law = match k % 2 {
                0 => FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 0.3 + 3.0 * u.next() },
                _ => FrictionLaw::Constant { mu_s, mu_d },
            };
            let mut one =
                instance(law, &[(Param::Theta, theta), (Param::BeltVelocity, 0.2 + 2.0 * u.next())]);
            one.params.set(Param::StartVelocity, 2.0 * u.next() - 1.0);
            if k % 3 == 0 {
                one.params.set(Param::BeltVelocityEnd, 0.1);
                one.params.set(Param::RampDuration, 1.0);
            }
            one
        })
        .collect()
}

fn run<T: Lanes>(instances: &[Instance]) -> Vec<Outcome> {
    let plan =
        Plan { settle: Duration::Periods(20.0), measure: Duration::Periods(20.0), ..plan(1.0, 1.0, 8) };
    outcomes::<T>(instances, &plan, &AtomicBool::new(false)).expect("nobody stops it")
}

/// The largest relative difference of an observable, and the steps taken, of two ways to the same.
fn apart(one: &[Outcome], other: &[Outcome]) -> (f64, [u64; 2]) {
    let mut worst = 0.0_f64;
    for (index, (a, b)) in one.iter().zip(other).enumerate() {
        assert_eq!([a.status, b.status], [Status::Ok; 2], "{index}");
        // y1 has never moved, or by 1e-300.
        assert!(a.ay_peak == Some(0.0) && b.ay_peak < Some(1e-290), "{index}: {a:?} {b:?}");
        let of = |o: &Outcome| {
            [
                o.x2_mean,
                o.x2_std,
                o.ax_rms,
                o.friction_mean,
                o.n_peak,
                o.response_frequency,
                o.stick,
                o.reverse,
            ]
        };
        for (a, b) in of(a).into_iter().zip(of(b)) {
            let (a, b) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
            worst = worst.max((a - b).abs() / a.abs().max(1e-3));
        }
    }
    (worst, [one, other].map(|all| all.iter().map(|outcome| outcome.steps).sum()))
}

/// An inclination too small for any number to notice takes the general way, whose steps are as short in stick.
fn agrees<T: Lanes>(bound: f64) {
    let (single, general) = (run::<T>(&instances(0.0)), run::<T>(&instances(1e-300)));
    let (worst, [few, many]) = apart(&single, &general);
    assert!(worst < bound, "{worst:e}");
    assert!(few < many, "{few} {many} steps");
    let stuck = single.iter().filter(|outcome| outcome.stick > Some(0.01)).count();
    assert!(stuck > 50, "{stuck} of 200 stick");
    // Planted fault: another limit of stick.
    let mut planted = instances(0.0);
    for instance in &mut planted {
        if let FrictionLaw::Bilinear { mu_s, .. } | FrictionLaw::Constant { mu_s, .. } = &mut instance.law {
            *mu_s *= 1.001;
        }
    }
    assert!(apart(&run::<T>(&planted), &general).0 > 2.0 * bound);
}

#[test]
fn f64_is_that_of_the_general_case() {
    agrees::<f64>(1e-5);
}

#[test]
fn f32_is_that_of_the_general_case() {
    agrees::<f32>(1e-4);
}
