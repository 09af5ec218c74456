//! Studies: computations that are no sweep of instances. Each has its table, its figure, and a reader of both.
//!
//! [`modes`] follows eigenvalues, [`trace`] one instance over time, [`hysteresis`] a cycle along a parameter, [`tradeoff`] speed
//! against error, [`fit`] measured friction, [`identify`] measured signals, [`signals`] an instance as sensors record it, [`paper`] the source
//! paper. `kind.rs` and `picture.rs` draw the figure of any directory again.

pub use kind::Kind;
pub use picture::Picture;

pub mod error;
pub mod fit;
pub mod hysteresis;
pub mod identify;
pub mod kind;
pub mod modes;
pub mod paper;
pub mod picture;
pub mod signals;
pub mod trace;
pub mod tradeoff;
