//! Stability maps of friction-induced vibration: for which friction, temperature and belt velocity does a
//! brake contact become unstable, by which mechanism, and what does it then do?
//!
//! The pipeline, in order:
//!
//! | stage | module |
//! |---|---|
//! | sweep file (TOML) → validated sweep | [`spec`], [`files`], [`error`], [`place`], [`quote`] |
//! | axes, index ↔ coordinates | [`grid`] |
//! | parameters, friction, equations, contact | [`model`] |
//! | eigenvalues and attribution | [`linear`] |
//! | one step, events inside it | [`method`] |
//! | one instance from start to outcome | [`integrate`], [`observe`], [`response`], [`settle`], [`outcome`] |
//! | one instance from several starts: bistability, basins | [`starts`] |
//! | a cycle followed while a parameter rises and falls | [`hysteresis`] |
//! | the twins of the compute kernels | [`kernel`] |
//! | many instances in vector registers | [`simd`] |
//! | many instances | [`backend`], [`sweep`], [`estimate`] |
//! | outcome → regime | [`classify`] |
//! | labels of an instance, counted | [`label`] |
//! | speed against error, and the cheapest that is accurate enough | [`accuracy`] |
//! | what is kept: the one door to the disk | [`disk`] |
//! | sweeps of any size, tile by tile in a directory, by the jobs of a cluster | [`store`], [`cluster`] |
//! | map → bytes, and a map read back | [`map`], [`trace`], [`export`], [`archive`] |
//! | an instance as sensors record it; measured signals → verdict | [`signals`], [`identify`], [`fit`] |
//! | the source paper computed again | [`paper`] |
//!
//! ```
//! use squealmap::backend::choice::Options;
//! use squealmap::classify::InstabilityType;
//! use squealmap::{export, spec::Spec, sweep};
//!
//! let text = r#"
//!     title = "Three belt velocities"
//!     [friction]
//!     law = "bilinear"                 # mu_s at rest, mu_d from 5 m/s on
//!     mu_s = 0.15
//!     mu_d = 0.05
//!     [axes]
//!     belt_velocity = { values = [1.0, 3.0, 6.0] }
//!     [response]
//!     settle = "50 periods"
//!     measure = "20 periods"
//! "#;
//! let spec = Spec::parse(text, "example.toml", ".".as_ref())?;
//! let map = sweep::run(spec, &Options::default(), &|_finished| {})?;
//! assert_eq!(map.records[1].kind, Some(InstabilityType::NegativeSlope));
//! assert_eq!(map.records[2].kind, Some(InstabilityType::Stable));
//! let table = export::csv::map_csv(&map)?;
//! assert_eq!(table.iter().filter(|byte| **byte == b'\n').count(), 4);
//! # Ok::<(), squealmap::Error>(())
//! ```

pub mod accuracy;
pub mod archive;
pub mod backend;
pub mod classify;
pub mod cluster;
pub mod disk;
pub mod error;
pub mod estimate;
pub mod export;
pub mod files;
pub mod fit;
pub mod grid;
pub mod hysteresis;
pub mod identify;
pub mod integrate;
pub mod kernel;
pub mod label;
pub mod linear;
pub mod map;
pub mod method;
pub mod model;
pub mod observe;
pub mod onset;
pub mod outcome;
pub mod paper;
pub mod place;
pub mod quote;
pub mod refine;
pub mod response;
pub mod settle;
pub mod signals;
pub mod simd;
pub mod spec;
mod start;
pub mod starts;
pub mod store;
pub mod sweep;
pub mod trace;

pub use error::{Error, Result};

/// The example of `docs/library.md` is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct LibraryPage;
