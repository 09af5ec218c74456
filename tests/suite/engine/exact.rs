//! The motion without events, exactly: matrix exponentials of the paper's equations.
//!
//! On one contact state and a straight piece of the law the deviations `z = (x2, y1, ẋ2, ẏ1)` from the sliding
//! equilibrium obey `ż = A z`. Its means and mean squares over a window follow from `exp(A t)` and from
//! `∫ exp(A t) z zᵀ exp(Aᵀ t) dt` by doubling, for eigenvalues of any kind, defective ones included. Nothing of the
//! code under test is used: the matrices are written out here, the exponential is nalgebra's.

use nalgebra::{Matrix4, Vector4};
use squealmap::model::Param;
use squealmap::model::instance::Instance;

/// What a window shows of the motion; SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exact {
    pub(crate) x2_std: f64,
    pub(crate) y1_std: f64,
    pub(crate) ax_rms: f64,
    pub(crate) ay_rms: f64,
}

/// `A` for slip against friction `mu` with the slope `slope` (s/m) at the equilibrium.
pub(crate) fn sliding(instance: &Instance, mu: f64, slope: f64) -> Matrix4<f64> {
    let p = |param| instance.params.get(param).expect("a value");
    let (m1, m2) = (p(Param::M1), p(Param::M2));
    let (s, c) = p(Param::Theta).sin_cos();
    let normal = p(Param::FExt) / (c + mu * s);
    // Spring 2 is longer by δ = s x2 − y1, spring 1 by c x2: N = c h − s g − m1 s c ẍ2, T = μ N.
    let rows = |a: f64, b: f64| {
        let (g, h) = ([a * c, 0.0], [b * s, -b]);
        let along = |i: usize| c * g[i] + s * h[i] - mu * (c * h[i] - s * g[i]);
        [along(0), along(1), -h[0], -h[1]]
    };
    let (stiffness, mut damping) = (rows(p(Param::K1), p(Param::K2)), rows(p(Param::C1), p(Param::C2)));
    damping[0] += slope * normal;
    let inertia = m2 + m1 * c * c + mu * m1 * s * c;
    let mass = [inertia, inertia, m1, m1];
    let (k, d) = (|i: usize| -stiffness[i] / mass[i], |i: usize| -damping[i] / mass[i]);
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
        k(0), k(1), d(0), d(1),
        k(2), k(3), d(2), d(3),
    );
    matrix
}

/// The window of length `measure` after `settle` (s) of the motion `ż = A z` from `start`.
pub(crate) fn window(matrix: &Matrix4<f64>, start: Vector4<f64>, settle: f64, measure: f64) -> Exact {
    // In units of time in which A is about 1 the exponential keeps its digits.
    let scale = (matrix[(2, 0)].abs() + matrix[(3, 1)].abs()).sqrt();
    let units = Matrix4::from_diagonal(&Vector4::new(scale, scale, 1.0, 1.0));
    let back = Matrix4::from_diagonal(&Vector4::new(1.0 / scale, 1.0 / scale, 1.0, 1.0));
    let scaled = units * matrix * back / scale;
    let after = flow(&scaled, settle * scale) * units * start;
    let (mean, square) = integrals(&scaled, after, measure * scale);
    let deviation = |i: usize| (square[(i, i)] - mean[i] * mean[i]).max(0.0).sqrt() / scale;
    let rms = |i: usize| {
        let row = scaled.row(i) * scale;
        (row * square * row.transpose())[(0, 0)].max(0.0).sqrt()
    };
    Exact { x2_std: deviation(0), y1_std: deviation(1), ax_rms: rms(2), ay_rms: rms(3) }
}

/// `exp(A t)`: a short step by nalgebra, squared as often as needed.
fn flow(matrix: &Matrix4<f64>, time: f64) -> Matrix4<f64> {
    let halvings = halvings(matrix, time);
    let mut flow = (matrix * (time * 0.5_f64.powi(halvings))).exp();
    for _ in 0..halvings {
        flow *= flow;
    }
    flow
}

/// As often as `time` has to be halved for `A t` to be below 1/16.
fn halvings(matrix: &Matrix4<f64>, time: f64) -> i32 {
    let mut count = 0;
    while matrix.norm() * time * 0.5_f64.powi(count) > 0.0625 {
        count += 1;
    }
    count
}

/// Means over `time` of `z` and of `z zᵀ`.
fn integrals(matrix: &Matrix4<f64>, start: Vector4<f64>, time: f64) -> (Vector4<f64>, Matrix4<f64>) {
    let halvings = halvings(matrix, time);
    let short = time * 0.5_f64.powi(halvings);
    // Gauss's rule of four nodes is exact to (1/16)^9 on so short a step.
    let nodes = [
        (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
        (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
        (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
        (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
    ];
    // The flow's own mean, so that the doubling knows nothing of the start until the end.
    let mut flow = (matrix * short).exp();
    let (mut mean, mut square) = (Matrix4::zeros(), Matrix4::zeros());
    for (node, weight) in nodes {
        let at = (matrix * (short * node)).exp();
        let motion = at * start;
        mean += weight * at;
        square += weight * (motion * motion.transpose());
    }
    for _ in 0..halvings {
        mean = 0.5 * (mean + mean * flow);
        square = 0.5 * (square + flow * square * flow.transpose());
        flow *= flow;
    }
    (mean * start, square)
}

/// The upward zero crossings of `ẋ2` in a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    /// Crossings per time, from the first to the last.
    pub(crate) frequency: f64,
    /// The smallest `|ẋ2|` at an extremum, relative to the largest: how nearly it only touches zero.
    pub(crate) closest: f64,
}

/// Every crossing counts, those included that lie close together around a shallow minimum or maximum.
pub(crate) fn crossings(matrix: &Matrix4<f64>, start: Vector4<f64>, settle: f64, measure: f64) -> Crossings {
    let fastest = matrix.complex_eigenvalues().iter().fold(0.0, |fastest: f64, root| fastest.max(root.im));
    let count = (measure * fastest * 100.0).ceil();
    let length = measure / count;
    let step = flow(matrix, length);
    let velocity = |state: &Vector4<f64>, after: f64| ((matrix * after).exp() * state)[2];
    let root = |state: &Vector4<f64>, mut low: f64, mut high: f64| {
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if velocity(state, middle) < 0.0 { low = middle } else { high = middle }
        }
        low
    };
    let mut state = flow(matrix, settle) * start;
    let (mut moments, mut extrema) = (Vec::new(), Vec::new());
    let mut began = 0.0;
    while began < 0.5_f64.mul_add(-length, measure) {
        let next = step * state;
        let slopes = [&state, &next].map(|z| (matrix.row(2) * z)[(0, 0)]);
        let extremum = length * slopes[0] / (slopes[0] - slopes[1]);
        let between = (slopes[0] * slopes[1] < 0.0).then(|| velocity(&state, extremum));
        extrema.extend(between.map(f64::abs));
        let bracket = match (state[2] < 0.0, next[2] < 0.0, between) {
            (true, false, _) => Some((0.0, length)),
            (false, false, Some(lowest)) if lowest < 0.0 => Some((extremum, length)),
            (true, true, Some(highest)) if highest >= 0.0 => Some((0.0, extremum)),
            _ => None,
        };
        if let Some((low, high)) = bracket {
            moments.push(began + root(&state, low, high));
        }
        state = next;
        began += length;
    }
    let (least, most) = extrema.iter().fold((f64::MAX, 0.0_f64), |(a, b), v| (a.min(*v), b.max(*v)));
    Crossings {
        frequency: (moments.len() - 1) as f64 / (moments[moments.len() - 1] - moments[0]),
        closest: least / most,
    }
}
