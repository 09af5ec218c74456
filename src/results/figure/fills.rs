//! The fills of classes: hatches, dots, and what stands where there is nothing.

use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::results::figure::palette::Colouring;
use crate::sweep::label::Label;
use squealmap_figure::svg::Svg;

/// Fill of cells without a result, or not computed.
pub(crate) const FAILED_FILL: &str = "#FFFFFF";

/// The light line and the dashes on it of the linear stability limit: as wide as each other, so that no region beside it is
/// hidden.
pub(crate) const LIMIT: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="0.75" stroke-linejoin="round""##,
    r##"fill="none" stroke="#000000" stroke-width="0.75" stroke-dasharray="2.2 1.2" stroke-linejoin="round""##,
];

/// One hatching per class after the first, in a square of 4 points; they differ in direction and density.
const HATCHES: [&str; 7] = [
    "M-1 1L1 -1M0 4L4 0M3 5L5 3",
    "M-1 3L1 5M0 0L4 4M3 -1L5 1",
    "M0 2H4",
    "M2 0V4",
    "M0 2H4M2 0V4",
    "M0 0L4 4M4 0L0 4",
    "M0 1H2M2 3H4",
];

/// Hatchings, defined once per figure.
pub(crate) fn define_patterns(svg: &mut Svg) {
    for (id, colour) in [("unsettled-on-light", "#000000"), ("unsettled-on-dark", "#FFFFFF")] {
        svg.define(&format!(
            r#"<pattern id="{id}" patternUnits="userSpaceOnUse" width="2.4" height="2.4"><path d="M-0.6 0.6L0.6 -0.6M0 2.4L2.4 0M1.8 3L3 1.8" stroke="{colour}" stroke-width="0.45"/></pattern>"#
        ));
    }
    for (tone, colour) in [("light", "#000000"), ("dark", "#FFFFFF")] {
        svg.define(&format!(
            r#"<pattern id="dots-on-{tone}" patternUnits="userSpaceOnUse" width="3" height="3"><path d="M0.75 0.75h0.01M2.25 2.25h0.01" stroke="{colour}" stroke-width="0.8" stroke-linecap="round"/></pattern>"#
        ));
    }
    for (k, lines) in HATCHES.iter().enumerate() {
        for (tone, colour) in [("light", "#000000"), ("dark", "#FFFFFF")] {
            svg.define(&format!(
                r#"<pattern id="hatch-{k}-{tone}" patternUnits="userSpaceOnUse" width="4" height="4"><path d="{lines}" fill="none" stroke="{colour}" stroke-width="0.4"/></pattern>"#
            ));
        }
    }
    svg.define(
        r##"<pattern id="not-computed" patternUnits="userSpaceOnUse" width="4" height="4"><path d="M-1 3L1 5M0 0L4 4M3 -1L5 1" stroke="#B4B4B4" stroke-width="0.4"/></pattern>"##,
    );
    svg.define(
        r##"<pattern id="failed" patternUnits="userSpaceOnUse" width="3" height="3"><path d="M0 0L3 3M3 0L0 3" stroke="#C00000" stroke-width="0.5"/></pattern>"##,
    );
}

/// The hatching of the class with this position; the first class has none.
pub(crate) fn hatch(class: usize, dark: bool) -> Option<String> {
    let number = class.checked_sub(1).filter(|number| *number < HATCHES.len())?;
    let tone = if dark { "dark" } else { "light" };
    Some(format!(r#"class="hatch" fill="url(#hatch-{number}-{tone})" fill-rule="evenodd""#))
}

/// The pattern that marks an unsettled instance of a class.
pub(crate) fn unsettled_fill(dark: bool) -> &'static str {
    if dark { r#"fill="url(#unsettled-on-dark)""# } else { r#"fill="url(#unsettled-on-light)""# }
}

/// Whether hatching applies: only the response settles.
pub(crate) fn unsettled(label: Label, colouring: Colouring) -> bool {
    colouring == Colouring::Regime && label.settled() == Some(false)
}

/// Whether a stopped run did not come to what a colouring shows of an instance.
pub(crate) fn not_computed(label: Label, colouring: Colouring) -> bool {
    label.status() == Status::NotComputed && colouring.class(label).is_none()
}

/// Whether the sliding equilibrium is stable.
pub(crate) fn is_stable(kind: InstabilityType) -> bool {
    kind == InstabilityType::Stable
}
