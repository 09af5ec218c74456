//! Points per second of the eigenvalue analysis and instances per second of the transient, reference and CPU
//! engine, on one core. `cargo bench --bench core` prints both;
//! `docs/performance.md` says what was measured.

use std::hint::black_box;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::engine::reference::respond::respond;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::linear::analyse;
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params};

/// The paper's model over a grid of `side`² friction coefficients at 3 m/s.
fn plane(side: usize) -> Vec<Instance> {
    let coefficient = |k: usize| 0.6 * k as f64 / (side - 1) as f64;
    let instance = |mu_s, mu_d| {
        let mut params = Params::default();
        params.set(Param::BeltVelocity, 3.0);
        let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 };
        Instance { params, law, impact_friction: true, motion: Motion::Ramp, modal: None }
    };
    (0..side * side).map(|k| instance(coefficient(k / side), coefficient(k % side))).collect()
}

fn linear(criterion: &mut Criterion) {
    let instances = plane(100);
    let mut group = criterion.benchmark_group("linear");
    group.throughput(Throughput::Elements(instances.len() as u64));
    group.bench_function("analyse", |bencher| {
        bencher.iter(|| {
            for instance in &instances {
                black_box(analyse(black_box(instance)));
            }
        });
    });
    group.finish();
}

fn response(criterion: &mut Criterion) {
    let instances = plane(12);
    let plan = Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(100.0),
        settle_limit: None,
        hunts: false,
        measure: Duration::Periods(40.0),
        steps_per_period: 12,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    };
    let mut group = criterion.benchmark_group("response");
    group.throughput(Throughput::Elements(instances.len() as u64));
    group.sample_size(10);
    group.bench_function("140 periods", |bencher| {
        bencher.iter(|| {
            for instance in &instances {
                black_box(respond(black_box(instance), &plan));
            }
        });
    });
    group.finish();
}

fn lanes(criterion: &mut Criterion) {
    let instances = plane(32);
    let mut group = criterion.benchmark_group("lanes");
    group.throughput(Throughput::Elements(instances.len() as u64));
    group.sample_size(10);
    for steps_per_period in [12, 5] {
        let plan = Plan {
            start: StartKind::Kick,
            settle: Duration::Periods(100.0),
            settle_limit: None,
            hunts: false,
            measure: Duration::Periods(40.0),
            steps_per_period,
            method: Method::Taylor,
            order: REFERENCE_ORDER,
            tolerance: STEP_TOLERANCE,
        };
        let never = AtomicBool::new(false);
        group.bench_function(format!("f32, 140 periods of {steps_per_period} steps"), |bencher| {
            bencher.iter(|| outcomes::<f32>(black_box(&instances), &plan, &never));
        });
        group.bench_function(format!("f64, 140 periods of {steps_per_period} steps"), |bencher| {
            bencher.iter(|| outcomes::<f64>(black_box(&instances), &plan, &never));
        });
    }
    group.finish();
}

criterion_group!(benches, linear, response, lanes);
criterion_main!(benches);
