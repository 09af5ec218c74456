//! Ctrl-C, and the signal by which schedulers end a process.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use squealmap::{Error, Result};

/// A flag that Ctrl-C sets, and SIGTERM; a command then ends between two instances or dispatches. Set before anything is
/// made on the disk; a second Ctrl-C changes nothing, so that no file is left half written.
pub(crate) fn stop_at_signal() -> Result<Arc<AtomicBool>> {
    let cancel = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&cancel);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
        .map_err(|why| Error::Signal { why: why.to_string() })?;
    #[cfg(unix)]
    signal_hook::flag::register(signal_hook::consts::SIGTERM, Arc::clone(&cancel))
        .map_err(|why| Error::Signal { why: why.to_string() })?;
    Ok(cancel)
}
