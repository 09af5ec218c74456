//! Claims on the phase of the two accelerations: Figure 7 and section 2.4.

use crate::study::paper::claims::claim::{Claim, Verdict};
use crate::study::paper::evidence::Evidence;
use crate::study::paper::{CUSTOMARY, LIMITS, Score, Source, Window, degrees, extremes};

/// The range of some angles in words.
fn range(angles: impl Iterator<Item = f64>) -> String {
    extremes(angles).map_or_else(|| "none".to_owned(), degrees)
}

fn found(windows: &[Window]) -> String {
    let [Some(first), Some(last)] = [windows.first(), windows.last()] else {
        return format!("the vibration does not grow to {} times what disturbs it", LIMITS.growth);
    };
    format!(
        "ÿ1 against ẍ2 while it grows from V = {:.2} to {:.2} m/s: {} measured, {} of the eigenvectors",
        first.velocity,
        last.velocity,
        range(windows.iter().map(|window| window.measured)),
        range(windows.iter().filter_map(|window| window.eigenvector))
    )
}

/// A phase holds when it does in every window, measured and of the eigenvector.
fn verdict(windows: &[Window], holds: impl Fn(f64) -> bool) -> Verdict {
    let both = |window: &Window| holds(window.measured) && window.eigenvector.is_some_and(&holds);
    Verdict::of(!windows.is_empty() && windows.iter().all(both))
}

pub(super) fn in_phase(evidence: &Evidence) -> Claim {
    let windows = &evidence.phases[0];
    Claim {
        figure: "7a",
        says: "under a negative slope normal and tangential acceleration are in phase",
        found: found(windows),
        verdict: verdict(windows, |angle| angle.abs() <= LIMITS.in_phase),
    }
}

pub(super) fn in_quadrature(evidence: &Evidence) -> Claim {
    let windows = &evidence.phases[1];
    Claim {
        figure: "7b",
        says: "under mode coupling they are in quadrature",
        found: found(windows),
        verdict: verdict(windows, |angle| (angle.abs() - 90.0).abs() <= LIMITS.quadrature),
    }
}

/// Both shares of right verdicts, of the laws that the paper considers.
pub(super) fn separates(evidence: &Evidence) -> Claim {
    let trial = evidence.phase_trial.falling();
    let [growing, cycle] = [Source::Growth, Source::Cycle].map(|source| trial.score(source, CUSTOMARY));
    let words = |score: Option<Score>| {
        score.map_or_else(
            || "no verdicts".to_owned(),
            |score| format!("right on {:.0} and {:.0} %", 100.0 * score.slope, 100.0 * score.coupling),
        )
    };
    let best = trial.best(Source::Growth).map_or_else(String::new, |best| {
        format!(", {} at the best threshold, {:.1}°", words(Some(best)), best.threshold)
    });
    let holds =
        |score: Option<Score>| score.is_some_and(|score| score.slope.min(score.coupling) >= LIMITS.separates);
    Claim {
        figure: "section 2.4",
        says: "the phase between the accelerations tells a negative slope from mode coupling",
        found: format!(
            "one mechanism alone, μ_s ≥ μ_d, threshold {CUSTOMARY}° (negative slope and mode coupling): {} while the \
             vibration grows{best}; {} in the settled limit cycle",
            words(growing),
            words(cycle)
        ),
        verdict: match [growing, cycle].map(holds) {
            [true, _] => Verdict::Reproduced,
            [false, true] => {
                Verdict::Under("in the settled limit cycle, not while the vibration grows".to_owned())
            }
            [false, false] => Verdict::NotReproduced,
        },
    }
}
