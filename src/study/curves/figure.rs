//! The curves in the panels of their map.

use crate::results::figure::look::{Content, Look};
use crate::results::figure::map::MapFigure;
use crate::results::figure::overlay::{Overlay, Stroke};
use crate::study::curves::seek::PlaneCurves;
use crate::study::cycles::special::Special;
use crate::sweep::grid::AxisKey;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::Spec;

/// How each kind of curve is drawn.
const STROKES: [(Special, Stroke); 5] = [
    (
        Special::Hopf,
        Stroke::line(
            "Hopf (H): the equilibrium loses its stability",
            r##"class="hopf" fill="none" stroke="#D55E00" stroke-width="1.2" stroke-linejoin="round""##,
        ),
    ),
    (
        Special::Fold,
        Stroke::line(
            "fold of cycles (LP)",
            r##"class="fold" fill="none" stroke="#000000" stroke-width="1.2" stroke-linejoin="round""##,
        ),
    ),
    (
        Special::Corner,
        Stroke::line(
            "fold at a change of contact (C)",
            r##"class="corner" fill="none" stroke="#000000" stroke-width="1.2" stroke-dasharray="6 2" stroke-linejoin="round""##,
        ),
    ),
    (
        Special::Doubling,
        Stroke::line(
            "period doubling (PD)",
            r##"class="doubling" fill="none" stroke="#000000" stroke-width="1.2" stroke-dasharray="1.2 1.6" stroke-linejoin="round""##,
        ),
    ),
    (
        Special::Torus,
        Stroke::line(
            "torus (NS)",
            r##"class="torus" fill="none" stroke="#000000" stroke-width="1.2" stroke-dasharray="6 1.6 1.2 1.6" stroke-linejoin="round""##,
        ),
    ),
];

/// The stroke of a kind of curve; `None` where it has none.
pub(crate) fn stroke(special: Special) -> Option<Stroke> {
    STROKES.iter().find(|(of, _)| *of == special).map(|(_, stroke)| *stroke)
}

/// The curves as lines over a map.
#[must_use]
pub fn overlays(planes: &[PlaneCurves]) -> Vec<Overlay> {
    let of_plane = |plane: &PlaneCurves| -> Vec<Overlay> {
        let line = |(special, points)| {
            Some(Overlay {
                axes: plane.params.map(AxisKey::Param),
                others: plane.others.clone(),
                stroke: stroke(special)?,
                points,
            })
        };
        let points = |curve: &crate::study::cycles::curve::Curve| {
            curve.points.iter().map(|point| point.values).collect()
        };
        plane.curves.iter().filter_map(|curve| line((curve.special, points(curve)))).collect()
    };
    ordered(planes.iter().flat_map(of_plane).collect())
}

/// Lines from beneath to above: what is rarer lies above.
pub(crate) fn ordered(mut lines: Vec<Overlay>) -> Vec<Overlay> {
    let place = |line: &Overlay| STROKES.iter().position(|(_, stroke)| *stroke == line.stroke);
    lines.sort_by_key(place);
    lines
}

/// The figure of lines alone as an SVG document.
#[must_use]
pub fn curves_svg(spec: &Spec, lines: &[Overlay], look: &Look<'_>) -> String {
    let look = Look { contents: vec![Content::Lines], lines: lines.to_vec(), ..look.clone() };
    MapFigure::new(Sheet::new(spec, [None, None])).look(&look)
}
