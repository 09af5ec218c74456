//! Tests that need an adapter, software or not. Without one each is shown as ignored with the reason; with
//! `SQUEALMAP_REQUIRE_GPU=1` each fails instead.

mod faults;
#[path = "../suite/instances.rs"]
mod instances;
mod linear;
mod probes;
mod response;
mod runs;
mod strict;
mod words;

use libtest_mimic::{Arguments, Failed, Trial};
use squealmap::backend::gpu::adapter::Adapter;

/// The variable that turns a missing adapter into a failure.
const REQUIRE: &str = "SQUEALMAP_REQUIRE_GPU";

/// A test's name and what it does.
type Case = (&'static str, fn() -> Result<(), Failed>);

fn main() {
    let arguments = Arguments::from_args();
    let adapters = Adapter::all();
    let reason = if adapters.is_empty() { Some("no adapter") } else { None };
    let required = std::env::var_os(REQUIRE).is_some_and(|value| value == "1");
    let all = [probes::CASES, linear::CASES, response::CASES, runs::CASES, faults::CASES, strict::CASES];
    let trials = all.into_iter().flatten().map(|&(name, run)| match reason {
        None => Trial::test(name, run),
        Some(reason) if required => {
            Trial::test(name, move || Err(format!("{REQUIRE}=1 but there is {reason}").into()))
        }
        Some(reason) => Trial::test(format!("{name} ({reason})"), run).with_ignored_flag(true),
    });
    libtest_mimic::run(&arguments, trials.collect()).exit();
}
