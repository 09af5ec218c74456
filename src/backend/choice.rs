//! What computes a sweep: the CPU engine or a GPU, in which precision, and why.

use std::sync::atomic::AtomicBool;

use super::gpu::adapter::Adapter;
use super::gpu::device::{Arithmetic, Device};
use super::gpu::response;
use crate::error::{Error, Result};
use crate::kernel::source::Precision;
use crate::spec::Spec;

/// The backend that is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// A hardware GPU where there is one, else the CPU engine.
    #[default]
    Auto,
    /// A GPU, or a software adapter.
    Gpu,
    /// The CPU engine.
    Cpu,
}

/// How a sweep is to be computed.
#[derive(Clone, Copy, Default)]
pub struct Options<'a> {
    /// The backend.
    pub backend: Backend,
    /// The scalar; `None`: f64 on the CPU, f32 on a GPU.
    pub precision: Option<Precision>,
    /// Whether a GPU rounds every operation by itself: where it also divides exactly and keeps denormals, results
    /// are those of the kernel's twin in every bit.
    pub strict: bool,
    /// An error unless a hardware GPU computes.
    pub require_gpu: bool,
    /// Only adapters whose name contains this, in any case.
    pub adapter: Option<&'a str>,
    /// Most instances of one chunk on a GPU; results do not depend on it.
    pub chunk: Option<usize>,
    /// Set to stop early.
    pub cancel: Option<&'a AtomicBool>,
    /// Gets one line: what computes, and why.
    pub note: Option<&'a (dyn Fn(&str) + Sync)>,
}

/// The flag of a run that nobody cancels.
static NEVER: AtomicBool = AtomicBool::new(false);

impl<'a> Options<'a> {
    /// Set when the run is to stop.
    #[must_use]
    pub fn cancel(&self) -> &'a AtomicBool {
        self.cancel.unwrap_or(&NEVER)
    }

    /// What a GPU computes in.
    fn arithmetic(&self) -> Arithmetic {
        Arithmetic { precision: self.precision.unwrap_or(Precision::F32), strict: self.strict }
    }
}

/// What computes.
#[derive(Debug)]
pub enum Engine {
    /// The f64 reference on all cores.
    Cpu,
    /// An open adapter.
    Gpu(Device),
}

/// Chooses the engine of a sweep and says why to `options.note`.
///
/// # Errors
/// When the backend that is asked for is not there, lacks the precision or cannot compute the analysis.
pub fn choose(options: &Options, spec: &Spec) -> Result<Engine> {
    let (engine, why) = match options.backend {
        Backend::Cpu if options.strict => return Err(Error::CpuStrict),
        Backend::Cpu => (cpu(options)?, "as asked for".to_owned()),
        Backend::Gpu => gpu(options, spec)?,
        Backend::Auto => auto(options, spec)?,
    };
    if let Some(note) = options.note {
        note(&match &engine {
            Engine::Cpu => format!("computing on the CPU in f64: {why}"),
            Engine::Gpu(device) => {
                let strict = if device.strict() { "strict " } else { "" };
                format!("computing on {} in {strict}{}: {why}", device.describe(), device.precision())
            }
        });
    }
    Ok(engine)
}

fn cpu(options: &Options) -> Result<Engine> {
    if options.precision == Some(Precision::F32) {
        return Err(Error::CpuPrecision);
    }
    if options.require_gpu {
        return Err(Error::NoHardware { instead: "the CPU engine".to_owned() });
    }
    Ok(Engine::Cpu)
}

fn gpu(options: &Options, spec: &Spec) -> Result<(Engine, String)> {
    response::check(spec)?;
    let arithmetic = options.arithmetic();
    let adapter = Adapter::best(arithmetic, options.adapter)?;
    if options.require_gpu && adapter.is_software() {
        return Err(Error::NoHardware { instead: adapter.describe().to_string() });
    }
    let why = if adapter.is_software() {
        "the best adapter there is, but it is software on the CPU and slower than --backend cpu"
    } else {
        "as asked for"
    };
    Ok((Engine::Gpu(Device::open(&adapter, arithmetic)?), why.to_owned()))
}

fn auto(options: &Options, spec: &Spec) -> Result<(Engine, String)> {
    let fallback = |why: String| {
        if options.require_gpu {
            return Err(Error::NoHardware { instead: format!("the CPU engine ({why})") });
        }
        Ok((cpu(options)?, why))
    };
    if let Err(why) = response::check(spec) {
        return fallback(why.to_string());
    }
    let arithmetic = options.arithmetic();
    let adapter = match Adapter::best(arithmetic, options.adapter) {
        Ok(adapter) => adapter,
        Err(why @ (Error::NoAdapter { .. } | Error::NoF64 { .. } | Error::NoStrict { .. })) => {
            return fallback(why.to_string());
        }
        Err(other) => return Err(other),
    };
    if adapter.is_software() {
        return fallback(format!("the only adapter, {}, is software", adapter.describe()));
    }
    match Device::open(&adapter, arithmetic) {
        Ok(device) => Ok((Engine::Gpu(device), "the best GPU of this machine".to_owned())),
        Err(why) => fallback(why.to_string()),
    }
}
