//! What computes a sweep: the CPU engine or a GPU, in which precision, and why.

use std::sync::atomic::AtomicBool;

use crate::engine::fallback::NoGpu;
use crate::engine::gpu;
use crate::engine::gpu::adapter::Adapter;
use crate::engine::gpu::device::{Arithmetic, Device};
use crate::engine::gpu::response;
use crate::engine::instances::Instances;
use crate::engine::kernel::source::Precision;
use crate::engine::lanes::records as cpu;
use crate::engine::method::Method;
use crate::engine::reference::records as reference;
use crate::error::{Error, Result};

/// The backend that is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// A hardware GPU where there is one, else the CPU engine.
    #[default]
    Auto,
    /// A GPU, or a software adapter.
    Gpu,
    /// The CPU engine: many instances at a time in vector registers.
    Cpu,
    /// The f64 reference, one instance at a time.
    Reference,
    /// Runge–Kutta steps in its place, events located: to compare with.
    LocatedRk4,
    /// Runge–Kutta steps in its place, events at their ends: to compare with.
    FixedStep,
}

impl Backend {
    /// The one of this name in a [`crate::engine::computation::Computation`].
    #[must_use]
    pub fn of_name(name: &str) -> Option<Backend> {
        match name {
            gpu::NAME => Some(Backend::Gpu),
            cpu::NAME => Some(Backend::Cpu),
            name => [Backend::Reference, Backend::LocatedRk4, Backend::FixedStep]
                .into_iter()
                .find(|one| one.method().is_some_and(|method| reference::name(method) == name)),
        }
    }

    /// Whether it is there to be compared with: no accuracy is reached by it that another does not reach faster.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        matches!(self, Backend::LocatedRk4 | Backend::FixedStep)
    }

    /// The method of those that compute one instance at a time in f64.
    #[must_use]
    pub fn method(self) -> Option<Method> {
        match self {
            Backend::Reference => Some(Method::Taylor),
            Backend::LocatedRk4 => Some(Method::LocatedRk4),
            Backend::FixedStep => Some(Method::FixedStep),
            Backend::Auto | Backend::Gpu | Backend::Cpu => None,
        }
    }
}

/// How a sweep is to be computed.
#[derive(Clone, Copy, Default)]
pub struct Options<'a> {
    /// The backend.
    pub backend: Backend,
    /// The scalar; `None`: f64 on the CPU, f32 on a GPU. f32 is an error for the reference.
    pub precision: Option<Precision>,
    /// Whether a GPU rounds every operation by itself: where it also divides exactly and keeps denormals, results
    /// are those of the kernel's twin in every bit. An error where the CPU engine would compute.
    pub strict: bool,
    /// An error unless a hardware GPU computes.
    pub require_gpu: bool,
    /// Only adapters whose name contains this, in any case. An error where the CPU engine would compute, or
    /// when it is blank.
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
    /// The CPU engine.
    Cpu(Precision),
    /// One instance at a time in f64 by this method, that of the reference or one to compare with.
    Reference(Method),
    /// An open adapter.
    Gpu(Device),
}

/// Chooses the engine of a sweep and says why to `options.note`.
///
/// # Errors
/// When the backend that is asked for is not there, lacks the precision or cannot compute the analysis; when
/// an option would have no effect on what computes.
pub fn choose(options: &Options, spec: &dyn Instances) -> Result<Engine> {
    if let Some(name) = options.adapter.filter(|name| name.trim().is_empty()) {
        return Err(Error::EmptyAdapter { name: name.to_owned() });
    }
    let (engine, why) = match options.backend {
        Backend::Gpu => gpu(options, spec)?,
        Backend::Auto => auto(options, spec)?,
        _ => (cpu(options)?, "as asked for".to_owned()),
    };
    if let Some(note) = options.note {
        note(&match &engine {
            Engine::Cpu(precision) => format!("computing on the CPU in {precision}: {why}"),
            Engine::Reference(Method::Taylor) => format!("computing with the f64 reference: {why}"),
            Engine::Reference(method) => format!("computing by {} in f64: {why}", reference::name(*method)),
            Engine::Gpu(device) => {
                let strict = if device.strict() { "strict " } else { "" };
                format!("computing on {} in {strict}{}: {why}", device.describe(), device.precision())
            }
        });
    }
    Ok(engine)
}

fn cpu(options: &Options) -> Result<Engine> {
    if options.strict {
        return Err(Error::CpuStrict);
    }
    if let Some(name) = options.adapter {
        return Err(Error::CpuAdapter { name: name.to_owned() });
    }
    if options.require_gpu {
        return Err(Error::CpuRequireGpu);
    }
    if let Some(method) = options.backend.method() {
        if options.precision == Some(Precision::F32) {
            return Err(Error::ReferencePrecision);
        }
        return Ok(Engine::Reference(method));
    }
    Ok(Engine::Cpu(options.precision.unwrap_or(Precision::F64)))
}

fn gpu(options: &Options, spec: &dyn Instances) -> Result<(Engine, String)> {
    response::check(spec).map_err(|why| {
        // Its advice, the CPU engine, would be refused next.
        let asked = ["--backend gpu", "--require-gpu"].map(str::to_owned);
        if options.require_gpu { NoGpu::Failed(why).refusal(&asked, true) } else { why }
    })?;
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

fn auto(options: &Options, spec: &dyn Instances) -> Result<(Engine, String)> {
    let no_gpu = match hardware(options, spec) {
        Ok(device) => return Ok((Engine::Gpu(device), "the best GPU of this machine".to_owned())),
        // A name that is nowhere is a slip of the pen, not a machine without a GPU.
        Err(NoGpu::Failed(why @ Error::NoSuchAdapter { .. })) => return Err(why),
        Err(no_gpu) => no_gpu,
    };
    no_gpu.allows_cpu(options)?;
    Ok((Engine::Cpu(options.precision.unwrap_or(Precision::F64)), no_gpu.note()))
}

/// The best hardware GPU, open.
fn hardware(options: &Options, spec: &dyn Instances) -> std::result::Result<Device, NoGpu> {
    response::check(spec).map_err(NoGpu::Failed)?;
    let arithmetic = options.arithmetic();
    let adapter = Adapter::best(arithmetic, options.adapter).map_err(NoGpu::Failed)?;
    if adapter.is_software() {
        return Err(NoGpu::Software(adapter.describe().to_string()));
    }
    Device::open(&adapter, arithmetic).map_err(NoGpu::Failed)
}
