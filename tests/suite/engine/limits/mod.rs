//! Where each method and precision stops being trustworthy: scenes at the extremes, what has to come out of them by
//! closed forms, and what does. `docs/limits.md` is the table of it.

mod document;
mod measure;
pub(crate) mod scene;
mod table;

use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::model::status::Status;

use crate::engines::Engine;
use document::{ROOM, Row, agrees, is_same, render};
use measure::{Found, STEPS, error, found};
use scene::{Expected, Number};

/// An error above this, with the status `ok`, is a wrong number.
const WRONG: f64 = 0.1;

/// The variable that writes `docs/limits.md` instead of comparing with it.
const WRITE: &str = "SQUEALMAP_WRITE_LIMITS";

fn rows() -> Vec<(&'static str, &'static str, Vec<Row>)> {
    table::groups().into_iter().map(|group| (group.title, group.source, measured(&group.scenes))).collect()
}

/// What every engine makes of some scenes.
fn measured(scenes: &[scene::Scene]) -> Vec<Row> {
    // A scene about its own step is run with that alone.
    let (usual, own): (Vec<usize>, Vec<usize>) =
        (0..scenes.len()).partition(|at| scenes[*at].plan.steps_per_period == STEPS[0]);
    let mut rows: Vec<Row> =
        scenes.iter().map(|scene| Row { name: scene.name.clone(), cells: Default::default() }).collect();
    let asked = STEPS.iter().map(|steps| (&usual, Some(*steps))).chain([(&own, None)]);
    for ((which, steps), (column, engine)) in
        asked.flat_map(|asked| Engine::ALL.into_iter().enumerate().map(move |engine| (asked, engine)))
    {
        let some: Vec<&scene::Scene> = which.iter().map(|at| &scenes[*at]).collect();
        for (at, found) in which.iter().zip(found(&some, engine, steps)) {
            rows[*at].cells[column].push(found);
        }
    }
    rows
}

#[test]
fn the_document_says_what_is_measured() {
    let rows = rows();
    for row in rows.iter().flat_map(|(_, _, rows)| rows) {
        for found in row.cells.iter().flatten() {
            assert!(
                !matches!(found, Found::Off(error) if *error >= WRONG),
                "{}: {found:?} with status ok",
                row.name
            );
        }
    }
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/limits.md");
    if std::env::var_os(WRITE).is_some() {
        std::fs::write(&path, render(&rows, ROOM)).expect("docs is writable");
        return;
    }
    let stored = std::fs::read_to_string(&path).expect("docs/limits.md");
    if let Err(line) = is_same(&stored, &render(&rows, 1.0)) {
        panic!("docs/limits.md is out of date ({WRITE}=1 cargo test limits writes it):\n{line}");
    }
}

#[test]
fn a_document_out_of_date_is_seen() {
    let row = |cells: &str| format!("| e = 0 | {cells} |\n");
    let stored = row("1e-6 | painleve");
    assert!(is_same(&stored, &row("1e-6 | painleve")).is_ok());
    // The last decade is the machine's.
    assert!(is_same(&stored, &row("1e-7 | painleve")).is_ok());
    for other in ["1e-5 | painleve", "1e-9 | painleve", "1e-6 | 1e-6", "painleve | painleve", "1e-6"] {
        assert!(is_same(&stored, &row(other)).is_err(), "{other}");
    }
    assert!(is_same(&stored, &(stored.clone() + &row("1e-6 | painleve"))).is_err());
    assert!(is_same(&stored, &stored.replace("e = 0", "e = 1")).is_err());
}

/// No engine returns `ok` with a number that is wrong, with steps of half a period and a whole one either; what has to
/// be refused is.
#[test]
fn a_step_too_large_is_never_a_wrong_number() {
    for group in table::groups() {
        let scenes: Vec<&scene::Scene> = group.scenes.iter().collect();
        // What takes thousands of steps whatever is asked for takes the same ones with a step of half a period.
        let is_other = |scene: &&scene::Scene| {
            let coarse = Plan { steps_per_period: 1, ..scene.plan };
            Engine::CpuF64.run(&scene.instance, &coarse).steps < 2000
        };
        let others: Vec<&scene::Scene> = scenes.iter().copied().filter(is_other).collect();
        let cases = Engine::ALL.into_iter().flat_map(|engine| [(engine, 1, &scenes), (engine, 2, &others)]);
        for (engine, steps, scenes) in cases {
            for (scene, found) in scenes.iter().zip(found(scenes, engine, Some(steps))) {
                let (name, engine) = (&scene.name, engine.name());
                match (found, &scene.expected) {
                    (Found::Ended(status), Expected::Ends(expected)) => {
                        assert_eq!(status, *expected, "{name}: {engine}");
                    }
                    (Found::Off(_), Expected::Ends(expected)) => {
                        panic!("{name}: {engine} with {steps} steps is ok instead of {expected:?}")
                    }
                    (Found::Off(error), _) => {
                        assert!(error < WRONG, "{name}: {engine} with {steps} steps is off by {error:e}");
                    }
                    (Found::Ended(_), _) => {}
                }
            }
        }
    }
}

/// Planted faults: what compares outcomes with what is expected sees a wrong number, a missing one and a NaN.
#[test]
fn a_wrong_number_is_seen() {
    let scene = scene::sliding("", 0.1, 5.0, &[]);
    let Expected::Numbers(numbers) = &scene.expected else { panic!("numbers are expected") };
    let outcome = Engine::Reference.run(&scene.instance, &scene.plan);
    assert!(error(&outcome, numbers) < 1e-9);
    let with = |fault: fn(&mut Outcome)| {
        let mut other = outcome;
        fault(&mut other);
        error(&other, numbers)
    };
    assert!((with(|other| other.y1_std = other.y1_std.map(|value| 1.01 * value)) - 0.01).abs() < 1e-6);
    assert!(with(|other| other.ay_rms = None).is_infinite());
    assert!(with(|other| other.ax_rms = Some(f64::NAN)).is_infinite());
    assert!(with(|other| *other = Outcome { status: Status::Ok, ..Outcome::default() }).is_infinite());
}

/// Lengths follow the force, velocities likewise; masses follow stiffness and damping. By powers of two nothing
/// rounds: the same bits.
#[test]
fn units_change_no_bit() {
    use squealmap::model::Param;
    use squealmap::model::friction::FrictionLaw;
    let run = |engine: Engine, force: f64, mass: f64| {
        let knee_velocity = 5.0 * force / mass;
        let law = FrictionLaw::Bilinear { mu_s: 0.4, mu_d: 0.3, knee_velocity };
        let mut one = crate::common::instance(law, &[]);
        for param in [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2] {
            one.params.set(param, mass * one.params.get(param).expect("a value"));
        }
        one.params.set(Param::FExt, 1000.0 * force);
        one.params.set(Param::BeltVelocity, 3.0 * force / mass);
        one.params.set(Param::StartVelocity, 1.0 * force / mass);
        engine.run(&one, &scene::periods(30.0, 20.0, 12))
    };
    let numbers: [Number; 3] = [|o| o.x2_std, |o| o.ax_rms, |o| o.ay_rms];
    for engine in Engine::ALL {
        let base = run(engine, 1.0, 1.0);
        assert!(base.stick.is_some_and(|stick| stick > 0.1), "{base:?}");
        for (force, mass) in [(2_f64.powi(40), 1.0), (2_f64.powi(-40), 1.0), (1.0, 2_f64.powi(30))] {
            let other = run(engine, force, mass);
            for number in numbers {
                assert_eq!(
                    number(&other),
                    number(&base).map(|value| value * force / mass),
                    "{}",
                    engine.name()
                );
            }
            assert_eq!((other.stick, other.free), (base.stick, base.free));
        }
    }
}

/// The engine of the CPU keeps an amplitude over as many steps as a run may have.
#[test]
#[ignore = "minutes"]
fn as_many_steps_as_a_run_may_have() {
    let scene = scene::sliding(
        "",
        0.1,
        1.0,
        &[
            (squealmap::model::Param::C1, 0.0),
            (squealmap::model::Param::C2, 0.0),
            (squealmap::model::Param::Theta, 0.0),
        ],
    );
    let Expected::Numbers(numbers) = &scene.expected else { panic!("numbers are expected") };
    let plan = scene::periods(f64::from(squealmap::engine::scene::MOST_STEPS) / 12.0 - 2.0, 1.0, 12);
    let outcome = Engine::CpuF64.run(&scene.instance, &plan);
    println!("{:e}", error(&outcome, &numbers[..1]));
    assert!(error(&outcome, &numbers[..1]) < 1e-3);
}

#[test]
fn grades_are_compared_by_decades() {
    assert!(agrees("1e-6", "1e-6") && agrees("1e-6", "1e-7"));
    assert!(!agrees("1e-6", "1e-5") && !agrees("1e-6", "1e-8") && !agrees("ok", "1e-6"));
}
