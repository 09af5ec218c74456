//! What is not a sweep of instances: each with its table, its figure, and what reads it back.
//!
//! [`modes`] follows eigenvalues, [`trace`] one instance over time, [`hysteresis`] a cycle along a parameter, [`tradeoff`] speed
//! against error, [`fit`] measured friction, [`identify`] measured signals, [`signals`] an instance as sensors record it, [`paper`] the source
//! paper. `kind.rs` and `picture.rs` draw the figure of any directory again.

#[cfg(all(feature = "figures", feature = "identify"))]
pub use kind::Kind;
#[cfg(all(feature = "figures", feature = "identify"))]
pub use picture::Picture;

pub mod error;
#[cfg(feature = "identify")]
pub mod fit;
pub mod hysteresis;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod identify;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod kind;
pub mod modes;
#[cfg(feature = "figures")]
pub mod paper;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod picture;
pub mod signals;
pub mod trace;
#[cfg(feature = "figures")]
pub mod tradeoff;
