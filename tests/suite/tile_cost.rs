//! What tiles cost beside the computation; measured, not asserted.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::time::Instant;

use squealmap::backend::choice::{Backend, Options};
use squealmap::backend::solver::Solver;
use squealmap::kernel::source::Precision;
use squealmap::spec::Spec;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::tiling::TILE;

/// A sweep of both friction coefficients at four belt velocities, as the benchmarks have it.
fn sweep(analysis: &str, points: [usize; 2], response: &str) -> String {
    format!(
        "analysis = [\"{analysis}\"]\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5.0\n[axes]\n\
         mu_s = {{ from = 0.0, to = 0.6, points = {} }}\nmu_d = {{ from = 0.0, to = 0.6, points = {} }}\n\
         belt_velocity = {{ values = [0.5, 1.0, 3.0, 6.0] }}\n{response}",
        points[0], points[1]
    )
}

/// Processor time of this process so far, s: other programs that share the machine do not count. 0 where the system
/// does not say it as Linux does.
fn processor() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |at: usize| fields.get(at).and_then(|text| text.parse::<f64>().ok()).unwrap_or(0.0);
    // User and system time, in hundredths of a second.
    (ticks(11) + ticks(12)) / 100.0
}

/// Processor time of this thread so far, s, to the nanosecond on Linux.
fn thread() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|text| text.parse::<f64>().ok()).unwrap_or(0.0) * 1e-9
}

/// Processor time of computing all tiles, and of encoding, hashing and writing them; wall time of that.
fn round(spec: &Spec) -> [f64; 3] {
    let precision = Some(Precision::F32);
    let options = Options { backend: Backend::Cpu, precision, ..Options::default() };
    let mut solver = Solver::new(spec, &options).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let description = Description::new(spec, solver.computations(), TILE);
    let store = Store::begin(directory.path(), description, &|_| {}).unwrap();
    let tiling = store.description.tiling;
    let mut sums = [0.0; 3];
    for number in 0..tiling.count() {
        let before = processor();
        let computed = solver.records(tiling.bounds(number), &|_| {}).unwrap();
        sums[0] += processor() - before;
        let (before, began) = (thread(), Instant::now());
        let claim = store.claim(number).unwrap().unwrap();
        store.write(claim, number, &computed.records).unwrap();
        sums[1] += thread() - before;
        sums[2] += began.elapsed().as_secs_f64();
    }
    assert_eq!(store.done().unwrap(), tiling.count());
    sums
}

#[test]
#[ignore = "takes some minutes: cargo test --release --test suite -- --ignored --nocapture tile_cost"]
fn tile_cost() {
    let response = "[start]\nkind = \"kick\"\nstart_velocity = 0.01\n[response]\nsettle = \"100 periods\"\n\
        measure = \"40 periods\"\nsteps_per_period = 4\n";
    for (name, text) in [
        ("1e7 linear", sweep("linear", [2500, 1000], "")),
        ("1e6 response, f32, 4 steps", sweep("response", [500, 500], response)),
    ] {
        let spec = Spec::parse(&text, "cost.toml", ".".as_ref()).unwrap();
        for _ in 0..3 {
            let [computed, written, wall] = round(&spec);
            let tiles = spec.grid.len().div_ceil(TILE) as f64;
            println!(
                "{name}: processor time {computed:.2} s, of tiles {written:.3} s, {:+.1} %; a tile takes {:.1} ms",
                100.0 * written / computed,
                1e3 * wall / tiles
            );
        }
    }
}
