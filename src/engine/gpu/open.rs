//! The device that a sweep is computed on, as an engine.

use crate::engine::Engine;
use crate::engine::error::{Error, Result};
use crate::engine::fallback::NoGpu;
use crate::engine::gpu::adapter::Adapter;
use crate::engine::gpu::arithmetic::Arithmetic;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::records::Gpu;
use crate::engine::gpu::response;
use crate::engine::instances::Instances;
use crate::engine::options::Options;
use crate::engine::precision::Precision;

/// The best adapter of those that were asked for, what is said of it, and why it is taken.
pub(crate) fn asked(options: &Options, spec: &dyn Instances) -> Result<(Box<dyn Engine>, String, String)> {
    response::check(spec).map_err(|why| {
        // Its advice, the CPU engine, would be refused next.
        let asked = ["--backend gpu", "--require-gpu"].map(str::to_owned);
        if options.require_gpu { NoGpu::Failed(why).refusal(&asked, true) } else { why }
    })?;
    let asked = arithmetic(options);
    let adapters = Adapter::several(asked, options.adapters)?;
    let software = adapters.iter().find(|adapter| adapter.is_software());
    if let Some(software) = software.filter(|_| options.require_gpu) {
        return Err(Error::NoHardware { instead: software.describe().to_string() });
    }
    let why =
        if software.is_none() || !options.adapters.is_empty() && !adapters.iter().all(Adapter::is_software) {
            "as asked for"
        } else {
            "the best adapter there is, but it is software on the CPU and slower than --backend cpu"
        };
    let (engine, on) = engine(&adapters, options)?;
    Ok((engine, on, why.to_owned()))
}

/// The best hardware GPUs, and what is said of them.
pub(crate) fn hardware(
    options: &Options,
    spec: &dyn Instances,
) -> std::result::Result<(Box<dyn Engine>, String), NoGpu> {
    response::check(spec).map_err(NoGpu::Failed)?;
    let adapters = Adapter::several(arithmetic(options), options.adapters).map_err(NoGpu::Failed)?;
    if let Some(software) = adapters.iter().find(|adapter| adapter.is_software()) {
        return Err(NoGpu::Software(software.describe().to_string()));
    }
    engine(&adapters, options).map_err(NoGpu::Failed)
}

/// Adapters, opened, as an engine, and what is said of it.
fn engine(adapters: &[Adapter], options: &Options) -> Result<(Box<dyn Engine>, String)> {
    let asked = arithmetic(options);
    let devices = adapters.iter().map(|adapter| Device::open(adapter, asked)).collect::<Result<Vec<_>>>()?;
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.describe().to_string()).collect();
    let strict = if asked.strict { "strict " } else { "" };
    let on = format!("on {} in {strict}{}", names.join(" and "), asked.precision);
    Ok((Box::new(Gpu::new(devices, options.chunk)), on))
}

/// What a GPU computes in.
fn arithmetic(options: &Options) -> Arithmetic {
    Arithmetic { precision: options.precision.unwrap_or(Precision::F32), strict: options.strict }
}
