//! The program where no GPU answers: no driver, a broken driver. Linux only, where the variables are read.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::process::Command;

/// A sweep with one row of its friction table more than kernels hold.
const LONG: &str = "[friction]\nlaw = \"table\"\ntable = \"mu.csv\"\n[belt]\nbelt_velocity = 3\n\
                    [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";

/// A sweep with transients.
const PERIODS: &str = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n\
                       [response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";

/// A sweep that finds its cycles.
const CYCLE: &str =
    "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n[response]\nsettle = \"cycle\"\n";

/// Exit code and standard error of the program with the Vulkan loader pointed at `driver`.
fn with_driver(driver: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::copy("sweeps/paper/figure2.toml", directory.path().join("modes.toml")).unwrap();
    std::fs::write(directory.path().join("periods.toml"), PERIODS).unwrap();
    std::fs::write(directory.path().join("long.toml"), LONG).unwrap();
    std::fs::write(directory.path().join("cycle.toml"), CYCLE).unwrap();
    let rows: Vec<String> = (0..1025).map(|row| format!("{row},0.3")).collect();
    std::fs::write(directory.path().join("mu.csv"), format!("velocity,mu\n{}\n", rows.join("\n"))).unwrap();
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

/// The words of a command line.
fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// What must hold wherever no adapter answers.
fn nothing_answers(driver: &Path) {
    let (code, _, err) = with_driver(driver, &["run", "periods.toml"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(err.starts_with("computing on the CPU in f64: no GPU was found: "), "{err}");
    let (code, _, err) = with_driver(driver, &["run", "modes.toml"]);
    assert_eq!(code, Some(0), "{err}");
    let why = "a GPU gains nothing where eigenvalues alone are asked for";
    assert!(err.starts_with(&format!("computing on the CPU in f64: {why}\n")), "{err}");

    // Eigenvalues are in f64 whatever was asked for.
    let (code, _, err) = with_driver(driver, &["run", "modes.toml", "--precision", "f32"]);
    assert_eq!(code, Some(0), "{err}");
    let always = "computing on the CPU in f64, as eigenvalues always are: ";
    assert!(err.starts_with(&format!("{always}{why}\n")), "{err}");

    let (code, _, err) = with_driver(driver, &["run", "modes.toml", "--backend", "gpu"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(err.starts_with("error: no GPU was found: "), "{err}");
    assert!(err.contains("libvulkan1") && err.contains("mesa-vulkan-drivers"), "{err}");

    // The CPU engine computes in the precision that was asked for.
    for precision in ["f32", "f64"] {
        let (code, _, err) = with_driver(driver, &["run", "periods.toml", "--precision", precision]);
        assert_eq!(code, Some(0), "{err}");
        let expected = format!("computing on the CPU in {precision}: no GPU was found: ");
        assert!(err.starts_with(&expected), "{err}");
    }

    for asked in ["--strict", "--adapter radeon", "--require-gpu", "--strict --precision f64"] {
        let (code, _, err) = with_driver(driver, &[&["run", "modes.toml"], &words(asked)[..]].concat());
        assert_eq!(code, Some(2), "{err}");
        let asked = asked.trim_end_matches(" --precision f64");
        let cause = "this needs a GPU, but no adapter answers through Vulkan, Metal or DX12; install ";
        assert!(err.starts_with(&format!("error: {asked}: {cause}")), "{err}");
        assert!(err.ends_with(&format!(", or remove {asked}\n")), "{err}");
    }
    let all = "run modes.toml --require-gpu --strict --precision f32";
    let (_, _, err) = with_driver(driver, &words(all));
    assert!(err.starts_with("error: --strict and --require-gpu: this needs a GPU"), "{err}");

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

/// The one line that a run without any driver ends with, after exit code 2.
fn refused(arguments: &str) -> String {
    let (code, _, err) = with_driver(Path::new("/nonexistent"), &words(arguments));
    assert_eq!(code, Some(2), "{err}");
    assert_eq!(err.lines().count(), 1, "{err}");
    err.trim_end().to_owned()
}

#[test]
fn the_reference_has_no_f32() {
    assert_eq!(
        refused("run modes.toml --backend reference --precision f32"),
        "error: the reference computes in f64 only; remove --precision f32 or use --backend cpu"
    );
}

#[test]
fn the_cpu_engine_is_not_asked_to_be_strict() {
    assert_eq!(
        refused("run modes.toml --backend cpu --strict"),
        "error: --strict is about how a GPU rounds; remove --strict or use --backend gpu"
    );
}

#[test]
fn the_cpu_engine_uses_no_adapter() {
    assert_eq!(
        refused("run modes.toml --backend cpu --adapter radeon"),
        "error: the CPU engine uses no adapter; remove --adapter radeon or use --backend gpu"
    );
}

#[test]
fn the_cpu_engine_is_no_gpu() {
    assert_eq!(
        refused("run modes.toml --backend cpu --require-gpu"),
        "error: the CPU engine is no GPU; remove --require-gpu or use --backend gpu"
    );
}

#[test]
fn an_adapter_has_a_name() {
    for backend in ["auto", "gpu", "cpu"] {
        for name in ["", "  "] {
            let arguments = ["run", "modes.toml", "--backend", backend, "--adapter", name];
            let (code, _, err) = with_driver(Path::new("/nonexistent"), &arguments);
            assert_eq!(code, Some(2), "{err}");
            let expected = format!(
                "error: --adapter is `{name}` but must be a part of an adapter's name as `squealmap adapters` \
                 prints it; give one or remove --adapter\n"
            );
            assert_eq!(err, expected);
        }
    }
}

#[test]
fn a_table_that_no_kernel_holds_is_the_reason_given() {
    let cause = "a friction table of 1025 rows, or two of a material together, is too long for a GPU, which takes 1024; \
                 thin it out, or";
    assert_eq!(refused("run long.toml --backend gpu"), format!("error: {cause} use --backend cpu"));
    for asked in ["--require-gpu", "--backend gpu --require-gpu", "--strict"] {
        let named = asked.replace(" --r", " and --r");
        assert_eq!(
            refused(&format!("run long.toml {asked}")),
            format!("error: {named}: this needs a GPU, but {cause} remove {named}")
        );
    }
    let (code, _, err) = with_driver(Path::new("/nonexistent"), &["run", "long.toml"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(err.starts_with(&format!("computing on the CPU in f64: {cause} use --backend cpu")), "{err}");
}

#[test]
fn cycles_are_found_on_the_cpu_and_refused_on_a_gpu() {
    let cause = "settle = \"cycle\"";
    assert_eq!(
        refused("run cycle.toml --backend gpu"),
        format!(
            "error: {cause} finds cycles on the CPU only; use --backend cpu, or settle = \"auto\" in [response]"
        )
    );
    assert_eq!(
        refused("run cycle.toml --require-gpu"),
        format!(
            "error: --require-gpu: this needs a GPU, but {cause} in [response] finds cycles on the CPU only; write \
             settle = \"auto\", or remove --require-gpu"
        )
    );
    let (code, _, err) = with_driver(Path::new("/nonexistent"), &["run", "cycle.toml"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(err.starts_with(&format!("computing on the CPU in f64: {cause} finds cycles")), "{err}");
}
