//! Inputs of the linear kernel, its results on CPU and GPU, and the comparers.

use std::sync::atomic::AtomicBool;

use crate::instances::random;
use libtest_mimic::Failed;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::arithmetic::Arithmetic;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::{ChunkResult, Drive, check, run};
use squealmap::engine::kernel::linear::{Analysed, KERNEL, analyse};
use squealmap::engine::kernel::places::{filled, place};
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::source::SETTING_WORDS;
use squealmap::engine::kernel::words::{FLAG_WORDS, INPUT_WORDS, STATE_WORDS, Words};
use squealmap::model::linear::prepare;

static NEVER: AtomicBool = AtomicBool::new(false);

/// How the tests drive a kernel.
pub(crate) fn drive() -> Drive<'static> {
    Drive { offset: 0, settings: [0; SETTING_WORDS], most_dispatches: 4, cancel: &NEVER, progress: &|_| {} }
}

/// The best adapter's device.
pub(crate) fn device(arithmetic: impl Into<Arithmetic>) -> Result<Device, Failed> {
    let arithmetic = arithmetic.into();
    Ok(Device::open(&Adapter::best(arithmetic, None)?, arithmetic)?)
}

/// The inputs of random instances that need the kernel.
pub(crate) fn inputs<R: Real>(count: usize) -> Vec<R> {
    let live: Vec<[R; INPUT_WORDS]> = random(2 * count)
        .iter()
        .filter_map(|one| prepare(one).ok())
        .take(count)
        .map(|one| Words::new(&one).inputs.map(R::from_f64))
        .collect();
    assert_eq!(live.len(), count);
    of_rows(&live)
}

/// Rows as a buffer.
fn of_rows<T: bytemuck::Pod + Send + Sync, const N: usize>(rows: &[[T; N]]) -> Vec<T> {
    filled(N, rows.len(), |index| &rows[index][..])
}

/// The twin over the inputs of so many instances.
pub(crate) fn on_cpu<R: Real>(inputs: &[R], count: usize) -> ChunkResult<R> {
    let one = |instance: usize| analyse(&|word| inputs[place([word, INPUT_WORDS], instance)]);
    let (state, flags): (Vec<_>, Vec<_>) =
        (0..count).map(one).map(|Analysed { state, flags }| (state, flags)).unzip();
    ChunkResult { state: of_rows(&state), flags: of_rows(&flags), cancelled: false }
}

/// The kernel over the inputs of so many instances.
pub(crate) fn on_gpu<R: Real>(inputs: &[R], count: usize) -> Result<ChunkResult<R>, Failed> {
    let device = device(R::PRECISION)?;
    let compiled = Compiled::new(&device, &KERNEL, &[])?;
    Ok(run(&device, &compiled, (inputs, count), &drive())?)
}

/// Compares two results of the linear kernel word by word.
///
/// A number may differ by `tolerance` times its own size or 1, the size of what it was made from; flags may
/// differ in at most `flags` instances. A NaN, a short buffer or an unwritten instance is always an error.
pub(crate) fn compare<R: Real>(
    actual: &ChunkResult<R>,
    expected: &ChunkResult<R>,
    count: usize,
    tolerance: f64,
    most_flags: usize,
) -> Result<f64, Failed> {
    let sizes = [INPUT_WORDS, STATE_WORDS, FLAG_WORDS];
    check(expected, count, sizes)?;
    check(actual, count, sizes)?;
    let mut worst = 0.0_f64;
    for (index, (a, b)) in actual.state.iter().zip(&expected.state).enumerate() {
        let (a, b) = (a.to_f64(), b.to_f64());
        let difference = (a - b).abs() / b.abs().max(1.0);
        if difference.is_nan() || difference > tolerance {
            return Err(format!("word {index}: {a:e} instead of {b:e}, off by {difference:.1e}").into());
        }
        worst = worst.max(difference);
    }
    let differing = actual.flags.iter().zip(&expected.flags).filter(|(a, b)| a != b).count();
    if differing > most_flags {
        return Err(format!("{differing} flags differ, at most {most_flags} may").into());
    }
    Ok(worst)
}

/// Numbers whose bits differ.
pub(crate) fn differing<R: Real>(actual: &ChunkResult<R>, expected: &ChunkResult<R>) -> usize {
    let bits = |one: &R| one.to_f64().to_bits();
    actual.state.iter().zip(&expected.state).filter(|(a, b)| bits(a) != bits(b)).count()
}
