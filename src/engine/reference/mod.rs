//! The f64 reference, one instance at a time.
//!
//! - [`records`](mod@records): a sweep on all cores.
//! - [`respond`](mod@respond): one instance: start, settle, measure, outcome.
//! - [`integrate`]: smooth steps between located events.
//! - [`observe`]: sums and extremes of one trajectory.

pub mod bounds;
mod hunt;
pub mod integrate;
pub mod observe;
pub mod observer;
mod phase;
pub mod records;
pub mod resolution;
pub mod respond;
mod section;
mod watched;
