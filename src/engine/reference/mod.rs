//! The f64 reference, one instance at a time.
//!
//! - [`records`](mod@records): a sweep on all cores.
//! - [`respond`](mod@respond): one instance: start, settle, measure, outcome.
//! - [`integrate`]: smooth steps between located events.
//! - [`observe`]: sums and extremes of one trajectory.
//! - [`orbit`]: cycles and returns without a run around them.

pub mod bounds;
mod heat;
mod hunt;
pub mod integrate;
pub mod observe;
pub mod observer;
pub mod orbit;
mod phase;
pub mod records;
pub mod resolution;
pub mod respond;
mod round;
mod section;
mod watched;
