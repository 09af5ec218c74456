//! The instances that are given to an engine.

use crate::engine::plan::Plan;
use crate::model::instance::Instance;

/// The instances that an engine computes, and what is asked of each.
pub trait Instances: Sync {
    /// Instance `index`.
    ///
    /// # Panics
    /// When there are not so many.
    fn instance(&self, index: usize) -> Instance;

    /// How each is integrated.
    fn plan(&self) -> Plan;

    /// Whether the eigenvalues of each are asked for.
    fn linear(&self) -> bool;

    /// Whether the transient of each is asked for.
    fn response(&self) -> bool;

    /// Whether they are of a modal model.
    fn modal(&self) -> bool;

    /// The pieces of the longest friction law.
    fn pieces(&self) -> usize;
}
