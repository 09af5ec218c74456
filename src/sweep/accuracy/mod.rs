//! What a result costs and how far from the truth it is: speed against error of every way to compute a sweep, and
//! the cheapest one that is accurate enough.
//!
//! - [`configuration`]: an engine with its arithmetic and steps per period.
//! - [`boundary`]: how near an instance is to another label.
//! - [`sample`]: a stratified sample of a sweep's own instances.
//! - [`errors`]: how far results are from the truth.
//! - [`measure`](mod@measure): every configuration on a sample.
//! - [`clock`]: how long one thread has worked.
//! - [`row`]: what was measured, as a table.
//! - [`frontier`]: the cheapest configuration for an error.
//! - [`level`]: the accuracy that is asked for.
//! - [`trial`]: the choice tried on some of the sweep's own instances; [`tried`]: the result.
//! - [`check`](mod@check): a few instances of every map computed again, and what that found.

pub mod boundary;
pub mod check;
pub mod clock;
pub mod configuration;
pub mod errors;
pub mod frontier;
pub mod level;
pub mod measure;
pub mod row;
pub mod sample;
pub mod trial;
pub mod tried;
