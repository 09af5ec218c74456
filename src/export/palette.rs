//! Colours of types and regimes.
//!
//! Each set falls from near white to near black in steps that differ in lightness as well as in hue, so
//! that it survives the three kinds of dichromacy and a grey print; a test measures both. The hues are
//! those of the sets of Okabe & Ito and of Tol, moved to evenly spaced lightness.

use crate::label::Label;

/// How one class is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// The name in `map.csv`.
    pub name: &'static str,
    /// The words of a legend.
    pub label: &'static str,
    /// Fill colour, `#RRGGBB`.
    pub fill: &'static str,
    /// Whether marks on top of it must be white.
    pub dark: bool,
}

/// The classes of [`InstabilityType::ALL`](crate::classify::InstabilityType::ALL), in that order.
pub const TYPES: [Class; 7] = [
    Class { name: "stable", label: "stable", fill: "#F2F2EE", dark: false },
    Class { name: "negative_slope", label: "negative slope", fill: "#56B4E9", dark: false },
    Class { name: "mode_coupling", label: "mode coupling", fill: "#B5441A", dark: true },
    Class { name: "coexistence", label: "coexistence", fill: "#452087", dark: true },
    Class { name: "interaction", label: "interaction", fill: "#EBCB57", dark: false },
    Class { name: "sticking", label: "sticking (V = 0)", fill: "#808B81", dark: false },
    Class { name: "divergence", label: "divergence", fill: "#0A0A0A", dark: true },
];

/// The classes of [`Regime::ALL`](crate::classify::Regime::ALL), in that order.
pub const REGIMES: [Class; 7] = [
    Class { name: "equilibrium", label: "equilibrium", fill: "#F2F2EE", dark: false },
    Class { name: "slip", label: "slip", fill: "#BDD965", dark: false },
    Class { name: "stick_slip", label: "stick–slip", fill: "#45B89B", dark: false },
    Class { name: "slip_reversal", label: "slip reversal", fill: "#5B85CC", dark: false },
    Class { name: "detaching", label: "detaching", fill: "#A03785", dark: true },
    Class { name: "detaching_stick_slip", label: "detaching stick–slip", fill: "#6B1237", dark: true },
    Class { name: "stuck", label: "stuck", fill: "#0A0A0A", dark: true },
];

/// What a block of panels colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colouring {
    /// By [`InstabilityType`](crate::classify::InstabilityType).
    Type,
    /// By [`Regime`](crate::classify::Regime).
    Regime,
}

impl Colouring {
    /// The heading of the block.
    #[must_use]
    pub fn heading(self) -> &'static str {
        match self {
            Colouring::Type => "Type of instability (complex eigenvalues)",
            Colouring::Regime => "Regime of the response (time integration)",
        }
    }

    /// Its classes.
    #[must_use]
    pub fn classes(self) -> &'static [Class; 7] {
        match self {
            Colouring::Type => &TYPES,
            Colouring::Regime => &REGIMES,
        }
    }

    /// The position of a label's class in [`Colouring::classes`]; `None`: there is no result.
    #[must_use]
    pub fn class(self, label: Label) -> Option<usize> {
        match self {
            Colouring::Type => label.kind_position(),
            Colouring::Regime => label.regime_position(),
        }
    }
}
