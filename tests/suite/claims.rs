//! The paper's claims: verdicts follow from the numbers. Results that contradict a claim change its verdict.

use squealmap::paper::{Evidence, LIMITS, Phase, PhaseTrial, RampFacts, Stretch, Trial, Verdict, claims};

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

/// Results that bear out every claim.
fn faithful() -> Evidence {
    let trial = |kick: f64| Trial {
        duration: 2.0,
        kick,
        disturbance: 4.0,
        peaks: [Some([400.0, 100.0]), Some([410.0, 300.0]), Some([500.0, 350.0])],
    };
    let phase =
        |angle| Phase { eigenvector: angle, measured: angle, growth_rate: 4.0, growth_rate_measured: 4.0 };
    Evidence {
        critical_friction: Some(0.222),
        coalescence_frequency: Some(33.9),
        critical_velocity: Some(5.0),
        knee_velocity: 5.0,
        ramps: [cycle(1.0, 0.0), cycle(1.1, 0.2), cycle(1.3, 0.2)],
        swell: Some(0.4),
        phases: [phase(-5.0), phase(-85.0)],
        trials: vec![trial(1e-4), trial(1e-5)],
        phase_trial: PhaseTrial { witnesses: Vec::new() },
    }
}

/// The claim whose words contain `part`.
fn verdict(evidence: &Evidence, part: &str) -> Verdict {
    let mut found = claims(evidence).into_iter().filter(|claim| claim.says.contains(part));
    let claim = found.next().expect("a claim of these words");
    assert!(found.next().is_none(), "{part} is ambiguous");
    claim.verdict
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
    ("sliding is stable until", |e| e.ramps[0] = ramp(|_| (4.0, 1.0, 0.0))),
    // No growth; a limit cycle that swells again; one that keeps its size.
    ("then shrinks", |e| e.ramps[0] = ramp(|_| (4.0, 1.0, 0.0))),
    ("then shrinks", |e| e.ramps[0].parts[22].tangential = [-190.0, 190.0]),
    ("then shrinks", |e| e.ramps[0] = ramp(|v| (if v < 4.0 { 200.0 } else { 4.0 }, 1.0, 0.0))),
    ("beats", |e| e.swell = Some(0.05)),
    ("beats", |e| e.swell = None),
    // No flight; growth to the end; no growth.
    ("saturates", |e| e.ramps[1] = cycle(1.1, 0.0)),
    ("saturates", |e| e.ramps[1] = ramp(|v| (1000.0 / (0.1 + v), 1.0, 0.2))),
    ("saturates", |e| e.ramps[1] = ramp(|_| (4.0, 1.0, 0.2))),
    ("in phase", |e| e.phases[0].measured = 30.0),
    ("in phase", |e| e.phases[0].eigenvector = -170.0),
    ("in quadrature", |e| e.phases[1].eigenvector = -20.0),
    ("in quadrature", |e| e.phases[1].measured = -160.0),
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
fn quadrature_may_be_read_as_nearer_to_it() {
    let mut evidence = faithful();
    evidence.phases[1].eigenvector = -60.0;
    assert!(matches!(verdict(&evidence, "in quadrature"), Verdict::Under(_)));
    assert_eq!(LIMITS.critical_friction.to_bits(), 0.22_f64.to_bits(), "what the paper prints");
}
