//! The program with a GPU backend: exit codes, messages, manifest. Drivers print lines of their own.

use std::process::{Command, Output};

use libtest_mimic::Failed;

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    ("runs::adapters_are_listed", adapters),
    ("runs::a_linear_sweep_on_the_best_adapter", linear),
    ("runs::a_strict_linear_sweep", strict),
    ("runs::an_adapter_that_is_not_there", no_such_adapter),
    ("runs::a_response_has_no_kernel", response),
];

/// Runs the program in a directory with the sweep `modes.toml`.
pub(crate) fn squealmap(arguments: &[&str]) -> Result<(Output, tempfile::TempDir), Failed> {
    let directory = tempfile::tempdir()?;
    std::fs::copy("sweeps/paper_modes.toml", directory.path().join("modes.toml"))?;
    std::fs::copy("sweeps/mass_on_belt.toml", directory.path().join("belt.toml"))?;
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory.path())
        .env("NO_COLOR", "1")
        .output()?;
    Ok((output, directory))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn adapters() -> Result<(), Failed> {
    let (output, _directory) = squealmap(&["adapters"])?;
    let out = text(&output.stdout);
    for part in ["  kind ", "  driver ", "  features  f64 ", " MiB per storage binding, "] {
        assert!(out.contains(part), "{out}");
    }
    Ok(())
}

fn linear() -> Result<(), Failed> {
    let (output, directory) = squealmap(&["run", "modes.toml", "--backend", "gpu"])?;
    let err = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{err}");
    assert!(err.contains("computing on "), "{err}");
    let manifest = std::fs::read(directory.path().join("out/modes/manifest.json"))?;
    let manifest: serde_json::Value = serde_json::from_slice(&manifest)?;
    let linear = &manifest["computation"]["linear"];
    assert_eq!(linear["backend"], "gpu");
    assert_eq!(linear["precision"], "f32");
    assert_eq!(linear["strict"], false);
    assert!(linear["adapter"].as_str().is_some_and(|name| err.contains(name)), "{manifest}");
    assert!(manifest["computation"]["response"].is_null());
    Ok(())
}

fn strict() -> Result<(), Failed> {
    let (output, directory) = squealmap(&["run", "modes.toml", "--backend", "gpu", "--strict"])?;
    let err = text(&output.stderr);
    if err.contains(" cannot compute strictly, which needs Vulkan; ") {
        assert_eq!(output.status.code(), Some(2), "{err}");
        println!("not run: {err}");
        return Ok(());
    }
    assert_eq!(output.status.code(), Some(0), "{err}");
    assert!(err.contains(" in strict f32: "), "{err}");
    let manifest = std::fs::read(directory.path().join("out/modes/manifest.json"))?;
    let manifest: serde_json::Value = serde_json::from_slice(&manifest)?;
    assert_eq!(manifest["computation"]["linear"]["strict"], true);
    Ok(())
}

fn no_such_adapter() -> Result<(), Failed> {
    let (output, _directory) = squealmap(&["run", "modes.toml", "--backend", "gpu", "--adapter", "abacus"])?;
    let err = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("error: no adapter has `abacus` in its name; there are: "), "{err}");
    Ok(())
}

fn response() -> Result<(), Failed> {
    let (output, _directory) = squealmap(&["run", "belt.toml", "--backend", "gpu"])?;
    let err = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.starts_with("error: the response has no GPU kernel"), "{err}");
    Ok(())
}
