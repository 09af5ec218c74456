//! The core of the explorer: a sweep that is open, regions of its map, and single cells, asked for and answered as bytes.
//!
//! A question is a JSON object, see [`explorer::Question`]. An [`answer::Answer`] is a JSON object and numbers beside it. The page of
//! `crates/explorer/page` asks through `door`, compiled to WebAssembly, in as many workers as the reader's machine has cores; tests
//! ask [`Explorer`] directly. Everything that is computed comes from the engines of [`squealmap`], so that the numbers are those of
//! `run` and `trace`.
//!
//! | module | what it answers |
//! |---|---|
//! | [`explorer`], [`opened`] | who is asked |
//! | [`about`] | what varies, what may be varied, which columns there are |
//! | [`region`] | the cells of a rectangle of the map |
//! | [`cell`] | one instance: eigenvalues, motion, friction law, record |
//! | [`device`] | the same, by the GPU of the reader, in turns |
//! | [`mod@file`] | the sweep of a region as a sweep file |

pub mod about;
pub mod answer;
pub mod cell;
pub mod device;
#[cfg(target_family = "wasm")]
pub mod door;
pub mod explorer;
pub mod file;
pub mod opened;
pub mod place;
pub mod region;

#[doc(inline)]
pub use explorer::Explorer;
