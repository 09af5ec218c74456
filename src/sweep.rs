//! The spine: spec → engine → records → map.

use std::time::Instant;

use crate::backend::choice::{Engine, Options, choose};
use crate::backend::{cpu, gpu};
use crate::error::Result;
use crate::map::{Computation, Map, Provenance};
use crate::spec::Spec;

/// Computes a sweep; the CPU's part runs on the rayon pool it is called in. `progress` gets the number of
/// newly finished instances.
///
/// # Errors
/// When the backend cannot compute the sweep, fails, or the run is cancelled.
pub fn run(spec: Spec, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let (records, linear, response) = match choose(options, spec.analysis)? {
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
    Ok(Map { spec, records, provenance })
}
