//! A figure as PNG at 300 dpi, drawn with embedded fonts only, so that every machine makes the same one.

use std::sync::Arc;

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
    Ok(with_chunks(&image(svg)?, &[resolution()]))
}

/// The PNG of an SVG document as [`render`] makes it, with its title and its provenance as texts that image viewers show.
///
/// # Errors
/// When the document is not SVG, or too large for an image.
pub fn render_described(svg: &str, title: &str, provenance: &str) -> Result<Vec<u8>> {
    let chunks = [resolution(), words("Title", title), words("Description", provenance)];
    Ok(with_chunks(&image(svg)?, &chunks))
}

/// The picture without chunks of its own.
fn image(svg: &str) -> Result<Vec<u8>> {
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
    pixmap.encode_png().map_err(|_| Error::Rasterize { width, height })
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

/// The chunk `pHYs`: pixels per metre.
fn resolution() -> Vec<u8> {
    /// 300 dots per inch in dots per metre.
    const PER_METRE: u32 = 11_811;
    /// The unit code of metres.
    const METRE: u8 = 1;
    let mut body = b"pHYs".to_vec();
    body.extend(PER_METRE.to_be_bytes());
    body.extend(PER_METRE.to_be_bytes());
    body.push(METRE);
    body
}

/// The chunk `iTXt`: a keyword and a text in UTF-8, not compressed, in no particular language.
fn words(keyword: &str, text: &str) -> Vec<u8> {
    let mut body = b"iTXt".to_vec();
    body.extend(keyword.as_bytes());
    body.extend([0; 5]);
    body.extend(text.as_bytes());
    body
}

/// Inserts chunks (type and content) after the header.
fn with_chunks(png: &[u8], chunks: &[Vec<u8>]) -> Vec<u8> {
    /// Signature (8) and the chunk `IHDR` (25).
    const HEADER: usize = 33;
    /// Bytes of the type, which the length of a chunk does not count.
    const TYPE: usize = 4;
    let header = HEADER.min(png.len());
    let mut out = png[..header].to_vec();
    for chunk in chunks {
        // No text of a figure comes near the limit of 2³¹ bytes.
        let length = u32::try_from(chunk.len() - TYPE).unwrap_or(u32::MAX);
        out.extend(length.to_be_bytes());
        out.extend(chunk);
        out.extend(crc32(chunk).to_be_bytes());
    }
    out.extend(&png[header..]);
    out
}

/// CRC-32 as in the PNG specification.
fn crc32(bytes: &[u8]) -> u32 {
    /// The reversed polynomial.
    const POLYNOMIAL: u32 = 0xEDB8_8320;
    let step = |crc: u32, _| if crc & 1 == 1 { POLYNOMIAL ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}
