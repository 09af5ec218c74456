//! What a witness says about a segment of time.

use crate::verdict::Kind;

/// Who speaks about a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Witness {
    /// The power of friction while the vibration grows.
    Power,
    /// The phase between normal and tangential acceleration: the source paper's method.
    Phase,
    /// Level and slope of the friction coefficient.
    Friction,
}

impl Witness {
    /// All of them, in the order of a segment's testimonies.
    pub const ALL: [Witness; 3] = [Witness::Power, Witness::Phase, Witness::Friction];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Witness::Power => "power of friction at growth",
            Witness::Phase => "phase (the paper's method)",
            Witness::Friction => "level and slope of friction",
        }
    }

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Witness::Power => "power",
            Witness::Phase => "phase",
            Witness::Friction => "friction",
        }
    }
}

/// Causes that chances are given for: [`Kind`]s, and an instability that needs both mechanisms together.
pub(super) const CAUSES: usize = 5;

/// The probabilities of no instability, negative slope, mode coupling, both, and only both together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chances(pub [f64; CAUSES]);

impl Chances {
    /// From weights of any sum; `None` when there is no weight.
    pub(super) fn from_weights(weights: [f64; CAUSES]) -> Option<Chances> {
        let sum: f64 = weights.iter().sum();
        (sum > 0.0 && sum.is_finite()).then(|| Chances(weights.map(|weight| weight / sum)))
    }

    /// From the probabilities that mode coupling alone, and that the slope alone, would do.
    pub(super) fn of_each(coupling: f64, slope: f64) -> Chances {
        let (no_coupling, no_slope) = (1.0 - coupling, 1.0 - slope);
        Chances([no_coupling * no_slope, no_coupling * slope, coupling * no_slope, coupling * slope, 0.0])
    }

    /// The likeliest kind and its probability; of what needs both together there is no kind.
    #[must_use]
    pub fn leading(&self) -> (Kind, f64) {
        let best = (0..CAUSES).max_by(|a, b| self.0[*a].total_cmp(&self.0[*b])).unwrap_or_default();
        // Kinds have the order of the causes; the fifth of them is undecided.
        (Kind::ALL[best], self.0[best])
    }

    /// The probability of a kind; 0 for undecided.
    #[must_use]
    pub fn of(&self, kind: Kind) -> f64 {
        match kind {
            Kind::NoInstability => self.0[0],
            Kind::NegativeSlope => self.0[1],
            Kind::ModeCoupling => self.0[2],
            Kind::Both => self.0[3],
            Kind::Undecided => 0.0,
        }
    }

    /// The probability that mode coupling alone would do.
    #[must_use]
    pub fn coupling(&self) -> f64 {
        self.0[2] + self.0[3]
    }

    /// The probability that a mechanism alone would do.
    #[must_use]
    pub fn suffices(&self, mechanism: Mechanism) -> f64 {
        match mechanism {
            Mechanism::NegativeSlope => self.slope(),
            Mechanism::ModeCoupling => self.coupling(),
        }
    }

    /// The probability that the slope alone would do.
    #[must_use]
    pub fn slope(&self) -> f64 {
        self.0[1] + self.0[3]
    }
}

/// One mechanism that suffices, whatever the other one does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Mechanism {
    /// The falling friction-velocity slope.
    NegativeSlope,
    /// Mode coupling.
    ModeCoupling,
}

impl Mechanism {
    /// Both of them.
    pub const ALL: [Mechanism; 2] = [Mechanism::NegativeSlope, Mechanism::ModeCoupling];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Mechanism::NegativeSlope => "negative slope, with or without mode coupling",
            Mechanism::ModeCoupling => "mode coupling, with or without a negative slope",
        }
    }
}

/// What one witness says.
#[derive(Clone, Debug, PartialEq)]
pub struct Testimony {
    /// Who speaks.
    pub witness: Witness,
    /// How likely each cause is; `None` when it cannot speak.
    pub chances: Option<Chances>,
    /// What it saw, or why it cannot speak.
    pub evidence: String,
}

impl Testimony {
    pub(super) fn silent(witness: Witness, why: impl Into<String>) -> Testimony {
        Testimony { witness, chances: None, evidence: why.into() }
    }
}
