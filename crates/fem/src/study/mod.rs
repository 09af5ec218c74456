//! A whole study from a description in a file: model, coefficients of friction, results.
//!
//! [`document`] is the file, [`Study::new`] builds the model, [`estimate()`] says what it would cost, [`compute()`] computes it, and
//! [`table()`], [`manifest()`] and [`shapes()`] are its results as bytes. Nothing here opens a file.

mod band;
mod build;
mod compute;
pub mod document;
mod estimate;
mod growth;
mod manifest;
mod materials;
mod mechanisms;
mod modal;
mod part;
mod parts;
mod place;
mod plane;
mod projected;
mod shapes;
mod space;
mod surfaces;
mod table;
mod transitions;
mod turns;
mod values;
mod variation;
mod varied;

pub use band::in_band;
pub use build::Study;
pub use compute::{Outcome, Pressed, Shape, compute};
pub use estimate::{Estimate, estimate};
pub use growth::grows;
pub use manifest::manifest;
pub use mechanisms::Alone;
pub use modal::{Contact, Modal};
pub use place::place;
pub use shapes::shapes;
pub use table::{COLUMNS, Column, table, vary_table};
pub use transitions::{Event, Transition};
pub use variation::Variation;
