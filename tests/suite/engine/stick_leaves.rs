//! How a lane of the CPU engine leaves stick, against the forces of the model along a motion integrated apart: `x2` goes
//! with the belt, `y1` by RK4 in short steps.

use pulp::{Arch, Simd, WithSimd};

use crate::engine::first_events::{Body, job, steps};
use crate::instances::Uniform;
use squealmap::engine::lanes::block::{SECOND, THIRD};
use squealmap::engine::lanes::constants::R;
use squealmap::engine::lanes::contact::STICK;
use squealmap::model::scaled::Scaled;

/// Short steps of the other integration.
const SHORT: usize = 2000;

/// Bound on the truncation of a step; the series of all here are good to their ends.
const TOLERANCE: f64 = 1e-9;

impl Body {
    /// Random ones that stick, inside the cone.
    fn sticking() -> Vec<Body> {
        let mut u = Uniform(53);
        let mut bodies = Vec::new();
        while bodies.len() < 2000 {
            let Some(mut job) = job(&mut u, TOLERANCE) else { continue };
            let belt = 2.0 * u.next() - 1.0;
            let drive = if u.next() < 0.5 { 0.0 } else { u.next() - 0.5 };
            let mut around = || 2.0 * u.next() - 1.0;
            job.state.contact = STICK;
            job.state.body.p = [around(), 0.0, around()];
            job.state.body.v = [belt, 0.0, around()];
            let body = Body { job, belt, drive, step: 0.1 + 0.5 * u.next(), disarmed: 0 };
            // What begins at the edge may be on either side of it.
            if body.margins(&[0.0; 2], 0.0).iter().all(|margin| *margin > 1e-3) {
                bodies.push(body);
            }
        }
        bodies
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
    bodies: &'a [Body],
    found: Vec<(f64, u32)>,
}

impl WithSimd for &mut InLanes<'_> {
    type Output = ();
    fn with_simd<S: Simd>(self, simd: S) {
        steps(simd, self.bodies, TOLERANCE, |step, bodies| {
            for lane in 0..bodies.len() {
                assert!(step.until.get(lane) >= 1.0);
                self.found.push(step.event(lane));
            }
        });
    }
}

/// How many lanes differ, and how many do not leave, leave forwards, backwards, cannot be told.
fn differ(planted: impl Fn(&mut Body)) -> (usize, [usize; 4]) {
    let mut bodies = Body::sticking();
    let expected: Vec<_> = bodies.iter().map(Body::leaves).collect();
    bodies.iter_mut().for_each(planted);
    let mut lanes = InLanes { bodies: &bodies, found: Vec::new() };
    Arch::new().dispatch(&mut lanes);
    let (mut different, mut seen) = (0, [0; 4]);
    for ((at, event), expected) in lanes.found.into_iter().zip(expected) {
        let Ok(expected) = expected else {
            seen[3] += 1;
            continue;
        };
        let (place, code) = expected.unwrap_or((1.0, 0));
        let kind = [0, SECOND, THIRD].iter().position(|one| *one == code).expect("an end");
        seen[kind] += 1;
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
    let drive = |body: &mut Body| body.drive = 0.0;
    let damper = |body: &mut Body| body.job.constants[R + 3] *= 1.1;
    let velocity = |body: &mut Body| body.job.state.body.v[2] += 1e-4;
    for planted in [&drive as &dyn Fn(&mut Body), &damper, &velocity] {
        assert!(differ(planted).0 > 100);
    }
}
