//! The choice of an engine for a sweep: which one, in which precision, and why.

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::error::{Error, Result};
use crate::engine::fallback::{NoGpu, only_on_gpu};
use crate::engine::gpu::open;
use crate::engine::instances::Instances;
use crate::engine::lanes::records::Cpu;
use crate::engine::method::Method;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::engine::reference::records::Scalar;

/// Chooses the engine of a sweep and says why to `options.note`.
///
/// # Errors
/// When the backend that is asked for is not there, lacks the precision or cannot compute the analysis; when
/// an option would have no effect on what computes.
pub fn choose(options: &Options, spec: &dyn Instances) -> Result<Box<dyn Engine>> {
    if let Some(name) = options.adapters.iter().find(|name| name.trim().is_empty()) {
        return Err(Error::EmptyAdapter { name: name.clone() });
    }
    if spec.modal() && options.backend == Backend::Gpu {
        return Err(Error::ModalOnGpu);
    }
    let (engine, on, why): (Box<dyn Engine>, String, String) = match options.backend {
        Backend::Gpu => open::asked(options, spec)?,
        Backend::Auto => auto(options, spec)?,
        _ => {
            let (engine, on) = cpu(options, spec)?;
            (engine, on, "as asked for".to_owned())
        }
    };
    if let Some(note) = options.note {
        note(&format!("computing {on}: {why}"));
    }
    Ok(engine)
}

/// Where the CPU engine computes, in words.
fn on_cpu(precision: Precision, spec: &dyn Instances) -> String {
    match precision {
        Precision::F32 if !spec.response() => "on the CPU in f64, as eigenvalues always are".to_owned(),
        _ => format!("on the CPU in {precision}"),
    }
}

fn cpu(options: &Options, spec: &dyn Instances) -> Result<(Box<dyn Engine>, String)> {
    if options.strict {
        return Err(Error::CpuStrict);
    }
    if let Some(name) = options.adapters.first() {
        return Err(Error::CpuAdapter { name: name.clone() });
    }
    if options.require_gpu {
        return Err(Error::CpuRequireGpu);
    }
    let Some(method) = options.backend.method() else {
        let precision = options.precision.unwrap_or(Precision::F64);
        return Ok((Box::new(Cpu(precision)), on_cpu(precision, spec)));
    };
    if options.precision == Some(Precision::F32) {
        return Err(Error::ReferencePrecision);
    }
    let on = match method {
        Method::Taylor => "with the f64 reference".to_owned(),
        method => format!("by {} in f64", Backend::of_method(method).name()),
    };
    Ok((Box::new(Scalar(method)), on))
}

fn auto(options: &Options, spec: &dyn Instances) -> Result<(Box<dyn Engine>, String, String)> {
    let precision = options.precision.unwrap_or(Precision::F64);
    let by_cpu = |why| Ok::<_, Error>((Box::new(Cpu(precision)) as _, on_cpu(precision, spec), why));
    // The host takes as long to send an instance as to compute its eigenvalues.
    if !spec.response() && only_on_gpu(options).is_empty() {
        return by_cpu("a GPU gains nothing where eigenvalues alone are asked for".to_owned());
    }
    let hardware =
        if spec.modal() { Err(NoGpu::Failed(Error::ModalOnGpu)) } else { open::hardware(options, spec) };
    let no_gpu = match hardware {
        Ok((engine, on)) => return Ok((engine, on, "the best GPU of this machine".to_owned())),
        // A name that is nowhere is a slip of the pen, not a machine without a GPU.
        Err(NoGpu::Failed(why @ Error::NoSuchAdapter { .. })) => return Err(why),
        Err(no_gpu) => no_gpu,
    };
    no_gpu.allows_cpu(options)?;
    by_cpu(no_gpu.note())
}
