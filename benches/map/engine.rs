//! The engines and what one of them makes of a map.

use std::sync::atomic::AtomicBool;

use crate::gpu;
use crate::work::{Work, plan, reference_plan};
use clap::ValueEnum;
use rayon::prelude::*;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::lanes::{Lanes, ORDER, tolerance};
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::engine::precision::Precision;
use squealmap::engine::reference::respond::respond;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// Most instances of a batch on the CPU, and fewest: those of a sweep.
const MOST: usize = 1024;
const FEWEST: usize = 32;

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// The scalar f64 reference.
    Reference,
    /// The same method in scalar code: that of the reference with the order, the steps and the bound on the
    /// truncation of the engine in vector registers, in f64 with either bound (scalar code gains nothing by f32).
    Scalar,
    /// The engine in vector registers.
    Simd,
    /// The kernel on an adapter.
    Gpu,
}

/// An engine with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Case {
    pub(crate) engine: Engine,
    pub(crate) precision: Precision,
    pub(crate) steps_per_period: u32,
}

/// What came of a map.
#[derive(Clone, Debug, Default)]
pub(crate) struct Output {
    /// Steps of all instances, as their outcomes count them.
    pub(crate) steps: u64,
    /// Instances that did not end as `ok`, and how they did.
    pub(crate) failed: Vec<(usize, Status)>,
    /// The outcomes of the judged instances.
    pub(crate) judged: Vec<Outcome>,
}

impl Engine {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Engine::Reference => "reference",
            Engine::Scalar => "scalar",
            Engine::Simd => "simd",
            Engine::Gpu => "gpu",
        }
    }
}

impl Case {
    /// Order of its Taylor series.
    pub(crate) fn order(self) -> usize {
        match self.engine {
            Engine::Reference => REFERENCE_ORDER,
            Engine::Scalar | Engine::Simd | Engine::Gpu => ORDER,
        }
    }

    /// What it computes in.
    pub(crate) fn arithmetic(self) -> Precision {
        match self.engine {
            Engine::Reference | Engine::Scalar => Precision::F64,
            _ => self.precision,
        }
    }

    /// What a table says of its scalar.
    pub(crate) fn scalar(self) -> String {
        let arithmetic = self.arithmetic();
        if arithmetic == self.precision {
            return arithmetic.to_string();
        }
        format!("{arithmetic} with the bound of {}", self.precision)
    }

    fn plan(self) -> Plan {
        match self.engine {
            Engine::Reference => reference_plan(self.steps_per_period),
            _ => plan(self.steps_per_period, ORDER, tolerance(self.precision, self.steps_per_period)),
        }
    }

    /// Computes a map and keeps the outcomes of `judged`.
    pub(crate) fn run(
        self,
        work: Work,
        judged: &[usize],
        adapter: Option<&Adapter>,
    ) -> squealmap::error::Result<Output> {
        let plan = self.plan();
        let each = |one: fn(&Instance, &Plan) -> Outcome| {
            on_cpu(work, judged, |instances| instances.iter().map(|instance| one(instance, &plan)).collect())
        };
        Ok(match (self.engine, self.precision) {
            (Engine::Gpu, precision) => {
                return gpu::run(work, judged, adapter, precision, self.steps_per_period);
            }
            (Engine::Reference | Engine::Scalar, _) => each(respond),
            (Engine::Simd, Precision::F32) => on_cpu(work, judged, |i| lanes::<f32>(i, &plan)),
            (Engine::Simd, Precision::F64) => on_cpu(work, judged, |i| lanes::<f64>(i, &plan)),
        })
    }
}

fn lanes<T: Lanes>(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    outcomes::<T>(instances, plan, &AtomicBool::new(false)).expect("nobody stops it")
}

/// A map in batches on all threads; only what is asked for is kept of it.
fn on_cpu(work: Work, judged: &[usize], run: impl Fn(&[Instance]) -> Vec<Outcome> + Sync) -> Output {
    let (total, threads) = (work.len(), rayon::current_num_threads());
    let size = (total / (4 * threads)).clamp(FEWEST, MOST).min(total);
    let batches: Vec<Output> = (0..total.div_ceil(size))
        .into_par_iter()
        .map(|batch| {
            let range = batch * size..((batch + 1) * size).min(total);
            let instances: Vec<Instance> = range.clone().map(|index| work.instance(index)).collect();
            let mut output = Output::default();
            let outcomes = run(&instances);
            let first = judged.partition_point(|index| *index < range.start);
            let of_range = judged[first..].iter().take_while(|index| **index < range.end);
            output.judged.extend(of_range.map(|index| outcomes[index - range.start]));
            for (index, outcome) in range.zip(&outcomes) {
                output.count(index, outcome);
            }
            output
        })
        .collect();
    let mut all = Output::default();
    for batch in batches {
        all.steps += batch.steps;
        all.failed.extend(batch.failed);
        all.judged.extend(batch.judged);
    }
    all
}

impl Output {
    /// Counts an instance.
    pub(crate) fn count(&mut self, index: usize, outcome: &Outcome) {
        self.steps += outcome.steps;
        if outcome.status != Status::Ok {
            self.failed.push((index, outcome.status));
        }
    }
}
