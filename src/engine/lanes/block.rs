//! The lanes that step together, each on its own instance, time and contact state.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::constants::{CONE, CONSTANTS, LONGEST, N0, SWING_WORDS, V0};
use crate::engine::lanes::contact::{
    Belt, CONE_BACKWARD, CONE_FORWARD, GAP, LIFT_OFF, LOWER_KINK, NOTHING, REST, State, UPPER_KINK,
};
use crate::engine::lanes::contact::{Body, FREE, REVERSE, SLIP, STICK};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::lanes::words::{EVENTS_AT_ONCE, Words};
use crate::model::piece::LawForm;

/// The event function a lane's normal force or gap belongs to.
pub const FIRST: u32 = 1;
/// The event function of rest, of the lower kink, and of the forward side of the stick cone.
pub const SECOND: u32 = 2;
/// The event function of the upper kink, and of the backward side of the stick cone.
pub const THIRD: u32 = 3;

/// `μ` at zero, slope, rate, offset, lower and upper kink of a lane's piece of the law.
pub const AT_ZERO: usize = 0;
/// `dμ/d|v|`.
pub const SLOPE: usize = 1;
/// Decay rate; the longest step of slip on a straight piece.
pub const RATE: usize = 2;
/// μ at the belt velocity of the equilibrium less that of the equilibrium.
pub const OFFSET: usize = 3;
/// Lower end in `|v|`.
pub const LOWER: usize = 4;
/// Upper end in `|v|`.
pub const UPPER: usize = 5;

/// The value of [`Block::many`] for a law of one piece.
pub const ONE_PIECE: f64 = 0.5;

/// The time, steps and events that a resting lane has left: more than it can ever use.
const ENDLESS: f64 = 1e30;

/// Lanes in step order of their fields.
#[derive(Clone, Copy, Debug)]
pub struct Block<S: Simd, T: Scalar<S>> {
    /// The instruction set.
    pub simd: S,
    /// The form of every lane's law.
    pub law: LawForm,
    /// Constants of the scenes, see [`crate::engine::lanes::constants`].
    pub scene: [Vector<S, T>; CONSTANTS],
    /// The present piece of the law.
    pub piece: [Vector<S, T>; 6],
    /// Positions `x2 y2 y1`, deviations from the equilibrium.
    pub p: [Vector<S, T>; 3],
    /// Velocities.
    pub v: [Vector<S, T>; 3],
    /// Belt velocity.
    pub belt: Vector<S, T>,
    /// Belt acceleration.
    pub drive: Vector<S, T>,
    /// Time left in the present stretch.
    pub left: Vector<S, T>,
    /// The longest step.
    pub step: Vector<S, T>,
    /// The longest step that the last one lets expect.
    pub pace: Vector<S, T>,
    /// Contact state.
    pub contact: Vector<S, T>,
    /// The highest code of the contact states of the present stretch.
    pub reached: Vector<S, T>,
    /// The event function that begins at zero.
    pub disarmed: Vector<S, T>,
    /// The other piece of a law of two.
    pub other: [Vector<S, T>; 6],
    /// 1 for laws of more pieces, [`ONE_PIECE`] for those of one, which have no kink to cross.
    pub many: Vector<S, T>,
    /// Steps of the present stretch.
    pub steps: Vector<S, T>,
    /// The most steps, see [`crate::engine::lanes::count`].
    pub most_steps: Vector<S, T>,
    /// Events of the present stretch.
    pub counted: Vector<S, T>,
    /// The most of them.
    pub most_events: Vector<S, T>,
    /// Events without time between them.
    pub at_once: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Block<S, T> {
    /// Lanes that rest: they stick to a belt at rest, and no force acts.
    #[inline(always)]
    pub fn idle(simd: S, law: LawForm) -> Self {
        let zero = Vector::constant(simd, 0.0);
        let mut block = Block {
            simd,
            law,
            scene: [zero; CONSTANTS],
            piece: [zero; 6],
            p: [zero; 3],
            v: [zero; 3],
            belt: zero,
            drive: zero,
            left: zero,
            step: zero,
            pace: zero,
            contact: zero,
            reached: zero,
            disarmed: zero,
            other: [zero; 6],
            many: zero,
            steps: zero,
            most_steps: zero,
            counted: zero,
            most_events: zero,
            at_once: zero,
        };
        for lane in 0..Vector::<S, T>::LANES {
            block.rest(lane);
        }
        block
    }

    /// Lets a lane rest.
    #[inline(always)]
    pub fn rest(&mut self, lane: usize) {
        for word in self.scene.iter_mut().chain(&mut self.piece).chain(&mut self.p).chain(&mut self.v) {
            word.set(lane, T::ZERO);
        }
        for constant in [N0, CONE, CONE + 1, LONGEST, LONGEST + 1, LONGEST + 2, LONGEST + 3] {
            self.scene[constant].set(lane, T::ONE);
        }
        self.belt.set(lane, T::ZERO);
        self.drive.set(lane, T::ZERO);
        self.left.set(lane, T::from_f64(ENDLESS));
        self.step.set(lane, T::ONE);
        self.pace.set(lane, T::ONE);
        self.contact.set(lane, T::from_f64(f64::from(STICK)));
        self.disarmed.set(lane, T::ZERO);
        self.steps.set(lane, T::ZERO);
        self.most_steps.set(lane, T::from_f64(ENDLESS));
        self.counted.set(lane, T::ZERO);
        self.most_events.set(lane, T::from_f64(ENDLESS));
        self.at_once.set(lane, T::ZERO);
    }

    /// Loads the scene of an instance.
    #[inline(always)]
    pub fn load_scene(&mut self, lane: usize, constants: &[T; CONSTANTS], scene: &Words<T>) {
        for (word, value) in self.scene.iter_mut().zip(constants) {
            word.set(lane, *value);
        }
        self.scene[V0].set(lane, scene.v0);
    }

    /// Loads what the steps in closed form need of a single mass; the rest stays 0, which in transitions stands beside the
    /// motion of `y1`, 0 as well.
    #[inline(always)]
    pub fn load_swing(&mut self, lane: usize, constants: &[T; CONSTANTS]) {
        for word in SWING_WORDS {
            self.scene[word].set(lane, constants[word]);
        }
    }

    /// Loads the state of a lane.
    #[inline(always)]
    pub fn load_state(&mut self, index: usize, state: &State<T>, scene: &Words<T>) {
        for i in 0..3 {
            self.p[i].set(index, state.body.p[i]);
            self.v[i].set(index, state.body.v[i]);
        }
        let piece = if state.contact == STICK { 0 } else { state.piece as usize };
        load_piece(&mut self.piece, index, scene, piece);
        if scene.pieces.len() > 1 {
            load_piece(&mut self.other, index, scene, usize::from(piece == 0));
        }
        // Another contact state has other modes.
        self.pace.set(index, self.step.get(index));
        let many = match scene.pieces.len() {
            1 => ONE_PIECE,
            2 => 0.0,
            _ => 1.0,
        };
        self.many.set(index, T::from_f64(many));
        self.contact.set(index, T::from_f64(f64::from(state.contact)));
        let disarmed = match state.disarmed {
            NOTHING => 0,
            UPPER_KINK => THIRD,
            _ if state.contact == FREE => FIRST,
            _ => SECOND,
        };
        self.disarmed.set(index, T::from_f64(f64::from(disarmed)));
    }

    /// Stores the state of a lane.
    #[inline(always)]
    pub fn store_state(&self, index: usize, state: &mut State<T>, scene: &Words<T>) {
        state.body = Body {
            p: [self.p[0].get(index), self.p[1].get(index), self.p[2].get(index)],
            v: [self.v[0].get(index), self.v[1].get(index), self.v[2].get(index)],
        };
        let number = |vector: &Vector<S, T>| vector.get(index).to_f64() as u32;
        state.contact = number(&self.contact);
        state.at_once = number(&self.at_once);
        if self.piece[LOWER].get(index) <= T::ZERO {
            state.piece = 0;
        } else if scene.pieces.len() == 2 {
            state.piece = 1;
        }
        state.disarmed = match number(&self.disarmed) {
            0 => NOTHING,
            function => event_of(function, state.contact, state.piece),
        };
    }

    /// The belt of a lane.
    #[inline(always)]
    pub fn belt(&self, lane: usize) -> Belt<T> {
        Belt { velocity: self.belt.get(lane), acceleration: self.drive.get(lane) }
    }

    /// Whether a lane has had too many events.
    pub fn is_exhausted(&self, lane: usize) -> bool {
        self.at_once.get(lane) > T::from_f64(f64::from(EVENTS_AT_ONCE))
            || self.counted.get(lane) > self.most_events.get(lane)
    }

    /// The longest step of the present contact states.
    #[inline(always)]
    pub fn longest(&self) -> Vector<S, T> {
        let slides = self.reverse().select(self.scene[LONGEST + 1], self.scene[LONGEST]);
        let closed = self.slip().select(slides, self.scene[LONGEST + 3]);
        self.free().select(self.scene[LONGEST + 2], closed)
    }

    /// Lanes in contact state `code` or one before it.
    #[inline(always)]
    pub fn up_to(&self, code: u32) -> Mask<S, T> {
        self.contact.at_most(self.contact.like(f64::from(code)))
    }

    /// Lanes that slip.
    #[inline(always)]
    pub fn slip(&self) -> Mask<S, T> {
        self.up_to(REVERSE)
    }

    /// Lanes that overtake their belts.
    #[inline(always)]
    pub fn reverse(&self) -> Mask<S, T> {
        self.slip().and(self.up_to(SLIP).not())
    }

    /// Lanes that stick.
    #[inline(always)]
    pub fn stick(&self) -> Mask<S, T> {
        self.up_to(REVERSE).not().and(self.up_to(STICK))
    }

    /// Lanes that fly.
    #[inline(always)]
    pub fn free(&self) -> Mask<S, T> {
        self.up_to(STICK).not()
    }

    /// `σ` of lanes that slip.
    #[inline(always)]
    pub fn sigma(&self) -> Vector<S, T> {
        self.up_to(SLIP).select(self.contact.like(1.0), self.contact.like(-1.0))
    }
}

/// Loads one piece of a law.
fn load_piece<S: Simd, T: Scalar<S>>(
    words: &mut [Vector<S, T>; 6],
    lane: usize,
    scene: &Words<T>,
    index: usize,
) {
    let piece = &scene.pieces[index];
    let lower = if index == 0 { T::ZERO } else { scene.pieces[index - 1].kink };
    let values = [piece.at_zero, piece.slope, piece.rate, piece.offset, lower, piece.kink];
    for (word, value) in words.iter_mut().zip(values) {
        word.set(lane, value);
    }
}

/// The twin's name of an event.
#[must_use]
pub fn event_of(function: u32, contact: u32, piece: u32) -> u32 {
    match (function, contact) {
        (FIRST, FREE) => GAP,
        (FIRST, _) => LIFT_OFF,
        (SECOND, STICK) => CONE_FORWARD,
        (THIRD, STICK) => CONE_BACKWARD,
        (SECOND, _) if piece == 0 => REST,
        (SECOND, _) => LOWER_KINK,
        _ => UPPER_KINK,
    }
}
