//! The shipped map on the best adapter: instances per second, and its agreement with the f64 reference.
//!
//! The log is printed and kept under `benches/results/`. `SQUEALMAP_BENCH_POINTS` sets the friction coefficients on each
//! axis (default 41, the shipped map; the reference takes 4 ms of a core per instance).

use std::error::Error;
use std::fmt::Write;
use std::time::SystemTime;

use squealmap::engine::backend::Backend;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::sweep::map::Map;
use squealmap::sweep::run as sweep_run;
use squealmap::sweep::spec::Spec;
use squealmap::version::{COMMIT, VERSION};

use crate::differences::Differences;

/// Runs of which the fastest counts.
const RUNS: usize = 3;

/// Measures, prints and keeps the log.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let points = std::env::var("SQUEALMAP_BENCH_POINTS").unwrap_or_else(|_| "41".to_owned());
    let text = std::fs::read_to_string("sweeps/paper_map.toml")?;
    let text = text.replace("points = 41", &format!("points = {points}"));
    let mut spec = Spec::parse(&text, "paper_map.toml", "sweeps".as_ref())?;
    // What is measured is the engine.
    spec.analysis.checked = false;
    let adapter = Adapter::best(Precision::F32, None)?.describe();
    let seconds = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH)?.as_secs();
    let mut log = String::new();
    writeln!(log, "squealmap {VERSION}, commit {}, unix time {seconds}", COMMIT.unwrap_or("unknown"))?;
    writeln!(log, "adapter: {adapter}")?;
    writeln!(log, "paper_map with {points} coefficients per axis: {} instances", spec.grid.len())?;

    let run = |backend, precision, strict| {
        let options = Options { backend, precision, strict, ..Options::default() };
        sweep_run::run(spec.clone(), &options, &|_| {})
    };
    let reference = run(Backend::Reference, None, false)?;
    writeln!(log, "\nreference, f64 on {} threads: {}", reference.provenance.threads, rate(&reference))?;
    let mut cases = vec![("f32", Precision::F32, false)];
    if adapter.strict {
        cases.push(("f32 strict", Precision::F32, true));
    }
    if adapter.f64 {
        cases.push(("f64", Precision::F64, false));
    }
    for (name, precision, strict) in cases {
        let mut best = run(Backend::Gpu, Some(precision), strict)?;
        for _ in 1..RUNS {
            let again = run(Backend::Gpu, Some(precision), strict)?;
            if again.records != best.records {
                return Err("two runs differ".into());
            }
            if again.provenance.elapsed < best.provenance.elapsed {
                best = again;
            }
        }
        writeln!(log, "\n{name}: {}\n{}", rate(&best), Differences::new(&best, &reference))?;
    }
    print!("{log}");
    let name: String = adapter.name.chars().filter(char::is_ascii_alphanumeric).collect();
    std::fs::create_dir_all("benches/results")?;
    std::fs::write(format!("benches/results/gpu-{}.txt", name.to_lowercase()), log)?;
    Ok(())
}

/// How fast a map was computed, compilation and transfers included.
fn rate(map: &Map) -> String {
    let seconds = map.provenance.elapsed.as_secs_f64();
    let steps: u64 =
        map.records.iter().filter_map(|record| record.outcome.as_ref()).map(|outcome| outcome.steps).sum();
    format!(
        "{seconds:.2} s, {:.0} instances/s, {:.2e} steps/s",
        map.records.len() as f64 / seconds,
        steps as f64 / seconds
    )
}
