//! A run cut into the segments of a kernel.

use crate::engine::kernel::scene::{FIRST_HALF, OPEN_HALF, SECOND_HALF, SEGMENTS, SETTLE, Segments};
use crate::engine::kernel::table::segment;
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use std::f64::consts::TAU;

/// The segments of a run: settle and both halves of the window, cut where a ramp ends.
#[must_use]
pub fn segments(scene: &Scene, plan: &Plan) -> Segments {
    let half = 0.5 * scene.scaled(plan.measure);
    cut(scene, plan, [(SETTLE, scene.scaled(plan.settle)), (FIRST_HALF, half), (SECOND_HALF, half)])
}

/// The segments of one window of a run until settled, without a second pass.
#[must_use]
pub fn window_segments(scene: &Scene, plan: &Plan, settle: f64, half: f64) -> Segments {
    cut(scene, plan, [(SETTLE, settle), (FIRST_HALF, half), (OPEN_HALF, half)])
}

/// A ramp that has less than this part of its time to go is over.
const END_ROUNDING: f64 = 1e-14;

fn cut(scene: &Scene, plan: &Plan, parts: [(u32, f64); 3]) -> Segments {
    let nominal = TAU / f64::from(plan.steps_per_period);
    let mut segments = [[0.0; segment::WORDS]; SEGMENTS];
    let mut used = 0;
    let mut time = 0.0;
    for (part, length) in parts {
        let mut rest = length;
        while rest > 0.0 {
            let (mut belt, mut holds) = scene.belt_from(time);
            if holds <= END_ROUNDING * time {
                // The sum of the parts falls short of the end of the ramp by its rounding: a segment of nothing, for which
                // there is no room.
                time *= 1.0 + END_ROUNDING;
                (belt, holds) = scene.belt_from(time);
            }
            let duration = rest.min(holds);
            let steps = (duration / nominal).ceil().max(1.0);
            let words = &mut segments[used];
            words[segment::STEPS] = steps;
            words[segment::STEP] = duration / steps;
            words[segment::VELOCITY] = belt.velocity;
            words[segment::ACCELERATION] = belt.acceleration;
            words[segment::PART] = f64::from(part);
            used += 1;
            time += duration;
            rest -= duration;
        }
    }
    segments
}
