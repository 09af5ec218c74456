//! The kernel that marches instances through a leg; the part of the run and the pieces of the law are chosen when it is
//! compiled.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use crate::engine::fields::Field;
use crate::engine::kernel::source::{Constant, Kernel};
use crate::engine::lanes::ORDER;
use crate::engine::lanes::contact as states;
use crate::engine::lanes::function::HIGHEST_ORDER;
use crate::engine::lanes::job::{FIRST_STRETCH, LAST_STRETCH, LONG_STRETCH, Part, STRETCH};
use crate::engine::lanes::nodes::{NODES, WEIGHTS};
use crate::engine::lanes::reach::{FAR, LONGER, MARGIN, SHORTEST};
use crate::engine::lanes::spectrum::{CLOSING, COMPONENTS};
use crate::engine::lanes::words::EVENTS_AT_ONCE;
use crate::engine::march::series;
use crate::engine::march::table::{SETTINGS, flag, head, history, piece, state};
use crate::engine::method::pace::{HARDER, HIDDEN, LEFT_BEHIND};
use crate::engine::reference::bounds::{MAX_EVENTS_PER_PERIOD, MAX_STEPS_PER_PERIOD, ROUNDINGS};
use crate::engine::sums::{growth, sum};
use crate::model::contact::SLOWEST_REBOUND;
use crate::model::piece::{FAR as NEAR, LawForm};

/// Most pieces of a friction law in a kernel, and those of each that is compiled.
pub const PIECES: [usize; 7] = [1, 2, 4, 16, 64, 256, 1024];

/// Most pieces of a friction law.
pub const MOST_PIECES: usize = PIECES[PIECES.len() - 1];

/// Where the files of the kernel are, and their text; that of the series is made.
static FILES: LazyLock<[(&str, &str); 5]> = LazyLock::new(|| {
    [
        ("shaders/march.wgsl", include_str!("../../../shaders/march.wgsl")),
        ("src/engine/march/series.rs", Box::leak(series::text(ORDER).into_boxed_str())),
        ("shaders/march_window.wgsl", include_str!("../../../shaders/march_window.wgsl")),
        ("shaders/march_stretch.wgsl", include_str!("../../../shaders/march_stretch.wgsl")),
        ("shaders/march_main.wgsl", include_str!("../../../shaders/march_main.wgsl")),
    ]
});

static KERNELS: LazyLock<[Kernel; PIECES.len()]> = LazyLock::new(|| PIECES.map(kernel));

/// The smallest kernel that holds laws of `pieces` pieces, and how many it holds; `None` when there is none.
#[must_use]
pub fn kernel_for(pieces: usize) -> Option<(&'static Kernel, usize)> {
    let place = PIECES.iter().position(|holds| pieces <= *holds)?;
    Some((&KERNELS[place], PIECES[place]))
}

#[expect(clippy::cast_possible_truncation, reason = "small constants become words of a kernel")]
fn kernel(pieces: usize) -> Kernel {
    let mut inputs: Vec<Field> = head::FIELDS.to_vec();
    inputs.push(Field::many("pieces", pieces * piece::WORDS));
    Kernel {
        name: "march",
        files: &*FILES,
        inputs: Vec::leak(inputs),
        state: &state::FIELDS,
        flags: &flag::FIELDS,
        settings: &SETTINGS,
        tables: &[
            ("SUM", &sum::FIELDS),
            ("GROWTH", &growth::FIELDS),
            ("HISTORY", &history::FIELDS),
            ("PIECE", &piece::FIELDS),
        ],
        constants: Vec::leak(vec![
            ("PIECES", Constant::U32(pieces as u32)),
            ("STATE_SENT", Constant::U32(state::SENT as u32)),
            ("FLAG_SENT", Constant::U32(flag::SENT as u32)),
            ("PART_GROWTH", Constant::U32(Part::Growth as u32)),
            ("PART_SETTLE", Constant::U32(Part::Settle as u32)),
            ("PART_WINDOW", Constant::U32(Part::Window as u32)),
            ("COMPONENTS", Constant::U32(COMPONENTS as u32)),
            ("STRETCH", Constant::U32(STRETCH)),
            ("LONG_STRETCH", Constant::U32(LONG_STRETCH)),
            ("LAST_STRETCH", Constant::U32(LAST_STRETCH)),
            ("FIRST_STRETCH", Constant::U32(FIRST_STRETCH)),
            ("TAU", Constant::Real(TAU)),
            ("CLOSING", Constant::Real(CLOSING)),
            ("STEPS_PER_PERIOD", Constant::Real(f64::from(MAX_STEPS_PER_PERIOD))),
            ("EVENTS_PER_PERIOD", Constant::Real(f64::from(MAX_EVENTS_PER_PERIOD))),
            ("SLIP", Constant::U32(states::SLIP)),
            ("REVERSE", Constant::U32(states::REVERSE)),
            ("STICK", Constant::U32(states::STICK)),
            ("FREE", Constant::U32(states::FREE)),
            ("HIGHEST_ORDER", Constant::U32(HIGHEST_ORDER as u32)),
            ("HELD_FROM", Constant::U32(states::HELD_FROM)),
            ("EVENTS_AT_ONCE", Constant::U32(EVENTS_AT_ONCE)),
            ("ROUNDINGS", Constant::Real(ROUNDINGS)),
            ("SLOWEST_REBOUND", Constant::Real(SLOWEST_REBOUND)),
            ("LONGER", Constant::Real(LONGER)),
            ("MARGIN", Constant::Real(MARGIN)),
            ("FAR", Constant::Real(FAR)),
            ("SHORTEST", Constant::Real(SHORTEST)),
            ("ENOUGH", Constant::Real(ENOUGH)),
            ("HARDER", Constant::Real(HARDER)),
            ("HIDDEN", Constant::Real(HIDDEN)),
            ("LEFT_BEHIND", Constant::Real(LEFT_BEHIND)),
            ("LAW_PIECES", Constant::U32(LawForm::Pieces as u32)),
            ("LAW_EXPONENTIAL", Constant::U32(LawForm::Exponential as u32)),
            ("NEAR", Constant::Real(NEAR)),
            ("NODE_0", Constant::Real(NODES[0])),
            ("NODE_1", Constant::Real(NODES[1])),
            ("NODE_2", Constant::Real(NODES[2])),
            ("WEIGHT_0", Constant::Real(WEIGHTS[0])),
            ("WEIGHT_1", Constant::Real(WEIGHTS[1])),
            // What a search of an event function is at: its samples, a dip between two of them, its root.
            ("SAMPLES", Constant::U32(0)),
            ("DIP", Constant::U32(1)),
            ("ROOT", Constant::U32(2)),
        ]),
        // Three searches, the searches for a piece at an impact, and the sums of a stretch.
        loops_per_step: 200 + 3 * (pieces as u32 - 1),
    }
}

/// A root is found when the square of the last step of Newton's method, which squares its error, was below this many
/// roundings of the step.
const ENOUGH: f64 = 0.08;

/// The parts of the kernel that are chosen: the part of the run, the form of the law, and whether the belt has a ramp.
#[must_use]
pub fn choices(part: Part, law: LawForm, ramp: bool) -> Vec<(&'static str, Constant)> {
    vec![
        ("PART", Constant::U32(part as u32)),
        ("LAW", Constant::U32(law as u32)),
        ("RAMP", Constant::Bool(ramp)),
    ]
}
