//! What tiles cost beside the computation; measured, not asserted.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

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

/// The times of a round: the records of every tile computed and dropped; the same into a directory.
fn round(spec: &Spec) -> [Duration; 2] {
    let precision = Some(Precision::F32);
    let options = Options { backend: Backend::Cpu, precision, ..Options::default() };
    let mut solver = Solver::new(spec, &options).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let description = Description::new(spec, solver.computations(), TILE);
    let store = Store::begin(directory.path(), description, &|_| {}).unwrap();
    let tiling = store.description.tiling;
    let began = Instant::now();
    for number in 0..tiling.count() {
        std::hint::black_box(solver.records(tiling.bounds(number), &|_| {}).unwrap());
    }
    let computed = began.elapsed();
    let watch = Watch { cancel: &AtomicBool::new(false), progress: &|_| {}, note: &|_| {} };
    let all: Vec<usize> = (0..tiling.count()).collect();
    let began = Instant::now();
    let filled = fill(&store, &mut solver, &all, watch).unwrap();
    let kept = began.elapsed();
    assert_eq!((filled.computed, store.done().unwrap()), (spec.grid.len(), tiling.count()));
    [computed, kept]
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
        let rounds: Vec<[f64; 2]> = (0..5).map(|_| round(&spec).map(|time| time.as_secs_f64())).collect();
        for [computed, kept] in &rounds {
            println!(
                "{name}: computed {computed:.2} s, into tiles {kept:.2} s, {:+.1} %",
                100.0 * (kept / computed - 1.0)
            );
        }
        let best = |k: usize| rounds.iter().map(|round| round[k]).fold(f64::INFINITY, f64::min);
        println!(
            "{name}: best of each {:.2} s and {:.2} s, {:+.1} %",
            best(0),
            best(1),
            100.0 * (best(1) / best(0) - 1.0)
        );
    }
}
