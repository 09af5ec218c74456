//! Eigenvalues chunk by chunk; a lost device is opened again once, with half the work.

use std::num::NonZero;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

use crate::engine::error::{Error, Result};
use crate::engine::fields::words;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::kernel::Compiled;
use crate::engine::gpu::run::{ChunkResult, Drive, run};
use crate::engine::kernel::places::TOGETHER;
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

/// The instances of one chunk that need the kernel.
#[derive(Debug)]
pub struct Batch<R, T> {
    /// Their inputs, and how many they are; without any instance there is nothing to run, and nothing comes of it.
    pub inputs: (Vec<R>, usize),
    /// Something to remember with the batch until its results come.
    pub memory: T,
}

/// A device with the kernels compiled for it.
#[derive(Debug)]
pub struct Session {
    device: Device,
    compiled: Vec<(Choices, Compiled)>,
    /// How many times it was opened again.
    opened_again: u32,
}

impl Session {
    /// An open device, no kernel yet.
    #[must_use]
    pub fn new(device: Device) -> Session {
        Session { device, compiled: Vec::new(), opened_again: 0 }
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
        // Places of words are u32.
        let words = inputs.max(state).max(flags).max(1);
        let rows = limits.max_compute_workgroups_per_dimension as usize;
        let most = (largest / bytes.into_iter().max().unwrap_or(1).max(1))
            .min(MOST_BYTES / bytes.into_iter().sum::<usize>().max(1))
            .min(u32::MAX as usize / words)
            .min(rows.saturating_mul(rows).saturating_mul(WORKGROUP_SIZE as usize));
        // Buffers have room for whole groups of instances.
        (most / TOGETHER * TOGETHER).max(TOGETHER)
    }

    /// Runs `total` instances through a kernel in chunks of at most `chunk`.
    ///
    /// `prepare` makes the batch of a range; `accept` gets what it has remembered, and the result, also of a chunk that was
    /// cancelled on its way.
    ///
    /// # Errors
    /// Those of [`run`]; a device lost for the second time.
    pub fn each<R: Real, T>(
        &mut self,
        kernel: &Kernel,
        [total, chunk]: [usize; 2],
        drive: &Drive,
        mut prepare: impl FnMut(Range<usize>) -> Batch<R, T>,
        mut accept: impl FnMut(T, ChunkResult<R>) -> Result<()>,
    ) -> Result<()> {
        let mut chunk = chunk.max(1);
        let mut start = 0;
        let reported = AtomicUsize::new(0);
        while start < total {
            let range = start..(start + chunk).min(total);
            let done = AtomicUsize::new(0);
            // What a lost device had already reported is not reported again.
            let progress = |count: usize| {
                let now = done.fetch_add(count, Ordering::Relaxed) + count;
                let before = reported.fetch_max(now, Ordering::Relaxed);
                if now > before {
                    (drive.progress)(now - before);
                }
            };
            let Batch { inputs: (inputs, count), memory } = prepare(range.clone());
            let drive = Drive { offset: start, progress: &progress, ..*drive };
            match self.one(kernel, (&inputs, count), &drive) {
                Ok(result) => {
                    let cancelled = result.cancelled;
                    accept(memory, result)?;
                    if cancelled {
                        return Err(Error::Cancelled { done: start, total });
                    }
                    progress(range.len().saturating_sub(done.load(Ordering::Relaxed)));
                    reported.store(0, Ordering::Relaxed);
                    start = range.end;
                }
                Err(Error::DeviceLost { why }) => {
                    self.reopen(why, [start, total])?;
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

    /// Opens the device again that was lost, the first time.
    ///
    /// # Errors
    /// When it is lost for the second time, or cannot be opened.
    pub(super) fn reopen(&mut self, why: String, [done, total]: [usize; 2]) -> Result<()> {
        if self.opened_again > 0 {
            return Err(Error::DeviceLostAgain { why, done, total });
        }
        self.opened_again += 1;
        self.device = self.device.reopen()?;
        self.compiled.clear();
        Ok(())
    }

    /// Runs one chunk.
    fn one<R: Real>(
        &mut self,
        kernel: &Kernel,
        inputs: (&[R], usize),
        drive: &Drive,
    ) -> Result<ChunkResult<R>> {
        if inputs.1 == 0 {
            return Ok(ChunkResult::nothing(kernel, 0));
        }
        let place = self.compiled(kernel, &Choices::new())?;
        match run(&self.device, &self.compiled[place].1, inputs, drive) {
            Err(Error::Cancelled { total, .. }) => Ok(ChunkResult::nothing(kernel, total)),
            other => other,
        }
    }

    /// How many times the device was opened again.
    pub(super) fn opened_again(&self) -> u32 {
        self.opened_again
    }

    /// The kernel at a place.
    pub(super) fn at(&self, place: usize) -> &Compiled {
        &self.compiled[place].1
    }

    /// The place of a kernel, compiled at its first use.
    pub(super) fn compiled(&mut self, kernel: &Kernel, choices: &Choices) -> Result<usize> {
        let same = |(made, compiled): &(Choices, Compiled)| made == choices && compiled.kernel == *kernel;
        if let Some(place) = self.compiled.iter().position(same) {
            return Ok(place);
        }
        let compiled = Compiled::new(&self.device, kernel, choices)?;
        self.compiled.push((choices.clone(), compiled));
        Ok(self.compiled.len() - 1)
    }
}
