//! What computes the cells that are asked for.

use std::sync::{Mutex, PoisonError};

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::choice::choose;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::sweep::spec::Spec;

/// What computes.
#[derive(Clone, Copy)]
pub struct By<'a> {
    /// Which engine, and when to stop.
    pub options: Options<'a>,
    /// An engine that is open already, as a GPU is, and takes one question at a time.
    pub open: Option<&'a Mutex<Box<dyn Engine>>>,
}

impl std::fmt::Debug for By<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("By").field("backend", &self.options.backend).finish_non_exhaustive()
    }
}

impl By<'_> {
    /// The engine of the CPU.
    #[must_use]
    pub fn cpu() -> By<'static> {
        By { options: Options { backend: Backend::Cpu, ..Options::default() }, open: None }
    }

    /// The records of all instances of a sweep of one start each, on the rayon pool that it is called in; transients in `f32` where that
    /// is enough and no other precision was asked for.
    ///
    /// # Errors
    /// A sentence, when the engine cannot compute them, or is stopped.
    pub fn records(&self, spec: &Spec, f32: bool) -> Result<Vec<Record>, String> {
        let (total, cancel) = (spec.grid.len(), self.options.cancel());
        let computed = if let Some(engine) = self.open {
            let mut engine = engine.lock().unwrap_or_else(PoisonError::into_inner);
            engine.records(spec, 0..total, cancel, &|_| ())
        } else {
            let is_enough = f32 && spec.analysis.response && self.options.backend == Backend::Cpu;
            let precision = self.options.precision.or(is_enough.then_some(Precision::F32));
            choose(&Options { precision, ..self.options }, spec)
                .and_then(|mut engine| engine.records(spec, 0..total, cancel, &|_| ()))
        };
        let computed = computed.map_err(|why| why.to_string())?;
        computed.stopped.map_or(Ok(computed.records), |why| Err(why.error(0, total).to_string()))
    }
}
