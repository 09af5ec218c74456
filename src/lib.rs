//! squealmap: stability maps of friction-induced vibration.

pub mod classify;
pub mod error;
pub mod export;
pub mod grid;
pub mod linear;
pub mod map;
pub mod model;
pub mod outcome;
pub mod spec;
pub mod trace;

pub use error::{Error, Result};
