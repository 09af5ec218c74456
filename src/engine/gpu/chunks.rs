//! A whole sweep chunk by chunk; a lost device is opened again once, with half the work.

use std::num::NonZero;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

use crate::engine::error::{Error, Result};
use crate::engine::fields::words;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::kernel::Compiled;
use crate::engine::gpu::run::{ChunkResult, Drive, resume};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{Constant, Kernel, WORKGROUP_SIZE};

/// Most bytes of a chunk's inputs and results, however large an adapter's buffers are. With everything that is made from
/// them this is about 1 GiB on the host.
pub const MOST_BYTES: usize = 256 << 20;

/// Most instances of one chunk on a software adapter. Its lanes advance together and come to their ends
/// together: in one chunk of a whole sweep nothing would be finished for a run that is stopped to keep. Eight
/// workgroups for each core cost no time against such a chunk (four cost 5 %, two a quarter).
#[must_use]
pub fn software_chunk() -> usize {
    8 * WORKGROUP_SIZE as usize * available_parallelism().map_or(1, NonZero::get)
}

/// Constants that a scene selects.
pub type Choices = Vec<(&'static str, Constant)>;

/// Instances of one chunk that share a kernel.
#[derive(Debug)]
pub struct Batch<R, T> {
    /// The kernel.
    pub kernel: Kernel,
    /// The parts of the kernel that the scenes select.
    pub choices: Choices,
    /// Word-major inputs; without any instance there is nothing to run, and nothing comes of it.
    pub inputs: Vec<R>,
    /// Word-major state and flags that its instances have come to before; `None` at their start.
    pub before: Option<(Vec<R>, Vec<u32>)>,
    /// Something to remember with the batch until its results come.
    pub memory: T,
}

impl<R, T> Batch<R, T> {
    /// Its instances.
    fn len(&self) -> usize {
        self.inputs.len() / words(self.kernel.inputs).max(1)
    }
}

/// A device with the kernels compiled for it.
#[derive(Debug)]
pub struct Session {
    device: Device,
    compiled: Vec<(Choices, Compiled)>,
    lost_once: bool,
}

impl Session {
    /// An open device, no kernel yet.
    #[must_use]
    pub fn new(device: Device) -> Session {
        Session { device, compiled: Vec::new(), lost_once: false }
    }

    /// The device in use.
    #[must_use]
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Instances of a chunk that fit the adapter's buffers and dispatches and the memory of the host;
    /// `kernel` is the one with the most words.
    #[must_use]
    pub fn chunk_size<R: Real>(&self, kernel: &Kernel) -> usize {
        let limits = self.device.limits();
        let [inputs, state, flags] = [kernel.inputs, kernel.state, kernel.flags].map(words);
        let bytes = [inputs * size_of::<R>(), state * size_of::<R>(), flags * 4];
        let largest = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let largest = usize::try_from(largest).unwrap_or(usize::MAX);
        // Word-major indices are u32.
        let words = inputs.max(state).max(flags).max(1);
        let rows = limits.max_compute_workgroups_per_dimension as usize;
        (largest / bytes.into_iter().max().unwrap_or(1).max(1))
            .min(MOST_BYTES / bytes.into_iter().sum::<usize>().max(1))
            .min(u32::MAX as usize / words)
            .min(rows.saturating_mul(rows).saturating_mul(WORKGROUP_SIZE as usize))
            .max(1)
    }

    /// Runs `total` instances in chunks of at most `chunk`.
    ///
    /// `prepare` makes the batches of a range, of as many instances as it likes. `accept` gets the range, whether it has got
    /// it before, and each batch's memory and result, also of a chunk that was cancelled on its way. It returns the batches
    /// that follow for the same range, and none when the range is done.
    ///
    /// # Errors
    /// Those of [`resume`]; a device lost for the second time.
    pub fn each<R: Real, T>(
        &mut self,
        total: usize,
        chunk: usize,
        drive: &Drive,
        mut prepare: impl FnMut(Range<usize>) -> Vec<Batch<R, T>>,
        mut accept: impl FnMut(Range<usize>, bool, Vec<(T, ChunkResult<R>)>) -> Result<Vec<Batch<R, T>>>,
    ) -> Result<()> {
        let mut chunk = chunk.max(1);
        let mut start = 0;
        let reported = AtomicUsize::new(0);
        while start < total {
            let range = start..(start + chunk).min(total);
            let done = AtomicUsize::new(0);
            // What a lost device had already reported is not reported again.
            let report = |now: usize| {
                let before = reported.fetch_max(now, Ordering::Relaxed);
                if now > before {
                    (drive.progress)(now - before);
                }
            };
            let progress = |count: usize| {
                if drive.counts {
                    report(done.fetch_add(count, Ordering::Relaxed) + count);
                }
            };
            let drive_chunk = Drive { offset: start, progress: &progress, ..*drive };
            let mut batches = prepare(range.clone());
            let mut again = false;
            let ended = loop {
                let results = match self.run(batches, &drive_chunk) {
                    Ok(results) => results,
                    Err(why) => break Err(why),
                };
                let cancelled = results.iter().any(|(_, result)| result.cancelled);
                batches = accept(range.clone(), again, results)?;
                if cancelled {
                    return Err(Error::Cancelled { done: start, total });
                }
                if batches.is_empty() {
                    break Ok(());
                }
                if !drive.counts {
                    report(range.len().saturating_sub(batches.iter().map(Batch::len).sum()));
                }
                again = true;
            };
            match ended {
                Ok(()) => {
                    let rest = range.len().saturating_sub(reported.swap(0, Ordering::Relaxed));
                    (drive.progress)(rest);
                    start = range.end;
                }
                Err(Error::DeviceLost { why }) if self.lost_once => {
                    return Err(Error::DeviceLostAgain { why, done: start, total });
                }
                Err(Error::DeviceLost { .. }) => {
                    self.device = self.device.reopen()?;
                    self.compiled.clear();
                    self.lost_once = true;
                    chunk = (chunk / 2).max(1);
                }
                Err(Error::Unwritten { instance }) => {
                    return Err(Error::Unwritten { instance: start + instance });
                }
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }

    /// Runs the batches of one chunk.
    fn run<R: Real, T>(
        &mut self,
        batches: Vec<Batch<R, T>>,
        drive: &Drive,
    ) -> Result<Vec<(T, ChunkResult<R>)>> {
        let mut results = Vec::with_capacity(batches.len());
        for batch in batches {
            if batch.inputs.is_empty() {
                results.push((batch.memory, ChunkResult::nothing(&batch.kernel, 0)));
                continue;
            }
            let place = self.compiled(&batch.kernel, &batch.choices)?;
            let result = match resume(
                &self.device,
                &self.compiled[place].1,
                &batch.inputs,
                batch.before.as_ref(),
                drive,
            ) {
                Err(Error::Cancelled { total, .. }) => ChunkResult::nothing(&batch.kernel, total),
                other => other?,
            };
            results.push((batch.memory, result));
        }
        Ok(results)
    }

    /// The place of a kernel, compiled at its first use.
    fn compiled(&mut self, kernel: &Kernel, choices: &Choices) -> Result<usize> {
        let same = |(made, compiled): &(Choices, Compiled)| made == choices && compiled.kernel == *kernel;
        if let Some(place) = self.compiled.iter().position(same) {
            return Ok(place);
        }
        let compiled = Compiled::new(&self.device, kernel, choices)?;
        self.compiled.push((choices.clone(), compiled));
        Ok(self.compiled.len() - 1)
    }
}
