//! Whether an oscillation grows by itself: an instability begins with an exponential, a vibration that is driven does not.

use std::f64::consts::TAU;

use super::cross::Measured;
use super::mode::Mode;
use super::shape::Shape;
use super::sharpen::{LENGTH, MOST, Span};

/// Twice the logarithm of the likelihood by which a course must exceed another one per parameter that it has more (Akaike
/// 1974).
const PER_PARAMETER: f64 = 2.0;
/// A bell whose growth rate falls less than to this part over the samples is an exponential whose rate drifts.
const FALLS: f64 = 0.5;

/// What the samples in which windows saw growth tell as a whole.
pub(super) struct Course {
    /// Why it is none; `None` where it is an exponential that may saturate.
    pub(super) driven: Option<&'static str>,
    /// Growth rate of the linear motion with which it began, 1/s, where saturation fits.
    pub(super) growth: Option<Measured>,
}

/// The course, up to the sample `end`, of what windows took for growth (1/s) at a frequency (Hz).
pub(super) fn course(span: &Span, end: usize, growth: f64, frequency: f64) -> Course {
    /// Exponents of time, and words.
    const POWERS: [(f64, &str); 2] = [
        (
            1.0,
            "its amplitude rises in proportion to time, as that of a vibration that is driven, and not exponentially from the \
             beginning, as that of an instability; record what drives it",
        ),
        (
            2.0,
            "its amplitude rises with the square of time, as that of a vibration that is driven, and not exponentially from \
             the beginning, as that of an instability; record what drives it",
        ),
    ];
    const BELL: &str = "its growth rate falls from the beginning on, as that of a vibration that is driven through a resonance, \
         and not at the end only, as that of an instability that saturates; record what drives it";
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive numbers of samples"
    )]
    let longest = (LENGTH * span.rate / growth).min(MOST as f64) as usize;
    let end = end.min(span.channels.first().map_or(0, Vec::len));
    let part = [end.saturating_sub(longest), end];
    let omega = refined(span, end, growth, TAU * frequency);
    let exponential = span.fit(part, Shape::Exponential([growth, omega]));
    let [rate, omega] = exponential.as_ref().map_or([growth, omega], |mode| [mode.growth.value, mode.omega]);
    let saturating = span.fit(part, Shape::saturating(rate, omega));
    let powers = POWERS.into_iter().filter_map(|(exponent, words)| {
        let mode = span.fit(part, Shape::Power([omega, exponent / rate], exponent))?;
        Some((mode, words))
    });
    let bell = span.fit(part, Shape::Bell([rate, omega, 0.0])).filter(|mode| {
        let length = (part[1] - part[0]) as f64 / span.rate;
        matches!(mode.shape, Shape::Bell([end, _, narrow]) if end < FALLS * (end + narrow * length))
    });
    let rivals = powers.chain(bell.map(|mode| (mode, BELL)));
    let driven = rivals
        .max_by(|(a, _), (b, _)| a.likelier_than(b).total_cmp(&0.0))
        .filter(|(rival, _)| {
            let more = |by: &Mode| by.shape.parameters().len() as f64 - rival.shape.parameters().len() as f64;
            let beaten = |by: &Mode| by.likelier_than(rival) > PER_PARAMETER * more(by);
            !saturating.iter().chain(&exponential).any(beaten)
        })
        .map(|(_, words)| words);
    Course { driven, growth: saturating.map(|saturating| saturating.growth) }
}

/// An angular frequency (rad/s) that stays in step with all samples before `end`, from parts that double in length.
fn refined(span: &Span, end: usize, growth: f64, omega: f64) -> f64 {
    /// Periods of the first part.
    const FIRST: f64 = 10.0;
    /// The frequency stays within this part of what windows say.
    const SAME: f64 = 0.05;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number of samples"
    )]
    let first = (FIRST * TAU * span.rate / omega) as usize;
    let lengths = std::iter::successors(Some(first), |length| Some(2 * length))
        .take_while(|length| *length < end.min(MOST));
    lengths.fold(omega, |so_far, length| {
        let mode = span.fit([end - length, end], Shape::Exponential([growth, so_far]));
        mode.map(|mode| mode.omega).filter(|found| (found / omega - 1.0).abs() < SAME).unwrap_or(so_far)
    })
}
