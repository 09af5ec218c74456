//! Extremes give a status, never a panic, a hang or silent nonsense.

use crate::common::{bilinear, close, constant, instance, near, paper, plan};
use crate::engines::Engine;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Plan, StartKind};
use squealmap::engine::reference::respond::respond;
use squealmap::engine::regime::{Regime, regime};
use squealmap::model::Param;
use squealmap::model::friction::{FrictionLaw, MuTable};
use squealmap::model::instance::Instance;
use squealmap::model::linear::analyse;
use squealmap::model::status::Status;

fn run(instance: &Instance) -> Outcome {
    respond(instance, &plan(0.5, 0.5, 12))
}

/// A completed outcome with every number finite and the requested time simulated.
fn complete(instance: &Instance) -> Outcome {
    let outcome = run(instance);
    assert_eq!(outcome.status, Status::Ok, "{instance:?}");
    near("simulated time", outcome.simulated_time, 1.0, 1e-12);
    for value in [outcome.x2_mean, outcome.x2_std, outcome.ax_rms, outcome.ay_rms, outcome.n_peak] {
        assert!(value.is_some_and(f64::is_finite), "{outcome:?}");
    }
    outcome
}

fn with(base: &Instance, values: &[(Param, f64)]) -> Instance {
    let mut instance = base.clone();
    for &(param, value) in values {
        instance.params.set(param, value);
    }
    instance
}

#[test]
fn belt_at_rest() {
    let outcome = complete(&paper(0.4, 0.3, 0.0));
    // The friction force of 0.4 kN stops the kick of 10 mm/s at once, and for good.
    assert!(outcome.stick.expect("a fraction") > 0.999);
    assert_eq!(regime(&outcome, 0.0, false).0, Regime::Stuck);
    // Without friction, damping and belt the mass oscillates for ever: amplitude v/ω, reversing.
    let free = instance(
        constant(0.0),
        &[(Param::BeltVelocity, 0.0), (Param::Theta, 0.0), (Param::C1, 0.0), (Param::C2, 0.0)],
    );
    let outcome = complete(&free);
    let omega = (100_000.0_f64 / 2.3).sqrt();
    close("frequency", outcome.response_frequency.expect("one"), omega / std::f64::consts::TAU, 1e-9);
    near("reversed half the time", outcome.reverse.expect("a fraction"), 0.5, 0.02);
    close("peak", outcome.ax_peak.expect("a peak"), 0.01 * omega, 1e-5);
}

/// However small the kick: friction stops it within `v²`, at most once on each side of the equilibrium, and holds it.
#[test]
fn a_kick_on_a_belt_at_rest_ends_in_rest() {
    for theta in [0.0, 0.01, 0.3] {
        for kick in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
            let one = with(&paper(0.4, 0.3, 0.0), &[(Param::Theta, theta), (Param::StartVelocity, kick)]);
            for engine in Engine::ALL {
                let outcome = engine.run(&one, &plan(0.5, 0.5, 12));
                let name = engine.name();
                assert_eq!(
                    (outcome.status, outcome.stick),
                    (Status::Ok, Some(1.0)),
                    "{name} θ = {theta}, {kick}"
                );
                assert_eq!(outcome.x2_std, Some(0.0), "{name} θ = {theta}, {kick}");
            }
        }
    }
}

/// A run of more steps than a kernel counts is refused at once.
#[test]
fn a_run_without_end_is_refused() {
    for engine in Engine::ALL {
        let outcome = engine.run(&paper(0.4, 0.3, 3.0), &plan(1e8, 1.0, 12));
        assert_eq!((outcome.status, outcome.steps), (Status::StepTooLarge, 0), "{}", engine.name());
    }
}

#[test]
fn no_damping_no_friction_no_inclination() {
    for base in [
        instance(constant(0.3), &[(Param::BeltVelocity, 1.0), (Param::Theta, 0.0)]),
        instance(constant(0.0), &[(Param::BeltVelocity, 1.0)]),
        with(&paper(0.4, 0.3, 3.0), &[(Param::C1, 0.0), (Param::C2, 0.0)]),
        with(&paper(0.4, 0.3, 1e-6), &[]),
        with(&paper(0.4, 0.3, 1e3), &[]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::Theta, -0.3)]),
        with(&paper(0.3, 0.2, 3.0), &[(Param::Theta, 1.2)]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::M2, 1e-6)]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::K2, 1e9)]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::FExt, 1e-9)]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::FExt, 1e9)]),
        with(&paper(0.4, 0.4, 3.0), &[(Param::C1, 1e5), (Param::C2, 1e5)]),
        instance(bilinear(1.0, 0.0), &[(Param::BeltVelocity, 1e-3)]),
    ] {
        complete(&base);
    }
}

#[test]
fn a_slope_of_1000_s_per_m() {
    let law = FrictionLaw::Bilinear { mu_s: 1.0, mu_d: 0.0, knee_velocity: 1e-3 };
    let instance = instance(law, &[(Param::BeltVelocity, 5e-4)]);
    let (_, linear) = analyse(&instance);
    // Far above the spring: growth → slope N/(m1 + m2) with a real eigenvalue.
    let linear = linear.expect("an equilibrium");
    close("growth", linear.growth_rate, 1000.0 * 1000.0 / 2.3, 0.02);
    assert_eq!((linear.frequency, linear.phase), (Some(0.0), None));
    complete(&instance);
}

#[test]
fn elastic_impacts_reach_the_end() {
    for restitution in [0.5, 0.9, 0.99, 1.0] {
        let instance = with(
            &paper(0.4, 0.4, 6.9),
            &[(Param::Restitution, restitution), (Param::StartDisplacement, 0.02)],
        );
        let outcome = run(&instance);
        match outcome.status {
            Status::Ok => near("simulated time", outcome.simulated_time, 1.0, 1e-12),
            // Bounces that never lose speed may chatter without end.
            Status::EventLimit => assert!(restitution > 0.99 && outcome.simulated_time < 1.0),
            other => panic!("{other:?} at e = {restitution}"),
        }
    }
}

#[test]
fn painleve_is_reported() {
    let theta = std::f64::consts::FRAC_PI_4;
    let base = instance(constant(1.5), &[(Param::Theta, theta), (Param::BeltVelocity, 0.5)]);
    // A start faster than the belt slips in reverse, where M11 < 0 from μ = 1.1698 on.
    let reverse = with(&base, &[(Param::StartVelocity, 2.0)]);
    let outcome = run(&reverse);
    assert_eq!(outcome.status, Status::Painleve);
    assert_eq!(outcome.x2_std, None);
    assert!(outcome.simulated_time < 1.0);
    // Below the limit the same start runs.
    let below = Instance { law: constant(1.1), ..reverse };
    assert_ne!(run(&below).status, Status::Painleve);
}

/// Sliding that never reverses runs on, whatever reversed slip would do; a law that falls by next to nothing is a constant one.
#[test]
fn what_reversed_slip_would_do_ends_no_run() {
    let values = [
        (Param::Theta, 1.186_590_559_226_814_4),
        (Param::M2, 0.057_433_456_923_756_315),
        (Param::K2, 229_649.655_647_752_93),
        (Param::BeltVelocity, 1.094),
        (Param::StartVelocity, 0.010_94),
    ];
    let [flat, falling] = [constant(0.5958), bilinear(0.5958, 0.595_799)].map(|law| instance(law, &values));
    for engine in Engine::ALL {
        let [flat, falling] = [&flat, &falling]
            .map(|one| engine.run(one, &Plan { start: StartKind::Kick, ..plan(0.2, 0.2, 12) }));
        assert_eq!([flat.status, falling.status], [Status::Ok; 2], "{}", engine.name());
        let [flat, falling] = [flat, falling].map(|one| one.x2_std.expect("a motion"));
        near(engine.name(), falling / flat, 1.0, 1e-2);
    }
}

/// In a thin layer of friction that grows as the body slows down, M11 falls from 15 to 0 before the body comes to rest: another
/// integrator, in which the relative velocity is the independent variable, meets that at 0.142809778 s. A step that jumps over
/// it to the rest has passed what has no solution.
#[test]
fn what_passes_the_singularity_is_painleve() {
    let values = [
        (Param::Theta, -0.9),
        (Param::M1, 66.327_729_085_398_93),
        (Param::M2, 2.290_743_039_378_798),
        (Param::K1, 63_207.937_671_933_17),
        (Param::K2, 17_575.751_230_207_603),
        (Param::C1, 400.0),
        (Param::C2, 400.0),
        (Param::FExt, 5.731_314_947_718_468),
        (Param::BeltVelocity, 0.227_875_931_650_275_25),
        (Param::StartVelocity, 2.357_926_324_294_166_6),
    ];
    let law = FrictionLaw::Bilinear {
        mu_s: 1.278_510_241_234_278_6,
        mu_d: 0.396_478_215_251_073_3,
        knee_velocity: 0.005_307_199_524_510_54,
    };
    let one = instance(law, &values);
    for engine in Engine::ALL {
        for steps in [6, 8, 12, 16, 20, 30, 60] {
            let outcome = engine.run(&one, &plan(1.0, 1.0, steps));
            let what = format!("{} with {steps} steps", engine.name());
            assert_eq!(outcome.status, Status::Painleve, "{what}");
            near(&what, outcome.simulated_time, 0.142_809_778, 2e-5);
        }
    }
}

#[test]
fn no_equilibrium_and_invalid_law_are_reported() {
    let divergent = instance(constant(2.0), &[(Param::Theta, -0.5), (Param::BeltVelocity, 1.0)]);
    assert_eq!(run(&divergent).status, Status::NoEquilibrium);
    let law = FrictionLaw::Constant { mu_s: 0.2, mu_d: 0.3 };
    assert_eq!(run(&instance(law, &[(Param::BeltVelocity, 1.0)])).status, Status::InvalidLaw);
}

/// Coefficients of the characteristic polynomial beyond all numbers are told, and no eigenvalues that are none.
#[test]
fn a_polynomial_beyond_numbers_has_no_eigenvalues() {
    let heavy = with(
        &paper(0.3, 0.3, 1.0),
        &[(Param::Theta, 0.0), (Param::M1, 0.1), (Param::M2, f64::MAX), (Param::K2, 1e290)],
    );
    assert_eq!(analyse(&heavy), (None, None));
    // A factor in all coefficients changes nothing, however large.
    let large = with(
        &paper(0.4, 0.4, 3.0),
        &[Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2]
            .map(|param| (param, 1e140 * paper(0.4, 0.4, 3.0).params.require(param))),
    );
    let (a, b) = (analyse(&paper(0.4, 0.4, 3.0)).1, analyse(&large).1);
    close("growth", b.expect("one").growth_rate, a.expect("one").growth_rate, 1e-12);
}

#[test]
fn a_step_beyond_the_finest_is_reported() {
    let stiff = with(&paper(0.4, 0.4, 3.0), &[(Param::K2, 1e16), (Param::M2, 1e-3)]);
    let outcome = respond(&stiff, &plan(0.001, 0.001, 4));
    assert_eq!(outcome.status, Status::StepTooLarge);
}

#[test]
fn rising_and_tabulated_laws() {
    let rising = paper(0.2, 0.4, 3.0);
    complete(&rising);
    // A table that is the bilinear law gives its numbers.
    let table = |knots: &[(f64, f64)]| {
        let (velocity, mu) = knots.iter().copied().unzip();
        FrictionLaw::Table(std::sync::Arc::new(MuTable { velocity, mu }))
    };
    let tabulated = Instance { law: table(&[(0.0, 0.4), (2.5, 0.35), (5.0, 0.3)]), ..paper(0.4, 0.3, 3.0) };
    let (a, b) = (complete(&paper(0.4, 0.3, 3.0)), complete(&tabulated));
    close("std x2", b.x2_std.expect("a value"), a.x2_std.expect("a value"), 1e-9);
    let (a, b) = (analyse(&paper(0.4, 0.3, 3.0)).1, analyse(&tabulated).1);
    close("growth", b.expect("one").growth_rate, a.expect("one").growth_rate, 1e-12);
}

#[test]
fn units_do_not_matter() {
    // The same motion with the force scaled by 1e6: lengths and velocities scale, fractions stay.
    let small = with(&paper(0.4, 0.4, 3.0), &[(Param::StartVelocity, 0.01)]);
    let large = with(&small, &[(Param::FExt, 1e9), (Param::BeltVelocity, 3e6), (Param::StartVelocity, 1e4)]);
    let (a, b) = (complete(&small), complete(&large));
    close("std x2", b.x2_std.expect("a value"), 1e6 * a.x2_std.expect("a value"), 1e-6);
    close("stick", b.stick.expect("a value"), a.stick.expect("a value"), 1e-6);
}

#[test]
fn mode_start_without_a_mode_rests() {
    let at_rest = paper(0.4, 0.3, 0.0);
    let mode = Plan { start: StartKind::Mode, ..plan(0.5, 0.5, 12) };
    let outcome = respond(&at_rest, &mode);
    assert_eq!((outcome.status, outcome.stick), (Status::Ok, Some(1.0)));
}
