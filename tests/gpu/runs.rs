//! The program with a GPU backend: exit codes, messages, manifest. Drivers print lines of their own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::Case;
use libtest_mimic::Failed;
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Stopped;
use squealmap::engine::error::Error;
use squealmap::engine::options::Options;
use squealmap::engine::record::Record;
use squealmap::results;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

pub(crate) const CASES: &[Case] = &[
    ("runs::adapters_are_listed", adapters),
    ("runs::a_linear_sweep_on_the_best_adapter", linear),
    ("runs::a_cancelled_sweep_keeps_its_chunks", cancelled),
    ("runs::an_adapter_that_is_not_there", no_such_adapter),
    ("runs::a_sweep_with_response_on_the_best_adapter", response),
];

/// Cases that need a strict adapter.
pub(crate) const STRICT: &[Case] = &[("runs::a_strict_linear_sweep", strict)];

/// Cases that need the software driver's manifest.
pub(crate) const SOFTWARE: &[Case] = &[
    ("runs::two_adapters", two_adapters),
    ("runs::auto_does_not_drop_what_only_a_gpu_honours", only_on_gpu),
];

/// The manifests of the software Vulkan driver.
pub(crate) fn software_driver() -> Option<PathBuf> {
    let found = std::fs::read_dir("/usr/share/vulkan/icd.d").ok()?.flatten().map(|entry| entry.path());
    found
        .into_iter()
        .find(|path| path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"lvp")))
}

/// A sweep with response of four instances.
const BELT: &str = "[friction]\nmu_d = 0.3\nknee_velocity = 5.0\n[axes]\nmu_s = { values = [0.2, 0.5] }\nbelt_velocity = { values = [1.0, 3.0] }\n\
                    [response]\nsettle = \"5 periods\"\nmeasure = \"5 periods\"\n";

/// Runs the program in a directory with the sweep `modes.toml`.
pub(crate) fn squealmap(arguments: &[&str]) -> Result<(Output, tempfile::TempDir), Failed> {
    let directory = tempfile::tempdir()?;
    std::fs::copy("sweeps/paper/figure2.toml", directory.path().join("modes.toml"))?;
    std::fs::write(directory.path().join("belt.toml"), BELT)?;
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory.path())
        .env("NO_COLOR", "1")
        .output()?;
    Ok((output, directory))
}

/// Exit code, standard output and standard error of the program in a directory where only `drivers` answer.
fn with_drivers(
    directory: &Path,
    drivers: &[PathBuf],
    arguments: &[&str],
) -> Result<(Option<i32>, String, String), Failed> {
    let drivers = std::env::join_paths(drivers)?;
    let output = Command::new(env!("CARGO_BIN_EXE_squealmap"))
        .args(arguments)
        .current_dir(directory)
        .env("VK_ICD_FILENAMES", &drivers)
        .env("VK_DRIVER_FILES", &drivers)
        .output()?;
    Ok((output.status.code(), text(&output.stdout), text(&output.stderr)))
}

/// With a software adapter alone, `auto` takes the CPU engine, but not in the place of what that cannot do.
fn only_on_gpu() -> Result<(), Failed> {
    let drivers = [software_driver().ok_or("no driver")?];
    let directory = tempfile::tempdir()?;
    std::fs::write(directory.path().join("belt.toml"), BELT)?;
    let run = |arguments: &[&str]| {
        with_drivers(directory.path(), &drivers, &[&["run", "belt.toml"], arguments].concat())
    };
    let (_, listed, _) = with_drivers(directory.path(), &drivers, &["adapters"])?;
    let name = listed.lines().next().ok_or("no name")?;
    for (plain, precision) in
        [(&[][..], "f64"), (&["--precision", "f64"], "f64"), (&["--precision", "f32"], "f32")]
    {
        let (code, _, err) = run(plain)?;
        assert_eq!(code, Some(0), "{err}");
        let expected = format!("computing on the CPU in {precision}: the only adapter, {name} (");
        assert!(err.contains(&expected), "{err}");
    }
    for (asked, remedy) in [
        (&["--strict"][..], "take it all the same with --backend gpu"),
        (&["--adapter", name], "take it all the same with --backend gpu"),
        (&["--require-gpu"], "install the driver of a GPU"),
    ] {
        let (code, _, err) = run(asked)?;
        let asked = asked.join(" ");
        assert_eq!(code, Some(2), "{err}");
        assert!(err.contains(&format!("error: {asked}: this needs a GPU, but {name} (")), "{err}");
        assert!(err.contains(&format!(" is no hardware GPU; {remedy}, or remove {asked}\n")), "{err}");
    }
    let (code, _, err) = run(&["--backend", "gpu", "--require-gpu"])?;
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains(&format!("error: --require-gpu: {name} (")), "{err}");
    Ok(())
}

fn two_adapters() -> Result<(), Failed> {
    let driver = software_driver().ok_or("no driver")?;
    let directory = tempfile::tempdir()?;
    // The loader takes one driver once per path.
    let twice = ["one.json", "two.json"].map(|name| directory.path().join(name));
    for path in &twice {
        std::fs::copy(&driver, path)?;
    }
    std::fs::write(directory.path().join("belt.toml"), BELT)?;
    let squealmap = |arguments: &[&str]| with_drivers(directory.path(), &twice, arguments);
    let (_, listed, _) = squealmap(&["adapters"])?;
    assert_eq!(listed.matches("  kind      software").count(), 2, "{listed}");
    let name = listed.lines().next().ok_or("no name")?;
    let one = ["run", "belt.toml", "--backend", "gpu", "--adapter", name];
    let (code, _, err) = squealmap(&one)?;
    assert_eq!(code, Some(0), "{err}");
    // Both of them, each with a name in the manifest, and the same table.
    let (code, _, err) = squealmap(&[&one[..], &["--adapter", name, "-o", "both"]].concat())?;
    assert_eq!(code, Some(0), "{err}");
    let read = |path: &str| std::fs::read_to_string(directory.path().join(path));
    assert_eq!(read("both/map.csv")?, read("out/belt/map.csv")?);
    let manifest: serde_json::Value = serde_json::from_str(&read("both/manifest.json")?)?;
    let adapters = manifest["computation"]["response"]["adapter"].as_str().unwrap_or_default();
    assert_eq!(adapters.matches(name).count(), 2, "{adapters}");
    let thrice = [&one[..], &["--adapter", name, "--adapter", name, "-o", "thrice"]].concat();
    let (code, _, err) = squealmap(&thrice)?;
    assert_eq!(code, Some(2), "{err}");
    let few =
        format!("--adapter {name} asks for 3 adapters with that in their names, but there are 2; remove one");
    assert!(err.contains(&few), "{err}");
    let (code, _, err) = squealmap(&["run", "belt.toml", "--backend", "gpu", "--adapter", "abacus"])?;
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains(&format!("there are: {name}, {name}")), "{err}");
    let (code, _, err) = squealmap(&["run", "belt.toml", "--require-gpu"])?;
    assert_eq!(code, Some(2), "two software adapters are no GPU: {err}");
    Ok(())
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
    assert_eq!(output.status.code(), Some(0), "{err}");
    assert!(err.contains(" in strict f32: "), "{err}");
    let manifest = std::fs::read(directory.path().join("out/modes/manifest.json"))?;
    let manifest: serde_json::Value = serde_json::from_slice(&manifest)?;
    assert_eq!(manifest["computation"]["linear"]["strict"], true);
    Ok(())
}

fn cancelled() -> Result<(), Failed> {
    const CHUNK: usize = 1000;
    let mut spec = Spec::read("sweeps/paper_map.toml".as_ref())?;
    spec.analysis.response = false;
    let total = spec.grid.len();
    let (cancel, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let options =
        Options { backend: Backend::Gpu, chunk: Some(CHUNK), cancel: Some(&cancel), ..Options::default() };
    let whole = run::run(spec.clone(), &options, &|_| {})?;
    assert_eq!((whole.computed(), &whole.stopped), (total, &None));
    // In the third chunk; what it had finished by then is done to its end.
    let map = run::run(spec.clone(), &options, &|count| {
        if done.fetch_add(count, Ordering::Relaxed) + count > 2 * CHUNK {
            cancel.store(true, Ordering::Relaxed);
        }
    })?;
    assert_eq!((map.computed(), &map.stopped), (3 * CHUNK, &Some(Stopped::Cancelled)));
    assert_eq!(map.records[..3 * CHUNK], whole.records[..3 * CHUNK]);
    assert!(map.records[3 * CHUNK..].iter().all(|record| *record == Record::NOT_COMPUTED));
    let csv = String::from_utf8(results::csv::map_csv(&map)?)?;
    assert_eq!(csv.lines().count(), 1 + total);
    assert_eq!(csv.lines().filter(|line| line.ends_with(",not_computed")).count(), total - 3 * CHUNK);
    let manifest: serde_json::Value = serde_json::from_slice(&results::manifest::manifest_json(&map)?)?;
    assert_eq!((&manifest["complete"], &manifest["computation"]["computed"]), (&false.into(), &3000.into()));
    results::figure::map::map_svg(&map)?;
    // Before the first chunk there is nothing.
    match run::run(spec, &options, &|_| {}) {
        Err(squealmap::sweep::error::Error::OfEngine(Error::Cancelled { done: 0, total: of }))
            if of == total =>
        {
            Ok(())
        }
        other => Err(format!("{:?}", other.map(|map| map.computed())).into()),
    }
}

fn no_such_adapter() -> Result<(), Failed> {
    let (output, _directory) = squealmap(&["run", "modes.toml", "--backend", "gpu", "--adapter", "abacus"])?;
    let err = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("error: no adapter has `abacus` in its name; there are: "), "{err}");
    Ok(())
}

fn response() -> Result<(), Failed> {
    let (output, directory) = squealmap(&["run", "belt.toml", "--backend", "gpu"])?;
    let err = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{err}");
    let manifest = std::fs::read(directory.path().join("out/belt/manifest.json"))?;
    let manifest: serde_json::Value = serde_json::from_slice(&manifest)?;
    for (part, backend, precision) in [("linear", "cpu", "f64"), ("response", "gpu", "f32")] {
        let computed = &manifest["computation"][part];
        assert_eq!(
            (&computed["backend"], &computed["precision"]),
            (&backend.into(), &precision.into()),
            "{part}"
        );
        assert!(computed["method"].as_str().is_some_and(|method| !method.is_empty()), "{part}");
    }
    assert_eq!(manifest["computation"]["instances"], 4);
    Ok(())
}
