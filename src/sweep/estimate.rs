//! The cost of a sweep before it is run, measured on a few of its instances.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use crate::engine::lanes::march::Terms;
use crate::engine::lanes::outcomes::outcomes_on;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::scene::{MOST_STEPS, Scene};
use crate::model::instance::Instance;
use crate::model::linear::analyse;
use crate::model::status::Status;
use crate::sweep::spec::Spec;

/// Most instances that are measured.
const SAMPLES: usize = 24;

/// No further instance is begun after this time.
const BUDGET: Duration = Duration::from_secs(3);

/// Longer transients are measured over their first periods and scaled up.
const MOST_PERIODS: f64 = 200.0;

/// No sample takes more steps: some tenths of a second.
const MOST_OF_A_SAMPLE: u32 = 50_000;

/// Copies of an instance that are measured together: the engine is made for many at a time.
const COPIES: usize = 16;

/// The cost of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Instances that were measured.
    pub sampled: usize,
    /// Measured instances that were not followed to their end, since that would take too many steps. What they took is
    /// scaled up by the time that they came to: right for a run that goes on as it began, too little for one that becomes
    /// stiffer.
    pub cut_short: usize,
    /// How measured instances failed: those that ended early for another reason than too many steps to measure.
    pub failed: Vec<Status>,
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
    let (mut sampled, mut cut_short) = (0, 0);
    let mut failed = Vec::new();
    let (mut steps, mut time) = (0.0, Duration::ZERO);
    while sampled < samples && (sampled == 0 || began.elapsed() < BUDGET) {
        let index = sample(spread(sampled, samples), samples, instances);
        let instance = spec.instance(index);
        let start = Instant::now();
        if spec.analysis.linear {
            std::hint::black_box(analyse(&instance));
        }
        time += start.elapsed();
        if spec.analysis.response {
            let periods =
                MOST_PERIODS.min(0.5 * f64::from(MOST_OF_A_SAMPLE) / f64::from(spec.steps_per_period));
            // What the whole plan refuses costs nothing.
            let whole = Plan::new(spec);
            let (plan, share) = match Scene::planned(&instance, &whole) {
                // Until settled most take a part of the longest time.
                Ok(_) if whole.settle_limit.is_none() => whole.shortened(&instance, periods),
                _ => (whole, 1.0),
            };
            let terms = Terms { most_steps: MOST_OF_A_SAMPLE, ..Terms::default() };
            let copies: Vec<Instance> = std::iter::repeat_n(instance, COPIES).collect();
            let start = Instant::now();
            let outcomes =
                outcomes_on::<f64>(&copies, &plan, terms, &AtomicBool::new(false)).unwrap_or_default();
            let elapsed = start.elapsed();
            let outcome = outcomes.first().copied().unwrap_or_default();
            let reached = reached(&outcome, &copies[0], &plan);
            cut_short += usize::from(reached < 1.0);
            failed.extend((reached >= 1.0 && outcome.status != Status::Ok).then_some(outcome.status));
            // Other starts cost about as much as the small one; no run has more steps than it may.
            let taken = outcome.steps.max(1) as f64;
            let more = (1.0 / (share * reached)).min(f64::from(MOST_STEPS) / taken).max(1.0);
            let runs = spec.analysis.starts.count() as f64;
            time += elapsed.mul_f64(runs * more / COPIES as f64);
            steps += runs * more * outcome.steps as f64;
        }
        sampled += 1;
    }
    let scale = instances as f64 / sampled.max(1) as f64;
    Estimate { sampled, cut_short, failed, steps: steps * scale, cpu_time: time.mul_f64(scale) }
}

/// The part of a plan's time that a sample came to before its steps were counted out; 1 where they were not.
fn reached(outcome: &Outcome, instance: &Instance, plan: &Plan) -> f64 {
    if outcome.status != Status::StepTooLarge || outcome.steps < u64::from(MOST_OF_A_SAMPLE) {
        return 1.0;
    }
    let Ok(scene) = Scene::new(instance, plan.start) else { return 1.0 };
    let settle = plan.settle_limit.unwrap_or(plan.settle);
    let whole = (scene.scaled(settle) + scene.scaled(plan.measure)) * scene.units.time;
    (outcome.simulated_time / whole).min(1.0)
}

/// An instance of part `part` of `parts` equal parts of the grid; where in the part follows the golden
/// ratio, so that no axis is always met at the same value.
pub(crate) fn sample(part: usize, parts: usize, instances: usize) -> usize {
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
