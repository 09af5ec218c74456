//! The roots of a real quartic in closed form, polished.
//!
//! Factorisation into two quadratics after A. Orellana and C. De Michele, Algorithm 1010, ACM TOMS 46,
//! 20 (2020): a scaled quartic, the dominant root of its resolvent, the best of three ways to the
//! coefficients of the factors, then Newton steps on the roots.

use num_complex::Complex64;

/// Newton steps on each root; every one is kept only if it lowers the residual.
const POLISH: usize = 2;

/// A step of this relative size is rounding.
const NEGLIGIBLE_STEP: f64 = 4.0 * f64::EPSILON;

/// Newton steps on the resolvent's root.
const RESOLVENT_POLISH: usize = 2;

/// The four roots of `c4 z⁴ + c3 z³ + c2 z² + c1 z + c0`; `c4` must not be 0.
///
/// Complex roots come as exact conjugate pairs next to each other whenever the factors are real.
#[must_use]
pub fn roots([c0, c1, c2, c3, c4]: [f64; 5]) -> [Complex64; 4] {
    // z = scale ζ brings the roots to magnitude about 1.
    let scale = (c0 / c4).abs().sqrt().sqrt();
    let scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
    let (per_c4, per_scale) = (1.0 / c4, 1.0 / scale);
    let square = per_scale * per_scale;
    let (a, b) = (c3 * per_c4 * per_scale, c2 * per_c4 * square);
    let (c, d) = (c1 * per_c4 * per_scale * square, c0 * per_c4 * square * square);
    let [p, q, r, s] = factor(a, b, c, d);
    // Of a conjugate pair one member is polished.
    let pair = |p: Complex64, q: Complex64| {
        let first = scale * polish([d, c, b, a], p);
        let second =
            if p.im != 0.0 && q == p.conj() { first.conj() } else { scale * polish([d, c, b, a], q) };
        [first, second]
    };
    let ([p, q], [r, s]) = (pair(p, q), pair(r, s));
    [p, q, r, s]
}

/// Roots of `ζ⁴ + a ζ³ + b ζ² + c ζ + d`.
fn factor(a: f64, b: f64, c: f64, d: f64) -> [Complex64; 4] {
    let phi = dominant_resolvent_root(a, b, c, d);
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
    let [per_b, per_c, per_d] = [b, c, d].map(|size| if size == 0.0 { 1.0 } else { 1.0 / size });
    let residual = |&(d2, l2): &(f64, f64)| {
        let sum = ((d2 + l1 * l1 + 2.0 * l3 - b) * per_b).abs()
            + ((2.0 * (d2 * l2 + l1 * l3) - c) * per_c).abs()
            + ((d2 * l2 * l2 + l3 * l3 - d) * per_d).abs();
        if sum.is_nan() { f64::INFINITY } else { sum }
    };
    let best = candidates.iter().min_by(|p, q| residual(p).total_cmp(&residual(q)));
    match best {
        Some(&(d2, l2)) if residual(&(d2, l2)).is_finite() && d2 != 0.0 => {
            if d2 < 0.0 {
                let gamma = (-d2).sqrt();
                let [p, q] = quadratic_real(l1 + gamma, l3 + gamma * l2);
                let [r, s] = quadratic_real(l1 - gamma, l3 - gamma * l2);
                [p, q, r, s]
            } else {
                let gamma = d2.sqrt();
                let [p, q] = quadratic(Complex64::new(l1, gamma), Complex64::new(l3, gamma * l2));
                [p, p.conj(), q, q.conj()]
            }
        }
        _ => {
            // Two factors with the same linear term.
            let gap = square_root(Complex64::new(l3 * l3 - d, 0.0));
            let [p, q] = quadratic(Complex64::new(l1, 0.0), l3 + gap);
            let [r, s] = quadratic(Complex64::new(l1, 0.0), l3 - gap);
            [p, q, r, s]
        }
    }
}

/// The real root of largest magnitude of the depressed resolvent `φ³ + g φ + h`.
fn dominant_resolvent_root(a: f64, b: f64, c: f64, d: f64) -> f64 {
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

/// Newton on `ζ⁴ + a ζ³ + b ζ² + c ζ + d`, each step kept only if it lowers the residual.
fn polish([d, c, b, a]: [f64; 4], start: Complex64) -> Complex64 {
    let value = |z: Complex64| (((z + a) * z + b) * z + c) * z + d;
    let mut root = start;
    let mut residual = value(root);
    for _ in 0..POLISH {
        let slope = ((4.0 * root + 3.0 * a) * root + 2.0 * b) * root + c;
        // residual / slope, which is not finite for a multiple root: then no step is taken.
        let step = residual * slope.conj() * (1.0 / slope.norm_sqr());
        if step.norm_sqr() <= NEGLIGIBLE_STEP * NEGLIGIBLE_STEP * root.norm_sqr() {
            break;
        }
        let next = root - step;
        let next_residual = value(next);
        if next_residual.norm_sqr() < residual.norm_sqr() {
            root = next;
            residual = next_residual;
        } else {
            break;
        }
    }
    root
}
