//! Studies: computations that are no sweep of instances. Each has its table, its figure, and a reader of both.
//!
//! | study | where |
//! |---|---|
//! | eigenvalues along an axis | [`modes`] |
//! | one instance over time | [`trace`] |
//! | a cycle while a parameter rises and falls | [`hysteresis`] |
//! | speed against error | [`tradeoff`] |
//! | measured friction as a material | [`fit`] |
//! | measured signals | [`identify`] |
//! | an instance as sensors record it | [`signals`] |
//! | the source paper | [`paper`] |
//!
//! [`kind`] says which figures a directory holds, [`picture`] draws them again, and [`error`] says why a study has no
//! result.

pub use kind::Kind;
pub use picture::Picture;

pub mod error;
pub mod fit;
pub mod hysteresis;
pub mod identify;
pub mod kind;
pub mod modes;
pub mod paper;
pub mod picture;
pub mod signals;
pub mod trace;
pub mod tradeoff;
