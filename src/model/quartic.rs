//! The roots of a real quartic, by its two real quadratic factors.
//!
//! After A. Orellana and C. De Michele, Algorithm 1010, ACM TOMS 46, 20 (2020): a scaled quartic, the dominant root of its
//! resolvent, the best of several ways to the coefficients of the factors, then Newton steps on these coefficients. Small real
//! parts of roots keep their digits, as they are coefficients of a factor.

use nalgebra::{Matrix4, Vector4};
use num_complex::Complex64;

/// Newton steps on the coefficients of the factors; every one is kept only if it lowers the error.
const POLISH: usize = 12;

/// Newton steps on the resolvent's root.
const RESOLVENT_POLISH: usize = 2;

/// Two real quadratics `(ζ² + p ζ + q)(ζ² + r ζ + s)`, as `[p, q, r, s]`.
type Factors = [f64; 4];

/// The four roots of `c4 z⁴ + c3 z³ + c2 z² + c1 z + c0`; `c4` must not be 0.
///
/// Complex roots come as exact conjugate pairs next to each other.
#[must_use]
pub fn roots([c0, c1, c2, c3, c4]: [f64; 5]) -> [Complex64; 4] {
    // z = scale ζ brings the roots to magnitude about 1.
    let scale = (c0 / c4).abs().sqrt().sqrt();
    let scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
    let (per_c4, per_scale) = (1.0 / c4, 1.0 / scale);
    let square = per_scale * per_scale;
    let monic = [
        c3 * per_c4 * per_scale,
        c2 * per_c4 * square,
        c1 * per_c4 * per_scale * square,
        c0 * per_c4 * square * square,
    ];
    let [p, q, r, s] = polished(&monic, factors(&monic));
    let ([first, second], [third, fourth]) = (quadratic_real(p, q), quadratic_real(r, s));
    [first, second, third, fourth].map(|root| scale * root)
}

/// The factors of `ζ⁴ + a ζ³ + b ζ² + c ζ + d`, nearly.
fn factors(monic: &[f64; 4]) -> Factors {
    let [a, b, c, d] = *monic;
    let phi = dominant_resolvent_root(monic);
    let l1 = 0.5 * a;
    let l3 = b / 6.0 + 0.5 * phi;
    let delta2 = c - a * l3;
    let d2_direct = 2.0 * b / 3.0 - phi - l1 * l1;
    let l2_ratio = 2.0 * (d - l3 * l3) / delta2;
    let candidates = [
        (d2_direct, delta2 / (2.0 * d2_direct)),
        (delta2 / (2.0 * l2_ratio), l2_ratio),
        (d2_direct, l2_ratio),
    ];
    let apart = candidates.map(|(d2, l2)| {
        if d2 < 0.0 {
            let gamma = (-d2).sqrt();
            completed(monic, [l1 + gamma, l3 + gamma * l2, l1 - gamma, l3 - gamma * l2])
        } else {
            let gamma = d2.sqrt();
            of_conjugates(Complex64::new(l1, gamma), Complex64::new(l3, gamma * l2))
        }
    });
    // Two factors with the same linear term: without damping they have none, and rounding is all that is left of `d2`.
    let gap = l3 * l3 - d;
    let alike = if gap >= 0.0 {
        completed(monic, [l1, l3 + gap.sqrt(), l1, l3 - gap.sqrt()])
    } else {
        of_conjugates(Complex64::new(l1, 0.0), Complex64::new(l3, (-gap).sqrt()))
    };
    let [first, second, third] = apart;
    best(monic, first, [second, third, alike])
}

/// Of some factors those whose product lacks least.
fn best(monic: &[f64; 4], first: Factors, others: impl IntoIterator<Item = Factors>) -> Factors {
    let less = |best, other| if error(monic, &other) < error(monic, &best) { other } else { best };
    others.into_iter().fold(first, less)
}

/// Factors of which the smaller coefficients, differences, are had from the larger ones and from the product.
fn completed(monic: &[f64; 4], [p, mut q, r, mut s]: Factors) -> Factors {
    let [a, b, c, d] = *monic;
    if s.abs() < q.abs() {
        s = d / q;
    } else if q.abs() < s.abs() {
        q = d / s;
    }
    // Of `p + r = a`, `q + p r + s = b` and `q r + p s = c` the one that is best known.
    let known = |large: f64, q: f64, s: f64| [(c - s * large) / q, (b - q - s) / large, a - large];
    if p.abs() < r.abs() {
        best(monic, [p, q, r, s], known(r, s, q).map(|p| [p, q, r, s]))
    } else {
        best(monic, [p, q, r, s], known(p, q, s).map(|r| [p, q, r, s]))
    }
}

/// The real factors of `(ζ² + p ζ + q)(ζ² + p* ζ + q*)`: a root of the first and its conjugate belong to one of them.
fn of_conjugates(p: Complex64, q: Complex64) -> Factors {
    let [first, second] = quadratic(p, q);
    [-2.0 * first.re, first.norm_sqr(), -2.0 * second.re, second.norm_sqr()]
}

/// What the product of two factors lacks of a quartic.
fn lacks(&[a, b, c, d]: &[f64; 4], &[p, q, r, s]: &Factors) -> [f64; 4] {
    [a - (p + r), b - (q + p * r + s), c - (q * r + p * s), d - q * s]
}

/// The sum of the relative errors of the coefficients; infinite where one is no number.
fn error(monic: &[f64; 4], factors: &Factors) -> f64 {
    let sum: f64 = lacks(monic, factors)
        .into_iter()
        .zip(monic)
        .map(|(lack, size)| if *size == 0.0 { lack.abs() } else { (lack / size).abs() })
        .sum();
    if sum.is_nan() { f64::INFINITY } else { sum }
}

/// Newton on the coefficients of the factors.
fn polished(monic: &[f64; 4], mut factors: Factors) -> Factors {
    let mut least = error(monic, &factors);
    for _ in 0..POLISH {
        let [p, q, r, s] = factors;
        let slopes = Matrix4::new(1.0, 0.0, 1.0, 0.0, r, 1.0, p, 1.0, s, r, q, p, 0.0, s, 0.0, q);
        let lacks = Vector4::from(lacks(monic, &factors));
        let Some(step) = slopes.lu().solve(&lacks) else { break };
        let next: Factors = std::array::from_fn(|k| factors[k] + step[k]);
        let left = error(monic, &next);
        if left >= least {
            break;
        }
        (factors, least) = (next, left);
    }
    factors
}

/// The real root of largest magnitude of the depressed resolvent `φ³ + g φ + h`.
fn dominant_resolvent_root(&[a, b, c, d]: &[f64; 4]) -> f64 {
    let g = a * c - 4.0 * d - b * b / 3.0;
    let h = (8.0 * d + a * c - 2.0 * b * b / 9.0) * b / 3.0 - c * c - a * a * d;
    let (q, r) = (-g / 3.0, 0.5 * h);
    let mut phi = if r * r < q * q * q {
        let angle = (r / (q * q.sqrt())).clamp(-1.0, 1.0).acos();
        if angle < std::f64::consts::FRAC_PI_2 {
            -2.0 * q.sqrt() * (angle / 3.0).cos()
        } else {
            -2.0 * q.sqrt() * ((angle + std::f64::consts::TAU) / 3.0).cos()
        }
    } else {
        let root = -r.signum() * (r.abs() + (r * r - q * q * q).max(0.0).sqrt()).cbrt();
        if root == 0.0 { 0.0 } else { root + q / root }
    };
    for _ in 0..RESOLVENT_POLISH {
        let slope = 3.0 * phi * phi + g;
        if slope == 0.0 {
            break;
        }
        phi -= (phi * (phi * phi + g) + h) / slope;
    }
    phi
}

/// Roots of `ζ² + p ζ + q` with real coefficients.
fn quadratic_real(p: f64, q: f64) -> [Complex64; 2] {
    let discriminant = 0.25 * p * p - q;
    if discriminant >= 0.0 {
        let larger = -0.5 * p - if p < 0.0 { -discriminant.sqrt() } else { discriminant.sqrt() };
        let smaller = if larger == 0.0 { 0.0 } else { q / larger };
        [Complex64::new(larger, 0.0), Complex64::new(smaller, 0.0)]
    } else {
        let root = Complex64::new(-0.5 * p, (-discriminant).sqrt());
        [root, root.conj()]
    }
}

/// The square root with a real part that is not negative, without angles; of magnitudes between 1e-150 and 1e150.
fn square_root(z: Complex64) -> Complex64 {
    let larger = (0.5 * (z.re.abs() + z.norm_sqr().sqrt())).sqrt();
    if larger == 0.0 {
        Complex64::ZERO
    } else if z.re >= 0.0 {
        Complex64::new(larger, 0.5 * z.im / larger)
    } else {
        Complex64::new(0.5 * z.im.abs() / larger, larger.copysign(z.im))
    }
}

/// Roots of `ζ² + p ζ + q` with complex coefficients.
fn quadratic(p: Complex64, q: Complex64) -> [Complex64; 2] {
    let root = square_root(0.25 * p * p - q);
    let half = -0.5 * p;
    let larger = if (half.conj() * root).re < 0.0 { half - root } else { half + root };
    let smaller = if larger.norm_sqr() == 0.0 { larger } else { q / larger };
    [larger, smaller]
}
