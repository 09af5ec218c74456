//! A run until it is settled: windows of whole cycles, one after another, until nothing changes any more.
//!
//! A window that ends within a cycle mixes the phase of its ends into its sums; one that is shorter than the beat
//! of the two modes compares different parts of it. The halves of a window are therefore whole cycles of the
//! motion as the window before has seen it, and not shorter than the beat.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::engine::kinks;
use crate::engine::outcome::{Ending, Outcome};
use crate::engine::plan::Plan;
use crate::engine::regime::{self, Regime};
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::kind::InstabilityType;
use crate::model::{Param, linear};

/// The longest half of a window, in the halves that were asked for: near coalescence the beat is endless.
const LONGEST_HALF: f64 = 4.0;

/// The shortest half, periods: a window of less than some cycles compares nothing.
const SHORTEST_HALF: f64 = 8.0;

/// A mode decays when its real part is below this fraction of its eigenvalue; what decays more slowly goes on for
/// longer than anybody waits.
const DECAYS_BELOW: f64 = -1e-6;

/// A decay without any event is left to its eigenvalues after this many time constants, or after a beat.
const TIME_CONSTANTS: f64 = 3.0;

/// The part of a small speed ([`regime::small_speed`]) below which nothing moves across the belt.
const UNMOVED: f64 = 1e-6;

/// A motion has settled when the deviation of `x2` and the rms of `ÿ1` in three halves in a row agree within this fraction,
/// and no more than that is still to come. It is half of what [`regime::THRESHOLDS`] asks of one window.
pub const AGREE: f64 = 0.005;

/// A change of this fraction is no trend, whichever way it goes.
const NO_TREND: f64 = 0.0005;

/// The windows of one run until settled; times are scaled.
#[derive(Clone, Debug)]
pub struct Settling {
    limit: f64,
    half: f64,
    belt_velocity: f64,
    stable: bool,
    /// The growth rate (1/s) of an unstable equilibrium.
    growth_rate: Option<f64>,
    /// How long a linear motion may grow before it decays; `None` when it does not.
    wait: Option<f64>,
    /// The same of the motion along the belt alone, where that does not excite what lasts across it; and the rms of `ÿ1` (m/s²) that is nothing.
    along: (Option<f64>, f64),
    piecewise_linear: bool,
    /// Whether the belt velocity lies on a kink of the law: small motions pass it twice in every cycle, and nothing else.
    on_kink: bool,
    before: Option<[f64; 2]>,
    /// The end of the window before, and the time without events up to there.
    reached: [f64; 2],
}

impl Settling {
    /// The windows of an instance; `None` when the plan has one, at a fixed time.
    #[must_use]
    pub fn new(instance: &Instance, scene: &Scene, plan: &Plan) -> Option<Settling> {
        let limit = scene.scaled(plan.settle_limit?);
        let asked = (0.5 * scene.scaled(plan.measure)).max(SHORTEST_HALF * TAU);
        let time = scene.units.time;
        // What begins on a kink of the law stays about it.
        let seen = kinks::seen(instance, 0.0);
        let on_kink = seen.is_some();
        let instance = seen.as_ref().unwrap_or(instance);
        let modes: Vec<Complex64> =
            linear::eigenvalues(instance).into_iter().flatten().map(|z| z * time).collect();
        let along: Vec<Complex64> =
            modes.iter().copied().filter(|mode| !is_across(instance, mode / time)).collect();
        let belt_velocity = instance.params.require(Param::BeltVelocity);
        let of_both = beat(&modes);
        let (kind, linear) = linear::analyse(instance);
        let unstable = kind.is_some_and(InstabilityType::is_unstable);
        Some(Settling {
            limit,
            half: of_both.clamp(asked, LONGEST_HALF * asked),
            wait: time_constant(&modes).map(|time| of_both.min(TIME_CONSTANTS * time)),
            along: (
                time_constant(&along).map(|time| beat(&along).min(TIME_CONSTANTS * time)),
                UNMOVED * regime::small_speed(belt_velocity) / time,
            ),
            reached: [scene.scaled(plan.settle), 0.0],
            belt_velocity,
            stable: kind == Some(InstabilityType::Stable),
            growth_rate: linear.map(|linear| linear.growth_rate).filter(|_| unstable),
            piecewise_linear: instance.law.kind().form().is_straight(),
            on_kink,
            before: None,
        })
    }

    /// The latest start of a window, scaled.
    #[must_use]
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// The length of a half of the next window: whole cycles of a motion of `frequency` (cycles per scaled time).
    #[must_use]
    pub fn half(&self, frequency: Option<f64>) -> f64 {
        match frequency {
            Some(frequency) if frequency * self.half >= 0.5 => (frequency * self.half).ceil() / frequency,
            _ => self.half,
        }
    }

    /// Judges a window that ended at `end`; `events` says whether any fell into it. `None`: another one follows.
    pub fn judge(&mut self, outcome: &Outcome, events: bool, end: f64) -> Option<Ending> {
        let (regime, _) = regime::regime(outcome, self.belt_velocity, self.stable);
        let halves = [outcome.x2_std_halves, outcome.ay_rms_halves];
        let before = self.before.replace(halves.map(|[_, last]| last));
        let [first, second] = outcome.speed_rms_halves;
        if first == 0.0 && second == 0.0 || regime == Regime::Stuck {
            return Some(Ending::Settled);
        }
        let small = regime::small_speed(self.belt_velocity);
        let events = events && !(self.on_kink && first < small && second < small);
        let [reached, quiet] = self.reached;
        let quiet = if events { 0.0 } else { quiet + end - reached };
        self.reached = [end, quiet];
        // The beat of two decaying modes may still grow into an event; a curved law is linear for small motions.
        let linear = self.piecewise_linear || second < small;
        let (along, unmoved) = self.along;
        let wait = self.wait.or(along.filter(|_| halves[1].iter().all(|ay| *ay <= unmoved)));
        let decays = wait.filter(|_| self.stable);
        if linear && decays.is_some_and(|wait| quiet >= wait) {
            return Some(Ending::Decays);
        }
        // What has met no event yet grows or decays as its eigenvalues say, however slowly, unless it is seen to have
        // stopped growing.
        let moves = match self.growth_rate {
            Some(rate) if !events || regime == Regime::Equilibrium => {
                regime::has_stopped_growing(outcome, self.belt_velocity, rate)
            }
            _ if events || !self.piecewise_linear => regime != Regime::Equilibrium && (events || self.stable),
            _ => self.stable && decays.is_none(),
        };
        if let Some(before) = before
            && moves
            && halves.iter().zip(before).all(|(&[a, b], before)| has_settled([before, a, b]))
        {
            return Some(Ending::Settled);
        }
        (end > self.limit).then_some(Ending::Limit)
    }
}

/// Whether three values in a row, one from each window, are settled: the last change is small, and so are all later ones
/// together if the changes fall like a geometric series.
fn has_settled([a, b, c]: [f64; 3]) -> bool {
    let (size, bound) = (b.max(c), AGREE * b.max(c));
    let [before, last] = [b - a, c - b];
    if last.abs() <= NO_TREND * size && before.abs() <= bound {
        return true;
    }
    let ratio = last / before;
    let approach = if before * last <= 0.0 { 1.0 } else { ratio / (1.0 - ratio) };
    last.abs() <= bound && before.abs() <= bound && ratio < 1.0 && last.abs() * approach <= bound
}

/// Whether a mode (1/s) is one of `m1` across the belt alone, which no motion along it excites: they do not know of each other at θ = 0.
fn is_across(instance: &Instance, mode: Complex64) -> bool {
    /// What rounding makes of zero.
    const ROUNDING: f64 = 1e-9;
    let [m1, c2, k2, theta] =
        [Param::M1, Param::C2, Param::K2, Param::Theta].map(|param| instance.params.require(param));
    let left = (mode * mode * m1 + mode * c2 + k2).norm();
    theta == 0.0 && left <= ROUNDING * (mode.norm_sqr() * m1 + mode.norm() * c2 + k2)
}

/// The time constant of the slowest mode of the sliding equilibrium, scaled; `None` when it does not decay.
fn time_constant(modes: &[Complex64]) -> Option<f64> {
    let slowest = modes.iter().max_by(|a, b| a.re.total_cmp(&b.re))?;
    (slowest.re < DECAYS_BELOW * slowest.norm()).then(|| -1.0 / slowest.re)
}

/// The beat of the two modes of the sliding equilibrium, scaled: infinite when they have one frequency, 0 when
/// there are no two oscillations.
fn beat(modes: &[Complex64]) -> f64 {
    let mut frequencies: Vec<f64> = modes.iter().map(|z| z.im).filter(|w| *w > 0.0).collect();
    frequencies.sort_by(f64::total_cmp);
    match frequencies[..] {
        [low, high] => TAU / (high - low),
        _ => 0.0,
    }
}
