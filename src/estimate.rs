//! What a sweep would cost, measured on a few of its instances.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use crate::backend::cpu::outcomes;
use crate::linear::analyse;
use crate::response::Plan;
use crate::spec::{Instance, Spec};

/// Most instances that are measured.
const SAMPLES: usize = 24;

/// No further instance is begun after this time.
const BUDGET: Duration = Duration::from_secs(3);

/// Longer transients are measured over their first periods and scaled up.
const MOST_PERIODS: f64 = 200.0;

/// Copies of an instance that are measured together: the engine is made for many at a time.
const COPIES: usize = 16;

/// The cost of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Instances that were measured.
    pub sampled: usize,
    /// Steps of the whole sweep.
    pub steps: f64,
    /// Time of one thread for the whole sweep.
    pub cpu_time: Duration,
}

/// Integrates a handful of instances spread over the grid and scales their cost up.
#[must_use]
pub fn estimate(spec: &Spec) -> Estimate {
    let instances = spec.grid.len();
    let samples = SAMPLES.min(instances);
    let began = Instant::now();
    let mut sampled = 0;
    let (mut steps, mut time) = (0.0, Duration::ZERO);
    while sampled < samples && (sampled == 0 || began.elapsed() < BUDGET) {
        let index = sample(spread(sampled, samples), samples, instances);
        let instance = spec.instance(index);
        let (plan, share) = Plan::new(spec).shortened(&instance, MOST_PERIODS);
        let start = Instant::now();
        if spec.analysis.linear {
            std::hint::black_box(analyse(&instance));
        }
        time += start.elapsed();
        if spec.analysis.response {
            let copies: Vec<Instance> = std::iter::repeat_n(instance, COPIES).collect();
            let start = Instant::now();
            let outcomes = outcomes::<f64>(&copies, &plan, &AtomicBool::new(false));
            // Other starts cost about as much as the small one.
            let starts = spec.analysis.starts.count() as f64;
            time += start.elapsed().mul_f64(starts / (share * COPIES as f64));
            steps += outcomes.map_or(0.0, |outcomes| starts * outcomes[0].steps as f64 / share);
        }
        sampled += 1;
    }
    let scale = instances as f64 / sampled.max(1) as f64;
    Estimate { sampled, steps: steps * scale, cpu_time: time.mul_f64(scale) }
}

/// An instance of part `part` of `parts` equal parts of the grid; where in the part follows the golden
/// ratio, so that no axis is always met at the same value.
fn sample(part: usize, parts: usize, instances: usize) -> usize {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let position = (part as f64 + (part as f64 * GOLDEN).fract()) / parts as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a usize")]
    let index = (position * instances as f64) as usize;
    index.min(instances - 1)
}

/// Visits the parts in an order that covers the grid evenly wherever it stops.
fn spread(visit: usize, parts: usize) -> usize {
    // A stride prime to 24 and near its golden section; other numbers of parts are small sweeps.
    const STRIDE: usize = 7;
    if parts.is_multiple_of(STRIDE) { visit } else { visit * STRIDE % parts }
}
