//! A mesh painted: its visible pieces, each in the colour of its value.

use squealmap_fem::output::Facet;

use squealmap_figure::svg::{Svg, polyline};

/// Pieces of the surface are this long, over the size of the mesh, or one element: finer ones make large files.
pub(super) const PIECE: f64 = 1.0 / 28.0;

/// An edge of an element.
const EDGE: &str = r##"stroke="#3A3A3A" stroke-width="0.12""##;

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
        for facet in &self.facets {
            let fill = fill(facet.value);
            let outline = polyline(facet.outline.iter().map(at)) + "Z";
            if facet.edges.iter().all(|edge| *edge) {
                svg.path(&outline, &format!(r#"fill="{fill}" {EDGE}"#));
                continue;
            }
            // The line of its own colour closes the seams between pieces.
            svg.path(&outline, &format!(r#"fill="{fill}" stroke="{fill}""#));
            let side = |i: usize| {
                polyline([at(&facet.outline[i]), at(&facet.outline[(i + 1) % facet.outline.len()])])
            };
            let edges: String = (0..facet.outline.len()).filter(|i| facet.edges[*i]).map(side).collect();
            svg.path(&edges, EDGE);
        }
        svg.close();
    }
}
