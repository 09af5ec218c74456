//! The instruction set changes no bit of a result, or its name stands in the method, which a tile is known by.

use std::sync::atomic::AtomicBool;

use crate::common::plan;
use crate::engine::kernel_response::periods;
use crate::engine::simd::{of_every_law, single_masses};
use pulp::Arch;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::march::Terms;
use squealmap::engine::lanes::outcomes::outcomes_on;
use squealmap::engine::lanes::records::{response, rounding};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::engine::precision::Precision;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// Every instruction set that this program may be run with, `None` where the machine has none.
pub(crate) fn levels() -> Vec<(&'static str, Option<Arch>)> {
    let mut levels = vec![("scalar", Some(Arch::Scalar))];
    #[cfg(target_arch = "x86_64")]
    levels.extend([
        ("AVX2", pulp::x86::V3::try_new().map(Arch::V3)),
        ("AVX-512", pulp::x86::V4::try_new().map(Arch::V4)),
    ]);
    #[cfg(not(target_arch = "x86_64"))]
    levels.push(("widest", Some(Arch::new())));
    levels
}

/// All numbers of some outcomes, as text that reads back to the same bits.
fn bits(outcomes: &[Outcome]) -> Vec<String> {
    outcomes.iter().map(|outcome| format!("{outcome:?}")).collect()
}

fn run<T: Lanes>(instances: &[Instance], plan: &Plan, instructions: Arch) -> Vec<Outcome> {
    let terms = Terms { instructions, ..Terms::default() };
    outcomes_on::<T>(instances, plan, terms, &AtomicBool::new(false)).expect("nobody stops it")
}

/// The same bits where the method has the same name, whatever the widths of the registers.
fn agree<T: Lanes>(name: &str, instances: &[Instance], plan: &Plan) {
    let mut before: Vec<(&str, Arch, Vec<String>)> = Vec::new();
    for (level, arch) in levels() {
        let Some(arch) = arch else {
            eprintln!("NOT RUN: {name} with {level}, which this machine does not have");
            continue;
        };
        let made = run::<T>(instances, plan, arch);
        assert!(made.iter().filter(|one| one.status == Status::Ok).count() > made.len() / 2, "{name}");
        let made = bits(&made);
        for (other, of_other, theirs) in &before {
            let differ = theirs.iter().zip(&made).filter(|(a, b)| a != b).count();
            println!("{name}: {other} against {level}: {differ} of {} differ", made.len());
            let same_name = rounding(*of_other) == rounding(arch);
            assert!(differ == 0 || !same_name, "{name}: {differ} differ, {other} against {level}");
        }
        before.push((level, arch, made));
    }
}

/// A method that has another name makes other tiles.
#[test]
fn the_method_names_how_products_are_rounded() {
    let method = response(Precision::F64, 12).method;
    assert!(method.ends_with(rounding(Arch::new())), "{method}");
    assert!(!rounding(Arch::Scalar).is_empty());
}

#[test]
fn no_bit_depends_on_the_instruction_set() {
    let short = Plan { settle: Duration::Periods(8.0), measure: Duration::Periods(6.0), ..periods() };
    let auto = Plan {
        settle: Duration::Periods(0.0),
        settle_limit: Some(Duration::Periods(60.0)),
        measure: Duration::Periods(8.0),
        ..plan(0.0, 1.0, 12)
    };
    let mode = Plan { start: StartKind::Mode, ..short };
    for (name, plan) in [("kick", short), ("auto", auto), ("mode", mode)] {
        for (of, instances) in [("every law", of_every_law(240)), ("single masses", single_masses(120))] {
            agree::<f64>(&format!("{name}, {of}, f64"), &instances, &plan);
            agree::<f32>(&format!("{name}, {of}, f32"), &instances, &plan);
        }
    }
}
