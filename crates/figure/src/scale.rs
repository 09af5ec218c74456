//! From values to positions on an axis, and the ticks of an axis.

use crate::text::Text;

/// A scale: which value stands at which position on an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Proportional between two ends.
    Linear {
        /// Value at position 0.
        low: f64,
        /// Value at position 1.
        high: f64,
    },
    /// Proportional in the logarithm between two positive ends.
    Log {
        /// Value at position 0.
        low: f64,
        /// Value at position 1.
        high: f64,
    },
    /// Proportional from a negative end to 0, and separately from 0 to a positive end. So small values on one side are seen
    /// beside large ones on the other.
    Signed {
        /// Value at position 0.
        low: f64,
        /// Value at position 1.
        high: f64,
    },
    /// Names in equal steps.
    Names(Vec<String>),
}

/// The position of 0 on a signed scale.
pub const ZERO: f64 = 0.375;

/// One tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Position, 0 to 1.
    pub at: f64,
    /// The label beside it.
    pub label: Text,
}

impl Scale {
    /// A linear scale over the finite values, never of zero length.
    #[must_use]
    pub fn spanning(values: impl IntoIterator<Item = f64>) -> Scale {
        let finite = values.into_iter().filter(|x| x.is_finite());
        let (low, high) = finite.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        match low.partial_cmp(&high) {
            Some(std::cmp::Ordering::Less) => Scale::Linear { low, high },
            Some(std::cmp::Ordering::Equal) => {
                let half = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
                Scale::Linear { low: low - half, high: high + half }
            }
            _ => Scale::Linear { low: 0.0, high: 1.0 },
        }
    }

    /// This scale with a margin at both ends, as a fraction of its length.
    #[must_use]
    pub fn widened(self, fraction: f64) -> Scale {
        match self {
            Scale::Linear { low, high } => {
                let margin = fraction * (high - low);
                Scale::Linear { low: low - margin, high: high + margin }
            }
            Scale::Log { low, high } => {
                let factor = (high / low).powf(fraction);
                Scale::Log { low: low / factor, high: high * factor }
            }
            Scale::Signed { low, high } => {
                Scale::Signed { low: low * (1.0 + fraction), high: high * (1.0 + fraction) }
            }
            Scale::Names(names) => Scale::Names(names),
        }
    }

    /// The position of a value, 0 to 1 inside the scale; the value of a name is its index.
    #[must_use]
    pub fn position(&self, value: f64) -> f64 {
        match self {
            Scale::Linear { low, high } => (value - low) / (high - low),
            Scale::Log { low, high } => (value / low).ln() / (high / low).ln(),
            Scale::Signed { low, .. } if value < 0.0 => ZERO * (1.0 - value / low),
            Scale::Signed { high, .. } => ZERO + (1.0 - ZERO) * value / high,
            Scale::Names(names) => (value + 0.5) / names.len() as f64,
        }
    }

    /// The value at a position: the inverse of [`Scale::position`].
    #[must_use]
    pub fn value(&self, position: f64) -> f64 {
        match self {
            Scale::Linear { low, high } => low + (high - low) * position,
            Scale::Log { low, high } => low * (high / low).powf(position),
            Scale::Signed { low, .. } if position < ZERO => low * (1.0 - position / ZERO),
            Scale::Signed { high, .. } => high * (position - ZERO) / (1.0 - ZERO),
            Scale::Names(names) => position * names.len() as f64 - 0.5,
        }
    }

    /// The decimal exponent taken out of the tick labels: not 0 only for very large or small values.
    #[must_use]
    pub fn exponent(&self) -> i32 {
        /// Largest magnitudes written out in full.
        const PLAIN: std::ops::Range<f64> = 1e-2..1e4;
        let (Scale::Linear { low, high } | Scale::Signed { low, high }) = self else { return 0 };
        let largest = low.abs().max(high.abs());
        if PLAIN.contains(&largest) { 0 } else { decade(largest) }
    }

    /// Ticks at round values, at most about `most`; names all get one.
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self {
            Scale::Linear { low, high } => {
                let unit = 10_f64.powi(self.exponent());
                linear_ticks(low / unit, high / unit, most)
                    .into_iter()
                    .map(|(value, label)| Tick { at: snapped(self.position(value * unit)), label })
                    .collect()
            }
            Scale::Log { low, high } => self.log_ticks(*low, *high, most),
            Scale::Signed { low, high } => self.signed_ticks(*low, *high, most),
            Scale::Names(names) => names
                .iter()
                .enumerate()
                .map(|(i, name)| Tick { at: self.position(i as f64), label: Text::from(name.as_str()) })
                .collect(),
        }
    }

    /// Ticks of both sides, the lowest of the negative one and 0 in any case.
    fn signed_ticks(&self, low: f64, high: f64, most: usize) -> Vec<Tick> {
        /// From so many on the negative side has a second tick.
        const MANY: usize = 6;
        let unit = 10_f64.powi(self.exponent());
        let tick = |(value, label): (f64, Text)| Tick { at: snapped(self.position(value * unit)), label };
        let negative = linear_ticks(low / unit, 0.0, 2).into_iter().filter(|(value, _)| *value < 0.0);
        let negative = negative.take(if most < MANY { 1 } else { 2 });
        let positive = linear_ticks(0.0, high / unit, most.saturating_sub(2));
        // Of the other side they may be parts of a unit.
        negative.map(|(value, _)| (value, value_label(value))).chain(positive).map(tick).collect()
    }

    fn log_ticks(&self, low: f64, high: f64, most: usize) -> Vec<Tick> {
        /// Mantissas of ticks, from few to many.
        const MANTISSAS: [&[f64]; 3] = [&[1.0], &[1.0, 3.0], &[1.0, 2.0, 5.0]];
        /// Powers of ten written out as plain numbers.
        const PLAIN_POWERS: std::ops::RangeInclusive<i32> = -3..=4;
        /// Fewer ticks do not show a scale.
        const FEWEST: usize = 3;
        let decades = decade(low)..=decade(high);
        let inside = |value: f64| (0.0..=1.0).contains(&snapped(self.position(value)));
        let at = |mantissas: &[f64]| -> Vec<(f64, i32)> {
            let all = decades.clone().flat_map(|d| mantissas.iter().map(move |m| (*m, d)));
            all.filter(|(m, d)| inside(m * 10_f64.powi(*d))).collect()
        };
        let mut ticks = at(MANTISSAS[0]);
        for mantissas in &MANTISSAS[1..] {
            let more = at(mantissas);
            if ticks.len() < FEWEST && more.len() <= most.max(FEWEST) {
                ticks = more;
            }
        }
        if ticks.len() < 2 {
            return linear_ticks(low, high, most)
                .into_iter()
                .filter(|(value, _)| *value > 0.0)
                .map(|(value, label)| Tick { at: snapped(self.position(value)), label })
                .collect();
        }
        let stride = ticks.len().div_ceil(most.max(2));
        let plain = ticks.iter().all(|(_, exponent)| PLAIN_POWERS.contains(exponent));
        let tick = |(mantissa, exponent): (f64, i32)| {
            let value = mantissa * 10_f64.powi(exponent);
            let label = if plain { value_label(value) } else { power_label(mantissa, exponent) };
            Tick { at: snapped(self.position(value)), label }
        };
        ticks.into_iter().step_by(stride).map(tick).collect()
    }
}

/// ` (10³ m/s²)`: the unit of an axis and the power of ten taken out of its labels.
#[must_use]
pub fn axis_unit(unit: &str, exponent: i32) -> Text {
    if unit.is_empty() && exponent == 0 {
        return Text::default();
    }
    let text = Text::from(" (");
    let text = match exponent {
        0 => text,
        _ => text.plain("10").superscript(&minus(&exponent.to_string())),
    };
    let text = if exponent == 0 || unit.is_empty() { text } else { text.plain(" ") };
    text.unit(unit).plain(")")
}

/// A number as figures print it: shortest form, a real minus sign, powers of ten for very large or small ones.
#[must_use]
pub fn value_label(value: f64) -> Text {
    /// Magnitudes written without an exponent.
    const PLAIN: std::ops::Range<f64> = 1e-4..1e6;
    /// Digits that tell apart any two values a person would choose.
    const DIGITS: usize = 5;
    if value == 0.0 {
        return Text::from("0");
    }
    let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
    if PLAIN.contains(&rounded.abs()) {
        return Text::from(minus(&rounded.to_string()));
    }
    let exponent = decade(rounded.abs());
    power_label(rounded / 10_f64.powi(exponent), exponent)
}

fn power_label(mantissa: f64, exponent: i32) -> Text {
    /// Mantissas this close to 1 are 1: rounding of a division.
    const ONE: f64 = 1e-6;
    let power = minus(&exponent.to_string());
    let text = if (mantissa - 1.0).abs() < ONE {
        Text::default()
    } else {
        Text::from(minus(&format!("{}", (mantissa * 1e5).round() / 1e5))).plain("·")
    };
    text.plain("10").superscript(&power)
}

/// Values and labels at multiples of 1, 2 or 5 times a power of ten between two ends.
fn linear_ticks(low: f64, high: f64, most: usize) -> Vec<(f64, Text)> {
    /// A tick this fraction of a step beyond an end still belongs to it: rounding of the ends.
    const SLACK: f64 = 1e-9;
    /// A step this much shorter than asked for is welcome: half-cell margins make lengths odd.
    const GENEROUS: f64 = 0.85;
    let raw = (high - low) / most.max(2) as f64;
    if !raw.is_finite() || raw <= 0.0 {
        return Vec::new();
    }
    let power = 10_f64.powi(decade(GENEROUS * raw));
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| f * power >= GENEROUS * raw).unwrap_or(10.0);
    let step = factor * power;
    let decimals = usize::try_from(-decade(step)).unwrap_or(0);
    let mut k = (low / step - SLACK).ceil();
    let mut ticks = Vec::new();
    while k <= high / step + SLACK && ticks.len() <= most + 2 {
        let value = k * step;
        let text = format!("{value:.decimals$}");
        let text = if k == 0.0 { "0".to_owned() } else { minus(&text) };
        ticks.push((value, Text::from(text)));
        k += 1.0;
    }
    ticks
}

/// A position that is beyond an end by rounding only is that end: no frame leaves its tick out.
#[must_use]
pub fn snapped(at: f64) -> f64 {
    /// More than rounding, and far less than a printer resolves.
    const ROUNDING: f64 = 1e-9;
    let end = at.clamp(0.0, 1.0);
    if (at - end).abs() < ROUNDING { end } else { at }
}

/// The decimal exponent of a positive number.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is within ±324")]
fn decade(x: f64) -> i32 {
    if x > 0.0 && x.is_finite() { (x.log10() + 1e-12).floor() as i32 } else { 0 }
}

fn minus(text: &str) -> String {
    text.replace('-', "−")
}
