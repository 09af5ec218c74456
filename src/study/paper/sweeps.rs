//! The sweep files in `sweeps/paper/`, built in so that an installed program has them.

use std::path::Path;

use crate::sweep::spec::Spec;

/// A friction case of the paper's ramps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// A falling friction law with little friction: Figures 3a and 4.
    NegativeSlope,
    /// Constant friction above the coalescence of the modes: Figures 3b and 5.
    ModeCoupling,
    /// Both: Figures 3c and 6.
    Both,
}

impl Case {
    /// The cases in the order of the figures.
    pub const ALL: [Case; 3] = [Case::NegativeSlope, Case::ModeCoupling, Case::Both];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Case::NegativeSlope => "negative slope",
            Case::ModeCoupling => "mode coupling",
            Case::Both => "both",
        }
    }

    /// The ramp of the case as shipped.
    #[must_use]
    pub fn ramp(self) -> Spec {
        match self {
            Case::NegativeSlope => FIGURE_4.spec(),
            Case::ModeCoupling => FIGURE_5.spec(),
            Case::Both => FIGURE_6.spec(),
        }
    }
}

/// A sweep file: its name in the repository and its text.
pub(super) struct Shipped {
    name: &'static str,
    text: &'static str,
}

macro_rules! shipped {
    ($($constant:ident $file:literal;)*) => {
        $(pub(super) const $constant: Shipped = Shipped {
            name: concat!("sweeps/paper/", $file),
            text: include_str!(concat!("../../../sweeps/paper/", $file)),
        };)*
    };
}

shipped! {
    FIGURE_2 "figure2.toml";
    FIGURE_4 "figure4.toml";
    FIGURE_5 "figure5.toml";
    FIGURE_6 "figure6.toml";
    FIGURE_7A "figure7a.toml";
    FIGURE_7B "figure7b.toml";
    ACCELERATIONS "accelerations.toml";
    PHASE "phase.toml";
}

impl Shipped {
    /// The sweep; it names no other files.
    pub(super) fn spec(&self) -> Spec {
        Spec::parse(self.text, self.name, Path::new("")).expect("a shipped sweep is valid: a test reads each")
    }
}
