//! A record of any length in a bounded number of cells: what segments are cut from.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use crate::cross::{INDEPENDENT, Measured, Sums};
use crate::episode::LOUD;
use crate::inertia::Inertia;
use crate::losses::Losses;
use crate::pitch::Pitch;
use crate::window::Window;
use crate::within::Within;

/// The most cells of a record: finer than any boundary is known.
const MOST: usize = 512;

/// Windows side by side, added up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cell {
    /// Start and end, s; windows overlap, cells do not.
    pub(super) time: [f64; 2],
    /// Number of windows.
    pub(super) windows: f64,
    /// Those in which an oscillation stands out of the noise.
    pub(super) loud: f64,
    /// Cross-spectra of these.
    pub(super) sums: Sums,
    /// `Σ` amplitude² of the tangential acceleration, m²/s⁴.
    pub(super) power: f64,
    /// The frequency, by power.
    pitch: Pitch,
    /// Windows in which the normal acceleration is much the larger one, and the tangential one shows nothing.
    unlike: f64,
    /// `Σ` of the means of `T`, `N`, `V`, temperature.
    tangential: f64,
    normal: f64,
    velocity: f64,
    temperature: f64,
    /// `Σ` of the squared swing of the forces.
    swing: f64,
    /// The friction law within the oscillation.
    pub(super) within: Within,
    /// What the structure loses in it.
    pub(super) losses: Losses,
    /// What moves along the contact.
    pub(super) inertia: Inertia,
}

impl Cell {
    fn new(window: &Window, hop: f64) -> Cell {
        // The middle of the window is its own, the rest it shares.
        let middle = 0.5 * (window.time[0] + window.time[1]);
        let loud = window.signal_to_noise >= LOUD;
        let friction = window.friction.zip(window.normal_force);
        Cell {
            time: [middle - 0.5 * hop, middle + 0.5 * hop],
            windows: 1.0,
            loud: f64::from(u8::from(loud)),
            sums: if loud { window.sums } else { Sums::default() },
            power: window.amplitude * window.amplitude,
            pitch: Pitch::of(window.frequency, window.amplitude * window.amplitude),
            unlike: f64::from(u8::from(!loud && window.unlike)),
            tangential: friction.map_or(0.0, |(mu, normal)| mu * normal),
            normal: window.normal_force.unwrap_or_default(),
            velocity: window.velocity.unwrap_or_default(),
            temperature: window.temperature.unwrap_or_default(),
            swing: window.swing.unwrap_or_default().powi(2),
            within: window.within,
            losses: window.losses,
            inertia: window.inertia,
        }
    }

    pub(super) fn add(&mut self, other: &Cell) {
        if self.windows == 0.0 {
            self.time[0] = other.time[0];
        }
        self.time[1] = other.time[1];
        self.windows += other.windows;
        self.loud += other.loud;
        self.sums.add(&other.sums);
        self.power += other.power;
        self.pitch.add(&other.pitch);
        self.unlike += other.unlike;
        self.tangential += other.tangential;
        self.normal += other.normal;
        self.velocity += other.velocity;
        self.temperature += other.temperature;
        self.swing += other.swing;
        self.within.add(&other.within);
        self.losses.add(&other.losses);
        self.inertia.add(&other.inertia);
    }

    /// Cells added up.
    pub(super) fn sum(cells: &[Cell]) -> Cell {
        let mut sum = Cell::default();
        for cell in cells {
            sum.add(cell);
        }
        sum
    }

    pub(super) fn middle(&self) -> f64 {
        0.5 * (self.time[0] + self.time[1])
    }

    /// Amplitude of the tangential acceleration, m/s².
    pub(super) fn amplitude(&self) -> f64 {
        (self.power / self.windows).sqrt()
    }

    /// Frequency, Hz.
    pub(super) fn frequency(&self) -> f64 {
        self.pitch.frequency()
    }

    /// Mean friction `ΣT/ΣN`; meaningless without forces.
    pub(super) fn friction(&self) -> f64 {
        self.tangential / self.normal
    }

    /// Mean normal force, N.
    pub(super) fn normal(&self) -> f64 {
        self.normal / self.windows
    }

    /// Mean velocity, m/s.
    pub(super) fn velocity(&self) -> f64 {
        self.velocity / self.windows
    }

    /// Mean velocity either way, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.velocity().abs()
    }

    /// Velocity of the vibration over that of sliding; `None` at rest.
    pub(super) fn reach(&self) -> Option<f64> {
        let reach = self.amplitude() / (TAU * self.frequency()) / self.speed();
        reach.is_finite().then_some(reach)
    }

    /// Mean temperature, °C.
    pub(super) fn temperature(&self) -> f64 {
        self.temperature / self.windows
    }

    /// Amplitude of the force that swings most at the frequency of the oscillation, over its mean.
    pub(super) fn swing(&self) -> f64 {
        (self.swing / self.windows).sqrt()
    }

    /// Phase of the normal against the tangential acceleration, degrees, and the squared coherence of the two; the normal one is
    /// late by `skew` (s).
    pub(super) fn phase(&self, skew: f64) -> Option<(Measured, f64)> {
        let ratio = self.sums.normal_acceleration(INDEPENDENT);
        let turned = ratio.value * Complex64::cis(TAU * self.frequency() * skew);
        let size = ratio.value.norm();
        let error = if size > 0.0 { (ratio.error / size).min(PI) } else { f64::INFINITY };
        let value = turned.arg().to_degrees();
        value.is_finite().then_some((Measured { value, error: error.to_degrees() }, ratio.coherence))
    }

    /// Whether the law is read in it.
    pub(super) fn reads(&self) -> bool {
        self.within != Within::default()
    }

    /// Whether in most of its windows the normal acceleration alone shows something.
    pub(super) fn is_unlike(&self) -> bool {
        2.0 * self.unlike > self.windows
    }

    /// The share of its windows in which an oscillation stands out.
    pub(super) fn is_loud(&self) -> bool {
        2.0 * self.loud >= self.windows
    }
}

/// The cells of a record, pairs of which become one when there are too many.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    /// In order of time.
    pub(super) list: Vec<Cell>,
    /// Windows of a full cell.
    each: f64,
    /// Between windows, s.
    hop: f64,
}

impl Cells {
    /// For windows that begin this far apart, s.
    pub(super) fn new(hop: f64) -> Cells {
        Cells { list: Vec::new(), each: 1.0, hop }
    }

    /// Leaves out what forces at the frequency of the vibration have shown.
    pub(super) fn forget_fast_forces(&mut self) {
        for cell in &mut self.list {
            *cell = Cell {
                swing: 0.0,
                within: Within::default(),
                losses: Losses::default(),
                inertia: Inertia::default(),
                ..*cell
            };
        }
    }

    pub(super) fn take(&mut self, window: &Window) {
        let cell = Cell::new(window, self.hop);
        match self.list.last_mut() {
            Some(last) if last.windows < self.each => last.add(&cell),
            _ => self.list.push(cell),
        }
        if self.list.len() > MOST {
            self.each *= 2.0;
            self.list = self.list.chunks(2).map(Cell::sum).collect();
        }
    }
}
