//! The spine: spec → engine → records → map.

use std::time::Instant;

use crate::backend::choice::{Engine, Options, choose};
use crate::backend::computed::Computed;
use crate::backend::{cpu, gpu};
use crate::error::Result;
use crate::map::{Computation, Map, Provenance};
use crate::spec::Spec;

/// Computes a sweep; the CPU's part runs on the rayon pool it is called in. `progress` gets the number of
/// newly finished instances. A run that is cancelled or fails on its way gives what is done, see
/// [`Map::stopped`].
///
/// # Errors
/// When the backend cannot compute the sweep, or the run is cancelled or fails before any instance is done.
pub fn run(spec: Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let (computed, linear, response) = match choose(options, spec.analysis)? {
        Engine::Cpu => {
            let computed = cpu::records(&spec, options.cancel(), progress)?;
            (computed, cpu::computation(cpu::linear_method()), cpu::computation(cpu::method()))
        }
        Engine::Gpu(device) => {
            let on_device = |method| Computation {
                backend: gpu::NAME.to_owned(),
                precision: device.precision().to_string(),
                method,
                adapter: Some(device.describe().to_string()),
            };
            // The response kernel takes its place here; until then `choose` sends no response to a GPU.
            let (linear, response) = (on_device(gpu::linear::method()), on_device(String::new()));
            (gpu::linear::records(&spec, device, options, progress)?, linear, response)
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
