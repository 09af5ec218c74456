//! Numbers on the command line.

pub(crate) fn finite(text: &str) -> std::result::Result<f64, String> {
    number(text, |_| true, "a finite number")
}

pub(crate) fn positive(text: &str) -> std::result::Result<f64, String> {
    number(text, |x| x > 0.0, "a finite number greater than 0")
}

pub(crate) fn number(
    text: &str,
    legal: impl Fn(f64) -> bool,
    words: &str,
) -> std::result::Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("must be {words}"))?;
    if value.is_finite() && legal(value) { Ok(value) } else { Err(format!("must be {words}")) }
}

/// A number of instances.
pub(crate) fn at_least_one(text: &str) -> std::result::Result<usize, String> {
    match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err("must be a whole number from 1 on".to_owned()),
    }
}

/// Samples per second, which may be written as 4e5.
pub(crate) fn rate(text: &str) -> std::result::Result<u32, String> {
    let most = f64::from(u32::MAX);
    let words = format!("a whole number of samples per second from 1 to {most}");
    let value = number(text, |rate| (1.0..=most).contains(&rate) && rate.fract() == 0.0, &words)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and in range")]
    Ok(value as u32)
}

/// The number of an instance.
pub(crate) fn index(text: &str) -> std::result::Result<usize, String> {
    text.parse().map_err(|_| "must be a whole number from 0 on, as map.csv has it".to_owned())
}
