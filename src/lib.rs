//! Stability maps of friction-induced vibration: for which friction, temperature and belt velocity does a
//! brake contact become unstable, by which mechanism, and what does it then do?
//!
//! The floors, from below; each uses only what is beneath it:
//!
//! | floor | what stands there |
//! |---|---|
//! | [`squealmap_input`], [`squealmap_figure`], [`squealmap_identify`] | files of the user; figures for print; measured signals → verdict: crates of their own |
//! | [`disk`] | the one door to the disk |
//! | [`model`] | parameters, friction, equations, contact, eigenvalues |
//! | [`engine`] | instances integrated: reference, vector registers, GPU |
//! | [`sweep`] | sweep files, grids, labels, several starts, checks, refinement |
//! | [`store`], [`cluster`] | sweeps of any size, tile by tile in a directory, by the jobs of a cluster |
//! | [`results`] | map → bytes, and a map read back |
//! | [`study`] | eigenvalues along an axis, traces, hysteresis, speed against error, fits, measured signals, the source paper |
//!
//! ```
//! use squealmap::engine::options::Options;
//! use squealmap::model::kind::InstabilityType;
//! use squealmap::results::csv;
//! use squealmap::sweep::{run, spec::Spec};
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
//! let map = run::run(spec, &Options::default(), &|_finished| {})?;
//! assert_eq!(map.records[1].kind, Some(InstabilityType::NegativeSlope));
//! assert_eq!(map.records[2].kind, Some(InstabilityType::Stable));
//! let table = csv::map_csv(&map)?;
//! assert_eq!(table.iter().filter(|byte| **byte == b'\n').count(), 4);
//! # Ok::<(), squealmap::Error>(())
//! ```

#![cfg_attr(
    not(all(feature = "figures", feature = "gpu", feature = "identify")),
    allow(dead_code, reason = "fewer features leave unused what only the others call")
)]

pub mod cluster;
pub mod disk;
pub mod engine;
pub mod error;
pub mod model;
pub mod results;
pub mod store;
pub mod study;
pub mod sweep;
pub mod version;

pub use error::{Error, Result};

/// The example of `docs/library.md` is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct LibraryPage;
