//! The scenes: every parameter from one end of its range to the other.

use super::scene::{
    Group, Scene, as_reference, as_reference_over, ends, layer, periods, sliding, sliding_under, stick_slip,
};
use crate::common::{bilinear, constant};
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::status::Status;

/// Undamped coalescence of Table 1, the root of its closed form.
const COALESCENCE: f64 = 0.226_361_594_06;

pub(crate) fn groups() -> Vec<Group> {
    vec![
        Group {
            title: "Sliding without an event",
            source: "Deviations and accelerations of a small kick, x2 and y1, from the matrix exponential of the \
                     equations; 20 periods before the window and 20 in it, θ = 0.1, μ = 0.1 unless said otherwise.",
            scenes: slides(),
        },
        Group {
            title: "Stick-slip of the single mass",
            source: "θ = 0, no damping, μ_d = 0.3: share of stick, frequency and acceleration of the closed form.",
            scenes: stick_slips(),
        },
        Group {
            title: "Layers near rest",
            source: "Friction that falls or rises within a small part of the belt's velocity, 2 m/s, θ = 0.1: deviation, acceleration, its \
                     peak, and impacts per second. The same as the reference with 60 steps per period; its own column is that against 12.",
            scenes: layers(),
        },
        Group {
            title: "Flight and impact",
            source: "The same as the reference with 60 steps per period; its own column is that against 12. Chaotic \
                     motions are left out: above e = 0.95 they part whatever the step.",
            scenes: impacts(),
        },
        Group {
            title: "What is refused",
            source: "The status that the equations ask for.",
            scenes: refused(),
        },
    ]
}

fn slides() -> Vec<Scene> {
    let slide = |name: &str, values: &[(Param, f64)]| sliding(name, 0.1, 20.0, values);
    let mut all = Vec::new();
    for theta in [-1.4, -0.3, 0.0, 1e-6, 0.3, 1.0, 1.2, 1.4] {
        all.push(slide(&format!("θ = {theta}"), &[(Param::Theta, theta), (Param::StartVelocity, 1e-4)]));
    }
    for ratio in [1e-6, 1e-3, 1e2, 1e4] {
        all.push(slide(&format!("k2/k1 = {ratio:e}"), &[(Param::K2, 1e5 * ratio)]));
    }
    // Thousands of steps each.
    all.push(sliding("k2/k1 = 1e6, 2 + 2 periods", 0.1, 2.0, &[(Param::K2, 1e11)]));
    for ratio in [1e-9, 1e-3, 10.0, 1e3] {
        all.push(slide(&format!("m2/m1 = {ratio:e}"), &[(Param::M2, 2.12 * ratio)]));
    }
    for damping in [0.0, 1e2, 1e4] {
        all.push(slide(&format!("c1 = c2 = {damping:e}"), &[(Param::C1, damping), (Param::C2, damping)]));
    }
    let damped = [(Param::C1, 1e5), (Param::C2, 1e5)];
    all.push(sliding("c1 = c2 = 1e5, 4 + 4 periods", 0.1, 4.0, &damped));
    for force in [1e-9, 1e9] {
        let values =
            [(Param::FExt, force), (Param::StartVelocity, 1e-6 * force), (Param::BeltVelocity, 1e-3 * force)];
        all.push(slide(&format!("F_ext = {force:e}, velocities in proportion"), &values));
    }
    for velocity in [1e-6_f64, 1e3] {
        let values = [(Param::BeltVelocity, velocity), (Param::StartVelocity, 1e-3 * velocity.min(1.0))];
        all.push(slide(&format!("V = {velocity:e}"), &values));
    }
    let tiny = [(Param::StartVelocity, 1e-12)];
    all.push(slide("kick of 1e-12 m/s", &tiny));
    // μ and slope at 1 m/s, from the formulas of the laws; flat enough that the motion stays small.
    let decayed = (-0.5_f64).exp();
    let exponential = FrictionLaw::Exponential { mu_s: 0.14, mu_d: 0.1, stribeck_velocity: 2.0 };
    let sloped = [
        ("bilinear", bilinear(0.2, 0.1), [0.18, -0.02]),
        ("exponential", exponential, [0.1 + 0.04 * decayed, -0.02 * decayed]),
        ("rational", FrictionLaw::Rational { mu_s: 0.15, decay: 0.25 }, [0.12, -0.024]),
    ];
    for (law_name, law, at) in sloped {
        all.push(sliding_under(&format!("kick of 1e-12 m/s, {law_name} law"), law, at, 20.0, &tiny));
    }
    // Far above its decay an exponential law is its floor: nothing of the fall is left, however short it was.
    for ratio in [1e3, 1e6] {
        let law = FrictionLaw::Exponential { mu_s: 0.3, mu_d: 0.1, stribeck_velocity: 1.0 / ratio };
        all.push(sliding_under(&format!("exponential law, V = {ratio:e} v_0"), law, [0.1, 0.0], 20.0, &[]));
    }
    let undamped = [(Param::C1, 0.0), (Param::C2, 0.0), (Param::Theta, 0.01)];
    all.push(sliding("defective eigenvalue (coalescence)", COALESCENCE, 20.0, &undamped));
    all.push(sliding("no damping, 2000 periods", 0.1, 1000.0, &undamped));
    let fine = sliding("10 000 steps per period, 2 + 2 periods", 0.1, 2.0, &[]);
    all.push(Scene { plan: periods(2.0, 2.0, 10_000), ..fine });
    all
}

fn stick_slips() -> Vec<Scene> {
    let mut all = Vec::new();
    for velocity in [1e-6, 1e-3, 1.0, 1e3] {
        let name = format!("V = {velocity:e}, F_ext in proportion, μ_s = 0.5");
        all.push(stick_slip(&name, velocity, 1000.0 * velocity, 0.2));
    }
    for (velocity, margin) in [(1e-3, 0.2), (1e-2, 0.2), (0.1, 0.2), (10.0, 0.2), (1.0, 0.01), (1.0, 100.0)] {
        let name = format!("V = {velocity:e}, F_ext = 1000, μ_s − μ_d = {margin}");
        all.push(stick_slip(&name, velocity, 1000.0, margin));
    }
    all
}

fn layers() -> Vec<Scene> {
    let values = [(Param::Theta, 0.1), (Param::BeltVelocity, 2.0), (Param::StartVelocity, 0.01)];
    let exponential = |mu_s: f64, mu_d: f64, width: f64| {
        let law = FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: 2.0 * width };
        layer(&format!("exponential, {mu_s} to {mu_d} within {width:e} V"), law, &values)
    };
    let rational = |width: f64| {
        let law = FrictionLaw::Rational { mu_s: 0.5, decay: 0.5 / width };
        layer(&format!("rational, 0.5 at rest, within {width:e} V"), law, &values)
    };
    vec![
        exponential(0.6, 0.3, 1e-2),
        exponential(0.6, 0.3, 1e-4),
        exponential(0.6, 0.3, 1e-6),
        exponential(0.0, 0.6, 1e-1),
        exponential(0.0, 0.6, 1e-2),
        exponential(0.0, 0.6, 1e-3),
        rational(0.5),
        rational(5.0),
    ]
}

fn impacts() -> Vec<Scene> {
    let base = [(Param::BeltVelocity, 6.9), (Param::StartDisplacement, 0.02)];
    let with = |name: &str, more: &[(Param, f64)]| as_reference(name, constant(0.4), &[&base, more].concat());
    let mut all = Vec::new();
    for restitution in [0.0, 0.5, 0.9] {
        all.push(with(&format!("e = {restitution}"), &[(Param::Restitution, restitution)]));
    }
    let light = |ratio: f64| [(Param::M2, 2.12 * ratio), (Param::BeltVelocity, 3.0)];
    let lightest = [&base[..], &light(1e-6)].concat();
    all.push(as_reference_over([15.0, 10.0], "m2/m1 = 1e-6, 15 + 10 periods", constant(0.4), &lightest));
    for ratio in [1e-3, 1e-2] {
        all.push(with(&format!("m2/m1 = {ratio:e}"), &light(ratio)));
    }
    all
}

fn refused() -> Vec<Scene> {
    let theta = std::f64::consts::FRAC_PI_4;
    let reverse = [(Param::Theta, theta), (Param::BeltVelocity, 0.5), (Param::StartVelocity, 2.0)];
    let belt = [(Param::BeltVelocity, 1.0)];
    let rises = FrictionLaw::Constant { mu_s: 0.2, mu_d: 0.3 };
    vec![
        ends("Painlevé: μ = 1.5 at θ = π/4 in reversed slip", Status::Painleve, constant(1.5), &reverse),
        ends(
            "no equilibrium: μ = 2 at θ = −0.5",
            Status::NoEquilibrium,
            constant(2.0),
            &[(Param::Theta, -0.5), (Param::BeltVelocity, 1.0)],
        ),
        ends("constant law with μ_s < μ_d", Status::InvalidLaw, rises, &belt),
        ends(
            "k2/k1 = 1e16",
            Status::StepTooLarge,
            constant(0.4),
            &[(Param::K2, 1e16), (Param::K1, 1.0), (Param::BeltVelocity, 1.0)],
        ),
        ends(
            "k1 = 1e300",
            Status::NonFinite,
            constant(0.4),
            &[(Param::K1, 1e300), (Param::BeltVelocity, 1.0)],
        ),
        ends(
            "F_ext = 1e-300",
            Status::NonFinite,
            constant(0.4),
            &[(Param::FExt, 1e-300), (Param::BeltVelocity, 1.0)],
        ),
        ends(
            "a ramp of 1e-300 s",
            Status::NonFinite,
            constant(0.4),
            &[(Param::RampDuration, 1e-300), (Param::BeltVelocity, 1.0)],
        ),
    ]
}
