//! The Taylor series of the motion in every lane, over the lane's own step.
//!
//! The recurrence of [`crate::engine::method::taylor`] with time in steps: coefficients carry the powers of the step,
//! forces are times its square, so that everything that follows is a polynomial on [0, 1]. Terms that are
//! known early are summed first: a degree waits for three of its products, not for all.

use crate::engine::lanes::block::{Block, RATE, SLOPE};
use crate::engine::lanes::constants::{KAPPA, V0};
use crate::engine::lanes::forms::{Forms, forms};
use crate::engine::lanes::friction::{AtStart, friction};
use crate::engine::lanes::layer::layer;
use crate::engine::lanes::motion::{CURVED, FLIGHT, PIECES, SINGLE};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::model::piece::LawForm;
use pulp::Simd;

/// Series of one step; `N` coefficients of the positions.
#[derive(Clone, Copy, Debug)]
pub struct Expansion<S: Simd, T: Scalar<S>, const N: usize> {
    /// `x2 y2 y1`.
    pub p: [[Vector<S, T>; N]; 3],
    /// Their derivatives: `k` times the coefficient of degree `k`, at `k`.
    pub v: [[Vector<S, T>; N]; 3],
    /// Accelerations of `x2` and `y1`.
    pub a: [[Vector<S, T>; N]; 2],
    /// Normal force.
    pub n: [Vector<S, T>; N],
    /// The step.
    pub step: Vector<S, T>,
    /// `1/step`.
    pub rate: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>, const N: usize> Expansion<S, T, N> {
    /// No motion.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        let series = [zero; N];
        Expansion { p: [series; 3], v: [series; 3], a: [series; 2], n: series, step: zero, rate: zero }
    }
}

/// Expands the motion over the step `h`; returns the lanes whose contact forces are not unique. Series of what
/// does not move are left alone.
#[inline(always)]
pub fn expand<S: Simd, T: Scalar<S>, const N: usize, const LAW: bool, const MOTION: u8>(
    b: &Block<S, T>,
    h: Vector<S, T>,
    e: &mut Expansion<S, T, N>,
) -> Mask<S, T> {
    let (zero, one) = (h.like(0.0), h.like(1.0));
    let slip = b.slip();
    let sigma = b.sigma();
    let velocity = b.v[0];
    let relative = b.belt - velocity;
    let lag = velocity - (b.belt - b.scene[V0]);
    let start = friction::<S, T, LAW>(b, sigma, relative, lag);
    let AtStart { q: q0, less: q0_less, law } = start;
    let inertia = slip.select(b.scene[KAPPA].fma(q0, one), one);
    let ill_posed = inertia.not_positive();
    let h = if LAW == CURVED {
        let inverse = layer::<S, T, MOTION>(b, start, inertia, [sigma, relative]);
        slip.select(h.min(one / inverse), h)
    } else {
        h
    };
    let per_step = one / (inertia * h);
    let reciprocal = per_step * h;
    let forms = forms::<S, T, MOTION>(b, h, [q0, q0_less], reciprocal);
    let drive = b.drive * (h * h);
    // q_k = −slope · (relative velocity)_k, with 1/(1 + κ q0) folded in.
    let stiffening = slip.select(-(b.piece[SLOPE] * per_step), zero);
    // Without a slope q is constant.
    let sloped = LAW == CURVED || zero.less(stiffening.abs()).any();

    let Expansion { p, v, .. } = e;
    for i in 0..3 {
        if MOTION == FLIGHT || i == 0 || i == 2 && MOTION != SINGLE {
            p[i][0] = b.p[i];
            v[i][1] = b.v[i] * h;
            p[i][1] = v[i][1];
        }
    }
    let mut friction = Friction { q: [zero; N], law: [zero; N] };
    if LAW == CURVED {
        friction.law[0] = law;
    }
    let known = Known {
        forms,
        stiffening,
        drive,
        sloped,
        reciprocal,
        rate: per_step * inertia,
        sigma,
        relative,
        slip,
    };
    let mut course = Course { drag: zero, back: zero, force_before: zero };
    const { assert!(N <= 17, "a degree is missing below") };
    macro_rules! degrees {
        ($($k:literal)*) => {
            $(if $k < N - 2 {
                degree::<S, T, N, LAW, MOTION>($k, b, &known, e, &mut friction, &mut course);
            })*
        };
    }
    if const { LAW == PIECES } {
        // Written out, with every constant and every place known.
        degrees!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14);
    } else {
        // Of a curved law each degree is a sum of all before: a loop, which compiles in a fraction of the time.
        for k in 0..N - 2 {
            degree::<S, T, N, LAW, MOTION>(k, b, &known, e, &mut friction, &mut course);
        }
    }
    e.step = h;
    e.rate = known.rate;
    ill_posed
}

/// The numbers that all degrees of a step share.
#[derive(Clone, Copy)]
struct Known<S: Simd, T: Scalar<S>> {
    forms: Forms<S, T>,
    /// `q_k` of a straight law is this times the velocity of degree `k`.
    stiffening: Vector<S, T>,
    /// The belt's acceleration, times the square of the step.
    drive: Vector<S, T>,
    /// Whether `q` is not constant.
    sloped: bool,
    /// `1/(1 + κ q0)`.
    reciprocal: Vector<S, T>,
    /// `1/step`.
    rate: Vector<S, T>,
    sigma: Vector<S, T>,
    /// The relative velocity at the beginning.
    relative: Vector<S, T>,
    slip: Mask<S, T>,
}

/// The series of the friction law.
struct Friction<S: Simd, T: Scalar<S>, const N: usize> {
    /// `q`, with the inverse of the inertia.
    q: [Vector<S, T>; N],
    /// The series that the recurrence of a curved law carries along.
    law: [Vector<S, T>; N],
}

/// For straight laws: the part of a degree of the accelerations that follows from the degree before it, so that it waits for
/// little else.
struct Course<S: Simd, T: Scalar<S>> {
    drag: Vector<S, T>,
    back: Vector<S, T>,
    force_before: Vector<S, T>,
}

/// The accelerations of degree `k`, and what of the motion follows from them.
#[inline(always)]
fn degree<S: Simd, T: Scalar<S>, const N: usize, const LAW: bool, const MOTION: u8>(
    k: usize,
    b: &Block<S, T>,
    known: &Known<S, T>,
    e: &mut Expansion<S, T, N>,
    friction: &mut Friction<S, T, N>,
    course: &mut Course<S, T>,
) {
    let Known { forms, stiffening, drive, sloped, .. } = *known;
    let Forms { ax, ay, aw, normal, push, fall, load, kappa } = forms;
    let zero = drive.like(0.0);
    let Expansion { p, v, a, n, .. } = e;
    let Friction { q, law } = friction;
    let waits_less = LAW == PIECES && k > 1;
    let (mut x, mut y, mut w, mut force) = (ax[0] * p[0][k], zero, zero, zero);
    if MOTION != SINGLE {
        x = ax[0].fma(p[0][k], ax[2] * p[2][k]);
        w = aw[0].fma(p[0][k], aw[2] * p[2][k]);
        force = normal[0].fma(p[0][k], normal[2] * p[2][k]);
    }
    if k == 0 {
        x += push;
        y += fall;
        force += load;
    }
    if MOTION == FLIGHT {
        x = ax[1].fma(p[1][k], x);
        w = aw[1].fma(p[1][k], w);
        y = ay[0].fma(p[0][k], ay[1].fma(p[1][k], ay[2].fma(p[2][k], y)));
        y = ay[3].fma(v[0][k + 1], ay[4].fma(v[1][k + 1], ay[5].fma(v[2][k + 1], y)));
        x = ax[4].fma(v[1][k + 1], x);
        w = aw[4].fma(v[1][k + 1], w);
    }
    if MOTION != SINGLE && sloped {
        for j in 2..k {
            x = q[j].fma(n[k - j], x);
        }
    }
    let part = zero.like(1.0 / k.max(1) as f64);
    if waits_less {
        if MOTION != SINGLE {
            x = q[1].fma(course.force_before, x);
            x = ax[5].fma(v[2][k + 1], x);
            w = aw[5].fma(v[2][k + 1], w);
            w = aw[3].fma(v[0][k + 1], w);
        }
        x = course.drag.fma(part, course.back).fma(a[0][k - 1], x);
    } else {
        if MOTION != SINGLE {
            x = ax[5].fma(v[2][k + 1], x);
            w = aw[5].fma(v[2][k + 1], w);
            w = aw[3].fma(v[0][k + 1], w);
        }
        x = ax[3].fma(v[0][k + 1], x);
        if k > 0 {
            x = q[k].fma(n[0], x);
        }
        if MOTION != SINGLE && k > 1 {
            x = q[1].fma(n[k - 1], x);
        }
    }
    if MOTION != SINGLE {
        force = normal[5].fma(v[2][k + 1], force);
        force = normal[3].fma(v[0][k + 1], force);
        a[1][k] = w;
    }
    if MOTION != SINGLE || k == 0 {
        n[k] = kappa.fnma(x, force);
    }
    course.force_before = force;
    a[0][k] = x;
    let once = zero.like(1.0 / (k + 1) as f64);
    let twice = zero.like(1.0 / ((k + 1) * (k + 2)) as f64);
    v[0][k + 2] = x * once;
    p[0][k + 2] = x * twice;
    if MOTION != SINGLE {
        v[2][k + 2] = w * once;
        p[2][k + 2] = w * twice;
    }
    if MOTION == FLIGHT {
        v[1][k + 2] = y * once;
        p[1][k + 2] = y * twice;
    }
    // The relative velocity of degree k + 1, times the step.
    let slower = if k == 0 { v[0][2] - drive } else { v[0][k + 2] };
    if LAW == PIECES {
        q[k + 1] = stiffening * slower;
        if k == 0 {
            course.drag = stiffening.fma(n[0], ax[3]);
        }
        if k == 0 && MOTION != SINGLE {
            course.back = -(q[1] * kappa);
        }
    } else {
        q[k + 1] = curved(k, b, known, &v[0], law);
    }
}

/// What the recurrence of a curved law comes to at the degree `k + 1`, and its part of `q`; `v` is the series of the velocity.
#[inline(always)]
fn curved<S: Simd, T: Scalar<S>, const N: usize>(
    k: usize,
    b: &Block<S, T>,
    known: &Known<S, T>,
    v: &[Vector<S, T>; N],
    law: &mut [Vector<S, T>; N],
) -> Vector<S, T> {
    let Known { drive, reciprocal, rate, sigma, relative, slip, .. } = *known;
    let (zero, one) = (drive.like(0.0), drive.like(1.0));
    let once = zero.like(1.0 / (k + 1) as f64);
    // Kept as the relative velocity times the degree or not, as its law needs it.
    let mut sum = zero;
    law[k + 1] = zero;
    for j in 1..=k + 1 {
        let along = if j == 1 { drive - v[2] } else { -v[j + 1] } * rate;
        let along = match b.law {
            LawForm::Exponential => along * drive.like(j as f64),
            LawForm::Pieces | LawForm::Rational => along,
        };
        sum = along.fma(law[k + 1 - j], sum);
    }
    match b.law {
        LawForm::Exponential => {
            law[k + 1] = -(sigma * b.piece[RATE] * sum) * once;
            (sigma * law[k + 1] * reciprocal).only(slip)
        }
        LawForm::Pieces | LawForm::Rational => {
            law[k + 1] = -(b.piece[RATE] * sigma * sum) / (b.piece[RATE] * sigma).fma(relative, one);
            (law[k + 1] * reciprocal).only(slip)
        }
    }
}
