//! Twin: shaders/observe.wgsl
//!
//! Running reductions of one lane, as [`crate::engine::reference::observe`] makes them.

#![expect(clippy::too_many_arguments, reason = "the arguments are those of the WGSL twin")]

use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{FIRST_HALF, SEGMENTS, Scene, Segment};
use crate::engine::kernel::series::{Expansion, FREE, REVERSE, STICK, evaluate, value};
use crate::engine::sums::{growth, peak, sum};

/// Nodes of the three-point Gauss–Legendre rule on `[0, 1]`.
pub const NODES: [f64; 3] = [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7];
/// Its weights.
pub const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

/// Samples of a step: its start, the nodes, its end.
pub const STEP_SAMPLES: usize = NODES.len() + 2;

/// Terms of the series of sine and cosine.
pub const ROTATION_TERMS: usize = 7;

/// A time on the grid of steps: segment, whole steps of it, fraction of the next.
#[derive(Clone, Copy, Debug)]
pub struct Moment<S> {
    /// Segment.
    pub segment: u32,
    /// Whole steps.
    pub index: u32,
    /// Fraction of a step.
    pub fraction: S,
}

impl<S: Real> Moment<S> {
    /// The beginning of the run.
    #[must_use]
    pub fn start() -> Self {
        Moment { segment: 0, index: 0, fraction: S::ZERO }
    }
}

/// Reductions of the window and of the time before the first event.
#[derive(Clone, Debug)]
pub struct Sums<S> {
    /// Sums since the last flush: short sums keep their digits in f32.
    pub block: [S; sum::WORDS],
    /// Sums of both halves.
    pub total: [[S; sum::WORDS]; 2],
    /// The half the block belongs to.
    pub half: u32,
    /// Largest values, see [`peak`].
    pub peaks: [S; peak::WORDS],
    /// `ẋ2` at the end of the last step of the window.
    pub previous: S,
    /// Whether there is such a step.
    pub has_previous: bool,
    /// Impacts in the window.
    pub impacts: u32,
    /// Upward crossings of `ẋ2`.
    pub crossings: u32,
    /// The first crossing.
    pub first: Moment<S>,
    /// The last crossing.
    pub last: Moment<S>,
    /// Whether the first event has come.
    pub growth_closed: bool,
    /// Sums before the first event, see [`growth`].
    pub growth: [S; growth::WORDS],
}

impl<S: Real> Sums<S> {
    /// Nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Sums {
            block: [S::ZERO; sum::WORDS],
            total: [[S::ZERO; sum::WORDS]; 2],
            half: 0,
            peaks: [S::ZERO; peak::WORDS],
            previous: S::ZERO,
            has_previous: false,
            impacts: 0,
            crossings: 0,
            first: Moment::start(),
            last: Moment::start(),
            growth_closed: false,
            growth: [S::ZERO; growth::WORDS],
        }
    }

    /// Adds the block to its half.
    pub fn flush(&mut self) {
        for i in 0..sum::WORDS {
            self.total[self.half as usize][i] += self.block[i];
            self.block[i] = S::ZERO;
        }
    }

    /// Counts an impact in the window.
    pub fn count_impact(&mut self) {
        self.impacts += 1;
    }

    /// The first event ends the growth window.
    pub fn close_growth(&mut self) {
        self.growth_closed = true;
    }

    /// Adds a step of the window that begins at `at`; positions count from `origin`, where the window began: a
    /// deviation around a mean far from the equilibrium would be lost in the squares.
    pub fn observe_window(
        &mut self,
        e: &Expansion<S>,
        origin: [S; 2],
        t0: S,
        contact: u32,
        part: u32,
        at: Moment<S>,
        step: S,
        tau: S,
    ) {
        self.half = u32::from(part != FIRST_HALF);
        self.block[sum::TIME] += tau;
        if contact == STICK {
            self.block[sum::STICK] += tau;
        } else if contact == FREE {
            self.block[sum::FREE] += tau;
        } else if contact == REVERSE {
            self.block[sum::REVERSE] += tau;
        }
        let closed = if contact == FREE { S::ZERO } else { t0 };
        let mut ax = [S::ZERO; STEP_SAMPLES];
        let mut ay = [S::ZERO; STEP_SAMPLES];
        let mut normal = [S::ZERO; STEP_SAMPLES];
        let mut velocity = [S::ZERO; STEP_SAMPLES];
        let mut acceleration = [S::ZERO; STEP_SAMPLES];
        for i in 0..STEP_SAMPLES {
            let t = S::from_f64(SAMPLE_TIMES[i]) * tau;
            let (x, w) = (evaluate(&e.x, t), evaluate(&e.w, t));
            velocity[i] = x[1];
            acceleration[i] = x[2];
            ax[i] = x[2].abs();
            ay[i] = w[2].abs();
            normal[i] = value(&e.n, t);
            if i > 0 && i < STEP_SAMPLES - 1 {
                let weight = S::from_f64(WEIGHTS[i - 1]) * tau;
                let dx = x[0] - origin[0];
                let dw = w[0] - origin[1];
                self.block[sum::X] += weight * dx;
                self.block[sum::XX] += weight * (dx * dx);
                self.block[sum::Y] += weight * dw;
                self.block[sum::YY] += weight * (dw * dw);
                self.block[sum::AX] += weight * (x[2] * x[2]);
                self.block[sum::AY] += weight * (w[2] * w[2]);
                self.block[sum::SPEED] += weight * (x[1] * x[1] + w[1] * w[1]);
                self.block[sum::TANGENTIAL] += weight * (value(&e.t, t) + closed);
                self.block[sum::NORMAL] += weight * normal[i];
            }
        }
        self.peaks[peak::AX] = self.peaks[peak::AX].max(maximum(&ax));
        self.peaks[peak::AY] = self.peaks[peak::AY].max(maximum(&ay));
        self.peaks[peak::NORMAL] = self.peaks[peak::NORMAL].max(maximum(&normal));
        self.cross_upwards(e, &velocity, &acceleration, at, step, tau);
    }

    /// Notes the upward crossings of `ẋ2`: a jump to the first sample, rises from one sample to the next, and those
    /// on one side of an extremum that reaches over zero between two samples of the same sign.
    fn cross_upwards(
        &mut self,
        e: &Expansion<S>,
        velocity: &[S; STEP_SAMPLES],
        acceleration: &[S; STEP_SAMPLES],
        at: Moment<S>,
        step: S,
        tau: S,
    ) {
        if self.has_previous && self.previous < S::ZERO && velocity[0] >= S::ZERO {
            self.note(at);
        }
        for i in 0..STEP_SAMPLES - 1 {
            let mut low = S::from_f64(SAMPLE_TIMES[i]) * tau;
            let mut high = S::from_f64(SAMPLE_TIMES[i + 1]) * tau;
            let below = velocity[i] < S::ZERO;
            if below == (velocity[i + 1] < S::ZERO) {
                let (before, after) = (acceleration[i], acceleration[i + 1]);
                let rises = before > S::ZERO && after < S::ZERO;
                let falls = before < S::ZERO && after > S::ZERO;
                if !((below && rises) || (!below && falls)) {
                    continue;
                }
                let extremum = turn(e, low, high, below);
                if (evaluate(&e.x, extremum)[1] < S::ZERO) == below {
                    continue;
                }
                if below {
                    high = extremum;
                } else {
                    low = extremum;
                }
            } else if !below {
                continue;
            }
            // Bisection: the crossing of a monotone piece, to the last bits of f32.
            for _ in 0..BISECTIONS {
                let middle = S::from_f64(0.5) * (low + high);
                if evaluate(&e.x, middle)[1] < S::ZERO {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            self.note(Moment { fraction: at.fraction + high / step, ..at });
        }
        self.previous = velocity[STEP_SAMPLES - 1];
        self.has_previous = true;
    }

    /// Notes one upward crossing.
    fn note(&mut self, moment: Moment<S>) {
        if self.crossings == 0 {
            self.first = moment;
        }
        self.last = moment;
        self.crossings += 1;
    }

    /// Adds a step before the first event.
    pub fn observe_growth(&mut self, e: &Expansion<S>, tau: S) {
        if self.growth_closed {
            return;
        }
        let (x, w) = (evaluate(&e.x, tau), evaluate(&e.w, tau));
        let sample = [x[0], x[1], x[2], w[2]];
        self.growth[growth::TIME] += tau;
        let mut word = growth::PRODUCTS;
        for i in 0..growth::SAMPLED {
            self.growth[growth::SAMPLES + i] += tau * sample[i];
            for j in i..growth::SAMPLED {
                self.growth[word] += tau * (sample[i] * sample[j]);
                word += 1;
            }
        }
    }
}

impl<S: Real> Default for Sums<S> {
    fn default() -> Self {
        Sums::new()
    }
}

/// Bisections of a crossing.
pub const BISECTIONS: usize = 24;

/// Where `ẍ2`, positive first or negative first, changes its sign.
fn turn<S: Real>(e: &Expansion<S>, from: S, to: S, positive: bool) -> S {
    let mut low = from;
    let mut high = to;
    for _ in 0..BISECTIONS {
        let middle = S::from_f64(0.5) * (low + high);
        if (evaluate(&e.x, middle)[2] > S::ZERO) == positive {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Times of the samples of a step: its start, the nodes, its end.
pub const SAMPLE_TIMES: [f64; STEP_SAMPLES] = [0.0, NODES[0], NODES[1], NODES[2], 1.0];

/// The maximum of a smooth function from its samples, as [`crate::engine::reference::observe`] finds it.
pub fn maximum<S: Real>(values: &[S; STEP_SAMPLES]) -> S {
    let mut top = 0;
    for i in 1..STEP_SAMPLES {
        if values[i] > values[top] {
            top = i;
        }
    }
    if top == 0 || top == STEP_SAMPLES - 1 {
        return values[top];
    }
    let time = |i: usize| S::from_f64(SAMPLE_TIMES[i]);
    let left = (values[top] - values[top - 1]) / (time(top) - time(top - 1));
    let right = (values[top + 1] - values[top]) / (time(top + 1) - time(top));
    let curvature = (right - left) / (time(top + 1) - time(top - 1));
    let tangent = left + curvature * (time(top) - time(top - 1));
    if curvature < S::ZERO {
        values[top] - tangent * tangent / (S::from_f64(4.0) * curvature)
    } else {
        values[top]
    }
}

/// The second pass over the window: Fourier components at the response frequency.
#[derive(Clone, Debug)]
pub struct Phase<S> {
    /// Angular frequency.
    pub omega: S,
    /// `exp(−iω(t − t_first))`, real and imaginary part.
    pub carrier: [S; 2],
    /// Component of `ẍ2`.
    pub x: [S; 2],
    /// Component of `ÿ1`.
    pub y: [S; 2],
}

impl<S: Real> Phase<S> {
    /// Nothing yet.
    #[must_use]
    pub fn new() -> Self {
        let zero = [S::ZERO; 2];
        Phase { omega: S::ZERO, carrier: [S::ONE, S::ZERO], x: zero, y: zero }
    }

    /// Sets the frequency; false when there is none.
    pub fn prepare_phase(&mut self, scene: &Scene<S>, sums: &Sums<S>) -> bool {
        if sums.crossings < 2 {
            return false;
        }
        let span = since_start(scene, &sums.last) - since_start(scene, &sums.first);
        if span <= S::ZERO {
            return false;
        }
        self.omega = S::from_f64(std::f64::consts::TAU) * S::from_f64(f64::from(sums.crossings - 1)) / span;
        true
    }

    /// Adds the part of a step between the first and the last crossing.
    pub fn observe_phase(&mut self, e: &Expansion<S>, sums: &Sums<S>, at: Moment<S>, step: S, tau: S) {
        let (low, high) = (clipped(&sums.first, &at, step, tau), clipped(&sums.last, &at, step, tau));
        let span = high - low;
        if span <= S::ZERO {
            return;
        }
        for i in 0..NODES.len() {
            let along = S::from_f64(NODES[i]) * span;
            let weight = S::from_f64(WEIGHTS[i]) * span;
            let [c, s] = rotate(self.carrier, self.omega * along);
            let ax = evaluate(&e.x, low + along)[2] * weight;
            let ay = evaluate(&e.w, low + along)[2] * weight;
            self.x[0] += ax * c;
            self.x[1] += ax * s;
            self.y[0] += ay * c;
            self.y[1] += ay * s;
        }
        self.carrier = rotate(self.carrier, self.omega * span);
    }
}

impl<S: Real> Default for Phase<S> {
    fn default() -> Self {
        Phase::new()
    }
}

/// The time of a moment within the step that begins at `at`, clipped to the step.
fn clipped<S: Real>(moment: &Moment<S>, at: &Moment<S>, step: S, tau: S) -> S {
    if moment.segment < at.segment || (moment.segment == at.segment && moment.index < at.index) {
        return S::ZERO;
    }
    if moment.segment > at.segment || moment.index > at.index {
        return tau;
    }
    ((moment.fraction - at.fraction) * step).max(S::ZERO).min(tau)
}

/// The time of a moment since the start of the run.
fn since_start<S: Real>(scene: &Scene<S>, moment: &Moment<S>) -> S {
    let mut time = S::ZERO;
    for i in 0..SEGMENTS {
        let segment: &Segment<S> = &scene.segments[i];
        let index = S::from_f64(i as f64);
        let reached = S::from_f64(f64::from(moment.segment));
        if index < reached {
            time += segment.steps * segment.step;
        } else if index <= reached {
            time += (S::from_f64(f64::from(moment.index)) + moment.fraction) * segment.step;
        }
    }
    time
}

/// `z exp(−iφ)` for `|φ| ≤ π/2`, kept at length 1.
pub fn rotate<S: Real>([c, s]: [S; 2], angle: S) -> [S; 2] {
    let square = angle * angle;
    let mut cosine = S::ONE;
    let mut sine = S::ONE;
    for k in (1..=ROTATION_TERMS).rev() {
        let n = (2 * k) as f64;
        cosine = S::ONE - square * cosine / S::from_f64(n * (n - 1.0));
        sine = S::ONE - square * sine / S::from_f64(n * (n + 1.0));
    }
    sine *= angle;
    let re = c * cosine + s * sine;
    let im = s * cosine - c * sine;
    let length = S::from_f64(1.5) - S::from_f64(0.5) * (re * re + im * im);
    [re * length, im * length]
}
