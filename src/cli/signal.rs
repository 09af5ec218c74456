//! Ctrl-C, and the signal by which schedulers end a process.

use crate::cli::error::{Error, Result};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A flag that Ctrl-C sets, and SIGTERM; a command then ends between two instances or dispatches, the reference within an
/// instance too. Set before anything is made on the disk; a second Ctrl-C changes nothing, so that no file is left half written.
pub(crate) fn stop_at_signal() -> Result<Arc<AtomicBool>> {
    let cancel = Arc::new(AtomicBool::new(false));
    listen(&cancel).map_err(|why| Error::Signal { why })?;
    Ok(cancel)
}

/// The flag is set by the handler itself: no thread, which a limit on threads or memory could refuse.
#[cfg(unix)]
fn listen(cancel: &Arc<AtomicBool>) -> std::result::Result<(), String> {
    use signal_hook::consts::{SIGINT, SIGTERM};

    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register(signal, Arc::clone(cancel)).map_err(|why| why.to_string())?;
    }
    Ok(())
}

#[cfg(not(unix))]
fn listen(cancel: &Arc<AtomicBool>) -> std::result::Result<(), String> {
    let flag = Arc::clone(cancel);
    ctrlc::set_handler(move || flag.store(true, std::sync::atomic::Ordering::Relaxed))
        .map_err(|why| why.to_string())
}

/// The exit code after Ctrl-C or SIGTERM: 128 and the number of the signal, as shells have it.
pub(super) const INTERRUPTED: u8 = 130;
