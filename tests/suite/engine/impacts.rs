//! Impacts in the lanes of the CPU engine against those of the model, whose cases are solved by hand in `observables`.

use std::f64::consts::FRAC_PI_2;

use pulp::{Arch, Simd, WithSimd};

use crate::common::plan;
use crate::instances::{Uniform, moving};
use squealmap::engine::lanes::ORDER;
use squealmap::engine::lanes::block::Block;
use squealmap::engine::lanes::contact::FREE;
use squealmap::engine::lanes::impacts::impact;
use squealmap::engine::lanes::job::Job;
use squealmap::engine::lanes::scalar::Scalar;
use squealmap::engine::lanes::vector::Vector;
use squealmap::engine::method::pace::Turns;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;

/// Velocities of the body and of the belt, scaled.
#[derive(Clone, Copy)]
struct Moment {
    vx: f64,
    vy: f64,
    belt: f64,
}

/// The impacts of some instances, as many as lanes at a time: `ẋ2` and `ẏ2` afterwards, `None` where they are not unique.
struct InLanes<'a> {
    jobs: &'a [(Job<f64>, Moment)],
    made: Vec<Option<[f64; 2]>>,
}

impl WithSimd for &mut InLanes<'_> {
    type Output = ();
    fn with_simd<S: Simd>(self, simd: S) {
        for jobs in self.jobs.chunks(<f64 as Scalar<S>>::LANES) {
            let mut block: Block<S, f64> = Block::idle(simd, jobs[0].0.law());
            for (lane, (job, moment)) in jobs.iter().enumerate() {
                let mut state = job.state;
                state.contact = FREE;
                state.body.v = [moment.vx, moment.vy, 0.0];
                block.load_scene(lane, &job.constants, &job.words);
                block.load_state(lane, &state, &job.words);
                block.belt.set(lane, moment.belt);
            }
            let after = impact(&block);
            let ill_posed = after.ill_posed.select(Vector::splat(simd, 1.0), Vector::splat(simd, 0.0));
            for lane in 0..jobs.len() {
                let velocities = [after.tangential.get(lane), after.rebound.get(lane)];
                self.made.push((ill_posed.get(lane) == 0.0).then_some(velocities));
            }
        }
    }
}

/// Random impacts of a law of one piece or two, and how many of them: slide on, stop, turn back, are not unique. `planted`
/// changes what the lanes get.
fn impacts(planted: impl Fn(&mut Instance)) -> (f64, [usize; 4]) {
    let mut u = Uniform(29);
    let turns = Turns::new(ORDER, 1e-6);
    let mut jobs = Vec::new();
    let mut expected = Vec::new();
    while jobs.len() < 4000 {
        let mut params = moving(&mut u);
        // Steep contacts reverse and lose their impulses.
        params.set(Param::Theta, 0.9 * FRAC_PI_2 * (2.0 * u.next() - 1.0));
        let (mu_s, mu_d) = (1.5 * u.next(), 1.5 * u.next());
        let law = if u.next() < 0.5 {
            FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 2.0 * u.next() + 0.01 }
        } else {
            FrictionLaw::Constant { mu_s, mu_d: mu_s }
        };
        let instance = Instance {
            params,
            law,
            impact_friction: u.next() < 0.8,
            motion: Motion::Ramp,
            heating: None,
            modal: None,
        };
        let Ok(scene) = Scene::planned(&instance, &plan(1.0, 0.1, 12)) else { continue };
        let belt = 3.0 * u.next();
        let moment = Moment { vx: belt + 4.0 * (u.next() - 0.5), vy: -2.0 * u.next(), belt };
        expected.push((scene.model.impact(moment.vx, moment.vy, belt).ok(), moment));
        let mut changed = instance.clone();
        planted(&mut changed);
        let scene = Scene::planned(&changed, &plan(1.0, 0.1, 12)).expect("it could be prepared before");
        jobs.push((Job::<f64>::new(&changed, scene, &plan(1.0, 0.1, 12), &turns), moment));
    }
    let mut lanes = InLanes { jobs: &jobs, made: Vec::new() };
    Arch::new().dispatch(&mut lanes);
    let (mut worst, mut kinds) = (0.0_f64, [0; 4]);
    for ((expected, moment), made) in expected.into_iter().zip(lanes.made) {
        let (Some(expected), Some([vx, vy])) = (&expected, made) else {
            kinds[3] += 1;
            if expected.is_some() != made.is_some() {
                worst = f64::INFINITY;
            }
            continue;
        };
        let (before, after) = (moment.belt - moment.vx, moment.belt - expected.vx);
        kinds[if after == 0.0 { 1 } else { usize::from(before * after < 0.0) * 2 }] += 1;
        worst = worst.max((vx - expected.vx).abs()).max((vy - expected.vy).abs());
    }
    (worst, kinds)
}

#[test]
fn impacts_in_lanes_are_those_of_the_model() {
    let (worst, kinds) = impacts(|_| {});
    assert!(kinds.iter().all(|count| *count > 50), "{kinds:?}");
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn a_wrong_impact_is_seen() {
    // Planted faults: a little more restitution, a little more friction, friction where there is none.
    let restitution = |instance: &mut Instance| {
        let less = 0.999 * instance.params.require(Param::Restitution);
        instance.params.set(Param::Restitution, less + 0.0005);
    };
    let friction = |instance: &mut Instance| {
        if let FrictionLaw::Bilinear { mu_d, .. } = &mut instance.law {
            *mu_d *= 1.001;
        }
    };
    let everywhere = |instance: &mut Instance| instance.impact_friction = true;
    for planted in [&restitution as &dyn Fn(&mut Instance), &friction, &everywhere] {
        assert!(impacts(planted).0 > 1e-6);
    }
}
