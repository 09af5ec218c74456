//! Fourier components put together from stretches at guessed frequencies, against integrals over the window.

use num_complex::Complex64;

use squealmap::engine::lanes::spectrum::{COMPONENTS, MOMENTS};
use squealmap::engine::lanes::stretches::Stretches;

const OMEGA: f64 = 1.3;
const START: f64 = 2.0;

/// Two signals with a common frequency, a harmonic and something slow.
fn signals(t: f64) -> [f64; 2] {
    let angle = OMEGA * t;
    [angle.cos() + 0.3 * (2.0 * angle + 0.4).sin(), 0.5 * (angle + 1.1).cos() + 0.05 * (0.11 * t).sin()]
}

/// `∫ f` by Simpson's rule.
fn integral(from: f64, to: f64, f: impl Fn(f64) -> Complex64) -> Complex64 {
    let n = 4000;
    let h = (to - from) / f64::from(n);
    (0..=n)
        .map(|i| {
            let weight = if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            f(from + h * f64::from(i)) * (weight * h / 3.0)
        })
        .sum()
}

/// What the engine sums over a stretch up to `end`.
fn sums(guess: f64, [middle, half]: [f64; 2], from: f64, end: f64) -> [f64; COMPONENTS] {
    let mut sums = [0.0; COMPONENTS];
    for m in 0..MOMENTS {
        for signal in 0..2 {
            let z = integral(from, end, |t| {
                let power = (0..m).fold(1.0, |power, _| power * (t - middle) / half);
                Complex64::cis(-guess * (t - middle)) * signals(t)[signal] * power
            });
            sums[4 * m + 2 * signal] = z.re;
            sums[4 * m + 2 * signal + 1] = z.im;
        }
    }
    sums
}

/// Ten stretches; the last crossing is in the last but one.
fn stretches(error: f64) -> (Stretches, f64) {
    let (length, last) = (20.0, START + 9.3 * 20.0);
    let mut all = Stretches::default();
    for i in 0..11 {
        let from = START + length * f64::from(i);
        let place = [from + 0.5 * length, 0.5 * length];
        let guess = OMEGA * (1.0 + error * f64::from(i % 3 - 1));
        let noted = (last < from + length && last > from || i < 9)
            .then(|| sums(guess, place, from, last.min(from + 0.9 * length)));
        all.push(guess, place, sums(guess, place, from, from + length), noted);
    }
    (all, last)
}

fn components(stretches: &Stretches) -> Option<[Complex64; 2]> {
    stretches
        .components(OMEGA, START, [1.0, 0.5], 1e-3)
        .map(|both| both.map(|[re, im]| Complex64::new(re, im)))
}

#[test]
fn guesses_of_the_frequency_are_corrected() {
    let (_, last) = stretches(0.0);
    let exact =
        [0, 1].map(|i| integral(START, last, |t| Complex64::cis(-OMEGA * (t - START)) * signals(t)[i]));
    for (error, allowed) in [(0.0, 1e-7), (1e-4, 1e-6), (3e-3, 1e-3)] {
        let found = components(&stretches(error).0).expect("the guesses are good");
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).norm() < allowed * exact.norm(), "{error:e}: {found} {exact}");
        }
    }
}

#[test]
fn bad_guesses_are_not_used() {
    assert!(components(&stretches(0.05).0).is_none());
}

#[test]
fn a_stretch_in_a_wrong_place_is_seen() {
    let (mut all, last) = stretches(0.0);
    let place = [START + 215.0, 10.0];
    let z = sums(OMEGA, place, START + 220.0, START + 240.0);
    all.push(OMEGA, place, z, Some(z));
    let exact = integral(START, last, |t| Complex64::cis(-OMEGA * (t - START)) * signals(t)[0]);
    let found = components(&all).expect("the guess is good")[0];
    assert!((found - exact).norm() > 0.01 * exact.norm());
}

#[test]
fn without_a_crossing_there_is_nothing() {
    let mut all = Stretches::default();
    all.push(OMEGA, [10.0, 10.0], [1.0; COMPONENTS], None);
    assert!(components(&all).is_none());
}

#[test]
fn a_last_crossing_that_was_missed_is_not_used() {
    let (mut all, _) = stretches(0.0);
    assert!(components(&all).is_some());
    all.forget();
    assert!(components(&all).is_none());
}
