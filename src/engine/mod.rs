//! Instances integrated: the engines, and everything that they have in common.
//!
//! | question | where |
//! |---|---|
//! | what an engine is, and what it is given | [`Engine`], [`instances`], [`plan`] |
//! | one instance scaled, at its start | [`scene`], `belt.rs`, `start.rs` |
//! | what an engine sums up, and what it did | [`sums`], [`growth`](mod@growth), [`reductions`], [`outcome`], [`regime`] |
//! | what small motions see of a kink of the friction law | `kinks.rs` |
//! | until when it is followed | [`measuring`], [`settling`] |
//! | the cycle that it comes to | [`cycle`] |
//! | the words of a kernel | [`fields`], [`march::table`] |
//! | the record of an instance | [`record`], [`judged`] |
//! | where and how a sweep was computed, and its records | [`computation`], [`computed`] |
//! | one step, events inside it | [`method`] |
//! | the f64 reference, which judges the others | [`reference`](mod@reference) |
//! | the twins of the compute kernels | [`kernel`] |
//! | vector registers of all cores | [`lanes`] |
//! | that engine's method as a compute kernel | `march` |
//! | compute kernels through wgpu | [`gpu`] |
//! | which of them computes, in which precision, and why | [`choice`], [`options`], [`backend`], [`precision`], `fallback.rs` |
//! | why none computes, or one stopped | [`error`] |

pub mod backend;
mod belt;
pub mod choice;
pub mod computation;
pub mod computed;
pub mod course;
pub mod cycle;
pub mod error;
mod fallback;
pub mod fields;
#[cfg(feature = "gpu")]
pub mod gpu;
#[cfg(not(feature = "gpu"))]
#[path = "no_gpu.rs"]
pub mod gpu;
pub mod growth;
pub mod instances;
pub mod judged;
pub mod kernel;
mod kinks;
pub mod lanes;
#[cfg(feature = "kernels")]
pub mod march;
pub mod measuring;
pub mod method;
pub mod options;
pub mod outcome;
pub mod plan;
pub mod precision;
pub mod record;
pub mod reductions;
pub mod reference;
pub mod regime;
pub mod scene;
pub mod settling;
pub(crate) mod start;
pub mod sums;

use std::fmt;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use crate::engine::backend::Backend;
use crate::engine::computation::Computation;
use crate::engine::computed::Computed;
use crate::engine::error::Result;
use crate::engine::instances::Instances;
use crate::engine::precision::Precision;

/// Starts that a CPU takes at a time of instances with several.
const STARTS_ON_A_CPU: usize = 2048;

/// An engine computes many instances from one start each, without any check.
pub trait Engine: fmt::Debug + Send {
    /// Its name.
    fn backend(&self) -> Backend;

    /// Its scalar.
    fn precision(&self) -> Precision;

    /// Where and how it computes the eigenvalue analysis and the response of a sweep.
    fn computations(&self, instances: &dyn Instances) -> [Computation; 2];

    /// The records of the instances `range`, in order; the CPU's part runs on the rayon pool it is called in. `progress` gets the
    /// number of newly finished instances. What is cancelled or fails on its way gives what is done, see [`Computed::stopped`].
    ///
    /// # Errors
    /// When it fails or is cancelled before any instance of the range is done, or a result is in doubt.
    fn records(
        &mut self,
        instances: &dyn Instances,
        range: Range<usize>,
        cancel: &AtomicBool,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed>;

    /// As [`Engine::records`]. Of the `ahead` instances behind the range, for which the next call asks, it may begin some, so that the last
    /// ones of the range are not alone.
    ///
    /// # Errors
    /// As [`Engine::records`].
    fn records_ahead(
        &mut self,
        instances: &dyn Instances,
        range: Range<usize>,
        _ahead: usize,
        cancel: &AtomicBool,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        self.records(instances, range, cancel, progress)
    }

    /// How many instances behind a range of these it begins at most.
    fn ahead(&self, _instances: &dyn Instances) -> usize {
        0
    }

    /// The least number of instances, of `starts` starts each, that keeps it busy: with fewer, cores or lanes are left
    /// without work. Where instances are so costly that a tile has few, a core takes no more than a tile at a time, so that
    /// a stop does not lose many.
    fn busy_with(&self, tile: usize, starts: usize) -> usize;

    /// Starts that it takes at a time of `instances` with several: some batches for each core, and less than a second's
    /// work of cheap ones, which a stop would lose.
    fn at_once(&self, _instances: usize) -> usize {
        STARTS_ON_A_CPU
    }
}
