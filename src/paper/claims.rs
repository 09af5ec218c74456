//! What the paper claims of the lumped model, and whether the results bear it out.
//!
//! Verdicts are decided here from [`Evidence`] and [`LIMITS`]; none is written down.

use crate::paper::evidence::{Evidence, RampFacts};
use crate::paper::{LIMITS, Phase, Trial, millimetres};

/// What became of a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds.
    Reproduced,
    /// It holds, but not as the paper has it: under this condition.
    Under(String),
    /// It does not hold.
    NotReproduced,
}

impl Verdict {
    fn of(holds: bool) -> Verdict {
        if holds { Verdict::Reproduced } else { Verdict::NotReproduced }
    }

    /// In words, without the condition.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self {
            Verdict::Reproduced => "reproduced",
            Verdict::Under(_) => "reproduced under a stated condition",
            Verdict::NotReproduced => "not reproduced",
        }
    }
}

/// One claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The figure it belongs to.
    pub figure: &'static str,
    /// What the paper says, as it is read here.
    pub says: &'static str,
    /// What was found, with the numbers.
    pub found: String,
    /// What became of it.
    pub verdict: Verdict,
}

/// All claims in the order of the figures.
#[must_use]
pub fn claims(evidence: &Evidence) -> Vec<Claim> {
    vec![
        critical_friction(evidence),
        coalescence_frequency(evidence),
        stable_until_critical_velocity(evidence),
        limit_cycle_shrinks(evidence),
        beat(evidence),
        saturation_with_detachment(evidence),
        similar_amplitudes(evidence),
        larger_under_coexistence(evidence),
        in_phase(&evidence.phases[0]),
        in_quadrature(&evidence.phases[1]),
    ]
}

/// `x` with `digits` decimals, or a dash.
fn or_none(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "none".to_owned(), |x| format!("{x:.digits$}"))
}

fn near(value: Option<f64>, target: f64, within: f64) -> bool {
    value.is_some_and(|x| (x - target).abs() <= within)
}

fn critical_friction(evidence: &Evidence) -> Claim {
    let found = evidence.critical_friction;
    Claim {
        figure: "2",
        says: "with constant friction the sliding equilibrium loses stability at μ = 0.22",
        found: format!("at μ = {}", or_none(found, 4)),
        verdict: Verdict::of(near(found, LIMITS.critical_friction, LIMITS.critical_friction_within)),
    }
}

fn coalescence_frequency(evidence: &Evidence) -> Claim {
    let found = evidence.coalescence_frequency;
    let within = LIMITS.coalescence_frequency_within;
    Claim {
        figure: "2",
        says: "the two modes merge at about 34 Hz",
        found: format!("{} Hz at the critical friction", or_none(found, 2)),
        verdict: Verdict::of(near(found, LIMITS.coalescence_frequency, within)),
    }
}

fn grown(ramp: &RampFacts) -> bool {
    ramp.largest().1 >= LIMITS.growth * ramp.disturbance
}

fn stable_until_critical_velocity(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[0];
    let critical = evidence.critical_velocity;
    let before = ramp.parts.iter().filter(|part| critical.is_some_and(|v| part.velocity[1] >= v));
    let before = before.map(|part| part.peaks()[0]).fold(0.0, f64::max);
    let start = ramp.parts.first().map_or(0.0, |part| part.peaks()[0]);
    let steady = before > 0.0 && before <= LIMITS.steady * start;
    let at_knee = near(critical, evidence.knee_velocity, LIMITS.critical_velocity_within);
    Claim {
        figure: "4",
        says: "under a negative slope sliding is stable until the belt has slowed down to the critical velocity",
        found: format!(
            "eigenvalues: unstable below {} m/s, the knee of the law being at {} m/s; ramp: ẍ2 stays within \
             {before:.1} m/s² above that velocity and reaches {:.0} m/s² below it",
            or_none(critical, 2),
            evidence.knee_velocity,
            ramp.largest().1
        ),
        verdict: Verdict::of(steady && at_knee && grown(ramp)),
    }
}

fn limit_cycle_shrinks(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[0];
    let (top, most) = ramp.largest();
    let after: Vec<f64> = ramp.parts[top..].iter().map(|part| part.peaks()[0]).collect();
    let falls = after.windows(2).all(|pair| pair[1] <= LIMITS.steady * pair[0]);
    let last = after.last().copied().unwrap_or(most);
    let velocity = ramp.parts.get(top).map_or(f64::NAN, |part| part.velocity[1]);
    Claim {
        figure: "4",
        says: "the vibration grows exponentially into a limit cycle, which then shrinks with the belt velocity",
        found: format!(
            "ẍ2 grows from {:.1} to {most:.0} m/s² at V = {velocity:.2} m/s and {} to {last:.0} m/s² before rest",
            ramp.disturbance,
            if falls { "falls steadily" } else { "changes, not steadily," }
        ),
        verdict: Verdict::of(grown(ramp) && falls && last <= LIMITS.shrunk * most),
    }
}

fn beat(evidence: &Evidence) -> Claim {
    let swell = evidence.swell;
    Claim {
        figure: "4",
        says: "the vibration beats (read here as: in the limit cycle the normal acceleration swells and fades)",
        found: swell.map_or_else(
            || "no limit cycle".to_owned(),
            |swell| {
                format!("in proportion to the belt velocity, the peaks of ÿ1 vary by ±{:.0} %", 100.0 * swell)
            },
        ),
        verdict: Verdict::of(swell.is_some_and(|swell| swell >= LIMITS.beat)),
    }
}

fn saturation_with_detachment(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[1];
    let (top, most) = ramp.largest();
    let saturated = top + 1 < ramp.parts.len();
    // Parts are equally long.
    let after = &ramp.parts[top..];
    let free = after.iter().map(|part| part.free).sum::<f64>() / after.len().max(1) as f64;
    Claim {
        figure: "5",
        says: "under mode coupling the growth saturates, and the contact detaches",
        found: format!(
            "ẍ2 {} {most:.0} m/s² at V = {:.2} m/s; from then on free flight takes {:.1} % of the time",
            if saturated { "grows to" } else { "is still growing at the end, with" },
            ramp.parts.get(top).map_or(f64::NAN, |part| part.velocity[1]),
            100.0 * free
        ),
        verdict: Verdict::of(grown(ramp) && saturated && free >= LIMITS.detached),
    }
}

/// Whether neither of two amplitudes is much larger than the other.
fn similar(ratio: f64) -> bool {
    (1.0 / LIMITS.similar..=LIMITS.similar).contains(&ratio)
}

fn similar_amplitudes(evidence: &Evidence) -> Claim {
    let [slope, coupling, _] = &evidence.ramps;
    let peaks = [slope, coupling].map(|ramp| ramp.peaks()[0]);
    let rms = [slope, coupling].map(|ramp| ramp.ax_rms);
    let trials = selected(evidence, |trial| trial.slope_over_coupling().is_some_and(similar));
    let verdict = if similar(peaks[0] / peaks[1]) {
        Verdict::Reproduced
    } else if similar(rms[0] / rms[1]) {
        Verdict::Under(format!("as root mean square over the ramp: {:.0} and {:.0} m/s²", rms[0], rms[1]))
    } else if trials.is_empty() {
        Verdict::NotReproduced
    } else {
        Verdict::Under(where_it_holds(&trials, evidence))
    };
    let ratios = evidence.trials.iter().filter(|trial| LIMITS.grown(trial));
    let best = ratios.filter_map(Trial::slope_over_coupling).map(|r| r.min(1.0 / r)).fold(0.0, f64::max);
    Claim {
        figure: "4a, 5a",
        says: "the tangential accelerations under either mechanism are similar",
        found: format!(
            "peaks of ẍ2 {:.0} and {:.0} m/s² (ratio {:.2}), root mean square {:.0} and {:.0} m/s² (ratio {:.2}); \
             nearest to 1 among other ramps and kicks: {best:.2}",
            peaks[0],
            peaks[1],
            peaks[0] / peaks[1],
            rms[0],
            rms[1],
            rms[0] / rms[1]
        ),
        verdict,
    }
}

fn larger_under_coexistence(evidence: &Evidence) -> Claim {
    let [slope, coupling, both] = evidence.ramps.each_ref().map(RampFacts::peaks);
    let holds = |ratio: [f64; 2]| ratio.into_iter().all(|ratio| ratio > 1.0);
    let ratio = [0, 1].map(|k| both[k] / slope[k].max(coupling[k]));
    let trials = selected(evidence, |trial| trial.coexistence().is_some_and(holds));
    let verdict = match (holds(ratio), trials.is_empty()) {
        (true, _) => Verdict::Reproduced,
        (false, false) => Verdict::Under(where_it_holds(&trials, evidence)),
        (false, true) => Verdict::NotReproduced,
    };
    Claim {
        figure: "6",
        says: "where both mechanisms act, both accelerations are larger than under either alone",
        found: format!(
            "on this ramp {:.0} and {:.0} m/s², {:.2} and {:.2} times the larger of the two alone",
            both[0], both[1], ratio[0], ratio[1]
        ),
        verdict,
    }
}

/// The trials with grown vibrations that satisfy a condition.
fn selected(evidence: &Evidence, holds: impl Fn(&Trial) -> bool) -> Vec<&Trial> {
    evidence.trials.iter().filter(|trial| LIMITS.grown(trial) && holds(trial)).collect()
}

/// For which ramps and kicks something holds.
fn where_it_holds(trials: &[&Trial], evidence: &Evidence) -> String {
    let range = |value: fn(&Trial) -> f64| {
        let values = trials.iter().map(|trial| value(trial));
        values.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)))
    };
    let [duration, kick] = [range(|trial| trial.duration), range(|trial| millimetres(trial.kick))];
    let between = |(low, high): (f64, f64), unit: &str| {
        if low < high { format!("{low} to {high} {unit}") } else { format!("{low} {unit}") }
    };
    let grown = evidence.trials.iter().filter(|trial| LIMITS.grown(trial)).count();
    format!(
        "in {} of the {grown} combinations of ramp and kick in which all three vibrations grow, with ramps of {} \
         and kicks of {}",
        trials.len(),
        between(duration, "s"),
        between(kick, "mm")
    )
}

fn phase_found(phase: &Phase) -> String {
    format!("ÿ1 against ẍ2: {:.1}° from the eigenvector, {:.1}° measured", phase.eigenvector, phase.measured)
        .replace('-', "−")
}

/// Both phases, from the eigenvector and measured, satisfy a condition.
fn both_phases(phase: &Phase, holds: impl Fn(f64) -> bool) -> bool {
    holds(phase.eigenvector) && holds(phase.measured)
}

fn in_phase(phase: &Phase) -> Claim {
    Claim {
        figure: "7a",
        says: "under a negative slope normal and tangential acceleration are in phase",
        found: phase_found(phase),
        verdict: Verdict::of(both_phases(phase, |angle| angle.abs() <= LIMITS.in_phase)),
    }
}

fn in_quadrature(phase: &Phase) -> Claim {
    let quadrature = both_phases(phase, |angle| (angle.abs() - 90.0).abs() <= LIMITS.quadrature);
    let nearer = LIMITS.nearer_quadrature..=180.0 - LIMITS.nearer_quadrature;
    let verdict = if quadrature {
        Verdict::Reproduced
    } else if both_phases(phase, |angle| nearer.contains(&angle.abs())) {
        let nearer = LIMITS.nearer_quadrature;
        Verdict::Under(format!(
            "where every phase nearer to 90° than to 0°, from {nearer}° on, is called quadrature"
        ))
    } else {
        Verdict::NotReproduced
    };
    Claim {
        figure: "7b",
        says: "under mode coupling they are in quadrature",
        found: phase_found(phase),
        verdict,
    }
}
