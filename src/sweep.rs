//! The spine: spec → engine → records → map.

use std::time::Instant;

use crate::backend::choice::{Engine, Options, choose};
use crate::backend::computed::Computed;
use crate::backend::gpu::device::Device;
use crate::backend::{cpu, gpu, reference};
use crate::error::Result;
use crate::map::{Computation, Map, Provenance, Record};
use crate::spec::{Analysis, Spec};

/// Computes a sweep; the CPU's part runs on the rayon pool it is called in. `progress` gets the number of
/// newly finished instances. A run that is cancelled or fails on its way gives what is done, see
/// [`Map::stopped`].
///
/// # Errors
/// When the backend cannot compute the sweep, or the run is cancelled or fails before any instance is done.
pub fn run(spec: Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let (computed, linear, response) = match choose(options, &spec)? {
        Engine::Cpu(precision) => {
            let computed = cpu::records(&spec, precision, options.cancel(), progress)?;
            (computed, reference::linear(cpu::NAME), cpu::response(precision, spec.steps_per_period))
        }
        Engine::Reference => {
            let computed = reference::records(&spec, options.cancel(), progress)?;
            (computed, reference::linear(reference::NAME), reference::response())
        }
        Engine::Gpu(device) => {
            let on_device = |method| Computation {
                backend: gpu::NAME.to_owned(),
                precision: device.precision().to_string(),
                method,
                adapter: Some(device.describe().to_string()),
                strict: Some(device.strict()),
            };
            let (linear, response) = (on_device(gpu::linear::method()), on_device(gpu::response::method()));
            (on_gpu(&spec, &device, options, progress)?, linear, response)
        }
    };
    let provenance = Provenance {
        linear: spec.analysis.linear.then_some(linear),
        response: spec.analysis.response.then_some(response),
        threads: rayon::current_num_threads(),
        elapsed: began.elapsed(),
    };
    let Computed { records, stopped } = computed;
    Ok(Map { spec, records, stopped, provenance })
}

/// The records of a sweep from a GPU; only the last analysis counts as progress, and only what has all of
/// them is done.
fn on_gpu(
    spec: &Spec,
    device: &Device,
    options: &Options,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let Analysis { linear, response } = spec.analysis;
    let total = spec.grid.len();
    let mut records = Vec::with_capacity(total);
    let mut ended = Ok(());
    if linear {
        let progress = if response { &|_: usize| {} } else { progress };
        ended = gpu::linear::append(spec, device, options, progress, &mut records);
    }
    if response {
        ended?;
        records.resize(total, Record::default());
        ended = gpu::response::complete(spec, device, options, progress, &mut records);
    }
    Computed::new(records, total, ended)
}
