//! Whether an oscillation grows by itself: an instability begins with an exponential, a vibration that is driven does not.

use std::f64::consts::TAU;

use crate::cross::Measured;
use crate::mode::Mode;
use crate::shape::Shape;
use crate::sharpen::{LENGTH, MOST, Span};

/// Twice the logarithm of the likelihood by which a course must exceed another one per parameter that it has more (Akaike
/// 1974).
const PER_PARAMETER: f64 = 2.0;
/// A power of time with an exponent above the inverse of this is an exponential whose rate drifts.
const CURVED: f64 = 0.1;
/// From this many e-foldings before its end on back, a growth is looked at by itself.
const BEFORE: f64 = 1.5;
/// Up to there an instability grows at the rate of its end, less what saturation takes, within this part …
const DRIFT: f64 = 0.1;
/// … at one frequency within this part …
const MOVED: f64 = 0.003;
/// … unless twice the logarithm of the likelihood of others is larger by less than this: noise alone may reach 10 here.
const CLEAR: f64 = 20.0;

/// The results from all samples in which windows saw growth.
pub(super) struct Course {
    /// Why it is none; `None` where it is an exponential that may saturate.
    pub(super) driven: Option<&'static str>,
    /// Growth rate of the linear motion with which it began, 1/s, where saturation fits.
    pub(super) growth: Option<Measured>,
}

/// The course, up to the sample `end`, of what windows took for growth (1/s) at a frequency (Hz).
pub(super) fn course(span: &Span, end: usize, growth: f64, frequency: f64) -> Course {
    const POWER: &str = "its amplitude does not rise exponentially from the beginning, as that of an instability, but with a power \
         of time, as that of a vibration that is driven; record what drives it";
    const CHANGES: &str = "its growth rate or its frequency is not the same from the beginning on, as those of an instability: it is \
         driven, or its conditions change; record what drives it";
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
    let power = span
        .fit(part, Shape::Power([rate, omega, 0.0]))
        .filter(|mode| matches!(mode.shape, Shape::Power([.., kappa]) if kappa.abs() > CURVED));
    // Driven, unless an instability is as likely.
    let driven = power.filter(|power| {
        let more = |by: &Mode| by.shape.parameters().len() as f64 - power.shape.parameters().len() as f64;
        let beaten = |by: &Mode| by.likelier_than(power) > PER_PARAMETER * more(by);
        !saturating.iter().chain(&exponential).any(beaten)
    });
    let changes = || changes(span, part, saturating.as_ref().or(exponential.as_ref())).then_some(CHANGES);
    let driven = driven.map(|_| POWER).or_else(changes);
    Course { driven, growth: saturating.map(|saturating| saturating.growth) }
}

/// Whether growth rate or frequency were others well before the end than the mode says, which is fitted to it.
fn changes(span: &Span, part: [usize; 2], mode: Option<&Mode>) -> bool {
    let Some(mode) = mode else { return false };
    let fold = span.rate / mode.growth.value;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive numbers of samples"
    )]
    let [before, longest] = [BEFORE, LENGTH].map(|folds| (folds * fold).min(MOST as f64) as usize);
    let end = part[1] - before.min(part[1] / 2);
    let early = [end.saturating_sub(longest), end];
    let ahead = (end as f64 - part[1] as f64) / span.rate;
    let same = mode.shape.seen_from(ahead);
    let exponential = span.fit(early, Shape::Exponential([mode.growth.value, mode.omega]));
    let [growth, omega] =
        exponential.as_ref().map_or([mode.growth.value, mode.omega], |mode| [mode.growth.value, mode.omega]);
    let others = [Shape::Power([growth, omega, 0.0]), Shape::saturating(growth, omega)];
    let mut free = others.into_iter().filter_map(|guess| span.fit(early, guess)).chain(exponential);
    let Some(same) = span.held(early, same) else { return false };
    let differ = |a: f64, b: f64, allowed: f64| (a - b).abs() > allowed * b;
    // The middle of the last e-folding weighs most.
    let rate = |of: &Mode, at: f64| of.shape.rate(at - 0.5 / mode.growth.value);
    let is = rate(mode, ahead);
    free.any(|free| {
        let moved = differ(rate(&free, 0.0), is, DRIFT) || differ(free.omega, mode.omega, MOVED);
        moved && free.likelier_than(&same) > CLEAR
    })
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
