//! Timing.
use squealmap::model::friction::FrictionLaw;
use squealmap::model::{Param, Params};
use squealmap::response::*;
use squealmap::spec::*;
fn main() {
    let mut p = Params::default();
    let mode = std::env::args().nth(1).unwrap();
    let (ms, md, v): (f64, f64, f64) = match mode.as_str() {
        "ns" => (0.15, 0.05, 3.0),
        "mc" => (0.4, 0.4, 3.0),
        "st" => (0.1, 0.1, 3.0),
        _ => (0.4, 0.3, 3.0),
    };
    p.set(Param::BeltVelocity, v);
    let i = Instance {
        params: p,
        law: FrictionLaw::Bilinear { mu_s: ms, mu_d: md, knee_velocity: 5.0 },
        impact_friction: true,
    };
    let plan = Plan {
        start: StartKind::Kick,
        settle: Duration::Seconds(6.0),
        measure: Duration::Seconds(3.0),
        steps_per_period: 12,
        order: 14,
        tolerance: 1e-9,
    };
    let n: u32 = 100;
    let t = std::time::Instant::now();
    let mut steps = 0;
    for _ in 0..n {
        steps += std::hint::black_box(respond(std::hint::black_box(&i), &plan)).steps;
    }
    let e = t.elapsed();
    println!(
        "{mode}: {:.3} ms per instance, {:.0} ns per step",
        e.as_secs_f64() * 1e3 / n as f64,
        e.as_nanos() as f64 / steps as f64
    );
}
