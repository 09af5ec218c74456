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
    let adapter = Adapter::best(asked, options.adapter)?;
    if options.require_gpu && adapter.is_software() {
        return Err(Error::NoHardware { instead: adapter.describe().to_string() });
    }
    let why = if adapter.is_software() {
        "the best adapter there is, but it is software on the CPU and slower than --backend cpu"
    } else {
        "as asked for"
    };
    let (engine, on) = engine(Device::open(&adapter, asked)?, options);
    Ok((engine, on, why.to_owned()))
}

/// The best hardware GPU, and what is said of it.
pub(crate) fn hardware(
    options: &Options,
    spec: &dyn Instances,
) -> std::result::Result<(Box<dyn Engine>, String), NoGpu> {
    response::check(spec).map_err(NoGpu::Failed)?;
    let asked = arithmetic(options);
    let adapter = Adapter::best(asked, options.adapter).map_err(NoGpu::Failed)?;
    if adapter.is_software() {
        return Err(NoGpu::Software(adapter.describe().to_string()));
    }
    Ok(engine(Device::open(&adapter, asked).map_err(NoGpu::Failed)?, options))
}

/// An open device as an engine, and what is said of it.
fn engine(device: Device, options: &Options) -> (Box<dyn Engine>, String) {
    let strict = if device.strict() { "strict " } else { "" };
    let on = format!("on {} in {strict}{}", device.describe(), device.precision());
    (Box::new(Gpu::new(device, options.chunk)), on)
}

/// What a GPU computes in.
fn arithmetic(options: &Options) -> Arithmetic {
    Arithmetic { precision: options.precision.unwrap_or(Precision::F32), strict: options.strict }
}
