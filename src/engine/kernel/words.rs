//! An instance as words of the linear kernel, and its results back in SI units: f64, host only.

use std::f64::consts::TAU;

use crate::engine::fields::words;
use crate::engine::kernel::linear::{FLAGS, STATE, code};
use crate::model::kind::InstabilityType;
use crate::model::linear::{Linear, Prepared};

/// Input words of one instance.
pub const INPUT_WORDS: usize = words(&crate::engine::kernel::linear::INPUTS);

/// State words of one instance.
pub const STATE_WORDS: usize = words(&STATE);

/// Flags of one instance.
pub const FLAG_WORDS: usize = words(&FLAGS);

/// Half the sum of the roots, or of their inverses, in units of their geometric mean, beyond which they lie far apart. It is 3
/// where two modes a thousandfold apart have a damping ratio of 0.1.
const FAR: f64 = 1e4;

/// An instance that the linear kernel can analyse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Words {
    /// Its input words.
    pub inputs: [f64; INPUT_WORDS],
    /// The unit of each polynomial's eigenvalues, 1/s: full, flat, frozen.
    pub scales: [f64; 3],
    /// `sin θ`, the sign of the mode ratio.
    pub s: f64,
    /// Whether anything damps.
    pub damped: bool,
}

impl Words {
    /// The words of prepared polynomials.
    #[must_use]
    pub fn new(prepared: &Prepared) -> Words {
        let mut inputs = [0.0; INPUT_WORDS];
        let mut scales = [0.0; 3];
        for (k, polynomial) in [prepared.full, prepared.flat, prepared.frozen].into_iter().enumerate() {
            let (four, scale) = reduced(polynomial);
            inputs[4 * k..4 * k + 4].copy_from_slice(&four);
            scales[k] = scale;
        }
        let [stiffness, damping, mass] = prepared.normal;
        inputs[12] = mass / stiffness * scales[0] * scales[0];
        inputs[13] = 1.0 - inputs[12];
        inputs[14] = damping / stiffness * scales[0];
        Words { inputs, scales, s: prepared.s, damped: prepared.is_damped() }
    }

    /// Whether roots lie so far apart, by damping, that the kernel's form has no digits for the small ones: the quartic itself has.
    #[must_use]
    pub fn is_far(&self) -> bool {
        // `P`, and half of `c`.
        let sums = |four: &[f64]| [four[0], four[0] - four[3]];
        self.inputs[..12].chunks(4).flat_map(sums).any(|sum| sum.abs() > FAR)
    }

    /// Type and analysis from what the kernel wrote; `None` for a code that is no type.
    #[must_use]
    pub fn results(&self, state: [f64; STATE_WORDS], kind: u32) -> Option<(InstabilityType, Linear)> {
        let kind = InstabilityType::ALL.into_iter().find(|one| code(*one) == kind)?;
        let [growth, frequency, ratio_re, ratio_im, flat, frozen] = state;
        let leads = kind != InstabilityType::Stable || self.damped;
        let phase = (leads && frequency != 0.0 && self.s != 0.0)
            .then(|| (self.s * ratio_im).atan2(self.s * ratio_re).to_degrees())
            .filter(|phase| phase.is_finite());
        let linear = Linear {
            growth_rate: growth * self.scales[0],
            frequency: leads.then_some(frequency * self.scales[0] / TAU),
            phase,
            growth_rate_flat: flat * self.scales[1],
            growth_rate_frozen: frozen * self.scales[2],
        };
        Some((kind, linear))
    }
}

/// `P, g, P c − 2g, e` of a polynomial (powers 0 to 4) scaled to the constant term 1, and the scale.
fn reduced([c0, c1, c2, c3, c4]: [f64; 5]) -> ([f64; 4], f64) {
    let scale = (c0 / c4).sqrt().sqrt();
    let (a, b, c) = (c3 / c4 / scale, c2 / c4 / (scale * scale), c1 / c4 / (scale * scale * scale));
    let (p, g) = (0.5 * a, b - 2.0);
    ([p, g, p * c - 2.0 * g, p - 0.5 * c], scale)
}
