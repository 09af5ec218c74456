//! A sweep as jobs of a cluster: how many shares, and the scripts that compute and join them.

pub mod slurm;
pub mod tasks;
