//! Running reductions of one trajectory, in scaled units.
//!
//! Integrals over a step use Gauss–Legendre nodes on its series, so that means are as accurate as the
//! method whatever the step; nothing is stored.

use crate::engine::method::roots::upward_crossings;
use crate::engine::method::taylor::{Motion, NORMAL, X2, Y1, horner_with_derivatives};
use crate::engine::reductions::Reductions;
use crate::engine::reference::observer::{Event, Observer, Step};
use crate::engine::sums::{growth, peak, sum};
use crate::model::contact::ContactState;
use num_complex::Complex64;

/// Nodes on `[0, 1]` and weights of the four-point Gauss–Legendre rule: on the longest step of the
/// reference (`ωτ = 0.98`) it integrates the squares of a harmonic to 1e-7.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Adds a step to the sums of half of the measuring window.
fn add(sums: &mut [f64; sum::WORDS], step: &Step, nodes: &[Sample; 4], origin: [f64; 2]) {
    let duration = step.duration;
    let from = [origin[0] - step.warmth.base[0], origin[1] - step.warmth.base[1]];
    sums[sum::TIME] += duration;
    match step.expansion.contact.state() {
        ContactState::Slip => {}
        ContactState::Reverse => sums[sum::REVERSE] += duration,
        ContactState::Stick => sums[sum::STICK] += duration,
        ContactState::Free => sums[sum::FREE] += duration,
    }
    for ((_, weight), sample) in GAUSS.iter().zip(nodes) {
        let weight = weight * duration;
        let Motion { state, acceleration: [ax, _, ay] } = sample.motion;
        let (x, y) = (state.position[X2] - from[0], state.position[Y1] - from[1]);
        let [vx, _, vy] = state.velocity;
        sums[sum::X] += weight * x;
        sums[sum::XX] += weight * x * x;
        sums[sum::Y] += weight * y;
        sums[sum::YY] += weight * y * y;
        sums[sum::AX] += weight * ax * ax;
        sums[sum::AY] += weight * ay * ay;
        sums[sum::SPEED] += weight * (vx * vx + vy * vy);
        sums[sum::TANGENTIAL] += weight * sample.forces.0;
        sums[sum::NORMAL] += weight * sample.forces.1;
    }
}

/// The motion and the contact forces `(T, N)` at one time of a step.
#[derive(Clone, Copy, Debug)]
struct Sample {
    motion: Motion,
    forces: (f64, f64),
}

impl Sample {
    fn at(step: &Step, fraction: f64) -> Sample {
        let tau = fraction * step.duration;
        Sample { motion: step.expansion.motion(tau), forces: step.expansion.forces(tau) }
    }
}

/// The times of the samples of a step as fractions of it: its start, the Gauss nodes, its end.
const SAMPLE_TIMES: [f64; 6] = [0.0, GAUSS[0].0, GAUSS[1].0, GAUSS[2].0, GAUSS[3].0, 1.0];

/// Newton steps from the vertex of the parabola to the maximum of the series itself.
const PEAK_ITERATIONS: usize = 4;

/// Raises `peak` to the maximum of a polynomial (times `sign`) within a step, wherever the step ends.
///
/// The samples find the highest cell; only where the parabola through them promises a new peak is the
/// maximum of the series itself looked for.
fn raise(peak: &mut f64, series: &[f64], sign: f64, samples: [f64; 6], duration: f64) {
    let values = samples.map(|value| sign * value);
    let mut top = 0;
    for i in 1..6 {
        if values[i] > values[top] {
            top = i;
        }
    }
    *peak = peak.max(values[top]);
    if top == 0 || top == 5 {
        return;
    }
    let slope = |i: usize| (values[i + 1] - values[i]) / (SAMPLE_TIMES[i + 1] - SAMPLE_TIMES[i]);
    let [before, at, after] = [SAMPLE_TIMES[top - 1], SAMPLE_TIMES[top], SAMPLE_TIMES[top + 1]];
    // Newton's form f(t) = f_top + (t − t_top)(tangent + curvature (t − t_top)).
    let curvature = (slope(top) - slope(top - 1)) / (after - before);
    let tangent = slope(top - 1) + curvature * (at - before);
    if curvature >= 0.0 || values[top] - tangent * tangent / (2.0 * curvature) <= *peak {
        return;
    }
    let mut tau = (at - tangent / (2.0 * curvature)) * duration;
    for _ in 0..PEAK_ITERATIONS {
        let [_, first, second] = horner_with_derivatives(series, tau);
        let next = tau - first / second;
        if !(before * duration..=after * duration).contains(&next) {
            break;
        }
        tau = next;
    }
    *peak = peak.max(sign * horner_with_derivatives(series, tau)[0]);
}

/// The measuring window.
#[derive(Clone, Debug, Default)]
pub struct Window {
    /// Sums of the first and the second half, see [`sum`].
    pub halves: [[f64; sum::WORDS]; 2],
    /// Which half is running.
    pub half: usize,
    /// Largest values, see [`peak`].
    pub peaks: [f64; peak::WORDS],
    /// Events of any kind.
    pub events: u64,
    /// Impacts.
    pub impacts: u64,
    /// Upward zero crossings of `ẋ2`.
    pub crossings: u64,
    /// Time of the first crossing.
    pub first_crossing: f64,
    /// Time of the last crossing.
    pub last_crossing: f64,
    /// `x2` and `y1` at the start of the window: deviations are summed from there, so that a window at
    /// rest far from the equilibrium has no spread at all.
    pub origin: Option<[f64; 2]>,
    previous_velocity: Option<f64>,
}

impl Window {
    fn crossed(&mut self, time: f64) {
        if self.crossings == 0 {
            self.first_crossing = time;
        }
        self.last_crossing = time;
        self.crossings += 1;
    }

    /// What it has reduced, with the growth before it; without the phase, for which it is passed once more.
    #[must_use]
    pub fn reductions(&self, growth: &Growth) -> Reductions {
        Reductions {
            origin: self.origin.unwrap_or_default(),
            halves: self.halves,
            peaks: self.peaks,
            impacts: self.impacts,
            crossings: self.crossings,
            first: self.first_crossing,
            last: self.last_crossing,
            phase: [[0.0; 2]; 2],
            growth: growth.words(),
        }
    }

    fn count_crossings(&mut self, step: &Step) {
        let velocity = step.expansion.tangential_velocity();
        let (before, after) = (velocity[0], step.end.state.velocity[0]);
        if before >= 0.0 && self.previous_velocity.is_some_and(|v| v < 0.0) {
            self.crossed(step.start);
        }
        // Reversed slip and stick are not below the velocity of the belt, which is not below 0, but for a rounding.
        let state = step.expansion.contact.state();
        if matches!(state, ContactState::Slip | ContactState::Free) {
            let velocity = &velocity[..step.expansion.order];
            for tau in upward_crossings(velocity, step.duration, [before < 0.0, after < 0.0]) {
                self.crossed(step.start + tau);
            }
        }
        // What comes down to the velocity of the belt, or sticks, has not gone below it, which matters where that is 0.
        let belt = step.belt.velocity + step.belt.acceleration * step.duration;
        self.previous_velocity = Some(match state {
            ContactState::Reverse => after.max(belt),
            ContactState::Stick => after.max(0.0),
            ContactState::Slip | ContactState::Free => after,
        });
    }
}

impl Observer for Window {
    fn step(&mut self, step: &Step) {
        let samples = SAMPLE_TIMES.map(|fraction| Sample::at(step, fraction));
        let [_, ref nodes @ .., _] = samples;
        let start = samples[0].motion.state.position;
        let origin =
            *self.origin.get_or_insert([start[X2] + step.warmth.base[0], start[Y1] + step.warmth.base[1]]);
        add(&mut self.halves[self.half], step, nodes, origin);
        self.count_crossings(step);
        let (order, duration) = (step.expansion.order, step.duration);
        for (axis, peak) in [(X2, peak::AX), (Y1, peak::AY)] {
            let series = step.expansion.acceleration(axis);
            let values = samples.map(|sample| sample.motion.acceleration[axis]);
            let peak = &mut self.peaks[peak];
            raise(peak, &series[..order - 1], 1.0, values, duration);
            raise(peak, &series[..order - 1], -1.0, values, duration);
        }
        let normal = step.expansion.contact(NORMAL);
        let forces = samples.map(|sample| sample.forces.1);
        raise(&mut self.peaks[peak::NORMAL], &normal[..order - 1], 1.0, forces, duration);
    }

    fn event(&mut self, event: Event) {
        self.events += 1;
        if matches!(event, Event::Impact { .. }) {
            self.impacts += 1;
        }
    }
}

/// Counts the impacts of the whole run that gained energy.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyGains(pub u64);

impl Observer for EnergyGains {
    fn step(&mut self, _step: &Step) {}
    fn event(&mut self, event: Event) {
        self.0 += u64::from(event == Event::Impact { gained_energy: true });
    }
}

/// Sums over the time before the first event, see [`crate::engine::growth`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Growth {
    closed: bool,
    words: [f64; growth::WORDS],
}

impl Growth {
    /// Whether an event has come.
    #[must_use]
    pub fn met_event(&self) -> bool {
        self.closed
    }

    /// Its sums.
    #[must_use]
    pub fn words(&self) -> [f64; growth::WORDS] {
        self.words
    }
}

impl Observer for Growth {
    fn step(&mut self, step: &Step) {
        if self.closed {
            return;
        }
        let Motion { state, acceleration } = step.end;
        let sample = [state.position[0], state.velocity[0], acceleration[0], acceleration[2]];
        self.words[growth::TIME] += step.duration;
        let mut product = growth::PRODUCTS;
        for i in 0..growth::SAMPLED {
            self.words[growth::SAMPLES + i] += step.duration * sample[i];
            for j in i..growth::SAMPLED {
                self.words[product] += step.duration * sample[i] * sample[j];
                product += 1;
            }
        }
    }

    fn event(&mut self, _event: Event) {
        self.closed = true;
    }
}

/// Fourier components of `ẍ2` and `ÿ1` at one frequency between two times: a whole number of cycles,
/// so that the mean and the ends leave no leakage.
#[derive(Clone, Copy, Debug)]
pub struct CyclePhase {
    /// Angular frequency.
    pub angular_frequency: f64,
    /// From this time.
    pub from: f64,
    /// To this time.
    pub to: f64,
    /// Component of `ẍ2`.
    pub x: Complex64,
    /// Component of `ÿ1`.
    pub y: Complex64,
}

impl Observer for CyclePhase {
    fn step(&mut self, step: &Step) {
        let low = (self.from - step.start).clamp(0.0, step.duration);
        let high = (self.to - step.start).clamp(0.0, step.duration);
        if high <= low {
            return;
        }
        for (node, weight) in GAUSS {
            let tau = low + node * (high - low);
            let [ax, _, ay] = step.expansion.motion(tau).acceleration;
            let carrier = Complex64::cis(-self.angular_frequency * (step.start + tau - self.from));
            self.x += weight * (high - low) * ax * carrier;
            self.y += weight * (high - low) * ay * carrier;
        }
    }
}
