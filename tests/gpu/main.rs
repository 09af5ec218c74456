//! Tests that need an adapter, software or not. Without one each is shown as ignored with the reason; with
//! `SQUEALMAP_REQUIRE_GPU=1` each fails instead.

mod ahead;
#[path = "../suite/engine/fuzz/defect.rs"]
mod defect;
mod differences;
mod faults;
mod fuzz;
#[path = "../suite/instances.rs"]
mod instances;
mod linear;
mod probes;
mod response;
mod runs;
mod starts;
mod strict;
mod sweeps;
#[path = "../suite/twin.rs"]
mod twin;
#[path = "../suite/engine/fuzz/whole_range.rs"]
mod whole_range;
mod words;

use libtest_mimic::{Arguments, Failed, Trial};
use squealmap::engine::gpu::adapter::Adapter;

/// The variable that turns a missing adapter into a failure.
const REQUIRE: &str = "SQUEALMAP_REQUIRE_GPU";

/// A test's name and what it does.
type Case = (&'static str, fn() -> Result<(), Failed>);

/// Why a test is not run.
#[derive(Clone, Copy)]
enum Lack {
    /// A defect where an adapter is required.
    Adapter,
    /// A property of the adapter.
    F64,
    /// A property of the adapter.
    Strict,
    /// A property of the system.
    SoftwareDriver,
    /// Minutes on a software adapter; `--include-ignored` runs it.
    Time,
}

impl Lack {
    fn reason(self) -> &'static str {
        match self {
            Lack::Adapter => "no adapter",
            Lack::F64 => "no adapter with f64",
            Lack::Strict => "no adapter that is strict",
            Lack::SoftwareDriver => "no lavapipe",
            Lack::Time => "slow",
        }
    }
}

fn main() {
    let mut arguments = Arguments::from_args();
    // A software driver has all cores at work for one of them.
    arguments.test_threads.get_or_insert(1);
    let adapters = Adapter::all();
    let required = std::env::var_os(REQUIRE).is_some_and(|value| value == "1");
    let all = adapters.is_empty().then_some(Lack::Adapter);
    let f64 = all.or_else(|| (!adapters.iter().any(|one| one.describe().f64)).then_some(Lack::F64));
    let strict = all.or_else(|| (!adapters.iter().any(|one| one.describe().strict)).then_some(Lack::Strict));
    let software = runs::software_driver().is_none().then_some(Lack::SoftwareDriver);
    let slow = all.or(Some(Lack::Time));
    let groups = [
        (all, probes::CASES),
        (all, linear::CASES),
        (f64, linear::F64),
        (all, response::CASES),
        (all, sweeps::CASES),
        (all, ahead::CASES),
        (all, starts::CASES),
        (f64, sweeps::F64),
        (slow, sweeps::SLOW),
        (all, runs::CASES),
        (software, runs::SOFTWARE),
        (all, faults::CASES),
        (all, fuzz::CASES),
        (strict, strict::CASES),
        (strict.or(slow), strict::SLOW),
        (strict.or(f64).or(slow), strict::SLOW_F64),
        (strict, runs::STRICT),
        (strict.or(f64), strict::F64),
    ];
    let trials = groups.into_iter().flat_map(|(lack, cases)| {
        cases.iter().map(move |&(name, run)| match lack {
            None => Trial::test(name, run),
            Some(Lack::Adapter) if required => {
                Trial::test(name, || Err(format!("{REQUIRE}=1 but there is no adapter").into()))
            }
            Some(lack) => Trial::test(format!("{name} ({})", lack.reason()), run).with_ignored_flag(true),
        })
    });
    libtest_mimic::run(&arguments, trials.collect()).exit();
}
