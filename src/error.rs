//! The one error type.

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {}

/// The crate's result.
pub type Result<T> = std::result::Result<T, Error>;
