//! No instance goes on for ever: the steps of a period and of a run are bounded, on every engine alike.

use std::sync::atomic::AtomicBool;

use crate::common::{constant, instance, paper, plan};
use crate::engines::Engine;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::march::Terms;
use squealmap::engine::lanes::outcomes::outcomes_on;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::reference::bounds::MAX_STEPS_PER_PERIOD;
use squealmap::engine::scene::MOST_STEPS;
use squealmap::model::Param;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;
use squealmap::sweep::estimate::estimate;
use squealmap::sweep::spec::Spec;

/// Dampers that stop a motion within a millionth of a period: millions of steps of it.
fn stiff() -> Instance {
    instance(constant(0.3), &[(Param::BeltVelocity, 3.0), (Param::C1, 1e9), (Param::C2, 1e9)])
}

/// Several stretches of lanes in a period, so that their steps have to be added up.
fn in_fine_steps() -> Plan {
    Plan { settle: Duration::Periods(20.0), measure: Duration::Periods(10.0), ..plan(0.0, 1.0, 400) }
}

#[test]
fn a_period_has_no_more_steps_than_it_may() {
    for engine in [Engine::Reference, Engine::CpuF64, Engine::KernelF64] {
        let outcome = engine.run(&stiff(), &in_fine_steps());
        assert_eq!(outcome.status, Status::StepTooLarge, "{}", engine.name());
        let most = u64::from(MAX_STEPS_PER_PERIOD);
        assert!((most..most + 2).contains(&outcome.steps), "{}: {} steps", engine.name(), outcome.steps);
    }
}

fn within<T: Lanes>(instance: &Instance, plan: &Plan, most_steps: u32) -> Outcome {
    let terms = Terms { most_steps, ..Terms::default() };
    let cancel = AtomicBool::new(false);
    outcomes_on::<T>(std::slice::from_ref(instance), plan, terms, &cancel).expect("nobody stops it")[0]
}

/// A belt that carries two undamped modes for ever, a run until settled that may take as long as it likes.
#[test]
fn a_run_has_no_more_steps_than_it_may() {
    let mut instance = paper(0.4, 0.4, 3.0);
    instance.params.set(Param::C1, 0.0);
    instance.params.set(Param::C2, 0.0);
    let fixed = Plan { settle: Duration::Periods(1e5), ..plan(0.0, 1.0, 12) };
    let auto = Plan {
        settle: Duration::Periods(0.0),
        settle_limit: Some(Duration::Periods(1e9)),
        measure: Duration::Periods(20.0),
        ..fixed
    };
    for (name, plan) in [("fixed", fixed), ("auto", auto)] {
        for outcome in [within::<f64>(&instance, &plan, 3000), within::<f32>(&instance, &plan, 3000)] {
            assert_eq!(outcome.status, Status::StepTooLarge, "{name}: {} steps", outcome.steps);
            assert!((3000..3002).contains(&outcome.steps), "{name}: {} steps", outcome.steps);
        }
    }
}

#[test]
fn a_plan_of_more_steps_is_refused_before_the_run() {
    let periods = 1.01 * f64::from(MOST_STEPS) / 12.0;
    let plan = Plan { settle: Duration::Periods(periods), ..plan(0.0, 1.0, 12) };
    for engine in Engine::ALL {
        let outcome = engine.run(&paper(0.4, 0.3, 3.0), &plan);
        assert_eq!((outcome.status, outcome.steps), (Status::StepTooLarge, 0), "{}", engine.name());
    }
}

/// What a sweep would cost is told from some of its first steps, however many it has.
#[test]
fn an_estimate_is_cut_short() {
    let text = "[model]\nk2 = 1e13\n[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n[response]\n\
                settle = \"100 periods\"\nmeasure = \"100 periods\"\n";
    let spec = Spec::parse(text, "stiff.toml", "".as_ref()).expect("a valid sweep");
    let made = estimate(&spec);
    assert_eq!((made.sampled, made.cut_short), (1, 1));
    // A period has some 40 000 steps.
    assert!((4e6..=f64::from(MOST_STEPS)).contains(&made.steps), "{:e} steps", made.steps);
}
