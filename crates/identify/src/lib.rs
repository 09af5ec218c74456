//! What measured signals say: is there an instability, and which mechanism causes it?
//!
//! | stage | file |
//! |---|---|
//! | a file of any format → columns and rows | `formats/mod.rs`, `place.rs`, `unread.rs` |
//! | columns → channels, units of time | `channel.rs`, `unit.rs`, `scale.rs`, `settings.rs`, `read.rs` |
//! | its strokes, between rests and turns | `stroke.rs` |
//! | is the file fit for analysis: gaps, outliers, clipping, swapped columns | `survey.rs`, `pace.rs`, `range.rs`, `outlier.rs`, `fault.rs` |
//! | forces that slow sensors do not show, from the accelerations of a known rig | `rig.rs`, `restore.rs`, `motion.rs` |
//! | windows: frequency, growth, cross-spectra | `window.rs`, `cross.rs`, `spectrum.rs` |
//! | episodes of growth; one mode fitted to the samples of each | `runs.rs`, `episode.rs`, `spans.rs`, `sharpen.rs`, `mode.rs`, `shape.rs`, `course.rs` |
//! | friction power and its parts | `feedback.rs` |
//! | which mechanism alone would destabilise | `attribution.rs` |
//! | verdict of the growth, confidence, reasons | `verdict.rs`, `reading.rs`, `overview.rs`, `conclude.rs` |
//! | segments of time: where the record changes in kind | `cells.rs`, `cut.rs`, `knee.rs`, `parts.rs`, `segment.rs`, `trend.rs`, `within.rs`, `losses.rs` |
//! | what three witnesses say of each, and together | `witness.rs`, `population.rs`, `joint.rs`, `testimony.rs`, `rates.rs`, `told.rs` |
//! | points for `fit` | `points.rs`, `undisturbed.rs`, `measured.rs` |
//! | pictures | `spectrogram.rs`, `envelope.rs`, `clips.rs`, `instants.rs` |
//! | all of it in order, over samples that are kept or read again | `analysis.rs`, `again.rs`, `block.rs`, `sliding.rs` |
//!
//! A verdict rests on the signals alone and on one picture: a tangential and a normal mode, both slightly damped,
//! coupled by friction. Where the signals leave more than one mechanism open, the verdict is undecided and says why.

mod again;
mod analysis;
mod attribution;
mod block;
mod cells;
mod channel;
mod clips;
mod conclude;
mod course;
mod cross;
mod cut;
mod envelope;
mod episode;
mod fault;
mod feedback;
mod formats;
mod inertia;
mod instants;
mod joint;
mod knee;
mod lanes;
mod level;
mod line;
mod losses;
mod measured;
mod misfit;
mod mode;
mod motion;
mod outlier;
mod overview;
mod pace;
mod parts;
mod pitch;
mod place;
mod points;
pub mod population;
mod range;
mod rates;
mod read;
mod reading;
mod restore;
mod rig;
mod runs;
mod scale;
mod segment;
mod settings;
mod shape;
mod sharpen;
mod sliding;
mod spans;
mod spectrogram;
mod spectrum;
mod still;
mod stroke;
mod survey;
mod testimony;
mod told;
mod trend;
mod undisturbed;
mod unit;
mod unread;
mod verdict;
mod window;
mod within;
mod witness;

pub use analysis::{Identification, identify};
pub use attribution::{CAUSE, alone};
pub use channel::Channel;
pub use clips::Clip;
pub use cross::Measured;
pub use envelope::Envelope;
pub use episode::Episode;
pub use fault::{Fault, RATES, Unfit};
pub use instants::Instant;
pub use level::{Level, Reading as FrictionReading};
pub use measured::{Measurements, read_measurements};
pub use overview::Friction;
pub use place::Place;
pub use points::{FrictionColumn, Point, Points, read_points};
pub use rates::{Forces, Rate, rate_of};
pub use reading::Reading;
pub use rig::Rig;
pub use segment::{Segment, State};
pub use settings::{DAMPING_RATIO, INCLINATION, LARGEST_FRICTION, OVERLAP, Settings, WINDOW};
pub use spectrogram::Spectrogram;
pub use stroke::{Stroke, strokes};
pub use survey::{LEAST_PER_PERIOD, LEAST_SAMPLES};
pub use testimony::{Chances, Mechanism, Testimony, Witness};
pub use told::told;
pub use undisturbed::Undisturbed;
pub use unit::TimeUnit;
pub use unread::Unread;
pub use verdict::{CONFIDENT, Kind, Verdict};
pub use window::Window;
