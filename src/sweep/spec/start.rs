//! `[start]`: the kinds of starts, which of their keys each reads, and where they lie.
//!
//! The small start is the kick of every sweep. The large one of `kind = "both"` is by default the mass moving with the
//! belt, `ẋ2 = V` at the sliding equilibrium: stick, the state of every brake before it slips. Of the single mass every
//! cycle with stick contains that state's release, so that the large start finds the cycle wherever there is one.

use serde_json::Value as Json;

use crate::engine::plan::StartKind;
use crate::model::{Param, Params};
use crate::sweep::spec::{Pass, Spec, Starts};

/// What `kind` may say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Kick,
    Mode,
    Both,
    Box,
}

/// Starts drawn from a box when a sweep does not say: a fraction is then known to 5 % (one standard error) or better.
pub(super) const BOX_SAMPLES: u32 = 100;

/// Fewest and most of them.
pub(super) const SAMPLES_RANGE: (usize, usize) = (1, 1_000_000);

/// The amplitudes of starts.
pub(super) const AMPLITUDES: [Param; 10] = [
    Param::StartVelocity,
    Param::StartDisplacement,
    Param::StartFraction,
    Param::StartEventFraction,
    Param::LargeVelocity,
    Param::LargeDisplacement,
    Param::BoxDisplacementFrom,
    Param::BoxDisplacementTo,
    Param::BoxVelocityFrom,
    Param::BoxVelocityTo,
];

/// The bounds of the box, which has no natural size.
pub(super) const BOUNDS: [Param; 4] =
    [Param::BoxDisplacementFrom, Param::BoxDisplacementTo, Param::BoxVelocityFrom, Param::BoxVelocityTo];

impl Kind {
    /// Every kind with its name in a sweep file.
    pub(super) const ALL: [(&'static str, Kind); 4] =
        [("kick", Kind::Kick), ("mode", Kind::Mode), ("both", Kind::Both), ("box", Kind::Box)];

    /// The kind of a sweep.
    pub(super) fn of(spec: &Spec) -> Kind {
        match (spec.start, spec.analysis.starts) {
            (StartKind::Mode, _) => Kind::Mode,
            (StartKind::Kick, Starts::One) => Kind::Kick,
            (StartKind::Kick, Starts::Both) => Kind::Both,
            (StartKind::Kick, Starts::Box(_)) => Kind::Box,
        }
    }

    /// The name in a sweep file.
    pub(super) fn name(self) -> &'static str {
        Kind::ALL.iter().find(|(_, kind)| *kind == self).map_or("kick", |(name, _)| name)
    }

    /// How each of its transients starts.
    pub(super) fn transient(self) -> StartKind {
        if self == Kind::Mode { StartKind::Mode } else { StartKind::Kick }
    }

    /// How many starts every instance has.
    pub(super) fn starts(self, samples: u32) -> Starts {
        match self {
            Kind::Kick | Kind::Mode => Starts::One,
            Kind::Both => Starts::Both,
            Kind::Box => Starts::Box(samples),
        }
    }

    /// The key or kind that would read an amplitude that this kind does not read. `by_event` says whether
    /// `start_event_fraction` is given.
    pub(super) fn reader(self, param: Param, by_event: bool) -> Option<&'static str> {
        let unread = |reads: &[Kind], reader: &'static str| (!reads.contains(&self)).then_some(reader);
        match param {
            Param::StartVelocity | Param::StartDisplacement => unread(
                &[Kind::Kick, Kind::Both, Kind::Box],
                "kind = \"kick\", \"both\" or \"box\" in [start]",
            ),
            Param::StartFraction if self == Kind::Mode && by_event => {
                Some("a mode start without `start_event_fraction`")
            }
            Param::StartFraction | Param::StartEventFraction => {
                unread(&[Kind::Mode], "kind = \"mode\" in [start]")
            }
            Param::LargeVelocity | Param::LargeDisplacement => {
                unread(&[Kind::Both], "kind = \"both\" in [start]")
            }
            param if BOUNDS.contains(&param) => unread(&[Kind::Box], "kind = \"box\" in [start]"),
            _ => None,
        }
    }
}

/// Gives the parameters of an instance the start of a pass, as the kick that engines read.
pub(crate) fn place(pass: Pass, params: &mut Params) {
    if pass == Pass::Large {
        let velocity = params.get(Param::LargeVelocity);
        params.set(Param::StartVelocity, velocity.unwrap_or_else(|| params.require(Param::BeltVelocity)));
        params.set(Param::StartDisplacement, params.require(Param::LargeDisplacement));
    }
}

/// The starts of a resolved sweep's `[start]`.
#[must_use]
pub(crate) fn from_json(start: &Json) -> Starts {
    match start["kind"].as_str() {
        Some("both") => Starts::Both,
        Some("box") => {
            let samples = start["box_samples"].as_u64().and_then(|samples| u32::try_from(samples).ok());
            Starts::Box(samples.unwrap_or(1))
        }
        _ => Starts::One,
    }
}
