//! A figure as PDF: vectors, text as text in the embedded fonts, at the size the SVG document states.

use krilla::geom::Size;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla::{Document, SerializeSettings};
use krilla_svg::{SurfaceExt, SvgSettings};

use crate::error::{Error, Result};
use crate::png::{CSS_DPI, read};

/// Points per inch: the unit of PDF.
const POINTS: f32 = 72.0;

/// The PDF of an SVG document; `provenance` and the program that made it stand in its metadata.
///
/// # Errors
/// When the document is not SVG, or has no size.
pub fn render(svg: &str, title: &str, provenance: &str, creator: &str) -> Result<Vec<u8>> {
    let tree = read(svg)?;
    let failed = |why: String| Error::Pdf { why };
    let [width, height] = [tree.size().width(), tree.size().height()].map(|length| length * POINTS / CSS_DPI);
    let empty = || failed(format!("a page of {width} × {height} points is empty"));
    let size = Size::from_wh(width, height).ok_or_else(empty)?;
    let page = PageSettings::from_wh(width, height).ok_or_else(empty)?;
    let mut document = Document::new_with(SerializeSettings::default());
    document.set_metadata(
        Metadata::new()
            .title(title.to_owned())
            .description(provenance.to_owned())
            .creator(creator.to_owned()),
    );
    let mut page = document.start_page_with(page);
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default()).ok_or_else(empty)?;
    surface.finish();
    page.finish();
    document.finish().map_err(|why| failed(format!("{why:?}")))
}
