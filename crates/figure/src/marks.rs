//! Open marks on a curve: values of a response that has not settled.

use crate::plot::Plot;
use crate::svg::Svg;

/// Radius of a mark, points.
pub const MARK: f64 = 1.5;
/// Its sample in a legend.
pub const UNSETTLED: &str = r##"fill="#FFFFFF" stroke="#000000" stroke-width="0.6""##;

/// Draws marks in the colour of a curve, none on top of another.
pub fn open_marks(
    svg: &mut Svg,
    plot: &Plot<'_>,
    points: impl IntoIterator<Item = (f64, f64)>,
    stroke: &str,
) {
    let style = format!(r##"class="unsettled" fill="#FFFFFF" stroke="{}" stroke-width="0.6""##, ink(stroke));
    let mut last: Option<(f64, f64)> = None;
    for (x, y) in points.into_iter().filter(|(_, y)| y.is_finite()) {
        let at = (plot.frame.across(plot.x.position(x)), plot.frame.up(plot.y.position(y)));
        if last.is_none_or(|last| (at.0 - last.0).hypot(at.1 - last.1) >= 2.0 * MARK) {
            svg.circle(at.0, at.1, MARK, &style);
            last = Some(at);
        }
    }
}

/// The colour of a stroke.
fn ink(stroke: &str) -> &str {
    let colour = stroke.split_once("stroke=\"").and_then(|(_, rest)| rest.split_once('"'));
    colour.map_or("#000000", |(colour, _)| colour)
}
