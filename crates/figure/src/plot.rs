//! Line plots: curves in a frame, thinned to what a printer resolves.

use crate::frame::Frame;
use crate::scale::Scale;
use crate::svg::{Svg, polyline};

/// Width of the columns in which a curve is thinned, points: finer than its line.
const COLUMN: f64 = 0.25;

/// Stroke of the first curve of a panel.
pub const FIRST: &str = r##"fill="none" stroke="#1F3F8F" stroke-width="0.9" stroke-linejoin="round""##;
/// Stroke of the second curve: lighter and dashed, so that it survives a grey print.
pub const SECOND: &str =
    r##"fill="none" stroke="#D55E00" stroke-width="0.9" stroke-dasharray="3.2 1.6" stroke-linejoin="round""##;
/// Stroke of a third curve: dotted, between the two in lightness.
pub const THIRD: &str = r##"fill="none" stroke="#4F7F4F" stroke-width="1.1" stroke-dasharray="0.1 2.2" stroke-linecap="round" stroke-linejoin="round""##;
/// Stroke of one of many modes that do not grow,
pub const STABLE: &str = r##"fill="none" stroke="#1F3F8F" stroke-width="0.7" stroke-linejoin="round""##;
/// and of one that grows.
pub const GROWS: &str = r##"fill="none" stroke="#D55E00" stroke-width="1.6" stroke-linejoin="round""##;
/// The mark at a critical value.
pub const CRITICAL: &str = r##"fill="none" stroke="#000000" stroke-width="0.6" stroke-dasharray="1.2 1.4""##;
/// The line of zero, of what has a sign.
pub const ZERO: &str = r##"fill="none" stroke="#777777" stroke-width="0.5""##;

/// A frame with what its sides mean.
pub struct Plot<'a> {
    /// The frame.
    pub frame: Frame,
    /// The scale of the horizontal axis.
    pub x: &'a Scale,
    /// The scale of the vertical axis.
    pub y: &'a Scale,
}

impl Plot<'_> {
    /// Draws a curve, interrupted where a value is undefined.
    pub fn curve(&self, svg: &mut Svg, points: impl IntoIterator<Item = (f64, f64)>, stroke: &str) {
        let mut data = String::new();
        let mut piece: Vec<(f64, f64)> = Vec::new();
        for (x, y) in points {
            if x.is_finite() && y.is_finite() {
                piece.push((self.frame.across(self.x.position(x)), self.frame.up(self.y.position(y))));
            } else {
                data.push_str(&polyline(thin(&piece)));
                piece.clear();
            }
        }
        data.push_str(&polyline(thin(&piece)));
        svg.path(&data, stroke);
    }
}

impl Plot<'_> {
    /// Draws the area inside a closed line.
    pub fn area(&self, svg: &mut Svg, points: impl IntoIterator<Item = (f64, f64)>, style: &str) {
        let at =
            |(x, y): (f64, f64)| (self.frame.across(self.x.position(x)), self.frame.up(self.y.position(y)));
        let outline = points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite()).map(at);
        let data = polyline(outline);
        if !data.is_empty() {
            svg.path(&(data + "Z"), style);
        }
    }
}

/// Keeps the first, lowest, highest and last point of every narrow column, in their order.
fn thin(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let column = |point: &(f64, f64)| (point.0 / COLUMN).floor();
    let mut kept = Vec::new();
    for chunk in points.chunk_by(|a, b| column(a).to_bits() == column(b).to_bits()) {
        let (mut low, mut high) = (0, 0);
        for (i, point) in chunk.iter().enumerate() {
            if point.1 < chunk[low].1 {
                low = i;
            }
            if point.1 > chunk[high].1 {
                high = i;
            }
        }
        let mut order = [0, low.min(high), low.max(high), chunk.len() - 1].to_vec();
        order.dedup();
        kept.extend(order.into_iter().map(|i| chunk[i]));
    }
    kept
}
