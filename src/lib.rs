//! Stability maps of friction-induced vibration: for which friction, temperature and belt velocity does a
//! brake contact become unstable, by which mechanism, and what does it then do?
//!
//! The floors, from below; each uses only what is beneath it:
//!
//! | floor | what stands there |
//! |---|---|
//! | [`squealmap_input`], [`squealmap_figure`], [`squealmap_identify`] | files of the user; figures for print; measured signals → verdict: crates of their own |
//! | [`model`] | parameters, friction, equations, contact, eigenvalues |
//! | [`engine`] | instances integrated: reference, vector registers, GPU |
//! | [`sweep`] | sweep files, grids, labels, several starts, checks, refinement |
//! | [`store`], [`cluster`] | sweeps of any size, tile by tile in a directory, by the jobs of a cluster |
//! | [`results`] | map → bytes, and a map read back |
//! | [`study`] | eigenvalues along an axis, traces, hysteresis, speed against error, fits, measured signals, the source paper |
//!
//! A sweep is built in code, or read from a TOML file with [`Spec::read`]; both give the same [`Spec`]. What most programs
//! need stands here at the root.
//!
//! ```
//! use squealmap::{FrictionLaw::Bilinear, Param, Settle, Sweep};
//!
//! let map = Sweep::two_mass()
//!     .friction(Bilinear { mu_s: 0.15, mu_d: 0.05, knee_velocity: 5.0 })
//!     .values(Param::BeltVelocity, [1.0, 3.0, 6.0])
//!     .response(Settle::Auto)
//!     .run()?;
//! let [Some(slow), _, Some(fast)] = &map.names("type")?[..] else { panic!("three velocities") };
//! assert_eq!([slow.as_str(), fast.as_str()], ["negative_slope", "stable"]);
//! let amplitude = map.array("x2_std")?;
//! assert_eq!(amplitude.shape(), [3]);
//! assert!(amplitude.get(&[0]) > amplitude.get(&[2]));
//! # Ok::<(), squealmap::Error>(())
//! ```
//!
//! Features, all of them default: `gpu` (compute kernels through wgpu; `kernels` is what a device that others open needs of
//! them), `figures`, `identify` (measured signals and friction), `parquet`, and `cli`, what only the program needs; `program` is
//! all of them. Without any there are the model, the engines of the CPU, sweeps, tiles, and tables as CSV, NetCDF and Zarr.

#![cfg_attr(
    not(all(feature = "figures", feature = "gpu", feature = "identify")),
    allow(dead_code, reason = "fewer features leave unused what only the others call")
)]

/// The program knows the library by its name, as any other would.
#[cfg(feature = "program")]
extern crate self as squealmap;

/// The program: what `src/main.rs` and the Python package call.
#[cfg(feature = "program")]
#[allow(rustdoc::invalid_html_tags, reason = "help of the program names values in angle brackets")]
#[doc(hidden)]
pub mod cli;
pub mod cluster;
#[doc(hidden)]
pub mod disk;
pub mod engine;
pub mod error;
pub mod model;
pub mod results;
pub mod store;
pub mod study;
pub mod sweep;
#[doc(hidden)]
pub mod version;

#[doc(inline)]
pub use engine::backend::Backend;
#[doc(inline)]
pub use engine::options::Options;
#[doc(inline)]
pub use engine::plan::Duration;
#[doc(inline)]
pub use engine::record::Record;
#[doc(inline)]
pub use engine::regime::Regime;
pub use error::{Error, Result};
#[doc(inline)]
pub use model::friction::{FrictionLaw, LawKind};
#[doc(inline)]
pub use model::instance::Instance;
#[doc(inline)]
pub use model::kind::InstabilityType;
#[doc(inline)]
pub use model::motion::Motion;
#[doc(inline)]
pub use model::status::Status;
#[doc(inline)]
pub use model::{Param, Params};
#[doc(inline)]
pub use results::by_name::Array;
#[doc(inline)]
pub use sweep::build::{Settle, Start, Sweep};
#[doc(inline)]
pub use sweep::map::Map;
#[doc(inline)]
pub use sweep::spec::Spec;

/// The example of `docs/library.md` is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct LibraryPage;
