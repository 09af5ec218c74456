//! What the host does for each instance beside the kernels: processor time, allocations, bytes to and from the device, memory;
//! how long the device computes by its own clock and how long threads wait for it, and how busy the lanes are. On the map of
//! `cargo bench --bench map`, with all columns.
//!
//! Processor time is that of the program's own threads: the pool's and the one that waits for the device. What a software driver
//! does on threads of its own, kernels and copies, is told apart.

use std::error::Error;
use std::sync::atomic::AtomicBool;

use squealmap::engine::Engine;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::records::Gpu;
use squealmap::engine::precision::Precision;
use squealmap::sweep::spec::Spec;
use squealmap::version::COMMIT;

use crate::date::date;
use crate::kept::keep;
use crate::ledger::{Ledger, forget_peak, own, peak_memory};
use crate::work::Work;

/// The cases: their names, and their sections of a sweep file.
pub(crate) const CASES: [(&str, &str); 4] = [
    ("two periods", "[response]\nsettle = \"1 periods\"\nmeasure = \"1 periods\"\n"),
    ("140 periods", "[response]\nsettle = \"100 periods\"\nmeasure = \"40 periods\"\n"),
    ("auto", "[response]\nsettle = \"auto\"\n"),
    ("linear", ""),
];

const HEADER: [&str; 17] = [
    "adapter",
    "case",
    "instances",
    "chunk",
    "date",
    "commit",
    "wall_s",
    "device_s",
    "waited_s",
    "driver_cpu_s",
    "host_us",
    "allocations",
    "bytes_up",
    "bytes_back",
    "peak_mib",
    "steps_of_warps_percent",
    "lanes_held_percent",
];

/// Columns that say which case a row is.
const KEY: usize = 4;

/// Instances where none are asked for.
const SIZE: usize = 40_000;

/// Instances before the measured ones: they bring every kernel to be compiled.
const WARM: usize = 600;

/// Bytes of a MiB.
pub(crate) const MIB: f64 = 1024.0 * 1024.0;

/// Measures, prints and keeps the rows; of `arguments` the first is the number of instances, the second a case, the third the
/// most instances of a chunk.
pub(crate) fn run(arguments: &[&str]) -> Result<(), Box<dyn Error>> {
    let number = |place: usize| arguments.get(place).map(|text| text.parse::<usize>()).transpose();
    let (size, chunk) = (number(0)?.unwrap_or(SIZE), number(2)?);
    println!("| {} |\n|{}", HEADER.join(" | "), "---|".repeat(HEADER.len()));
    // The pool begins before any thread of a driver.
    rayon::broadcast(|_| ());
    let own = own();
    let mut rows = Vec::new();
    for (name, section) in CASES {
        if arguments.get(1).is_some_and(|asked| *asked != name) {
            continue;
        }
        let [few, spec] = [WARM, size].map(|size| spec(size, section));
        let (few, spec) = (few?, spec?);
        let device = Device::open(&Adapter::best(Precision::F32, None)?, Precision::F32)?;
        let mut engine = Gpu::new(vec![device.clone()], chunk);
        let never = AtomicBool::new(false);
        engine.records(&few, 0..few.grid.len(), &never, &|_| {})?;
        let count = spec.grid.len();
        let before = device.metered();
        forget_peak();
        let ledger = Ledger::open();
        // Range by range, as the program does, without checks and tiles.
        let part = engine.busy_with(count, 1);
        for first in (0..count).step_by(part) {
            let range = first..count.min(first + part);
            let ahead = engine.ahead(&spec).min(count - range.end);
            engine.records_ahead(&spec, range, ahead, &never, &|_| {})?;
        }
        let taken = ledger.close(&own);
        let peak = peak_memory();
        let after = device.metered();
        let each = |of: f64, digits: usize| format!("{:.digits$}", of / count as f64);
        let share = |part: u64, whole: u64| {
            if whole == 0 { String::new() } else { format!("{:.1}", 100.0 * part as f64 / whole as f64) }
        };
        let fields = vec![
            device.describe().name,
            name.to_owned(),
            count.to_string(),
            chunk.map_or("own".to_owned(), |chunk| chunk.to_string()),
            date(),
            COMMIT.unwrap_or("unknown").to_owned(),
            format!("{:.2}", taken.wall.as_secs_f64()),
            format!("{:.2}", (after.computed - before.computed) as f64 * 1e-9),
            format!("{:.2}", (after.waited - before.waited) as f64 * 1e-9),
            format!("{:.2}", taken.driver),
            each(taken.host * 1e6, 1),
            each(taken.allocations as f64, 1),
            each((after.up - before.up) as f64, 0),
            each((after.back - before.back) as f64, 0),
            format!("{:.0}", peak / MIB),
            share(after.steps - before.steps, after.of_warps - before.of_warps),
            share(after.lanes - before.lanes, after.room - before.room),
        ];
        println!("| {} |", fields.join(" | "));
        rows.push(fields);
    }
    if rows.is_empty() {
        return Err(no_case());
    }
    println!("kept in {}", keep("gpu-host.csv", &HEADER, KEY, rows)?.display());
    Ok(())
}

/// Why a case that is asked for is none.
pub(crate) fn no_case() -> Box<dyn Error> {
    format!("the case has to be one of: {}", CASES.map(|(name, _)| name).join(", ")).into()
}

/// The map nearest to `size` instances, run as a section says; without one only eigenvalues.
pub(crate) fn spec(size: usize, section: &str) -> Result<Spec, Box<dyn Error>> {
    let of_map = Work::of_size(size).spec()?;
    let analysis = if section.is_empty() { "analysis = [\"linear\"]\n" } else { "" };
    let text = format!(
        "{analysis}[friction]\nlaw = \"bilinear\"\nmu_s = 0.1\nmu_d = 0.1\nknee_velocity = 5.0\n\
         [belt]\nbelt_velocity = 1.0\n{section}"
    );
    let mut spec = Spec::parse(&text, "benches/gpu", ".".as_ref())?;
    spec.grid = of_map.grid;
    // What is measured is the engine.
    spec.analysis.checked = false;
    Ok(spec)
}
