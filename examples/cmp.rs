//! x
use squealmap::classify::regime;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::{Param, Params};
use squealmap::outcome::*;
use squealmap::response::*;
use squealmap::spec::*;
fn main() {
    let n: u32 = std::env::args().nth(1).unwrap().parse().unwrap();
    let tol: f64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let law = std::env::args().nth(3).unwrap_or("b".into());
    let side = 12;
    let (mut e64, mut e32) = (vec![], vec![]);
    let mut reg = [0; 2];
    let (mut tr, mut t64, mut t32) = (0.0, 0.0, 0.0);
    for v in [0.5, 1.0, 3.0, 6.0] {
        for a in 0..side {
            for b in 0..side {
                let (ms, md) = (0.6 * a as f64 / (side - 1) as f64, 0.6 * b as f64 / (side - 1) as f64);
                let mut p = Params::default();
                p.set(Param::BeltVelocity, v);
                p.set(Param::StartVelocity, 0.3 * v);
                let law = match law.as_str() {
                    "b" => FrictionLaw::Bilinear { mu_s: ms, mu_d: md, knee_velocity: 5.0 },
                    "e" => FrictionLaw::Exponential { mu_s: ms, mu_d: md, stribeck_velocity: 2.0 },
                    _ => FrictionLaw::Rational { mu_s: ms, decay: md },
                };
                let i = Instance { params: p, law, impact_friction: true };
                let plan = Plan {
                    start: StartKind::Kick,
                    settle: Duration::Periods(100.0),
                    measure: Duration::Periods(40.0),
                    steps_per_period: 12,
                    order: 16,
                    tolerance: 1e-11,
                };
                let t = std::time::Instant::now();
                let r = respond(&i, &plan);
                tr += t.elapsed().as_secs_f64();
                let plan = Plan { steps_per_period: n, ..plan };
                let t = std::time::Instant::now();
                let x = squealmap::kernel::response::respond::<f64>(&i, &plan, tol);
                t64 += t.elapsed().as_secs_f64();
                let t = std::time::Instant::now();
                let y = squealmap::kernel::response::respond::<f32>(&i, &plan, tol);
                t32 += t.elapsed().as_secs_f64();
                for (o, e, k) in [(&x, &mut e64, 0), (&y, &mut e32, 1)] {
                    if o.status != r.status {
                        println!("status {ms} {md} {v}: {:?} {:?} k{k}", o.status, r.status);
                        continue;
                    }
                    if r.status != Status::Ok {
                        continue;
                    }
                    let d = |p: Option<f64>, q: Option<f64>| match (p, q) {
                        (Some(p), Some(q)) => (p - q).abs() / q.abs().max(1e-300),
                        (None, None) => 0.0,
                        _ => 9.0,
                    };
                    let da = |p: Option<f64>, q: Option<f64>| match (p, q) {
                        (Some(p), Some(q)) => (p - q).abs(),
                        (None, None) => 0.0,
                        _ => 9.0,
                    };
                    let (ro, so) = regime(o, v, false);
                    let (rr, sr) = regime(&r, v, false);
                    if ro != rr {
                        reg[k] += 1;
                        if k == 0 {
                            println!(
                                "regime {ms:.3} {md:.3} {v}: {ro:?} {rr:?} settled {so} {sr} std {:?} {:?}",
                                o.x2_std, r.x2_std
                            );
                        }
                    }
                    e.push([
                        d(o.x2_std, r.x2_std),
                        d(o.ax_rms, r.ax_rms),
                        d(o.ay_rms, r.ay_rms),
                        d(o.ax_peak, r.ax_peak),
                        d(o.n_peak, r.n_peak),
                        d(o.response_frequency, r.response_frequency),
                        da(o.phase_cycle, r.phase_cycle),
                        da(o.stick, r.stick),
                        da(o.free, r.free),
                        da(o.reverse, r.reverse),
                        d(o.friction_mean, r.friction_mean),
                        d(o.growth_rate_measured, r.growth_rate_measured),
                        da(o.phase_measured, r.phase_measured),
                        d(o.impacts_per_second, r.impacts_per_second),
                    ]);
                }
            }
        }
    }
    for (name, e) in [("f64", &e64), ("f32", &e32)] {
        for (k, label) in [
            "std", "ax", "ay", "axp", "npk", "freq", "phc", "stick", "free", "rev", "fric", "grow", "phm",
            "imp",
        ]
        .iter()
        .enumerate()
        {
            let mut c: Vec<f64> = e.iter().map(|r| r[k]).collect();
            c.sort_by(f64::total_cmp);
            let q = |f: f64| c[((c.len() - 1) as f64 * f) as usize];
            print!("{name} {label} p50 {:.1e} p90 {:.1e} p99 {:.1e} | ", q(0.5), q(0.9), q(0.99));
        }
        println!();
    }
    println!(
        "regimes {reg:?} of {}; ref {:.1}/s f64 {:.1}/s f32 {:.1}/s",
        e64.len(),
        e64.len() as f64 / tr,
        e64.len() as f64 / t64,
        e64.len() as f64 / t32
    );
}
