//! Instances integrated: what becomes of each, by the reference, in vector registers, or on a GPU.
//!
//! | question | where |
//! |---|---|
//! | what an engine is given | [`instances`], [`plan`] |
//! | one instance scaled, at its start | [`scene`], `start.rs` |
//! | what it did, and until when it is followed | [`outcome`], [`regime`], [`settling`] |
//! | the record of an instance | [`record`], [`judged`], [`computation`], [`computed`] |
//! | one step, events inside it | [`method`] |
//! | the f64 reference, which judges the others | [`reference`](mod@reference) |
//! | the twins of the compute kernels | [`kernel`] |
//! | vector registers of all cores | [`lanes`] |
//! | compute kernels through wgpu | [`gpu`] |
//! | which of them computes, in which precision, and why | [`choice`], `fallback.rs` |

pub mod choice;
pub mod computation;
pub mod computed;
pub mod fallback;
pub mod gpu;
pub mod instances;
pub mod judged;
pub mod kernel;
pub mod lanes;
pub mod method;
pub mod outcome;
pub mod plan;
pub mod record;
pub mod reference;
pub mod regime;
pub mod scene;
pub mod settling;
pub mod start;
