//! `cargo bench --bench gpu`: the kernels as GPUs would run them.
//!
//! | option | what it does |
//! |---|---|
//! | none | what every compiler that is installed makes of every kernel, into `benches/results/gpu-pipelines.csv`; where there is a hardware GPU the shipped map on it, too |
//! | `--lockstep` | how well the march fills the warps of a GPU, by its twin, into `benches/results/gpu-lockstep.csv` |
//! | `--host [INSTANCES [CASE [CHUNK]]]` | what the host does for each instance, and how busy the lanes are, into `benches/results/gpu-host.csv` |
//! | `--memory [INSTANCES [CASE]]` | the most memory of a sweep with checks and tiles that takes as much at once as on hardware |
//! | `--alone [INSTANCES]` | that by itself, without a device beside it |
//! | `--projection` | from these, how long a large sweep takes on named cards, into `benches/results/gpu-projection.csv` |
//! | `--map` | the shipped map on the best adapter alone |
//! | `--check` | fails where the distribution's compiler needs more than `benches/gpu/limits.csv` allows |
//! | `--keep-limits` | writes that file |
//!
//! docs/gpu.md says how the compilers are installed. None of them needs a card.

mod alone;
mod compilers;
mod cuda;
#[path = "../map/date.rs"]
mod date;
#[path = "../../tests/gpu/differences.rs"]
mod differences;
mod driver;
mod figures;
mod host;
#[path = "../map/kept.rs"]
mod kept;
mod kernels;
mod ledger;
mod lockstep;
mod map;
mod memory;
mod projection;
mod ratchet;
mod rows;
#[path = "../../tests/suite/twin.rs"]
#[expect(dead_code, reason = "the tests take more of it")]
mod twin;
#[path = "../map/work.rs"]
#[expect(dead_code, reason = "that bench takes more of it")]
mod work;

use std::error::Error;
use std::path::Path;

use compilers::Compiler;
use ratchet::{Limits, Verdict};
use rows::Row;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::precision::Precision;

#[global_allocator]
static COUNTING: ledger::Counting = ledger::Counting;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|one| one != "--bench").collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["--of-driver", spirv] => driver::print(Path::new(spirv)),
        [] => {
            let rows = measured(|_| true)?;
            println!("kept in {}", rows::keep(&rows)?.display());
            if Adapter::best(Precision::F32, None).is_ok_and(|adapter| !adapter.is_software()) {
                map::run()?;
            }
            Ok(())
        }
        ["--lockstep", ..] => lockstep::run(&arguments[1..]),
        ["--map"] => map::run(),
        ["--host", ..] => host::run(&arguments[1..]),
        ["--memory", ..] => memory::run(&arguments[1..]),
        ["--alone", ..] => alone::run(&arguments[1..]),
        ["--projection"] => projection::run(),
        ["--check"] => check(),
        ["--keep-limits"] => {
            let rows = measured(Compiler::is_of_distribution)?;
            println!("kept in {}", Limits::write(&rows)?.display());
            Ok(())
        }
        _ => Err(format!(
            "{} is no option: --lockstep, --host, --memory, --alone, --projection, --map, --check, --keep-limits or none",
            arguments.join(" ")
        )
        .into()),
    }
}

/// The figures of every kernel by the compilers that are wanted and installed, printed on the way.
fn measured(wanted: impl Fn(&Compiler) -> bool) -> Result<Vec<Row>, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let mut rows = Vec::new();
    println!("{}", rows::head());
    for compiler in compilers::ALL.iter().filter(|one| wanted(one)) {
        if let Some(why) = compiler.missing() {
            println!("NOT RUN: {}, as {why}", compiler.name);
            continue;
        }
        for variant in kernels::all() {
            if variant.precision == Precision::F64 && !compiler.has_f64() {
                println!("NOT RUN: {} in f64, which {} does not have", variant.name, compiler.name);
                continue;
            }
            match compiler.compile(&variant, folder.path()) {
                Ok((version, figures)) => {
                    let row = Row {
                        kernel: variant.name.to_owned(),
                        scalar: variant.precision.to_string(),
                        compiler: compiler.name.to_owned(),
                        version,
                        figures,
                    };
                    println!("{}", row.line());
                    rows.push(row);
                }
                Err(why) => {
                    println!("FAILED: {} in {} on {}: {why}", variant.name, variant.precision, compiler.name);
                }
            }
        }
    }
    Ok(rows)
}

/// Holds the kernels against their limits.
fn check() -> Result<(), Box<dyn Error>> {
    let limits = Limits::read()?;
    let rows = measured(Compiler::is_of_distribution)?;
    let mut faults = Vec::new();
    for row in &rows {
        match limits.judge(row) {
            Verdict::Kept => limits.sees_rises(row)?,
            Verdict::OtherVersion(versions) => println!(
                "NOT HELD: `{}` in {} on {}, as its limits are those of {versions} and this is {}",
                row.kernel, row.scalar, row.compiler, row.version
            ),
            Verdict::Unknown => {
                faults.push(format!("`{}` in {} on {} has no limit", row.kernel, row.scalar, row.compiler));
            }
            Verdict::Risen(risen) => faults.extend(risen),
        }
    }
    if faults.is_empty() {
        println!("{} kernels are within their limits", rows.len());
        return Ok(());
    }
    Err(format!(
        "{}: make the kernel smaller again, or, if what it gained is worth that, write the new limits with \
         `cargo bench --bench gpu -- --keep-limits` and say in the commit what was gained",
        faults.join("; ")
    )
    .into())
}
