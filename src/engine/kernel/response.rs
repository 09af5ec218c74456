//! An instance into a kernel's words, and a lane's records into an outcome (host only).

#![expect(clippy::cast_possible_truncation, reason = "small constants become words of a kernel")]

use crate::engine::fields::Field;
use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{
    FIRST_HALF, OPEN_HALF, SECOND_HALF, SEGMENTS, SETTLE, Scene as Words, Segments,
};
use crate::engine::kernel::source::{Constant, Kernel};
use crate::engine::kernel::table::{flag, head, piece, segment, state};
use crate::engine::kernel::windows::Windows;
use crate::engine::kernel::{contact, crossing, lane, observe, scene, series, steps};
use crate::engine::method::pace::Turns;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::bounds::MAX_EVENTS_PER_PERIOD;
use crate::engine::reference::bounds::MAX_STEPS_PER_PERIOD;
use crate::engine::reference::bounds::ROUNDINGS;
use crate::engine::scene::{MOST_STEPS, Scene};
use crate::engine::sums::{growth, peak, phase, sum};
use crate::model::instance::Instance;
use crate::model::piece::{FAR, LawForm};
use std::f64::consts::TAU;

/// Most pieces of a friction law in a kernel: the rows of the longest table.
pub const MOST_PIECES: usize = 1024;

/// The smallest kernel that holds laws of `pieces` pieces, and how many it holds; `None` above
/// [`MOST_PIECES`].
#[must_use]
pub fn kernel_for(pieces: usize) -> Option<&'static (Kernel, usize)> {
    static KERNELS: [(Kernel, usize); 7] = [
        (KERNEL, 1),
        (kernel::<2>(), 2),
        (kernel::<4>(), 4),
        (kernel::<16>(), 16),
        (kernel::<64>(), 64),
        (kernel::<256>(), 256),
        (kernel::<MOST_PIECES>(), MOST_PIECES),
    ];
    KERNELS.iter().find(|(_, holds)| pieces <= *holds)
}

/// The settings that all instances share.
const SETTINGS: &[Field] = &[Field::one("tolerance")];

/// The response kernel for laws of one piece.
pub const KERNEL: Kernel = kernel::<1>();

/// The response kernel for laws of up to `PIECES` pieces.
#[must_use]
pub const fn kernel<const PIECES: usize>() -> Kernel {
    Kernel {
        name: "response",
        files: &[
            ("shaders/scene.wgsl", include_str!("../../../shaders/scene.wgsl")),
            ("shaders/series.wgsl", include_str!("../../../shaders/series.wgsl")),
            ("shaders/crossing.wgsl", include_str!("../../../shaders/crossing.wgsl")),
            ("shaders/observe.wgsl", include_str!("../../../shaders/observe.wgsl")),
            ("shaders/contact.wgsl", include_str!("../../../shaders/contact.wgsl")),
            ("shaders/lane.wgsl", include_str!("../../../shaders/lane.wgsl")),
            ("shaders/response_main.wgsl", include_str!("../../../shaders/response_main.wgsl")),
        ],
        inputs: const { &inputs::<PIECES>() },
        state: &state::FIELDS,
        flags: &flag::FIELDS,
        settings: SETTINGS,
        tables: &[
            ("SUM", &sum::FIELDS),
            ("PEAK", &peak::FIELDS),
            ("GROWTH", &growth::FIELDS),
            ("PHASE", &phase::FIELDS),
            ("SEGMENT", &segment::FIELDS),
            ("PIECE", &piece::FIELDS),
        ],
        constants: const {
            &[
                ("LAW_PIECES", Constant::U32(LawForm::Pieces as u32)),
                ("LAW_EXPONENTIAL", Constant::U32(LawForm::Exponential as u32)),
                ("LAW_RATIONAL", Constant::U32(LawForm::Rational as u32)),
                ("PIECES", Constant::U32(PIECES as u32)),
                ("SEGMENTS", Constant::U32(SEGMENTS as u32)),
                ("SETTLE", Constant::U32(SETTLE)),
                ("FIRST_HALF", Constant::U32(FIRST_HALF)),
                ("SECOND_HALF", Constant::U32(SECOND_HALF)),
                ("OPEN_HALF", Constant::U32(OPEN_HALF)),
                ("FAR", Constant::Real(FAR)),
                ("NO_KINK", Constant::Real(scene::NO_KINK)),
                ("EXP_DEGREE", Constant::U32(scene::EXP_DEGREE as u32)),
                ("ORDER", Constant::U32(steps::ORDER as u32)),
                ("SERIES", Constant::U32(steps::ORDER as u32 + 1)),
                ("MAX_HALVINGS", Constant::U32(series::MAX_HALVINGS as u32)),
                ("SLIP", Constant::U32(series::SLIP)),
                ("REVERSE", Constant::U32(series::REVERSE)),
                ("STICK", Constant::U32(series::STICK)),
                ("FREE", Constant::U32(series::FREE)),
                ("SAMPLES", Constant::U32(crossing::SAMPLES as u32)),
                ("SOLVER_ITERATIONS", Constant::U32(crossing::SOLVER_ITERATIONS as u32)),
                ("HIGHEST_ORDER", Constant::U32(crossing::HIGHEST_ORDER as u32)),
                ("NEVER", Constant::Real(crossing::NEVER)),
                ("DIP", Constant::Real(crossing::DIP)),
                ("DIP_ITERATIONS", Constant::U32(crossing::DIP_ITERATIONS as u32)),
                ("NODES", Constant::U32(observe::NODES.len() as u32)),
                ("NODE_0", Constant::Real(observe::NODES[0])),
                ("NODE_1", Constant::Real(observe::NODES[1])),
                ("NODE_2", Constant::Real(observe::NODES[2])),
                ("WEIGHT_0", Constant::Real(observe::WEIGHTS[0])),
                ("WEIGHT_1", Constant::Real(observe::WEIGHTS[1])),
                ("WEIGHT_2", Constant::Real(observe::WEIGHTS[2])),
                ("STEP_SAMPLES", Constant::U32(observe::STEP_SAMPLES as u32)),
                ("GROWTH_SAMPLED", Constant::U32(growth::SAMPLED as u32)),
                ("ROTATION_TERMS", Constant::U32(observe::ROTATION_TERMS as u32)),
                ("BISECTIONS", Constant::U32(observe::BISECTIONS as u32)),
                ("TAU", Constant::Real(TAU)),
                ("ROUNDINGS", Constant::Real(ROUNDINGS)),
                ("HELD_FROM", Constant::U32(contact::HELD_FROM)),
                ("LEAST_REST", Constant::Real(lane::LEAST_REST)),
                ("STEPS_PER_SUM", Constant::U32(lane::STEPS_PER_SUM)),
                ("MOST_STEPS", Constant::U32(MOST_STEPS)),
                ("MAX_STEPS_PER_PERIOD", Constant::U32(MAX_STEPS_PER_PERIOD)),
                ("MAX_EVENTS_PER_PERIOD", Constant::U32(MAX_EVENTS_PER_PERIOD)),
                ("EVENTS_AT_ONCE", Constant::U32(scene::EVENTS_AT_ONCE)),
                ("NOTHING", Constant::U32(contact::NOTHING)),
                ("REST", Constant::U32(contact::REST)),
                ("LOWER_KINK", Constant::U32(contact::LOWER_KINK)),
                ("UPPER_KINK", Constant::U32(contact::UPPER_KINK)),
                ("LIFT_OFF", Constant::U32(contact::LIFT_OFF)),
                ("CONE_FORWARD", Constant::U32(contact::CONE_FORWARD)),
                ("CONE_BACKWARD", Constant::U32(contact::CONE_BACKWARD)),
                ("GAP", Constant::U32(contact::GAP)),
            ]
        },
        loops_per_step: LOOPS_PER_STEP + SEARCHES_PER_STEP * (PIECES as u32 - 1),
    }
}

/// The words of an instance of a kernel for laws of up to `PIECES` pieces.
const fn inputs<const PIECES: usize>() -> [Field; head::FIELDS.len() + 2] {
    let mut all = [Field::one(""); head::FIELDS.len() + 2];
    let mut k = 0;
    while k < head::FIELDS.len() {
        all[k] = head::FIELDS[k];
        k += 1;
    }
    all[k] = Field::many("segments", SEGMENTS * segment::WORDS);
    all[k + 1] = Field::many("pieces", PIECES * piece::WORDS);
    all
}

/// Most loop iterations of one step, every loop at its longest, without the searches for a piece of the law.
const LOOPS_PER_STEP: u32 = 1900;

/// Most searches for a piece in one step, each over all pieces: an impact looks for that before it and that
/// after it.
const SEARCHES_PER_STEP: u32 = 2;

/// The parts of the kernel that a scene selects: the form of its law, and whether its belt has a ramp.
#[must_use]
pub const fn choices(law: LawForm, ramp: bool) -> [(&'static str, Constant); 2] {
    [("LAW", Constant::U32(law as u32)), ("RAMP", Constant::Bool(ramp))]
}

/// The words of an instance for kernels built for `pieces` pieces.
#[must_use]
pub fn words(scene: &Scene, segments: &Segments, pieces: usize) -> Vec<f64> {
    scene::words(&scene.model, scene.belt(0.0).velocity, start(scene), segments, pieces)
}

/// An instance as the kernel's twin has it, without segments, for steps that may turn so far.
#[must_use]
pub fn without_segments<S: Real>(law: LawForm, scene: &Scene, turns: &Turns) -> Words<S> {
    Words::of(law, &scene.model, scene.belt(0.0).velocity, start(scene), turns)
}

/// `x2`, `y1`, `ẋ2`, `ẏ1` at the start.
fn start(scene: &Scene) -> [f64; 4] {
    let start = scene.start();
    [start.position[0], start.position[2], start.velocity[0], start.velocity[2]]
}

/// Integrates one instance with the twin of the kernel.
#[must_use]
pub fn respond<S: Real>(instance: &Instance, plan: &Plan, tolerance: f64) -> Outcome {
    let scene = match Scene::planned(instance, plan) {
        Ok(scene) => scene,
        Err(status) => return Outcome { status, ..Outcome::default() },
    };
    let pieces = scene.model.law.pieces.len();
    let mut windows = Windows::new(instance, &scene, plan);
    let mut lane: Option<Lane<S>> = None;
    loop {
        let packed = words(&scene, &windows.segments, pieces);
        let words: Words<S> = Words::read(instance.law.kind().form(), pieces, &packed);
        let lane = lane.get_or_insert_with(|| Lane::new(&words));
        lane.run(&words, S::from_f64(tolerance));
        if let Some(outcome) = windows.take(&scene, lane) {
            return outcome;
        }
    }
}
