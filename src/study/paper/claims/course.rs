//! How the size of a vibration follows the belt velocity once it has grown: Figure 5.

use crate::study::paper::claims::claim::{Claim, Verdict, not_grown};
use crate::study::paper::evidence::{Evidence, RampFacts};
use crate::study::paper::{LIMITS, extremes};

/// The size of one acceleration from its largest on.
struct Course {
    /// The last size over the largest.
    last: f64,
    /// Coefficient of determination of the straight line over the belt velocity; `None` of too few parts.
    straight: Option<f64>,
    /// The belt velocity over which the size stays almost the same, at most, m/s.
    zone: f64,
}

impl Course {
    /// The course of the size of `ẍ2` (`which` is 0) or `ÿ1` (1).
    fn of(ramp: &RampFacts, which: usize) -> Course {
        let sizes: Vec<f64> = ramp.parts.iter().map(|part| part.peaks()[which]).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let top = sizes.iter().position(|size| *size >= largest).unwrap_or(0);
        let sizes = &sizes[top..];
        let parts = &ramp.parts[top..];
        let middle = |part: usize| 0.5 * (parts[part].velocity[0] + parts[part].velocity[1]);
        let along: Vec<[f64; 2]> = sizes.iter().enumerate().map(|(k, size)| [middle(k), *size]).collect();
        let stable = |from: usize| {
            let run = (from + 1..=sizes.len()).take_while(|to| {
                let range = extremes(sizes[from..*to].iter().copied());
                range.is_some_and(|[low, high]| high <= LIMITS.steady * low)
            });
            run.last().map_or(0.0, |to| (parts[from].velocity[0] - parts[to - 1].velocity[1]).abs())
        };
        Course {
            last: sizes.last().map_or(f64::NAN, |last| last / largest),
            straight: determination(&along),
            zone: (0..sizes.len()).map(stable).fold(0.0, f64::max),
        }
    }

    /// Whether it is what the paper describes, on a ramp over so much belt velocity.
    fn as_described(&self, over: f64) -> bool {
        self.straight.is_some_and(|r| r < LIMITS.straight)
            && self.zone >= LIMITS.zone * over
            && self.last <= LIMITS.shrunk
    }

    fn words(&self, symbol: &str) -> String {
        let Some(straight) = self.straight else {
            return format!("{symbol} is largest at the end of the ramp");
        };
        format!(
            "{symbol} falls to {:.0} % of its largest and stays within {:.0} % over {:.2} m/s at most; a straight line \
             over V has R² = {:.4}",
            100.0 * self.last,
            100.0 * (LIMITS.steady - 1.0),
            self.zone,
            straight
        )
    }
}

/// The coefficient of determination of a straight line through points: the square of their correlation. One through two
/// points says nothing.
fn determination(points: &[[f64; 2]]) -> Option<f64> {
    if points.len() < 3 {
        return None;
    }
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    let middle = [mean(0), mean(1)];
    let moment = |i: usize, j: usize| {
        points.iter().map(|point| (point[i] - middle[i]) * (point[j] - middle[j])).sum::<f64>()
    };
    // Sizes that are all the same are on a line.
    let spread = moment(0, 0) * moment(1, 1);
    Some(if spread > 0.0 { moment(0, 1).powi(2) / spread } else { 1.0 })
}

pub(super) fn stable_zone(evidence: &Evidence) -> Claim {
    let ramp = &evidence.ramps[1];
    let [tangential, normal] = [0, 1].map(|which| Course::of(ramp, which));
    let over = ramp.parts.iter().map(|part| part.velocity[0] - part.velocity[1]).sum::<f64>().abs();
    let shown = [&tangential, &normal].map(|course| ramp.grown() && course.as_described(over));
    Claim {
        figure: "5",
        says: "under mode coupling the accelerations do not follow the belt velocity linearly: once grown they have an \
               almost stable zone, then they decrease",
        found: if ramp.grown() {
            format!("{}; {}", tangential.words("ẍ2"), normal.words("ÿ1"))
        } else {
            not_grown(ramp)
        },
        verdict: match shown {
            [true, true] => Verdict::Reproduced,
            [true, false] => Verdict::Under("of ẍ2 alone".to_owned()),
            [false, true] => Verdict::Under("of ÿ1 alone".to_owned()),
            [false, false] => Verdict::NotReproduced,
        },
    }
}
