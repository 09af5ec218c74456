//! Bodies in the lanes of the CPU engine for one step, and the first event that each of them finds.

use pulp::Simd;

use crate::common::plan;
use crate::instances::{Uniform, moving};
use squealmap::engine::lanes::ORDER;
use squealmap::engine::lanes::block::{Block, FIRST, SECOND, THIRD};
use squealmap::engine::lanes::events::first_event;
use squealmap::engine::lanes::expand::{Expansion, expand};
use squealmap::engine::lanes::functions::{Functions, functions};
use squealmap::engine::lanes::job::Job;
use squealmap::engine::lanes::motion::CLOSED;
use squealmap::engine::lanes::motion::PIECES;
use squealmap::engine::lanes::reach::reach;
use squealmap::engine::lanes::scalar::Scalar;
use squealmap::engine::lanes::vector::Vector;
use squealmap::engine::method::pace::Turns;
use squealmap::engine::scene::Scene;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;

/// Coefficients of the series of a position.
pub(crate) const N: usize = ORDER + 1;

/// A body in contact, the belt below it, and its step.
pub(crate) struct Body {
    pub(crate) job: Job<f64>,
    pub(crate) belt: f64,
    pub(crate) drive: f64,
    pub(crate) step: f64,
    /// The event function that begins at zero.
    pub(crate) disarmed: u32,
}

/// A random instance of a bilinear law; `None` where there is none.
pub(crate) fn job(u: &mut Uniform, tolerance: f64) -> Option<Job<f64>> {
    let (mu_s, mu_d) = (0.6 * u.next(), 0.6 * u.next());
    let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: u.log(0.03, 1.0) };
    let instance = Instance {
        params: moving(u),
        law,
        impact_friction: false,
        motion: Motion::Ramp,
        heating: None,
        modal: None,
    };
    let plan = plan(1.0, 0.1, 12);
    let scene = Scene::planned(&instance, &plan).ok()?;
    Some(Job::new(&instance, scene, &plan, &Turns::new(ORDER, tolerance)))
}

/// A step of as many bodies as there are lanes.
pub(crate) struct Step<S: Simd> {
    pub(crate) block: Block<S, f64>,
    pub(crate) e: Expansion<S, f64, N>,
    /// The series of the normal force.
    pub(crate) normal: [Vector<S, f64>; N],
    /// How far the series are good.
    pub(crate) until: Vector<S, f64>,
    at: Vector<S, f64>,
    event: Vector<S, f64>,
}

impl<S: Simd> Step<S> {
    /// Where a lane has its event, 1 for none, and which, 0 for none.
    pub(crate) fn event(&self, lane: usize) -> (f64, u32) {
        let number = self.event.get(lane);
        let code = [0, FIRST, SECOND, THIRD].into_iter().find(|code| (f64::from(*code) - number).abs() < 0.5);
        (self.at.get(lane), code.expect("an event function"))
    }
}

/// Calls `look` with the steps of all bodies and those that are in them.
pub(crate) fn steps<S: Simd>(
    simd: S,
    bodies: &[Body],
    tolerance: f64,
    mut look: impl FnMut(&Step<S>, &[Body]),
) {
    let tolerance = Vector::splat(simd, tolerance);
    for bodies in bodies.chunks(<f64 as Scalar<S>>::LANES) {
        let mut block: Block<S, f64> = Block::idle(simd, bodies[0].job.law());
        let mut steps = Vector::splat(simd, 1.0);
        for (lane, body) in bodies.iter().enumerate() {
            block.load_scene(lane, &body.job.constants, &body.job.words);
            block.load_state(lane, &body.job.state, &body.job.words);
            block.belt.set(lane, body.belt);
            block.drive.set(lane, body.drive);
            block.disarmed.set(lane, f64::from(body.disarmed));
            steps.set(lane, body.step);
        }
        let mut e = Expansion::<S, f64, N>::new(simd);
        let mut g = Functions::<S, f64, N>::new(simd);
        assert!(!expand::<S, f64, N, PIECES, CLOSED>(&block, steps, &mut e).any());
        let until = reach::<S, f64, N, CLOSED>(&mut e, tolerance).end;
        let normal = e.n;
        functions::<S, f64, N, CLOSED>(&block, &mut e, &mut g);
        let [at, event] = first_event::<S, f64, N, CLOSED>(&block, &e, &g, tolerance);
        look(&Step { block, e, normal, until, at, event }, bodies);
    }
}
