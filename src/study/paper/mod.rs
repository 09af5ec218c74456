//! The source paper computed again: its figures of the lumped model, and what becomes of its claims.
//!
//! | stage | file |
//! |---|---|
//! | the shipped sweeps behind the figures | `sweeps.rs` |
//! | a ramp, reduced to what pictures show | `ramp.rs` |
//! | growth on a ramp and the phase in it | `growth.rs` |
//! | other ramps and kicks | `accelerations.rs` |
//! | the phase as a fingerprint of the mechanism | `phase.rs` |
//! | what is computed, once each and when first asked for | `study.rs` |
//! | the numbers the claims ask for | `evidence.rs` |
//! | thresholds, verdicts | `limits.rs`, `claims/` |
//! | pictures, tables and `paper.md` | [`figures`] |
//! | these read back | `read.rs` |

mod accelerations;
mod claims;
mod evidence;
pub mod figures;
mod growth;
mod limits;
mod phase;
mod ramp;
pub(crate) mod read;
mod study;
mod sweeps;

pub use accelerations::Trial;
pub use claims::{Claim, Verdict, claims};
pub use evidence::{Evidence, RampFacts};
pub use growth::{Growth, PhaseCase, Window};
pub use limits::{LIMITS, Limits};
pub use phase::{CUSTOMARY, PhaseTrial, Score, Source, Witness};
pub use ramp::{Ramp, Stretch};
pub use study::{Settings, Study};
pub use sweeps::Case;

/// The figures that the command draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the variants are the names of the figures")]
pub enum Figure {
    Figure2,
    Figure3,
    Figure4,
    Figure5,
    Figure6,
    Figure7,
    Accelerations,
    Phase,
}

impl Figure {
    /// Every figure, in order.
    pub const ALL: [Figure; 8] = [
        Figure::Figure2,
        Figure::Figure3,
        Figure::Figure4,
        Figure::Figure5,
        Figure::Figure6,
        Figure::Figure7,
        Figure::Accelerations,
        Figure::Phase,
    ];

    /// The name of its files, and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Figure::Figure2 => "figure2",
            Figure::Figure3 => "figure3",
            Figure::Figure4 => "figure4",
            Figure::Figure5 => "figure5",
            Figure::Figure6 => "figure6",
            Figure::Figure7 => "figure7",
            Figure::Accelerations => "accelerations",
            Figure::Phase => "phase",
        }
    }

    /// Its heading in the report.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Figure::Figure2 => "Figure 2: frequencies and growth rates against friction",
            Figure::Figure3 => "Figure 3: friction laws",
            Figure::Figure4 => "Figure 4: ramp under a negative slope",
            Figure::Figure5 => "Figure 5: ramp under mode coupling",
            Figure::Figure6 => "Figure 6: ramp under both",
            Figure::Figure7 => "Figure 7: accelerations while the vibration grows",
            Figure::Accelerations => "Beyond the paper: other ramps and kicks",
            Figure::Phase => "Beyond the paper: the phase method on trial",
        }
    }
}

/// A range of angles for words: `−16.3 to −11.1°`, `−56.4°` where both ends are the same.
#[must_use]
pub fn degrees([low, high]: [f64; 2]) -> String {
    let [low, high] = [low, high].map(|angle| format!("{angle:.1}"));
    let range = if low == high { high } else { format!("{low} to {high}") };
    format!("{range}°").replace('-', "−")
}

/// The lowest and the highest of some values; `None` of none.
#[must_use]
pub(crate) fn extremes(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range: Option<[f64; 2]>, x| {
        Some(range.map_or([x, x], |[low, high]| [low.min(x), high.max(x)]))
    })
}

/// A length in mm for words, free of the rounding of the product.
#[must_use]
pub fn millimetres(metres: f64) -> f64 {
    /// Decimals that every length of a kick has.
    const DECIMALS: f64 = 1e9;
    (1e3 * metres * DECIMALS).round() / DECIMALS
}
