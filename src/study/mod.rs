//! Studies: computations that are no sweep of instances. Each has its table, its figure, and a reader of both.
//!
//! | study | where |
//! |---|---|
//! | eigenvalues along an axis | [`modes`] |
//! | one instance over time | [`trace`] |
//! | a cycle while a parameter rises and falls | [`hysteresis`] |
//! | branches of cycles, stable and unstable | [`cycles`] |
//! | curves over two parameters where cycles meet or are born | [`curves`] |
//! | a map to look into: questions, answers, the page | [`explore`] |
//! | speed against error | [`tradeoff`] |
//! | measured friction as a material | [`fit`] |
//! | measurements of a structure as a model | [`calibrate`] |
//! | measured signals | [`identify`] |
//! | the strokes of many records | [`campaign`] |
//! | an instance as sensors record it | [`signals`] |
//! | measured strokes over a map | [`observed`] |
//! | the source paper | [`paper`] |
//! | bodies in sliding contact by finite elements | [`fem`] |
//!
//! [`kind`] says which figures a directory holds, [`picture`] draws them again, and [`error`] says why a study has no
//! result.

#[cfg(all(feature = "figures", feature = "identify"))]
pub use kind::Kind;
#[cfg(all(feature = "figures", feature = "identify"))]
pub use picture::Picture;

pub mod calibrate;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod campaign;
#[cfg(feature = "figures")]
pub mod curves;
pub mod cycles;
pub mod error;
pub mod explore;
#[cfg(feature = "figures")]
pub mod fem;
#[cfg(feature = "identify")]
pub mod fit;
pub mod hysteresis;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod identify;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod kind;
pub mod modes;
#[cfg(feature = "figures")]
pub mod observed;
#[cfg(feature = "figures")]
pub mod paper;
#[cfg(all(feature = "figures", feature = "identify"))]
pub mod picture;
pub mod signals;
pub mod trace;
#[cfg(feature = "figures")]
pub mod tradeoff;
