//! A sweep as jobs of a cluster.
//!
//! - [`tasks`]: into how many tasks a sweep is cut.
//! - [`slurm`]: the scripts that compute and join them.

pub mod slurm;
pub mod tasks;
