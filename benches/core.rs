//! Points per second of the eigenvalue analysis and instances per second of the transient, reference and CPU
//! engine, per second of processor time: the median of nine rounds. `cargo bench --bench core [-- NAME]` prints them;
//! `docs/performance.md` says what was measured.

use std::hint::black_box;
use std::sync::atomic::AtomicBool;

use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::linear::solved;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::engine::reference::respond::respond;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::linear::{Preparation, analyse, prepare};
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params};
use squealmap::sweep::accuracy::clock::Clock;

/// The paper's model over a grid of `side`² friction coefficients at 3 m/s.
fn plane(side: usize) -> Vec<Instance> {
    let coefficient = |k: usize| 0.6 * k as f64 / (side - 1) as f64;
    let instance = |mu_s, mu_d| {
        let mut params = Params::default();
        params.set(Param::BeltVelocity, 3.0);
        let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 };
        Instance { params, law, impact_friction: true, motion: Motion::Ramp, heating: None, modal: None }
    };
    (0..side * side).map(|k| instance(coefficient(k / side), coefficient(k % side))).collect()
}

/// A kick, and 140 periods of so many steps.
fn plan(steps_per_period: u32) -> Plan {
    Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(100.0),
        settle_limit: None,
        hunts: false,
        measure: Duration::Periods(40.0),
        steps_per_period,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    }
}

/// Prints how many items a second of processor time does, if it is asked for: the median of nine rounds of at least a second.
fn report(name: &str, items: usize, work: impl Fn()) {
    let asked: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    if !asked.is_empty() && !asked.iter().any(|word| name.contains(word.as_str())) {
        return;
    }
    let mut rates: Vec<f64> = (0..9)
        .map(|_| {
            let (clock, mut rounds) = (Clock::start(), 0);
            while clock.worked() < 1.0 {
                work();
                rounds += 1;
            }
            (items * rounds) as f64 / clock.worked()
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    println!("{name:40} {:.4e} per second, {:.4e} to {:.4e}", rates[4], rates[0], rates[8]);
}

fn lanes<T: Lanes>(name: &str) {
    let (instances, never) = (plane(32), AtomicBool::new(false));
    for steps in [12, 5] {
        let plan = plan(steps);
        report(&format!("lanes {name}, 140 periods of {steps} steps"), instances.len(), || {
            black_box(outcomes::<T>(black_box(&instances), &plan, &never).is_some());
        });
    }
}

fn main() {
    let instances = plane(100);
    report("linear, in the lanes", instances.len(), || {
        for instances in instances.chunks(500) {
            let prepared: Vec<Preparation> = instances.iter().map(prepare).collect();
            black_box(solved(black_box(&prepared)));
        }
    });
    report("linear, one by one", instances.len(), || {
        for instance in &instances {
            black_box(analyse(black_box(instance)));
        }
    });
    let (instances, plan) = (plane(12), plan(12));
    report("response, 140 periods", instances.len(), || {
        for instance in &instances {
            black_box(respond(black_box(instance), &plan));
        }
    });
    lanes::<f32>("f32");
    lanes::<f64>("f64");
}
