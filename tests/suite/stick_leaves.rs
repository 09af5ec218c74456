//! How a lane of the CPU engine leaves stick, against the forces of the model along a motion integrated apart: `x2` goes
//! with the belt, `y1` by RK4 in short steps.

use pulp::{Arch, Simd, WithSimd};

use crate::common::plan;
use crate::instances::{Uniform, moving};
use squealmap::kernel::series::STICK;
use squealmap::method::pace::Turns;
use squealmap::model::equilibrium::Scaled;
use squealmap::model::friction::FrictionLaw;
use squealmap::response::Scene;
use squealmap::simd::ORDER;
use squealmap::simd::block::{Block, SECOND, THIRD};
use squealmap::simd::events::first_event;
use squealmap::simd::expand::{CLOSED, Expansion, PIECES, expand};
use squealmap::simd::functions::{Functions, functions};
use squealmap::simd::job::Job;
use squealmap::simd::vector::{Scalar, Vector};
use squealmap::spec::Instance;

const N: usize = ORDER + 1;

/// Short steps of the other integration.
const SHORT: usize = 2000;

/// Bound on the truncation of a step.
const TOLERANCE: f64 = 1e-9;

/// A sticking body, the belt below it and a step in which its series is exact but for 1e-9.
struct Case {
    job: Job<f64>,
    belt: f64,
    drive: f64,
    step: f64,
}

impl Case {
    /// Random ones inside the cone.
    fn all() -> Vec<Case> {
        let mut u = Uniform(53);
        let turns = Turns::new(ORDER, TOLERANCE);
        let mut cases = Vec::new();
        while cases.len() < 2000 {
            let (mu_s, mu_d) = (0.6 * u.next(), 0.6 * u.next());
            let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: u.log(0.03, 1.0) };
            let instance = Instance { params: moving(&mut u), law, impact_friction: false };
            let plan = plan(1.0, 0.1, 12);
            let Ok(scene) = Scene::planned(&instance, &plan, f64::EPSILON) else { continue };
            let mut job = Job::<f64>::new(&instance, scene, &plan, &turns);
            let belt = 2.0 * u.next() - 1.0;
            let drive = if u.next() < 0.5 { 0.0 } else { u.next() - 0.5 };
            let mut around = || 2.0 * u.next() - 1.0;
            job.state.contact = STICK;
            job.state.body.p = [around(), 0.0, around()];
            job.state.body.v = [belt, 0.0, around()];
            let case = Case { job, belt, drive, step: 0.1 + 0.5 * u.next() };
            // What begins at the edge may be on either side of it.
            if case.margins(&[0.0; 2], 0.0).iter().all(|margin| *margin > 1e-3) {
                cases.push(case);
            }
        }
        cases
    }

    fn model(&self) -> &Scaled {
        &self.job.scene.model
    }

    /// Positions and velocities at a time, with `y1` and its velocity ahead of the start by `ahead`.
    fn motion(&self, ahead: &[f64; 2], time: f64) -> [[f64; 3]; 2] {
        let ([x, _, w], [_, _, vw]) = (self.job.state.body.p, self.job.state.body.v);
        let position = [x + time * (self.belt + 0.5 * time * self.drive), 0.0, w + ahead[0]];
        [position, [self.belt + time * self.drive, 0.0, vw + ahead[1]]]
    }

    /// How far the forces are inside the stick cone, forwards and backwards.
    fn margins(&self, ahead: &[f64; 2], time: f64) -> [f64; 2] {
        let [position, velocity] = self.motion(ahead, time);
        self.model().cone_margins(self.model().springs(position, velocity), self.drive)
    }

    /// Where in the step the cone is left first, and forwards or backwards; `None` if it is not, `Err` where this cannot
    /// tell: by a hair.
    fn leaves(&self) -> Result<Option<(f64, u32)>, ()> {
        let h = self.step / SHORT as f64;
        let slope = |ahead: &[f64; 2], time: f64| {
            let [position, velocity] = self.motion(ahead, time);
            [velocity[2], self.model().springs(position, velocity).h / self.model().m1]
        };
        let along = |a: &[f64; 2], k: &[f64; 2], t: f64| [a[0] + t * k[0], a[1] + t * k[1]];
        let mut ahead = [0.0; 2];
        let mut before = self.margins(&ahead, 0.0);
        let mut least = f64::INFINITY;
        for i in 0..SHORT {
            let time = i as f64 * h;
            let one = slope(&ahead, time);
            let two = slope(&along(&ahead, &one, 0.5 * h), time + 0.5 * h);
            let three = slope(&along(&ahead, &two, 0.5 * h), time + 0.5 * h);
            let four = slope(&along(&ahead, &three, h), time + h);
            for (j, value) in ahead.iter_mut().enumerate() {
                *value += h / 6.0 * (one[j] + 2.0 * (two[j] + three[j]) + four[j]);
            }
            let after = self.margins(&ahead, time + h);
            let outside: Vec<usize> = (0..2).filter(|side| after[*side] <= 0.0).collect();
            match outside[..] {
                [] => least = least.min(after[0]).min(after[1]),
                [side] => {
                    let part = before[side] / (before[side] - after[side]);
                    return Ok(Some(((i as f64 + part) / SHORT as f64, [SECOND, THIRD][side])));
                }
                _ => return Err(()),
            }
            before = after;
        }
        if least < 1e-6 { Err(()) } else { Ok(None) }
    }
}

/// Where in its step each lane has an event, and which.
struct InLanes<'a> {
    cases: &'a [Case],
    found: Vec<(f64, u32)>,
}

impl WithSimd for &mut InLanes<'_> {
    type Output = ();
    fn with_simd<S: Simd>(self, simd: S) {
        for cases in self.cases.chunks(<f64 as Scalar<S>>::LANES) {
            let mut block: Block<S, f64, 1> = Block::idle(simd, cases[0].job.law());
            let mut steps = Vector::splat(simd, 1.0);
            for (lane, case) in cases.iter().enumerate() {
                block.load_scene(lane, &case.job.constants, &case.job.words);
                block.load_state(lane, &case.job.state, &case.job.words);
                block.belt.set(lane, case.belt);
                block.drive.set(lane, case.drive);
                steps.set(lane, case.step);
            }
            let mut e = Expansion::<S, f64, 1, N>::new(simd);
            let mut g = Functions::<S, f64, 1, N>::new(simd);
            assert!(!expand::<S, f64, 1, N, PIECES, CLOSED>(&block, steps, &mut e).any());
            functions::<S, f64, 1, N, CLOSED>(&block, &mut e, &mut g);
            let tolerance = Vector::splat(simd, TOLERANCE);
            let [at, event] = first_event::<S, f64, 1, N, CLOSED>(&block, &e, &g, tolerance);
            for lane in 0..cases.len() {
                let event = [SECOND, THIRD]
                    .into_iter()
                    .find(|code| (f64::from(*code) - event.get(lane)).abs() < 0.5)
                    .unwrap_or_else(|| {
                        assert!(event.get(lane).abs() < 0.5, "neither side of the cone");
                        0
                    });
                self.found.push((at.get(lane), event));
            }
        }
    }
}

/// How many lanes differ, and how many do not leave, leave forwards, backwards, cannot be told.
fn differ(planted: impl Fn(&mut Case)) -> (usize, [usize; 4]) {
    let mut cases = Case::all();
    let expected: Vec<_> = cases.iter().map(Case::leaves).collect();
    cases.iter_mut().for_each(planted);
    let mut lanes = InLanes { cases: &cases, found: Vec::new() };
    Arch::new().dispatch(&mut lanes);
    let (mut different, mut seen) = (0, [0; 4]);
    for ((at, event), expected) in lanes.found.into_iter().zip(expected) {
        let Ok(expected) = expected else {
            seen[3] += 1;
            continue;
        };
        let (place, code) = expected.unwrap_or((1.0, 0));
        seen[if code == 0 {
            0
        } else if code == SECOND {
            1
        } else {
            2
        }] += 1;
        different += usize::from(event != code || (at - place).abs() > 1e-6);
    }
    (different, seen)
}

#[test]
fn the_stick_cone_is_left_where_the_model_leaves_it() {
    let (different, seen) = differ(|_| {});
    assert!(seen[..3].iter().all(|count| *count > 100) && seen[3] < 20, "{seen:?}");
    assert_eq!(different, 0, "{seen:?}");
}

#[test]
fn a_wrong_leave_is_seen() {
    // Planted faults: a belt whose acceleration is not felt, another damping, a velocity of y1 that is off by 1e-4.
    let drive = |case: &mut Case| case.drive = 0.0;
    let damper = |case: &mut Case| case.job.constants[squealmap::simd::constants::R + 3] *= 1.1;
    let velocity = |case: &mut Case| case.job.state.body.v[2] += 1e-4;
    for planted in [&drive as &dyn Fn(&mut Case), &damper, &velocity] {
        assert!(differ(planted).0 > 100);
    }
}
