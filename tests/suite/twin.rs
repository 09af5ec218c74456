//! The kernels of the march on the CPU, operation by operation: their twin, made of their own text.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock, Mutex};

use bytemuck::Pod;
use rayon::prelude::*;
use squealmap::engine::fields::words;
use squealmap::engine::gpu::run::ChunkResult;
use squealmap::engine::kernel::places::{Column, filled, place, room};
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::source::{Kernel, PROGRESS_WORDS, SETTING_WORDS, Settings};
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::job::Part;
use squealmap::engine::lanes::march::{Settings as OfLanes, Terms};
use squealmap::engine::march::marching::{Form, Marching, PARTS, Way};
use squealmap::engine::march::table::{flag, head, state};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::engine::precision::Precision;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;
use squealmap_lockstep::{Count, Program};

/// Instances of a part of a chunk, each of which is a task of its own.
const TASK: usize = 256;

fn bits<R: Real>(value: R) -> u64 {
    match R::PRECISION {
        Precision::F32 => u64::from(value.bits32()),
        Precision::F64 => value.to_f64().to_bits(),
    }
}

fn number<R: Real>(bits: u64) -> R {
    match R::PRECISION {
        Precision::F32 => R::from_f64(f64::from(f32::from_bits(low(bits)))),
        Precision::F64 => R::from_f64(f64::from_bits(bits)),
    }
}

fn low(bits: u64) -> u32 {
    u32::try_from(bits & u64::from(u32::MAX)).expect("32 bits")
}

/// A part of a chunk that is done.
struct Done {
    /// State and flags.
    words: [Vec<u64>; 2],
    /// By the functions of the kernel.
    cost: Vec<Count>,
}

/// What a kernel makes of a chunk of so many lanes, in warps of `W`; the words are as on a device.
pub(crate) fn run<R: Real, const W: usize>(
    program: &Program,
    kernel: &Kernel,
    (inputs, count): (&[R], usize),
    before: Option<&(Vec<R>, Vec<u32>)>,
    settings: [u32; SETTING_WORDS],
) -> (ChunkResult<R>, Vec<Count>) {
    let [per_input, per_state, per_flag] = [kernel.inputs, kernel.state, kernel.flags].map(words);
    let tasks: Vec<usize> = (0..count).step_by(TASK).collect();
    let parts: Vec<Done> = tasks
        .into_par_iter()
        .map(|first| {
            let lanes = TASK.min(count - first);
            let part = |words: usize, of: &dyn Fn(usize) -> u64| -> Vec<u64> {
                let begin = place([0, words], first);
                (begin..begin + words * room(lanes)).map(of).collect()
            };
            let head = Settings::new([lanes, per_state], u32::MAX, 0, settings);
            let mut buffers = [
                bytemuck::cast_slice::<Settings, u32>(&[head]).iter().map(|word| u64::from(*word)).collect(),
                part(per_input, &|at| bits(inputs[at])),
                part(per_state, &|at| before.map_or(0, |(state, _)| bits(state[at]))),
                part(per_flag, &|at| before.map_or(0, |(_, flags)| u64::from(flags[at]))),
                vec![0; PROGRESS_WORDS],
            ];
            let cost = program.run::<W>(lanes, &mut buffers);
            let [_, _, state, flags, _] = buffers;
            Done { words: [state, flags], cost }
        })
        .collect();
    let mut cost = vec![Count::default(); program.functions().len()];
    for one in &parts {
        for (all, one) in cost.iter_mut().zip(&one.cost) {
            *all += *one;
        }
    }
    let of = |which: usize| parts.iter().flat_map(move |part| part.words[which].iter().copied());
    let result =
        ChunkResult { state: of(0).map(number).collect(), flags: of(1).map(low).collect(), cancelled: false };
    (result, cost)
}

/// A kernel as a program, made once.
pub(crate) fn program(form: Form, part: Part, precision: Precision) -> (&'static Kernel, Arc<Program>) {
    type Made = BTreeMap<(Form, Part, usize), Arc<Program>>;
    static MADE: LazyLock<Mutex<Made>> = LazyLock::new(Mutex::default);
    let (kernel, choices) = form.kernel(part).expect("a kernel for the pieces of the law");
    let mut made = MADE.lock().expect("nobody has panicked");
    let program = made.entry((form, part, precision.bytes())).or_insert_with(|| {
        Arc::new(Program::new(&kernel.source(precision, &choices)).expect("a kernel that compiles"))
    });
    (kernel, program.clone())
}

/// The words of the settings.
pub(crate) fn settings(way: &Way) -> [u32; SETTING_WORDS] {
    let mut settings = [0; SETTING_WORDS];
    settings[0] = way.tolerance.to_bits();
    settings
}

/// Legs that share their kernels, as inputs, state and flags: the first words of these stand in the inputs, the others are 0.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts are words of a kernel")]
fn buffers<R: Real>(rows: &[Vec<R>]) -> (Vec<R>, (Vec<R>, Vec<u32>)) {
    fn of<T: Pod + Send + Sync>(rows: &[Vec<T>]) -> Vec<T> {
        filled(rows.first().map_or(0, Vec::len), rows.len(), |index| &rows[index])
    }
    let begun = |row: &Vec<R>| {
        let (mut words, mut flags) = (vec![R::ZERO; state::WORDS], vec![0; flag::WORDS]);
        words[..state::SENT].copy_from_slice(&row[head::START..head::COUNTS]);
        for (flag, count) in flags.iter_mut().zip(&row[head::COUNTS..head::WORDS]) {
            *flag = count.to_f64() as u32;
        }
        (words, flags)
    };
    let (words, flags): (Vec<_>, Vec<_>) = rows.iter().map(begun).unzip();
    (of(rows), (of(&words), of(&flags)))
}

/// One of the lanes of a chunk.
pub(crate) fn lane<R: Real>(result: &ChunkResult<R>, lane: usize) -> (Vec<R>, Vec<u32>) {
    (
        Column::of_buffer(&result.state, state::WORDS, lane).iter().collect(),
        Column::of_buffer(&result.flags, flag::WORDS, lane).iter().collect(),
    )
}

/// Legs that share their kernels.
struct Group<R> {
    form: Form,
    marching: Vec<Marching<R>>,
    rows: Vec<Vec<R>>,
}

/// A leg of an instance: its kernels and its words.
type Begun<R> = (Marching<R>, Form, Vec<R>);

/// Legs by their kernels, each group in the order of its instances.
fn groups<R>(legs: Vec<Begun<R>>) -> Vec<Group<R>> {
    let mut groups: BTreeMap<Form, Group<R>> = BTreeMap::new();
    for (one, form, words) in legs {
        let new = || Group { form, marching: Vec::new(), rows: Vec::new() };
        let group = groups.entry(form).or_insert_with(new);
        group.marching.push(one);
        group.rows.push(words);
    }
    groups.into_values().collect()
}

/// A part of the legs of a chunk that share their kernels, and what the twin makes of it.
pub(crate) struct Chunk<R> {
    pub(crate) form: Form,
    pub(crate) part: Part,
    pub(crate) lanes: usize,
    pub(crate) inputs: Vec<R>,
    pub(crate) before: (Vec<R>, Vec<u32>),
    pub(crate) result: ChunkResult<R>,
    /// What each function of the kernel has cost, by its name.
    pub(crate) by_function: Vec<(String, Count)>,
}

impl<R> Chunk<R> {
    /// What it has cost.
    pub(crate) fn count(&self) -> Count {
        self.by_function.iter().map(|(_, count)| *count).sum()
    }

    /// How many lanes have come to the part.
    pub(crate) fn begun(&self) -> usize {
        let flags = &self.before.1;
        let is_here = |lane: &usize| {
            let of = |word: usize| flags[place([word, flag::WORDS], *lane)];
            of(flag::STATUS) == Status::Unwritten as u32 && of(flag::PART) == self.part as u32
        };
        (0..self.lanes).filter(is_here).count()
    }
}

/// Runs legs that share their kernels through the parts of a run; `seen` gets every part.
pub(crate) fn run_leg<R: Real, const W: usize>(
    form: Form,
    rows: &[Vec<R>],
    settings: [u32; SETTING_WORDS],
    mut seen: impl FnMut(Chunk<R>),
) -> ChunkResult<R> {
    let ((inputs, before), lanes) = (buffers(rows), rows.len());
    let mut result = ChunkResult { state: before.0, flags: before.1, cancelled: false };
    for part in PARTS {
        let (kernel, program) = program(form, part, R::PRECISION);
        let before = (result.state, result.flags);
        let (next, counts) = run::<R, W>(&program, kernel, (&inputs, lanes), Some(&before), settings);
        result = next.clone();
        let by_function = program.functions().iter().cloned().zip(counts).collect();
        seen(Chunk { form, part, lanes, inputs: inputs.clone(), before, result: next, by_function });
    }
    result
}

/// The next leg of an instance, its kernels and its words; `None` at its end.
pub(crate) fn begin<R: Lanes>(one: &mut Marching<R>, way: &Way) -> Option<(Form, Vec<R>)> {
    let form = one.next(way)?;
    let mut words = vec![R::ZERO; form.inputs()];
    one.put(&mut words);
    Some((form, words))
}

/// The responses of some instances in warps of `W`; `seen` gets every part of every leg.
pub(crate) fn outcomes_seen<R: Lanes, const W: usize>(
    instances: &[Instance],
    plan: &Plan,
    mut seen: impl FnMut(Chunk<R>),
) -> Vec<Outcome> {
    let way = Way::new::<R>(*plan);
    let mut made = vec![Outcome::default(); instances.len()];
    let (mut going, mut over) = (Vec::new(), Vec::new());
    for (index, instance) in instances.iter().enumerate() {
        match Marching::new(index, instance, &way) {
            Ok(one) => going.push(one),
            Err(status) => made[index] = Outcome { status, ..Outcome::default() },
        }
    }
    while !going.is_empty() {
        let mut legs = Vec::new();
        for mut one in going.drain(..) {
            match begin(&mut one, &way) {
                Some((form, words)) => legs.push((one, form, words)),
                None => over.push(one),
            }
        }
        for Group { form, marching, rows } in groups(legs) {
            let result = run_leg::<R, W>(form, &rows, settings(&way), &mut seen);
            for (index, mut one) in marching.into_iter().enumerate() {
                let (words, flags) = lane(&result, index);
                let taken = one.take(Column::of_row(&words), Column::of_row(&flags));
                taken.expect("a lane that the kernels have ended");
                going.push(one);
            }
        }
    }
    let cancel = AtomicBool::new(false);
    let settings =
        OfLanes { plan, tolerance: f64::from(way.tolerance), terms: Terms::default(), cancel: &cancel };
    for mut one in over {
        R::run(std::slice::from_mut(&mut one.job), &[Part::Phase], false, settings);
        made[one.index] = one.job.outcome(plan);
    }
    made
}

/// The responses of some instances; few of them in narrow warps, which wait less for the one that takes the most steps.
pub(crate) fn outcomes<R: Lanes>(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    match instances.len() {
        0 | 1 => outcomes_seen::<R, 1>(instances, plan, |_| {}),
        2..=64 => outcomes_seen::<R, 8>(instances, plan, |_| {}),
        65..=256 => outcomes_seen::<R, 16>(instances, plan, |_| {}),
        _ => outcomes_seen::<R, 64>(instances, plan, |_| {}),
    }
}
