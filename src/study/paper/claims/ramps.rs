//! Claims on single ramps: Figures 4 and 5.

use crate::study::paper::LIMITS;
use crate::study::paper::claims::claim::{Claim, Verdict, near, not_grown, or_none};
use crate::study::paper::evidence::{Evidence, SLOWEST};

pub(super) fn stable_until_critical_velocity(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[0];
    let critical = evidence.critical_velocity;
    let before = ramp.parts.iter().filter(|part| critical.is_some_and(|v| part.velocity[1] >= v));
    let before = before.map(|part| part.peaks()[0]).fold(0.0, f64::max);
    let start = ramp.parts.first().map_or(0.0, |part| part.peaks()[0]);
    // A vibration smaller than what disturbs it has not grown, whatever it was at first.
    let steady = before > 0.0 && before <= LIMITS.steady * start.max(ramp.disturbance);
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
        verdict: Verdict::of(steady && at_knee && ramp.grown()),
    }
}

pub(super) fn limit_cycle_shrinks(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[0];
    let (top, most) = ramp.largest();
    let after: Vec<f64> = ramp.parts[top..].iter().map(|part| part.peaks()[0]).collect();
    let falls = after.windows(2).all(|pair| pair[1] <= LIMITS.steady * pair[0]);
    let last = after.last().copied().unwrap_or(most);
    let velocity = ramp.parts.get(top).map_or(f64::NAN, |part| part.velocity[1]);
    Claim {
        figure: "4",
        says: "the vibration grows exponentially into a limit cycle, which then shrinks with the belt velocity",
        found: if ramp.grown() {
            format!(
                "ẍ2 grows from {:.1} to {most:.0} m/s² at V = {velocity:.2} m/s and {} to {last:.0} m/s² before rest",
                ramp.disturbance,
                if falls { "falls steadily" } else { "changes, not steadily," }
            )
        } else {
            not_grown(ramp)
        },
        verdict: Verdict::of(ramp.grown() && falls && last <= LIMITS.shrunk * most),
    }
}

pub(super) fn beat(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[0];
    let swell = evidence.swell.filter(|_| ramp.grown());
    Claim {
        figure: "4",
        says: "the vibration beats (read here as: in the limit cycle the normal acceleration swells and fades)",
        found: match swell {
            Some(swell) => {
                format!("in proportion to the belt velocity, the peaks of ÿ1 vary by ±{:.0} %", 100.0 * swell)
            }
            None if ramp.grown() => {
                format!(
                    "the limit cycle begins below {SLOWEST} m/s, too late to tell a beat from its shrinking"
                )
            }
            None => not_grown(ramp),
        },
        verdict: Verdict::of(swell.is_some_and(|swell| swell >= LIMITS.beat)),
    }
}

pub(super) fn saturation_with_detachment(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[1];
    let (top, most) = ramp.largest();
    let saturated = top + 1 < ramp.parts.len();
    // Parts are equally long.
    let after = &ramp.parts[top..];
    let free = after.iter().map(|part| part.free).fold(0.0, |a, b| a + b) / after.len().max(1) as f64;
    Claim {
        figure: "5",
        says: "under mode coupling the growth saturates, and the contact detaches",
        found: if ramp.grown() {
            format!(
                "ẍ2 {} {most:.0} m/s² at V = {:.2} m/s; from then on free flight takes {:.1} % of the time",
                if saturated { "grows to" } else { "is still growing at the end, with" },
                ramp.parts.get(top).map_or(f64::NAN, |part| part.velocity[1]),
                100.0 * free
            )
        } else {
            not_grown(ramp)
        },
        verdict: Verdict::of(ramp.grown() && saturated && free >= LIMITS.detached),
    }
}
