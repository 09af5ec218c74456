//! The colours of a number over the panels: by lightness, by sign, around a circle, or by name.

use crate::results::figure::fills::FAILED_FILL;
use squealmap_figure::scale::{Scale, ZERO};
use squealmap_figure::{cyclic, raster};

/// Steps of lightness: more than the eye tells apart, few enough for small files.
const STEPS: usize = 48;
/// Below 0, from the lowest value to 0: lighter than what is above.
const BELOW: [[f32; 3]; 2] = [[255.0, 250.0, 235.0], [243.0, 214.0, 145.0]];
/// How light what is just above 0 is, of the colours of [`Tones::Lightness`].
const ABOVE: f32 = 0.25;
/// The first step that is not below 0.
const FIRST_ABOVE: usize = 18;
const _: () = assert!((FIRST_ABOVE as f64 - ZERO * STEPS as f64).abs() < 1e-9, "a step begins at 0");

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tones<'a> {
    /// The larger the darker.
    Lightness,
    /// The larger the darker, in one hue below 0 and in another above.
    Sign,
    /// Angles around a circle.
    Circle,
    /// Names and their fills.
    Named(&'a [(&'a str, &'a str)]),
}

impl Tones<'_> {
    /// The number of steps.
    pub(super) fn steps(self) -> usize {
        match self {
            Tones::Lightness | Tones::Sign => STEPS,
            Tones::Circle => cyclic::STEPS,
            Tones::Named(names) => names.len(),
        }
    }

    /// The fill of a step.
    pub(super) fn fill(self, step: usize) -> String {
        match self {
            Tones::Lightness => raster::fill(step as f32 / (STEPS - 1) as f32),
            Tones::Sign if step < FIRST_ABOVE => {
                let part = step as f32 / (FIRST_ABOVE - 1) as f32;
                raster::between(BELOW, part)
            }
            Tones::Sign => {
                let part = (step - FIRST_ABOVE) as f32 / (STEPS - 1 - FIRST_ABOVE) as f32;
                raster::fill(ABOVE + (1.0 - ABOVE) * part)
            }
            Tones::Circle => cyclic::fill(step).to_owned(),
            Tones::Named(names) => names.get(step).map_or(FAILED_FILL, |(_, fill)| fill).to_owned(),
        }
    }

    /// The step of a value on a scale.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the steps")]
    pub(super) fn step(self, value: f64, scale: &Scale) -> usize {
        match self {
            Tones::Lightness | Tones::Sign => {
                (scale.position(value) * STEPS as f64).clamp(0.0, (STEPS - 1) as f64) as usize
            }
            Tones::Circle => cyclic::step(value),
            Tones::Named(_) => value.max(0.0) as usize,
        }
    }

    /// Whether dots on a step have to be white.
    pub(super) fn is_dark(self, step: usize) -> bool {
        match self {
            Tones::Lightness => 2 * step > STEPS,
            Tones::Sign => step > STEPS / 2 + STEPS / 8,
            // Light around the middle, dark around both ends.
            Tones::Circle => !(STEPS / 4..3 * STEPS / 4).contains(&step),
            Tones::Named(_) => false,
        }
    }
}
