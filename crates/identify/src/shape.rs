//! The courses that the amplitude of one oscillation may take: what tells an instability from a vibration that is driven.
//!
//! Each is a complex function `z(τ)` with `z(0) = 1` at the end of a fit, all channels in fixed ratios to it:
//!
//! ```text
//! exponential   exp(λτ)                                                   the beginning of an instability
//! saturating    exp(λτ) (1 + κ(e^{2στ} − 1))^{−(1 + iη/κ)/2}              and its end: dz/dt = λz − c|z|²z (Stuart, Landau)
//! power         (1 + κστ)^{1/κ} exp(iωτ), 0 where 1 + κστ < 0             driven harder and harder
//! ```
//!
//! κ is the part of the growth that saturation has taken away at the end, η the same of the frequency. The growth rate of
//! an exponential is the same at all times, that of a saturating one falls with the square of its amplitude, at its end;
//! that of a power falls from the beginning.

use num_complex::Complex64;

/// A course and its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// σ, ω.
    Exponential([f64; 2]),
    /// σ, ω, κ, η.
    Saturating([f64; 4]),
    /// σ at the end, ω, κ.
    Power([f64; 3]),
}

/// `z` and the derivatives of `ln z` by the parameters, at one time.
pub(super) struct Point {
    pub(super) z: Complex64,
    pub(super) slopes: [Complex64; 4],
}

impl Shape {
    /// A saturating one that does not saturate yet: where a fit begins.
    pub(super) fn saturating(growth: f64, omega: f64) -> Shape {
        Shape::Saturating([growth, omega, 0.0, 0.0])
    }

    /// The parameters that are fitted.
    pub(super) fn parameters(&self) -> &[f64] {
        match self {
            Shape::Exponential(of) => of,
            Shape::Power(of) => of,
            Shape::Saturating(of) => of,
        }
    }

    /// With every parameter moved by its step, or as much of it as the shape allows; `None` where that is nothing.
    pub(super) fn moved(&self, steps: &[f64]) -> Option<Shape> {
        // No more than to half or to twice, and half-way to the limit at 1.
        let within = |old: f64, new: f64| new.clamp(0.5 * old, 2.0 * old);
        let below_one = |old: f64, new: f64| new.min(0.5 * (1.0 + old));
        let moved = match (*self, steps) {
            (Shape::Exponential([growth, omega]), [a, b]) => Shape::Exponential([growth + a, omega + b]),
            (Shape::Saturating([growth, omega, kappa, eta]), [a, b, c, d]) => {
                let (growth, kappa) = (within(growth, growth + a), below_one(kappa, kappa + c));
                Shape::Saturating([growth, omega + b, kappa, eta + d])
            }
            (Shape::Power([growth, omega, kappa]), [a, b, c]) => {
                Shape::Power([within(growth, growth + a), omega + b, kappa + c.clamp(-0.25, 0.25)])
            }
            _ => return None,
        };
        let decays = matches!(moved, Shape::Exponential([growth, _]) if growth.is_nan() || growth <= 0.0);
        (!decays && moved.omega() > 0.0).then_some(moved)
    }

    /// Growth rate (1/s) of the linear motion; of a power that at the end.
    pub(super) fn growth(&self) -> f64 {
        match self {
            Shape::Exponential([growth, ..])
            | Shape::Saturating([growth, ..])
            | Shape::Power([growth, ..]) => *growth,
        }
    }

    /// Growth rate (1/s) at `tau` (s).
    pub(super) fn rate(&self, tau: f64) -> f64 {
        match self {
            Shape::Saturating([growth, _, kappa, _]) => {
                growth * (1.0 - kappa) / (1.0 + kappa * (2.0 * growth * tau).exp_m1())
            }
            Shape::Power([growth, _, kappa]) => growth / (1.0 + kappa * growth * tau),
            Shape::Exponential([growth, _]) => *growth,
        }
    }

    /// The shape of a possible instability as a fit that ends at `tau` (s) sees it.
    pub(super) fn seen_from(self, tau: f64) -> Shape {
        match self {
            Shape::Saturating([growth, omega, kappa, eta]) => {
                let lost = (2.0 * growth * tau).exp_m1();
                let part = (1.0 + lost) / (1.0 + kappa * lost);
                Shape::Saturating([growth, omega, kappa * part, eta * part])
            }
            other => other,
        }
    }

    pub(super) fn omega(&self) -> f64 {
        match self {
            Shape::Exponential([_, omega])
            | Shape::Saturating([_, omega, ..])
            | Shape::Power([_, omega, _]) => *omega,
        }
    }

    /// At `tau` (s, 0 at the end and negative before).
    pub(super) fn at(&self, tau: f64) -> Point {
        let i_tau = Complex64::new(0.0, tau);
        let mut slopes = [Complex64::ZERO; 4];
        let z = match *self {
            Shape::Exponential([growth, omega]) => {
                slopes[..2].copy_from_slice(&[tau.into(), i_tau]);
                (Complex64::new(growth, omega) * tau).exp()
            }
            Shape::Saturating([growth, omega, kappa, eta]) => {
                let lost = (2.0 * growth * tau).exp_m1();
                let [log, by_kappa] = logarithm(kappa, lost);
                let by_growth = 2.0 * tau * (lost + 1.0) / (1.0 + kappa * lost);
                let c = -0.5 * Complex64::new(kappa, eta);
                slopes =
                    [tau + c * by_growth, i_tau, -0.5 * log + c * by_kappa, Complex64::new(0.0, -0.5 * log)];
                (Complex64::new(growth, omega) * tau + c * log).exp()
            }
            Shape::Power([growth, omega, kappa]) => {
                let part = 1.0 + kappa * growth * tau;
                if part <= 0.0 {
                    return Point { z: Complex64::ZERO, slopes };
                }
                let [log, by_kappa] = logarithm(kappa, growth * tau);
                slopes[..3].copy_from_slice(&[(tau / part).into(), i_tau, by_kappa.into()]);
                Complex64::new(log, omega * tau).exp()
            }
        };
        Point { z, slopes }
    }
}

/// `ln(1 + κx)/κ` and its derivative by κ, also at κ = 0.
fn logarithm(kappa: f64, x: f64) -> [f64; 2] {
    /// Below this the series is as exact.
    const SMALL: f64 = 1e-4;
    let y = kappa * x;
    if y.abs() < SMALL {
        return [x * (1.0 - y / 2.0 + y * y / 3.0), x * x * (-0.5 + 2.0 * y / 3.0)];
    }
    let log = y.ln_1p() / kappa;
    [log, (x / (1.0 + y) - log) / kappa]
}
