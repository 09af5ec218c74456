//! An open device: error scopes, waiting with a limit, device lost.

use crate::engine::error::{Error, Result};
use crate::engine::gpu::adapter::{Adapter, Description};
use crate::engine::gpu::arithmetic::Arithmetic;
use crate::engine::gpu::meter::{Meter, Metered};
use crate::engine::precision::Precision;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How long a submission may take; one that takes longer has hung. Dispatches are cut to a tenth of a second.
const PATIENCE: Duration = Duration::from_mins(1);
/// How long a submission may take where a processor stands in for the GPU. It compiles a kernel within its first submission,
/// which takes half a minute, and shares its cores with whatever else runs.
const SOFTWARE_PATIENCE: Duration = Duration::from_mins(10);

/// An open device and its queue; clones are the same device.
#[derive(Clone, Debug)]
pub struct Device {
    pub(super) raw: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    adapter: Adapter,
    arithmetic: Arithmetic,
    lost: Arc<Lost>,
    pub(super) meter: Arc<Meter>,
}

/// The words of the driver when the device is lost, and errors outside any scope.
#[derive(Debug, Default)]
struct Lost {
    flag: AtomicBool,
    why: Mutex<String>,
}

impl Lost {
    fn set(&self, why: String) {
        *self.why.lock().unwrap_or_else(PoisonError::into_inner) = why;
        self.flag.store(true, Ordering::Release);
    }

    fn why(&self) -> String {
        self.why.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Device {
    /// Opens an adapter with its own limits, and with f64 or strict where that is asked for.
    ///
    /// # Errors
    /// When it lacks one of them, or cannot be opened.
    pub fn open(adapter: &Adapter, arithmetic: impl Into<Arithmetic>) -> Result<Device> {
        let arithmetic = arithmetic.into();
        let description = adapter.describe();
        // It tells how long it computes, where it can.
        let mut features = adapter.raw.features() & wgpu::Features::TIMESTAMP_QUERY;
        if arithmetic.precision == Precision::F64 {
            if !description.f64 {
                return Err(Error::NoF64 { adapter: description.to_string() });
            }
            features |= wgpu::Features::SHADER_F64;
        }
        if arithmetic.strict {
            if !description.strict {
                return Err(Error::NoStrict { adapter: description.to_string() });
            }
            features |= wgpu::Features::PASSTHROUGH_SHADERS;
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("squealmap"),
            required_features: features,
            required_limits: adapter.raw.limits(),
            ..wgpu::DeviceDescriptor::default()
        };
        let (raw, queue) = pollster::block_on(adapter.raw.request_device(&descriptor))
            .map_err(|why| Error::OpenDevice { adapter: description.to_string(), why: why.to_string() })?;
        let lost = Arc::new(Lost::default());
        let on_lost = Arc::clone(&lost);
        raw.set_device_lost_callback(move |reason, message| on_lost.set(format!("{reason:?} {message}")));
        let on_error = Arc::clone(&lost);
        raw.on_uncaptured_error(Arc::new(move |error: wgpu::Error| on_error.set(error.to_string())));
        Ok(Device { raw, queue, adapter: adapter.clone(), arithmetic, lost, meter: Arc::default() })
    }

    /// Opens the same adapter again, after a loss.
    ///
    /// # Errors
    /// As [`Device::open`].
    pub fn reopen(&self) -> Result<Device> {
        Device::open(&self.adapter, self.arithmetic)
    }

    /// The scalar it was opened for.
    #[must_use]
    pub fn precision(&self) -> Precision {
        self.arithmetic.precision
    }

    /// Whether every operation is rounded by itself.
    #[must_use]
    pub fn strict(&self) -> bool {
        self.arithmetic.strict
    }

    /// Whether it is a program on the CPU, or may be one.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.adapter.may_be_software()
    }

    /// The adapter that it runs on.
    #[must_use]
    pub fn describe(&self) -> Description {
        self.adapter.describe()
    }

    /// The limits it was opened with.
    #[must_use]
    pub fn limits(&self) -> wgpu::Limits {
        self.raw.limits()
    }

    /// Gives the device up: every later use fails as after a loss. For tests of that path.
    pub fn destroy(&self) {
        self.raw.destroy();
        self.lost.set("it was given up".to_owned());
    }

    /// Runs `work` with its errors caught; `what` names it in the message.
    ///
    /// # Errors
    /// What the device says of the work.
    pub fn checked<T>(&self, what: &str, work: impl FnOnce() -> T) -> Result<T> {
        let memory = self.raw.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.raw.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.raw.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = work();
        let errors = [validation, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        let error = errors.into_iter().flatten().next();
        if error.is_some() {
            // A loss is reported by a poll, and is the cause of whatever else fails.
            let _ = self.raw.poll(wgpu::PollType::Poll);
        }
        self.alive()?;
        match error {
            Some(error) => Err(Error::Device { what: what.to_owned(), why: error.to_string() }),
            None => Ok(result),
        }
    }

    /// What it has done so far.
    #[must_use]
    pub fn metered(&self) -> Metered {
        self.meter.read()
    }

    /// Waits for everything submitted so far.
    ///
    /// # Errors
    /// When the device is lost or does not answer.
    pub fn wait(&self) -> Result<()> {
        self.wait_until(None)
    }

    /// Waits for a submission, and for those before it.
    ///
    /// # Errors
    /// When the device is lost or does not answer.
    pub(super) fn wait_for(&self, submission: wgpu::SubmissionIndex) -> Result<()> {
        self.wait_until(Some(submission))
    }

    /// Hears of what has come to its end, without waiting for it: for something that was submitted so long ago.
    ///
    /// # Errors
    /// When the device is lost or does not answer.
    pub(super) fn listen(&self, since: Duration) -> Result<()> {
        let polled = self.raw.poll(wgpu::PollType::Poll);
        self.alive()?;
        polled.map_err(|why| Error::DeviceLost { why: why.to_string() })?;
        if since > self.patience() {
            return Err(Error::DeviceLost { why: wgpu::PollError::Timeout.to_string() });
        }
        Ok(())
    }

    /// How long a submission may take.
    fn patience(&self) -> Duration {
        if self.adapter.is_software() { SOFTWARE_PATIENCE } else { PATIENCE }
    }

    fn wait_until(&self, submission_index: Option<wgpu::SubmissionIndex>) -> Result<()> {
        let wait = wgpu::PollType::Wait { submission_index, timeout: Some(self.patience()) };
        let polled = self.meter.wait(|| self.raw.poll(wait));
        self.alive()?;
        polled.map(|_| ()).map_err(|why| Error::DeviceLost { why: why.to_string() })
    }

    /// An error once the device is lost.
    fn alive(&self) -> Result<()> {
        if self.lost.flag.load(Ordering::Acquire) {
            return Err(Error::DeviceLost { why: self.lost.why() });
        }
        Ok(())
    }
}
