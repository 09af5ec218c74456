//! Eigenvalues: the figures of physics.md section 6 and a Schur oracle.

use crate::common::{close, constant, instance, near, paper};
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::analyse;

#[test]
fn table_of_the_paper_to_1e_6() {
    let rows = [
        (0.15, 0.05, 6.0, -0.021_847_53, 33.260_271_95, 0.001_372, -0.021_847_53, -0.021_714_01),
        (0.15, 0.05, 3.0, 4.734_497_34, 33.296_422_62, -27.053_167, -0.021_972_96, 4.280_319_75),
        (0.4, 0.4, 3.0, 4.338_989_74, 33.949_151_20, -40.738_935, 4.338_989_74, -0.021_714_01),
        (0.4, 0.3, 3.0, 6.855_996_09, 33.579_134_84, -42.428_705, 3.506_818_02, 4.269_566_35),
        (0.07, 0.02, 3.0, 2.233_027_54, 33.235_905_65, -13.126_833, -0.021_819_09, 2.127_434_19),
        (0.8, 0.8, 3.0, 7.890_499_89, 33.935_624_30, -56.418_074, 7.890_499_89, -0.021_714_01),
    ];
    for (mu_s, mu_d, velocity, growth, frequency, phase, flat, frozen) in rows {
        let (_, linear) = analyse(&paper(mu_s, mu_d, velocity));
        let linear = linear.expect("an equilibrium");
        let case = format!("({mu_s}, {mu_d}) at {velocity} m/s");
        close(&format!("growth {case}"), linear.growth_rate, growth, 1e-6);
        close(&format!("frequency {case}"), linear.frequency.expect("a frequency"), frequency, 1e-9);
        near(&format!("phase {case}"), linear.phase.expect("a phase"), phase, 1e-6);
        close(&format!("flat {case}"), linear.growth_rate_flat, flat, 1e-6);
        close(&format!("frozen {case}"), linear.growth_rate_frozen, frozen, 1e-6);
    }
}

fn type_of(mu_s: f64, mu_d: f64, velocity: f64) -> Option<InstabilityType> {
    analyse(&paper(mu_s, mu_d, velocity)).0
}

#[test]
fn the_paper_cases_have_their_types() {
    assert_eq!(type_of(0.15, 0.05, 3.0), Some(InstabilityType::NegativeSlope));
    assert_eq!(type_of(0.15, 0.05, 6.0), Some(InstabilityType::Stable));
    assert_eq!(type_of(0.4, 0.4, 3.0), Some(InstabilityType::ModeCoupling));
    assert_eq!(type_of(0.4, 0.3, 3.0), Some(InstabilityType::Coexistence));
    assert_eq!(type_of(0.07, 0.02, 3.0), Some(InstabilityType::NegativeSlope));
    assert_eq!(type_of(0.8, 0.8, 3.0), Some(InstabilityType::ModeCoupling));
    assert_eq!(type_of(0.4, 0.4, 0.0), Some(InstabilityType::Sticking));
}

/// The friction coefficient of a constant law at which the growth rate changes sign.
fn critical_mu(values: &[(Param, f64)], mut low: f64, mut high: f64) -> f64 {
    let growth = |mu: f64| {
        let mut all = vec![(Param::BeltVelocity, 3.0)];
        all.extend_from_slice(values);
        analyse(&instance(constant(mu), &all)).1.expect("an equilibrium").growth_rate
    };
    assert!(growth(low) < 0.0 && growth(high) > 0.0, "{values:?}: no change of sign");
    while high - low > 1e-15 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if growth(middle) > 0.0 { high = middle } else { low = middle }
    }
    high
}

#[test]
fn critical_friction_and_the_destabilisation_paradox() {
    near("Table 1", critical_mu(&[], 0.1, 0.4), 0.226_361_157_99, 1e-10);
    let damping = |c1, c2| critical_mu(&[(Param::C1, c1), (Param::C2, c2)], 0.001, 0.6);
    near("(1, 0.1)", damping(1.0, 0.1), 0.083_281_5, 5e-8);
    near("(0.1, 1)", damping(0.1, 1.0), 0.084_467_8, 5e-8);
    near("(10, 0.1)", damping(10.0, 0.1), 0.019_263_5, 5e-8);
    near("(10, 10)", damping(10.0, 10.0), 0.273_094_0, 5e-8);
}

#[test]
fn undamped_coalescence_against_the_closed_form() {
    for (theta, expected, digits) in [
        (0.005, 0.437_701, 5e-7),
        (0.01, 0.226_361_594_06, 1e-10),
        (0.02, 0.128_205, 5e-7),
        (0.05, 0.093_383_3, 5e-7),
        (0.1, 0.122_114, 5e-7),
    ] {
        let unstable = |mu: f64| {
            let values =
                [(Param::BeltVelocity, 3.0), (Param::C1, 0.0), (Param::C2, 0.0), (Param::Theta, theta)];
            let (kind, linear) = analyse(&instance(constant(mu), &values));
            (kind == Some(InstabilityType::ModeCoupling), linear.expect("an equilibrium").frequency)
        };
        let (mut low, mut high) = (theta.tan() + 0.01, 0.6);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if unstable(middle).0 { high = middle } else { low = middle }
        }
        near(&format!("coalescence at θ = {theta}"), high, expected, digits);
        if digits < 1e-9 {
            near("its frequency", unstable(high).1.expect("a frequency"), 33.954_934_41, 1e-5);
        }
    }
}

#[test]
fn smallest_destabilising_slope() {
    use squealmap::model::friction::FrictionLaw;
    for (mu, expected) in [(0.02, 9.8907e-5), (0.05, 9.5239e-5), (0.10, 8.7404e-5), (0.20, 5.3223e-5)] {
        // A bilinear law that falls with `slope` and has the value mu at V.
        let growth = |slope: f64| {
            let (velocity, knee) = (3.0, 5.0);
            let law = FrictionLaw::Bilinear {
                mu_s: mu + slope * velocity,
                mu_d: mu + slope * (velocity - knee),
                knee_velocity: knee,
            };
            analyse(&instance(law, &[(Param::BeltVelocity, velocity)])).1.expect("one").growth_rate
        };
        let (mut low, mut high) = (0.0, 1e-3);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if growth(middle) > 0.0 { high = middle } else { low = middle }
        }
        close(&format!("slope at μ = {mu}"), high, expected, 1e-5);
    }
}

#[test]
fn divergence_and_rest() {
    // θ < 0: no sliding equilibrium from μ = −c/s on.
    let values = [(Param::BeltVelocity, 1.0), (Param::Theta, -0.5)];
    let limit = 1.0 / 0.5_f64.tan();
    let below = analyse(&instance(constant(limit * 0.999), &values));
    let above = analyse(&instance(constant(limit * 1.001), &values));
    assert!(below.1.is_some());
    assert_eq!(above, (Some(InstabilityType::Divergence), None));
}
