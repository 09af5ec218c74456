//! Claims that compare the ramps with each other: Figures 4 to 6.

use crate::study::paper::claims::claim::{Claim, Verdict};
use crate::study::paper::evidence::{Evidence, RampFacts};
use crate::study::paper::{Case, LIMITS, Trial, millimetres};

/// Whether neither of two amplitudes is much larger than the other.
fn alike(ratio: f64) -> bool {
    (1.0 / LIMITS.similar..=LIMITS.similar).contains(&ratio)
}

/// The end of a sentence that names the ramps whose vibrations have not grown; empty where all have.
fn small(evidence: &Evidence, cases: &[Case]) -> String {
    let small = cases.iter().filter(|case| !evidence.ramps[**case as usize].grown());
    let words: Vec<&str> = small.map(|case| case.words()).collect();
    if words.is_empty() {
        return String::new();
    }
    format!("; not grown on this ramp, so that these say nothing: {}", words.join(", "))
}

pub(super) fn similar(evidence: &Evidence) -> Claim {
    let [slope, coupling, _] = &evidence.ramps;
    let peaks = [slope, coupling].map(|ramp| ramp.peaks()[0]);
    let rms = [slope, coupling].map(|ramp| ramp.ax_rms);
    let trials = selected(evidence, |trial| trial.slope_over_coupling().is_some_and(alike));
    let cases = [Case::NegativeSlope, Case::ModeCoupling];
    let small = small(evidence, &cases);
    let verdict = if small.is_empty() && alike(peaks[0] / peaks[1]) {
        Verdict::Reproduced
    } else if small.is_empty() && alike(rms[0] / rms[1]) {
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
            "peaks of ẍ2 {:.0} and {:.0} m/s² (ratio {:.2}), root mean square {:.0} and {:.0} m/s² (ratio \
             {:.2}){small}; nearest to 1 among other ramps and kicks: {best:.2}",
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

pub(super) fn larger_under_coexistence(evidence: &Evidence) -> Claim {
    let [slope, coupling, both] = evidence.ramps.each_ref().map(RampFacts::peaks);
    let holds = |ratio: [f64; 2]| ratio.into_iter().all(|ratio| ratio > 1.0);
    let ratio = [0, 1].map(|k| both[k] / slope[k].max(coupling[k]));
    let trials = selected(evidence, |trial| trial.coexistence().is_some_and(holds));
    let small = small(evidence, &Case::ALL);
    let verdict = match (small.is_empty() && holds(ratio), trials.is_empty()) {
        (true, _) => Verdict::Reproduced,
        (false, false) => Verdict::Under(where_it_holds(&trials, evidence)),
        (false, true) => Verdict::NotReproduced,
    };
    Claim {
        figure: "6",
        says: "where both mechanisms act, both accelerations are larger than under either alone",
        found: format!(
            "on this ramp {:.0} and {:.0} m/s², {:.2} and {:.2} times the larger of the two alone{small}",
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
