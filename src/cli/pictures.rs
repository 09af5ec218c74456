//! A figure of a command as PNG.

use crate::cli::error::Result;
use crate::cli::talk::note;

/// The PNG of a figure of a command, with a note where its font lacks a character.
pub(super) fn png_of(svg: &str) -> Result<Vec<u8>> {
    tell_missing(svg)?;
    Ok(squealmap_figure::png::render(svg)?)
}

/// Says which characters of a figure its font lacks.
pub(super) fn tell_missing(svg: &str) -> Result<()> {
    let missing = squealmap_figure::glyphs::missing(svg)?;
    let shown: Vec<String> = missing.iter().map(|c| format!("`{c}` (U+{:04X})", u32::from(*c))).collect();
    if !shown.is_empty() {
        note(&format!(
            "the font of the figures, Liberation Sans, has no {}: boxes stand there in PNG and PDF; write the title or name \
             without it",
            shown.join(", ")
        ));
    }
    Ok(())
}
