//! A whole sweep chunk by chunk; a lost device is opened again once, with half the work.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::device::Device;
use super::kernel::Compiled;
use super::run::{ChunkResult, Drive, run};
use crate::error::{Error, Result};
use crate::kernel::scalar::Real;
use crate::kernel::source::{Constant, Kernel, WORKGROUP_SIZE};

/// Most instances of a chunk, however large an adapter's buffers: it bounds the memory of the host.
pub const MOST_INSTANCES: usize = 1 << 20;

/// A device with a kernel compiled for it.
#[derive(Debug)]
pub struct Session<'a> {
    device: Device,
    compiled: Compiled,
    kernel: &'a Kernel,
    choices: &'a [(&'a str, Constant)],
    lost_once: bool,
}

impl<'a> Session<'a> {
    /// Compiles `kernel` for an open device; `choices` are constants that the scene selects.
    ///
    /// # Errors
    /// When the device rejects the kernel.
    pub fn new(
        device: Device,
        kernel: &'a Kernel,
        choices: &'a [(&'a str, Constant)],
    ) -> Result<Session<'a>> {
        let compiled = Compiled::new(&device, kernel, choices)?;
        Ok(Session { device, compiled, kernel, choices, lost_once: false })
    }

    /// The device in use.
    #[must_use]
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Instances of a chunk that fit the adapter's buffers and dispatches.
    #[must_use]
    pub fn chunk_size<R: Real>(&self) -> usize {
        let limits = self.device.limits();
        let [inputs, state, flags] = self.compiled.words();
        let bytes =
            [inputs * size_of::<R>(), state * size_of::<R>(), flags * 4].into_iter().max().unwrap_or(1);
        let largest = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        // Word-major indices are u32.
        let words = inputs.max(state).max(flags).max(1);
        let rows = limits.max_compute_workgroups_per_dimension as usize;
        usize::try_from(largest)
            .unwrap_or(usize::MAX)
            .checked_div(bytes)
            .unwrap_or(1)
            .min(u32::MAX as usize / words)
            .min(rows.saturating_mul(rows).saturating_mul(WORKGROUP_SIZE as usize))
            .clamp(1, MOST_INSTANCES)
    }

    /// Runs `total` instances in chunks of at most `chunk`.
    ///
    /// `prepare` makes the word-major inputs of a range, of as many instances as it likes, and something to
    /// remember; `accept` gets the range, what is remembered, and the result (`None` without any inputs).
    ///
    /// # Errors
    /// Those of [`run`]; a device lost for the second time.
    pub fn each<R: Real, T>(
        &mut self,
        total: usize,
        chunk: usize,
        drive: &Drive,
        mut prepare: impl FnMut(Range<usize>) -> (Vec<R>, T),
        mut accept: impl FnMut(Range<usize>, T, Option<ChunkResult<R>>) -> Result<()>,
    ) -> Result<()> {
        let mut chunk = chunk.min(self.chunk_size::<R>()).max(1);
        let mut start = 0;
        let reported = AtomicUsize::new(0);
        while start < total {
            let range = start..(start + chunk).min(total);
            let (inputs, memory) = prepare(range.clone());
            let done = AtomicUsize::new(0);
            // What a lost device had already reported is not reported again.
            let progress = |count: usize| {
                let now = done.fetch_add(count, Ordering::Relaxed) + count;
                let before = reported.fetch_max(now, Ordering::Relaxed);
                if now > before {
                    (drive.progress)(now - before);
                }
            };
            let result = if inputs.is_empty() {
                Ok(None)
            } else {
                let drive = Drive { offset: start, progress: &progress, ..*drive };
                run(&self.device, &self.compiled, &inputs, &drive).map(Some)
            };
            match result {
                Ok(result) => {
                    accept(range.clone(), memory, result)?;
                    let rest = range.len().saturating_sub(reported.swap(0, Ordering::Relaxed));
                    (drive.progress)(rest);
                    start = range.end;
                }
                Err(Error::DeviceLost { why }) if self.lost_once => {
                    return Err(Error::DeviceLostAgain { why, done: start, total });
                }
                Err(Error::DeviceLost { .. }) => {
                    self.device = self.device.reopen()?;
                    self.compiled = Compiled::new(&self.device, self.kernel, self.choices)?;
                    self.lost_once = true;
                    chunk = (chunk / 2).max(1);
                }
                Err(Error::Unwritten { instance }) => {
                    return Err(Error::Unwritten { instance: start + instance });
                }
                Err(Error::Cancelled { .. }) => return Err(Error::Cancelled { done: start, total }),
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }
}
