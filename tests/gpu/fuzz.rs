//! Random sweeps on an adapter: over the whole range of every parameter no instance is left out, hangs, or is told as `ok`
//! with a number that is none.
//!
//! Some seconds in a run of the tests; `SQUEALMAP_FUZZ_SECONDS=3600` for longer.

use std::time::{Duration, Instant};

use crate::Case;
use crate::defect::defect;
use crate::whole_range::parts;
use libtest_mimic::Failed;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::engine::precision::Precision;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::status::Status;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

pub(crate) const CASES: &[Case] = &[
    ("fuzz::no_instance_is_at_a_loss_on_an_adapter", no_instance_is_at_a_loss),
    ("fuzz::a_defect_is_seen", a_defect_is_seen),
];

/// Seconds that it goes on for; the variable for longer.
const SECONDS: u64 = 10;
const VARIABLE: &str = "SQUEALMAP_FUZZ_SECONDS";

/// Instances of a sweep: a kernel is compiled for each sweep, and costs as much as some dozens of them.
const INSTANCES: usize = 48;

/// Instances that ask for more steps are legal, and slow on a software adapter.
const MOST_STEPS: f64 = 2e4;

/// What an instance may have of its own.
const OWN: [Param; 13] = [
    Param::M1,
    Param::M2,
    Param::K1,
    Param::K2,
    Param::C1,
    Param::C2,
    Param::FExt,
    Param::Theta,
    Param::Restitution,
    Param::MuS,
    Param::MuD,
    Param::BeltVelocity,
    Param::StartVelocity,
];

fn parse(text: &str) -> Result<Spec, Failed> {
    Spec::parse(text, "random.toml", "".as_ref()).map_err(|why| format!("{why}:\n{text}").into())
}

/// Steps that an instance asks for at most, by its fastest mode.
fn is_short(spec: &Spec, plan: &Plan) -> bool {
    let Ok(scene) = Scene::new(&spec.instance(0), plan.start) else { return true };
    let fastest = scene.model.fastest.into_iter().filter(|rate| rate.is_finite()).fold(0.0, f64::max);
    let length = scene.scaled(plan.settle) + scene.scaled(plan.measure);
    let steps = length * fastest.max(f64::from(plan.steps_per_period) / 6.0);
    !(MOST_STEPS..=1e18).contains(&steps)
}

/// A random sweep: start, response and what only some laws have are those of the first draw, all other numbers of each
/// instance its own.
fn random(runner: &mut TestRunner) -> Result<(String, Spec), Failed> {
    let draw = |runner: &mut TestRunner| parts().new_tree(runner).map(|tree| tree.current());
    loop {
        let (own, shared) = draw(runner)?;
        let text = format!("{own}{shared}");
        let base = parse(&text)?;
        let first = base.instance(0).params;
        let keys: Vec<Param> = OWN.into_iter().filter(|param| first.get(*param).is_some()).collect();
        let mut rows = Vec::new();
        // Where the shared part asks for many steps, so do nearly all.
        for _ in 0..4 * INSTANCES {
            let (own, _) = draw(runner)?;
            let one = parse(&format!("{own}{shared}"));
            let Ok(one) = one else { continue };
            let params = one.instance(0).params;
            let values: Option<Vec<Value>> =
                keys.iter().map(|key| params.get(*key).map(Value::Number)).collect();
            if let Some(values) = values.filter(|_| is_short(&one, &Plan::new(&one))) {
                rows.push(values);
            }
            if rows.len() == INSTANCES {
                break;
            }
        }
        if rows.len() >= INSTANCES / 4 && base.settle_limit.is_none_or(|_| is_short(&base, &Plan::new(&base)))
        {
            let keys = keys.into_iter().map(AxisKey::Param).collect();
            return Ok((text, Spec { grid: Grid::Tuples { keys, rows: rows.into() }, ..base }));
        }
    }
}

fn no_instance_is_at_a_loss() -> Result<(), Failed> {
    let seconds = std::env::var(VARIABLE).ok().and_then(|text| text.parse().ok()).unwrap_or(SECONDS);
    let (began, limit) = (Instant::now(), Duration::from_secs(seconds));
    let mut runner = TestRunner::default();
    let (mut sweeps, mut instances) = (0, 0);
    while began.elapsed() < limit {
        let (text, spec) = random(&mut runner)?;
        let options =
            Options { backend: Backend::Gpu, precision: Some(Precision::F32), ..Options::default() };
        let map = run::run(spec, &options, &|_| {}).map_err(|why| format!("{why}:\n{text}"))?;
        for (index, record) in map.records.iter().enumerate() {
            let outcome = record.outcome.as_deref().copied().unwrap_or_default();
            let found = if record.status == Status::Ok || record.outcome.is_some() {
                defect(&Outcome { status: record.status, ..outcome })
            } else {
                matches!(record.status, Status::Unwritten | Status::NotComputed)
                    .then(|| format!("its status is {:?}", record.status))
            };
            if let Some(found) = found {
                let instance = map.spec.instance(index);
                return Err(format!("{found}:\n{text}\n{:?}\n{:?}", instance.params, record.status).into());
            }
        }
        sweeps += 1;
        instances += map.records.len();
    }
    println!("{sweeps} sweeps of {instances} instances");
    Ok(())
}

/// Planted faults: an outcome with a number that is none, and one that nobody has written.
fn a_defect_is_seen() -> Result<(), Failed> {
    let ok = Outcome { status: Status::Ok, ..Outcome::default() };
    let unwritten = Outcome { status: Status::Unwritten, ..ok };
    if defect(&ok).is_none() || defect(&unwritten).is_none() {
        return Err("an outcome without numbers passes".into());
    }
    Ok(())
}
