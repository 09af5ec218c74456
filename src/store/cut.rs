//! How many instances a tile has: as many as make some seconds of work of one core.
//!
//! A process that is killed loses the tiles that it works on, and processes share a sweep by tiles. So a tile of costly
//! instances has few of them. The number follows from the sweep alone, by a count of steps and not by a clock: every
//! process, machine and run cuts a sweep alike.

use crate::engine::lanes::{ORDER, tolerance};
use crate::engine::method::pace::Turns;
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::scene::Scene;
use crate::store::tiling::{LEAST, TILE};
use crate::sweep::spec::Spec;

/// Steps of a tile: one core takes some seconds for them in f32, twice that in f64.
const STEPS: f64 = 1.2e8;

/// A step of the reference takes as long as this many of the other engines: 14 times on the paper's map.
const OF_REFERENCE: f64 = 16.0;

/// Three eigenproblems of a modal model take as long as so many steps for each cube of their rows.
const OF_ROWS: f64 = 0.4;

/// Periods before the first window and in the windows of most runs until settled.
const UNTIL_SETTLED: f64 = 300.0;

/// Instances that are looked at, spread over the sweep.
const SAMPLES: usize = 32;

/// How many instances a tile of a sweep has: a power of two from [`LEAST`] to [`TILE`]. The reference, which takes longer,
/// has fewer.
#[must_use]
pub fn tile_of(spec: &Spec, by_reference: bool) -> usize {
    let tile = |cost: f64| {
        let mut tile = TILE;
        while tile > LEAST && tile as f64 * cost > STEPS {
            tile /= 2;
        }
        tile
    };
    if let Some(modal) = &spec.modal {
        return tile(OF_ROWS * ((2 * modal.size()) as f64).powi(3));
    }
    if !spec.analysis.response {
        return TILE;
    }
    let plan = Plan::new(spec);
    let turns = Turns::new(ORDER, tolerance(Precision::F64, spec.steps_per_period));
    let instances = spec.grid.len();
    let samples = SAMPLES.min(instances).max(1);
    let steps = |sample: usize| {
        // In the middle of equal parts; in 128 bits, as the product may be large.
        let index = (2 * sample as u128 + 1) * instances as u128 / (2 * samples as u128);
        let instance = spec.instance(usize::try_from(index).unwrap_or(usize::MAX).min(instances - 1));
        // What cannot start costs nothing.
        let Ok(scene) = Scene::planned(&instance, &plan) else { return 0.0 };
        let periods = |duration| scene.scaled(duration) / std::f64::consts::TAU;
        let asked = match plan.settle_limit {
            Some(limit) => periods(limit).min(UNTIL_SETTLED) + periods(plan.measure),
            None => periods(plan.settle) + periods(plan.measure),
        };
        let longest = turns.longest_steps(&scene.model.fastest)[0];
        asked * f64::from(spec.steps_per_period).max(std::f64::consts::TAU / longest)
    };
    let mean = if instances == 0 { 0.0 } else { (0..samples).map(steps).sum::<f64>() / samples as f64 };
    let slowness = if by_reference { OF_REFERENCE } else { 1.0 };
    tile(mean * spec.analysis.starts.count() as f64 * slowness)
}
