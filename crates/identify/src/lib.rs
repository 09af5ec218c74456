//! What measured signals say: is there an instability, and which mechanism causes it?
//!
//! | stage | file |
//! |---|---|
//! | columns, units of time, CSV → rows | `channel.rs`, `unit.rs`, `settings.rs`, `read.rs` |
//! | is the file fit for analysis: gaps, outliers, clipping, swapped columns | `survey.rs`, `pace.rs`, `range.rs`, `outlier.rs`, `fault.rs` |
//! | windows: frequency, growth, cross-spectra | `window.rs`, `cross.rs`, `spectrum.rs` |
//! | episodes of growth; one mode fitted to the samples of each | `runs.rs`, `episode.rs`, `spans.rs`, `sharpen.rs`, `mode.rs`, `shape.rs`, `course.rs` |
//! | friction power and its parts | `feedback.rs` |
//! | which mechanism alone would destabilise | `attribution.rs` |
//! | verdict, confidence, reasons | `verdict.rs`, `reading.rs`, `overview.rs`, `conclude.rs` |
//! | points for `fit` | `points.rs` |
//! | pictures | `spectrogram.rs`, `envelope.rs` |
//! | all of it in order | `analysis.rs` |
//!
//! A verdict rests on the signals alone and on one picture: a tangential and a normal mode, both slightly damped,
//! coupled by friction. Where the signals leave more than one mechanism open, the verdict is undecided and says why.

mod analysis;
mod attribution;
mod channel;
mod conclude;
mod course;
mod cross;
mod envelope;
mod episode;
mod fault;
mod feedback;
mod line;
mod mode;
mod outlier;
mod overview;
mod pace;
mod points;
mod range;
mod read;
mod reading;
mod runs;
mod settings;
mod shape;
mod sharpen;
mod spans;
mod spectrogram;
mod spectrum;
mod still;
mod survey;
mod unit;
mod verdict;
mod window;

pub use analysis::{Identification, identify};
pub use attribution::{CAUSE, alone};
pub use channel::Channel;
pub use cross::Measured;
pub use envelope::Envelope;
pub use episode::Episode;
pub use fault::{Fault, RATES, Unfit};
pub use overview::Friction;
pub use points::{FrictionColumn, Point, read_points};
pub use reading::Reading;
pub use settings::{DAMPING_RATIO, INCLINATION, LARGEST_FRICTION, OVERLAP, Settings, WINDOW};
pub use spectrogram::Spectrogram;
pub use survey::{LEAST_PER_PERIOD, LEAST_SAMPLES};
pub use unit::TimeUnit;
pub use verdict::{CONFIDENT, Kind, Verdict};
pub use window::Window;
