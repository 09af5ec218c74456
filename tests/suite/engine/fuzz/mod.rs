//! Random sweeps: over the whole range of every parameter nothing panics, hangs, is left out or is told as `ok` with a
//! number that is none; and what is no sweep is refused in a sentence.
//!
//! Some seconds in a run of the suite; `SQUEALMAP_FUZZ_SECONDS=3600` for longer.

mod defect;
mod text;
mod whole_range;

use std::io::Write as _;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use proptest::prelude::*;
use proptest::test_runner::{Config, TestError, TestRunner};
use squealmap::engine::method::Method;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::engine::reference::records::record;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::scene::Scene;
use squealmap::model::linear::Linear;
use squealmap::model::status::Status;
use squealmap::sweep::spec::Spec;

use crate::engines::Engine;
use defect::defect;

/// The variable with the seconds each part goes on for.
const SECONDS: &str = "SQUEALMAP_FUZZ_SECONDS";

/// A case that takes longer hangs: the longest legal ones of these sweeps take ten seconds of a processor.
const HANGS: Duration = Duration::from_mins(2);

/// Instances that ask for more steps are legal and slow; they are left out. An engine with slower steps is asked for fewer.
const MOST_STEPS: f64 = 3e5;

/// Defects of different kinds after which a search ends.
const MOST_DEFECTS: usize = 8;

/// A valid sweep of one instance.
pub(crate) fn sweep() -> impl Strategy<Value = String> {
    whole_range::parts().prop_map(|(own, shared)| own + &shared)
}

/// Tries random values until the time is over.
fn until_the_time_is_over<T: Strategy>(
    seconds: u64,
    strategy: &T,
    test: impl Fn(T::Value) -> Result<(), TestCaseError>,
) where
    T::Value: std::fmt::Debug,
{
    let seconds = std::env::var(SECONDS).ok().and_then(|text| text.parse().ok()).unwrap_or(seconds);
    let (began, limit) = (Instant::now(), Duration::from_secs(seconds));
    let mut cases = 0;
    // One of every kind: what an hour finds is to be read at its end.
    let mut defects: Vec<(String, String)> = Vec::new();
    while began.elapsed() < limit && defects.len() < MOST_DEFECTS {
        let config = Config { cases: 16, failure_persistence: None, ..Config::default() };
        match TestRunner::new(config).run(strategy, &test) {
            Ok(()) => cases += 16,
            Err(TestError::Fail(why, value)) => {
                let why = why.to_string();
                let kind = why.split(|c: char| c.is_ascii_digit()).next().unwrap_or_default().to_owned();
                if defects.iter().all(|(other, _)| *other != kind) {
                    defects.push((kind, format!("{why}\n{value:#?}")));
                }
            }
            Err(TestError::Abort(why)) => panic!("{why}"),
        }
    }
    println!("{cases} cases");
    let defects: Vec<String> = defects.into_iter().map(|(_, defect)| defect).collect();
    assert!(defects.is_empty(), "{}", defects.join("\n"));
}

fn is_finite(linear: &Linear) -> bool {
    let Linear { growth_rate, frequency, phase, growth_rate_flat, growth_rate_frozen } = *linear;
    [growth_rate, frequency.unwrap_or(0.0), phase.unwrap_or(0.0), growth_rate_flat, growth_rate_frozen]
        .iter()
        .all(|number| number.is_finite())
}

/// Steps that an instance asks for at most, by its fastest mode; infinite where it has no dynamics to tell.
fn steps(spec: &Spec, plan: &Plan) -> f64 {
    let Ok(scene) = Scene::new(&spec.instance(0), plan.start) else { return 0.0 };
    let fastest = scene.model.fastest.into_iter().filter(|rate| rate.is_finite()).fold(0.0, f64::max);
    // A run until settled has windows of its own.
    let length = scene.scaled(plan.settle) + scene.scaled(plan.measure);
    (if plan.settle_limit.is_some() { 1000.0 } else { length }) * fastest
}

/// Ends the tests where one case goes on for longer than [`HANGS`], and says which.
fn watch(case: &Arc<Mutex<(Instant, String)>>) {
    let case = Arc::downgrade(case);
    std::thread::spawn(move || {
        while let Some(case) = case.upgrade() {
            let (began, text) = case.lock().expect("no case panics while it is noted").clone();
            if began.elapsed() > HANGS {
                // Past the harness, which keeps what a test prints until the test ends: this one does not.
                let _ = writeln!(std::io::stderr(), "hangs:\n{text}");
                std::process::exit(1);
            }
            std::thread::sleep(Duration::from_millis(100));
        }
    });
}

#[test]
fn no_engine_is_at_a_loss() {
    let case = Arc::new(Mutex::new((Instant::now(), String::new())));
    watch(&case);
    until_the_time_is_over(15, &sweep(), |text| {
        let spec = Spec::parse(&text, "random.toml", "".as_ref())
            .map_err(|why| TestCaseError::fail(format!("a valid sweep is refused: {why}")))?;
        let plan = Plan::new(&spec);
        let steps = steps(&spec, &plan);
        let too_long = |slower: f64| (MOST_STEPS / slower..1e18).contains(&steps);
        if too_long(1.0) {
            return Ok(());
        }
        *case.lock().expect("the watch does not panic") = (Instant::now(), text.clone());
        let record = record(&spec, 0);
        prop_assert!(
            record.linear.as_ref().is_none_or(is_finite),
            "{:?} is {:?}",
            record.status,
            record.linear
        );
        // A law may ask for more steps than the modes, up to where every engine gives up; the others come first and show it.
        let mut taken = 0.0;
        for engine in Engine::ALL {
            let slower = engine.slower();
            if too_long(slower) || slower > 1.0 && taken * slower > MOST_STEPS {
                continue;
            }
            let outcome = engine.run(&spec.instance(0), &plan);
            taken = f64::max(taken, outcome.steps as f64);
            if let Some(defect) = defect(&outcome) {
                return Err(TestCaseError::fail(format!("{}: {defect}", engine.name())));
            }
        }
        for method in [Method::LocatedRk4, Method::FixedStep] {
            if let Some(defect) = defect(&respond(&spec.instance(0), &Plan { method, ..plan })) {
                return Err(TestCaseError::fail(format!("{method:?}: {defect}")));
            }
        }
        Ok(())
    });
}

#[test]
fn what_is_no_sweep_is_refused_in_a_sentence() {
    let directory = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("sweeps");
    until_the_time_is_over(5, &text::mutilated(&directory), |text| {
        match Spec::parse(&text, "random.toml", &directory) {
            Ok(spec) => {
                for index in [0, spec.grid.len() - 1] {
                    let _ = spec.instance(index);
                }
            }
            Err(why) => {
                let message = why.to_string();
                prop_assert!(why.is_bad_input(), "{message}");
                prop_assert!(message.len() > 10 && !message.contains('\n'), "{message}");
                if let Some(place) = why.place() {
                    prop_assert!(place.text().get(place.span()).is_some(), "{message}");
                }
            }
        }
        Ok(())
    });
}

/// Planted faults: an outcome with a number that is none, without one, unwritten, or with shares of time that are none.
#[test]
fn a_defect_is_seen() {
    let sweep = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";
    let spec = Spec::parse(sweep, "s.toml", "".as_ref()).expect("a valid sweep");
    let outcome = Engine::CpuF64.run(&spec.instance(0), &Plan::new(&spec));
    assert_eq!(defect(&outcome), None);
    let with = |fault: fn(&mut Outcome)| {
        let mut other = outcome;
        fault(&mut other);
        defect(&other).is_some()
    };
    assert!(with(|other| other.x2_mean = Some(f64::NAN)) && with(|other| other.n_peak = Some(f64::INFINITY)));
    assert!(with(|other| other.x2_std = None) && with(|other| other.stick = Some(1.5)));
    assert!(
        with(|other| other.status = Status::Unwritten) && with(|other| other.status = Status::EventLimit)
    );
    assert!(with(|other| other.ay_rms_halves[1] = f64::NAN) && with(|other| other.simulated_time = f64::NAN));
}
