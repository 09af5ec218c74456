//! Sweeps: files, grids, labels, checks, several starts, refinement.

pub(crate) mod accuracy;
mod belt;
pub(crate) mod bistable;
pub(crate) mod build;
pub(crate) mod checks;
pub(crate) mod input_files;
pub(crate) mod label;
pub(crate) mod modal;
mod modal_sweeps;
pub(crate) mod promise;
pub(crate) mod refine;
pub(crate) mod spec;
pub(crate) mod stopped;
pub(crate) mod sweeps;
mod tables;
