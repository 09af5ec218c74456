//! A sweep: which instances, what is asked of them, and the records of all.
//!
//! | question | where |
//! |---|---|
//! | sweep file (TOML) → validated sweep | [`spec`] |
//! | the same built in code | [`build`] |
//! | axes, index ↔ coordinates | [`grid`] |
//! | the chosen engine, range after range, with several starts and checks | [`solver`], `several.rs`, [`accuracy`] |
//! | the whole in memory | [`run`](mod@run), [`map`], [`sheet`] |
//! | what is told of an instance, in tables, tiles and figures | [`columns`] |
//! | labels of an instance, counted | [`label`], [`checks`] |
//! | the lines of a map from few instances | [`refine`] |
//! | what it would cost, and how long a start takes to show what it does | [`estimate`](mod@estimate), [`onset`] |
//! | numbers that depend on a seed and an index alone | [`draw`] |
//! | why a sweep is refused or does not come to its end | [`error`] |

pub mod accuracy;
pub mod build;
pub mod checks;
pub mod columns;
pub mod draw;
pub mod error;
pub mod estimate;
pub mod grid;
pub mod label;
pub mod map;
pub mod onset;
pub mod refine;
pub mod run;
pub mod several;
pub mod sheet;
pub mod solver;
pub mod spec;
