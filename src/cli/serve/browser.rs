//! The browser of whoever looks.

use std::process::{Command, Stdio};

/// What opens an address on this system.
const OPENERS: &[&str] = if cfg!(windows) {
    &["cmd", "/C", "start", ""]
} else if cfg!(target_os = "macos") {
    &["open"]
} else {
    &["xdg-open"]
};

/// Opens an address in it.
///
/// # Errors
/// A sentence, when there is none, or no screen to show it on.
pub(crate) fn open(address: &str) -> Result<(), String> {
    // Without a screen a browser of a terminal would take this one over.
    let has_screen = ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| std::env::var_os(name).is_some());
    if OPENERS == ["xdg-open"] && !has_screen {
        return Err("there is no screen here".to_owned());
    }
    let mut command = Command::new(OPENERS[0]);
    command.args(&OPENERS[1..]).arg(address);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    // Ctrl-C in the terminal is for this program alone.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command.spawn().map(drop).map_err(|why| format!("`{}`: {why}", OPENERS[0]))
}
