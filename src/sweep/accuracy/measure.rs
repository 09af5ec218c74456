//! Every configuration on a sample of a sweep: instances per second against error.

use rayon::ThreadPoolBuilder;

use crate::engine::backend::Backend;
use crate::engine::choice::choose;
use crate::engine::gpu::adapter::Adapter;
use crate::engine::method::Method;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::model::status::Status;
use crate::sweep::accuracy::clock::Clock;
use crate::sweep::accuracy::configuration::{Configuration, scenes};
use crate::sweep::accuracy::errors::{Judge, Quantiles, is_settled_oscillation, oscillates, quantile, worst};
use crate::sweep::accuracy::frontier::mark;
use crate::sweep::accuracy::row::{Rate, Row};
use crate::sweep::accuracy::sample::{Sample, records, subset};
use crate::sweep::draw::spread;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::Spec;

/// Steps per period of the truth: twice those of a sweep.
pub const TRUTH_STEPS: u32 = 24;

/// Steps per period of what the truth is checked against.
pub const CHECK_STEPS: u32 = 48;

/// Settled oscillations of the sample on which the truth is checked.
const CHECKED: usize = 32;

/// Steps per period that are measured on the CPU engine and on GPUs.
const STEPS: [u32; 15] = [3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 24];
const GPU_STEPS: [u32; 6] = [4, 6, 8, 12, 16, 24];

/// Steps per period of the reference as a sweep runs it.
const REFERENCE_STEPS: u32 = 12;

/// Steps per period of the methods that are there to be compared with; the source paper's fixed step has 294.
const COMPARED: [(Method, &[u32]); 2] =
    [(Method::LocatedRk4, &[12, 20, 40, 80, 160]), (Method::FixedStep, &[12, 20, 40, 80, 160, 294])];

/// Instances that speed is measured on: enough to fill the lanes many times over.
const TIMED: usize = 1024;

/// Instances that the speed of the reference, and of methods compared with it, is measured on: they take one at a time.
const TIMED_REFERENCE: usize = 64;

/// Instances that methods only there for comparison are timed on, in one round: they are slow and never chosen. For the same
/// reason they are judged on only one of so many instances of the sample.
const TIMED_COMPARED: usize = 8;
const ONE_COMPARED_OF: usize = 8;

/// A speed is taken over so many seconds at least: clocks count the work of a thread in slices.
const SHORTEST_TIMING: f64 = 0.02;

/// Rounds of timing; the fastest counts. In each round every configuration has its turn, so that other work on the machine
/// does not hit one of them alone.
const ROUNDS: usize = 2;

/// What to measure.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Instances of the sample.
    pub sample: usize,
    /// Its seed.
    pub seed: u64,
    /// Threads of a run, at least 1.
    pub threads: usize,
    /// Whether software adapters are measured too.
    pub software: bool,
}

/// How good the records are that errors are measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Settled oscillations on which it was compared with twice its steps.
    pub checked: usize,
    /// The worst relative error of any quantity there: median, 95th percentile and largest.
    pub convergence: Quantiles,
    /// Difference of the halves of its own windows over the settled oscillations.
    pub scatter: Quantiles,
    /// Share of the sweep that oscillates.
    pub oscillating: f64,
    /// Share that oscillates and is settled: what numbers are compared on.
    pub settled: f64,
    /// Settled oscillations of the sample.
    pub judged: usize,
    /// Share that did not come to its end.
    pub failed: f64,
}

/// The result of a measurement.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The kind of scene; several of a sweep with several laws stand together.
    pub scene: String,
    /// The settings.
    pub settings: Settings,
    /// The sample.
    pub sample: Sample,
    /// The truth.
    pub truth: Truth,
    /// One row per configuration.
    pub rows: Vec<Row>,
    /// Sentences about configurations that were left out, and why.
    pub left_out: Vec<String>,
}

/// Measures every configuration that this machine has; `note` gets a line for each.
///
/// # Errors
/// When the sweep has no response or no settled oscillation, or is cancelled.
pub fn measure(
    spec: &Spec,
    settings: Settings,
    options: &Options,
    note: &dyn Fn(&str),
) -> Result<Measurement> {
    if !spec.analysis.response {
        return Err(Error::NothingToJudge {
            what: "the sweep has no response: `analysis` lacks \"response\"",
        });
    }
    let pool = |threads| {
        ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|why| Error::Threads { threads, why: why.to_string() })
    };
    let (one, all) = (pool(1)?, pool(settings.threads)?);
    let sample = all.install(|| Sample::draw(spec, settings.sample, settings.seed, options))?;
    let judged = subset(spec, &sample.indices);
    note(&format!("computing the truth of {} instances", sample.indices.len()));
    let truth = all.install(|| records(&Configuration::reference(TRUTH_STEPS), &judged, options))?;
    let judge = Judge::new(truth, sample.weights.clone());
    let truth = all.install(|| of_truth(&judge, &judged, options))?;
    let total = spec.grid.len();
    let timed = subset(spec, &spread(!settings.seed, TIMED.min(total), total, 0..total));
    let scene = scenes(spec).join(" + ");
    let (configurations, left_out) = configurations(settings.software);
    let mut rates: Vec<Rate> = Vec::new();
    for round in 0..ROUNDS {
        for (at, configuration) in configurations.iter().enumerate() {
            let compared = configuration.backend.is_comparison();
            if compared && round > 0 {
                continue;
            }
            let instances = match configuration.backend {
                _ if compared => TIMED_COMPARED.min(timed.grid.len()),
                one_by_one if one_by_one.method().is_some() => TIMED_REFERENCE.min(timed.grid.len()),
                Backend::Gpu if settings.software => TIMED_REFERENCE.min(timed.grid.len()),
                _ => timed.grid.len(),
            };
            let time = || speed(configuration, &timed, instances, options);
            let [_, per_second] = all.install(time)?;
            let per_cpu_second = match configuration.backend {
                Backend::Gpu => None,
                _ => Some(one.install(time)?[0]),
            };
            let rate = Rate { per_cpu_second, per_second };
            match rates.get_mut(at) {
                None => rates.push(rate),
                Some(before) => before.improve(rate),
            }
        }
        note(&format!("speed: round {} of {ROUNDS} is done", round + 1));
    }
    let (few, judge_of_few) = compared(&judged, &judge);
    let mut rows = Vec::new();
    for (configuration, rate) in configurations.iter().zip(rates) {
        let (judged, judge) =
            if configuration.backend.is_comparison() { (&few, &judge_of_few) } else { (&judged, &judge) };
        let found = all.install(|| records(configuration, judged, options))?;
        let row = Row::new(&scene, configuration, rate, &judge.errors(&found));
        note(&format!(
            "{configuration}: {:.0} instances/s, 95 % within {:.1e}, 99 % within {:.1e}",
            rate.per_second, row.worst_p95, row.worst_p99
        ));
        rows.push(row);
    }
    mark(&mut rows);
    Ok(Measurement { scene, settings, sample, truth, rows, left_out })
}

/// The part of the sample that the methods to compare with are judged on: of the settled oscillations, and of all others.
fn compared(judged: &Spec, judge: &Judge) -> (Spec, Judge) {
    let (settled, others): (Vec<usize>, Vec<usize>) =
        (0..judged.grid.len()).partition(|at| is_settled_oscillation(&judge.truth()[*at]));
    let few: Vec<usize> =
        [settled, others].iter().flat_map(|part| part.iter().step_by(ONE_COMPARED_OF).copied()).collect();
    (subset(judged, &few), judge.part_of(&few))
}

/// Compares the truth with twice its steps, and counts.
fn of_truth(judge: &Judge, judged: &Spec, options: &Options) -> Result<Truth> {
    let settled: Vec<usize> =
        (0..judge.truth().len()).filter(|at| is_settled_oscillation(&judge.truth()[*at])).collect();
    if settled.is_empty() {
        return Err(Error::NothingToJudge {
            what: "the sample has no settled oscillation: take a longer `settle`, or \"auto\", in [response]",
        });
    }
    let chosen: Vec<usize> =
        spread(0, CHECKED, settled.len(), 0..settled.len()).into_iter().map(|at| settled[at]).collect();
    let finer = records(&Configuration::reference(CHECK_STEPS), &subset(judged, &chosen), options)?;
    let errors: Vec<(f64, f64)> =
        chosen.iter().zip(&finer).map(|(at, finer)| (worst(&judge.truth()[*at], finer), 1.0)).collect();
    Ok(Truth {
        checked: chosen.len(),
        convergence: [0.5, 0.95, 1.0].map(|share| quantile(errors.clone(), share)),
        scatter: judge.scatter(),
        oscillating: judge.share(oscillates),
        settled: judge.share(is_settled_oscillation),
        judged: settled.len(),
        failed: judge.share(|record: &Record| record.status != Status::Ok),
    })
}

/// Every configuration that this machine can run, and sentences about those that are left out.
fn configurations(software: bool) -> (Vec<Configuration>, Vec<String>) {
    let both = [Precision::F32, Precision::F64];
    let mut all = vec![Configuration::reference(REFERENCE_STEPS)];
    all.extend(
        both.into_iter().flat_map(|precision| STEPS.map(|steps| Configuration::cpu(precision, steps))),
    );
    for (method, counts) in COMPARED {
        all.extend(counts.iter().map(|steps| Configuration::scalar(method, *steps)));
    }
    let mut left_out = Vec::new();
    for precision in both {
        match Adapter::best(precision, None) {
            Ok(adapter) if adapter.is_software() && !software => left_out.push(format!(
                "{} in {precision}: software on the CPU; `--software` measures it",
                adapter.describe()
            )),
            Ok(adapter) => all.extend(GPU_STEPS.map(|steps_per_period| Configuration {
                backend: Backend::Gpu,
                adapter: Some(adapter.describe().name.clone()),
                precision,
                steps_per_period,
            })),
            Err(why) => left_out.push(format!("a GPU in {precision}: {why}")),
        }
    }
    (all, left_out)
}

/// Instances per second of processor time of this thread and of wall time, of the first instances of a sweep, in the
/// pool it is called in.
fn speed(
    configuration: &Configuration,
    timed: &Spec,
    instances: usize,
    options: &Options,
) -> Result<[f64; 2]> {
    let spec = configuration.sweep(timed);
    let options = Options { note: None, ..configuration.options(options) };
    let mut engine = choose(&options, &spec)?;
    let clock = Clock::start();
    let mut computed = 0;
    while computed == 0 || clock.wall() < SHORTEST_TIMING || clock.worked() <= 0.0 {
        if let Some(why) = engine.records(&spec, 0..instances, options.cancel(), &|_| {})?.stopped {
            return Err(why.error(0, instances).into());
        }
        computed += instances;
    }
    Ok([clock.worked(), clock.wall()].map(|seconds| computed as f64 / seconds))
}
