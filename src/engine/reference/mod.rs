//! The f64 reference, one instance at a time.
//!
//! - [`records`](mod@records): a sweep on all cores.
//! - [`respond`](mod@respond): one instance: start, settle, measure, outcome.
//! - [`integrate`]: smooth steps between located events.
//! - [`observe`]: sums and extremes of one trajectory.

pub mod bounds;
pub mod integrate;
pub mod observe;
pub mod observer;
pub mod records;
pub mod resolution;
pub mod respond;
mod watched;
