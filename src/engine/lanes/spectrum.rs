//! Fourier components of the window in one pass, at a frequency that is known only at its end.
//!
//! Every lane sums over a stretch `∫ a uᵐ exp(−iω′(t − t_m)) dt`, with a guess `ω′` of the frequency, the
//! middle `t_m` of the stretch and `u = (t − t_m)/T` on `[−1, 1]`. The component at `ω = ω′ + δ` follows from
//! the series of `exp(−iδTu)`: see [`crate::engine::lanes::stretches`]. The sums begin at the first upward crossing of
//! `ẋ2`; the last of the window is their end. They are noted at all that may be the last one, the guess says when:
//! where it was wrong, the window is passed once more.

use std::f64::consts::TAU;

use pulp::Simd;

use crate::engine::lanes::angle::{rotation, turn};
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::motion::SINGLE;
use crate::engine::lanes::nodes::{NODES, WEIGHTS};
use crate::engine::lanes::polynomial::soon_to;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};

/// Powers of `u`.
pub const MOMENTS: usize = 3;
/// Sums of a stretch: by power, then real and imaginary part for `ẍ2` and `ÿ1`.
pub const COMPONENTS: usize = 4 * MOMENTS;

/// Periods of the guess before the end of the window from which crossings are noted.
pub const CLOSING: f64 = 1.5;

/// The sums of the present stretches.
#[derive(Clone, Copy, Debug)]
pub struct Spectrum<S: Simd, T: Scalar<S>> {
    /// The guess.
    pub omega: Vector<S, T>,
    /// `exp(−iω′(t − t_m))`.
    pub carrier: [Vector<S, T>; 2],
    /// `1/T`.
    pub scale: Vector<S, T>,
    /// 1 from the first crossing on.
    pub begun: Vector<S, T>,
    /// The time of the stretch from which crossings are noted.
    pub closing: Vector<S, T>,
    /// 1 when the last crossing has been.
    pub fresh: Vector<S, T>,
    /// Sums up to now.
    pub sums: [Vector<S, T>; COMPONENTS],
    /// Sums up to the last crossing that was noted.
    pub noted: [Vector<S, T>; COMPONENTS],
}

/// `ẍ2` and `ÿ1` at the nodes of a step.
pub type Nodes<S, T> = [[Vector<S, T>; 2]; 3];

/// How many of `x2` and `y1` move.
#[must_use]
pub const fn moving(motion: u8) -> usize {
    if motion == SINGLE { 1 } else { 2 }
}

/// The degree up to which a series counts at a node: what is left out of a motion that turns by 2.35 in the step is below
/// 2e-6 of it at the first two nodes, in shorter steps far less.
#[must_use]
pub const fn seen(highest: usize, node: usize) -> usize {
    let counts = [7, 10, highest][node];
    if counts < highest { counts } else { highest }
}

/// The accelerations at the nodes of the step up to `at`.
#[inline(always)]
pub fn accelerations<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    e: &Expansion<S, T, N>,
    at: Vector<S, T>,
) -> Nodes<S, T> {
    let rate_square = e.rate * e.rate;
    let mut nodes = [[at.like(0.0); 2]; 3];
    for i in 0..3 {
        let t = at * at.like(NODES[i]);
        for j in 0..moving(MOTION) {
            nodes[i][j] = soon_to(&e.a[j], 0, seen(N - 3, i), t) * rate_square;
        }
    }
    nodes
}

/// The sums of a part of a step, and the carrier at its end.
struct Part<S: Simd, T: Scalar<S>> {
    sums: [Vector<S, T>; COMPONENTS],
    carrier: [Vector<S, T>; 2],
}

impl<S: Simd, T: Scalar<S>> Spectrum<S, T> {
    /// Nothing yet.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Spectrum {
            omega: zero,
            carrier: [zero; 2],
            scale: zero,
            begun: zero,
            closing: zero,
            fresh: zero,
            sums: [zero; COMPONENTS],
            noted: [zero; COMPONENTS],
        }
    }

    /// Begins a stretch of a lane, whose crossings count: the window ends `left` behind its beginning.
    #[inline(always)]
    pub fn begin(&mut self, lane: usize, omega: f64, left: f64, begun: bool) {
        self.omega.set(lane, T::from_f64(omega));
        self.begun.set(lane, T::from_f64(f64::from(u8::from(begun))));
        self.closing.set(lane, T::from_f64(left - CLOSING * TAU / omega));
        self.fresh.set(lane, T::ZERO);
    }

    /// Begins its sums, at minus `half` of its middle.
    #[inline(always)]
    pub fn turn_back(&mut self, lane: usize, half: f64) {
        let (sine, cosine) = (self.omega.get(lane).to_f64() * half).sin_cos();
        self.scale.set(lane, T::from_f64(1.0 / half));
        self.carrier[0].set(lane, T::from_f64(cosine));
        self.carrier[1].set(lane, T::from_f64(sine));
        for word in self.sums.iter_mut().chain(&mut self.noted) {
            word.set(lane, T::ZERO);
        }
    }

    /// The sums over the step up to `at`; `time` is that of its begin since the stretch began.
    #[inline(always)]
    fn part<const N: usize, const MOTION: u8>(
        &self,
        e: &Expansion<S, T, N>,
        accelerations: &Nodes<S, T>,
        at: Vector<S, T>,
        time: Vector<S, T>,
    ) -> Part<S, T> {
        let tau = at * e.step;
        let angle = self.omega * tau;
        let outer = rotation(angle * at.like(NODES[0]));
        let inner = rotation(angle * at.like(NODES[1] - NODES[0]));
        let mut carrier = self.carrier;
        let mut sums = [at.like(0.0); COMPONENTS];
        for i in 0..3 {
            carrier = turn(carrier, if i == 0 { outer } else { inner });
            let node = at.like(NODES[i]);
            let weight = tau * at.like(WEIGHTS[i]);
            let [ax, ay] = accelerations[i];
            let (ax, ay) = (ax * weight, ay * weight);
            let u = tau.fma(node, time).fma(self.scale, at.like(-1.0));
            let mut terms = [ax * carrier[0], ax * carrier[1], ay * carrier[0], ay * carrier[1]];
            for m in 0..MOMENTS {
                for j in 0..2 * moving(MOTION) {
                    sums[4 * m + j] += terms[j];
                    if m + 1 < MOMENTS {
                        terms[j] = terms[j] * u;
                    }
                }
            }
        }
        Part { sums, carrier: turn(carrier, outer) }
    }

    /// Notes the sums of some lanes at an upward crossing, which is at `moment` of the step that is about to be added.
    #[inline(always)]
    pub fn note<const N: usize, const MOTION: u8>(
        &mut self,
        e: &Expansion<S, T, N>,
        time: Vector<S, T>,
        crossed: Mask<S, T>,
        moment: Vector<S, T>,
    ) {
        let one = moment.like(1.0);
        if MOTION == SINGLE {
            // What y1 does has no phase.
            self.begun = crossed.select(one, self.begun);
            return;
        }
        let nodes = accelerations::<S, T, N, MOTION>(e, moment);
        let before = self.part::<N, MOTION>(e, &nodes, moment, time).sums;
        let zero = moment.like(0.0);
        let begun = zero.less(self.begun);
        for i in 0..COMPONENTS {
            let reached = self.sums[i] + before[i];
            let noted = crossed.select(reached.only(begun), self.noted[i]);
            self.noted[i].put(noted);
            // The first crossing: what comes before it in the step does not count.
            let sum = begun.select(self.sums[i], (zero - before[i]).only(crossed));
            self.sums[i].put(sum);
        }
        self.begun = crossed.select(one, self.begun);
    }

    /// Adds a step up to `at`, whose crossings have been noted.
    #[inline(always)]
    pub fn observe<const N: usize, const MOTION: u8>(
        &mut self,
        e: &Expansion<S, T, N>,
        nodes: &Nodes<S, T>,
        at: Vector<S, T>,
        time: Vector<S, T>,
    ) {
        let whole = self.part::<N, MOTION>(e, nodes, at, time);
        let begun = at.like(0.0).less(self.begun);
        for i in 0..COMPONENTS {
            self.sums[i] += whole.sums[i].only(begun);
        }
        self.carrier = whole.carrier;
    }
}
