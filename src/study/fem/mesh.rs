//! `mesh.svg`: the mesh of a study with its parts, as Figure 15 of the paper.

use squealmap_fem::output::{facets, isometric};

use crate::results::figure::look::Look;
use crate::study::fem::bodies::Bodies;
use crate::study::fem::painting::{AXIS, PIECE, Painting, triad};
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// Height of the picture at most, points.
const TALLEST: f64 = 260.0;
/// Side of a sample of a colour, points.
const SAMPLE: f64 = 8.0;
/// Height of a line of words, points.
const LINE: f64 = 11.0;
/// The colours of parts, over and over: light, so that edges show.
const COLOURS: [&str; 6] = ["#9FC5E8", "#F6C48B", "#A8D5B0", "#E3A9C0", "#D9D38C", "#C4B5E0"];

impl Bodies {
    /// The mesh as an SVG document.
    #[must_use]
    pub fn mesh_svg(&self, look: &Look<'_>) -> String {
        let mesh = &self.mesh;
        // Nodes stand part by part; those that a merged bond shares are of the part before.
        let parts = self.parts.iter().enumerate();
        let mut of: Vec<f64> = parts.flat_map(|(k, (_, nodes, _))| vec![k as f64; *nodes]).collect();
        of.resize(mesh.nodes.len(), 0.0);
        let still = vec![[0.0; 3]; mesh.nodes.len()];
        let painting = Painting::new(facets(mesh, &still, &of, &isometric(), PIECE * mesh.extent()));
        let name = look.title(&self.title);
        let name = if name.is_empty() { "Mesh" } else { name };
        look.fitted(name, TALLEST, |part| page(self, &painting, look, part * TALLEST))
    }
}

fn page(bodies: &Bodies, painting: &Painting, look: &Look<'_>, tallest: f64) -> (Svg, [f64; 2]) {
    let width = look.points().unwrap_or(SINGLE_COLUMN);
    let whole = width - 2.0 * MARGIN;
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(&bodies.title), whole);
    let height = (whole / painting.aspect()).min(tallest);
    painting.paint(&mut svg, [MARGIN, y, whole, height], |value| colour(value).to_owned());
    // Below the lower left edge of whatever stands in the middle there is room.
    triad(&mut svg, [MARGIN + AXIS, y + height - 0.6 * AXIS]);
    y += height + 6.0;
    let style = Style::new(LABEL_SIZE, Anchor::Start);
    for (k, (name, nodes, elements)) in bodies.parts.iter().enumerate() {
        svg.rect(
            [MARGIN, y, SAMPLE, SAMPLE],
            &format!(r##"fill="{}" stroke="#3A3A3A" stroke-width="0.4""##, colour(k as f64)),
        );
        let words = Text::from(format!("{}: {elements} elements, {nodes} nodes", name.replace('_', " ")));
        svg.text(MARGIN + SAMPLE + 4.0, y + SAMPLE - 1.0, &words, style);
        y += LINE;
    }
    if let Some(words) = sliding(bodies) {
        svg.text(MARGIN, y + SAMPLE - 1.0, &Text::from(words), style);
        y += LINE;
    }
    (svg, [width, y + MARGIN])
}

/// The colour of a part.
fn colour(value: f64) -> &'static str {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number")]
    let part = value.max(0.0).round() as usize;
    COLOURS[part % COLOURS.len()]
}

/// Points of contact, and where along an axis they slide.
fn sliding(bodies: &Bodies) -> Option<String> {
    /// The cosine from which a direction is along an axis.
    const ALONG: f64 = 0.999_999;
    let contact = bodies.sliding?;
    let axes = ["x", "y", "z"].into_iter().zip(contact.direction);
    let which = match axes.into_iter().find(|(_, part)| part.abs() > ALONG) {
        Some((axis, part)) if !contact.turns => {
            format!(", sliding along {}{axis}", if part < 0.0 { "−" } else { "" })
        }
        _ => String::new(),
    };
    Some(format!("{} points of contact{which}", contact.points))
}
