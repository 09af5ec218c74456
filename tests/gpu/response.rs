//! The response kernel: GPU against its twin and against the reference.

use crate::Case;
use crate::words::{device, drive};
use libtest_mimic::Failed;
use squealmap::engine::error::Error;
use squealmap::engine::fields::{first_word, words};
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::response::read_lane;
use squealmap::engine::gpu::run::{Drive, run};
use squealmap::engine::kernel::lane::Lane;
use squealmap::engine::kernel::record::write;
use squealmap::engine::kernel::response::{choices, kernel, words as packed_words};
use squealmap::engine::kernel::scene::Scene as Words;
use squealmap::engine::kernel::segments::segments;
use squealmap::engine::kernel::source::{Kernel, SETTING_WORDS};
use squealmap::engine::kernel::steps::TOLERANCE;
use squealmap::engine::kernel::windows::reductions;
use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::engine::precision::Precision;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::scene::Scene;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::piece::LawForm;
use squealmap::model::status::Status;
use squealmap::model::{Param, Params};

pub(crate) const CASES: &[Case] = &[
    ("response::f32_equals_its_twin_over_short_runs", short_runs),
    ("response::amplitudes_are_those_of_the_reference", long_runs),
    ("response::words_that_are_no_finished_lane_are_refused", refused),
    ("response::a_kernel_that_stops_early_is_noticed", stops_early),
    ("response::any_number_of_steps_per_dispatch_gives_the_same_bits", any_dispatch),
];

/// Pieces of the law of the instances.
const PIECES: usize = 2;

/// The kernel for them.
const KERNEL: Kernel = kernel::<PIECES>();

/// Friction coefficients 0 to 0.6 at four velocities.
fn instances() -> Vec<Instance> {
    let velocities = [0.5, 1.0, 3.0, 6.0];
    let instance = |velocity: f64, k: i32| {
        let mut params = Params::default();
        params.set(Param::BeltVelocity, velocity);
        params.set(Param::StartVelocity, 0.3 * velocity);
        let (mu_s, mu_d) = (0.15 * f64::from(k / 5), 0.15 * f64::from(k % 5));
        let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 };
        Instance { params, law, impact_friction: true, modal: None }
    };
    velocities.iter().flat_map(|velocity| (0..25).map(|k| instance(*velocity, k))).collect()
}

pub(crate) fn plan(settle: f64, measure: f64) -> Plan {
    Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(settle),
        settle_limit: None,
        hunts: false,
        measure: Duration::Periods(measure),
        steps_per_period: 12,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    }
}

/// The words of every instance's lane after the run, on the GPU, and the scenes they belong to.
#[expect(clippy::type_complexity, reason = "state and flags of each instance")]
fn on_gpu(plan: &Plan, steps: Option<u32>) -> Result<Vec<(Scene, Words<f32>, Vec<f32>, Vec<u32>)>, Failed> {
    with_source(plan, steps, &KERNEL.source(Precision::F32, &choices(LawForm::Pieces, false)))
}

/// As [`on_gpu`], with another text of the kernel.
#[expect(clippy::type_complexity, reason = "state and flags of each instance")]
fn with_source(
    plan: &Plan,
    steps: Option<u32>,
    source: &str,
) -> Result<Vec<(Scene, Words<f32>, Vec<f32>, Vec<u32>)>, Failed> {
    let scenes: Vec<Scene> =
        instances().iter().filter_map(|instance| Scene::new(instance, plan.start).ok()).collect();
    let packed: Vec<Vec<f64>> =
        scenes.iter().map(|scene| packed_words(scene, &segments(scene, plan), PIECES)).collect();
    let count = scenes.len();
    #[expect(clippy::cast_possible_truncation, reason = "the narrowing of the host")]
    let inputs: Vec<f32> =
        (0..words(KERNEL.inputs)).flat_map(|word| packed.iter().map(move |one| one[word] as f32)).collect();
    let device = device(Precision::F32)?;
    let compiled = Compiled::from_source(&device, &KERNEL, source)?;
    let mut settings = [0; SETTING_WORDS];
    settings[0] = TOLERANCE.to_bits();
    let result =
        run(&device, &compiled, &inputs, &Drive { settings, steps, most_dispatches: 100_000, ..drive() })?;
    Ok(scenes
        .into_iter()
        .enumerate()
        .map(|(i, scene)| {
            let state = (0..words(KERNEL.state)).map(|word| result.state[word * count + i]).collect();
            let flags = (0..words(KERNEL.flags)).map(|word| result.flags[word * count + i]).collect();
            (scene, Words::read(LawForm::Pieces, PIECES, &packed[i]), state, flags)
        })
        .collect())
}

fn short_runs() -> Result<(), Failed> {
    let (mut worst, mut equal) = (0.0_f64, 0);
    let lanes = on_gpu(&plan(2.0, 2.0), None)?;
    let count = lanes.len();
    for (_, words, state, flags) in lanes {
        let mut lane = Lane::new(&words);
        lane.run(&words, TOLERANCE);
        let (expected, expected_flags) = write(&lane);
        equal += usize::from(
            flags == expected_flags && state.iter().zip(&expected).all(|(a, b)| a.to_bits() == b.to_bits()),
        );
        if flags[0] != Status::Ok as u32 || expected_flags[0] != flags[0] {
            return Err(format!("status {} instead of {}", flags[0], expected_flags[0]).into());
        }
        let size = expected[..6].iter().fold(0.0_f64, |size, value| size.max(f64::from(value.abs())));
        for (a, b) in state[..6].iter().zip(&expected[..6]) {
            let error = f64::from((a - b).abs()) / size;
            worst = if error.is_finite() { worst.max(error) } else { f64::INFINITY };
        }
    }
    println!("{equal} of {count} lanes equal in every bit; worst difference of a state {worst:.1e}");
    if worst < 1e-3 { Ok(()) } else { Err(format!("worst difference {worst:e}").into()) }
}

/// The outcome of a finished lane from its words.
fn outcome_from(
    scene: &Scene,
    plan: &Plan,
    index: usize,
    state: &[f32],
    flags: &[u32],
) -> squealmap::engine::error::Result<Outcome> {
    let segments = segments(scene, plan);
    let (seen, end) = reductions(&segments, &read_lane(&segments, index, state, flags)?);
    Ok(seen.outcome(scene, plan, &end))
}

fn long_runs() -> Result<(), Failed> {
    let plan = plan(60.0, 40.0);
    let mut errors = Vec::new();
    for ((scene, _, state, flags), instance) in on_gpu(&plan, None)?.into_iter().zip(instances()) {
        let found = outcome_from(&scene, &plan, 0, &state, &flags)?;
        let expected = respond(&instance, &plan);
        if found.status != Status::Ok || (found.simulated_time / expected.simulated_time - 1.0).abs() > 1e-12
        {
            return Err(format!("{:?} after {} s", found.status, found.simulated_time).into());
        }
        for (a, b) in [
            (found.x2_std, expected.x2_std),
            (found.ax_rms, expected.ax_rms),
            (found.ay_rms, expected.ay_rms),
            (found.friction_mean, expected.friction_mean),
        ] {
            let (a, b) = (a.ok_or("no value")?, b.ok_or("no value")?);
            errors.push(if a.is_finite() { (a - b).abs() / b.abs().max(1e-12) } else { f64::INFINITY });
        }
    }
    errors.sort_by(f64::total_cmp);
    let quantile = |share: usize| errors[(errors.len() - 1) * share / 100];
    println!("{} numbers: median {:.1e}, p99 {:.1e}", errors.len(), quantile(50), quantile(99));
    if quantile(50) < 1e-4 && quantile(99) < 2e-3 { Ok(()) } else { Err("too far".into()) }
}

fn any_dispatch() -> Result<(), Failed> {
    let bits = |steps| -> Result<Vec<u32>, Failed> {
        let lanes = on_gpu(&plan(3.0, 3.0), Some(steps))?;
        let words = |(_, _, state, flags): (_, _, Vec<f32>, Vec<u32>)| {
            state.into_iter().map(f32::to_bits).chain(flags).collect::<Vec<u32>>()
        };
        Ok(lanes.into_iter().flat_map(words).collect())
    };
    if bits(7)? == bits(32)? { Ok(()) } else { Err("the bits depend on the steps of a dispatch".into()) }
}

/// Planted faults in the words of finished lanes.
fn refused() -> Result<(), Failed> {
    let plan = plan(1.0, 1.0);
    let (scene, _, state, flags) = on_gpu(&plan, None)?.swap_remove(7);
    let read = |state: &[f32], flags: &[u32]| outcome_from(&scene, &plan, 7, state, flags);
    assert_eq!(read(&state, &flags)?.status, Status::Ok);
    let with = |name: &str, value: u32| {
        let mut wrong = flags.clone();
        wrong[first_word(KERNEL.flags, name)] = value;
        read(&state, &wrong)
    };
    for unwritten in [
        read(&state[1..], &flags),
        read(&state, &flags[1..]),
        read(&vec![0.0; state.len()], &vec![0; flags.len()]),
        with("status", 0),
        with("status", Status::NotComputed as u32),
        with("status", 77),
    ] {
        assert!(matches!(unwritten, Err(Error::Unwritten { instance: 7 })), "{unwritten:?}");
    }
    for miscounted in [with("steps", 3), with("segment", 0)] {
        assert!(matches!(miscounted, Err(Error::Miscounted { .. })), "{miscounted:?}");
    }
    for value in [f32::NAN, f32::INFINITY] {
        let mut wrong = state.clone();
        wrong[first_word(KERNEL.state, "total") + 2] = value;
        assert_eq!(read(&wrong, &flags)?.status, Status::NonFinite);
    }
    Ok(())
}

/// A kernel that calls every lane finished after ten steps.
fn stops_early() -> Result<(), Failed> {
    let plan = plan(2.0, 2.0);
    let source = KERNEL.source(Precision::F32, &choices(LawForm::Pieces, false));
    let early = source.replace(
        "            iterate(tolerance);\n",
        "            iterate(tolerance);\n            if lane.iterations > 10u { lane.status = STATUS_OK; }\n",
    );
    assert_ne!(source, early);
    for (scene, _, state, flags) in with_source(&plan, None, &early)? {
        match outcome_from(&scene, &plan, 0, &state, &flags) {
            Err(Error::Miscounted { found: 11, wanted: 48, .. }) => {}
            other => return Err(format!("{:?}", other.map(|outcome| outcome.simulated_time)).into()),
        }
    }
    Ok(())
}
