//! Pictures inside a figure: values in 0..1 as a PNG in a data URI.

use base64::Engine as _;
use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};

use crate::error::{Error, Result};

/// Colours from 0 to 1 at even steps: white to near black through blue, ever darker, so that it survives a grey print.
const COLOURS: [[f32; 3]; 5] = [
    [255.0, 255.0, 255.0],
    [176.0, 214.0, 232.0],
    [84.0, 148.0, 196.0],
    [31.0, 63.0, 143.0],
    [10.0, 14.0, 44.0],
];

/// A fill on the way from one colour to another.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two of 0..255")]
#[must_use]
pub fn between([from, to]: [[f32; 3]; 2], part: f32) -> String {
    let [r, g, b]: [u8; 3] = std::array::from_fn(|k| (from[k] + (to[k] - from[k]) * part).round() as u8);
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// The colour of a value; values outside 0..1 take the nearest end, NaN the lower one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the steps and to 0..255"
)]
#[must_use]
pub fn colour(value: f32) -> [u8; 3] {
    let steps = (COLOURS.len() - 1) as f32;
    let at = if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) * steps };
    let lower = (at as usize).min(COLOURS.len() - 2);
    let part = at - lower as f32;
    std::array::from_fn(|k| {
        let (a, b) = (COLOURS[lower][k], COLOURS[lower + 1][k]);
        (a + (b - a) * part).round() as u8
    })
}

/// The colour of a value as the fill of a vector drawing, `#RRGGBB`.
#[must_use]
pub fn fill(value: f32) -> String {
    let [r, g, b] = colour(value);
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// A data URI of a picture of `columns` × `rows` values, column by column, the lowest row first.
///
/// # Errors
/// When the picture is empty or too large.
pub fn data_uri(columns: usize, rows: usize, value: impl Fn(usize) -> f32) -> Result<String> {
    let [width, height] = [columns, rows].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
    let refused = || Error::Rasterize { width, height };
    let mut pixmap = Pixmap::new(width, height).ok_or_else(refused)?;
    for (index, pixel) in pixmap.pixels_mut().iter_mut().enumerate() {
        let (row, column) = (rows - 1 - index / columns, index % columns);
        let [r, g, b] = colour(value(column * rows + row));
        *pixel = PremultipliedColorU8::from_rgba(r, g, b, u8::MAX).ok_or_else(refused)?;
    }
    let png = pixmap.encode_png().map_err(|_| refused())?;
    Ok(format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png)))
}
