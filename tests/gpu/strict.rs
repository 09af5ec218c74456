//! Strict kernels against their twins: on a software driver every bit of every word is the same; on hardware,
//! where a division may be off by 2.5 ulp and denormals may be 0, the differing instances are counted.

use std::time::Instant;

use libtest_mimic::Failed;
use rayon::prelude::*;
use squealmap::backend::gpu::device::{Arithmetic, Device};
use squealmap::backend::gpu::kernel::Compiled;
use squealmap::backend::gpu::run::{ChunkResult, Drive, run};
use squealmap::integrate::STEP_TOLERANCE;
use squealmap::kernel::lane::Lane;
use squealmap::kernel::record::write;
use squealmap::kernel::response::{self, PIECES, choice, instance_words};
use squealmap::kernel::scene::{Law, Scene as Words};
use squealmap::kernel::source::{Constant, Kernel, Precision, SETTING_WORDS};
use squealmap::kernel::{linear, source};
use squealmap::method::taylor::REFERENCE_ORDER;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::{Param, Params};
use squealmap::outcome::Status;
use squealmap::response::{Plan, Scene};
use squealmap::spec::{Duration, Instance, StartKind};

use crate::Case;
use crate::instances::Uniform;
use crate::words::{device, drive, inputs, on_cpu};

/// Instances of a comparison.
const COUNT: usize = 65_536;

/// Instances of a planted fault.
const FEW: usize = 2000;

/// Bound on the truncation of the response kernel's steps.
const TOLERANCE: f32 = 2e-4;

const STRICT: Arithmetic = Arithmetic { precision: Precision::F32, strict: true };
const FREE: Arithmetic = Arithmetic { precision: Precision::F32, strict: false };

pub(crate) const CASES: &[Case] = &[
    ("strict::linear_equals_its_twin_in_every_bit", linear_equals),
    ("strict::pieces_equal_their_twin_in_every_bit", || response_equals(Law::Pieces)),
    ("strict::exponential_equals_its_twin_in_every_bit", || response_equals(Law::Exponential)),
    ("strict::rational_equals_its_twin_in_every_bit", || response_equals(Law::Rational)),
    ("strict::one_changed_operation_is_noticed", changed_operation),
    ("strict::one_ulp_in_one_scene_is_noticed", changed_scene),
];

/// The instances whose words are not the same to the bit, and what the first of them differs in.
fn differing(
    kernel: &Kernel,
    actual: &ChunkResult<f32>,
    expected: &ChunkResult<f32>,
) -> Result<(usize, String), Failed> {
    let count = expected.flags.len() / source::words(kernel.flags);
    if (actual.state.len(), actual.flags.len()) != (expected.state.len(), expected.flags.len()) {
        return Err("results of different sizes".into());
    }
    let mut differs = vec![false; count];
    let mut first = String::new();
    let mut note = |index: usize, a: String, b: String| {
        if first.is_empty() {
            first = format!("word {} of instance {}: {a} instead of {b}", index / count, index % count);
        }
        differs[index % count] = true;
    };
    for (index, (a, b)) in actual.flags.iter().zip(&expected.flags).enumerate() {
        if a != b {
            note(index, format!("flag {a}"), format!("{b}"));
        }
    }
    for (index, (a, b)) in actual.state.iter().zip(&expected.state).enumerate() {
        if a.to_bits() != b.to_bits() {
            note(index, format!("{a:e}"), format!("{b:e}"));
        }
    }
    Ok((differs.into_iter().filter(|one| *one).count(), first))
}

/// A kernel over word-major inputs on an open device.
fn on_gpu(
    device: &Device,
    kernel: &Kernel,
    source: &str,
    inputs: &[f32],
) -> Result<ChunkResult<f32>, Failed> {
    let compiled = Compiled::from_source(device, kernel, source)?;
    let mut settings = [0; SETTING_WORDS];
    settings[0] = TOLERANCE.to_bits();
    Ok(run(device, &compiled, inputs, &Drive { settings, most_dispatches: 100_000, ..drive() })?)
}

/// Compares a kernel with its twin, free and strict, and says how many instances differ.
fn compared(
    kernel: &Kernel,
    choices: &[(&str, Constant)],
    inputs: &[f32],
    twin: impl FnOnce() -> ChunkResult<f32>,
) -> Result<(), Failed> {
    let began = Instant::now();
    let expected = twin();
    let on_cpu = began.elapsed().as_secs_f64();
    let text = kernel.source(Precision::F32, choices);
    let mut counts = [0; 2];
    let mut seconds = [0.0; 2];
    let mut first = String::new();
    let mut software = true;
    for (k, arithmetic) in [FREE, STRICT].into_iter().enumerate() {
        let device = device(arithmetic)?;
        software = device.describe().device_type == "software";
        let began = Instant::now();
        let actual = on_gpu(&device, kernel, &text, inputs)?;
        seconds[k] = began.elapsed().as_secs_f64();
        (counts[k], first) = differing(kernel, &actual, &expected)?;
    }
    let count = expected.flags.len() / source::words(kernel.flags);
    println!(
        "{count} instances: {} differ when free ({:.1} s), {} when strict ({:.1} s); twin {on_cpu:.1} s",
        counts[0], seconds[0], counts[1], seconds[1]
    );
    if software && counts[1] > 0 {
        return Err(format!("{} instances differ: {first}", counts[1]).into());
    }
    Ok(())
}

fn linear_equals() -> Result<(), Failed> {
    let inputs = inputs::<f32>(COUNT);
    compared(&linear::KERNEL, &[], &inputs, || on_cpu(&inputs))
}

/// A random instance of a law.
fn instance(u: &mut Uniform, law: Law) -> Instance {
    let mut params = Params::default();
    let velocity = u.log(0.05, 10.0);
    params.set(Param::BeltVelocity, velocity);
    params.set(Param::Theta, 0.9 * u.next() - 0.3);
    params.set(Param::StartVelocity, 2.0 * velocity * u.next());
    params.set(Param::StartDisplacement, 1e-3 * (u.next() - 0.5));
    params.set(Param::Restitution, (1.5 * u.next() - 0.5).max(0.0));
    let (mu_s, mu_d, scale) = (0.9 * u.next(), 0.9 * u.next(), u.log(0.1, 10.0));
    let law = match law {
        Law::Pieces => FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: scale },
        Law::Exponential => FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: scale },
        Law::Rational => FrictionLaw::Rational { mu_s, decay: scale },
    };
    Instance { params, law, impact_friction: u.next() < 0.5 }
}

/// The f64 words of random instances that can be integrated.
fn scenes(law: Law, count: usize) -> Vec<Vec<f64>> {
    let plan = Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(1.0),
        measure: Duration::Periods(2.0),
        steps_per_period: 12,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    };
    let mut u = Uniform(11);
    std::iter::repeat_with(|| instance(&mut u, law))
        .filter_map(|one| Scene::new(&one, plan.start).ok())
        .map(|scene| instance_words(&scene, &plan, PIECES))
        .take(count)
        .collect()
}

/// Word-major inputs.
#[expect(clippy::cast_possible_truncation, reason = "the narrowing of the host")]
fn narrowed(scenes: &[Vec<f64>]) -> Vec<f32> {
    let words = source::words(response::KERNEL.inputs);
    (0..words).flat_map(|word| scenes.iter().map(move |one| one[word] as f32)).collect()
}

/// The twin of the response kernel.
fn twins(law: Law, scenes: &[Vec<f64>]) -> ChunkResult<f32> {
    let lanes: Vec<(Vec<f32>, Vec<u32>)> = scenes
        .par_iter()
        .map(|one| {
            let words = Words::read(law, PIECES, one);
            let mut lane = Lane::new(&words);
            lane.run(&words, TOLERANCE);
            write(&lane)
        })
        .collect();
    let (state, flags) = (source::words(response::KERNEL.state), source::words(response::KERNEL.flags));
    ChunkResult {
        state: (0..state).flat_map(|word| lanes.iter().map(move |one| one.0[word])).collect(),
        flags: (0..flags).flat_map(|word| lanes.iter().map(move |one| one.1[word])).collect(),
    }
}

fn response_equals(law: Law) -> Result<(), Failed> {
    let scenes = scenes(law, COUNT);
    let inputs = narrowed(&scenes);
    compared(&response::KERNEL, &choice(law), &inputs, || {
        let result = twins(law, &scenes);
        println!("{law:?}: {}", variety(&result));
        result
    })
}

/// How the twins end, and how many saw what: the comparison is worth what the instances do.
fn variety(result: &ChunkResult<f32>) -> String {
    let flag = |name: &str| {
        let fields = response::KERNEL.flags.iter().take_while(|field| field.name != name);
        let word: usize = fields.map(|field| field.words).sum();
        &result.flags[word * COUNT..(word + 1) * COUNT]
    };
    let many = |name: &str, holds: fn(u32) -> bool| flag(name).iter().filter(|one| holds(**one)).count();
    let statuses: Vec<String> = Status::ALL
        .into_iter()
        .map(|status| (status, flag("status").iter().filter(|one| **one == status as u32).count()))
        .filter(|(_, count)| *count > 0)
        .map(|(status, count)| format!("{count} {}", status.name()))
        .collect();
    format!(
        "{}; {} end out of slip, {} impact, {} pass twice, {} had an event",
        statuses.join(", "),
        many("contact", |contact| contact > 0),
        many("impacts", |impacts| impacts > 0),
        many("second_pass", |pass| pass > 0),
        many("growth_closed", |closed| closed > 0),
    )
}

/// The strict kernel of a changed text, or of changed scenes, against the right twin.
fn noticed(text: &str, inputs: &[f32], expected: &ChunkResult<f32>) -> Result<(), Failed> {
    let actual = on_gpu(&device(STRICT)?, &response::KERNEL, text, inputs)?;
    match differing(&response::KERNEL, &actual, expected)? {
        (0, _) => Err("the fault was not noticed".into()),
        (count, first) => {
            println!("{count} instances differ, {first}");
            Ok(())
        }
    }
}

fn changed_operation() -> Result<(), Failed> {
    let scenes = scenes(Law::Pieces, FEW);
    let text = response::KERNEL.source(Precision::F32, &choice(Law::Pieces));
    let changed =
        text.replace("weight * (x.v * x.v + w.v * w.v)", "weight * (w.v * w.v) + weight * (x.v * x.v)");
    if changed == text {
        return Err("nothing was changed".into());
    }
    noticed(&changed, &narrowed(&scenes), &twins(Law::Pieces, &scenes))
}

fn changed_scene() -> Result<(), Failed> {
    let scenes = scenes(Law::Pieces, FEW);
    let text = response::KERNEL.source(Precision::F32, &choice(Law::Pieces));
    let mut inputs = narrowed(&scenes);
    // k2 of instance 77.
    let word = &mut inputs[4 * FEW + 77];
    *word = word.next_up();
    noticed(&text, &inputs, &twins(Law::Pieces, &scenes))
}
