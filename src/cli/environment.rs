//! The environment of the process, put right before anything reads it.

#![expect(unsafe_code, reason = "the environment of the process is changed while it has one thread")]

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The variable that switches Mesa's Vulkan layer which sorts devices off.
const NO_DEVICE_SELECT: &str = "NODEVICE_SELECT";

/// Keeps Mesa's Vulkan layer which sorts devices from looking for a display where there can be none: it would say twice in
/// every run that `XDG_RUNTIME_DIR` is invalid. Devices are sorted here in any case; what drivers say is still heard.
///
/// To be called before anything else: other threads could read the environment meanwhile.
pub(crate) fn look_for_no_display() {
    // As libwayland sees it.
    let has_display = env::var_os("XDG_RUNTIME_DIR").is_some_and(|path| Path::new(&path).is_absolute());
    if cfg!(target_os = "linux") && !has_display && env::var_os(NO_DEVICE_SELECT).is_none() {
        // SAFETY: called first in `main`, so that no other thread is there.
        unsafe { env::set_var(NO_DEVICE_SELECT, "1") };
    }
}

/// The file that starts this program, where it is not that of the process.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Keeps the file that starts this program, where it is not that of the process.
pub(crate) fn started_by(program: Option<PathBuf>) {
    if let Some(program) = program {
        let _ = PROGRAM.set(program);
    }
}

/// The file that starts this program.
///
/// # Errors
/// What the system says where it does not know it.
pub(crate) fn program() -> io::Result<PathBuf> {
    PROGRAM.get().map_or_else(env::current_exe, |program| Ok(program.clone()))
}
