//! What the layers and drivers behind Vulkan print: the user hears drivers, and no layer that looks for a display.
//!
//! A loader takes the place of the system's. It does what Mesa's layer and libwayland do: `NODEVICE_SELECT` switches the
//! layer off, and a runtime directory that is no absolute path is complained of. Every function then refuses to begin.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::Command;

const LOADER: &str = r#"
use std::env::var_os;
extern "C" fn refused() -> i32 {
    -3
}
#[unsafe(no_mangle)]
pub extern "C" fn vkGetInstanceProcAddr(_: *const u8, _: *const u8) -> *const u8 {
    let has_display = var_os("XDG_RUNTIME_DIR").is_some_and(|path| path.to_string_lossy().starts_with('/'));
    if var_os("NODEVICE_SELECT").is_none() && !has_display {
        eprintln!("error: XDG_RUNTIME_DIR is invalid or not set in the environment.");
    }
    eprintln!("the driver says: no device; layer {:?}", var_os("NODEVICE_SELECT"));
    refused as *const u8
}
"#;

/// A sweep with transients, and one without.
const PERIODS: &str = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n\
                       [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";
const MODES: &str =
    "analysis = [\"linear\"]\n[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";

/// Standard error of `squealmap run` with the loader, of a sweep, and these variables.
fn said((loader, sweep): (&Path, &str), more: &[&str], variables: &[(&str, &str)]) -> String {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("sweep.toml"), sweep).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args([&["run", "sweep.toml"], more].concat())
        .current_dir(directory.path())
        .env_remove("XDG_RUNTIME_DIR")
        .env_remove("NODEVICE_SELECT")
        .env("LD_LIBRARY_PATH", loader)
        .envs(variables.iter().copied())
        .output()
        .unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{err}");
    err
}

#[test]
fn drivers_are_heard_and_a_display_is_not_looked_for() {
    let loader = tempfile::tempdir().unwrap();
    std::fs::write(loader.path().join("loader.rs"), LOADER).unwrap();
    let built = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()))
        .args(["--edition", "2024", "--crate-type", "cdylib", "-o", "libvulkan.so.1", "loader.rs"])
        .current_dir(loader.path())
        .output()
        .unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));

    let (complaint, driver) = ("XDG_RUNTIME_DIR is invalid", "the driver says: no device; layer ");
    for variables in [&[][..], &[("XDG_RUNTIME_DIR", "")], &[("XDG_RUNTIME_DIR", "here")]] {
        let err = said((loader.path(), PERIODS), &[], variables);
        assert!(err.contains(&format!("{driver}Some(\"1\")")), "{variables:?}: {err}");
        assert!(!err.contains(complaint), "{variables:?}: {err}");
    }
    // Where there may be a display, or the user has decided, nothing is changed.
    let err = said((loader.path(), PERIODS), &[], &[("XDG_RUNTIME_DIR", "/run/user/1")]);
    assert!(err.contains(&format!("{driver}None")), "{err}");
    let err = said((loader.path(), PERIODS), &[], &[("NODEVICE_SELECT", "0")]);
    assert!(err.contains(&format!("{driver}Some(\"0\")")), "{err}");
    // What computes on the CPU asks no driver.
    for (sweep, backend) in [(PERIODS, "cpu"), (PERIODS, "reference"), (MODES, "auto")] {
        let err = said((loader.path(), sweep), &["--backend", backend], &[]);
        assert!(!err.contains(complaint) && !err.contains(driver), "{backend}: {err}");
    }
}
