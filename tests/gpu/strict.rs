//! Strict kernels against their twins: on a software driver every bit of every word is the same; on hardware,
//! where a division may be off by 2.5 ulp and denormals may be 0, the differing instances are counted.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use crate::Case;
use crate::instances::{Uniform, moving};
use crate::response::{on_device, plan};
use crate::twin::{Chunk, outcomes_seen, settings};
use crate::words::{device, drive, inputs, on_cpu};
use libtest_mimic::Failed;
use squealmap::engine::fields;
use squealmap::engine::gpu::arithmetic::Arithmetic;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::{ChunkResult, run};
use squealmap::engine::kernel::linear;
use squealmap::engine::kernel::places::{TOGETHER, place};
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::source::Kernel;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::marching::Way;
use squealmap::engine::march::table::head;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::precision::Precision;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::piece::LawForm;
use squealmap::model::status::Status;

/// Instances of a comparison of eigenvalues.
const COUNT: usize = 65_536;

/// Instances of a comparison of transients, whose twin is slow: 65 536 take it a quarter of an hour for each law.
/// `SQUEALMAP_STRICT_INSTANCES` asks for more, in f32 and in f64.
const MARCHED: usize = 4096;

/// Instances of a planted fault, and of a transient in f64.
const FEW: usize = 2000;

pub(crate) const CASES: &[Case] = &[
    ("strict::linear_equals_its_twin_in_every_bit", linear_equals::<f32>),
    ("strict::some_of_every_law_equal_their_twin_in_every_bit", || {
        LawForm::ALL.into_iter().try_for_each(|law| march_equals::<f32>(law, FEW, &[true]))
    }),
    ("strict::one_ulp_in_one_scene_is_noticed", changed_scene),
];

/// What takes a software adapter half a minute and more, in f32.
pub(crate) const SLOW: &[Case] = &[
    ("strict::one_changed_operation_is_noticed", changed_operation),
    ("strict::pieces_equal_their_twin_in_every_bit", || {
        march_equals::<f32>(LawForm::Pieces, marched(MARCHED), &[false, true])
    }),
    ("strict::exponential_equals_its_twin_in_every_bit", || {
        march_equals::<f32>(LawForm::Exponential, marched(MARCHED), &[true])
    }),
    ("strict::rational_equals_its_twin_in_every_bit", || {
        march_equals::<f32>(LawForm::Rational, marched(MARCHED), &[true])
    }),
];

/// What takes it as long in f64.
pub(crate) const SLOW_F64: &[Case] = &[
    ("strict::pieces_in_f64_equal_their_twin_in_every_bit", || {
        march_equals::<f64>(LawForm::Pieces, marched(FEW), &[false, true])
    }),
    ("strict::exponential_in_f64_equals_its_twin_in_every_bit", || {
        march_equals::<f64>(LawForm::Exponential, marched(FEW), &[true])
    }),
    ("strict::rational_in_f64_equals_its_twin_in_every_bit", || {
        march_equals::<f64>(LawForm::Rational, marched(FEW), &[true])
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
    let words = [kernel.state, kernel.flags].map(fields::words);
    if (actual.state.len(), actual.flags.len()) != (expected.state.len(), expected.flags.len()) {
        return Err("results of different sizes".into());
    }
    let mut differs = vec![false; expected.flags.len() / words[1]];
    let mut first = String::new();
    let mut note = |index: usize, words: usize, a: String, b: String| {
        let (group, at) = (index / (words * TOGETHER), index % (words * TOGETHER));
        let instance = group * TOGETHER + at % TOGETHER;
        if first.is_empty() {
            first = format!("word {} of instance {instance}: {a} instead of {b}", at / TOGETHER);
        }
        differs[instance] = true;
    };
    for (index, (a, b)) in actual.flags.iter().zip(&expected.flags).enumerate() {
        if a != b {
            note(index, words[1], format!("flag {a}"), format!("{b}"));
        }
    }
    for (index, (a, b)) in actual.state.iter().zip(&expected.state).enumerate() {
        let (a, b) = (a.to_f64(), b.to_f64());
        if a.to_bits() != b.to_bits() {
            note(index, words[0], format!("{a:e}"), format!("{b:e}"));
        }
    }
    Ok((differs.into_iter().filter(|one| *one).count(), first))
}

fn linear_equals<R: Real>() -> Result<(), Failed> {
    let inputs = inputs::<R>(COUNT);
    let twin = on_cpu(&inputs, COUNT);
    for strict in [false, true] {
        let device = device(Arithmetic { precision: R::PRECISION, strict })?;
        let actual =
            run(&device, &Compiled::new(&device, &linear::KERNEL, &[])?, (&inputs, COUNT), &drive())?;
        let (different, first) = differing(&linear::KERNEL, &actual, &twin)?;
        println!("strict {strict}: {different} of {COUNT} instances differ on {}", device.describe());
        if strict && device.describe().device_type == "software" && different > 0 {
            return Err(format!("{different} of {COUNT} instances differ: {first}").into());
        }
    }
    Ok(())
}

/// A random instance of a law.
fn instance(u: &mut Uniform, law: LawForm) -> Instance {
    let params = moving(u);
    let (mu_s, mu_d, scale) = (0.9 * u.next(), 0.9 * u.next(), u.log(0.1, 10.0));
    let law = match law {
        LawForm::Pieces => FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: scale },
        LawForm::Exponential => FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: scale },
        LawForm::Rational => FrictionLaw::Rational { mu_s, decay: scale },
    };
    // Half of the belts that move have many corners, with and without an acceleration between them.
    let moves = params.get(Param::RampDuration).is_some();
    let motion = if moves && mu_s > 0.45 { Motion::Sine } else { Motion::Ramp };
    Instance { params, law, impact_friction: u.next() < 0.5, motion, heating: None, modal: None }
}

/// How many transients are compared, `without` a wish.
fn marched(without: usize) -> usize {
    std::env::var("SQUEALMAP_STRICT_INSTANCES").ok().and_then(|count| count.parse().ok()).unwrap_or(without)
}

/// As many random instances as can be integrated, run by the twin: the parts of their legs that any of them goes through.
fn chunks<R: Lanes>(u: &mut Uniform, law: LawForm, count: usize) -> Vec<Chunk<R>> {
    let plan = plan(0.5, 1.5);
    let live = |one: &Instance| Scene::planned(one, &plan).is_ok();
    let instances: Vec<Instance> =
        std::iter::repeat_with(|| instance(u, law)).filter(live).take(count).collect();
    let mut chunks = Vec::new();
    let outcomes = outcomes_seen::<R, 64>(&instances, &plan, |chunk| {
        if chunk.begun() > 0 {
            chunks.push(chunk);
        }
    });
    let many = |holds: fn(&Outcome) -> bool| outcomes.iter().filter(|one| holds(one)).count();
    let cost = chunks.iter().fold([0, 0], |[issued, useful], one: &Chunk<R>| {
        [issued + one.count().issued, useful + one.count().useful]
    });
    println!(
        "{law:?}, lanes at work {:.0} % of the time: {} ok, {} at the limit of events; {} stick, {} fly; {} have events",
        100.0 * cost[1] as f64 / (64.0 * cost[0] as f64),
        many(|one| one.status == Status::Ok),
        many(|one| one.status == Status::EventLimit),
        many(|one| one.stick > Some(0.0)),
        many(|one| one.free > Some(0.0)),
        many(|one| one.met_event),
    );
    chunks
}

/// The kernel of a chunk on an open device, from some text and inputs.
fn again<R: Lanes>(
    device: &Device,
    chunk: &Chunk<R>,
    text: &str,
    inputs: &[R],
) -> Result<ChunkResult<R>, Failed> {
    let (kernel, _) = chunk.form.kernel(chunk.part).ok_or("no kernel")?;
    on_kernel(device, &Compiled::from_source(device, kernel, text)?, chunk, inputs)
}

/// The same by a kernel that is compiled.
fn on_kernel<R: Lanes>(
    device: &Device,
    compiled: &Compiled,
    chunk: &Chunk<R>,
    inputs: &[R],
) -> Result<ChunkResult<R>, Failed> {
    let way = Way::new::<R>(plan(0.5, 1.5));
    on_device(device, compiled, chunk, inputs, (settings(&way), u32::MAX))
}

fn text<R: Real>(chunk: &Chunk<R>) -> Result<String, Failed> {
    let (kernel, choices) = chunk.form.kernel(chunk.part).ok_or("no kernel")?;
    Ok(kernel.source(R::PRECISION, &choices))
}

/// Whole runs, part by part, on a device that is strict or not as `modes` say: each from what the twin has come to.
fn march_equals<R: Lanes>(law: LawForm, count: usize, modes: &[bool]) -> Result<(), Failed> {
    let mut u = Uniform(11);
    // Memory holds the parts of so many.
    (0..count)
        .step_by(MARCHED)
        .try_for_each(|first| some_march_equals::<R>(&mut u, law, MARCHED.min(count - first), modes))
}

fn some_march_equals<R: Lanes>(
    u: &mut Uniform,
    law: LawForm,
    count: usize,
    modes: &[bool],
) -> Result<(), Failed> {
    // Some of them have more than a growth and a window, which are the least.
    let chunks = chunks::<R>(u, law, count);
    let parts: BTreeSet<(Part, bool)> = chunks.iter().map(|one| (one.part, one.form.ramp)).collect();
    assert_eq!(parts.len(), 6, "every part of a run, on belts with a ramp and without");
    for strict in modes {
        let device = device(Arithmetic { precision: R::PRECISION, strict: *strict })?;
        let (mut runs, mut different, mut first) = (0, 0, String::new());
        let mut compiled = BTreeMap::new();
        let began = Instant::now();
        for chunk in &chunks {
            let (kernel, _) = chunk.form.kernel(chunk.part).ok_or("no kernel")?;
            let compiled = match compiled.entry((chunk.part, chunk.form)) {
                Entry::Occupied(made) => made.into_mut(),
                Entry::Vacant(place) => place.insert(Compiled::from_source(&device, kernel, &text(chunk)?)?),
            };
            let actual = on_kernel(&device, compiled, chunk, &chunk.inputs)?;
            let (count, what) = differing(kernel, &actual, &chunk.result)?;
            runs += chunk.begun();
            different += count;
            if first.is_empty() && count > 0 {
                first = format!("{:?} {:?}: {what}", chunk.part, chunk.form);
            }
        }
        let mode = if *strict { "strict" } else { "not strict" };
        println!(
            "{mode}: {different} of {runs} parts of runs differ, {:.1} s on {}",
            began.elapsed().as_secs_f64(),
            device.describe()
        );
        let software = device.describe().device_type == "software";
        if runs < 2 * count || *strict && software && different > 0 {
            return Err(format!("{different} of {runs} parts of runs differ: {first}").into());
        }
    }
    Ok(())
}

/// The strict kernel of a changed text, or of changed inputs, against the right twin.
fn noticed(chunk: &Chunk<f32>, text: &str, inputs: &[f32]) -> Result<(), Failed> {
    let device = device(Arithmetic { precision: Precision::F32, strict: true })?;
    let (kernel, _) = chunk.form.kernel(chunk.part).ok_or("no kernel")?;
    match differing(kernel, &again(&device, chunk, text, inputs)?, &chunk.result)? {
        (0, _) => Err("the fault was not noticed".into()),
        (count, first) => {
            println!("{count} instances differ, {first}");
            Ok(())
        }
    }
}

/// The first windows.
fn window() -> Result<Chunk<f32>, Failed> {
    let chunks = chunks(&mut Uniform(11), LawForm::Pieces, FEW);
    Ok(chunks.into_iter().find(|one| one.part == Part::Window).ok_or("no window")?)
}

fn changed_operation() -> Result<(), Failed> {
    let chunk = window()?;
    let (from, to) = ("m.vx * m.vx + m.vw * m.vw", "m.vw * m.vw + m.vx * m.vx");
    let (right, from_sum) = (text(&chunk)?, "places += weight * vec4<real>(d.x, d.x * d.x, d.y, d.y * d.y);");
    // A sum of two is the same in either order.
    noticed_not(&chunk, &right.replace(from, to))?;
    let to_sum = "places += vec4<real>(d.x, d.x * d.x, d.y, d.y * d.y) * tau * sample_weight(i);";
    let changed = right.replace(from_sum, to_sum);
    if changed == right {
        return Err("nothing was changed".into());
    }
    noticed(&chunk, &changed, &chunk.inputs)
}

/// The opposite of [`noticed`].
fn noticed_not(chunk: &Chunk<f32>, text: &str) -> Result<(), Failed> {
    match noticed(chunk, text, &chunk.inputs) {
        Ok(()) => Err("a fault where there is none".into()),
        Err(_) => Ok(()),
    }
}

fn changed_scene() -> Result<(), Failed> {
    let chunk = window()?;
    let mut inputs = chunk.inputs.clone();
    // The first coefficient of a form of instance 77.
    let word = &mut inputs[place([head::R, chunk.form.inputs()], 77)];
    *word = word.next_up();
    noticed(&chunk, &text(&chunk)?, &inputs)
}
