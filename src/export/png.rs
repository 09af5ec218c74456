//! A figure as PNG at 300 dpi, drawn with embedded fonts only, so that every machine makes the same one.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::error::{Error, Result};

/// Resolution in dots per inch.
pub const DPI: f32 = 300.0;

/// CSS pixels per inch: the unit in which the SVG library reports sizes.
pub(super) const CSS_DPI: f32 = 96.0;

/// The embedded family.
const FAMILY: &str = "Liberation Sans";

const FONTS: [&[u8]; 3] = [
    include_bytes!("../../assets/fonts/LiberationSans-Regular.ttf"),
    include_bytes!("../../assets/fonts/LiberationSans-Italic.ttf"),
    include_bytes!("../../assets/fonts/LiberationSans-Bold.ttf"),
];

/// The PNG of an SVG document at [`DPI`] with its resolution recorded.
///
/// # Errors
/// When the document is not SVG, or too large for an image.
pub fn render(svg: &str) -> Result<Vec<u8>> {
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
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    let png = pixmap.encode_png().map_err(|_| Error::Rasterize { width, height })?;
    Ok(with_resolution(&png))
}

/// An SVG document with the embedded fonts.
pub(super) fn read(svg: &str) -> Result<Tree> {
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

/// Inserts the chunk `pHYs` (pixels per metre) after the header.
fn with_resolution(png: &[u8]) -> Vec<u8> {
    /// Signature (8) and the chunk `IHDR` (25).
    const HEADER: usize = 33;
    /// 300 dots per inch in dots per metre.
    const PER_METRE: u32 = 11_811;
    /// The unit code of metres.
    const METRE: u8 = 1;
    let mut body = b"pHYs".to_vec();
    body.extend(PER_METRE.to_be_bytes());
    body.extend(PER_METRE.to_be_bytes());
    body.push(METRE);
    let header = HEADER.min(png.len());
    let mut out = png[..header].to_vec();
    out.extend([0, 0, 0, 9]);
    out.extend(&body);
    out.extend(crc32(&body).to_be_bytes());
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
