//! A map on the best adapter, end to end: scenes, transfers, kernel, outcomes.

use crate::engine::Output;
use crate::work::Work;
use squealmap::engine::backend::Backend;
use squealmap::engine::gpu::adapter::{Adapter, Description};
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::sweep::run;

/// Most instances on a software adapter: a driver on the CPU computes some hundred a second.
pub(crate) const MOST_ON_SOFTWARE: usize = 1100;

/// The best adapter, when there is one.
pub(crate) fn adapter() -> Option<Adapter> {
    Adapter::best(Precision::F32, None).ok()
}

/// Whether an adapter computes maps of this size in a time one can wait for.
pub(crate) fn is_fit(adapter: &Adapter, work: Work) -> bool {
    !adapter.may_be_software() || work.len() <= MOST_ON_SOFTWARE
}

/// The name of an adapter in a table.
pub(crate) fn name(description: &Description) -> String {
    format!("{} ({}, {})", description.name, description.device_type, description.driver)
}

/// Computes a map as a sweep and keeps the outcomes of `judged`.
pub(crate) fn run(
    work: Work,
    judged: &[usize],
    adapter: Option<&Adapter>,
    precision: Precision,
    steps_per_period: u32,
) -> squealmap::error::Result<Output> {
    let mut spec = work.spec()?;
    spec.steps_per_period = steps_per_period;
    let wanted = adapter.map(|adapter| adapter.describe().name);
    let options = Options {
        backend: Backend::Gpu,
        precision: Some(precision),
        adapters: wanted.as_slice(),
        ..Options::default()
    };
    let map = run::run(spec, &options, &|_| {})?;
    let mut output = Output::default();
    for (index, record) in map.records.iter().enumerate() {
        output.count(index, &record.outcome.as_deref().copied().unwrap_or_default());
    }
    output.judged = judged
        .iter()
        .map(|&index| map.records[index].outcome.as_deref().copied().unwrap_or_default())
        .collect();
    Ok(output)
}
