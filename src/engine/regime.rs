//! Outcome → regime. Every threshold of the classification stands here.

use serde::Serialize;

use crate::engine::outcome::Outcome;

/// The kind of motion in the measuring window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Regime {
    /// Rest at, or decay towards, the sliding equilibrium.
    Equilibrium,
    /// Sustained oscillation that never sticks, reverses or detaches.
    Slip,
    /// Stick and slip.
    StickSlip,
    /// Oscillation with slip in both directions.
    SlipReversal,
    /// Oscillation with free flight, without stick.
    Detaching,
    /// Oscillation with free flight and stick.
    DetachingStickSlip,
    /// Stick throughout.
    Stuck,
    /// Still about an unstable equilibrium, without an event or small: what it grows into has not been seen.
    NotYetGrown,
}

// The place of a regime in its list is its number.
const _: () = {
    let mut place = 0;
    while place < Regime::ALL.len() {
        assert!(Regime::ALL[place] as usize == place);
        place += 1;
    }
};

impl Regime {
    /// Every regime, in the order of legends and summaries.
    pub const ALL: [Regime; 8] = [
        Regime::Equilibrium,
        Regime::Slip,
        Regime::StickSlip,
        Regime::SlipReversal,
        Regime::Detaching,
        Regime::DetachingStickSlip,
        Regime::Stuck,
        Regime::NotYetGrown,
    ];

    /// The name in `map.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Regime::Equilibrium => "equilibrium",
            Regime::Slip => "slip",
            Regime::StickSlip => "stick_slip",
            Regime::SlipReversal => "slip_reversal",
            Regime::Detaching => "detaching",
            Regime::DetachingStickSlip => "detaching_stick_slip",
            Regime::Stuck => "stuck",
            Regime::NotYetGrown => "not_yet_grown",
        }
    }
}

/// Every threshold of the regimes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// A contact state counts when it fills at least this fraction of the window.
    pub state_counts: f64,
    /// Decay: the speed of the second half below this multiple of that of the first.
    pub decay: f64,
    /// Rest: the speed below this fraction of the belt velocity …
    pub small_speed: f64,
    /// … while the second half is at most this multiple of the first. Motions this small are linear:
    /// where the eigenvalues say stable, a beat of two decaying modes counts as decay too.
    pub small_growth: f64,
    /// Settled: standard deviation of `x2` and rms of `ÿ1` of the two halves agree within this fraction.
    pub settled: f64,
    /// Two oscillations from two starts are two cycles: standard deviation of `x2` or rms of `ÿ1` apart by more than this
    /// fraction of the larger. Well above what settled halves may differ by, and below the steps between branches.
    pub apart: f64,
    /// A motion about an unstable equilibrium that does not grow any more has had the time to grow by this factor: then
    /// its unstable mode is more than a part too small to be seen.
    pub outgrown: f64,
}

/// The thresholds in use.
pub const THRESHOLDS: Thresholds = Thresholds {
    state_counts: 1e-3,
    decay: 0.99,
    small_speed: 0.01,
    small_growth: 1.01,
    settled: 0.01,
    apart: 0.05,
    outgrown: 1000.0,
};

/// The regime of a completed outcome at the belt velocity `belt_velocity` (m/s), and whether it is settled.
///
/// `stable` says whether the sliding equilibrium is linearly stable: it decides for motions too small for
/// anything else, which may beat for longer than the window.
#[must_use]
pub fn regime(outcome: &Outcome, belt_velocity: f64, stable: bool) -> (Regime, bool) {
    let limits = THRESHOLDS;
    let fraction = |value: Option<f64>| value.unwrap_or(0.0);
    let (stick, free) = (fraction(outcome.stick), fraction(outcome.free));
    let counts = |value: f64| value >= limits.state_counts;
    let [first, second] = outcome.speed_rms_halves;
    let small = first < limits.small_speed * belt_velocity;
    let regime = if stick >= 1.0 {
        Regime::Stuck
    } else if counts(free) {
        if counts(stick) { Regime::DetachingStickSlip } else { Regime::Detaching }
    } else if counts(stick) {
        Regime::StickSlip
    } else if counts(fraction(outcome.reverse)) {
        Regime::SlipReversal
    } else if second < limits.decay * first
        || (small
            && (second <= limits.small_growth * first
                || (stable && second < limits.small_speed * belt_velocity)))
    {
        Regime::Equilibrium
    } else {
        Regime::Slip
    };
    let settled = halves_agree(outcome) && !is_carried(regime, belt_velocity);
    (regime, regime == Regime::Equilibrium || settled)
}

/// Whether the belt carries the mass along, for ever or until it slips: that has not settled.
#[must_use]
pub fn is_carried(regime: Regime, belt_velocity: f64) -> bool {
    regime == Regime::Stuck && belt_velocity > 0.0
}

/// Whether the halves of the window agree in the standard deviation of `x2` and the rms of `ÿ1`.
fn halves_agree(outcome: &Outcome) -> bool {
    let agree = |[a, b]: [f64; 2]| (a - b).abs() <= THRESHOLDS.settled * a.max(b);
    agree(outcome.x2_std_halves) && agree(outcome.ay_rms_halves)
}

/// The regime of a completed outcome about an unstable equilibrium, whose growth rate (1/s) is asked for where it matters.
/// `found` is what [`regime`] makes of the outcome alone, and what is told where there is no rate. A motion that has met no
/// event, or is small, may only be growing: it is an oscillation of its own when it keeps its size although its growth rate
/// would have it grow.
#[must_use]
pub fn about_unstable(
    outcome: &Outcome,
    belt_velocity: f64,
    growth_rate: impl FnOnce() -> Option<f64>,
    found: (Regime, bool),
) -> (Regime, bool) {
    match found.0 {
        Regime::Slip if outcome.met_event && outcome.speed_rms_halves[1] >= small_speed(belt_velocity) => {
            found
        }
        Regime::Slip | Regime::Equilibrium if !may_have_stopped_growing(outcome, belt_velocity) => {
            (Regime::NotYetGrown, false)
        }
        Regime::Slip | Regime::Equilibrium => match growth_rate() {
            Some(rate) if has_outgrown(outcome, rate) => (Regime::Slip, found.1),
            Some(_) => (Regime::NotYetGrown, false),
            None => found,
        },
        _ => found,
    }
}

/// The speed (m/s) below which a motion is small.
#[must_use]
pub fn small_speed(belt_velocity: f64) -> f64 {
    THRESHOLDS.small_speed * belt_velocity
}

/// Whether a motion about an unstable equilibrium has come to an amplitude that it keeps. It has when the halves of the
/// window agree although its growth rate (1/s) would have set them apart, after a time in which its unstable mode has
/// outgrown all others. A small motion without any event is linear: nothing stops its growth.
#[must_use]
pub fn has_stopped_growing(outcome: &Outcome, belt_velocity: f64, growth_rate: f64) -> bool {
    may_have_stopped_growing(outcome, belt_velocity) && has_outgrown(outcome, growth_rate)
}

/// What of that needs no growth rate.
fn may_have_stopped_growing(outcome: &Outcome, belt_velocity: f64) -> bool {
    let [_, speed] = outcome.speed_rms_halves;
    let linear = speed < small_speed(belt_velocity) && !outcome.met_event;
    speed > 0.0 && !linear && halves_agree(outcome)
}

/// What of that needs the growth rate.
fn has_outgrown(outcome: &Outcome, growth_rate: f64) -> bool {
    let limits = THRESHOLDS;
    (0.5 * growth_rate * outcome.window).exp_m1() > limits.apart
        && growth_rate * outcome.simulated_time > limits.outgrown.ln()
}
