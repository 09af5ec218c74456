//! An overview of a whole record, gathered window by window.

use crate::cross::{INDEPENDENT, Measured};
use crate::episode::{Episode, LOUD, Recorded, is_linear};
use crate::line::Line;
use crate::window::Window;

/// Root mean square of the tangential acceleration, velocity and friction coefficient of a window.
type Quiet = [f32; 3];

/// The windows of a record in few numbers.
pub(super) struct Overview {
    recorded: Recorded,
    /// Number of windows.
    pub(super) windows: usize,
    /// Start of the first and end of the last window, s.
    pub(super) time: [f64; 2],
    /// Windows in which an oscillation stands out.
    pub(super) loud: usize,
    /// Power, start (s) and frequency (Hz) of the loudest of them.
    pub(super) loudest: [f64; 3],
    /// Whether all of them are linear.
    pub(super) linear: bool,
    /// Amplitude of the oscillation in the last window.
    pub(super) last: f64,
    clarity: f64,
    trend: Line,
    /// Windows with velocity and friction coefficient, `None` for the others.
    quiet: Vec<Option<Quiet>>,
    largest: f64,
}

impl Overview {
    pub(super) fn new(recorded: Recorded) -> Overview {
        Overview {
            recorded,
            windows: 0,
            time: [0.0; 2],
            loud: 0,
            loudest: [0.0; 3],
            linear: true,
            last: 0.0,
            clarity: 0.0,
            trend: Line::default(),
            quiet: Vec::new(),
            largest: 0.0,
        }
    }

    /// Takes the next window.
    #[expect(clippy::cast_possible_truncation, reason = "f32 has more digits than a friction coefficient")]
    pub(super) fn take(&mut self, window: &Window) {
        if self.windows == 0 {
            self.time[0] = window.time[0];
        }
        self.windows += 1;
        self.time[1] = window.time[1];
        let power = (window.sums.xx - window.sums.noise[0]).max(0.0);
        self.last = power.sqrt();
        self.largest = self.largest.max(window.rms);
        let slow = window.velocity.zip(window.friction);
        self.quiet.push(slow.map(|(velocity, mu)| [window.rms, velocity, mu].map(|x| x as f32)));
        if window.signal_to_noise < LOUD {
            return;
        }
        self.loud += 1;
        self.linear &= is_linear(window);
        self.clarity += clarity(window, self.recorded);
        if self.loud == 1 || window.sums.xx >= self.loudest[0] {
            self.loudest = [window.sums.xx, window.time[0], window.frequency];
        }
        let middle = 0.5 * (window.time[0] + window.time[1]);
        self.trend.take([middle, 0.5 * power.max(f64::MIN_POSITIVE).ln()]);
    }

    /// Slope of the logarithm of the amplitude over the loud windows, 1/s.
    pub(super) fn trend(&self) -> Measured {
        self.trend.slope()
    }

    /// Mean squared coherence of the loud windows.
    pub(super) fn clarity(&self) -> f64 {
        self.clarity / self.loud.max(1) as f64
    }

    /// Slope of the mean friction coefficient against the velocity over the windows before the first growth has ended in
    /// which the motion is small: large oscillations change the mean, and stick and flight make it another quantity.
    pub(super) fn quasi_static_slope(&self, episodes: &[Episode]) -> Option<Friction> {
        /// Windows below this part of the largest oscillation are quiet.
        const QUIET: f64 = 0.1;
        /// Fewest windows of a slope.
        const LEAST: usize = 8;
        /// Relative range of velocities below which there is no slope to speak of.
        const RANGE: f64 = 0.02;
        let end = episodes.first().map_or(self.quiet.len(), |episode| episode.windows[1] + 1);
        let (mut line, mut count) = (Line::default(), 0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for [rms, velocity, mu] in self.quiet[..end].iter().flatten().map(|quiet| quiet.map(f64::from)) {
            if rms <= QUIET * self.largest {
                line.take([velocity, mu]);
                (low, high, count) = (low.min(velocity), high.max(velocity), count + 1);
            }
        }
        let usable = count >= LEAST && high - low > RANGE * high.abs().max(low.abs());
        let slope = usable.then(|| line.slope()).filter(|slope| slope.error.is_finite());
        slope.map(|slope| Friction { slope, velocity: [low, high] })
    }
}

/// Squared coherence of one oscillation with the other channels, 1 without any.
fn clarity(window: &Window, recorded: Recorded) -> f64 {
    let force = window.sums.normal_force(INDEPENDENT).coherence;
    let acceleration = window.sums.normal_acceleration(INDEPENDENT).coherence;
    match (recorded.forces, recorded.normal_acceleration) {
        (false, false) => 1.0,
        (true, false) => force,
        (false, true) => acceleration,
        (true, true) => force.max(acceleration),
    }
}

/// Mean friction against mean velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// `dμ/dV`, s/m.
    pub slope: Measured,
    /// Lowest and highest velocity, m/s.
    pub velocity: [f64; 2],
}
