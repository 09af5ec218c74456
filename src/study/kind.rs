//! The kinds of figures, and which of them a directory holds.

use std::path::Path;

use crate::results::figure::look::WIDTHS;
use crate::results::read::{map, refined};
use crate::study::error::{Error, Result};
use crate::study::paper::Figure;
use crate::study::{campaign, curves, fem, fit, hysteresis, identify, modes, trace, tradeoff};

/// A figure of a command that can be drawn from its directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The map of `run`.
    Map,
    /// The map of `refine`.
    Refined,
    /// The trajectory of `trace`.
    Trace,
    /// Both branches of `trace --sweep-up-down`.
    Hysteresis,
    /// The curves of `curves`.
    Curves,
    /// The eigenvalues of `modes`.
    Modes,
    /// Speed against error of `tradeoff`.
    Tradeoff,
    /// Measured signals of `identify`.
    Identify,
    /// The conditions of `campaign`.
    Campaign,
    /// The law of `fit` among its points.
    Fit,
    /// The modes of `fem` over friction.
    Fem,
    /// Those over another parameter.
    Vary,
    /// Pictures of modes of `fem`.
    Shapes,
    /// The mesh of `fem`.
    Mesh,
    /// A figure of `paper`.
    Paper(Figure),
}

impl Kind {
    /// All kinds. Where a directory holds several, the first of these is drawn unless another is asked for.
    pub const ALL: [Kind; 22] = [
        Kind::Map,
        Kind::Refined,
        Kind::Trace,
        Kind::Hysteresis,
        Kind::Curves,
        Kind::Modes,
        Kind::Tradeoff,
        Kind::Identify,
        Kind::Campaign,
        Kind::Fit,
        Kind::Fem,
        Kind::Vary,
        Kind::Shapes,
        Kind::Mesh,
        Kind::Paper(Figure::Figure2),
        Kind::Paper(Figure::Figure3),
        Kind::Paper(Figure::Figure4),
        Kind::Paper(Figure::Figure5),
        Kind::Paper(Figure::Figure6),
        Kind::Paper(Figure::Figure7),
        Kind::Paper(Figure::Accelerations),
        Kind::Paper(Figure::Phase),
    ];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Kind::Map => "map",
            Kind::Refined => "refined",
            Kind::Trace => "trace",
            Kind::Hysteresis => "hysteresis",
            Kind::Curves => "curves",
            Kind::Modes => "modes",
            Kind::Tradeoff => "tradeoff",
            Kind::Identify => "identify",
            Kind::Campaign => "campaign",
            Kind::Fit => "fit",
            Kind::Fem => "fem",
            Kind::Vary => "vary",
            Kind::Shapes => "shapes",
            Kind::Mesh => "mesh",
            Kind::Paper(figure) => figure.name(),
        }
    }

    /// The files that it is drawn from.
    #[must_use]
    pub fn files(self) -> [&'static str; 2] {
        match self {
            Kind::Map => map::FILES,
            Kind::Refined => refined::FILES,
            Kind::Trace => trace::read::FILES,
            Kind::Hysteresis => hysteresis::read::FILES,
            Kind::Curves => curves::read::FILES,
            Kind::Modes => modes::read::FILES,
            Kind::Tradeoff => tradeoff::read::FILES,
            Kind::Identify => identify::read::FILES,
            Kind::Campaign => campaign::read::FILES,
            Kind::Fit => fit::read::FILES,
            Kind::Fem => fem::read::FILES,
            Kind::Vary => fem::read::VARIED,
            Kind::Shapes | Kind::Mesh => fem::read::BODIES,
            Kind::Paper(Figure::Figure2) => ["figure2.csv", "figure2.json"],
            Kind::Paper(Figure::Figure3) => ["figure3.csv", "figure3.json"],
            Kind::Paper(Figure::Figure4) => ["figure4.csv", "figure4.json"],
            Kind::Paper(Figure::Figure5) => ["figure5.csv", "figure5.json"],
            Kind::Paper(Figure::Figure6) => ["figure6.csv", "figure6.json"],
            Kind::Paper(Figure::Figure7) => ["figure7.csv", "figure7.json"],
            Kind::Paper(Figure::Accelerations) => ["accelerations.csv", "accelerations.json"],
            Kind::Paper(Figure::Phase) => ["phase.csv", "phase.json"],
        }
    }

    /// The least width in which all its words have room, mm.
    #[must_use]
    pub fn narrowest(self) -> f64 {
        match self {
            Kind::Fem | Kind::Vary => 88.0,
            Kind::Paper(Figure::Phase | Figure::Figure7) => 84.0,
            Kind::Map | Kind::Curves | Kind::Identify | Kind::Paper(_) => 70.0,
            _ => WIDTHS[0],
        }
    }

    /// The figures that a directory holds, in the order of [`Kind::ALL`]: all their files are there.
    #[must_use]
    pub fn held(directory: &Path) -> Vec<Kind> {
        let there = |kind: &Kind| kind.files().iter().all(|file| directory.join(file).is_file());
        Kind::ALL.into_iter().filter(there).collect()
    }

    /// The figure to draw: the one that is asked for, or the first.
    ///
    /// # Errors
    /// When the directory holds none, or not the one that is asked for.
    pub fn choose(directory: &Path, asked: Option<Kind>) -> Result<Kind> {
        let held = Kind::held(directory);
        let found = match asked {
            Some(kind) => held.contains(&kind).then_some(kind),
            None => held.first().copied(),
        };
        found.ok_or_else(|| {
            if !directory.is_dir() {
                let why = if directory.exists() { "is no directory" } else { "does not exist" };
                return Error::NoDirectoryToPlot { path: directory.to_owned(), why };
            }
            let wanted = asked.map_or(Kind::ALL.to_vec(), |kind| vec![kind]);
            let look_for = |kind: Kind| format!("{} for `{}`", kind.files().join(" and "), kind.name());
            let wanted: Vec<String> = wanted.into_iter().map(look_for).collect();
            Error::NothingToPlot { path: directory.to_owned(), wanted: wanted.join(", ") }
        })
    }
}
