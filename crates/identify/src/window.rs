//! One window: frequency, growth, distortion and cross-spectra.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::channel::{Channel, PerChannel};
use crate::cross::{INDEPENDENT, Measured, Sums};
use crate::inertia::Inertia;
use crate::lanes::{dot, sum};
use crate::losses::Losses;
use crate::motion::{drift, integral, period};
use crate::settings::Settings;
use crate::spectrum::{Beside, Spectra, detrend, hann, refine};
use crate::within::{PER_PERIOD, Within};

/// Periods of the dominant oscillation in a block: the fewest whose main lobe stays clear of drift.
const BLOCK_PERIODS: f64 = 4.0;
/// Blocks overlap by three quarters.
const BLOCK_HOPS: usize = 4;
/// Blocks of a window: 12 periods, in which an oscillation of Table 1 grows by a factor of 2 to 16.
const BLOCKS: usize = 9;
/// Fewest samples of a block.
const LEAST_BLOCK: usize = 12;
/// Windows start this many block hops apart.
const WINDOW_HOPS: usize = 3;
/// Windows that hold the same block.
pub(super) const SHARED: f64 = BLOCKS as f64 / WINDOW_HOPS as f64;
/// A normal acceleration that is larger than the tangential one by this factor, which shows no oscillation, tells that its sensor is dead:
/// modes that friction drives move along the contact, too.
pub(super) const UNLIKE: f64 = 30.0;
/// Bins of a window that slow drift reaches.
const DRIFT_BINS: usize = 3;

/// Lengths in samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Geometry {
    block: usize,
    block_hop: usize,
    pub(super) window: usize,
    pub(super) hop: usize,
}

impl Geometry {
    /// Windows for an oscillation of `period` samples.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number of samples"
    )]
    pub(super) fn new(period: f64) -> Geometry {
        let block = ((BLOCK_PERIODS * period).round() as usize).max(LEAST_BLOCK);
        let block_hop = (block / BLOCK_HOPS).max(1);
        let window = block + (BLOCKS - 1) * block_hop;
        Geometry { block, block_hop, window, hop: WINDOW_HOPS * block_hop }
    }
}

/// The results of one window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Start and end, s.
    pub time: [f64; 2],
    /// Mean friction coefficient `ΣT/ΣN`.
    pub friction: Option<f64>,
    /// Mean normal force, N.
    pub normal_force: Option<f64>,
    /// Mean velocity, m/s.
    pub velocity: Option<f64>,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
    /// Root mean square of the tangential acceleration without its trend, m/s².
    pub rms: f64,
    /// Whether the normal acceleration is so much larger that the tangential one has hardly a sensor.
    pub(super) unlike: bool,
    /// Dominant frequency of the tangential acceleration, Hz.
    pub frequency: f64,
    /// Its power over that of the noise beside it.
    pub signal_to_noise: f64,
    /// Growth rate of the envelope, 1/s.
    pub growth: Measured,
    /// Amplitude of the second and third harmonic relative to the fundamental, noise taken off.
    pub distortion: f64,
    /// Amplitude of the tangential acceleration at that frequency, noise taken off, m/s².
    pub amplitude: f64,
    /// Amplitude of either force at that frequency over its mean, the larger one.
    pub(super) swing: Option<f64>,
    /// The friction law within the oscillation, of the part of the window that no other has in its middle.
    pub(super) within: Within,
    /// What the structure loses, of the same part.
    pub(super) losses: Losses,
    /// What moves along the contact, of the same part, where it opens.
    pub(super) inertia: Inertia,
    pub(super) sums: Sums,
}

/// Analyses windows of one length; keeps its buffers.
pub(super) struct Analyser {
    geometry: Geometry,
    rate: f64,
    has: PerChannel<bool>,
    band: Option<[f64; 2]>,
    /// Whether the forces are restored from the accelerations.
    restored: bool,
    spectra: Spectra,
    taper: Vec<f64>,
    power: Vec<f64>,
    beside: Beside,
    /// Real and imaginary parts of the tapered phasor of a block.
    phasors: [Vec<f64>; 2],
    /// `x, y, n, t, u`, trends removed.
    signals: [Vec<f64>; 5],
    /// `ẋ`, trend removed.
    motion: Vec<f64>,
}

impl Analyser {
    pub(super) fn new(geometry: Geometry, rate: f64, has: PerChannel<bool>, settings: &Settings) -> Analyser {
        Analyser {
            geometry,
            rate,
            has,
            band: settings.band,
            restored: settings.rig.is_some(),
            spectra: Spectra::quick(hann(geometry.window)),
            taper: hann(geometry.block),
            power: Vec::new(),
            beside: Beside::default(),
            phasors: Default::default(),
            signals: Default::default(),
            motion: Vec::new(),
        }
    }

    /// Analyses one window: one slice per channel, each as long as [`Geometry::window`].
    pub(super) fn window(&mut self, start: f64, channels: &PerChannel<&[f64]>) -> Window {
        let mean = |channel: Channel| {
            let values = channels[channel as usize];
            self.has[channel as usize].then(|| sum(values) / values.len() as f64)
        };
        let normal_force = mean(Channel::NormalForce);
        let friction =
            mean(Channel::TangentialForce).zip(normal_force).map(|(tangential, normal)| tangential / normal);
        let (velocity, temperature) = (mean(Channel::Velocity), mean(Channel::Temperature));
        self.load(channels, friction.unwrap_or(0.0));
        let [rms, across] =
            [0, 1].map(|k| (dot(&self.signals[k], &self.signals[k]) / self.geometry.window as f64).sqrt());
        let unlike = self.has[Channel::NormalAcceleration as usize] && across > UNLIKE * rms;
        let (bin, mut distortion, x_noise) = self.peak();
        let frequency = bin * self.rate / self.spectra.length() as f64;
        // Block and window are tapered alike, so noise powers go with their lengths.
        let shorter = self.geometry.block as f64 / self.geometry.window as f64;
        let mut noise = [x_noise; 4];
        for (noise, signal) in noise[1..].iter_mut().zip([1, 2, 4]) {
            self.spectra.power_of_level(&self.signals[signal], &mut self.power);
            *noise = self.beside.noise_floor(&self.power);
        }
        if self.has[Channel::TangentialForce as usize] {
            self.spectra.power_of_level(&self.signals[3], &mut self.power);
            let floor = self.beside.noise_floor(&self.power);
            distortion = distortion.max(harmonics(&self.power, bin, floor));
        }
        let (sums, growth, frequency) = self.blocks(frequency, noise.map(|power| power * shorter));
        // A block under a Hann taper sums an amplitude to a quarter of its samples of it.
        let amplitude = |power: f64, noise: f64| {
            4.0 * ((power - noise).max(0.0) / sums.blocks).sqrt() / self.geometry.block as f64
        };
        let [along, _, normal_noise, friction_noise] = sums.noise;
        let swing = friction.zip(normal_force).map(|(mu, mean)| {
            let tangential = amplitude(sums.tt, friction_noise + mu * mu * normal_noise) / (mu * mean).abs();
            tangential.max(amplitude(sums.nn, normal_noise) / mean.abs())
        });
        let amplitude = amplitude(sums.xx, along);
        let (within, losses, inertia) = self.within(channels, velocity.zip(normal_force), frequency);
        Window {
            time: [start, start + self.geometry.window as f64 / self.rate],
            friction,
            normal_force,
            velocity,
            temperature,
            rms,
            unlike,
            frequency,
            signal_to_noise: sums.signal_to_noise(),
            growth,
            distortion,
            amplitude,
            swing,
            within,
            losses,
            inertia,
            sums,
        }
    }

    /// The friction law within the oscillation, with the mean velocity (m/s) and normal force (N), the losses and the mass; at a
    /// frequency (Hz).
    fn within(
        &mut self,
        channels: &PerChannel<&[f64]>,
        means: Option<(f64, f64)>,
        frequency: f64,
    ) -> (Within, Losses, Inertia) {
        /// Samples per period, with which the velocity is 1 % off; with three and a half it is 7 %, and the harmonics are lost.
        const LEAST: f64 = 5.0;
        let is_read = self.has[Channel::TangentialForce as usize] && self.rate >= LEAST * frequency;
        let Some((velocity, mean)) = means.filter(|_| is_read) else {
            return Default::default();
        };
        integral(&self.signals[0], 1.0 / self.rate, &mut self.motion);
        let slow = drift(&self.motion, period(self.rate / frequency));
        self.motion.iter_mut().zip(slow).for_each(|(motion, slow)| *motion -= slow);
        let Geometry { window, hop, .. } = self.geometry;
        let middle = (window - hop) / 2..usize::midpoint(window, hop);
        let [acceleration, tangential, normal] =
            [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::NormalForce]
                .map(|c| &channels[c as usize][middle.clone()]);
        let motion = &mut self.motion[middle.clone()];
        let losses = Losses::read(motion, &self.signals[0][middle], tangential, normal);
        let inertia = if losses.opens() && self.restored {
            // The motion of a contact that opens tells neither forces nor, with forces made of it, the mass.
            return Default::default();
        } else if losses.opens() {
            Inertia::read(motion, [acceleration, tangential, normal], self.rate, self.rate / frequency)
        } else {
            Inertia::default()
        };
        let within = if self.rate < PER_PERIOD * frequency {
            Within::default()
        } else {
            Within::read(motion, [acceleration, tangential, normal], velocity, mean)
        };
        (within, losses, inertia)
    }

    fn load(&mut self, channels: &PerChannel<&[f64]>, friction: f64) {
        let of = |channel: Channel| channels[channel as usize];
        let (tangential, normal) = (of(Channel::TangentialForce), of(Channel::NormalForce));
        let vibrating =
            [of(Channel::TangentialAcceleration), of(Channel::NormalAcceleration), normal, tangential];
        for (signal, values) in self.signals.iter_mut().zip(vibrating) {
            signal.clear();
            signal.extend_from_slice(values);
        }
        self.signals[4].clear();
        self.signals[4].extend(tangential.iter().zip(normal).map(|(t, n)| t - friction * n));
        self.signals.iter_mut().for_each(|signal| detrend(signal));
    }

    /// Position of the dominant peak of the tangential acceleration (bins), its distortion and its noise.
    fn peak(&mut self) -> (f64, f64, f64) {
        self.spectra.power_of_level(&self.signals[0], &mut self.power);
        let width = self.rate / self.spectra.length() as f64;
        let inside =
            |k: usize| self.band.is_none_or(|[low, high]| (low..=high).contains(&(k as f64 * width)));
        let bins = (DRIFT_BINS..self.power.len()).filter(|k| inside(*k));
        let highest = bins.max_by(|a, b| self.power[*a].total_cmp(&self.power[*b])).unwrap_or(DRIFT_BINS);
        let bin = refine(&self.power, highest);
        self.beside.set(self.power.len(), bin);
        let floor = self.beside.noise_floor(&self.power);
        (bin, harmonics(&self.power, bin, floor), floor)
    }

    /// Fills the tapered phasor, which turns by `turn` from sample to sample.
    fn turn(&mut self, turn: Complex64) {
        self.phasors.iter_mut().for_each(Vec::clear);
        let mut phasor = Complex64::ONE;
        for weight in &self.taper {
            self.phasors[0].push(phasor.re * weight);
            self.phasors[1].push(phasor.im * weight);
            phasor *= turn;
        }
    }

    /// Complex amplitudes of every block at `frequency` (Hz), the growth rate of their magnitude, and the frequency again
    /// (Hz), from the phase that they gain: the peak of a spectrum is biased by up to 0.02 bins, 0.2 %.
    fn blocks(&mut self, frequency: f64, noise: [f64; 4]) -> (Sums, Measured, f64) {
        let Geometry { block, block_hop, .. } = self.geometry;
        self.turn(Complex64::cis(-TAU * frequency / self.rate));
        let mut sums = Sums::default();
        let mut amplitudes = [(0.0, 0.0); BLOCKS];
        let (mut before, mut gained) = (Complex64::ZERO, Complex64::ZERO);
        let hop = block_hop as f64 / self.rate;
        for (number, amplitude) in amplitudes.iter_mut().enumerate() {
            let from = number * block_hop;
            let totals = self.signals.each_ref().map(|signal| {
                let [re, im] = self.phasors.each_ref().map(|part| dot(part, &signal[from..from + block]));
                Complex64::new(re, im)
            });
            sums.block(totals, noise);
            gained += totals[0] * before.conj();
            before = totals[0];
            let middle = (from as f64 + 0.5 * block as f64) / self.rate;
            *amplitude = (middle, totals[0].norm_sqr());
        }
        let ahead = (gained * Complex64::cis(-TAU * frequency * hop)).arg() / (TAU * hop);
        (sums, growth(&amplitudes, noise[0]), frequency + ahead)
    }
}

/// Amplitude of the second and third harmonic relative to the fundamental at `bin`, the noise taken off.
fn harmonics(power: &[f64], bin: f64, floor: f64) -> f64 {
    /// The highest of three bins of noise and twice that for its scatter.
    const ALLOWED: f64 = 4.0;
    let top = |position: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin is not negative")]
        let k = position.round() as usize;
        let near = k.saturating_sub(1)..=k + 1;
        near.filter_map(|k| power.get(k)).fold(0.0, |top: f64, p| top.max(*p))
    };
    let above: f64 = [2.0, 3.0].into_iter().map(|h| (top(h * bin) - ALLOWED * floor).max(0.0)).sum();
    let fundamental = top(bin);
    if fundamental > 0.0 { (above / fundamental).sqrt() } else { 0.0 }
}

/// Slope of `ln |X|` over time by least squares; blocks below the noise count less.
fn growth(blocks: &[(f64, f64)], noise: f64) -> Measured {
    const UNKNOWN: Measured = Measured { value: 0.0, error: f64::INFINITY };
    // The noise adds its mean to |X|²; time, ln|X|, weight and variance of ln|X| of what is above it.
    let points: Vec<[f64; 4]> = blocks
        .iter()
        .map(|(t, power)| (t, power - noise))
        .filter(|(_, power)| *power > 0.0)
        .map(|(t, power)| [*t, 0.5 * power.ln(), power / (power + noise), 0.5 * noise / power])
        .collect();
    let total: f64 = points.iter().map(|[_, _, w, _]| w).sum();
    let t0 = points.iter().map(|[t, _, w, _]| w * t).sum::<f64>() / total;
    let l0 = points.iter().map(|[_, l, w, _]| w * l).sum::<f64>() / total;
    let spread: f64 = points.iter().map(|[t, _, w, _]| w * (t - t0).powi(2)).sum();
    if points.len() < 3 || spread.is_nan() || spread <= 0.0 {
        return UNKNOWN;
    }
    let value = points.iter().map(|[t, l, w, _]| w * (t - t0) * (l - l0)).sum::<f64>() / spread;
    let residual: f64 = points.iter().map(|[t, l, w, _]| w * (l - l0 - value * (t - t0)).powi(2)).sum();
    let by_scatter = residual / (points.len() as f64 * INDEPENDENT - 2.0).max(1.0) / spread;
    let by_noise: f64 = points.iter().map(|[t, _, w, v]| v * (w * (t - t0)).powi(2)).sum::<f64>()
        / (spread * spread * INDEPENDENT);
    Measured { value, error: (by_scatter + by_noise).sqrt() }
}
