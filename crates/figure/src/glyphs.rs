//! What the embedded font knows of characters: how wide they are, and which ones it does not have. In PNG and PDF a box
//! stands in the place of such a character.

use ttf_parser::Face;

use crate::error::{Error, Result};
use crate::png::{BOLD, FONTS, REGULAR};

/// The width of upright words at a size, in the unit of the size; what has no glyph is as wide as high.
#[must_use]
pub fn width(words: &str, size: f64, bold: bool) -> f64 {
    let Ok(face) = Face::parse(if bold { BOLD } else { REGULAR }, 0) else { return f64::INFINITY };
    let advance = |letter: char| {
        let units = face.glyph_index(letter).and_then(|glyph| face.glyph_hor_advance(glyph));
        units.map_or(1.0, |units| f64::from(units) / f64::from(face.units_per_em()))
    };
    words.chars().map(advance).sum::<f64>() * size
}

/// The characters without a glyph in the words of an SVG document of this program, each once, in the order in which they
/// come.
///
/// # Errors
/// When the embedded fonts cannot be read.
pub fn missing(svg: &str) -> Result<Vec<char>> {
    let faces: std::result::Result<Vec<Face<'_>>, _> =
        FONTS.iter().map(|font| Face::parse(font, 0)).collect();
    let faces = faces.map_err(|why| Error::Pdf { why: why.to_string() })?;
    let mut found = Vec::new();
    for line in svg.lines().filter(|line| line.starts_with("<text")) {
        // Words stand outside of tags.
        let words = line.split('>').filter_map(|part| part.split('<').next());
        for letter in words.flat_map(str::chars) {
            let lacking = faces.iter().any(|face| face.glyph_index(letter).is_none());
            if lacking && !found.contains(&letter) {
                found.push(letter);
            }
        }
    }
    Ok(found)
}
