//! Properties over random parameters: Schur oracle, roots, energy, order.

use crate::common::{bilinear, close, constant, instance, paper, plan};
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Matrix4, Schur};
use num_complex::Complex64;
use proptest::prelude::*;
use squealmap::engine::method::Method;
use squealmap::engine::method::roots::{Crossing, first_crossing};
use squealmap::engine::method::taylor::{BeltMotion, Expansion, State};
use squealmap::engine::plan::{Plan, StartKind};
use squealmap::engine::reference::observer::Observer;
use squealmap::engine::reference::observer::Step;
use squealmap::engine::reference::resolution::Resolution;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::scene::Scene;
use squealmap::model::contact::Contact;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::linear::eigenvalues;
use squealmap::model::status::Status;
use squealmap::model::{Param, Params};

fn value(params: &Params, param: Param) -> f64 {
    params.get(param).expect("a value")
}

/// The paper's matrices (4) with the slope damping: mass, damping and stiffness, row by row.
fn matrices(instance: &Instance) -> [[f64; 4]; 3] {
    let p = |param| value(&instance.params, param);
    let (m1, m2, k1, k2, c1, c2) =
        (p(Param::M1), p(Param::M2), p(Param::K1), p(Param::K2), p(Param::C1), p(Param::C2));
    let (s, c) = p(Param::Theta).sin_cos();
    let velocity = p(Param::BeltVelocity);
    let (mu, slope) = (instance.law.mu(velocity), instance.law.slope(velocity));
    let normal = p(Param::FExt) / (c + mu * s);
    // T − μ N = 0 and m1 ÿ1 = h − F, linearised by hand: N = c h − s g − m1 s c ẍ2.
    let rows = |a: f64, b: f64| {
        [a * c * c + b * s * s - mu * (b * c * s - a * c * s), -b * s + mu * b * c, -b * s, b]
    };
    let mut damping = rows(c1, c2);
    damping[0] += slope * normal;
    [[m2 + m1 * c * c + mu * m1 * c * s, 0.0, 0.0, m1], damping, rows(k1, k2)]
}

/// Eigenvalues of the first-order system by nalgebra's Schur form with an iteration cap.
///
/// Balanced before: without it the QR algorithm loses 1e-9 where masses or stiffnesses are a factor 1000 apart.
fn schur_eigenvalues(instance: &Instance) -> Option<Vec<Complex64>> {
    let [m, c, k] = matrices(instance);
    let scale = (k[0] / m[0]).abs().sqrt();
    let mut matrix = Matrix4::new(
        0.0,
        0.0,
        scale,
        0.0,
        0.0,
        0.0,
        0.0,
        scale,
        -k[0] / m[0] / scale,
        -k[1] / m[0] / scale,
        -c[0] / m[0],
        -c[1] / m[0],
        -k[2] / m[3] / scale,
        -k[3] / m[3] / scale,
        -c[2] / m[3],
        -c[3] / m[3],
    );
    balance_parlett_reinsch(&mut matrix);
    let schur = Schur::try_new(matrix, 1e-15, 10_000)?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}

/// `|det(λ² M + λ C + K)|` relative to the size of its terms.
fn residual(instance: &Instance, lambda: Complex64) -> f64 {
    let [m, c, k] = matrices(instance);
    let entry = |i: usize| lambda * lambda * m[i] + lambda * c[i] + k[i];
    let size = |i: usize| lambda.norm_sqr() * m[i].abs() + lambda.norm() * c[i].abs() + k[i].abs();
    (entry(0) * entry(3) - entry(1) * entry(2)).norm() / (size(0) * size(3) + size(1) * size(2))
}

fn arbitrary_instance() -> impl Strategy<Value = Instance> {
    let positive = |low: f64, high: f64| (low.ln()..high.ln()).prop_map(f64::exp);
    (
        (positive(0.01, 100.0), positive(0.01, 100.0), positive(1e3, 1e7), positive(1e3, 1e7)),
        (positive(1e-3, 100.0), positive(1e-3, 100.0), positive(1.0, 1e4), -0.6..0.6),
        (0.0..0.9, 0.0..0.9, positive(0.1, 10.0), positive(0.01, 20.0)),
    )
        .prop_map(|((m1, m2, k1, k2), (c1, c2, force, theta), (mu_s, mu_d, knee_velocity, velocity))| {
            instance(
                FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity },
                &[
                    (Param::M1, m1),
                    (Param::M2, m2),
                    (Param::K1, k1),
                    (Param::K2, k2),
                    (Param::C1, c1),
                    (Param::C2, c2),
                    (Param::FExt, force),
                    (Param::Theta, theta),
                    (Param::BeltVelocity, velocity),
                ],
            )
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn closed_form_equals_schur(instance in arbitrary_instance()) {
        let closed = eigenvalues(&instance).expect("an equilibrium");
        let schur = schur_eigenvalues(&instance).expect("converged");
        let size = closed.iter().map(|z| z.norm()).fold(0.0, f64::max);
        // The oracle loses digits where modes are far apart, and both lose half where two coincide.
        for z in &closed {
            let others = closed.iter().map(|w| (w - z).norm()).filter(|d| *d > 0.0);
            let gap = others.fold(size, f64::min).max(1e-7 * size);
            let nearest = schur.iter().map(|w| (w - z).norm()).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest <= 1e-9 * size * (size / gap).sqrt(), "{z} is {nearest:e} from {schur:?}");
            prop_assert!(residual(&instance, *z) < 1e-12, "residual {:e} of {z}", residual(&instance, *z));
        }
        // All four, not one twice: their sum is the trace.
        let [mass, damping, _] = matrices(&instance);
        let trace = -(damping[0] / mass[0] + damping[3] / mass[3]);
        let sum: Complex64 = closed.iter().sum();
        prop_assert!((sum - trace).norm() <= 1e-12 * size, "{sum} instead of {trace}");
    }

    #[test]
    fn first_crossing_equals_a_dense_search(
        coefficients in prop::collection::vec(-3.0..3.0_f64, 3..15),
        step in 0.1..1.5_f64,
    ) {
        let mut coefficients = coefficients;
        coefficients[0] = coefficients[0].abs() + 1e-3;
        let value = |tau: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * tau + c);
        let samples = 20_000;
        let dense = (1..=samples).map(|i| step * f64::from(i) / f64::from(samples)).find(|tau| value(*tau) <= 0.0);
        match (first_crossing(&coefficients, step, false), dense) {
            (Crossing::Never, None) => {}
            (Crossing::At(tau), Some(sample)) => {
                // The dense search is right to one sample; it may only be later.
                prop_assert!(tau <= sample && tau > 0.0, "{tau} {sample}");
                prop_assert!(value(tau).abs() <= 1e-10, "{}", value(tau));
                prop_assert!(value(tau * (1.0 - 1e-9)) > -1e-12);
            }
            // A dip shorter than a sample is seen by the subdivision only.
            (Crossing::At(tau), None) => prop_assert!(value(tau).abs() <= 1e-10),
            other => prop_assert!(false, "{other:?}"),
        }
    }
}

/// The largest rise of the energy (frame of the belt, relative to its range of terms) along a run.
struct EnergyWatch<'a> {
    scene: &'a Scene,
    states: Vec<Contact>,
    previous: Option<f64>,
    rise: f64,
}

impl Observer for EnergyWatch<'_> {
    fn step(&mut self, step: &Step) {
        let watched = self.states.iter().any(|state| state.state() == step.expansion.contact.state());
        let energy = |fraction: f64| {
            let state = step.expansion.motion(fraction * step.duration).state;
            self.scene.model.energy(state.position, state.velocity)
        };
        let mut previous = if watched { self.previous.unwrap_or(energy(0.0)) } else { energy(1.0) };
        if watched {
            for fraction in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let now = energy(fraction);
                self.rise = self.rise.max((now - previous) / (1.0 + now.abs()));
                previous = now;
            }
        }
        self.previous = Some(previous);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Without friction nothing feeds the motion, impacts included: the energy never rises.
    #[test]
    fn energy_never_rises_without_friction(
        instance in arbitrary_instance(), restitution in 0.0..=1.0_f64, kick in 0.5..5.0_f64,
    ) {
        let mut instance = instance;
        instance.law = constant(0.0);
        instance.params.set(Param::Restitution, restitution);
        let scene = Scene::new(&instance, StartKind::Kick).expect("an equilibrium");
        let start = State { position: [0.0; 3], velocity: [0.0, 0.0, kick * scene.model.k2.sqrt()] };
        let resolution = Resolution { method: Method::Taylor, order: 16, nominal_step: 0.5, tolerance: 1e-11 };
        let belt = scene.belt(0.0);
        let mut integrator =
            squealmap::engine::reference::integrate::Integrator::new(&scene.model, resolution, start, belt).expect("a start");
        let mut watch = EnergyWatch {
            scene: &scene,
            states: vec![Contact::Slip { sigma: 1.0, piece: 0 }, Contact::Slip { sigma: -1.0, piece: 0 }, Contact::Free],
            previous: None,
            rise: 0.0,
        };
        let ended = integrator.advance(30.0, belt, &mut watch);
        prop_assert!(matches!(ended, Ok(()) | Err(Status::EventLimit)), "{ended:?}");
        prop_assert!(watch.rise <= 1e-9, "the energy rises by {:e}", watch.rise);
    }

    /// A belt at rest does no work: neither stick nor flight nor slip raises the energy.
    #[test]
    fn energy_never_rises_on_a_resting_belt(instance in arbitrary_instance(), kick in 0.5..5.0_f64) {
        let mut instance = instance;
        instance.params.set(Param::BeltVelocity, 0.0);
        let Ok(scene) = Scene::new(&instance, StartKind::Kick) else { return Ok(()) };
        let start = State { position: [0.0; 3], velocity: [kick, 0.0, 0.3 * kick] };
        let resolution = Resolution { method: Method::Taylor, order: 16, nominal_step: 0.5, tolerance: 1e-11 };
        let belt = BeltMotion { velocity: 0.0, acceleration: 0.0 };
        let Ok(mut integrator) = squealmap::engine::reference::integrate::Integrator::new(&scene.model, resolution, start, belt) else {
            return Ok(());
        };
        let mut watch = EnergyWatch {
            scene: &scene,
            states: vec![
                Contact::Slip { sigma: 1.0, piece: 0 },
                Contact::Slip { sigma: -1.0, piece: 0 },
                Contact::Free,
                Contact::Stick,
            ],
            previous: None,
            rise: 0.0,
        };
        let ended = integrator.advance(30.0, belt, &mut watch);
        prop_assert!(matches!(ended, Ok(()) | Err(Status::Painleve | Status::EventLimit)), "{ended:?}");
        prop_assert!(watch.rise <= 1e-9, "the energy rises by {:e}", watch.rise);
    }

    /// Whatever the instance, the simulated time is the requested one or the status says why not.
    #[test]
    fn time_always_advances(
        instance in arbitrary_instance(), restitution in 0.0..=1.0_f64, kick in -20.0..20.0_f64, law in 0..4_u8,
    ) {
        let mut instance = instance;
        instance.params.set(Param::Restitution, restitution);
        instance.params.set(Param::StartVelocity, kick);
        instance.law = match (law, instance.law) {
            (0, FrictionLaw::Bilinear { mu_s, mu_d, .. }) => {
                FrictionLaw::Constant { mu_s: mu_s.max(mu_d), mu_d: mu_s.min(mu_d) }
            }
            (1, FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity }) => {
                FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: knee_velocity }
            }
            (2, FrictionLaw::Bilinear { mu_s, knee_velocity, .. }) => {
                FrictionLaw::Rational { mu_s, decay: 1.0 / knee_velocity }
            }
            (_, law) => law,
        };
        let plan = Plan {
            settle: squealmap::engine::plan::Duration::Periods(10.0),
            settle_limit: None,
            measure: squealmap::engine::plan::Duration::Periods(10.0),
            ..plan(0.0, 1.0, 12)
        };
        let requested = 20.0 * squealmap::model::equilibrium::Units::new(&instance.params).period();
        for method in [Method::Taylor, Method::LocatedRk4, Method::FixedStep] {
            let outcome = respond(&instance, &Plan { method, ..plan });
            if outcome.status == Status::Ok {
                prop_assert!((outcome.simulated_time / requested - 1.0).abs() < 1e-12);
                prop_assert!(outcome.x2_std.is_some_and(f64::is_finite));
            } else {
                prop_assert!(outcome.status != Status::Unwritten);
                prop_assert!(outcome.simulated_time < requested);
            }
        }
    }
}

struct Nothing;

impl Observer for Nothing {
    fn step(&mut self, _step: &Step) {}
}

/// With steps of fixed length the error falls with the order of the velocity series, `order − 1`.
#[test]
fn order_of_the_method() {
    let instance = paper(0.4, 0.3, 3.0);
    let error = |order: usize, steps: u32| {
        let run = |order, steps_per_period| {
            let scene = Scene::new(&instance, StartKind::Kick).expect("an equilibrium");
            let plan = Plan { order, tolerance: f64::INFINITY, ..plan(0.0, 1.0, steps_per_period) };
            let mut integrator = scene.integrator(&plan).expect("a start");
            // 0.3 s: ten periods of the growing oscillation.
            scene.advance(&mut integrator, 0.3 / scene.units.time, &mut Nothing).expect("a run");
            integrator.state()
        };
        let (state, exact) = (run(order, steps), run(16, 96));
        (state.position[0] - exact.position[0]).hypot(state.velocity[0] - exact.velocity[0])
    };
    for order in [4, 5, 6, 7] {
        let slope = (error(order, 16) / error(order, 64)).log2() / 2.0;
        println!(
            "{order} {} {} {} {}",
            error(order, 16),
            error(order, 32),
            error(order, 64),
            error(order, 128)
        );
        let expected = (order - 1) as f64;
        assert!((slope - expected).abs() < 0.1, "order {order}: slope {slope} instead of {expected}");
    }
}

/// The same through events: the located transitions keep the order.
#[test]
fn located_events_keep_the_order() {
    let mut instance = paper(0.15, 0.05, 1.0);
    instance.params.set(Param::StartDisplacement, 3e-3);
    let x_std = |order, steps| {
        let plan = Plan { order, tolerance: f64::INFINITY, ..plan(0.05, 0.2, steps) };
        respond(&instance, &plan).x2_std.expect("a value")
    };
    let exact = x_std(16, 192);
    let error = |steps| (x_std(5, steps) - exact).abs();
    let slope = (error(24) / error(192)).log2() / 3.0;
    assert!(slope > 3.6, "slope {slope}");
}

/// An expansion is the solution: its second derivative obeys the equations at the end of the step too.
#[test]
fn series_satisfies_the_equations_of_motion() {
    for law in [
        bilinear(0.5, 0.2),
        FrictionLaw::Exponential { mu_s: 0.6, mu_d: 0.2, stribeck_velocity: 1.0 },
        FrictionLaw::Rational { mu_s: 0.7, decay: 0.4 },
    ] {
        let instance = instance(law, &[(Param::Theta, 0.3), (Param::BeltVelocity, 2.0)]);
        let scene = Scene::new(&instance, StartKind::Kick).expect("an equilibrium");
        let state = State { position: [0.3, 0.0, -0.2], velocity: [0.2, 0.0, 0.4] };
        let belt = scene.belt(0.0);
        for sigma in [1.0, -1.0] {
            let belt = BeltMotion { velocity: sigma * belt.velocity.max(0.5), ..belt };
            let contact = Contact::Slip { sigma, piece: 0 };
            let expansion = Expansion::new(&scene.model, 16, &state, contact, belt);
            let tau = 0.1;
            let motion = expansion.motion(tau);
            let (tangential, normal) = expansion.forces(tau);
            let velocity = motion.state.velocity;
            let mu = scene.model.law.mu((belt.velocity - velocity[0]).abs());
            close("Coulomb", tangential, sigma * mu * normal, 1e-12);
            let springs = scene.model.springs(motion.state.position, velocity);
            let (r, w) = scene.model.contact_loads(springs);
            close("x2", motion.acceleration[0] + r, tangential, 1e-12);
            close("y2", w - scene.model.kappa * motion.acceleration[0], normal, 1e-12);
            close("y1", scene.model.m1 * motion.acceleration[2], springs.h, 1e-11);
        }
    }
}
