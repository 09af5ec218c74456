//! The forces of the springs and dampers of every lane, and what follows from them for a contact state.

use crate::engine::lanes::block::Block;
use crate::engine::lanes::constants::{FALL, FLIGHT_X, FLIGHT_Y, H, KAPPA, N0, R, W};
use crate::engine::lanes::motion::{FLIGHT, SINGLE};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;
use pulp::Simd;

/// What the accelerations and the normal force are made of over a step, times its square: coefficients of the
/// coordinates and of their velocities (the power of the step is in them), and constants.
#[derive(Clone, Copy)]
pub(super) struct Forms<S: Simd, T: Scalar<S>> {
    /// Acceleration of `x2`, friction by the curvature of its law aside.
    pub(super) ax: [Vector<S, T>; 6],
    /// Acceleration of `y2`.
    pub(super) ay: [Vector<S, T>; 6],
    /// Acceleration of `y1`.
    pub(super) aw: [Vector<S, T>; 6],
    /// Normal force, without `−κ ẍ2`.
    pub(super) normal: [Vector<S, T>; 6],
    /// Constant part of `ax`.
    pub(super) push: Vector<S, T>,
    /// Constant part of `ay`.
    pub(super) fall: Vector<S, T>,
    /// Constant part of `normal`.
    pub(super) load: Vector<S, T>,
    /// `κ`, 0 in flight.
    pub(super) kappa: Vector<S, T>,
}

/// The forms of every lane's contact state; `reciprocal` is `1/(1 + κ q0)`.
#[inline(always)]
pub(super) fn forms<S: Simd, T: Scalar<S>, const MOTION: u8>(
    b: &Block<S, T>,
    h: Vector<S, T>,
    [q0, q0_less]: [Vector<S, T>; 2],
    reciprocal: Vector<S, T>,
) -> Forms<S, T> {
    let zero = h.like(0.0);
    let (slip, free) = (b.slip(), b.free());
    let square = h * h;
    let (scale, scale_damper) = (slip.select(reciprocal * square, zero), slip.select(reciprocal * h, zero));
    let mut ax = [zero; 6];
    let mut ay = [zero; 6];
    let mut aw = [zero; 6];
    let mut normal = [zero; 6];
    for i in 0..6 {
        if MOTION != FLIGHT && (i == 1 || i == 4) || MOTION == SINGLE && i % 3 > 0 {
            continue;
        }
        let (power, scaled) = if i < 3 { (square, scale) } else { (h, scale_damper) };
        ax[i] = (q0.fma(b.scene[W + i], -b.scene[R + i])) * scaled;
        if MOTION != SINGLE {
            aw[i] = b.scene[H + i] * power;
            normal[i] = b.scene[W + i] * power;
        }
        if MOTION == FLIGHT {
            ax[i] = free.select(b.scene[FLIGHT_X + i] * power, ax[i]);
            ay[i] = (b.scene[FLIGHT_Y + i] * power).only(free);
            normal[i] = free.select(zero, normal[i]);
        }
    }
    let mut push = slip.select(q0_less * b.scene[N0] * scale, b.drive * square);
    let mut load = b.scene[N0] * square;
    let mut kappa = b.scene[KAPPA];
    let mut fall = zero;
    if MOTION == FLIGHT {
        push = free.select(b.scene[FALL] * square, push);
        fall = (b.scene[FALL + 1] * square).only(free);
        load = free.select(zero, load);
        kappa = free.select(zero, kappa);
    }
    Forms { ax, ay, aw, normal, push, fall, load, kappa }
}
