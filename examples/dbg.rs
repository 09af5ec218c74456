//! x
use squealmap::kernel::{lane::Lane, response::*, scene::Scene as W};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::{Param, Params};
use squealmap::outcome::Status;
use squealmap::response::*;
use squealmap::spec::*;
fn main() {
    let mut p = Params::default();
    let v = 0.5;
    p.set(Param::BeltVelocity, v);
    p.set(Param::StartVelocity, 0.3 * v);
    let law =
        FrictionLaw::Bilinear { mu_s: 0.49090909090909085, mu_d: 0.10909090909090909, knee_velocity: 5.0 };
    let i = Instance { params: p, law, impact_friction: true };
    let plan = Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(100.0),
        measure: Duration::Periods(40.0),
        steps_per_period: 12,
        order: 16,
        tolerance: 1e-11,
    };
    let s = Scene::new(&i, plan.start).unwrap();
    let w = instance_words(&s, &plan, 2);
    let sc: W<f32> = W::read(law_of(i.law.kind()), 2, &w);
    let mut l = Lane::new(&sc);
    while l.status == Status::Unwritten {
        l.iterate(&sc, 2e-4);
        if l.at_once > 0 && l.at_once < 8 {
            println!(
                "{} {} rest {} contact {} piece {} dis {} at_once {} body {:?} V {}",
                l.segment, l.index, l.rest, l.contact, l.piece, l.disarmed, l.at_once, l.body, sc.v0
            );
        }
    }
    println!("{:?}", l.status);
}
