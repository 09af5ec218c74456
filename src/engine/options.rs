//! How a sweep is to be computed.

use std::sync::atomic::AtomicBool;

use crate::engine::backend::Backend;
use crate::engine::precision::Precision;

/// How a sweep is to be computed.
#[derive(Clone, Copy, Default)]
pub struct Options<'a> {
    /// The backend.
    pub backend: Backend,
    /// The scalar; `None` for f64 on the CPU and f32 on a GPU. The reference refuses f32.
    pub precision: Option<Precision>,
    /// Whether a GPU rounds every operation by itself: where it also divides exactly and keeps denormals, results
    /// are those of the kernel's twin in every bit. An error where the CPU engine would compute.
    pub strict: bool,
    /// An error unless a hardware GPU computes.
    pub require_gpu: bool,
    /// For each of these an adapter whose name contains it, in any case; they share the work. None: all that are as the best
    /// one. An error where the CPU engine would compute, or when one is blank.
    pub adapters: &'a [String],
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
}
