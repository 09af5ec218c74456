//! Twin: shaders/linear.wgsl
//!
//! Eigenvalues of one sliding equilibrium and their attribution, in a form that keeps f32's digits.
//!
//! The characteristic polynomial, scaled so that its constant term is 1, is the product of two real
//! quadratics `(ζ² + p1 ζ + q1)(ζ² + p2 ζ + q2)`, `q1 q2 = 1`. With `ζ⁴ + 2P ζ³ + (2 + g) ζ² + c ζ + 1` and
//! `q1, q2 = 1 + y ± r`, `p1, p2 = P ± w`,
//!
//! ```text
//! 2 y³ + (4 − g) y² + (P c − 2g) y − e² = 0,  y ≥ 0      e = P − c/2
//! r² = y (2 + y)      w r = e + P y      w² = 2y − g + P²
//! ```
//!
//! Everything small enters by itself: `P` and `e` are proportional to the damping, `g` is the distance to the
//! coalescence of the undamped modes. The host computes `P`, `g`, `P c − 2g` and `e` in f64 and narrows them
//! once; the growth rate, which is small beside the frequency, is then a difference of small numbers only.

use crate::engine::fields::Field;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{Constant, Kernel};
use crate::model::kind::{InstabilityType, UNSTABLE_ABOVE};
use crate::model::status::Status;

/// The method in a manifest.
pub const METHOD: &str = "two quadratic factors by a bracketed Newton search";

/// Most steps of the search for `y`; three to six are usual.
pub const MAX_STEPS: u32 = 64;

/// A relative step of this many epsilons is rounding.
pub const NEGLIGIBLE_EPSILONS: f64 = 4.0;

/// Polynomials of one instance, which is what the kernel counts: full, flat, frozen.
pub const POLYNOMIALS: u32 = 3;

/// The kernel.
pub const KERNEL: Kernel = Kernel {
    name: "linear",
    files: &[
        ("shaders/linear.wgsl", include_str!("../../../shaders/linear.wgsl")),
        ("shaders/linear_main.wgsl", include_str!("../../../shaders/linear_main.wgsl")),
    ],
    inputs: &INPUTS,
    state: &STATE,
    flags: &FLAGS,
    settings: &[],
    tables: &[],
    constants: &[
        ("MAX_STEPS", Constant::U32(MAX_STEPS)),
        ("NEGLIGIBLE_EPSILONS", Constant::Real(NEGLIGIBLE_EPSILONS)),
        ("POLYNOMIALS", Constant::U32(POLYNOMIALS)),
        ("UNSTABLE_ABOVE", Constant::Real(UNSTABLE_ABOVE)),
        ("TYPE_STABLE", Constant::U32(code(InstabilityType::Stable))),
        ("TYPE_NEGATIVE_SLOPE", Constant::U32(code(InstabilityType::NegativeSlope))),
        ("TYPE_MODE_COUPLING", Constant::U32(code(InstabilityType::ModeCoupling))),
        ("TYPE_COEXISTENCE", Constant::U32(code(InstabilityType::Coexistence))),
        ("TYPE_INTERACTION", Constant::U32(code(InstabilityType::Interaction))),
    ],
    loops_per_step: POLYNOMIALS * MAX_STEPS,
};

/// Words of an instance: `P, g, P c − 2g, e` of each polynomial; then of the normal mode `m' ζ² + c' ζ + 1`
/// the mass `m'`, `1 − m'` and the damping `c'`.
pub const INPUTS: [Field; 6] = [
    Field::many("full", 4),
    Field::many("flat", 4),
    Field::many("frozen", 4),
    Field::one("normal_mass"),
    Field::one("normal_gap"),
    Field::one("normal_damping"),
];

/// Results, dimensionless: each growth rate in the scale of its polynomial.
pub const STATE: [Field; 6] = [
    Field::one("growth_rate"),
    Field::one("frequency"),
    Field::one("ratio_re"),
    Field::one("ratio_im"),
    Field::one("growth_rate_flat"),
    Field::one("growth_rate_frozen"),
];

/// Flags of an instance.
pub const FLAGS: [Field; 3] = [Field::one("status"), Field::one("steps"), Field::one("type")];

/// The code of a type; 0 is none.
#[must_use]
pub const fn code(kind: InstabilityType) -> u32 {
    kind as u32 + 1
}

/// A polynomial with the constant term 1, as above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quartic<R> {
    /// `P`, half the sum of the dampings.
    pub p: R,
    /// `g`, the distance to coalescence.
    pub g: R,
    /// `P c − 2g`.
    pub k: R,
    /// `e`, the coupling by damping.
    pub e: R,
}

/// Two quadratics `ζ² + p ζ + q`, `q = 1 + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors<R> {
    /// `p` of the first.
    pub p1: R,
    /// `q` of the first.
    pub q1: R,
    /// `q1 − 1`.
    pub t1: R,
    /// `p` of the second.
    pub p2: R,
    /// `q` of the second.
    pub q2: R,
    /// `q2 − 1`.
    pub t2: R,
}

/// A root and the quadratic it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<R> {
    /// Real part.
    pub re: R,
    /// Imaginary part, not negative.
    pub im: R,
    /// `p` of its quadratic.
    pub p: R,
    /// `q` of its quadratic.
    pub q: R,
    /// `q − 1`.
    pub t: R,
}

/// The results that the kernel writes for one instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analysed<R> {
    /// The words of [`STATE`].
    pub state: [R; 6],
    /// The words of [`FLAGS`].
    pub flags: [u32; 3],
}

/// `y`, a root of the cubic that is not negative.
///
/// Newton inside a bracket. For `g < 4` the start is above the only positive root and the cubic is convex
/// there, so that no step leaves the bracket; the midpoints are for strongly overdamped modes.
#[must_use]
pub fn split<R: Real>(quartic: Quartic<R>) -> R {
    let two = R::from_f64(2.0);
    let three = R::from_f64(3.0);
    let four = R::from_f64(4.0);
    let half = R::from_f64(0.5);
    let b = four - quartic.g;
    let c = quartic.k;
    let f = quartic.e * quartic.e;
    let mut low = R::ZERO;
    let mut high = R::ONE + b.abs().max(c.abs()).max(f);
    if b > R::ZERO {
        let root = (c * c + four * b * f).sqrt();
        if c < R::ZERO {
            high = (root - c) / (two * b);
        } else if f > R::ZERO {
            high = two * f / (root + c);
        } else {
            high = R::ZERO;
        }
    }
    let mut y = high;
    for _ in 0..MAX_STEPS {
        let value = ((two * y + b) * y + c) * y - f;
        let slope = (three * two * y + two * b) * y + c;
        if value > R::ZERO {
            high = y;
        } else {
            low = y;
        }
        let newton = y - value / slope;
        let inside = newton >= low && newton <= high;
        let next = R::select(half * (low + high), newton, inside);
        let step = (next - y).abs();
        y = next;
        if step <= R::from_f64(NEGLIGIBLE_EPSILONS) * R::EPSILON * next {
            break;
        }
    }
    y
}

/// The two quadratics of a polynomial; the first has the larger `q`.
#[must_use]
pub fn factors<R: Real>(quartic: Quartic<R>) -> Factors<R> {
    let two = R::from_f64(2.0);
    let y = split(quartic);
    let r = (y * (two + y)).sqrt();
    let product = quartic.e + quartic.p * y;
    let square = (two * y - quartic.g) + quartic.p * quartic.p;
    let mut w = square.max(R::ZERO).sqrt();
    // The one of the two ways to w that has no cancellation.
    if quartic.g > R::ZERO && r > R::ZERO {
        w = product / r;
    } else if product < R::ZERO {
        w = -w;
    }
    let t1 = y + r;
    let q1 = R::ONE + t1;
    let q2 = R::ONE / q1;
    let p1 = quartic.p + w;
    let mut p2 = quartic.p - w;
    // c = p1 q2 + p2 q1 knows a p2 that is small beside p1 better than the sum does.
    if p1.abs() > p2.abs() {
        p2 = (two * (quartic.p - quartic.e) - p1 * q2) / q1;
    }
    Factors { p1, q1, t1, p2, q2, t2: -(t1 * q2) }
}

/// The root of `ζ² + p ζ + q` with the largest real part; of a pair the one with positive imaginary part.
#[must_use]
pub fn quadratic<R: Real>(p: R, q: R, t: R) -> Root<R> {
    let half = -R::from_f64(0.5) * p;
    let discriminant = half * half - q;
    if discriminant < R::ZERO {
        return Root { re: half, im: (-discriminant).sqrt(), p, q, t };
    }
    let root = discriminant.sqrt();
    if half >= R::ZERO {
        return Root { re: half + root, im: R::ZERO, p, q, t };
    }
    Root { re: q / (half - root), im: R::ZERO, p, q, t }
}

/// The root of largest real part.
#[must_use]
pub fn rightmost<R: Real>(quartic: Quartic<R>) -> Root<R> {
    let both = factors(quartic);
    let first = quadratic(both.p1, both.q1, both.t1);
    let second = quadratic(both.p2, both.q2, both.t2);
    if second.re > first.re || (second.re == first.re && second.im > first.im) {
        return second;
    }
    first
}

/// Whether a root grows.
#[must_use]
pub fn is_unstable<R: Real>(root: Root<R>) -> bool {
    let size = (root.re * root.re + root.im * root.im).sqrt();
    root.re > R::from_f64(UNSTABLE_ABOVE) * size
}

/// The type of instability from which of the three grow.
#[must_use]
pub fn type_of(full: bool, flat: bool, frozen: bool) -> u32 {
    if !full {
        return code(InstabilityType::Stable);
    }
    if flat && frozen {
        return code(InstabilityType::Coexistence);
    }
    if flat {
        return code(InstabilityType::ModeCoupling);
    }
    if frozen {
        return code(InstabilityType::NegativeSlope);
    }
    code(InstabilityType::Interaction)
}

/// The polynomial whose words begin at `first`.
#[must_use]
pub fn polynomial<R: Real>(first: usize, word: &impl Fn(usize) -> R) -> Quartic<R> {
    Quartic { p: word(first), g: word(first + 1), k: word(first + 2), e: word(first + 3) }
}

/// Everything about one instance; `word` gives its input words.
///
/// With `ζ² = −p ζ − q` the mode ratio `y1/(s x2) = (1 + c' ζ)/(m' ζ² + c' ζ + 1)` needs no square of ζ.
#[must_use]
pub fn analyse<R: Real>(word: &impl Fn(usize) -> R) -> Analysed<R> {
    let full = rightmost(polynomial(0, word));
    let flat = rightmost(polynomial(4, word));
    let frozen = rightmost(polynomial(8, word));
    let mass = word(12);
    let gap = word(13);
    let damping = word(14);
    let above_re = R::ONE + damping * full.re;
    let above_im = damping * full.im;
    let below = damping - mass * full.p;
    let near = full.t.abs() < R::from_f64(0.5);
    let below_re = R::select(R::ONE - mass * full.q, gap - mass * full.t, near) + below * full.re;
    let below_im = below * full.im;
    let ratio_re = above_re * below_re + above_im * below_im;
    let ratio_im = above_im * below_re - above_re * below_im;
    let state = [full.re, full.im, ratio_re, ratio_im, flat.re, frozen.re];
    let kind = type_of(is_unstable(full), is_unstable(flat), is_unstable(frozen));
    let status = if all_finite(state) { Status::Ok } else { Status::NonFinite };
    Analysed { state, flags: [status as u32, POLYNOMIALS, kind] }
}

/// Whether every result is finite as f32.
#[must_use]
pub fn all_finite<R: Real>(state: [R; 6]) -> bool {
    state.iter().all(|value| value.is_finite())
}
