//! Why a study has no result.

use squealmap_input::place::Place;
use squealmap_input::quote::{SAID, clipped, one_line};
use std::path::PathBuf;

/// The most characters of a sentence about a file of signals, which may name all columns of its header.
#[cfg(feature = "identify")]
const FAULT: usize = 1200;

/// Why a study has no result. Every message is one sentence: where, the key, the value, the limit, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A rig that varies.
    #[cfg(feature = "identify")]
    #[error(
        "--model takes one rig, but the sweep varies `{name}`; set it in [model] and leave it out of [axes] and points"
    )]
    NoOneRig {
        /// The parameter.
        name: &'static str,
    },
    /// A sweep without a plane to look into.
    #[error("a map to look into needs two axes of numbers in [axes], as `squealmap init map` writes them")]
    NothingToExplore,
    /// A directory without a run to look into.
    #[error("`{}` holds no run to look into: {why}; give the directory of `squealmap run`, or a sweep file", path.display())]
    NoRunToExplore {
        /// The directory.
        path: PathBuf,
        /// Why there is none.
        why: &'static str,
    },
    /// A program without the page of the explorer.
    #[error(
        "this program was built without the page of `explore`: in a copy of its repository `crates/explorer/build` makes the page, \
         then build or install the program again"
    )]
    NoPage,
    /// `modes` needs a numeric axis with at least two values.
    #[error(
        "modes needs an axis of numbers with at least 2 values, and [axes] has none; add one, e.g. mu_d = {{ from = 0.0, to = 0.6, points = 601 }}"
    )]
    NoModesAxis,
    /// `modes` needs axes, not tuples.
    #[error(
        "modes needs an axis of numbers with at least 2 values, and this sweep lists its instances in a file of `points`; give [axes] in its place, e.g. mu_d = {{ from = 0.0, to = 0.6, points = 601 }}"
    )]
    NoModesOfTuples,
    /// `modes` of more instances than it follows.
    #[error(
        "the sweep has {instances} instances but modes are followed in at most {limit}; give its axes fewer points or values"
    )]
    TooManyModes {
        /// Instances.
        instances: usize,
        /// The most.
        limit: usize,
    },
    /// A trace that memory does not hold.
    #[error(
        "the trace would have {rows:.0} rows but at most {limit:.0} fit the memory; shorten `settle`, `settle_limit` or `measure` \
         in [response], or ask for fewer samples per period"
    )]
    TraceTooLong {
        /// Rows.
        rows: f64,
        /// The most.
        limit: f64,
    },
    /// `modes` finds nothing to show.
    #[error(
        "no instance of the sweep has modes: none has a sliding equilibrium on a moving belt; give at least one a `belt_velocity` above 0 (and, where theta < 0, less friction; with the law `constant`, `mu_s` of at least `mu_d`)"
    )]
    NoModes,
    /// `curves` needs a plane of two parameters.
    #[error(
        "curves needs two axes of numbers with at least 2 values each, and [axes] does not have them; add one, e.g. belt_velocity = {{ from = 1.0, to = 6.0, points = 41 }}"
    )]
    NoPlane,
    /// `curves` needs axes, not tuples.
    #[error(
        "curves needs two axes of numbers, and this sweep lists its instances in a file of `points`; give [axes] in its place"
    )]
    NoCurvesOfTuples,
    /// An axis of the plane along which no cycle can be followed.
    #[error(
        "the plane of this sweep has `{name}` as an axis, along which no cycle can be followed: it is no number of the model, the friction or the belt; put two of these first in [axes]"
    )]
    NoCurvesAlong {
        /// The axis.
        name: &'static str,
    },
    /// Curves that hold for another system than a map.
    #[error(
        "the curves in `{}` are of another sweep than the map: `{section}` differs; compute them from the sweep of the map, with squealmap curves",
        path.display()
    )]
    CurvesOfAnother {
        /// The directory of the curves.
        path: PathBuf,
        /// The section of the sweep.
        section: &'static str,
    },
    /// Curves in planes that a map does not show.
    #[error(
        "no curve in `{}` lies in a plane that the figure shows; compute them from the sweep of the map, with squealmap curves",
        path.display()
    )]
    CurvesElsewhere {
        /// The directory of the curves.
        path: PathBuf,
    },
    /// Measured strokes that cannot be drawn over a map.
    #[error("the strokes in `{}` {why}", path.display())]
    BadStrokes {
        /// Their table.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// A ramp of the paper's figures that does not come to its end.
    #[error(
        "the ramp under {case} of {duration} s with a kick of {kick} m ended early with status `{status}`; \
         choose another --ramp-duration or --kick"
    )]
    PaperRamp {
        /// The friction case in words.
        case: &'static str,
        /// Duration of the ramp, s.
        duration: f64,
        /// Displacement at its start, m.
        kick: f64,
        /// How it ended.
        status: &'static str,
    },
    /// The path that is to be drawn is no directory.
    #[error("`{}` {why}; give `plot` the output directory of a command", path.display())]
    NoDirectoryToPlot {
        /// The path.
        path: PathBuf,
        /// What it is instead.
        why: &'static str,
    },
    /// A directory without a figure.
    #[error(
        "there is nothing to draw in `{}`: looked for {wanted}; give `plot` the output directory of one of these commands",
        path.display()
    )]
    NothingToPlot {
        /// The directory.
        path: PathBuf,
        /// The files that were looked for.
        wanted: String,
    },
    /// A study without shapes of modes.
    #[error(
        "the study has no shapes: none of its modes becomes unstable, and none was asked for; name coefficients of friction in `shapes_at` of its [output] and run `squealmap fem` again"
    )]
    NoShapes,
    /// A description of bodies in contact, or its model, cannot be computed.
    #[error("{}: {}", at.as_ref().map_or_else(|| format!("`{}`", one_line(&path.display().to_string())), Place::to_string), clipped(why, SAID))]
    Fem {
        /// The description.
        path: PathBuf,
        /// Where in it, if anywhere.
        at: Option<Place>,
        /// What is wrong, as a sentence.
        why: String,
    },
    /// Measured signals that are not fit for analysis.
    #[cfg(feature = "identify")]
    #[error("{name}: {}", clipped(&fault.to_string(), FAULT))]
    Signals {
        /// The file as the user wrote it.
        name: String,
        /// Which column, where, and what to do.
        fault: Box<squealmap_identify::Fault>,
    },
    /// Measured friction that does not determine a material.
    #[cfg(feature = "identify")]
    #[error("{name}: {}", clipped(&fault.to_string(), FAULT))]
    Fit {
        /// The file as the user wrote it.
        name: String,
        /// Which value, and what to do.
        fault: Box<dyn std::error::Error + Send + Sync>,
    },
    /// What the floor below says.
    #[error(transparent)]
    OfResults(#[from] crate::results::error::Error),
}

#[cfg(feature = "identify")]
impl From<squealmap_identify::Unfit> for Error {
    fn from(unfit: squealmap_identify::Unfit) -> Error {
        Error::Signals { name: unfit.name, fault: unfit.fault }
    }
}

impl From<crate::store::error::Error> for Error {
    fn from(why: crate::store::error::Error) -> Error {
        Error::OfResults(why.into())
    }
}

impl From<crate::sweep::error::Error> for Error {
    fn from(why: crate::sweep::error::Error) -> Error {
        Error::OfResults(why.into())
    }
}

impl From<crate::engine::error::Error> for Error {
    fn from(why: crate::engine::error::Error) -> Error {
        Error::OfResults(why.into())
    }
}

#[cfg(feature = "figures")]
impl From<squealmap_figure::Error> for Error {
    fn from(why: squealmap_figure::Error) -> Error {
        Error::OfResults(why.into())
    }
}

impl Error {
    /// The place in the input that the error is about, for underlining it.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Error::OfResults(why) => why.place(),
            Error::Fem { at, .. } => at.as_ref(),
            _ => None,
        }
    }

    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::OfResults(why) if why.is_cancelled())
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Error::NothingToExplore
            | Error::NoRunToExplore { .. }
            | Error::NoPage
            | Error::NoModesAxis
            | Error::NoModesOfTuples
            | Error::NoModes
            | Error::TooManyModes { .. }
            | Error::TraceTooLong { .. }
            | Error::NoPlane
            | Error::NoCurvesOfTuples
            | Error::NoCurvesAlong { .. }
            | Error::CurvesOfAnother { .. }
            | Error::CurvesElsewhere { .. }
            | Error::BadStrokes { .. }
            | Error::NoShapes
            | Error::PaperRamp { .. }
            | Error::NoDirectoryToPlot { .. }
            | Error::NothingToPlot { .. }
            | Error::Fem { .. } => true,
            #[cfg(feature = "identify")]
            Error::NoOneRig { .. } | Error::Signals { .. } | Error::Fit { .. } => true,
            Error::OfResults(why) => why.is_bad_input(),
        }
    }
}

/// The result of this floor.
pub type Result<T> = std::result::Result<T, Error>;
