//! The two masses without friction, from what an impact test tells of them.
//!
//! With `m_t = m2 + m1 c²`, `K = k1 c² + k2 s²` and `μ = 0` the modes of docs/physics.md are those of
//!
//! ```text
//! (K − m_t ω²)(k2 − m1 ω²) = s² k2²
//! ```
//!
//! With `X = K/m_t`, `Y = k2/m1` and `r = s² m1/m_t` their sum and product are `X + Y = ω1² + ω2²` and `XY − rY² = ω1² ω2²`, so that
//!
//! ```text
//! Y = (Σ ± √(Σ² − 4 (1 + r) Π))/(2 (1 + r))        Σ = ω1² + ω2²,  Π = ω1² ω2²
//! ```
//!
//! with the upper sign where the upper mode is rather the normal one. A weak damping adds `φᵀCφ = 2ζω` to a mode `φ` of unit modal
//! mass, which is linear in both dampers.

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

impl Wanted {
    fn tangential_mass(&self, theta: f64) -> f64 {
        self.masses[1] + self.masses[0] * theta.cos().powi(2)
    }

    /// The largest inclination (rad) at which two modes may lie so close; friction couples them at the least coefficient there.
    pub(super) fn steepest(&self) -> f64 {
        let [a, b] = self.frequencies.map(|f| (TAU * f).powi(2));
        let ratio = (b - a).powi(2) / (4.0 * a * b);
        // r = s² m1/(m2 + m1 (1 − s²))
        let [m1, m2] = self.masses;
        (ratio * (m1 + m2) / (m1 * (1.0 + ratio))).sqrt().min(1.0).asin()
    }

    /// The structure at an inclination (rad) up to [`Wanted::steepest`].
    pub(super) fn structure(&self, theta: f64) -> Structure {
        let (s, c) = theta.sin_cos();
        let m1 = self.masses[0];
        let mass = self.tangential_mass(theta);
        let squares = self.frequencies.map(|f| (TAU * f).powi(2));
        let (sum, product) = (squares[0] + squares[1], squares[0] * squares[1]);
        let r = s * s * m1 / mass;
        let root = (sum * sum - 4.0 * (1.0 + r) * product).max(0.0).sqrt();
        let root = if self.normal_above { root } else { -root };
        let y = (sum + root) / (2.0 * (1.0 + r));
        let k2 = m1 * y;
        let k1 = (mass * (sum - y) - k2 * s * s) / (c * c);
        let rows = [0, 1].map(|mode| {
            // (K − m_t ω²) x − s k2 y = 0, or the other row where that is nearly 0.
            let square = squares[mode];
            let [first, second] = [mass * (sum - y) - mass * square, k2 - m1 * square];
            let [x, up] =
                if first.abs() * m1 > second.abs() * mass { [s * k2, first] } else { [second, s * k2] };
            let modal = mass * x * x + m1 * up * up;
            let (across, along) = ((s * x - up).powi(2) / modal, (c * x).powi(2) / modal);
            [along, across, 2.0 * self.damping_ratios[mode] * square.sqrt()]
        });
        let [[a, b, e], [d, g, f]] = rows;
        let determinant = a * g - b * d;
        Structure {
            stiffness: [k1, k2],
            damping: [(e * g - b * f) / determinant, (a * f - e * d) / determinant],
        }
    }
}
