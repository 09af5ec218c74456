//! The program where no GPU answers: no driver, a broken driver. Linux only, where the variables are read.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::Command;

/// Exit code and standard error of the program with the Vulkan loader pointed at `driver`.
fn with_driver(driver: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::copy("sweeps/paper_modes.toml", directory.path().join("modes.toml")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory.path())
        .env("NO_COLOR", "1")
        .env("VK_DRIVER_FILES", driver)
        .env("VK_ICD_FILENAMES", driver)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// What must hold wherever no adapter answers.
fn nothing_answers(driver: &Path) {
    let (code, _, err) = with_driver(driver, &["run", "modes.toml"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(err.starts_with("computing on the CPU in f64: no GPU was found: "), "{err}");

    let (code, _, err) = with_driver(driver, &["run", "modes.toml", "--backend", "gpu"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(err.starts_with("error: no GPU was found: "), "{err}");
    assert!(err.contains("libvulkan1") && err.contains("mesa-vulkan-drivers"), "{err}");

    let (code, _, err) = with_driver(driver, &["run", "modes.toml", "--require-gpu"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(err.starts_with("error: --require-gpu: the CPU engine "), "{err}");

    let (code, _, err) = with_driver(driver, &["run", "modes.toml", "--strict"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(err.starts_with("computing on the CPU in f64: no GPU was found: "), "{err}");

    let (code, out, _) = with_driver(driver, &["adapters"]);
    assert_eq!(code, Some(0));
    assert!(out.starts_with("no GPU was found "), "{out}");
}

#[test]
fn no_driver() {
    nothing_answers(Path::new("/nonexistent"));
}

#[test]
fn a_driver_that_is_not_there() {
    let directory = tempfile::tempdir().unwrap();
    let manifest = directory.path().join("broken.json");
    let text = r#"{"file_format_version": "1.0.0", "ICD": {"library_path": "/nonexistent.so", "api_version": "1.3.0"}}"#;
    std::fs::write(&manifest, text).unwrap();
    nothing_answers(&manifest);
}

#[test]
fn the_cpu_engine_has_no_f32() {
    let (code, _, err) = with_driver(
        Path::new("/nonexistent"),
        &["run", "modes.toml", "--backend", "cpu", "--precision", "f32"],
    );
    assert_eq!(code, Some(2), "{err}");
    assert!(err.starts_with("error: the CPU engine computes in f64 only; remove --precision f32"), "{err}");
}

#[test]
fn the_cpu_engine_is_not_asked_to_be_strict() {
    let (code, _, err) =
        with_driver(Path::new("/nonexistent"), &["run", "modes.toml", "--backend", "cpu", "--strict"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(
        err.starts_with("error: the CPU engine rounds every operation by itself; remove --strict"),
        "{err}"
    );
}
