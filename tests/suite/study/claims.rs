//! The paper's claims: verdicts follow from the numbers. Results that contradict a claim change its verdict.

use squealmap::model::kind::InstabilityType;
use squealmap::study::paper::{
    Claim, Evidence, LIMITS, PhaseTrial, RampFacts, Stretch, Trial, Verdict, Window, Witness, claims,
};

/// A ramp of 28 parts from 7 m/s to rest whose largest `|ẍ2|` and `|ÿ1|` and free flight follow the velocity.
fn ramp(follow: impl Fn(f64) -> (f64, f64, f64)) -> RampFacts {
    let part = |k: i32| {
        let velocity = [7.0 - 0.25 * f64::from(k), 6.75 - 0.25 * f64::from(k)];
        let (ax, ay, free) = follow(velocity[1]);
        let time = velocity.map(|v| (7.0 - v) / 0.7);
        Stretch { time, velocity, tangential: [-ax, 0.5 * ax], normal: [-0.5 * ay, ay], stick: 0.0, free }
    };
    let parts = (0..28).map(part).collect();
    RampFacts { duration: 10.0, kick: 1e-4, disturbance: 4.0, ax_rms: 400.0, parts }
}

/// A limit cycle below 4 m/s in proportion to the velocity, growth above.
fn cycle(scale: f64, free: f64) -> RampFacts {
    ramp(|v| match v {
        v if v >= 5.0 => (4.0, 1.0, 0.0),
        v if v > 4.0 => (4.0 * (200.0 * scale / 4.0_f64).powf(5.0 - v), 10.0, 0.0),
        v => (50.0 * scale * v, 25.0 * scale * v, free),
    })
}

/// Like it, with a size that keeps to 2 m/s.
fn plateau(scale: f64) -> RampFacts {
    ramp(|v| match v {
        v if v >= 5.0 => (4.0, 1.0, 0.0),
        v if v > 4.0 => (4.0 * (200.0 * scale / 4.0_f64).powf(5.0 - v), 10.0, 0.0),
        v => (100.0 * scale * v.min(2.0), 50.0 * scale * v.min(2.0), 0.2),
    })
}

/// A vibration that does not grow.
fn still(size: f64) -> RampFacts {
    ramp(|_| (size, 0.25 * size, 0.0))
}

/// Growth with one phase throughout.
fn phase(angle: f64) -> Vec<Window> {
    let window = |velocity| Window {
        time: [1.0, 1.1],
        velocity,
        amplitude: 100.0,
        measured: angle,
        eigenvector: Some(angle),
    };
    vec![window(4.0), window(3.0)]
}

/// Instances of one mechanism alone; how many of them have a large phase, of ten.
fn witnesses(kind: InstabilityType, friction: [f64; 2], growth: usize, cycle: usize) -> Vec<Witness> {
    let angle = |large: bool| Some(if large { 80.0 } else { 10.0 });
    let witness = |k| Witness {
        velocity: 3.0,
        friction,
        kind: Some(kind),
        phases: [angle(k < growth), angle(k < growth), angle(k < cycle)],
    };
    (0..10).map(witness).collect()
}

/// A trial of the phase with these counts of large phases under a negative slope and under mode coupling.
fn trial_of_phase([slope, coupling]: [usize; 2], [slope_cycle, coupling_cycle]: [usize; 2]) -> PhaseTrial {
    let slope = witnesses(InstabilityType::NegativeSlope, [0.2, 0.1], slope, slope_cycle);
    let coupling = witnesses(InstabilityType::ModeCoupling, [0.4, 0.4], coupling, coupling_cycle);
    PhaseTrial { witnesses: slope.into_iter().chain(coupling).collect() }
}

/// Results that bear out every claim.
fn faithful() -> Evidence {
    let trial = |kick: f64| Trial {
        duration: 2.0,
        kick,
        disturbance: 4.0,
        peaks: [Some([400.0, 100.0]), Some([410.0, 300.0]), Some([500.0, 350.0])],
    };
    Evidence {
        critical_friction: Some(0.222),
        coalescence_frequency: Some(33.9),
        critical_velocity: Some(5.0),
        knee_velocity: 5.0,
        ramps: [cycle(1.0, 0.0), plateau(1.1), cycle(1.3, 0.2)],
        swell: Some(0.4),
        phases: [phase(-5.0), phase(-85.0)],
        trials: vec![trial(1e-4), trial(1e-5)],
        phase_trial: trial_of_phase([0, 10], [0, 10]),
    }
}

/// The claim whose words contain `part`.
fn claim(evidence: &Evidence, part: &str) -> Claim {
    let mut found = claims(evidence).into_iter().filter(|claim| claim.says.contains(part));
    let claim = found.next().expect("a claim of these words");
    assert!(found.next().is_none(), "{part} is ambiguous");
    claim
}

fn verdict(evidence: &Evidence, part: &str) -> Verdict {
    claim(evidence, part).verdict
}

#[test]
fn results_like_the_paper_reproduce_every_claim() {
    for claim in claims(&faithful()) {
        assert_eq!(claim.verdict, Verdict::Reproduced, "{}: {}", claim.says, claim.found);
    }
}

/// A claim by some of its words, and a change of the results that contradicts it.
type Plant = (&'static str, fn(&mut Evidence));

const CONTRADICTIONS: &[Plant] = &[
    ("loses stability", |e| e.critical_friction = Some(0.235)),
    ("loses stability", |e| e.critical_friction = None),
    ("merge", |e| e.coalescence_frequency = Some(35.0)),
    // Unstable from another velocity on; a vibration that grows before it; one that never grows.
    ("sliding is stable until", |e| e.critical_velocity = Some(4.0)),
    ("sliding is stable until", |e| e.ramps[0].parts[3].tangential = [-60.0, 60.0]),
    ("sliding is stable until", |e| e.ramps[0] = still(4.0)),
    // No growth; a limit cycle that swells again; one that keeps its size.
    ("then shrinks", |e| e.ramps[0] = still(4.0)),
    ("then shrinks", |e| e.ramps[0].parts[22].tangential = [-190.0, 190.0]),
    ("then shrinks", |e| e.ramps[0] = ramp(|v| (if v < 4.0 { 200.0 } else { 4.0 }, 1.0, 0.0))),
    ("beats", |e| e.swell = Some(0.05)),
    ("beats", |e| e.swell = None),
    ("beats", |e| e.ramps[0] = still(39.0)),
    // No flight; growth to the end; no growth.
    ("saturates", |e| e.ramps[1] = cycle(1.1, 0.0)),
    ("saturates", |e| e.ramps[1] = ramp(|v| (1000.0 / (0.1 + v), 1.0, 0.2))),
    ("saturates", |e| e.ramps[1] = ramp(|_| (4.0, 1.0, 0.2))),
    // No zone: in proportion to the velocity. No decrease; no growth.
    ("almost stable zone", |e| e.ramps[1] = cycle(1.1, 0.2)),
    ("almost stable zone", |e| e.ramps[1] = ramp(|v| (if v < 4.0 { 200.0 } else { 4.0 }, 1.0, 0.2))),
    ("almost stable zone", |e| e.ramps[1] = still(39.0)),
    // One window is enough, as is a phase that only comes near; and what does not grow has none.
    ("in phase", |e| e.phases[0][1].measured = 30.0),
    ("in phase", |e| e.phases[0][0].eigenvector = Some(-170.0)),
    ("in phase", |e| e.phases[0][0].eigenvector = None),
    ("in phase", |e| e.phases[0].clear()),
    ("in quadrature", |e| e.phases[1][1].eigenvector = Some(-20.0)),
    ("in quadrature", |e| e.phases[1][0].measured = -160.0),
    ("in quadrature", |e| e.phases[1] = phase(-56.4)),
    ("in quadrature", |e| e.phases[1].clear()),
    // Wrong on one mechanism; nothing to judge by; a friction that rises is not the paper's.
    ("tells a negative slope", |e| e.phase_trial = trial_of_phase([4, 10], [1, 10])),
    ("tells a negative slope", |e| e.phase_trial = trial_of_phase([0, 9], [0, 9])),
    ("tells a negative slope", |e| e.phase_trial.witnesses.clear()),
    ("tells a negative slope", |e| {
        e.phase_trial.witnesses.iter_mut().for_each(|one| one.friction = [0.1, 0.2]);
    }),
];

#[test]
fn results_that_contradict_a_claim_change_its_verdict() {
    for (number, (part, plant)) in CONTRADICTIONS.iter().enumerate() {
        let mut evidence = faithful();
        plant(&mut evidence);
        assert_eq!(verdict(&evidence, part), Verdict::NotReproduced, "{part}, contradiction {number}");
    }
}

#[test]
fn amplitudes_are_similar_as_peaks_or_as_rms_or_on_other_ramps() {
    let part = "are similar";
    let mut evidence = faithful();
    evidence.ramps[1] = cycle(1.5, 0.2);
    let Verdict::Under(condition) = verdict(&evidence, part) else { panic!("peaks differ, rms do not") };
    assert!(condition.contains("root mean square") && condition.contains("400"), "{condition}");
    evidence.ramps[1].ax_rms = 700.0;
    let Verdict::Under(condition) = verdict(&evidence, part) else { panic!("other ramps remain") };
    assert!(
        condition.contains("in 2 of the 2 combinations") && condition.contains("0.01 to 0.1 mm"),
        "{condition}"
    );
    // A vibration that has not grown says nothing.
    evidence.trials[0].peaks[0] = Some([30.0, 10.0]);
    evidence.trials[0].peaks[1] = Some([30.0, 10.0]);
    evidence.trials[1].peaks[0] = Some([100.0, 10.0]);
    assert_eq!(verdict(&evidence, part), Verdict::NotReproduced);
}

#[test]
fn coexistence_is_larger_here_or_on_other_ramps_or_nowhere() {
    let part = "both accelerations are larger";
    let mut evidence = faithful();
    evidence.ramps[2] = cycle(1.05, 0.2);
    let Verdict::Under(condition) = verdict(&evidence, part) else { panic!("the trials remain") };
    assert!(
        condition.contains("in 2 of the 2 combinations") && condition.contains("ramps of 2 s"),
        "{condition}"
    );
    // One of the two accelerations is not enough, nor is a ramp that failed.
    evidence.trials[0].peaks[2] = Some([500.0, 290.0]);
    evidence.trials[1].peaks[0] = None;
    assert_eq!(verdict(&evidence, part), Verdict::NotReproduced);
}

#[test]
fn a_vibration_that_has_not_grown_reproduces_nothing() {
    // Sizes that are alike, and largest under both: 39 is less than ten times what disturbs, 4 m/s².
    let mut evidence = faithful();
    evidence.ramps = [still(38.0), still(37.0), still(39.0)];
    for part in ["are similar", "both accelerations are larger"] {
        let claim = claim(&evidence, part);
        assert!(claim.found.contains("not grown on this ramp"), "{}", claim.found);
        let Verdict::Under(condition) = claim.verdict else { panic!("{part}: the trials remain") };
        assert!(condition.contains("in 2 of the 2 combinations"), "{condition}");
    }
    evidence.trials.clear();
    for claim in claims(&evidence) {
        let of_a_ramp = claim.figure.starts_with(['4', '5', '6']);
        assert_eq!(claim.verdict == Verdict::NotReproduced, of_a_ramp, "{}: {}", claim.says, claim.found);
    }
    // One of them is enough.
    evidence.ramps = [cycle(1.0, 0.0), still(39.0), cycle(1.3, 0.2)];
    assert!(claim(&evidence, "are similar").found.contains("mode coupling"));
}

#[test]
fn claims_of_one_ramp_do_not_contradict_each_other() {
    // A kick smaller than what the belt disturbs: 0.4 m/s² become 0.5, which is no growth where 4 m/s² disturb.
    let mut evidence = faithful();
    for (part, size) in evidence.ramps[0].parts.iter_mut().zip([0.4, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5]) {
        part.tangential = [-size, size];
    }
    assert_eq!(verdict(&evidence, "sliding is stable until"), Verdict::Reproduced);
    // A limit cycle that begins late is one.
    evidence.swell = None;
    assert_eq!(verdict(&evidence, "then shrinks"), Verdict::Reproduced);
    let found = claim(&evidence, "beats").found;
    assert!(found.contains("begins below 1 m/s"), "{found}");
    evidence.ramps[0] = still(39.0);
    for part in ["then shrinks", "beats"] {
        let found = claim(&evidence, part).found;
        assert!(found.contains("does not grow: ẍ2 stays within 39.0 m/s², 9.8 times"), "{found}");
    }
}

#[test]
fn a_stable_zone_of_one_acceleration_is_said_to_be_of_that_one() {
    let mut evidence = faithful();
    let other = cycle(1.1, 0.2);
    for (part, straight) in evidence.ramps[1].parts.iter_mut().zip(&other.parts) {
        part.normal = straight.normal;
    }
    assert_eq!(verdict(&evidence, "almost stable zone"), Verdict::Under("of ẍ2 alone".to_owned()));
    let found = claim(&evidence, "almost stable zone").found;
    // Sizes follow the end of a part: nine are the same, the last ends at 2 m/s; a line through the origin is one.
    assert!(found.contains("over 2.25 m/s") && found.contains("R² = 1.0000"), "{found}");
}

#[test]
fn a_course_that_ends_with_its_largest_is_no_line() {
    let mut evidence = faithful();
    evidence.ramps[1] = ramp(|v| (1000.0 / (0.1 + v), 1.0, 0.2));
    let found = claim(&evidence, "almost stable zone").found;
    assert!(found.contains("ẍ2 is largest at the end of the ramp") && !found.contains("NaN"), "{found}");
    assert!(found.contains("ÿ1 falls to 100 %") && found.contains("R² = 1.0000"), "{found}");
    assert_eq!(verdict(&evidence, "almost stable zone"), Verdict::NotReproduced);
}

#[test]
fn a_phase_that_tells_the_mechanism_in_the_limit_cycle_alone_is_said_to() {
    let mut evidence = faithful();
    evidence.phase_trial = trial_of_phase([4, 9], [0, 10]);
    let Verdict::Under(condition) = verdict(&evidence, "tells a negative slope") else {
        panic!("the cycle does")
    };
    assert!(condition.contains("limit cycle"), "{condition}");
    let found = claim(&evidence, "tells a negative slope").found;
    assert!(found.contains("right on 60 and 90 %") && found.contains("right on 100 and 100 %"), "{found}");
    assert_eq!(LIMITS.critical_friction.to_bits(), 0.22_f64.to_bits(), "what the paper prints");
}
