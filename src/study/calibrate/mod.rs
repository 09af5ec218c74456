//! Measurements of a structure → the two-mass model that has them.
//!
//! - [`Measured`], [`calibrate`]: `solve.rs`, in closed form but for the inclination; `system.rs`: the same model without friction.
//! - [`sweep`]: the sweep file of the model.
//! - `fault.rs`: why there is none.

mod fault;
mod solve;
pub mod sweep;
mod system;

pub use fault::Fault;
pub use solve::{Calibrated, Measured, calibrate};
#[cfg(all(feature = "figures", feature = "identify"))]
pub(crate) use solve::{MOST, coalescence};
