//! What a run measures.

use crate::engine::Engine;
use clap::Parser;
use squealmap::engine::precision::Precision;

/// Measures maps of growing size on every engine: speed, share of the FMA peak, error; prints Markdown and keeps
/// the rows under `benches/results/`.
#[derive(Clone, Debug, Parser)]
pub(crate) struct Options {
    /// Instances of the maps, rounded to 4 times a square; 1e7 is the largest that was tried.
    #[arg(long, value_delimiter = ',', default_value = "1e3,1e4,1e5", value_parser = size)]
    pub(crate) sizes: Vec<usize>,
    /// Steps per period `2π/ω0` of the engine in vector registers and of its scalar counterpart.
    #[arg(long, value_delimiter = ',', default_value = "4,5,8,12")]
    pub(crate) steps: Vec<u32>,
    /// Scalars of the engine in vector registers and of the kernel.
    #[arg(long, value_delimiter = ',', default_value = "f32,f64", value_parser = scalar)]
    pub(crate) scalars: Vec<Precision>,
    /// Rounds; every case runs once in each, the best counts.
    #[arg(long, default_value_t = 3)]
    pub(crate) rounds: usize,
    /// Engines; without the scalar codes their ratios stay empty, without an adapter there is no `gpu`.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "reference,scalar,simd,gpu")]
    pub(crate) engines: Vec<Engine>,
    /// Only prints: keeps nothing.
    #[arg(long)]
    pub(crate) dry: bool,
    /// What cargo passes to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

/// A size as `1000` or `1e3`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn size(text: &str) -> Result<usize, String> {
    match text.parse::<f64>() {
        Ok(number) if (4.0..=1e9).contains(&number) => Ok(number as usize),
        _ => Err(format!("`{text}` is no number of instances between 4 and 1e9")),
    }
}

fn scalar(text: &str) -> Result<Precision, String> {
    let known = [Precision::F32, Precision::F64];
    known
        .into_iter()
        .find(|scalar| scalar.to_string() == text)
        .ok_or_else(|| format!("`{text}` is neither f32 nor f64"))
}
