//! The first event in the lanes of the CPU engine against a dense search of the same series: lift-off, and which end of
//! its piece of the law the sliding speed leaves first.

use pulp::{Arch, Simd, WithSimd};

use crate::engine::first_events::{Body, N, job, steps};
use crate::instances::Uniform;
use squealmap::engine::lanes::block::{FIRST, LOWER, SECOND, THIRD, UPPER};
use squealmap::engine::lanes::constants::LONGEST;
use squealmap::engine::lanes::contact::NOTHING;
use squealmap::engine::lanes::contact::{REVERSE, SLIP};

/// Samples of the dense search.
const DENSE: usize = 1000;

/// Bound on the truncation of a step, the coarsest of the engine.
const TOLERANCE: f64 = 1e-3;

/// The series of a step as the lanes have them, and the event they find.
struct Made {
    normal: [f64; N],
    /// The sliding speed times the step.
    speed: [f64; N],
    /// Both ends of the piece, times the step.
    ends: [f64; 2],
    /// How far the series are good.
    until: f64,
    at: f64,
    event: u32,
}

struct InLanes<'a> {
    bodies: &'a [Body],
    made: Vec<Made>,
}

impl WithSimd for &mut InLanes<'_> {
    type Output = ();
    fn with_simd<S: Simd>(self, simd: S) {
        steps(simd, self.bodies, TOLERANCE, |made, bodies| {
            for (lane, body) in bodies.iter().enumerate() {
                let step = made.e.step.get(lane);
                let sign = if body.job.state.contact == SLIP { 1.0 } else { -1.0 };
                let mut speed = [0.0; N];
                for (k, coefficient) in speed.iter_mut().enumerate().take(N - 1) {
                    *coefficient = -sign * made.e.v[0][k + 1].get(lane);
                }
                speed[0] += sign * body.belt * step;
                let end = |word: usize| made.block.piece[word].get(lane) * step;
                let mut normal = [0.0; N];
                for (force, series) in normal.iter_mut().zip(&made.normal).take(N - 2) {
                    *force = series.get(lane);
                }
                let ends = [end(LOWER), end(UPPER)];
                let (at, event) = made.event(lane);
                self.made.push(Made { normal, speed, ends, until: made.until.get(lane), at, event });
            }
        });
    }
}

/// Bodies that slide on either piece of a bilinear law, some of which have just come onto it.
fn bodies() -> Vec<Body> {
    let mut u = Uniform(31);
    let mut bodies = Vec::new();
    while bodies.len() < 4000 {
        let Some(mut job) = job(&mut u, TOLERANCE) else { continue };
        let Some(knee) = job.scene.model.law.kinks.first().copied() else { continue };
        let (piece, sign) = (u32::from(u.next() < 0.3), if u.next() < 0.8 { 1.0 } else { -1.0 });
        // In a third of them the speed is that of an end of its piece.
        let (kind, inside) = (u.next(), u.next());
        let (speed, disarmed) = match piece {
            _ if kind < 0.16 => (knee * f64::from(piece), SECOND),
            0 if kind < 0.33 => (knee, THIRD),
            0 => (knee * inside, 0),
            _ => (knee * (1.0 + 2.0 * inside), 0),
        };
        let belt = 2.0 * u.next();
        let mut around = || 3.0 * (2.0 * u.next() - 1.0);
        job.state.contact = if sign > 0.0 { SLIP } else { REVERSE };
        (job.state.piece, job.state.disarmed) = (piece, NOTHING);
        job.state.body.p = [around(), 0.0, around()];
        job.state.body.v = [belt - sign * speed, 0.0, around()];
        // No longer than the engine's are.
        let longest = job.constants[LONGEST + usize::from(sign < 0.0)];
        let step = longest.min(0.3 + 2.1 * u.next());
        bodies.push(Body { job, belt, drive: 0.0, step, disarmed });
    }
    bodies
}

fn value(series: &[f64; N], t: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| sum.mul_add(t, *c))
}

/// Where a function is first no longer positive, `None` if it never is; `Err` where a dense search cannot tell: by a hair.
fn fall(function: impl Fn(f64) -> f64, begins: bool) -> Result<Option<f64>, ()> {
    let place = |i: usize| i as f64 / DENSE as f64;
    let values: Vec<f64> = (0..=DENSE).map(|i| function(place(i))).collect();
    let first = usize::from(begins);
    // One that begins at zero may be held there by the tolerance.
    if values[first].abs() < if begins { 1e-5 } else { 1e-6 } {
        return Err(());
    }
    let Some(i) = (first..values.len()).find(|i| values[*i] <= 0.0) else {
        // What begins at zero is near it for a while.
        let lowest =
            values[if begins { 50 } else { 0 }..].iter().fold(f64::INFINITY, |low, value| low.min(*value));
        return if lowest < 1e-4 { Err(()) } else { Ok(None) };
    };
    if i == first {
        return Ok(Some(0.0));
    }
    let deepest = values[i..].iter().fold(0.0_f64, |low, value| low.min(*value));
    let (mut low, mut high) = (place(i - 1), place(i));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { low = middle } else { high = middle }
    }
    if deepest > -2e-4 { Err(()) } else { Ok(Some(high)) }
}

/// The first place at which one of the three functions is no longer positive, and which; `None` for no event, `Err` where
/// a dense search cannot tell.
fn expected(made: &Made, disarmed: u32) -> Result<Option<(f64, u32)>, ()> {
    let scale = made.speed.iter().map(|c| c.abs()).sum::<f64>();
    let heavy = made.normal.iter().map(|c| c.abs()).sum::<f64>();
    let mut first: Option<(f64, u32)> = None;
    for code in [FIRST, SECOND, THIRD] {
        let function = |t: f64| match code {
            FIRST => value(&made.normal, t) / heavy,
            SECOND => (value(&made.speed, t) - made.ends[0]) / scale,
            _ => (made.ends[1] - value(&made.speed, t)) / scale,
        };
        if code == FIRST && function(0.0) <= 0.0 && function(0.0) > -10.0 * TOLERANCE {
            // A force that may be zero.
            return Err(());
        }
        let Some(t) = fall(function, code == disarmed)? else { continue };
        if first.is_some_and(|(other, _)| (other - t).abs() < 3e-3) {
            return Err(());
        }
        if first.is_none_or(|(other, _)| t < other) {
            first = Some((t, code));
        }
    }
    Ok(first)
}

/// How many lanes differ, and what has been seen: nothing, lift-off, lower end, upper end, undecided, both ends left.
fn differ(planted: impl Fn(&mut Made)) -> (usize, [usize; 6]) {
    let bodies = bodies();
    let mut lanes = InLanes { bodies: &bodies, made: Vec::new() };
    Arch::new().dispatch(&mut lanes);
    let (mut different, mut seen) = (0, [0; 6]);
    for (body, mut made) in bodies.iter().zip(lanes.made) {
        planted(&mut made);
        // What lies beyond the end is looked for again.
        let (at, event) = match expected(&made, body.disarmed) {
            Ok(Some((at, _))) if at > made.until => (1.0, 0),
            Ok(first) => first.unwrap_or((1.0, 0)),
            Err(()) => {
                seen[4] += 1;
                continue;
            }
        };
        if made.at > made.until {
            (made.at, made.event) = (1.0, 0);
        }
        seen[event as usize] += 1;
        let outside = |code: u32| {
            (1..=DENSE).any(|i| {
                let speed = value(&made.speed, i as f64 / DENSE as f64);
                if code == SECOND { speed < made.ends[0] } else { speed > made.ends[1] }
            })
        };
        seen[5] += usize::from(event >= SECOND && outside(SECOND) && outside(THIRD));
        different += usize::from(made.event != event || (made.at - at).abs() > 1e-6);
    }
    (different, seen)
}

#[test]
fn the_first_event_is_that_of_a_dense_search() {
    let (different, seen) = differ(|_| {});
    assert!(seen[..4].iter().chain(&seen[5..]).all(|count| *count > 50) && seen[4] < 400, "{seen:?}");
    assert_eq!(different, 0, "{seen:?}");
}

#[test]
fn a_wrong_event_is_seen() {
    // Planted faults: the upper end of the piece elsewhere, its two ends taken for each other, an event that is late.
    let end = |made: &mut Made| made.ends[1] *= 1.001;
    let swapped = |made: &mut Made| made.event = [0, FIRST, THIRD, SECOND][made.event as usize];
    let late = |made: &mut Made| made.at += if made.event == 0 { 0.0 } else { 1e-5 };
    for planted in [&end as &dyn Fn(&mut Made), &swapped, &late] {
        assert!(differ(planted).0 > 100);
    }
}
