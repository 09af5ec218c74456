//! Impacts in all lanes at once, for laws of at most two straight pieces.
//!
//! The rules are those of [`crate::engine::lanes::contact`] and [`crate::model::contact`].

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::block::{AT_ZERO, Block, LOWER, SLOPE, UPPER};
use crate::engine::lanes::constants::{IMPACT_FRICTION, KAPPA, NORMAL_MASS, RESTITUTION};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::model::contact::SLOWEST_REBOUND;

/// A law at the speed `|v|` of every lane.
pub struct AtSpeed<S: Simd, T: Scalar<S>> {
    /// μ.
    pub mu: Vector<S, T>,
    /// Lanes whose piece is not the present one.
    pub elsewhere: Mask<S, T>,
}

/// μ at a speed, whatever its piece.
#[inline(always)]
pub fn at_speed<S: Simd, T: Scalar<S>>(b: &Block<S, T>, speed: Vector<S, T>) -> AtSpeed<S, T> {
    let is_lower = b.piece[LOWER].not_positive();
    let kink = is_lower.select(b.piece[UPPER], b.piece[LOWER]);
    let above = kink.at_most(speed);
    let elsewhere = above.and(is_lower).or(above.not().and(is_lower.not()));
    let word = |index: usize| elsewhere.select(b.other[index], b.piece[index]);
    AtSpeed { mu: word(SLOPE).fma(speed, word(AT_ZERO)), elsewhere }
}

/// The motion after an impact.
pub struct Impact<S: Simd, T: Scalar<S>> {
    /// `ẋ2` afterwards.
    pub tangential: Vector<S, T>,
    /// `ẏ2` afterwards.
    pub rebound: Vector<S, T>,
    /// Lanes whose impulses are not unique.
    pub ill_posed: Mask<S, T>,
}

/// Newton's impact with friction inside its cone, of every lane's present velocity.
#[inline(always)]
pub fn impact<S: Simd, T: Scalar<S>>(b: &Block<S, T>) -> Impact<S, T> {
    let (zero, one) = (b.left.like(0.0), b.left.like(1.0));
    let (kappa, normal_mass) = (b.scene[KAPPA], b.scene[NORMAL_MASS]);
    let vy = b.v[1].min(zero);
    let rebound = -(b.scene[RESTITUTION] * vy);
    let rebound = rebound.less(rebound.like(SLOWEST_REBOUND)).select(zero, rebound);
    let change = rebound - vy;
    let relative = b.belt - b.v[0];
    let rubs = zero.less(b.scene[IMPACT_FRICTION]);
    let limit = at_speed(b, relative.abs()).mu;
    let q = relative.less(zero).select(-limit, limit).only(rubs);
    let inertia = kappa.fma(q, one);
    let jump = normal_mass.fma(q, kappa) / inertia * change;
    let reverses = kappa.fnma(q, one);
    let jump_back = normal_mass.fnma(q, kappa) / reverses * change;
    let tangential = kappa.fnma(change, relative);
    let normal = kappa.fnma(relative, normal_mass * change);
    let slides = rubs.not().or(zero.less((relative - jump) * relative));
    let turns = slides.not().and((limit * normal).less(tangential.abs()));
    let after = slides.select(b.v[0] + jump, turns.select(b.v[0] + jump_back, b.belt));
    let ill_posed = inertia.not_positive().or(turns.and(reverses.not_positive()));
    Impact { tangential: after, rebound, ill_posed }
}
