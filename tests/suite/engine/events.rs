//! Event times against exact sums, and the single mass on a belt against its closed forms.

use crate::common::{close, constant, instance, near, paper, plan};
use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::{BeltMotion, State};
use squealmap::engine::plan::{Plan, StartKind};
use squealmap::engine::reference::observer::Event;
use squealmap::engine::reference::observer::Observer;
use squealmap::engine::reference::observer::Step;
use squealmap::engine::scene::Scene;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::{Param, Params};

/// Every event with its time (s) and the motion just before it, and the extremes of `x2` (m) at step ends.
pub(crate) struct Log {
    unit: squealmap::model::equilibrium::Units,
    x2_eq: f64,
    last: (f64, [f64; 3], [f64; 3]),
    pub(crate) events: Vec<(f64, Event, [f64; 3], [f64; 3])>,
    turning_points: Vec<(f64, f64)>,
}

impl Observer for Log {
    fn step(&mut self, step: &Step) {
        let end = (step.start + step.duration) * self.unit.time;
        let state = step.end.state;
        let before = step.expansion.motion(0.0).state.velocity[0];
        if before * state.velocity[0] < 0.0 {
            // The zero of ẋ2 inside the step by bisection on the series.
            let (mut low, mut high) = (0.0, step.duration);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                let velocity = step.expansion.motion(middle).state.velocity[0];
                if velocity * before > 0.0 { low = middle } else { high = middle }
            }
            let x = step.expansion.motion(high).state.position[0] * self.unit.length + self.x2_eq;
            self.turning_points.push(((step.start + high) * self.unit.time, x));
        }
        self.last = (end, state.position, state.velocity.map(|v| v * self.unit.velocity));
    }
    fn event(&mut self, event: Event) {
        self.events.push((self.last.0, event, self.last.1, self.last.2));
    }
}

pub(crate) fn log(instance: &Instance, plan: &Plan, seconds: f64) -> Log {
    let scene = Scene::new(instance, plan.start).expect("an equilibrium");
    let mut integrator = scene.integrator(plan).expect("a start");
    let mut log = Log {
        unit: scene.units,
        x2_eq: scene.equilibrium.x2,
        last: Default::default(),
        events: Vec::new(),
        turning_points: Vec::new(),
    };
    scene.advance(&mut integrator, seconds / scene.units.time, &mut log).expect("a complete run");
    log
}

#[test]
fn first_zero_of_the_relative_velocity_to_1e_9_s() {
    for (mu, velocity, expected) in
        [(0.4, 7.0, 1.592_653_455_5), (0.4, 3.0, 1.387_011_992_5), (0.8, 7.0, 0.913_750_979_4)]
    {
        for steps in [12, 60] {
            let log = log(&paper(mu, mu, velocity), &plan(0.0, 1.0, steps), 2.0);
            let (time, event, ..) = log.events[0];
            assert_eq!(event, Event::Rest);
            near(&format!("μ = {mu}, V = {velocity}, {steps} steps"), time, expected, 1e-9);
        }
    }
}

/// The single mass `m = k = 1` under `N = 1`: θ = 0 with the mass shared between `m1` and `m2`.
pub(crate) fn single_mass(law: FrictionLaw, velocity: f64, damping: f64, start: (f64, f64)) -> Instance {
    instance(
        law,
        &[
            (Param::Theta, 0.0),
            (Param::M1, 0.5),
            (Param::M2, 0.5),
            (Param::K1, 1.0),
            (Param::K2, 1.0),
            (Param::C1, damping),
            (Param::C2, 0.0),
            (Param::FExt, 1.0),
            (Param::BeltVelocity, velocity),
            (Param::StartDisplacement, start.0),
            (Param::StartVelocity, start.1),
        ],
    )
}

/// Times between successive events `event` once the motion is periodic: the last difference.
pub(crate) fn period(log: &Log, event: Event) -> f64 {
    let times: Vec<f64> = log.events.iter().filter(|entry| entry.1 == event).map(|entry| entry.0).collect();
    times[times.len() - 1] - times[times.len() - 2]
}

/// The largest and smallest turning point of the last cycles.
fn extremes(log: &Log) -> (f64, f64) {
    let last = &log.turning_points[log.turning_points.len() - 4..];
    let values = last.iter().map(|point| point.1);
    (values.clone().fold(f64::MIN, f64::max), values.fold(f64::MAX, f64::min))
}

#[test]
fn constant_law_stick_slip_in_closed_form() {
    let law = FrictionLaw::Constant { mu_s: 0.4, mu_d: 0.25 };
    let log = log(&single_mass(law, 0.1, 0.0, (0.3, 0.0)), &plan(0.0, 1.0, 12), 80.0);
    close("period", period(&log, Event::StickLimit), 7.317_597_860_685, 1e-11);
    let (top, bottom) = extremes(&log);
    close("amplitude", 0.5 * (top - bottom), 0.180_277_563_773, 1e-11);
    close("centre", 0.5 * (top + bottom), 0.25, 1e-11);
}

#[test]
fn rational_law_of_leine() {
    let law = FrictionLaw::Rational { mu_s: 1.0, decay: 3.0 };
    let log = log(&single_mass(law, 0.2, 0.0, (1.0, 0.0)), &plan(0.0, 1.0, 24), 120.0);
    close("period", period(&log, Event::StickLimit), 12.001_031_295_0, 1e-10);
    let (top, bottom) = extremes(&log);
    // 25-digit Taylor integration of the slip phase from x = 1, ẋ = V (mpmath); physics.md ends in …901.
    close("x max", top, 1.133_944_676_441_66, 1e-10);
    close("x min", bottom, -0.555_432_690_060_23, 1e-10);
    let slip_starts = log.events.iter().rposition(|entry| entry.1 == Event::StickLimit).expect("slip");
    let slip_ends = log.events[..slip_starts].iter().rposition(|entry| entry.1 == Event::Rest);
    let previous = log.events[..slip_starts].iter().rposition(|entry| entry.1 == Event::StickLimit);
    let slip = log.events[slip_ends.expect("stick")].0 - log.events[previous.expect("slip")].0;
    close("slip", slip, 4.295_999_525_5, 1e-10);
}

fn bstab(velocity: f64, position: f64, speed: f64) -> Instance {
    let law = FrictionLaw::Exponential { mu_s: 1.0, mu_d: 0.5, stribeck_velocity: 0.5 };
    // Starts are absolute positions; the kick counts from the equilibrium, x_eq = μ(V) N/k.
    let equilibrium = law.mu(velocity);
    single_mass(law, velocity, 0.1, (position - equilibrium, speed))
}

#[test]
fn exponential_law_of_bstab() {
    let log = log(&bstab(1.5, -2.0, 1.5), &plan(0.0, 1.0, 24), 200.0);
    close("period", period(&log, Event::StickLimit), 6.316_306_36, 2e-9);
    let (top, bottom) = extremes(&log);
    // 25-digit Taylor integration from x = 0.85, ẋ = V (mpmath, DOP853 agrees); physics.md has …604.
    close("x max", top, 2.206_496_130_150_02, 1e-10);
    close("x min", bottom, -0.952_825_782_649_40, 1e-10);
    // The cycle ends at V = 1.83660097: it lives on below and dies out above.
    let sticks_late = |velocity: f64| {
        let log = self::log(&bstab(velocity, -2.0, velocity), &plan(0.0, 1.0, 24), 1500.0);
        log.events.iter().any(|entry| entry.1 == Event::StickLimit && entry.0 > 1400.0)
    };
    assert!(sticks_late(1.8365));
    assert!(!sticks_late(1.8367));
}

#[test]
fn basin_of_sliding_of_bstab() {
    let side = 48;
    let mut sliding = 0_u32;
    for i in 0..side {
        for j in 0..side {
            let cell = |k: usize| (k as f64 + 0.5) / side as f64;
            let instance = bstab(1.5, -2.0 + 4.0 * cell(i), 2.0 * cell(j));
            // A cycle sticks once per turn; a start that slides without sticking for 8 turns stays sliding.
            let log = log(&instance, &plan(0.0, 1.0, 12), 80.0);
            let sticks = log.events.iter().any(|entry| entry.1 == Event::StickLimit && entry.0 > 60.0);
            sliding += u32::from(!sticks);
        }
    }
    // The area of a smooth basin on a grid of side n is good to about 1/n^1.5.
    near("fraction", f64::from(sliding) / (side * side) as f64, 0.3071, 0.004);
}

#[test]
fn exponential_equilibrium_loses_stability_at_its_velocity() {
    use squealmap::model::linear::analyse;
    let growth = |velocity| analyse(&bstab(velocity, 0.0, 0.0)).1.expect("an equilibrium").growth_rate;
    let (mut low, mut high) = (1.0, 1.3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        // At θ = 0 the decoupled, undamped normal mode stays at growth 0.
        if growth(middle) > 1e-12 { low = middle } else { high = middle }
    }
    near("critical velocity", high, 1.151_292_546_5, 1e-9);
}

#[test]
fn free_flight_in_closed_form() {
    for (u0, time, velocity) in
        [(1.0, 5.820_547_148_887e-3, -2.001_160_971), (2.0, 8.267_032_396_547e-3, -3.476_113_151)]
    {
        let values = [(Param::Theta, 0.0), (Param::C1, 0.0), (Param::C2, 0.0), (Param::BeltVelocity, 1.0)];
        let instance = instance(constant(0.3), &values);
        let scene = Scene::new(&instance, StartKind::Kick).expect("an equilibrium");
        // y1 = y2 = 0: the spring is unstretched, one static deflection above the equilibrium.
        let start = State { position: [0.0, 0.0, 1.0], velocity: [0.0, 0.0, u0 / scene.units.velocity] };
        let resolution = squealmap::engine::reference::resolution::Resolution {
            method: Method::Taylor,
            order: 14,
            nominal_step: std::f64::consts::TAU / 24.0,
            tolerance: 1e-9,
        };
        let belt = BeltMotion { velocity: 1.0 / scene.units.velocity, acceleration: 0.0 };
        let mut integrator =
            squealmap::engine::reference::integrate::Integrator::new(&scene.model, resolution, start, belt)
                .expect("a start");
        let mut log = Log {
            unit: scene.units,
            x2_eq: 0.0,
            last: Default::default(),
            events: Vec::new(),
            turning_points: Vec::new(),
        };
        integrator.advance(0.01 / scene.units.time, belt, &mut log).expect("a complete run");
        let (at, event, _, velocities) = log.events[0];
        assert!(matches!(event, Event::Impact { .. }), "{event:?}");
        near("time of flight", at, time, 1e-12);
        near("velocity of impact", velocities[1], velocity, 1e-9);
    }
}

#[test]
fn painleve_limits() {
    let limit = |theta: f64| {
        let params = Params::default();
        let (m1, m2) = (params.require(Param::M1), params.require(Param::M2));
        (m2 + m1 * theta.cos().powi(2)) / (m1 * theta.sin() * theta.cos())
    };
    for (theta, expected, digits) in [(0.01, 108.4878, 1e-4), (std::f64::consts::FRAC_PI_4, 1.1698, 1e-4)] {
        near("closed form", limit(theta), expected, digits);
        let inertia = |mu: f64| {
            let instance = instance(constant(mu), &[(Param::Theta, theta), (Param::BeltVelocity, 1.0)]);
            Scene::new(&instance, StartKind::Kick).expect("an equilibrium").model.slip_inertia(-mu)
        };
        assert!(inertia(expected * 0.9999) > 0.0 && inertia(expected * 1.0001) < 0.0);
    }
}
