//! Figures for print: scales, frames, curves, text and legends as SVG, PNG and PDF.

pub mod boundaries;
pub mod cyclic;
mod error;
pub mod frame;
pub mod glyphs;
pub mod jumps;
pub mod key;
pub mod layout;
pub mod letters;
pub mod marching;
pub mod marks;
pub mod page;
pub mod pdf;
pub mod plot;
pub mod png;
pub mod raster;
pub mod scale;
pub mod svg;
pub mod tex;
pub mod text;
pub mod words;

pub use error::{Error, Result};
