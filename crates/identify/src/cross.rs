//! Cross-spectra at one frequency: amplitude ratios, phases and coherences of the channels.
//!
//! All channels of one mode share the factor `exp(λt)`, so the ratio of their windowed Fourier sums at one
//! frequency is the ratio of their complex amplitudes, exactly, whatever the growth and wherever the
//! frequency lies between bins: phases are not bound to the sampling.

use num_complex::Complex64;

/// Independent blocks per block when Hann blocks overlap by three quarters (Welch 1967).
pub(super) const INDEPENDENT: f64 = 0.52;

/// Sums over blocks of complex amplitudes at the dominant frequency. `x`, `y`: tangential and normal
/// acceleration; `n`, `t`: normal and tangential force; `u = T − μ N` with the mean friction coefficient μ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sums {
    /// Number of blocks.
    pub(super) blocks: f64,
    /// `Σ |X|⁴`: growing blocks count less than their number.
    pub(super) xxxx: f64,
    pub(super) xx: f64,
    pub(super) yy: f64,
    pub(super) nn: f64,
    pub(super) tt: f64,
    pub(super) uu: f64,
    pub(super) yx: Complex64,
    pub(super) nx: Complex64,
    pub(super) tx: Complex64,
    pub(super) ux: Complex64,
    /// Mean power of the noise in one block of `x, y, n, u`, summed over blocks.
    pub(super) noise: [f64; 4],
}

/// A measured number and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Its standard error, in the same unit.
    pub error: f64,
}

/// A complex amplitude ratio against the tangential acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Ratio {
    pub(super) value: Complex64,
    /// Standard error of each of its parts.
    pub(super) error: f64,
    /// The part of the error that no noise explains.
    pub(super) unexplained: f64,
    /// Squared coherence.
    pub(super) coherence: f64,
}

impl Measured {
    /// `4.3 ± 0.1`, both times `factor`, with this many decimals, or more until the error shows a digit.
    #[must_use]
    pub fn text(&self, factor: f64, decimals: usize) -> String {
        /// Decimals of an error that is nearly nothing.
        const MOST: f64 = 12.0;
        let (value, error) = (factor * self.value, factor.abs() * self.error);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 12")]
        let shown = if error > 0.0 { (-error.log10().floor()).clamp(0.0, MOST) as usize } else { 0 };
        let decimals = decimals.max(shown);
        format!("{value:.decimals$} ± {error:.decimals$}")
    }
}

impl Ratio {
    /// That of a channel that is late by this angle, rad, in time.
    pub(super) fn advanced(self, angle: f64) -> Ratio {
        Ratio { value: self.value * Complex64::cis(angle), ..self }
    }
}

impl Sums {
    /// Adds one block.
    pub(super) fn block(&mut self, [x, y, n, t, u]: [Complex64; 5], noise: [f64; 4]) {
        let xx = x.norm_sqr();
        self.blocks += 1.0;
        self.xxxx += xx * xx;
        self.xx += xx;
        self.yy += y.norm_sqr();
        self.nn += n.norm_sqr();
        self.tt += t.norm_sqr();
        self.uu += u.norm_sqr();
        self.yx += y * x.conj();
        self.nx += n * x.conj();
        self.tx += t * x.conj();
        self.ux += u * x.conj();
        self.noise.iter_mut().zip(noise).for_each(|(sum, power)| *sum += power);
    }

    /// Adds the sums of another window.
    pub(super) fn add(&mut self, other: &Sums) {
        self.blocks += other.blocks;
        self.xxxx += other.xxxx;
        self.xx += other.xx;
        self.yy += other.yy;
        self.nn += other.nn;
        self.tt += other.tt;
        self.uu += other.uu;
        self.yx += other.yx;
        self.nx += other.nx;
        self.tx += other.tx;
        self.ux += other.ux;
        self.noise.iter_mut().zip(other.noise).for_each(|(sum, power)| *sum += power);
    }

    /// Blocks that count: equally strong and independent ones would give the same scatter.
    fn effective(&self, share: f64) -> f64 {
        (self.xx * self.xx / self.xxxx.max(f64::MIN_POSITIVE) * share).max(1.0)
    }

    /// Power of the tangential acceleration over that of its noise.
    pub(super) fn signal_to_noise(&self) -> f64 {
        self.xx / self.noise[0].max(f64::MIN_POSITIVE)
    }

    /// Normal against tangential acceleration. `share`: independent blocks per block.
    pub(super) fn normal_acceleration(&self, share: f64) -> Ratio {
        self.ratio(self.yx, self.yy, self.noise[1], share)
    }

    /// Normal force against tangential acceleration.
    pub(super) fn normal_force(&self, share: f64) -> Ratio {
        self.ratio(self.nx, self.nn, self.noise[2], share)
    }

    /// `T − μ N` against tangential acceleration: what the friction coefficient itself does.
    pub(super) fn friction(&self, share: f64) -> Ratio {
        self.ratio(self.ux, self.uu, self.noise[3], share)
    }

    /// Amplitude of the normal force (or, without one, of the normal acceleration) that is neither noise nor in a
    /// fixed ratio to the tangential acceleration, relative to the whole: a second mode.
    pub(super) fn second_mode(&self) -> f64 {
        let force = if self.nn > 0.0 { [self.nn, self.nx.norm_sqr(), self.noise[2]] } else { [0.0; 3] };
        let acceleration =
            if self.yy > 0.0 { [self.yy, self.yx.norm_sqr(), self.noise[1]] } else { [0.0; 3] };
        let part = |[qq, qx, noise]: [f64; 3]| {
            if qq > 0.0 { (self.unexplained(qq, qx, noise) / qq).sqrt() } else { 0.0 }
        };
        // Sensors differ in noise: the better one decides.
        match (self.nn > 0.0, self.yy > 0.0) {
            (true, true) => part(force).max(part(acceleration)),
            (true, false) => part(force),
            _ => part(acceleration),
        }
    }

    /// Amplitude of the friction force that is neither noise, nor `μN`, nor in a fixed ratio to the motion,
    /// relative to the whole: stick, reversal, kinks.
    pub(super) fn nonlinear_friction(&self) -> f64 {
        if self.tt > 0.0 {
            (self.unexplained(self.uu, self.ux.norm_sqr(), self.noise[3]) / self.tt).sqrt()
        } else {
            0.0
        }
    }

    /// By how much the friction of `self` differs from that of `other`, relative to the whole friction force and
    /// beyond what noise explains: a strong motion that is no longer that of the weak one.
    pub(super) fn friction_departs(&self, other: &Sums) -> f64 {
        /// Standard errors of the difference that noise may reach.
        const BY_NOISE: f64 = 3.0;
        if self.xx <= 0.0 || other.xx <= 0.0 || self.tt <= 0.0 {
            return 0.0;
        }
        let variance = |sums: &Sums| sums.noise[3] / sums.blocks.max(1.0) / INDEPENDENT / sums.xx;
        let noise = (variance(self) + variance(other)).sqrt();
        let off = (self.ux / self.xx - other.ux / other.xx).norm();
        (off - BY_NOISE * noise).max(0.0) / (self.tx / self.xx).norm()
    }

    /// Noise of the friction per block, over that of `other`: stick and impacts fill the spectrum and look like noise.
    pub(super) fn noisier(&self, other: &Sums) -> f64 {
        let mean = |sums: &Sums| sums.noise[3] / sums.blocks.max(1.0);
        mean(self) / mean(other).max(f64::MIN_POSITIVE)
    }

    /// Power of `q` that is neither `H x` nor noise.
    fn unexplained(&self, qq: f64, qx: f64, noise: f64) -> f64 {
        /// Over the few independent blocks of a window the power of noise scatters up to this multiple of its mean.
        const SCATTER: f64 = 4.0;
        if self.xx <= 0.0 {
            return 0.0;
        }
        let expected = noise + qx / (self.xx * self.xx) * self.noise[0];
        (qq - qx / self.xx - SCATTER * expected).max(0.0)
    }

    /// Least squares of `q = H x` over the blocks. Its error: the noise beside the oscillation, and what the blocks
    /// leave unexplained beyond that.
    fn ratio(&self, qx: Complex64, qq: f64, noise: f64, share: f64) -> Ratio {
        if self.xx <= 0.0 {
            let unexplained = f64::INFINITY;
            return Ratio { value: Complex64::ZERO, error: f64::INFINITY, unexplained, coherence: 0.0 };
        }
        let value = qx / self.xx;
        let coherence = if qq > 0.0 { (qx.norm_sqr() / (self.xx * qq)).min(1.0) } else { 0.0 };
        let noise = noise + value.norm_sqr() * self.noise[0];
        let beyond = (qq * (1.0 - coherence) - noise).max(0.0);
        // Half of each power lies in each part of the complex ratio.
        let variance =
            0.5 * (noise / self.blocks.max(1.0) / share + beyond / self.effective(share)) / self.xx;
        let unexplained = (0.5 * beyond / self.effective(share) / self.xx).sqrt();
        Ratio { value, error: variance.sqrt(), unexplained, coherence }
    }
}
