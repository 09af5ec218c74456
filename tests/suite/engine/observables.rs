//! Every observable against closed forms, an integration of the sliding equations written out here, and
//! figures of an independent integration (scipy, DOP853 with located events).

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::common::{bilinear, close, constant, instance, near, plan};
use squealmap::engine::method::taylor::{BeltMotion, Expansion, State};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Plan, StartKind};
use squealmap::engine::reference::respond::respond;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::belt::Springs;
use squealmap::model::contact::{Contact, SLOWEST_REBOUND};
use squealmap::model::friction::{FrictionLaw, MuTable};
use squealmap::model::instance::Instance;
use squealmap::model::scaled::Scaled;
use squealmap::model::status::Status;
use squealmap::sweep::spec::Spec;

/// Steps per period from which on the peak of a harmonic is good to 1e-6.
const PEAK_STEPS: u32 = 12;

fn complete(instance: &Instance, plan: &Plan) -> Outcome {
    let outcome = respond(instance, plan);
    assert_eq!(outcome.status, Status::Ok);
    outcome
}

fn model(instance: &Instance) -> Scaled {
    Scene::new(instance, StartKind::Kick).expect("an equilibrium").model
}

/// The single mass on the belt: θ = 0, so that `x2` and `y1` go their own ways, without damping.
fn single(law: FrictionLaw, values: &[(Param, f64)]) -> Instance {
    let plain = [(Param::Theta, 0.0), (Param::C1, 0.0), (Param::C2, 0.0)];
    instance(law, &[plain.as_slice(), values].concat())
}

/// `ω0` of the single mass with Table 1.
fn omega() -> f64 {
    (100_000.0_f64 / 2.3).sqrt()
}

// Impact

/// The masses `m2 + m1 c²`, `m1 s c`, `m2 + m1 s²` of Table 1, kg.
fn impact_masses(theta: f64) -> (f64, f64, f64) {
    let (s, c) = theta.sin_cos();
    (0.18 + 2.12 * c * c, 2.12 * s * c, 0.18 + 2.12 * s * s)
}

#[test]
fn a_vertical_impact_rebounds_with_the_restitution() {
    for (restitution, approach) in [(0.0, -3.0), (0.25, -3.0), (0.5, -0.8), (0.9, -1e-3), (1.0, -2.0)] {
        let instance =
            single(constant(0.3), &[(Param::BeltVelocity, 3.0), (Param::Restitution, restitution)]);
        let model = model(&instance);
        let impact = model.impact(0.0, approach, 1e3).expect("an impact");
        close("rebound", impact.vy, -restitution * approach, 1e-15);
        // Far from stopping, the belt drags with μ P_n, and P_n = m2 (1 + e) |vy|.
        let (along, _, across) = impact_masses(0.0);
        close("drag", impact.vx, 0.3 * across / along * (1.0 + restitution) * -approach, 1e-14);
    }
}

/// The three cases of friction in an impact with inertia coupling, each against the 2×2 system solved by hand.
#[test]
fn an_oblique_impact_solves_its_equations_within_the_cone() {
    let theta = 0.3;
    let (along, coupling, across) = impact_masses(theta);
    let unit = along;
    let with = |mu: f64| {
        let values = [(Param::Theta, theta), (Param::BeltVelocity, 1.0), (Param::Restitution, 0.5)];
        model(&instance(constant(mu), &values))
    };
    // ẏ2 changes by (1 + e) |vy| = 3; (μ, relative velocity, the ratio P_t/P_n or a stop).
    let change = 3.0;
    let cases = [
        ("slides on", 0.4, 5.0, Some(0.4)),
        ("slides on in reverse", 0.2, -5.0, Some(-0.2)),
        ("stops", 0.4, 0.9, None),
        ("slides on against the inertia", 0.6, -0.01, Some(-0.6)),
        ("stops in reverse", 2.0, -0.3, None),
        ("is reversed by the inertia", 0.1, 0.2, Some(-0.1)),
    ];
    for (case, mu, relative, ratio) in cases {
        let impact = with(mu).impact(7.0 - relative, -2.0, 7.0).expect("an impact");
        close(case, impact.vy, 1.0, 1e-15);
        let jump = impact.vx - (7.0 - relative);
        let expected = match ratio {
            // along Δẋ − coupling Δẏ = q P_n and −coupling Δẋ + across Δẏ = P_n.
            Some(q) => (coupling + q * across) / (along + q * coupling) * change,
            None => relative,
        };
        close(case, jump, expected, 1e-13);
        let tangential = (along * jump - coupling * change) / unit;
        let normal = (across * change - coupling * jump) / unit;
        assert!(normal > 0.0, "{case}: {normal}");
        assert!(tangential.abs() <= mu * normal * (1.0 + 1e-12), "{case}: outside the cone");
        let after = relative - jump;
        match ratio {
            Some(q) if q * relative > 0.0 => assert!(after * relative > 0.0, "{case}"),
            Some(_) => assert!(after * relative < 0.0, "{case}"),
            None => assert_eq!(impact.vx.to_bits(), 7.0_f64.to_bits(), "{case}"),
        }
    }
    // Without impact friction only the inertia acts.
    let mut smooth = with(0.4);
    smooth.impact_friction = false;
    let impact = smooth.impact(2.0, -2.0, 7.0).expect("an impact");
    close("frictionless", impact.vx - 2.0, coupling / along * change, 1e-13);
}

/// Bounces down to a rebound of 1e-6 `ω0 F_ext/k2` are flights of their own; the next one closes the contact.
#[test]
fn the_contact_closes_at_the_slowest_rebound() {
    for restitution in [0.3, 0.5, 0.9] {
        let values = [(Param::BeltVelocity, 3.0), (Param::Restitution, restitution)];
        let model = model(&single(constant(0.3), &values));
        for approach in [0.5, 0.037] {
            let (mut speed, mut bounces) = (approach, 0_u32);
            while speed > 0.0 {
                speed = model.impact(0.0, -speed, 10.0).expect("an impact").vy;
                bounces += 1;
            }
            let expected = ((1e-6 / approach).ln() / restitution.ln()).ceil();
            near(&format!("e = {restitution} from {approach}"), f64::from(bounces), expected, 0.0);
        }
        let rebound = |speed: f64| model.impact(0.0, -speed / restitution, 10.0).expect("an impact").vy;
        assert_eq!(rebound(0.999e-6).to_bits(), 0.0_f64.to_bits());
        close("above", rebound(1.001e-6), 1.001e-6, 1e-12);
    }
    near("in units of ω0 F_ext/k2", SLOWEST_REBOUND, 1e-6, 0.0);
}

// Contact at rest

/// `|R + V̇| ≤ μ_s (W − κ V̇)` from both sides of both edges of the cone.
#[test]
fn stick_at_rest_counts_the_acceleration_of_the_belt() {
    let values = [(Param::Theta, 0.3), (Param::BeltVelocity, 1.0)];
    let model = model(&instance(constant(0.4), &values));
    let (along, coupling, _) = impact_masses(0.3);
    let kappa = coupling / along;
    for acceleration in [-1.0, -0.3, 0.0, 0.5, 1.0] {
        let w = 1.0;
        let edge = 0.4 * (w - kappa * acceleration);
        for sigma in [1.0, -1.0] {
            let at = |tangential: f64| {
                let r = sigma * tangential - acceleration;
                let springs = Springs { h: 0.0, r: r - model.mu0 * model.n0, w: w - model.n0 };
                model.contact_at_rest(springs, acceleration).expect("a contact")
            };
            let case = format!("V̇ = {acceleration}, σ = {sigma}");
            assert_eq!(at(edge * (1.0 - 1e-9)), Contact::Stick, "{case}");
            let outside = at(edge * (1.0 + 1e-9));
            // W + κ R decides between slip and flight.
            if w + kappa * (sigma * edge - acceleration) > 0.0 {
                assert_eq!(outside, Contact::Slip { sigma, piece: 0 }, "{case}");
            } else {
                assert_eq!(outside, Contact::Free, "{case}");
            }
        }
    }
}

/// On a belt that accelerates, the forces of stick carry the inertia of the mass that is taken along.
#[test]
fn forces_of_stick_carry_the_acceleration_of_the_belt() {
    let theta = 0.3;
    let model = model(&instance(constant(0.9), &[(Param::Theta, theta), (Param::BeltVelocity, 1.0)]));
    let (along, coupling, _) = impact_masses(theta);
    for acceleration in [-0.7, 0.4] {
        let belt = BeltMotion { velocity: 0.5, acceleration };
        let state = State { position: [0.2, 0.0, -0.1], velocity: [0.5, 0.0, 0.3] };
        let expansion = Expansion::new(&model, 16, &state, Contact::Stick, belt);
        for tau in [0.0, 0.2] {
            let motion = expansion.motion(tau);
            let (r, w) = model.contact_loads(model.springs(motion.state.position, motion.state.velocity));
            let (tangential, normal) = expansion.forces(tau);
            close("x2", motion.state.velocity[0], 0.5 + acceleration * tau, 1e-14);
            close("T", tangential, r + acceleration, 1e-12);
            close("N", normal, w - coupling / along * acceleration, 1e-12);
        }
    }
}

// Durations

/// 150 + 130 periods are 280 times 2π sqrt((m2 + m1 c²)/k1)/c, neither capped nor cut.
#[test]
fn periods_are_simulated_in_full() {
    let text = r#"
        title = "Periods"
        [model]
        theta = 0.4
        [friction]
        law = "constant"
        mu_s = 0.1
        mu_d = 0.1
        [axes]
        belt_velocity = { values = [3.0] }
        [response]
        settle = "150 periods"
        measure = "130 periods"
    "#;
    let spec = Spec::parse(text, "periods.toml", ".".as_ref()).expect("a sweep");
    let plan = Plan::new(&spec);
    let outcome = complete(&spec.instance(0), &plan);
    let c = 0.4_f64.cos();
    let period = TAU * ((0.18 + 2.12 * c * c) / 100_000.0).sqrt() / c;
    close("simulated time", outcome.simulated_time, 280.0 * period, 1e-12);
    // The same time in seconds takes the same steps, at least 12 per period.
    let seconds = crate::common::plan(150.0 * period, 130.0 * period, plan.steps_per_period);
    let same = complete(&spec.instance(0), &seconds);
    assert!(outcome.steps >= 280 * 12 && outcome.steps.abs_diff(same.steps) <= 3, "{}", outcome.steps);
    close("std x2", outcome.x2_std.expect("a value"), same.x2_std.expect("a value"), 1e-9);
}

// Closed forms of the single mass

/// Without friction and damping `x2` is a harmonic of amplitude v0/ω about `x2_eq = 0`, and `y1` rests.
#[test]
fn a_harmonic_in_closed_form() {
    let speed = 0.01;
    let kicked = single(constant(0.0), &[(Param::BeltVelocity, 10.0), (Param::StartVelocity, speed)]);
    for steps in [12, 60] {
        let outcome = complete(&kicked, &plan(0.0, 40.0 * TAU / omega(), steps));
        let get = |value: Option<f64>| value.expect("a value");
        if steps == PEAK_STEPS {
            close("peak", get(outcome.ax_peak), speed * omega(), 1e-6);
        }
        close("rms", get(outcome.ax_rms), speed * omega() / 2.0_f64.sqrt(), 1e-7);
        close("std", get(outcome.x2_std), speed / omega() / 2.0_f64.sqrt(), 1e-7);
        near("mean", get(outcome.x2_mean), 0.0, 1e-12);
        close("frequency", get(outcome.response_frequency), omega() / TAU, 1e-10);
        close("mean of y1", get(outcome.y1_mean), -1000.0 / 101_000.0, 1e-14);
        near("std of y1", get(outcome.y1_std), 0.0, 1e-15);
        near("rms of ay", get(outcome.ay_rms), 0.0, 1e-12);
        close("peak of N", get(outcome.n_peak), 1000.0, 1e-13);
        near("friction", get(outcome.friction_mean), 0.0, 1e-15);
        near("impacts", get(outcome.impacts_per_second), 0.0, 0.0);
        assert_eq!(outcome.phase_cycle, None, "y1 does not move");
    }
}

/// On a belt at rest friction opposes the motion: over one period its mean is 0, over half of one μ.
#[test]
fn mean_friction_has_the_sign_of_the_force() {
    let values = [(Param::BeltVelocity, 0.0), (Param::StartVelocity, 0.0), (Param::StartDisplacement, 0.05)];
    let released = single(constant(0.1), &values);
    let run = |periods: f64| complete(&released, &plan(0.0, periods * TAU / omega(), 12));
    let whole = run(1.0);
    near("both directions", whole.friction_mean.expect("a value"), 0.0, 1e-9);
    near("reversed", whole.reverse.expect("a value"), 0.5, 1e-9);
    let half = run(0.5 - 1e-9);
    close("one direction", half.friction_mean.expect("a value"), 0.1, 1e-12);
    let other = single(
        constant(0.1),
        &[(Param::BeltVelocity, 0.0), (Param::StartVelocity, 0.0), (Param::StartDisplacement, -0.05)],
    );
    let back = complete(&other, &plan(0.0, (0.5 - 1e-9) * TAU / omega(), 12));
    close("other direction", back.friction_mean.expect("a value"), -0.1, 1e-12);
}

// Sliding motion against RK4 written out in SI

/// Table 1 with the given angle, damping and friction.
#[derive(Clone, Copy)]
struct Sliding {
    theta: f64,
    damping: f64,
    mu: f64,
}

impl Sliding {
    /// `(ẍ2, ÿ1, N)` of slip with T = μ N: x1 = x2 c, y2 = 0.
    fn accelerations(self, [x, y, vx, vy]: [f64; 4]) -> (f64, f64, f64) {
        let (s, c) = self.theta.sin_cos();
        let g = 100_000.0 * x * c + self.damping * vx * c;
        let h = 101_000.0 * (x * s - y) + self.damping * (vx * s - vy);
        // (m2 + m1 c²) ẍ + c g + s h = μ N, N = c h − s g − m1 s c ẍ.
        let mass = 0.18 + 2.12 * c * c + self.mu * 2.12 * s * c;
        let ax = (self.mu * (c * h - s * g) - c * g - s * h) / mass;
        (ax, (h - 1000.0) / 2.12, c * h - s * g - 2.12 * s * c * ax)
    }

    fn equilibrium(self) -> [f64; 2] {
        let (s, c) = self.theta.sin_cos();
        let x = 1000.0 * (self.mu * c - s) / (c + self.mu * s) / (100_000.0 * c);
        [x, x * s - 1000.0 / 101_000.0]
    }

    fn rk4(self, z: [f64; 4], dt: f64) -> [f64; 4] {
        let rate = |z: [f64; 4]| {
            let (ax, ay, _) = self.accelerations(z);
            [z[2], z[3], ax, ay]
        };
        let moved = |k: [f64; 4], by: f64| std::array::from_fn(|i| z[i] + by * k[i]);
        let a = rate(z);
        let b = rate(moved(a, 0.5 * dt));
        let c = rate(moved(b, 0.5 * dt));
        let d = rate(moved(c, dt));
        std::array::from_fn(|i| z[i] + dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    }
}

#[test]
fn sliding_observables_against_a_fine_rk4() {
    for (sliding, settle, measure) in [
        // Microseconds. A window of 1.4 periods, so that the means stand off the equilibrium.
        (Sliding { theta: 0.4, damping: 5.0, mu: 0.3 }, 11_000_u32, 43_000_u32),
        (Sliding { theta: -0.3, damping: 20.0, mu: 0.5 }, 20_000, 13_000),
    ] {
        let kicked = instance(
            constant(sliding.mu),
            &[
                (Param::Theta, sliding.theta),
                (Param::C1, sliding.damping),
                (Param::C2, sliding.damping),
                (Param::BeltVelocity, 10.0),
                (Param::StartVelocity, 0.05),
                (Param::StartDisplacement, 1e-3),
            ],
        );
        let [x_eq, y_eq] = sliding.equilibrium();
        let mut z = [x_eq + 1e-3, y_eq, 0.05, 0.0];
        let dt = 1e-6;
        for _ in 0..settle {
            z = sliding.rk4(z, dt);
        }
        let count = measure;
        let mut sums = [0.0; 6];
        let mut peaks = [0.0_f64; 3];
        for i in 0..=count {
            let (ax, ay, normal) = sliding.accelerations(z);
            assert!(normal > 0.0);
            let weight = if i == 0 || i == count { 0.5 } else { 1.0 } / f64::from(count);
            let [x, y] = [z[0] - x_eq, z[1] - y_eq];
            for (sum, value) in sums.iter_mut().zip([x, x * x, y, y * y, ax * ax, ay * ay]) {
                *sum += weight * value;
            }
            for (peak, value) in peaks.iter_mut().zip([ax.abs(), ay.abs(), normal]) {
                *peak = peak.max(value);
            }
            z = sliding.rk4(z, dt);
        }
        let [x, xx, y, yy, ax, ay] = sums;
        let outcome = complete(&kicked, &plan(f64::from(settle) * dt, f64::from(measure) * dt, 60));
        for (what, actual, expected, tolerance) in [
            ("mean of x2", outcome.x2_mean, x_eq + x, 1e-7),
            ("mean of y1", outcome.y1_mean, y_eq + y, 1e-7),
            ("std of x2", outcome.x2_std, (xx - x * x).sqrt(), 1e-6),
            ("std of y1", outcome.y1_std, (yy - y * y).sqrt(), 1e-6),
            ("rms of ax", outcome.ax_rms, ax.sqrt(), 1e-6),
            ("rms of ay", outcome.ay_rms, ay.sqrt(), 1e-6),
            ("peak of ax", outcome.ax_peak, peaks[0], 1e-6),
            ("peak of ay", outcome.ay_peak, peaks[1], 1e-6),
            ("peak of N", outcome.n_peak, peaks[2], 1e-6),
            ("friction", outcome.friction_mean, sliding.mu, 1e-12),
        ] {
            close(&format!("{what} at θ = {}", sliding.theta), actual.expect("a value"), expected, tolerance);
        }
        // The mean and its removal matter in this window.
        assert!(y.abs() > 1e-2 * yy.sqrt(), "{y} {}", yy.sqrt());
    }
}

// Figures of an independent integration

/// A column and its figure.
type Figure = (&'static str, fn(&Outcome) -> Option<f64>, f64);

#[track_caller]
fn against_scipy(outcome: &Outcome, figures: &[Figure]) {
    for &(what, value, expected) in figures {
        close(what, value(outcome).expect("a value"), expected, 3e-4);
    }
}

#[test]
fn stick_slip_with_detachment_against_scipy() {
    let law = FrictionLaw::Exponential { mu_s: 0.4, mu_d: 0.3, stribeck_velocity: 1.5 };
    let cycle = instance(
        law,
        &[(Param::BeltVelocity, 3.0), (Param::StartVelocity, 0.0), (Param::StartDisplacement, 1e-3)],
    );
    against_scipy(
        &complete(&cycle, &plan(4.0, 4.0, 12)),
        &[
            ("std of x2", |o| o.x2_std, 0.011_758_27),
            ("stick", |o| o.stick, 0.142_392),
            ("free", |o| o.free, 0.201_163),
            ("reverse", |o| o.reverse, 0.042_179),
            ("friction", |o| o.friction_mean, 0.177_854_7),
            ("peak of N", |o| o.n_peak, 2_097.974),
            ("rms of ay", |o| o.ay_rms, 356.381_97),
            ("frequency", |o| o.response_frequency, 34.057_565_4),
            ("phase", |o| o.phase_cycle, -43.583),
            ("peak of ax", |o| o.ax_peak, 917.657_9),
            ("impacts", |o| o.impacts_per_second, 34.25),
        ],
    );
}

#[test]
fn steep_contact_with_restitution_against_scipy() {
    let law = FrictionLaw::Exponential { mu_s: 1.2, mu_d: 0.6, stribeck_velocity: 1.0 };
    let cycle = instance(
        law,
        &[
            (Param::Theta, -0.3),
            (Param::Restitution, 0.5),
            (Param::C1, 10.0),
            (Param::C2, 10.0),
            (Param::BeltVelocity, 3.0),
            (Param::StartVelocity, -3.0),
        ],
    );
    against_scipy(
        &complete(&cycle, &plan(2.0, 1.0, 12)),
        &[
            ("std of x2", |o| o.x2_std, 0.015_280_646_1),
            ("stick", |o| o.stick, 0.077_232_74),
            ("free", |o| o.free, 0.124_71),
            ("reverse", |o| o.reverse, 0.104_984_25),
            ("friction", |o| o.friction_mean, 0.667_993),
            ("peak of N", |o| o.n_peak, 3_159.400),
            ("peak of ax", |o| o.ax_peak, 1_451.020_9),
            ("rms of ay", |o| o.ay_rms, 303.198_051),
            ("frequency", |o| o.response_frequency, 45.305_861),
            ("phase", |o| o.phase_cycle, 2.722),
        ],
    );
}

// Friction laws

/// `dμ/d|v|` of every law is the derivative of its μ, at a kink that from the side of the larger speed.
#[test]
fn slopes_are_derivatives() {
    let knots = [(0.0, 0.5), (0.4, 0.42), (1.5, 0.45), (6.0, 0.2)];
    let (velocity, mu) = knots.iter().copied().unzip();
    let laws = [
        (FrictionLaw::Constant { mu_s: 0.5, mu_d: 0.3 }, vec![]),
        (bilinear(0.5, 0.2), vec![5.0]),
        (FrictionLaw::Exponential { mu_s: 0.6, mu_d: 0.25, stribeck_velocity: 0.7 }, vec![]),
        (FrictionLaw::Rational { mu_s: 0.7, decay: 1.3 }, vec![]),
        (FrictionLaw::Table(Arc::new(MuTable { velocity, mu })), vec![0.4, 1.5, 6.0]),
    ];
    let unit = 2.5;
    for (law, kinks) in laws {
        let chain = law.pieces(unit);
        for speed in [0.1, 0.25, 0.9, 1.2, 3.3, 4.7, 5.9, 7.5, 40.0] {
            let h = 1e-5;
            let difference = (law.mu(speed + h) - law.mu(speed - h)) / (2.0 * h);
            let case = format!("{:?} at {speed}", law.kind());
            near(&case, law.slope(speed), difference, 1e-9);
            near(&case, law.slope(-speed), difference, 1e-9);
            near(&case, chain.slope(speed / unit) / unit, difference, 1e-9);
            near(&case, chain.mu(speed / unit), law.mu(speed), 1e-15);
        }
        for kink in kinks {
            let h = 1e-6;
            let above = (law.mu(kink + h) - law.mu(kink)) / h;
            near(&format!("{:?} at its kink {kink}", law.kind()), law.slope(kink), above, 1e-8);
            let below = law.slope(kink * (1.0 - 1e-9));
            assert!((below - above).abs() > 1e-3, "{below} {above}");
        }
    }
}

/// The slopes written out.
#[test]
fn slopes_in_closed_form() {
    close("bilinear", bilinear(0.5, 0.2).slope(2.0), -0.06, 1e-14);
    let exponential = FrictionLaw::Exponential { mu_s: 0.6, mu_d: 0.25, stribeck_velocity: 0.7 };
    close("exponential", exponential.slope(1.4), -0.5 * (-2.0_f64).exp(), 1e-14);
    let rational = FrictionLaw::Rational { mu_s: 0.7, decay: 0.5 };
    close("rational", rational.slope(2.0), -0.35 / 4.0, 1e-14);
}
