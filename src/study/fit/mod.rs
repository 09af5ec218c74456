//! Measured friction → a material.
//!
//! - `squares.rs`: the fit by least squares; `problem.rs`: points as a linear problem.
//! - `errors.rs`: how far the values of a fit would scatter.
//! - `each.rs`: a velocity for every temperature, where the points ask for it; `information.rs`: what tells that.
//! - [`compare`]: several laws, by information criteria.
//! - [`files`](mod@files): the points of one file, or of several.
//! - [`rows`]: the temperatures of the material.
//! - [`made`](mod@made): a material with all of it.
//! - [`table`]: the files of a fit; [`told`]: what it says beside them.
//! - [`course`]: the law over the velocity; [`read`]: a fit read back; [`figure`]: its picture.
//! - [`binned`](mod@binned): tables where no law describes the friction; [`binned_csv`]: their file.
//! - `fault.rs`: why there is none.

pub mod binned;
pub mod binned_csv;
pub mod course;
mod criteria;
mod each;
mod errors;
mod fault;
#[cfg(feature = "figures")]
pub mod figure;
pub mod files;
mod information;
pub mod made;
mod problem;
#[cfg(feature = "figures")]
pub mod read;
pub mod rows;
mod shape;
mod squares;
pub mod table;
pub mod told;

pub use criteria::{Candidate, compare};
pub use each::fit;
pub use fault::FitFault;
pub use squares::{Fit, range};
