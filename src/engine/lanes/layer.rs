//! How far a step of every lane may go where a curved law changes within a layer of speeds near rest, see
//! [`crate::engine::method::pace::Layer`].

use pulp::Simd;

use crate::engine::lanes::block::{Block, RATE};
use crate::engine::lanes::constants::{KAPPA, LAYER, N0, R, W};
use crate::engine::lanes::friction::AtStart;
use crate::engine::lanes::motion::SINGLE;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;
use crate::engine::method::pace::{HARDER, HIDDEN, LEFT_BEHIND};
use crate::model::piece::LawForm;

/// The inverse of the longest step, of the friction `start`, the inertia `M11`, the direction of slip and the relative velocity.
#[inline(always)]
pub(super) fn layer<S: Simd, T: Scalar<S>, const MOTION: u8>(
    b: &Block<S, T>,
    start: AtStart<S, T>,
    inertia: Vector<S, T>,
    [sigma, relative]: [Vector<S, T>; 2],
) -> Vector<S, T> {
    let (zero, one) = (sigma.like(0.0), sigma.like(1.0));
    let form = |at: usize| {
        let sum = b.scene[at].fma(b.p[0], b.scene[at + 3] * b.v[0]);
        if MOTION == SINGLE { sum } else { b.scene[at + 2].fma(b.p[2], b.scene[at + 5].fma(b.v[2], sum)) }
    };
    // By springs alone.
    let changing = |at: usize| {
        let sum = b.scene[at] * b.v[0];
        if MOTION == SINGLE { sum } else { b.scene[at + 2].fma(b.v[2], sum) }
    };
    let normal = form(W);
    let force = start.q.fma(normal, start.less.fma(b.scene[N0], -form(R))) / inertia;
    let faster = sigma * (b.drive - force);
    let acceleration = faster.abs();
    let load = b.scene[KAPPA].fnma(force, normal).max(zero) + b.scene[N0];
    let share = start.law.abs() * load / inertia;
    let rate = b.piece[RATE];
    let widths = rate * (sigma * relative).max(zero);
    let away = widths + one;
    let turning = (start.q.fma(changing(W), -changing(R)) / inertia).abs();
    let [reach, along] = [b.scene[LAYER], b.scene[LAYER + 1]];
    let (held, toward) = match b.law {
        LawForm::Exponential => {
            let square = widths * widths;
            let behind = (square * square * one.like(LEFT_BEHIND)).only(zero.less(faster));
            let root = acceleration.min(share * one.like(HIDDEN)).sqrt() + share.sqrt();
            let slope = zero.less(start.law).select(share * one.like(HARDER), share);
            let held = (root * root * one.like(0.25) * reach).max(slope * along);
            (held, acceleration * reach / (away + behind))
        }
        LawForm::Pieces | LawForm::Rational => (zero, acceleration.fma(reach, share * along) / away),
    };
    let (toward, turning) = (rate * toward, rate * turning * reach / away);
    let double = toward + toward.fma(toward, turning + turning).sqrt();
    (rate * held).max(double * one.like(0.5))
}
