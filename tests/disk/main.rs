//! Every operation on the disk fails once, in every way: what is left never lies, and the same command ends as if nothing
//! had happened.
//!
//! The program runs in this test with another disk behind its door ([`faulty`]). For each command ([`scenario`]) an
//! undisturbed run counts the operations; then each is made to fail. `cargo test` takes one kind of fault for each
//! operation, in turn, of the commands that take few; `-- --ignored long_` that of the others, and `-- --ignored way` all
//! kinds, which takes minutes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod faulty;
mod judge;
mod scenario;

use std::process::ExitCode;

use libtest_mimic::{Arguments, Trial};

use faulty::Faulty;
use scenario::Scenario;

fn main() -> ExitCode {
    if let Some(faulty) = Faulty::asked_for() {
        squealmap::disk::put_in_place(Box::new(faulty));
        return squealmap::cli::main(None, std::env::args_os());
    }
    let trial = |scenario: Scenario, all: bool| {
        let is_long = !all && scenario.is_long();
        let [before, behind] = [if is_long { "long_" } else { "" }, if all { "_in_every_way" } else { "" }];
        let name = format!("{before}{}{behind}", scenario.name());
        Trial::test(name, move || judge::judge(scenario, all).map_err(Into::into))
            .with_ignored_flag(all || is_long)
    };
    let some = Scenario::ALL.into_iter().map(|scenario| trial(scenario, false));
    let all = Scenario::ALL.into_iter().map(|scenario| trial(scenario, true));
    let planted = judge::PLANTED.map(|(name, plant)| Trial::test(name, move || plant().map_err(Into::into)));
    let trials = some.chain(all).chain(planted).collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}
