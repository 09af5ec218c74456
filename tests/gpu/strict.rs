//! Strict kernels against their twins: on a software driver every bit of every word is the same; on hardware,
//! where a division may be off by 2.5 ulp and denormals may be 0, the differing instances are counted.

use std::time::Instant;

use crate::Case;
use crate::instances::{Uniform, moving};
use crate::response::plan;
use crate::words::{device, drive, inputs, on_cpu};
use libtest_mimic::Failed;
use rayon::prelude::*;
use squealmap::engine::fields;
use squealmap::engine::gpu::arithmetic::Arithmetic;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::{ChunkResult, Drive, run};
use squealmap::engine::kernel::lane::Lane;
use squealmap::engine::kernel::linear;
use squealmap::engine::kernel::record::write;
use squealmap::engine::kernel::response::{choices, kernel, words};
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::scene::Scene as Words;
use squealmap::engine::kernel::segments::segments;
use squealmap::engine::kernel::source::{Constant, FLAG_STEPS, Kernel, SETTING_WORDS};
use squealmap::engine::kernel::steps::TOLERANCE;
use squealmap::engine::precision::Precision;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::piece::LawForm;
use squealmap::model::status::Status;

/// Instances of a comparison.
const COUNT: usize = 65_536;

/// Instances of a planted fault, and of a transient in f64.
const FEW: usize = 2000;

/// Steps of an instance that chatters.
const LONG: u32 = 150;

/// Pieces of the longest law.
const PIECES: usize = 2;

/// The response kernel.
const RESPONSE: Kernel = kernel::<PIECES>();

pub(crate) const CASES: &[Case] = &[
    ("strict::linear_equals_its_twin_in_every_bit", linear_equals::<f32>),
    ("strict::belts_without_a_ramp_equal_their_twin_in_every_bit", || {
        // Their kernel is built without one; the others hold both.
        let forms = LawForm::ALL;
        forms.into_iter().try_for_each(|law| equals(&without_ramp::<f32>(law, FEW), law, false, &[true]))
    }),
    ("strict::one_ulp_in_one_scene_is_noticed", changed_scene),
];

/// What takes a software adapter half a minute and more, in f32; some of every law are among the others.
pub(crate) const SLOW: &[Case] = &[
    ("strict::one_changed_operation_is_noticed", changed_operation),
    ("strict::pieces_equal_their_twin_in_every_bit", || {
        response_equals::<f32>(LawForm::Pieces, COUNT, &[false, true])
    }),
    ("strict::exponential_equals_its_twin_in_every_bit", || {
        response_equals::<f32>(LawForm::Exponential, COUNT, &[true])
    }),
    ("strict::rational_equals_its_twin_in_every_bit", || {
        response_equals::<f32>(LawForm::Rational, COUNT, &[true])
    }),
];

/// What takes it as long in f64.
pub(crate) const SLOW_F64: &[Case] = &[
    ("strict::pieces_in_f64_equal_their_twin_in_every_bit", || {
        response_equals::<f64>(LawForm::Pieces, FEW, &[false, true])
    }),
    ("strict::exponential_in_f64_equals_its_twin_in_every_bit", || {
        response_equals::<f64>(LawForm::Exponential, FEW, &[true])
    }),
    ("strict::rational_in_f64_equals_its_twin_in_every_bit", || {
        response_equals::<f64>(LawForm::Rational, FEW, &[true])
    }),
];

/// Cases that need an adapter with f64 and a strict one.
pub(crate) const F64: &[Case] =
    &[("strict::linear_in_f64_equals_its_twin_in_every_bit", linear_equals::<f64>)];

/// The instances whose words are not the same to the bit, and what the first of them differs in.
fn differing<R: Real>(
    kernel: &Kernel,
    actual: &ChunkResult<R>,
    expected: &ChunkResult<R>,
) -> Result<(usize, String), Failed> {
    let count = expected.flags.len() / fields::words(kernel.flags);
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
        let (a, b) = (a.to_f64(), b.to_f64());
        if a.to_bits() != b.to_bits() {
            note(index, format!("{a:e}"), format!("{b:e}"));
        }
    }
    Ok((differs.into_iter().filter(|one| *one).count(), first))
}

/// A kernel over word-major inputs on an open device.
fn on_gpu<R: Real>(
    device: &Device,
    kernel: &Kernel,
    source: &str,
    inputs: &[R],
) -> Result<ChunkResult<R>, Failed> {
    let compiled = Compiled::from_source(device, kernel, source)?;
    let mut settings = [0; SETTING_WORDS];
    settings[0] = TOLERANCE.to_bits();
    Ok(run(device, &compiled, inputs, &Drive { settings, most_dispatches: 100_000, ..drive() })?)
}

/// Instances in a chunk of their own, and what the twin makes of them.
struct Group<R> {
    inputs: Vec<R>,
    twin: ChunkResult<R>,
}

/// Compares a kernel with its twin, strict or not as `modes` say, and prints how many instances differ.
fn compared<R: Real>(
    kernel: &Kernel,
    choices: &[(&str, Constant)],
    (groups, wanted): (&[Group<R>], usize),
    modes: &[bool],
) -> Result<(), Failed> {
    let text = kernel.source(R::PRECISION, choices);
    for strict in modes {
        let device = device(Arithmetic { precision: R::PRECISION, strict: *strict })?;
        let (mut instances, mut different, mut first) = (0, 0, String::new());
        let began = Instant::now();
        for group in groups {
            let actual = on_gpu(&device, kernel, &text, &group.inputs)?;
            let (count, what) = differing(kernel, &actual, &group.twin)?;
            instances += group.twin.flags.len() / fields::words(kernel.flags);
            different += count;
            first += &what;
        }
        let mode = if *strict { "strict" } else { "not strict" };
        println!(
            "{mode}: {different} of {instances} instances differ, {:.1} s on {}",
            began.elapsed().as_secs_f64(),
            device.describe()
        );
        let software = device.describe().device_type == "software";
        if instances != wanted || *strict && software && different > 0 {
            return Err(format!("{different} of {instances} instances differ: {first}").into());
        }
    }
    Ok(())
}

fn linear_equals<R: Real>() -> Result<(), Failed> {
    let inputs = inputs::<R>(COUNT);
    let twin = on_cpu(&inputs);
    compared(&linear::KERNEL, &[], (&[Group { inputs, twin }], COUNT), &[false, true])
}

/// A random instance of a law.
pub(crate) fn instance(u: &mut Uniform, law: LawForm) -> Instance {
    let params = moving(u);
    let (mu_s, mu_d, scale) = (0.9 * u.next(), 0.9 * u.next(), u.log(0.1, 10.0));
    let law = match law {
        LawForm::Pieces => FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: scale },
        LawForm::Exponential => FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: scale },
        LawForm::Rational => FrictionLaw::Rational { mu_s, decay: scale },
    };
    Instance { params, law, impact_friction: u.next() < 0.5, modal: None }
}

/// One instance and its twin at the end.
struct Run<R> {
    words: Vec<f64>,
    state: Vec<R>,
    flags: Vec<u32>,
}

/// Random instances that can be integrated, run by the twin.
fn runs<R: Real>(law: LawForm, count: usize) -> Vec<Run<R>> {
    let mut u = Uniform(11);
    by_twin(law, count, std::iter::repeat_with(|| instance(&mut u, law)))
}

/// The same without those whose belt has a ramp.
fn without_ramp<R: Real>(law: LawForm, count: usize) -> Vec<Run<R>> {
    let mut u = Uniform(12);
    let steady = |one: &Instance| one.params.get(Param::RampDuration).is_none();
    by_twin(law, count, std::iter::repeat_with(|| instance(&mut u, law)).filter(steady))
}

/// As many of `instances` as can be integrated, run by the twin.
fn by_twin<R: Real>(law: LawForm, count: usize, instances: impl Iterator<Item = Instance>) -> Vec<Run<R>> {
    let plan = plan(0.5, 1.5);
    let words: Vec<Vec<f64>> = instances
        .filter_map(|one| Scene::new(&one, plan.start).ok())
        .map(|scene| words(&scene, &segments(&scene, &plan), PIECES))
        .take(count)
        .collect();
    words
        .into_par_iter()
        .map(|words| {
            let scene = Words::read(law, PIECES, &words);
            let mut lane = Lane::new(&scene);
            lane.run(&scene, R::from_f64(f64::from(TOLERANCE)));
            let (state, flags) = write(&lane);
            Run { words, state, flags }
        })
        .collect()
}

/// Runs as word-major inputs and results.
fn group<R: Real>(runs: &[&Run<R>]) -> Group<R> {
    let [inputs, state, flags] = [RESPONSE.inputs, RESPONSE.state, RESPONSE.flags].map(fields::words);
    Group {
        inputs: (0..inputs)
            .flat_map(|word| runs.iter().map(move |one| R::from_f64(one.words[word])))
            .collect(),
        twin: ChunkResult {
            state: (0..state).flat_map(|word| runs.iter().map(move |one| one.state[word])).collect(),
            cancelled: false,
            flags: (0..flags).flat_map(|word| runs.iter().map(move |one| one.flags[word])).collect(),
        },
    }
}

fn response_equals<R: Real>(law: LawForm, count: usize, modes: &[bool]) -> Result<(), Failed> {
    equals(&runs::<R>(law, count), law, true, modes)
}

fn equals<R: Real>(runs: &[Run<R>], law: LawForm, ramp: bool, modes: &[bool]) -> Result<(), Failed> {
    println!("{law:?}: {}", variety(runs));
    // Those that chatter take many times the steps: all others would wait for them.
    let (long, short): (Vec<&Run<R>>, Vec<&Run<R>>) =
        runs.iter().partition(|one| one.flags[FLAG_STEPS] > LONG);
    let groups: Vec<Group<R>> =
        [short, long].iter().filter(|some| !some.is_empty()).map(|some| group(some)).collect();
    compared(&RESPONSE, &choices(law, ramp), (&groups, runs.len()), modes)
}

/// How the twins end, and how many saw what: the comparison is worth what the instances do.
fn variety<R>(runs: &[Run<R>]) -> String {
    let many = |name: &str, holds: fn(u32) -> bool| {
        let word = fields::first_word(RESPONSE.flags, name);
        runs.iter().filter(|one| holds(one.flags[word])).count()
    };
    format!(
        "{} ok, {} at the limit of events, {} take more than {LONG} steps; {} end out of slip, {} impact, \
         {} pass the window twice, {} have events",
        many("status", |status| status == Status::Ok as u32),
        many("status", |status| status == Status::EventLimit as u32),
        many("steps", |steps| steps > LONG),
        many("contact", |contact| contact > 0),
        many("impacts", |impacts| impacts > 0),
        many("second_pass", |pass| pass > 0),
        many("growth_closed", |closed| closed > 0),
    )
}

/// The strict kernel of a changed text, or of changed inputs, against the right twin.
fn noticed(text: &str, group: &Group<f32>) -> Result<(), Failed> {
    let strict = Arithmetic { precision: Precision::F32, strict: true };
    let actual = on_gpu(&device(strict)?, &RESPONSE, text, &group.inputs)?;
    match differing(&RESPONSE, &actual, &group.twin)? {
        (0, _) => Err("the fault was not noticed".into()),
        (count, first) => {
            println!("{count} instances differ, {first}");
            Ok(())
        }
    }
}

fn text() -> String {
    RESPONSE.source(Precision::F32, &choices(LawForm::Pieces, true))
}

fn changed_operation() -> Result<(), Failed> {
    let (from, to) = ("weight * (x.v * x.v + w.v * w.v)", "weight * (w.v * w.v) + weight * (x.v * x.v)");
    let changed = text().replace(from, to);
    if changed == text() {
        return Err("nothing was changed".into());
    }
    noticed(&changed, &group(&runs(LawForm::Pieces, FEW).iter().collect::<Vec<_>>()))
}

fn changed_scene() -> Result<(), Failed> {
    let mut group = group(&runs::<f32>(LawForm::Pieces, FEW).iter().collect::<Vec<_>>());
    // k2 of instance 77.
    let word = &mut group.inputs[4 * FEW + 77];
    *word = word.next_up();
    noticed(&text(), &group)
}
