//! Work beside the interpreter: on threads of its own, which never hold the interpreter up, while the thread that called
//! looks for Ctrl-C and tells how far it is.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use numpy::IntoPyArray;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;

use crate::failure::Failure;

/// Between two looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// Work that shows nothing before its end is left to itself where it does not stop within this time after Ctrl-C; it ends at
/// its next look, unheard.
const PATIENCE: Duration = Duration::from_millis(900);

/// A sweep, which stops in a moment, is waited for longer, so that a busy machine loses nothing of what is done.
const FOR_WHAT_IS_DONE: Duration = Duration::from_secs(20);

/// What work and the thread that waits for it know of each other.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    cancel: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Watch {
    /// Set when the work is to stop.
    pub(crate) fn cancel(&self) -> &AtomicBool {
        &self.cancel
    }

    /// Whether the work is to stop.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Says how much there is to do.
    pub(crate) fn expect(&self, total: usize) {
        self.total.store(total, Ordering::Relaxed);
    }

    /// Says that more of it is done.
    pub(crate) fn add(&self, count: usize) {
        self.done.fetch_add(count, Ordering::Relaxed);
    }

    /// Tells `progress` how much is done of how much, and hears Ctrl-C.
    fn look(&self, py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        py.check_signals()?;
        let total = self.total.load(Ordering::Relaxed);
        match progress.filter(|_| total > 0) {
            Some(progress) => progress.call1(py, (self.done.load(Ordering::Relaxed), total)).map(drop),
            None => Ok(()),
        }
    }
}

/// The result of work, and the exception that came while it was done: Ctrl-C, or what `progress` raised.
pub(crate) type Ended<T> = (T, Option<PyErr>);

/// Does `work` on as many threads as asked for, or one per core. `progress` is called with two numbers, done and all, in the
/// thread that calls. After an exception there the work is to stop, and what it gives then is given.
///
/// # Errors
/// That exception, where the work gives nothing; why the work has no result.
pub(crate) fn watched<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
) -> PyResult<Ended<T>> {
    patiently(py, (threads, FOR_WHAT_IS_DONE), progress, work)
}

fn patiently<T: Send + 'static>(
    py: Python<'_>,
    (threads, patience): (Option<usize>, Duration),
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
) -> PyResult<Ended<T>> {
    // What numpy is reached by is looked up once, before any Ctrl-C, which it would take for a fault.
    drop(Vec::<f64>::new().into_pyarray(py));
    let watch = Arc::new(Watch::default());
    let (sender, receiver) = sync_channel(1);
    let seen = Arc::clone(&watch);
    let begun = thread::Builder::new().name("squealmap".to_owned()).spawn(move || {
        let made = catch_unwind(AssertUnwindSafe(|| pooled(threads, || work(&seen))));
        // Nobody listens to work that was left to itself.
        let _ = sender.send(made.unwrap_or_else(|why| Err(Failure::panic(&said(why.as_ref())))));
    });
    begun.map_err(|why| PyRuntimeError::new_err(format!("cannot start a thread: {why}")))?;
    let (made, raised) = py.detach(|| wait(receiver, &watch, progress, patience));
    match (made, raised) {
        // The last look: what is done is not lost to a Ctrl-C that comes with its end.
        (Some(Ok(made)), None) => Ok((made, watch.look(py, progress).err())),
        (Some(Ok(made)), raised) => Ok((made, raised)),
        (_, Some(raised)) => Err(raised),
        (Some(Err(why)), None) => Err(why.raised(py)),
        (None, None) => Err(Failure::panic("a thread ended without a word").raised(py)),
    }
}

/// The same of work that has nothing to show before its end.
///
/// # Errors
/// Those of [`watched`], and any exception.
pub(crate) fn whole<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Watch) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    match patiently(py, (None, PATIENCE), None, work)? {
        (made, None) => Ok(made),
        (_, Some(raised)) => Err(raised),
    }
}

/// Waits for the work and looks for Ctrl-C meanwhile.
fn wait<T>(
    receiver: Receiver<Result<T, Failure>>,
    watch: &Watch,
    progress: Option<&Py<PyAny>>,
    patience: Duration,
) -> (Option<Result<T, Failure>>, Option<PyErr>) {
    let mut raised: Option<(PyErr, Instant)> = None;
    loop {
        match receiver.recv_timeout(LOOK) {
            Ok(made) => return (Some(made), raised.map(|(why, _)| why)),
            Err(RecvTimeoutError::Disconnected) => return (None, raised.map(|(why, _)| why)),
            Err(RecvTimeoutError::Timeout) => {}
        }
        match &raised {
            Some((_, since)) if since.elapsed() > patience => return (None, raised.map(|(why, _)| why)),
            // It is stopping: pressing Ctrl-C again says nothing new.
            Some(_) => Python::attach(|py| drop(py.check_signals())),
            None => {
                if let Err(why) = Python::attach(|py| watch.look(py, progress)) {
                    watch.cancel.store(true, Ordering::Relaxed);
                    raised = Some((why, Instant::now()));
                }
            }
        }
    }
}

/// Does work in a pool that goes with it: a process that forks finds none of its threads missing.
fn pooled<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let threads = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|why| squealmap::sweep::error::Error::Threads { threads, why: why.to_string() })?;
    pool.install(work)
}

/// The words of a panic.
fn said(why: &(dyn std::any::Any + Send)) -> String {
    let words = why.downcast_ref::<String>().cloned();
    words.or_else(|| why.downcast_ref::<&str>().map(|words| (*words).to_owned())).unwrap_or_default()
}
