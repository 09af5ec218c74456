//! The most memory that a sweep takes whose lanes, ranges and instances ahead are as many as on hardware, with checks and tiles: on
//! any device, of a software one with the buffers that a card would have in its own memory.

use std::error::Error;
use std::sync::atomic::AtomicBool;

use squealmap::engine::backend::Backend;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::records::Gpu;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::fill::{Watch, fill};
use squealmap::store::tiling::TILE;
use squealmap::sweep::solver::Solver;

use crate::host::{CASES, MIB, no_case, spec};
use crate::ledger::{forget_peak, peak_memory};

/// Instances where none are asked for: more than are in work at a time.
const SIZE: usize = 1_500_000;

/// Measures and prints; of `arguments` the first is the number of instances, the second a case.
pub(crate) fn run(arguments: &[&str]) -> Result<(), Box<dyn Error>> {
    let size = arguments.first().map_or(Ok(SIZE), |text| text.parse())?;
    let asked = arguments.get(1).copied().unwrap_or(CASES[0].0);
    let (case, section) = CASES.into_iter().find(|(name, _)| *name == asked).ok_or_else(no_case)?;
    let mut spec = spec(size, section)?;
    spec.analysis.checked = true;
    let device = Device::open(&Adapter::best(Precision::F32, None)?, Precision::F32)?;
    let name = device.describe().name;
    let engine = Gpu::new(vec![device], None).as_hardware();
    let options = Options { backend: Backend::Gpu, ..Options::default() };
    let mut solver = Solver::with_engine(&spec, &options, Box::new(engine));
    let directory = tempfile::tempdir()?;
    let description = Description::new(&spec, solver.computations(), TILE);
    let store = Store::begin(directory.path(), description, &|_| {})?;
    let tiles: Vec<usize> = (0..store.description.tiling.count()).collect();
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, progress: &|_| {}, note: &|_| {} };
    forget_peak();
    let before = peak_memory();
    let filled = fill(&store, &mut solver, &tiles, None, watch)?;
    println!("| adapter | case | instances | seconds | MiB before | most MiB |\n|---|---|---|---|---|---|");
    println!(
        "| {name} | {case} | {} | {:.1} | {:.0} | {:.0} |",
        filled.computed,
        filled.elapsed.as_secs_f64(),
        before / MIB,
        peak_memory() / MIB
    );
    Ok(())
}
