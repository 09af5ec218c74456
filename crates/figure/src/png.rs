//! A figure as PNG at 300 dpi, drawn with embedded fonts only, so that every machine makes the same one.

use std::sync::Arc;

use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter, PixelDimensions, Unit};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::error::{Error, Result};

/// Resolution in dots per inch.
pub const DPI: f32 = 300.0;

/// CSS pixels per inch: the unit in which the SVG library reports sizes.
pub const CSS_DPI: f32 = 96.0;

/// The embedded family.
const FAMILY: &str = "Liberation Sans";

/// The upright face.
pub const REGULAR: &[u8] = include_bytes!("../fonts/LiberationSans-Regular.ttf");
/// The bold face.
pub const BOLD: &[u8] = include_bytes!("../fonts/LiberationSans-Bold.ttf");
/// All faces.
pub const FONTS: [&[u8]; 3] = [REGULAR, include_bytes!("../fonts/LiberationSans-Italic.ttf"), BOLD];

/// The deepest nesting of elements that is drawn: the library goes down into each, on the stack of its caller.
const DEEPEST: usize = 100;

/// How deep the elements of a document are nested, or what a broken one looks like.
fn nesting(svg: &str) -> usize {
    let (mut depth, mut deepest) = (0_usize, 0);
    for tag in svg.split('<').skip(1) {
        if tag.starts_with('/') {
            depth = depth.saturating_sub(1);
        } else if !tag.starts_with(['!', '?']) {
            let end = tag.find('>').unwrap_or(tag.len());
            deepest = deepest.max(depth + 1);
            depth += usize::from(!tag[..end].ends_with('/'));
        }
    }
    deepest
}

/// The PNG of an SVG document at [`DPI`] with its resolution recorded.
///
/// # Errors
/// When the document is not SVG, or too large for an image.
pub fn render(svg: &str) -> Result<Vec<u8>> {
    encoded(&drawn(svg)?, &[])
}

/// The PNG of an SVG document as [`render`] makes it, with its title and its provenance as texts that image viewers show.
///
/// # Errors
/// When the document is not SVG, or too large for an image.
pub fn render_described(svg: &str, title: &str, provenance: &str) -> Result<Vec<u8>> {
    encoded(&drawn(svg)?, &[("Title", title), ("Description", provenance)])
}

/// The picture on white.
fn drawn(svg: &str) -> Result<Pixmap> {
    let tree = read(svg)?;
    let scale = DPI / CSS_DPI;
    let size = tree.size();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive; a size beyond u32 saturates and is refused by Pixmap"
    )]
    let [width, height] = [size.width(), size.height()].map(|length| (length * scale).ceil() as u32);
    let mut pixmap = Pixmap::new(width, height).ok_or(Error::Rasterize { width, height })?;
    // The last row and column reach over the edge of the page.
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// The PNG of an opaque picture with its resolution, and texts with their keywords.
fn encoded(pixmap: &Pixmap, texts: &[(&str, &str)]) -> Result<Vec<u8>> {
    /// 300 dots per inch in dots per metre.
    const PER_METRE: u32 = 11_811;
    /// Drawings are flat: a filter of rows makes them larger and takes twice the time, more effort saves a twentieth.
    const EFFORT: DeflateCompression = DeflateCompression::Level(4);
    let (width, height) = (pixmap.width(), pixmap.height());
    let colours: Vec<u8> =
        pixmap.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    let mut out = Vec::new();
    let mut write = || -> std::result::Result<(), png::EncodingError> {
        let mut encoder = Encoder::new(&mut out, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_filter(Filter::NoFilter);
        encoder.set_deflate_compression(EFFORT);
        encoder.set_pixel_dims(Some(PixelDimensions { xppu: PER_METRE, yppu: PER_METRE, unit: Unit::Meter }));
        for (keyword, text) in texts {
            encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned())?;
        }
        encoder.write_header()?.write_image_data(&colours)
    };
    write().map_err(|_| Error::Rasterize { width, height })?;
    Ok(out)
}

/// An SVG document with the embedded fonts.
///
/// # Errors
/// When it is not SVG.
pub fn read(svg: &str) -> Result<Tree> {
    let depth = nesting(svg);
    if depth > DEEPEST {
        return Err(Error::Nested { depth, most: DEEPEST });
    }
    Tree::from_str(svg, &options()).map_err(Error::ReadSvg)
}

/// Only the embedded fonts, whatever family is asked for.
fn options() -> Options<'static> {
    let mut fonts = fontdb::Database::new();
    for font in FONTS {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(font)));
    }
    fonts.set_sans_serif_family(FAMILY);
    Options { fontdb: Arc::new(fonts), font_family: FAMILY.to_owned(), ..Options::default() }
}
