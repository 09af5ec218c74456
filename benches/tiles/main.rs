//! `cargo bench --bench tiles`: what tiles cost beside the computation, in processor time.

mod overhead;

use std::error::Error;
use std::sync::atomic::AtomicBool;

use overhead::overhead;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::fill::{Watch, fill};
use squealmap::store::tiling::TILE;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;

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

/// Tiles computed alone and with the directory in turn: some tenths of a second of processors, of which the system's
/// clock counts hundredths.
const GROUP: usize = 4;

/// Processor time of computing all tiles of a sweep alone, and of filling a directory with them, s, group by group in turn:
/// the machine, which other programs share, is as fast for the one as for the other.
fn costs(spec: &Spec) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let precision = Some(Precision::F32);
    let options = Options { backend: Backend::Cpu, precision, ..Options::default() };
    let mut solver = Solver::new(spec, &options)?;
    let directory = tempfile::tempdir()?;
    let description = Description::new(spec, solver.computations(), TILE);
    let store = Store::begin(directory.path(), description, &|_| {})?;
    let tiling = store.description.tiling;
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, progress: &|_| {}, note: &|_| {} };
    let tiles: Vec<usize> = (0..tiling.count()).collect();
    let mut costs = Vec::new();
    for (turn, group) in tiles.chunks_exact(GROUP).enumerate() {
        let mut cost = [0.0; 2];
        // Neither is always the first.
        for what in [turn % 2, 1 - turn % 2] {
            let before = processor();
            if what == 0 {
                for &number in group {
                    drop(solver.records(tiling.bounds(number), &|_| {})?);
                }
            } else {
                drop(fill(&store, &mut solver, group, None, watch)?);
            }
            cost[what] = processor() - before;
        }
        costs.push(cost);
    }
    assert_eq!(store.done()?, costs.len() * GROUP);
    Ok(costs)
}

fn main() -> Result<(), Box<dyn Error>> {
    let response = "[start]\nkind = \"kick\"\nstart_velocity = 0.01\n[response]\nsettle = \"100 periods\"\n\
        measure = \"40 periods\"\nsteps_per_period = 4\n";
    for (name, text) in [
        ("2e7 linear", sweep("linear", [2500, 2000], "")),
        ("1e6 response, f32, 4 steps", sweep("response", [500, 500], response)),
    ] {
        let spec = Spec::parse(&text, "cost.toml", ".".as_ref())?;
        let costs = costs(&spec)?;
        let [share, error] = overhead(&costs);
        let alone: f64 = costs.iter().map(|cost| cost[0]).sum();
        println!(
            "{name}: {alone:.1} s of processors alone, with tiles {:+.1} % ± {:.1} %",
            100.0 * share,
            100.0 * error
        );
    }
    Ok(())
}
