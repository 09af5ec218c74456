//! θ = 0: the engine steps the single mass on a belt by less code, to the same bits.

use std::sync::atomic::AtomicBool;

use crate::common::{close, instance, plan};
use crate::instances::Uniform;
use squealmap::backend::cpu::outcomes;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::outcome::{Outcome, Status};
use squealmap::response::Plan;
use squealmap::simd::Lanes;
use squealmap::spec::{Duration, Instance};

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

/// An inclination too small for any number to notice takes the general way.
fn same_bits<T: Lanes>(epsilon: f64) {
    let (single, general) = (run::<T>(&instances(0.0)), run::<T>(&instances(1e-300)));
    let mut stuck = 0;
    for (index, (a, b)) in single.iter().zip(&general).enumerate() {
        assert_eq!(a.status, Status::Ok, "{index}");
        // The largest of many samples of one constant.
        close("peak of N", a.n_peak.expect("a value"), b.n_peak.expect("a value"), 4.0 * epsilon);
        // y1 has never moved, or by 1e-300: its phase then has a value.
        assert!(
            a.ay_peak == Some(0.0) && b.ay_peak < Some(1e-290),
            "{index}: {:?} {:?}",
            a.ay_peak,
            b.ay_peak
        );
        let b = Outcome { n_peak: a.n_peak, ay_peak: a.ay_peak, ..*b };
        assert_eq!(
            *a,
            Outcome { phase_cycle: a.phase_cycle, phase_measured: a.phase_measured, ..b },
            "{index}"
        );
        stuck += usize::from(a.stick > Some(0.01));
    }
    assert!(stuck > 50, "{stuck} of 200 stick");
}

#[test]
fn f64_is_that_of_the_general_case_in_every_bit() {
    same_bits::<f64>(f64::EPSILON);
}

#[test]
fn f32_is_that_of_the_general_case_in_every_bit() {
    same_bits::<f32>(f64::from(f32::EPSILON));
}
