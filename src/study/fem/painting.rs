//! A mesh painted: its visible pieces, each in the colour of its value.

use squealmap_fem::output::{Facet, isometric};

use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;

/// Pieces of the surface are this long, over the size of the mesh, or one element: finer ones make large files.
pub(super) const PIECE: f64 = 1.0 / 28.0;

/// An edge of an element.
const EDGE: &str = r##"stroke="#3A3A3A" stroke-width="0.12""##;

/// Length of an axis of the triad, points,
pub(super) const AXIS: f64 = 20.0;
/// its line,
const ARROW: &str = r##"fill="none" stroke="#000000" stroke-width="0.8""##;
/// and that of a direction beside it.
const ALONG: &str = r##"fill="none" stroke="#D55E00" stroke-width="1.3""##;

/// The directions x, y and z.
pub(super) fn triad(svg: &mut Svg, [x, y]: [f64; 2]) {
    let view = isometric();
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        let to = [view[0][k], -view[1][k]].map(|part| AXIS * part);
        svg.path(&polyline([(x, y), (x + to[0], y + to[1])]), ARROW);
        let beyond = 1.0 + 5.0 / AXIS / to[0].hypot(to[1]) * AXIS;
        let [right, down] = to.map(|part| part * beyond);
        let style = Style::new(LABEL_SIZE, Anchor::Middle);
        svg.text(x + right, y + down + 0.35 * LABEL_SIZE, &Text::default().symbol(name), style);
    }
}

/// An arrow along a direction in space, its middle at a place; one towards the eye is a short one.
pub(super) fn arrow(svg: &mut Svg, [x, y]: [f64; 2], direction: [f64; 3]) {
    /// Length and half the width of the head, over the length of the arrow.
    const HEAD: [f64; 2] = [0.35, 0.18];
    let view = isometric();
    let seen = |axis: [f64; 3]| AXIS * (0..3).map(|i| axis[i] * direction[i]).sum::<f64>();
    let [a, b] = [seen(view[0]), -seen(view[1])];
    let tip = (x + 0.5 * a, y + 0.5 * b);
    svg.path(&polyline([(x - 0.5 * a, y - 0.5 * b), tip]), ALONG);
    let barb =
        |side: f64| (tip.0 - HEAD[0] * a - side * HEAD[1] * b, tip.1 - HEAD[0] * b + side * HEAD[1] * a);
    svg.path(&polyline([barb(1.0), tip, barb(-1.0)]), ALONG);
}

/// What is painted.
pub(super) struct Painting {
    facets: Vec<Facet>,
    /// Lower left and upper right corner, m.
    bounds: [[f64; 2]; 2],
}

impl Painting {
    /// Of visible pieces, from the farthest to the nearest.
    pub(super) fn new(facets: Vec<Facet>) -> Painting {
        let fold = |f: fn(f64, f64) -> f64, from: f64| {
            [0, 1].map(|i| facets.iter().flat_map(|facet| &facet.outline).map(|c| c[i]).fold(from, f))
        };
        let bounds = [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)];
        Painting { facets, bounds }
    }

    /// Width over height.
    pub(super) fn aspect(&self) -> f64 {
        let [low, high] = self.bounds;
        (high[0] - low[0]) / (high[1] - low[1])
    }

    /// Paints it into a rectangle, as large as it fits; `fill` is the colour of a value.
    pub(super) fn paint(&self, svg: &mut Svg, [x, y, width, height]: [f64; 4], fill: impl Fn(f64) -> String) {
        let [low, high] = self.bounds;
        let scale = (width / (high[0] - low[0])).min(height / (high[1] - low[1]));
        let shift =
            [x + 0.5 * (width - scale * (high[0] - low[0])), y + 0.5 * (height + scale * (high[1] - low[1]))];
        let at = |c: &[f64; 2]| (shift[0] + scale * (c[0] - low[0]), shift[1] - scale * (c[1] - low[1]));
        svg.open(r#"stroke-width="0.3" stroke-linejoin="round""#);
        let side = |facet: &Facet, i: usize| {
            polyline([at(&facet.outline[i]), at(&facet.outline[(i + 1) % facet.outline.len()])])
        };
        let sides = |facet: &Facet, edge: bool| -> String {
            (0..facet.outline.len()).filter(|i| facet.edges[*i] == edge).map(|i| side(facet, i)).collect()
        };
        for facet in &self.facets {
            let fill = fill(facet.value);
            svg.path(&(polyline(facet.outline.iter().map(at)) + "Z"), &format!(r#"fill="{fill}""#));
            // A line of its own colour closes the seams between pieces.
            svg.path(&sides(facet, false), &format!(r#"stroke="{fill}""#));
            if !facet.whole {
                svg.path(&sides(facet, true), EDGE);
            }
        }
        // Nothing hides these: they are drawn over all colours.
        for facet in self.facets.iter().filter(|facet| facet.whole) {
            svg.path(&sides(facet, true), EDGE);
        }
        svg.close();
    }
}
