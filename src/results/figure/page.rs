//! The page that a figure has to fit: how tall it may be, and panels that become flatter where they would not.

use crate::results::error::{Error, Result};
use crate::results::figure::look::Look;
use squealmap_figure::svg::{MM, Svg};

/// Panels are never flatter than this part of their usual height.
const FLATTEST: f64 = 0.35;
/// A page that is taller by rounding fits, mm.
const ROUNDING: f64 = 0.01;

impl Look<'_> {
    /// The height in which to draw, points; `None` where any is right.
    pub(crate) fn tallest(&self) -> Option<f64> {
        self.height.map(|mm| mm * MM / self.enlarged)
    }

    /// The finished document of a figure whose panels have this height in all, points: `draw` gives the picture and its size
    /// in points for a part of that height. All of it is taken where the page has room. The name is that of a document
    /// above which nothing else stands.
    pub(crate) fn fitted(&self, name: &str, panels: f64, draw: impl Fn(f64) -> (Svg, [f64; 2])) -> String {
        let title = self.title(name);
        let name = if title.is_empty() { name } else { title };
        let (svg, size) = draw(1.0);
        let beyond = self.tallest().map_or(0.0, |tallest| size[1] - tallest);
        if beyond <= 0.0 {
            return self.finish(svg, size, name);
        }
        let (svg, size) = draw((1.0 - beyond / panels).max(FLATTEST));
        self.finish(svg, size, name)
    }

    /// Refuses a finished document that is taller than the page.
    ///
    /// # Errors
    /// When it is.
    pub fn check_height(&self, svg: &str, advice: &'static str) -> Result<()> {
        let height = stated_height(svg);
        match self.height {
            Some(most) if height > most + ROUNDING => Err(Error::TooTall { height, most, advice }),
            _ => Ok(()),
        }
    }
}

/// The height that a document states, mm.
fn stated_height(svg: &str) -> f64 {
    let stated = svg.split_once(" height=\"").and_then(|(_, rest)| rest.split_once("mm\""));
    stated.and_then(|(number, _)| number.parse().ok()).unwrap_or(0.0)
}
