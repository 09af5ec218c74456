//! 200 synthetic strokes whose type and phase are known: the requirements on `identify`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::study::judged::{GOOD, Judged, SEED, confident, phase_errors, table, within};
use crate::study::strokes::Wanted;
use squealmap_identify::Kind;

#[test]
fn two_hundred_strokes() {
    let judged = table(SEED);
    assert_eq!(judged.len(), 200);
    let good: Vec<&Judged> = judged.iter().filter(|stroke| stroke.ratio >= GOOD).collect();
    for stroke in &good {
        let found = stroke.found.as_ref().map(|found| &found.verdict);
        assert!(!stroke.wrong(), "{:?} at {} dB called {found:?}", stroke.wanted, stroke.ratio);
    }
    assert!(confident(&good) >= 80, "{} % confident", confident(&good));
    for ratio in [40.0, 30.0, 20.0] {
        let (_, median, count) = phase_errors(&judged, ratio);
        assert!(median <= 1.0 && count >= 8, "{ratio} dB: phase off by {median}° in the median of {count}");
    }
    for stroke in &good {
        let [off, error] = stroke.phase().unwrap_or_default();
        assert!(!stroke.phase_is_bad(), "{off} ± {error}° where {}° is possible", stroke.bound);
    }
    // The judge itself turns red: a verdict against the truth, and a wrong phase.
    let right = judged.into_iter().find(|stroke| stroke.kind() == Some(Kind::ModeCoupling)).unwrap();
    assert!(!right.wrong());
    let right = Judged { skew_known: true, bound: 0.5, ..right };
    let true_phase = right.true_phase + 180.0;
    let wrong = Judged { wanted: Wanted::Slope, true_phase, ..right };
    assert!(wrong.wrong() && wrong.phase_is_bad());
}

/// The stated standard errors are those of the phases: 95 % within two, not all within one, and near what is possible.
#[test]
fn phases_are_as_uncertain_as_they_say() {
    let judged: Vec<Judged> = [2, 3, 4].into_iter().flat_map(table).collect();
    let judged: Vec<Judged> = judged.into_iter().filter(|stroke| stroke.ratio >= GOOD).collect();
    let ((two, count), (one, _)) = (within(&judged, 2.0), within(&judged, 1.0));
    assert!(count > 100 && (0.92..=0.99).contains(&two), "{two} of {count} within two standard errors");
    assert!((0.6..=0.82).contains(&one), "{one} of {count} within one standard error");
    let mut over: Vec<f64> = judged.iter().filter_map(|s| Some(s.phase_error()?.abs() / s.bound)).collect();
    over.sort_by(f64::total_cmp);
    // Of a normal distribution half lies within 0.67 standard errors.
    let median = over[over.len() / 2];
    assert!((0.5..=0.9).contains(&median), "errors are {median} times the least possible in the median");
    // Phases 1° further off have other standard errors: the judge notices.
    let mut shifted = judged;
    for stroke in &mut shifted {
        stroke.true_phase += 1.0;
    }
    assert!(within(&shifted, 2.0).0 < 0.92);
}
