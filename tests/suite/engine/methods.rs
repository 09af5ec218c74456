//! The methods that the reference is compared with: their orders, from closed forms and matrix exponentials.

use std::f64::consts::{PI, TAU};

use crate::common::{close, constant, instance, near, paper, plan};
use crate::engine::events::{log, period, single_mass};
use crate::engine::exact;
use nalgebra::Vector4;
use squealmap::engine::method::roots::Crossing;
use squealmap::engine::method::taylor::{BeltMotion, Expansion, Motion, State};
use squealmap::engine::method::{Method, fixed, rk4};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::engine::reference::integrate::Integrator;
use squealmap::engine::reference::observer::Event;
use squealmap::engine::reference::observer::Observer;
use squealmap::engine::reference::observer::Step;
use squealmap::engine::reference::resolution::Resolution;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::contact::Contact;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::scaled::Scaled;
use squealmap::model::status::Status;

/// By how many powers of two an error falls when steps are halved, from the first of some errors to the last.
fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// The error at so many steps per period and twice, four and eight times as many.
fn errors(first: u32, error: impl Fn(u32) -> f64) -> [f64; 4] {
    [1, 2, 4, 8].map(|factor| error(first * factor))
}

#[track_caller]
fn has_order(what: &str, errors: [f64; 4], expected: f64, within: f64) {
    let found = order(&errors);
    assert!((found - expected).abs() < within, "{what}: order {found} instead of {expected}: {errors:?}");
}

#[test]
fn orders_are_told_apart() {
    for power in [1, 3, 4] {
        let errors = errors(10, |steps| 7.0 * f64::from(steps).powi(-power));
        has_order("a power", errors, f64::from(power), 1e-9);
    }
}

struct Nothing;

impl Observer for Nothing {
    fn step(&mut self, _step: &Step) {}
}

/// The textbook's step of the system of first order, by these weights of its four slopes.
fn textbook(
    model: &Scaled,
    state: State,
    contact: Contact,
    belt: BeltMotion,
    h: f64,
    weights: [f64; 4],
) -> State {
    let sum = |state: State, h: f64, (v, a): ([f64; 3], [f64; 3])| State {
        position: std::array::from_fn(|i| state.position[i] + h * v[i]),
        velocity: std::array::from_fn(|i| state.velocity[i] + h * a[i]),
    };
    let slope = |at: State| (at.velocity, rk4::accelerations(model, &at, contact, belt));
    let first = slope(state);
    let second = slope(sum(state, 0.5 * h, first));
    let third = slope(sum(state, 0.5 * h, second));
    let fourth = slope(sum(state, h, third));
    [first, second, third, fourth]
        .into_iter()
        .zip(weights)
        .fold(state, |state, (slope, weight)| sum(state, weight * h, slope))
}

const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// The single mass that slides without an event: `x = e^(−δt) (x0 cos ω t + (v0 + δ x0)/ω sin ω t)`.
fn damped(time: f64) -> (Instance, [f64; 2]) {
    let law = FrictionLaw::Constant { mu_s: 0.3, mu_d: 0.3 };
    let one = single_mass(law, 2.0, 0.1, (0.3, 0.5));
    let (delta, omega) = (0.05_f64, (1.0 - 0.05_f64 * 0.05).sqrt());
    let (sin, cos) = (omega * time).sin_cos();
    let b = (0.5 + delta * 0.3) / omega;
    let decay = (-delta * time).exp();
    let x = decay * (0.3 * cos + b * sin);
    (one, [x, decay * omega * (b * cos - 0.3 * sin) - delta * x])
}

#[test]
fn a_damped_oscillation_has_order_4() {
    let time = 20.0;
    let (one, [x, v]) = damped(time);
    let scene = Scene::new(&one, StartKind::Kick).expect("an equilibrium");
    let units = scene.units;
    let distance =
        |state: State| (state.position[0] * units.length - x).hypot(state.velocity[0] * units.velocity - v);
    for method in [Method::LocatedRk4, Method::FixedStep] {
        let error = |steps| {
            let plan = Plan { method, ..plan(0.0, 1.0, steps) };
            let mut integrator = scene.integrator(&plan).expect("a start");
            scene.advance(&mut integrator, time / units.time, &mut Nothing).expect("a run");
            distance(integrator.state())
        };
        has_order(&format!("{method:?}"), errors(20, error), 4.0, 0.15);
        assert!(error(160) < 1e-7, "{method:?}: {}", error(160));
    }
    // A wrong weight is of order 1 at most, and the same comparison says so.
    let error = |weights: [f64; 4], count: u32| {
        let h = time / units.time / f64::from(count);
        let belt = scene.belt(0.0);
        let contact = Contact::Slip { sigma: 1.0, piece: 0 };
        let step = |state, _| textbook(&scene.model, state, contact, belt, h, weights);
        distance((0..count).fold(scene.start(), step))
    };
    has_order("textbook", errors(100, |count| error(WEIGHTS, count)), 4.0, 0.15);
    let wrong = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 4.0];
    assert!(order(&errors(100, |count| error(wrong, count))) < 2.2);
}

/// Instances of every contact state with a state that is none of its equilibria.
fn contacts() -> Vec<(Scene, Contact)> {
    let laws = [
        FrictionLaw::Bilinear { mu_s: 0.5, mu_d: 0.2, knee_velocity: 5.0 },
        FrictionLaw::Exponential { mu_s: 0.6, mu_d: 0.2, stribeck_velocity: 1.0 },
        FrictionLaw::Rational { mu_s: 0.7, decay: 0.4 },
    ];
    let slip = [1.0, -1.0].map(|sigma| Contact::Slip { sigma, piece: 0 });
    let all = [slip[0], slip[1], Contact::Stick, Contact::Free];
    laws.into_iter()
        .flat_map(|law| {
            let values =
                [(Param::Theta, 0.3), (Param::BeltVelocity, 2.0), (Param::C1, 30.0), (Param::C2, 20.0)];
            let one = instance(law, &values);
            all.map(|contact| (Scene::new(&one, StartKind::Kick).expect("an equilibrium"), contact))
        })
        .collect()
}

/// A state in a contact state, and the belt.
fn begin(contact: Contact) -> (State, BeltMotion) {
    let y2 = if contact == Contact::Free { 0.2 } else { 0.0 };
    let sigma = if let Contact::Slip { sigma, .. } = contact { sigma } else { 1.0 };
    let belt = BeltMotion { velocity: sigma * 3.0, acceleration: 0.0 };
    let v = if contact == Contact::Stick { belt.velocity } else { 0.2 };
    (State { position: [0.3, y2, -0.2], velocity: [v, 2.0 * y2, 0.4] }, belt)
}

/// The end of a step is the textbook's, and the equations are those of the Taylor series; a wrong weight is neither.
#[test]
fn a_step_is_that_of_the_textbook() {
    let h = 0.3;
    for (scene, contact) in contacts() {
        let (state, belt) = begin(contact);
        let model = &scene.model;
        let first = rk4::accelerations(model, &state, contact, belt);
        let taylor = Expansion::new(model, 4, &state, contact, belt).motion(0.0).acceleration;
        let end = rk4::expand(model, &state, contact, belt, h).motion(h).state;
        let expected = textbook(model, state, contact, belt, h, WEIGHTS);
        for i in 0..3 {
            near("acceleration", first[i], taylor[i], 1e-13);
            near("position", end.position[i], expected.position[i], 1e-14);
            near("velocity", end.velocity[i], expected.velocity[i], 1e-13);
        }
        let wrong = textbook(model, state, contact, belt, h, [1.0 / 6.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 4.0]);
        assert!((end.velocity[2] - wrong.velocity[2]).abs() > 1e-3);
    }
}

/// Inside a step the position is as good as at its end, where it is off by `h⁵`; every derivative loses one order.
#[test]
fn dense_output_loses_one_order_with_each_derivative() {
    for (scene, contact) in contacts() {
        let (state, belt) = begin(contact);
        let exact = Expansion::new(&scene.model, 16, &state, contact, belt);
        let of = |difference: &dyn Fn(&Expansion, f64) -> f64| {
            errors(16, |count| {
                let h = 1.0 / f64::from(count);
                difference(&rk4::expand(&scene.model, &state, contact, belt, h), 0.4 * h)
            })
        };
        let position = |motion: Motion| motion.state.position[2];
        let velocity = |motion: Motion| motion.state.velocity[2];
        let acceleration = |motion: Motion| motion.acceleration[2];
        let differs = |of: &dyn Fn(Motion) -> f64, step: &Expansion, tau: f64| {
            (of(step.motion(tau)) - of(exact.motion(tau))).abs()
        };
        let case = format!("{contact:?} under {:?}", scene.model.law.pieces[0]);
        for (what, least, number) in [
            ("position", 4.7, &position as &dyn Fn(Motion) -> f64),
            ("velocity", 3.7, &velocity),
            ("acceleration", 2.7, &acceleration),
        ] {
            let found = order(&of(&|step, tau| differs(number, step, tau)));
            assert!(found > least, "{case}: {what} of order {found}");
        }
        let found = order(&of(&|step, tau| (step.forces(tau).1 - exact.forces(tau).1).abs()));
        assert!(contact == Contact::Free || found > 2.7, "{case}: normal force of order {found}");
        // The relative velocity is that of the motion.
        let step = rk4::expand(&scene.model, &state, contact, belt, 0.3);
        let [v, a, _] = step.relative_motion();
        let motion = step.motion(0.0);
        near("v", v, belt.velocity - motion.state.velocity[0], 1e-14);
        near("dv/dt", a, -motion.acceleration[0], 1e-13);
    }
}

/// Both masses over ten periods, what a window shows of them, from the matrix exponential.
#[test]
fn observables_of_both_masses_have_order_4() {
    let values = [(Param::Theta, 0.1), (Param::BeltVelocity, 1.0), (Param::StartVelocity, 1e-3)];
    let one = instance(constant(0.3), &values);
    let start = Vector4::new(0.0, 0.0, 1e-3, 0.0);
    let exact = exact::window(&exact::sliding(&one, 0.3, 0.0), start, 0.1, 0.2);
    let run = |steps| {
        let outcome = respond(&one, &Plan { method: Method::LocatedRk4, ..plan(0.1, 0.2, steps) });
        assert_eq!(outcome.status, Status::Ok);
        outcome
    };
    let numbers = |outcome: Outcome| {
        [outcome.x2_std, outcome.y1_std, outcome.ax_rms, outcome.ay_rms].map(|value| value.expect("a value"))
    };
    let measured = [20, 40, 80, 160].map(|steps| numbers(run(steps)));
    let exact = [exact.x2_std, exact.y1_std, exact.ax_rms, exact.ay_rms];
    for (k, name) in ["x2_std", "y1_std", "ax_rms", "ay_rms"].into_iter().enumerate() {
        has_order(name, measured.map(|values| (values[k] - exact[k]).abs()), 4.0, 0.3);
        close(name, measured[3][k], exact[k], 1e-6);
    }
}

/// The stick-slip cycle of the undamped single mass, `m = k = N = 1`, under a constant law with a jump at rest:
/// period, standard deviation of `x2`, rms of `ẍ2`, share of stick.
fn stick_slip() -> (Instance, [f64; 4]) {
    let (jump, velocity) = (0.15_f64, 0.1_f64);
    let law = FrictionLaw::Constant { mu_s: 0.4, mu_d: 0.25 };
    let (stick, slip) = (2.0 * jump / velocity, 2.0 * (PI - (jump / velocity).atan()));
    // Slip is x − μ_d = jump cos t + velocity sin t, and ẍ = −(x − μ_d); stick is a straight line from −jump to jump.
    let (sin, cos) = (2.0 * slip).sin_cos();
    let square = 0.5 * (jump * jump + velocity * velocity) * slip
        + 0.25 * (jump * jump - velocity * velocity) * sin
        + 0.5 * jump * velocity * (1.0 - cos);
    let period = stick + slip;
    let deviation = ((square + 2.0 * jump.powi(3) / (3.0 * velocity)) / period).sqrt();
    let instance = single_mass(law, velocity, 0.0, (0.3, 0.0));
    (instance, [period, deviation, (square / period).sqrt(), stick / period])
}

/// Names of the numbers.
const NAMES: [&str; 4] = ["period", "x2_std", "ax_rms", "stick"];

/// What is measured of 40 cycles.
fn cycles(method: Method, steps: u32) -> [f64; 4] {
    let (one, [exact, ..]) = stick_slip();
    let plan = Plan { method, measure: Duration::Seconds(40.0 * exact), ..plan(40.0, 1.0, steps) };
    let outcome = respond(&one, &plan);
    assert_eq!(outcome.status, Status::Ok);
    let frequency = outcome.response_frequency;
    [frequency.map(f64::recip), outcome.x2_std, outcome.ax_rms, outcome.stick]
        .map(|value| value.expect("a value"))
}

#[test]
fn located_events_of_stick_slip_keep_order_4() {
    let (one, exact) = stick_slip();
    let measured = [20, 40, 80, 160].map(|steps| cycles(Method::LocatedRk4, steps));
    for (k, name) in NAMES.into_iter().enumerate() {
        let errors = measured.map(|values| (values[k] - exact[k]).abs());
        // Without damping the energy is off by one power less: so are amplitudes.
        assert!(order(&errors) > 3.7, "{name}: {errors:?}");
        assert!(errors[3] < 1e-6, "{name}: {errors:?}");
    }
    let of_events = |steps| {
        let plan = Plan { method: Method::LocatedRk4, ..plan(0.0, 1.0, steps) };
        (period(&log(&one, &plan, 80.0), Event::StickLimit) - exact[0]).abs()
    };
    has_order("time between events", errors(20, of_events), 4.0, 0.4);
}

#[test]
fn transitions_at_the_ends_of_steps_have_order_1() {
    let (one, exact) = stick_slip();
    // How late a transition is depends on the number of steps by chance: the mean over several of them.
    let measured = [40, 160, 640, 2560]
        .map(|steps| [8, 9, 10, 11, 12].map(|part| cycles(Method::FixedStep, steps * part / 8)));
    for (k, name) in NAMES.into_iter().enumerate() {
        let errors = measured.map(|runs| runs.iter().map(|values| (values[k] - exact[k]).abs()).sum::<f64>());
        // From one to the next there are four times as many steps.
        has_order(name, errors, 2.0, 0.4);
        assert!(errors[3] > 1e-6, "{name}: {errors:?}");
    }
    // Every transition is at a step's end.
    let steps = 40;
    let plan = Plan { method: Method::FixedStep, ..plan(0.0, 1.0, steps) };
    let log = log(&one, &plan, 60.0);
    assert!(log.events.len() > 10);
    for (time, ..) in &log.events {
        let count = time / TAU * f64::from(steps);
        near("steps", count, count.round(), 1e-9);
    }
}

#[test]
fn an_event_function_is_looked_at_where_the_step_ends() {
    // Below zero only inside of the step.
    assert_eq!(fixed::at_end(&[1.0, -8.0, 8.0], 1.0, false), Crossing::Never);
    assert_eq!(fixed::at_end(&[1.0, -8.0, 8.0], 0.5, false), Crossing::At(0.5));
    let located = (Method::LocatedRk4.finder())(&[1.0, -8.0, 8.0], 1.0, false);
    let Crossing::At(tau) = located else { panic!("{located:?}") };
    near("root", tau, 0.5 - 0.125_f64.sqrt(), 1e-14);
}

/// The flight of the lifted mass in closed form, see docs/physics.md.
#[test]
fn the_time_of_a_flight_has_order_4() {
    let values = [(Param::Theta, 0.0), (Param::C1, 0.0), (Param::C2, 0.0), (Param::BeltVelocity, 1.0)];
    let one = instance(constant(0.3), &values);
    let scene = Scene::new(&one, StartKind::Kick).expect("an equilibrium");
    let units = scene.units;
    let start = State { position: [0.0, 0.0, 1.0], velocity: [0.0, 0.0, 2.0 / units.velocity] };
    let belt = BeltMotion { velocity: 1.0 / units.velocity, acceleration: 0.0 };
    let time = |method, steps: u32| {
        let resolution =
            Resolution { method, order: 16, nominal_step: TAU / f64::from(steps), tolerance: 1e-11 };
        let mut integrator = Integrator::new(&scene.model, resolution, start, belt).expect("a start");
        let mut flight = Flight::default();
        integrator.advance(0.01 / units.time, belt, &mut flight).expect("a run");
        flight.time.expect("an impact") * units.time
    };
    let located = |steps| (time(Method::LocatedRk4, steps) - 8.267_032_396_547e-3).abs();
    has_order("flight", errors(24, located), 4.0, 0.4);
    // Seen at the end of a step, the impact is late by less than one.
    for steps in [24, 100] {
        let late = time(Method::FixedStep, steps) - 8.267_032_396_547e-3;
        assert!(late > -1e-6 && late < units.period() / f64::from(steps), "{steps}: {late}");
    }
}

/// The end of the first flight.
#[derive(Default)]
struct Flight {
    now: f64,
    time: Option<f64>,
}

impl Observer for Flight {
    fn step(&mut self, step: &Step) {
        self.now = step.start + step.duration;
    }
    fn event(&mut self, event: Event) {
        if matches!(event, Event::Impact { .. }) {
            self.time.get_or_insert(self.now);
        }
    }
}

/// Mode coupling with stick, flight and impacts: with fine steps every method comes to the reference's numbers.
#[test]
fn a_detaching_cycle_is_the_references() {
    let mut one = paper(0.4, 0.4, 3.0);
    one.params.set(Param::StartVelocity, 0.3);
    let run = |method, steps| {
        let outcome = respond(&one, &Plan { method, ..plan(4.0, 4.0, steps) });
        assert_eq!(outcome.status, Status::Ok);
        [outcome.x2_std, outcome.ax_rms, outcome.ay_rms, outcome.stick, outcome.free]
            .map(|value| value.expect("a value"))
    };
    let reference = run(Method::Taylor, 12);
    for (method, steps, within) in [(Method::LocatedRk4, 160, 1e-4), (Method::FixedStep, 2000, 1e-2)] {
        for (value, expected) in run(method, steps).into_iter().zip(reference) {
            close(&format!("{method:?}"), value, expected, within);
        }
    }
}

/// The faster mode of the overdamped single mass decays with `c/2 + sqrt(c²/4 − 1)`; steps beyond 2.785 of its time
/// constants would let it grow.
#[test]
fn a_step_too_long_for_the_fastest_mode_is_refused() {
    let steps = 12;
    for (damping, expected) in [(4.5, Status::Ok), (6.0, Status::StepTooLarge)] {
        let one = single_mass(FrictionLaw::Constant { mu_s: 0.3, mu_d: 0.3 }, 2.0, damping, (0.3, 0.5));
        let turn = (0.5 * damping + (0.25 * damping * damping - 1.0_f64).sqrt()) * TAU / f64::from(steps);
        assert_eq!(turn < 2.785, expected == Status::Ok, "{turn}");
        for method in [Method::LocatedRk4, Method::FixedStep] {
            assert_eq!(respond(&one, &Plan { method, ..plan(50.0, 50.0, steps) }).status, expected);
        }
        assert_eq!(respond(&one, &plan(50.0, 50.0, steps)).status, Status::Ok);
    }
}
