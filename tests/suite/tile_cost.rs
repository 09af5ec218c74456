//! What tiles cost beside the computation; measured, not asserted.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use squealmap::backend::choice::{Backend, Options};
use squealmap::backend::solver::Solver;
use squealmap::kernel::source::Precision;
use squealmap::spec::Spec;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::fill::{Watch, fill};
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

/// Processor and wall time of what is done, s.
fn timed(work: impl FnOnce()) -> [f64; 2] {
    let (before, began) = (processor(), Instant::now());
    work();
    [processor() - before, began.elapsed().as_secs_f64()]
}

/// Times of computing all tiles, and of filling a directory with them.
fn round(spec: &Spec) -> [[f64; 2]; 2] {
    let precision = Some(Precision::F32);
    let options = Options { backend: Backend::Cpu, precision, ..Options::default() };
    let mut solver = Solver::new(spec, &options).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let description = Description::new(spec, solver.computations(), TILE);
    let store = Store::begin(directory.path(), description, &|_| {}).unwrap();
    let tiling = store.description.tiling;
    let pure = timed(|| {
        for number in 0..tiling.count() {
            drop(solver.records(tiling.bounds(number), &|_| {}).unwrap());
        }
    });
    let wanted: Vec<usize> = (0..tiling.count()).collect();
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, progress: &|_| {}, note: &|_| {} };
    let filled = timed(|| drop(fill(&store, &mut solver, &wanted, None, watch).unwrap()));
    assert_eq!(store.done().unwrap(), tiling.count());
    [pure, filled]
}

/// Rounds in turn: other programs share the machine.
const ROUNDS: usize = 8;

#[test]
#[ignore = "takes some minutes: cargo test --release --test suite -- --ignored --nocapture tile_cost"]
fn tile_cost() {
    let response = "[start]\nkind = \"kick\"\nstart_velocity = 0.01\n[response]\nsettle = \"100 periods\"\n\
        measure = \"40 periods\"\nsteps_per_period = 4\n";
    for (name, text) in [
        ("5e6 linear", sweep("linear", [2500, 500], "")),
        ("5e5 response, f32, 4 steps", sweep("response", [500, 250], response)),
    ] {
        let spec = Spec::parse(&text, "cost.toml", ".".as_ref()).unwrap();
        let rounds: Vec<_> = (0..ROUNDS).map(|_| round(&spec)).collect();
        for (time, which) in [(0, "processor"), (1, "wall")] {
            let of = |work: usize| rounds.iter().map(move |round| round[work][time]);
            let least = [0, 1].map(|work| of(work).fold(f64::INFINITY, f64::min));
            let mean = [0, 1].map(|work| of(work).sum::<f64>() / ROUNDS as f64);
            for (name_of, [pure, filled]) in [("least", least), ("mean", mean)] {
                println!(
                    "{name}, {which}, {name_of} of {ROUNDS}: {pure:.2} s, with tiles {filled:.2} s ({:+.1} %)",
                    100.0 * (filled / pure - 1.0)
                );
            }
        }
    }
}
