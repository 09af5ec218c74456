//! Colours of types and regimes.
//!
//! Each set falls from near white to near black in steps that differ in lightness as well as in hue, so
//! that it survives the three kinds of dichromacy and a grey print; a test measures both. The hues are
//! those of the sets of Okabe & Ito and of Tol, moved to evenly spaced lightness.

use crate::sweep::label::Label;
use crate::sweep::spec::{Analysis, Starts};

/// The colour of instances at rest, hardly darker than white paper.
pub const PALE: &str = "#F2F2EE";

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

/// The classes of [`InstabilityType::ALL`](crate::model::kind::InstabilityType::ALL), in that order.
pub const TYPES: [Class; 7] = [
    Class { name: "stable", label: "stable", fill: PALE, dark: false },
    Class { name: "negative_slope", label: "negative slope", fill: "#56B4E9", dark: false },
    Class { name: "mode_coupling", label: "mode coupling", fill: "#B5441A", dark: true },
    Class { name: "coexistence", label: "coexistence", fill: "#452087", dark: true },
    Class { name: "interaction", label: "interaction", fill: "#EBCB57", dark: false },
    Class { name: "sticking", label: "sticking (V = 0)", fill: "#808B81", dark: false },
    Class { name: "divergence", label: "divergence", fill: "#0A0A0A", dark: true },
];

/// The classes of [`Regime::ALL`](crate::engine::regime::Regime::ALL), in that order.
pub const REGIMES: [Class; 8] = [
    Class { name: "equilibrium", label: "equilibrium", fill: PALE, dark: false },
    Class { name: "slip", label: "slip", fill: "#BDD965", dark: false },
    Class { name: "stick_slip", label: "stick–slip", fill: "#45B89B", dark: false },
    Class { name: "slip_reversal", label: "slip reversal", fill: "#5B85CC", dark: false },
    Class { name: "detaching", label: "detaching", fill: "#A03785", dark: true },
    Class { name: "detaching_stick_slip", label: "detaching stick–slip", fill: "#6B1237", dark: true },
    Class { name: "stuck", label: "stuck", fill: "#0A0A0A", dark: true },
    Class { name: "not_yet_grown", label: "not yet grown", fill: "#FBD2FF", dark: false },
];

/// Whether several starts end differently.
pub const BISTABILITY: [Class; 3] = [
    Class { name: "monostable", label: "one end met", fill: PALE, dark: false },
    Class { name: "no_verdict", label: "no verdict", fill: "#A9B4BA", dark: false },
    Class { name: "bistable", label: "bistable", fill: "#A5480F", dark: true },
];

/// The property by which a block of panels is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colouring {
    /// Colours by [`InstabilityType`](crate::model::kind::InstabilityType).
    Type,
    /// Colours by [`Regime`](crate::engine::regime::Regime).
    Regime,
    /// Colours by whether several starts end differently.
    Bistability,
}

impl Colouring {
    /// The colourings of an analysis, in the order of a figure's blocks.
    pub fn of(analysis: Analysis) -> impl Iterator<Item = Colouring> {
        let asked = [
            (Colouring::Type, analysis.linear),
            (Colouring::Regime, analysis.response),
            (Colouring::Bistability, analysis.starts != Starts::One),
        ];
        asked.into_iter().filter_map(|(colouring, asked)| asked.then_some(colouring))
    }

    /// The name of its column in `map.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Colouring::Type => "type",
            Colouring::Regime => "regime",
            Colouring::Bistability => "bistable",
        }
    }

    /// The heading of the block, for instances with these starts.
    #[must_use]
    pub fn heading(self, starts: Starts) -> &'static str {
        match self {
            Colouring::Type => "Type of instability (complex eigenvalues)",
            Colouring::Regime if starts != Starts::One => "Regime from the small start (time integration)",
            Colouring::Regime => "Regime of the response (time integration)",
            Colouring::Bistability => "Bistability: starts that end differently",
        }
    }

    /// Its classes.
    #[must_use]
    pub fn classes(self) -> &'static [Class] {
        match self {
            Colouring::Type => &TYPES,
            Colouring::Regime => &REGIMES,
            Colouring::Bistability => &BISTABILITY,
        }
    }

    /// The position of a label's class in [`Colouring::classes`]; `None` where there is no result.
    #[must_use]
    pub fn class(self, label: Label) -> Option<usize> {
        match self {
            Colouring::Type => label.kind_position(),
            Colouring::Regime => label.regime_position(),
            Colouring::Bistability => match label.bistable() {
                Some(bistable) => Some(if bistable { 2 } else { 0 }),
                None => label.regime().map(|_| 1),
            },
        }
    }
}
