//! An instance into a kernel's words, and a lane's records into an outcome (host only).

use std::f64::consts::TAU;

use super::lane::Lane;
use super::observe::SUMS;
use super::scalar::Real;
use super::scene::{FIRST_HALF, Law, SECOND_HALF, SEGMENT_WORDS, SEGMENTS, SETTLE, Scene as Words, words};
use crate::model::friction::LawKind;
use crate::observe::GrowthFit;
use crate::outcome::{Outcome, Status};
use crate::response::{Plan, Scene};
use crate::spec::Instance;

/// The form of the law of an instance.
#[must_use]
pub fn law_of(kind: LawKind) -> Law {
    match kind {
        LawKind::Constant | LawKind::Bilinear | LawKind::Table => Law::Pieces,
        LawKind::Exponential => Law::Exponential,
        LawKind::Rational => Law::Rational,
    }
}

/// The segments of a run: settle and both halves of the window, cut where a ramp ends.
fn segments(scene: &Scene, plan: &Plan) -> [[f64; SEGMENT_WORDS]; SEGMENTS] {
    let half = 0.5 * scene.scaled(plan.measure);
    let parts = [(SETTLE, scene.scaled(plan.settle)), (FIRST_HALF, half), (SECOND_HALF, half)];
    let nominal = TAU / f64::from(plan.steps_per_period);
    let mut segments = [[0.0; SEGMENT_WORDS]; SEGMENTS];
    let mut used = 0;
    let mut time = 0.0;
    for (part, length) in parts {
        let mut rest = length;
        while rest > 0.0 && used < SEGMENTS {
            let (belt, holds) = scene.belt_from(time);
            let duration = rest.min(holds);
            let steps = (duration / nominal).ceil().max(1.0);
            segments[used] = [steps, duration / steps, belt.velocity, belt.acceleration, f64::from(part)];
            used += 1;
            time += duration;
            rest -= duration;
        }
    }
    segments
}

/// The words of an instance for kernels built for `pieces` pieces.
#[must_use]
pub fn instance_words(scene: &Scene, plan: &Plan, pieces: usize) -> Vec<f64> {
    let start = scene.start();
    let start = [start.position[0], start.position[2], start.velocity[0], start.velocity[2]];
    let v0 = scene.belt(0.0).velocity;
    words(&scene.model, &scene.equilibrium, v0, start, &segments(scene, plan), pieces)
}

/// Integrates one instance with the twin of the kernel.
#[must_use]
pub fn respond<S: Real>(instance: &Instance, plan: &Plan, tolerance: f64) -> Outcome {
    let scene = match Scene::new(instance, plan.start) {
        Ok(scene) => scene,
        Err(status) => return Outcome { status, ..Outcome::default() },
    };
    let pieces = scene.model.law.pieces.len();
    let packed = instance_words(&scene, plan, pieces);
    let words: Words<S> = Words::read(law_of(instance.law.kind()), pieces, &packed);
    let mut lane = Lane::new(&words);
    lane.run(&words, S::from_f64(tolerance));
    outcome(&scene, plan, &segments(&scene, plan), &lane)
}

/// The outcome of a finished lane.
#[must_use]
pub fn outcome<S: Real>(
    scene: &Scene,
    plan: &Plan,
    segments: &[[f64; SEGMENT_WORDS]; SEGMENTS],
    lane: &Lane<S>,
) -> Outcome {
    let time = |segment: u32, index: u32, fraction: f64| -> f64 {
        let before: f64 = segments[..(segment as usize).min(SEGMENTS)].iter().map(|s| s[0] * s[1]).sum();
        let step = segments.get(segment as usize).map_or(0.0, |s| s[1]);
        before + (f64::from(index) + fraction) * step
    };
    let units = &scene.units;
    let mut outcome =
        Outcome { status: lane.status, steps: u64::from(lane.iterations), ..Outcome::default() };
    if lane.status != Status::Ok {
        outcome.simulated_time = time(lane.segment, lane.index, 0.0) * units.time;
        return outcome;
    }
    outcome.simulated_time = scene.seconds(time(lane.segment, lane.index, 0.0), plan);
    let half = |k: usize| -> [f64; SUMS] { lane.sums.total[k].map(Real::to_f64) };
    let halves = [half(0), half(1)];
    let all: [f64; SUMS] = std::array::from_fn(|i| halves[0][i] + halves[1][i]);
    let std = |s: &[f64; SUMS], i: usize| (s[i + 1] / s[0] - (s[i] / s[0]).powi(2)).max(0.0).sqrt();
    let rms = |s: &[f64; SUMS], i: usize| (s[i] / s[0]).sqrt();
    let peaks = lane.sums.peaks.map(Real::to_f64);
    outcome.x2_mean = Some(scene.equilibrium.x2 + all[1] / all[0] * units.length);
    outcome.x2_std = Some(std(&all, 1) * units.length);
    outcome.y1_mean = Some(scene.equilibrium.y1 + all[3] / all[0] * units.length);
    outcome.y1_std = Some(std(&all, 3) * units.length);
    outcome.ax_rms = Some(rms(&all, 5) * units.acceleration);
    outcome.ay_rms = Some(rms(&all, 6) * units.acceleration);
    outcome.ax_peak = Some(peaks[0] * units.acceleration);
    outcome.ay_peak = Some(peaks[1] * units.acceleration);
    outcome.friction_mean = (all[9] > 0.0).then(|| all[8] / all[9]);
    outcome.n_peak = Some(peaks[2] * units.force);
    outcome.stick = Some(all[10] / all[0]);
    outcome.free = Some(all[11] / all[0]);
    outcome.reverse = Some(all[12] / all[0]);
    outcome.impacts_per_second = Some(f64::from(lane.sums.impacts) / (all[0] * units.time));
    outcome.speed_rms_halves = halves.map(|s| rms(&s, 7) * units.velocity);
    outcome.x2_std_halves = halves.map(|s| std(&s, 1) * units.length);
    outcome.ay_rms_halves = halves.map(|s| rms(&s, 6) * units.acceleration);
    let moment = |m: &super::observe::Moment<S>| time(m.segment, m.index, m.fraction.to_f64());
    let span = moment(&lane.sums.last) - moment(&lane.sums.first);
    if lane.sums.crossings >= 2 && span > 0.0 {
        outcome.response_frequency = Some(f64::from(lane.sums.crossings - 1) / span / units.time);
        let [x, y] =
            [lane.phase.x, lane.phase.y].map(|z| num_complex::Complex64::new(z[0].to_f64(), z[1].to_f64()));
        let ratio = y / x;
        outcome.phase_cycle = (ratio.is_finite() && ratio.norm_sqr() > 0.0).then(|| ratio.arg().to_degrees());
    }
    if let Some(fit) = growth_fit(&lane.sums.growth.map(Real::to_f64)) {
        outcome.growth_rate_measured = Some(fit.growth_rate / units.time);
        outcome.frequency_measured = Some(fit.angular_frequency / TAU / units.time);
        outcome.phase_measured = fit.phase.map(f64::to_degrees);
    }
    outcome
}

/// The fit of the growth window from its sums.
fn growth_fit(words: &[f64; 15]) -> Option<GrowthFit> {
    let mut product = [[0.0; 5]; 5];
    let mut word = 5;
    for i in 1..5 {
        for j in i..5 {
            product[i][j] = words[word];
            product[j][i] = words[word];
            word += 1;
        }
    }
    let sum = [words[0], words[1], words[2], words[3], words[4]];
    crate::observe::Growth::from_sums(words[0], sum, product).result()
}
