//! Roots of quartics whose factors are known.

use std::cmp::Reverse;

use crate::common::{close, instance};
use crate::instances::Uniform;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::{analyse, eigenvalues};
use squealmap::model::quartic::roots;

const DRAWN: usize = 20_000;

/// Two modes without damping: their coefficients have no odd powers, and whatever rounding leaves of a difference decided on their
/// roots once.
#[test]
fn without_damping_nothing_grows_and_frequencies_stay_apart() {
    let mut u = Uniform(11);
    for _ in 0..DRAWN {
        let (low, apart) = (u.log(1e-3, 1e5), u.log(1e-4, 1e4));
        let high = low * (1.0 + apart);
        let found = roots([low * low * high * high, 0.0, low * low + high * high, 0.0, 1.0]);
        assert!(found.iter().all(|root| root.re == 0.0), "{low} and {high}: {found:?}");
        let mut turns = found.map(|root| root.im);
        turns.sort_by(f64::total_cmp);
        for (turn, expected) in turns.into_iter().zip([-high, -low, low, high]) {
            close(&format!("{low} and {high}"), turn, expected, 1e-15 * (10.0 + 1.0 / apart));
        }
    }
}

/// A little damping, or driving: the real part of each root is half a coefficient of its factor, and keeps its digits.
#[test]
fn small_real_parts_keep_their_digits() {
    let mut u = Uniform(12);
    for _ in 0..DRAWN {
        let (low, apart) = (u.log(1.0, 1e4), u.log(0.01, 1e3));
        let high = low * (1.0 + apart);
        let rates = [(); 2].map(|()| u.log(1e-12, 1e-2));
        let ([p, r], [q, s]) = ([2.0 * rates[0] * low, 2.0 * rates[1] * high], [low * low, high * high]);
        let mut found = roots([q * s, q * r + p * s, q + p * r + s, p + r, 1.0]);
        found.sort_by_key(|root| Reverse(root.im.abs().to_bits()));
        // Sums of two dampings know the smaller one as far as they have digits.
        let digits = 1e-14 * (1.0 + 1.0 / apart) * (p + r).max(q * r / s + p);
        for (root, (p, size)) in found.into_iter().zip([(r, high), (r, high), (p, low), (p, low)]) {
            let wrong = (root.re + 0.5 * p).abs();
            assert!(wrong <= digits, "{root} for {}, {size}: {wrong:e} and {digits:e}", -0.5 * p);
        }
    }
}

#[test]
fn strong_dampings_have_real_roots_of_every_size() {
    let mut u = Uniform(13);
    for _ in 0..DRAWN {
        let mut sizes = [(); 4].map(|()| u.log(1e-6, 1e6));
        sizes.sort_by(f64::total_cmp);
        let [a, b, c, d] = sizes;
        if sizes.windows(2).any(|pair| pair[1] < 1.5 * pair[0]) {
            continue;
        }
        let pairs = a * b + a * c + a * d + b * c + b * d + c * d;
        let triples = a * b * c + a * b * d + a * c * d + b * c * d;
        let mut found = roots([a * b * c * d, triples, pairs, a + b + c + d, 1.0]);
        found.sort_by(|one, other| other.re.total_cmp(&one.re));
        for (root, size) in found.into_iter().zip(sizes) {
            assert!(root.im == 0.0, "{sizes:?}: {root}");
            close(&format!("{sizes:?}"), root.re, -size, 1e-12);
        }
    }
}

/// The frequencies of a structure without damping stand in the matrices themselves: a quadratic in the square of the frequency.
#[test]
fn a_structure_without_damping_has_its_two_frequencies() {
    let [m1, m2, k1, k2, theta] = [4.0, 0.45, 7e4, 5.5e6, 0.5_f64];
    let (s, c) = theta.sin_cos();
    for step in 0..=160 {
        let mu = 0.005 * f64::from(step);
        let law = FrictionLaw::Rational { mu_s: mu, decay: 0.0 };
        let values = [
            (Param::M1, m1),
            (Param::M2, m2),
            (Param::K1, k1),
            (Param::K2, k2),
            (Param::C1, 0.0),
            (Param::C2, 0.0),
            (Param::Theta, theta),
            (Param::BeltVelocity, 1.0),
        ];
        let instance = instance(law, &values);
        // (K11 − M11 w)(k2 − m1 w) = K12 k2, K12 = s (s − μ c) k2, w = ω².
        let mass = m2 + m1 * c * (c + mu * s);
        let stiffness = k1 * c * (c + mu * s) + k2 * s * (s - mu * c);
        let (one, two) = (stiffness * m1 + mass * k2, k1 * c * (c + mu * s) * k2);
        let root = (one * one - 4.0 * mass * m1 * two).sqrt();
        assert!(root > 0.0, "below the coalescence");
        let high = 0.5 * (one + root) / (mass * m1);
        let squares = [two / (mass * m1) / high, high];
        let mut turns = eigenvalues(&instance).expect("it slides").map(|lambda| lambda.im.abs());
        turns.sort_by(f64::total_cmp);
        close(&format!("low at {mu}"), turns[0], squares[0].sqrt(), 1e-12);
        close(&format!("high at {mu}"), turns[3], squares[1].sqrt(), 1e-12);
        let (kind, linear) = analyse(&instance);
        assert_eq!(kind, Some(InstabilityType::Stable), "{mu}");
        assert!(linear.expect("it slides").growth_rate == 0.0, "{mu}");
    }
}
