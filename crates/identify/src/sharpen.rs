//! Where the linear growth of an episode ends, and one mode fitted to all samples up to there.
//!
//! Windows of 12 periods end somewhere, not where the growth does, and the last e-folding holds most of what a growing
//! oscillation tells. So the end is moved on by half periods, the mode fitted anew, until its last period holds more
//! than noise.

use std::f64::consts::TAU;

use crate::cross::Measured;
use crate::mode::Mode;
use crate::shape::Shape;

/// From this many e-foldings before the end that windows have found, the end is looked for …
const BEFORE: f64 = 1.5;
/// … to this many after it.
pub(super) const AFTER: f64 = 1.0;
/// E-foldings that are fitted: what lies before is below 1.2 % of the amplitude.
pub(super) const LENGTH: f64 = 4.5;
/// Fewest periods of a fit.
const LEAST_PERIODS: f64 = 5.0;
/// Most samples of a fit.
pub(super) const MOST: usize = 1 << 14;
/// Steps of the end per period.
const STEPS: f64 = 2.0;
/// Steps per e-folding are no more than this.
const PER_FOLD: f64 = 40.0;
/// Steps of a stride.
const STRIDE: u32 = 8;
/// Steps back from the last end that fits: what it may already hold of a stick or a kink is too little to be seen.
const BACK: usize = 1;
/// Part of the amplitude that may be left over without noise: terms of higher order, the second mode.
const MODEL: f64 = 0.004;
/// Standard deviations by which the squares of the last period may exceed their expectation.
const LARGE: f64 = 4.0;
/// The fit and the windows see the same growth within this factor …
const SAME_GROWTH: f64 = 2.0;
/// Standard errors by which the growth rate must exceed 0.
const CLEARLY: f64 = 3.0;
/// … and the same frequency within this part.
const SAME_FREQUENCY: f64 = 0.05;

/// Samples around an episode: one vector per channel, the tangential acceleration first.
pub(super) struct Span {
    pub(super) channels: Vec<Vec<f64>>,
    /// Samples per second, Hz.
    pub(super) rate: f64,
    /// The sample after the last of those in which windows saw the growth.
    pub(super) end: usize,
}

impl Span {
    /// The mode of a part of the samples.
    pub(super) fn fit(&self, part: [usize; 2], guess: Shape) -> Option<Mode> {
        Mode::fit(&self.part(part), self.rate, guess)
    }

    /// The mode of a part of the samples with this very course.
    pub(super) fn held(&self, part: [usize; 2], shape: Shape) -> Option<Mode> {
        Mode::held(&self.part(part), self.rate, shape)
    }

    fn part(&self, [start, end]: [usize; 2]) -> Vec<&[f64]> {
        self.channels.iter().map(|channel| &channel[start..end]).collect()
    }
}

/// The results of a fit to all samples of a growth.
pub(super) struct Sharpened {
    /// The exponential that fits.
    pub(super) mode: Mode,
    /// Growth rate of the linear motion, 1/s.
    pub(super) linear: Measured,
    /// The sample of the span at which the exponential ends.
    pub(super) end: usize,
}

/// The mode up to the end of its linear growth, from what windows say of growth (1/s) and frequency (Hz); `None` where
/// nothing fits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive numbers of samples")]
pub(super) fn sharpen(span: &Span, growth: f64, frequency: f64) -> Option<Sharpened> {
    let fold = span.rate / growth;
    let period = span.rate / frequency;
    let all = span.channels.first()?.len();
    let least = (LEAST_PERIODS * period).ceil() as usize;
    let longest = ((LENGTH * fold) as usize).clamp(least, MOST.max(least));
    let lowest = (span.end as f64 - BEFORE * fold).max(least as f64);
    let highest = (span.end as f64 + AFTER * fold).min(all as f64);
    // Slow growth has many periods per e-folding: the end is looked for in strides first.
    let fine = (period / STEPS).max(fold / PER_FOLD);
    let mut stride = if fine > period / STEPS { STRIDE } else { 1 };
    let mut guess = Shape::Exponential([growth, TAU * frequency]);
    let mut noise: Option<Vec<f64>> = None;
    let mut fitted = Vec::new();
    let (mut number, mut limit) = (0_u32, u32::MAX);
    loop {
        let end = lowest + f64::from(number) * fine;
        let inside = end <= highest && number < limit;
        let part = [(end as usize).saturating_sub(longest), end as usize];
        let mode = if inside { span.fit(part, guess) } else { None };
        if let Some(mode) = mode {
            // The noise is that of the first part, in which nothing has ended yet.
            let noise =
                noise.get_or_insert_with(|| mode.channels.iter().map(|channel| channel.noise).collect());
            if fits(&mode, noise, period) {
                guess = mode.shape;
                fitted.push((mode, part));
                if fitted.len() > BACK + 1 {
                    fitted.remove(0);
                }
            } else {
                limit = number;
            }
        }
        if inside && number < limit {
            number += stride;
        } else if stride > 1 && number > 0 {
            number = number - stride + 1;
            stride = 1;
        } else {
            break;
        }
    }
    let found = fitted.into_iter().next();
    let (mode, part) = found?;
    let alike = |a: f64, b: f64| (1.0 / SAME_GROWTH..SAME_GROWTH).contains(&(a / b));
    let same =
        alike(mode.growth.value, growth) && (mode.omega / (TAU * frequency) - 1.0).abs() < SAME_FREQUENCY;
    // Saturation begins before it is seen: only with it are growth rate and error those of the linear motion.
    let saturating = span.fit(part, Shape::saturating(mode.growth.value, mode.omega));
    let linear = saturating.map(|saturating| saturating.growth);
    let linear = linear.filter(|linear| alike(linear.value, mode.growth.value)).unwrap_or(mode.growth);
    let clear = linear.value > CLEARLY * linear.error;
    (same && clear).then_some(Sharpened { mode, linear, end: part[1] })
}

/// Whether the last period is as close to the mode as the noise lets it be.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of samples")]
fn fits(mode: &Mode, noise: &[f64], period: f64) -> bool {
    let last = period.ceil() as usize;
    let channels = mode.channels.iter().zip(&mode.residuals).zip(noise);
    let squares: f64 = channels
        .map(|((channel, residual), noise)| {
            let allowed = noise * noise + (MODEL * channel.amplitude.norm()).powi(2);
            residual.iter().rev().take(last).map(|r| r * r).sum::<f64>() / allowed
        })
        .sum();
    let count = (last * noise.len()) as f64;
    squares < count + LARGE * (2.0 * count).sqrt()
}
