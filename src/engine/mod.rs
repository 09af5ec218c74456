//! Instances integrated: what becomes of each, by the reference, in vector registers, or on a GPU.
//!
//! | question | where |
//! |---|---|
//! | what an engine is, and what it is given | [`Engine`], [`instances`], [`plan`] |
//! | one instance scaled, at its start | [`scene`], `start.rs` |
//! | what an engine sums up, and what it did | [`sums`], [`growth`](mod@growth), [`reductions`], [`outcome`], [`regime`] |
//! | until when it is followed | [`measuring`], [`settling`] |
//! | the words of a kernel | [`fields`], [`kernel::table`] |
//! | the record of an instance | [`record`], [`judged`], [`computation`], [`computed`] |
//! | one step, events inside it | [`method`] |
//! | the f64 reference, which judges the others | [`reference`](mod@reference) |
//! | the twins of the compute kernels | [`kernel`] |
//! | vector registers of all cores | [`lanes`] |
//! | compute kernels through wgpu | [`gpu`] |
//! | which of them computes, in which precision, and why | [`choice`], [`options`], [`backend`], `fallback.rs` |

pub mod backend;
pub mod choice;
pub mod computation;
pub mod computed;
pub mod error;
mod fallback;
pub mod fields;
pub mod gpu;
pub mod growth;
pub mod instances;
pub mod judged;
pub mod kernel;
pub mod lanes;
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

/// What computes many instances: one start each, without any check.
pub trait Engine: fmt::Debug + Send {
    /// Which it is.
    fn backend(&self) -> Backend;

    /// Its scalar.
    fn precision(&self) -> Precision;

    /// Where and how it computes the eigenvalue analysis and the response, with so many steps per period.
    fn computations(&self, steps_per_period: u32) -> [Computation; 2];

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

    /// Instances of `starts` starts each that keep it busy, at least: ranges of fewer leave cores or lanes without work. Of
    /// instances so dear that a tile has few, a core takes no more than a tile at a time, lest a stop loses many.
    fn busy_with(&self, tile: usize, starts: usize) -> usize;

    /// Starts that it takes at a time of `instances` with several: some batches for each core, and less than a second's
    /// work of cheap ones, which a stop would lose.
    fn at_once(&self, instances: usize) -> usize;
}
