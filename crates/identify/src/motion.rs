//! Motion from acceleration, without the drift that offsets and noise leave in an integral.

/// Six points around each step: with seven samples per period a trapezoid is 7 % off.
const STEP: [f64; 6] = [11.0, -93.0, 802.0, 802.0, -93.0, 11.0];

/// The integral of values `step` (s) apart, from 0 on; a trapezoid where there are no six points around a step.
pub(super) fn integral(values: &[f64], step: f64, into: &mut Vec<f64>) {
    into.clear();
    let mut sum = 0.0;
    for k in 0..values.len() {
        sum += match k {
            0 => 0.0,
            k if k >= 3 && k + 2 < values.len() => {
                STEP.iter().zip(&values[k - 3..]).map(|(weight, value)| weight * value).sum::<f64>() / 1440.0
            }
            k => 0.5 * (values[k - 1] + values[k]),
        } * step;
        into.push(sum);
    }
}

/// The whole number of samples next to a period.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of samples")]
pub(super) fn period(samples: f64) -> usize {
    samples.round().max(1.0) as usize
}

/// Samples at both ends that [`drift`] continues with a straight line.
pub(super) fn reach(period: usize) -> usize {
    3 * period.div_ceil(2)
}

/// What is slower than an oscillation of `period` samples: the mean over a period, three times, which holds nothing of it and
/// of its harmonics, and keeps a straight line. Of an oscillation of half the frequency it holds a quarter.
pub(super) fn drift(values: &[f64], period: usize) -> Vec<f64> {
    let (count, ends) = (values.len(), reach(period));
    if count < 2 * ends + period + 1 {
        let mean = values.iter().sum::<f64>() / count.max(1) as f64;
        return vec![mean; count];
    }
    let mut slow = values.to_vec();
    for _ in 0..3 {
        slow = mean(&slow, period);
    }
    let [first, last] = [ends, count - 1 - ends];
    let slope = |from: usize, to: usize| (slow[to] - slow[from]) / period as f64;
    let [rise, fall] = [slope(first, first + period), slope(last - period, last)];
    let [start, end] = [slow[first], slow[last]];
    for k in 0..ends {
        let off = (ends - k) as f64;
        slow[k] = start - rise * off;
        slow[count - 1 - k] = end + fall * off;
    }
    slow
}

/// The mean over a period around each value, as far as there are values; where a period has an even number of samples the two at
/// its ends count half.
fn mean(values: &[f64], period: usize) -> Vec<f64> {
    let half = period / 2;
    let edge = if period.is_multiple_of(2) { 0.5 } else { 1.0 };
    let mut sums = vec![0.0; values.len() + 1];
    for (k, value) in values.iter().enumerate() {
        sums[k + 1] = sums[k] + value;
    }
    let around = |k: usize| {
        let (from, to) = (k - half, k + half);
        (sums[to] - sums[from + 1] + edge * (values[from] + values[to])) / period as f64
    };
    (0..values.len())
        .map(|k| if k < half || k + half >= values.len() { values[k] } else { around(k) })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Twice the integral of `cos ωt` under an offset, with noise of none, is `−cos ωt/ω²`: to the ends, for any number of samples
    /// per period.
    #[test]
    fn the_second_integral_of_an_oscillation_is_the_oscillation() {
        for per_period in [7.05, 12.0, 14.9, 27.3] {
            let (step, omega) = (1e-5, TAU / (per_period * 1e-5));
            let period = period(per_period);
            let acceleration: Vec<f64> =
                (0..2000).map(|k| 9.81 + omega * omega * (omega * step * f64::from(k)).cos()).collect();
            let mut values = acceleration;
            for _ in 0..2 {
                let mut sum = Vec::new();
                integral(&values, step, &mut sum);
                values = drift(&sum, period);
                values = sum.iter().zip(&values).map(|(sum, slow)| sum - slow).collect();
            }
            for (k, value) in values.iter().enumerate() {
                let expected = -(omega * step * k as f64).cos();
                let ends = if (40..1960).contains(&k) { 0.01 } else { 0.1 };
                assert!((value - expected).abs() < ends, "{per_period}: {k}: {value} {expected}");
            }
        }
    }
}
