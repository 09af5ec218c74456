//! squealmap: stability maps of friction-induced vibration.

pub mod backend;
pub mod classify;
pub mod error;
pub mod estimate;
pub mod export;
pub mod grid;
pub mod integrate;
pub mod linear;
pub mod map;
pub mod method;
pub mod model;
pub mod observe;
pub mod outcome;
mod place;
pub mod response;
pub mod spec;
pub mod sweep;
pub mod trace;

pub use error::{Error, Result};
