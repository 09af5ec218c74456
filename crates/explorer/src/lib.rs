//! The explorer in a browser: a sweep that is open, asked by a page through memory of WebAssembly.
//!
//! Questions and answers are those of [`squealmap::study::explore`], compiled to WebAssembly. The page of `crates/explorer/page` asks
//! through `door`, in as many workers as the reader's machine has cores; [`device`] computes a region by the reader's GPU, in turns.

pub mod device;
#[cfg(target_family = "wasm")]
pub mod door;
