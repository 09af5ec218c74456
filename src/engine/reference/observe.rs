//! Running reductions of one trajectory, in scaled units.
//!
//! Integrals over a step use Gauss–Legendre nodes on its series, so that means are as accurate as the
//! method whatever the step; nothing is stored.

use crate::engine::method::roots::upward_crossings;
use crate::engine::method::taylor::{Motion, NORMAL, X2, Y1, horner_with_derivatives};
use crate::engine::reference::integrate::{Event, Observer, Step};
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

/// Time-weighted sums over half of the measuring window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// Time.
    pub time: f64,
    /// `∫x2`, from the window's origin.
    pub x: f64,
    /// `∫x2²`.
    pub xx: f64,
    /// `∫y1`, from the window's origin.
    pub y: f64,
    /// `∫y1²`.
    pub yy: f64,
    /// `∫ẍ2²`.
    pub ax: f64,
    /// `∫ÿ1²`.
    pub ay: f64,
    /// `∫(ẋ2² + ẏ1²)`.
    pub speed: f64,
    /// `∫T`.
    pub tangential: f64,
    /// `∫N`.
    pub normal: f64,
    /// Time in stick.
    pub stick: f64,
    /// Time in free flight.
    pub free: f64,
    /// Time in reversed slip.
    pub reverse: f64,
}

impl Sums {
    /// Both halves together.
    #[must_use]
    pub fn plus(self, other: Sums) -> Sums {
        Sums {
            time: self.time + other.time,
            x: self.x + other.x,
            xx: self.xx + other.xx,
            y: self.y + other.y,
            yy: self.yy + other.yy,
            ax: self.ax + other.ax,
            ay: self.ay + other.ay,
            speed: self.speed + other.speed,
            tangential: self.tangential + other.tangential,
            normal: self.normal + other.normal,
            stick: self.stick + other.stick,
            free: self.free + other.free,
            reverse: self.reverse + other.reverse,
        }
    }

    /// Standard deviation of `x2`.
    #[must_use]
    pub fn x_std(&self) -> f64 {
        deviation(self.x / self.time, self.xx / self.time)
    }

    /// Standard deviation of `y1`.
    #[must_use]
    pub fn y_std(&self) -> f64 {
        deviation(self.y / self.time, self.yy / self.time)
    }

    fn add(&mut self, step: &Step, nodes: &[Sample; 4], origin: [f64; 2]) {
        let duration = step.duration;
        self.time += duration;
        match step.expansion.contact.state() {
            ContactState::Slip => {}
            ContactState::Reverse => self.reverse += duration,
            ContactState::Stick => self.stick += duration,
            ContactState::Free => self.free += duration,
        }
        for ((_, weight), sample) in GAUSS.iter().zip(nodes) {
            let weight = weight * duration;
            let Motion { state, acceleration: [ax, _, ay] } = sample.motion;
            let (x, y) = (state.position[X2] - origin[0], state.position[Y1] - origin[1]);
            let [vx, _, vy] = state.velocity;
            self.x += weight * x;
            self.xx += weight * x * x;
            self.y += weight * y;
            self.yy += weight * y * y;
            self.ax += weight * ax * ax;
            self.ay += weight * ay * ay;
            self.speed += weight * (vx * vx + vy * vy);
            self.tangential += weight * sample.forces.0;
            self.normal += weight * sample.forces.1;
        }
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

fn deviation(mean: f64, mean_square: f64) -> f64 {
    (mean_square - mean * mean).max(0.0).sqrt()
}

/// The measuring window.
#[derive(Clone, Debug, Default)]
pub struct Window {
    /// Sums of the first and the second half.
    pub halves: [Sums; 2],
    /// Which half is running.
    pub half: usize,
    /// Largest `|ẍ2|`.
    pub ax_peak: f64,
    /// Largest `|ÿ1|`.
    pub ay_peak: f64,
    /// Largest `N`.
    pub n_peak: f64,
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

    /// Crossings per time from the first to the last.
    #[must_use]
    pub fn response_frequency(&self) -> Option<f64> {
        let span = self.last_crossing - self.first_crossing;
        (self.crossings >= 2 && span > 0.0).then(|| (self.crossings - 1) as f64 / span)
    }

    fn count_crossings(&mut self, step: &Step) {
        let velocity = step.expansion.tangential_velocity();
        let (before, after) = (velocity[0], step.end.state.velocity[0]);
        if before >= 0.0 && self.previous_velocity.is_some_and(|v| v < 0.0) {
            self.crossed(step.start);
        }
        for tau in
            upward_crossings(&velocity[..step.expansion.order], step.duration, [before < 0.0, after < 0.0])
        {
            self.crossed(step.start + tau);
        }
        // What comes down to the velocity of the belt has not gone below it, which matters where that is 0.
        let reverse = step.expansion.contact.state() == ContactState::Reverse;
        let belt = step.belt.velocity + step.belt.acceleration * step.duration;
        self.previous_velocity = Some(if reverse { after.max(belt) } else { after });
    }
}

impl Observer for Window {
    fn step(&mut self, step: &Step) {
        let samples = SAMPLE_TIMES.map(|fraction| Sample::at(step, fraction));
        let [_, ref nodes @ .., _] = samples;
        let start = samples[0].motion.state.position;
        let origin = *self.origin.get_or_insert([start[X2], start[Y1]]);
        self.halves[self.half].add(step, nodes, origin);
        self.count_crossings(step);
        let (order, duration) = (step.expansion.order, step.duration);
        for (axis, peak) in [(X2, &mut self.ax_peak), (Y1, &mut self.ay_peak)] {
            let series = step.expansion.acceleration(axis);
            let values = samples.map(|sample| sample.motion.acceleration[axis]);
            raise(peak, &series[..order - 1], 1.0, values, duration);
            raise(peak, &series[..order - 1], -1.0, values, duration);
        }
        let normal = step.expansion.contact(NORMAL);
        raise(&mut self.n_peak, &normal[..order - 1], 1.0, samples.map(|sample| sample.forces.1), duration);
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

/// A growth window shorter than this many periods `2π/ω0` says nothing.
pub const SHORTEST_GROWTH_WINDOW: f64 = 1.0;

/// Least squares on the samples before the first event, means removed:
///
/// ```text
/// ẍ2 = 2σ ẋ2 − |λ|² (x2 − x2_eq)        ÿ1 = α ẍ2 + β ẋ2        φ = arg(α + β/λ)
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Growth {
    closed: bool,
    time: f64,
    /// Sums of 1, x, v, a, b (= ÿ1) and of their products, each weighted by the length of the step.
    sum: [f64; 5],
    product: [[f64; 5]; 5],
}

/// The growth as measured in its window, in scaled units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthFit {
    /// Real part of the eigenvalue.
    pub growth_rate: f64,
    /// Imaginary part of the eigenvalue.
    pub angular_frequency: f64,
    /// Phase of `ÿ1` against `ẍ2`, rad; `None` when `y1` does not follow.
    pub phase: Option<f64>,
}

impl Growth {
    /// A window summed elsewhere: its length, the sums of `1, x, v, a, b` and of their products.
    #[must_use]
    pub fn from_sums(time: f64, sum: [f64; 5], product: [[f64; 5]; 5]) -> Growth {
        Growth { closed: true, time, sum, product }
    }

    /// Whether an event has come.
    #[must_use]
    pub fn met_event(&self) -> bool {
        self.closed
    }

    /// Covariance of two samples.
    fn covariance(&self, i: usize, j: usize) -> f64 {
        self.product[i][j] / self.time - self.sum[i] / self.time * (self.sum[j] / self.time)
    }

    /// Solves `target = p u + q v` in the least-squares sense.
    fn fit(&self, target: usize, u: usize, v: usize) -> Option<(f64, f64)> {
        let (uu, uv, vv) = (self.covariance(u, u), self.covariance(u, v), self.covariance(v, v));
        let (ut, vt) = (self.covariance(u, target), self.covariance(v, target));
        let det = uu * vv - uv * uv;
        let (p, q) = ((ut * vv - vt * uv) / det, (vt * uu - ut * uv) / det);
        (det > 0.0 && p.is_finite() && q.is_finite()).then_some((p, q))
    }

    /// The fit, when the window is long enough and oscillates.
    #[must_use]
    pub fn result(&self) -> Option<GrowthFit> {
        const X: usize = 1;
        const V: usize = 2;
        const A: usize = 3;
        const B: usize = 4;
        if self.time < SHORTEST_GROWTH_WINDOW * std::f64::consts::TAU {
            return None;
        }
        let (twice_growth, stiffness) = self.fit(A, V, X)?;
        let growth_rate = 0.5 * twice_growth;
        let square = -stiffness - growth_rate * growth_rate;
        if !(square > 0.0 && square.is_finite() && growth_rate.is_finite()) {
            return None;
        }
        let angular_frequency = square.sqrt();
        let phase = self
            .fit(B, A, V)
            .map(|(alpha, beta)| (alpha + beta / Complex64::new(growth_rate, angular_frequency)).arg())
            .filter(|phase| phase.is_finite());
        let follows = self.covariance(B, B) > 0.0;
        Some(GrowthFit { growth_rate, angular_frequency, phase: phase.filter(|_| follows) })
    }
}

impl Observer for Growth {
    fn step(&mut self, step: &Step) {
        if self.closed {
            return;
        }
        let Motion { state, acceleration } = step.end;
        let sample = [1.0, state.position[0], state.velocity[0], acceleration[0], acceleration[2]];
        self.time += step.duration;
        for i in 0..5 {
            self.sum[i] += step.duration * sample[i];
            for j in i..5 {
                self.product[i][j] += step.duration * sample[i] * sample[j];
                self.product[j][i] = self.product[i][j];
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
