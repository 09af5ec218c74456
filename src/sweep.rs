//! The spine: spec → engine → records → map.

use std::time::Instant;

use crate::backend::choice::{Engine, Options, choose};
use crate::backend::gpu::device::Device;
use crate::backend::{cpu, gpu};
use crate::error::Result;
use crate::map::{Computation, Map, Provenance, Record};
use crate::spec::{Analysis, Spec};

/// Computes a sweep; the CPU's part runs on the rayon pool it is called in. `progress` gets the number of
/// newly finished instances.
///
/// # Errors
/// When the backend cannot compute the sweep, fails, or the run is cancelled.
pub fn run(spec: Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let (records, linear, response) = match choose(options, &spec)? {
        Engine::Cpu => {
            let records = cpu::records(&spec, options.cancel(), progress)?;
            (records, cpu::computation(cpu::linear_method()), cpu::computation(cpu::method()))
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
    Ok(Map { spec, records, provenance })
}

/// The records of a sweep from a GPU; only the last analysis counts as progress.
fn on_gpu(
    spec: &Spec,
    device: &Device,
    options: &Options,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Record>> {
    let Analysis { linear, response } = spec.analysis;
    let quiet = |_: usize| {};
    let mut records = if linear {
        gpu::linear::records(spec, device, options, if response { &quiet } else { progress })?
    } else {
        vec![Record::default(); spec.grid.len()]
    };
    if response {
        gpu::response::complete(spec, device, options, progress, &mut records)?;
    }
    Ok(records)
}
