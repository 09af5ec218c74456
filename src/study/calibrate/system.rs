//! The two masses without friction, from what an impact test tells of them.
//!
//! With `M = m1 + m2`, `m_t = m2 + m1 c²`, `D = m1 m_t`, `a1 = c1 c²`, `b1 = k1 c²`, `a2 = c2` and `b2 = k2` the characteristic polynomial of
//! docs/physics.md at `μ = 0` is
//!
//! ```text
//! D λ⁴ + (M a2 + m1 a1) λ³ + (M b2 + m1 b1 + a1 a2) λ² + (a1 b2 + a2 b1) λ + b1 b2
//! ```
//!
//! and has to be `D (λ² + 2 ζ1 ω1 λ + ω1²)(λ² + 2 ζ2 ω2 λ + ω2²) = D (λ⁴ + p3 λ³ + p2 λ² + p1 λ + p0)`. The coefficients of λ³, 1 and λ² are
//! those of
//!
//! ```text
//! m1 a1, M a2 = D p3/2 ∓ δ      m1 b1, M b2 = G e^∓w      G = √(m1 M D p0)
//! cosh w = D p2/2G − (D² p3²/4 − δ²)/(2 G m1 M)
//! ```
//!
//! with `w > 0` if the upper mode is rather the normal one. What remains is the coefficient of λ, whose roots `δ` are found by bisection among the
//! dampers that are not negative, `|δ| ≤ D p3/2`. There `cosh w ≤ D p2/2G`, from which `s² ≤ (1 − 4 p0/p2²) M/m1`.

use std::f64::consts::TAU;

/// Masses (kg), frequencies (Hz) and damping ratios of the lower and the upper mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wanted {
    pub(super) masses: [f64; 2],
    pub(super) frequencies: [f64; 2],
    pub(super) damping_ratios: [f64; 2],
    /// Whether the upper mode is rather the normal one.
    pub(super) normal_above: bool,
}

/// Stiffnesses (N/m) and dampers (N s/m), tangential and normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Structure {
    pub(super) stiffness: [f64; 2],
    pub(super) damping: [f64; 2],
}

/// Places at which a change of sign is looked for.
const PLACES: u32 = 240;
/// Halvings of the interval between two of them.
const BISECTIONS: u32 = 60;

impl Wanted {
    /// ω of both modes, 1/s: what vibrates with ω √(1 − ζ²).
    fn omegas(&self) -> [f64; 2] {
        [0, 1].map(|mode| TAU * self.frequencies[mode] / (1.0 - self.damping_ratios[mode].powi(2)).sqrt())
    }

    /// The largest inclination (rad) at which two modes may lie so close.
    pub(super) fn steepest(&self) -> f64 {
        let [m1, m2] = self.masses;
        let [a, b] = self.omegas();
        let [p, q] = self.damping_ratios;
        // p2/(2 √p0) − 1, without differences of large numbers.
        let apart = (b - a).powi(2) / (2.0 * a * b) + 2.0 * p * q;
        let part = apart * (2.0 + apart) / (1.0 + apart).powi(2);
        (part * (m1 + m2) / m1).sqrt().min(1.0).asin()
    }

    /// The structures at an inclination (rad) up to [`Wanted::steepest`], in the order of `δ`.
    pub(super) fn structures(&self, theta: f64) -> Vec<Structure> {
        let at = Inclined::new(self, theta);
        if at.half == 0.0 {
            return vec![at.structure(At { delta: 0.0, w: arcosh(at.excess) })];
        }
        let mut found = Vec::new();
        for &side in at.sides() {
            let place = |part: f64| at.place(side, part);
            let lacks = |part: f64| at.lacks(place(part));
            let part = |k: u32| f64::from(k) / f64::from(PLACES);
            for k in 0..PLACES {
                let (mut low, mut high) = (part(k), part(k + 1));
                let first = lacks(low);
                if first == 0.0 || first * lacks(high) > 0.0 {
                    continue;
                }
                for _ in 0..BISECTIONS {
                    let middle = f64::midpoint(low, high);
                    if lacks(middle) * first > 0.0 { low = middle } else { high = middle }
                }
                found.push(at.structure(place(f64::midpoint(low, high))));
            }
        }
        found
    }
}

/// A place on the curve of structures that have all coefficients but one.
#[derive(Clone, Copy, Debug)]
struct At {
    delta: f64,
    w: f64,
}

/// A part of that curve: all of it, where `δ` may be 0, or one of its two ends.
#[derive(Clone, Copy, Debug)]
enum Side {
    Whole,
    Below,
    Above,
}

/// The numbers of the polynomial at an inclination.
struct Inclined {
    /// m1 and M.
    masses: [f64; 2],
    /// c².
    across: f64,
    g: f64,
    /// D p3/2 and D p1.
    half: f64,
    mixed: f64,
    /// D p2/2G − 1, and what is left of it where both dampers are alike.
    excess: f64,
    alike: f64,
    sign: f64,
}

impl Inclined {
    fn new(wanted: &Wanted, theta: f64) -> Inclined {
        let (s, c) = theta.sin_cos();
        let [m1, m2] = wanted.masses;
        let mass = m1 + m2;
        let tangential = m2 + m1 * c * c;
        let d = m1 * tangential;
        let [a, b] = wanted.omegas();
        let [p, q] = wanted.damping_ratios;
        let g = m1 * (mass * tangential).sqrt() * a * b;
        let half = d * (p * a + q * b);
        let roots = [mass, tangential].map(f64::sqrt);
        // D p2 − 2 G, without differences of large numbers.
        let excess = m1
            * roots[1]
            * (roots[1] * ((b - a).powi(2) + 4.0 * p * q * a * b)
                - 2.0 * a * b * m1 * s * s / (roots[0] + roots[1]))
            / (2.0 * g);
        Inclined {
            masses: [m1, mass],
            across: c * c,
            g,
            half,
            mixed: d * 2.0 * a * b * (p * b + q * a),
            excess,
            alike: excess - half * half / (2.0 * g * m1 * mass),
            sign: if wanted.normal_above { 1.0 } else { -1.0 },
        }
    }

    /// The parts of the curve, in the order of `δ`.
    fn sides(&self) -> &'static [Side] {
        if self.alike >= 0.0 { &[Side::Whole] } else { &[Side::Below, Side::Above] }
    }

    /// A place by the part of its side up to there. Each is reckoned from what is small where it is.
    fn place(&self, side: Side, part: f64) -> At {
        let [m1, mass] = self.masses;
        let unit = 2.0 * self.g * m1 * mass;
        let (sign, part) = match side {
            Side::Whole => {
                let delta = self.half * (2.0 * part - 1.0);
                return At { delta, w: arcosh(self.alike + delta * delta / unit) };
            }
            Side::Below => (-1.0, 1.0 - part),
            Side::Above => (1.0, part),
        };
        let w = part * arcosh(self.excess);
        let delta = (unit * (2.0 * (0.5 * w).sinh().powi(2) - self.alike)).sqrt();
        At { delta: sign * delta.min(self.half), w }
    }

    /// m1 a1 and M a2; m1 b1 and M b2.
    fn parts(&self, At { delta, w }: At) -> [[f64; 2]; 2] {
        let turned = self.sign * w;
        [[self.half - delta, self.half + delta], [(-turned).exp() * self.g, turned.exp() * self.g]]
    }

    /// What the coefficient of λ is off.
    fn lacks(&self, at: At) -> f64 {
        let [[a1, a2], [b1, b2]] = self.parts(at);
        let [m1, mass] = self.masses;
        (a1 * b2 + a2 * b1) / (m1 * mass) - self.mixed
    }

    fn structure(&self, at: At) -> Structure {
        let [m1, mass] = self.masses;
        let [[a1, a2], [b1, b2]] = self.parts(at);
        Structure {
            stiffness: [b1 / m1 / self.across, b2 / mass],
            damping: [a1.max(0.0) / m1 / self.across, a2.max(0.0) / mass],
        }
    }
}

/// The inverse of `cosh w − 1`; 0 below.
fn arcosh(excess: f64) -> f64 {
    2.0 * (0.5 * excess.max(0.0)).sqrt().asinh()
}
