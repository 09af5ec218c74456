//! Laws whose friction changes within a layer of speeds far thinner than those of the motion, and rows of the same kind: no
//! engine may step over what it does not see, nor give up where another comes through.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration as Time, Instant};

use crate::common::{close, instance, near, plan};
use crate::engines::Engine;
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::lanes::again::outcomes_again;
use squealmap::engine::lanes::words::Words;
use squealmap::engine::method::pace::Turns;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::engine::reference::respond::respond_until;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::piece::Piece;
use squealmap::model::status::Status;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_SETTLE};

const TABLE_1: [Param; 11] = [
    Param::M1,
    Param::M2,
    Param::K1,
    Param::K2,
    Param::C1,
    Param::C2,
    Param::FExt,
    Param::Theta,
    Param::BeltVelocity,
    Param::StartVelocity,
    Param::StartDisplacement,
];

fn periods(settle: f64, measure: f64, steps_per_period: u32) -> Plan {
    let [settle, measure] = [settle, measure].map(Duration::Periods);
    Plan { settle, measure, ..plan(0.0, 1.0, steps_per_period) }
}

/// Single precision as a sweep has it: what ends early is computed again.
fn run(engine: Engine, instance: &Instance, plan: &Plan) -> Outcome {
    let made = engine.run_all(std::slice::from_ref(instance), plan);
    if !matches!(engine, Engine::CpuF32 | Engine::KernelF32) {
        return made[0];
    }
    let again = outcomes_again(std::slice::from_ref(instance), plan, made, &AtomicBool::new(false));
    again.expect("nobody stops it")[0]
}

/// Found by a search over extremes, where the engines ended differently: instances with what made the difference.
fn found() -> Vec<(&'static str, Instance, Plan)> {
    let one = |law: FrictionLaw, values: [f64; 11]| {
        let values: Vec<(Param, f64)> = TABLE_1.into_iter().zip(values).collect();
        instance(law, &values)
    };
    let exponential = |mu_s: f64, mu_d: f64, stribeck_velocity: f64| FrictionLaw::Exponential {
        mu_s,
        mu_d,
        stribeck_velocity,
    };
    let bilinear =
        |mu_s: f64, mu_d: f64, knee_velocity: f64| FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity };
    vec![
        (
            "0 times infinity, falling",
            one(
                exponential(0.1125, 0.1123, 1.145e-4),
                [0.3186, 0.5503, 26599.0, 51312.0, 0.0, 0.847, 9309.7, -1.224e-4, 3.0, 6.0, -0.03493],
            ),
            periods(5.0, 5.0, 12),
        ),
        (
            "0 times infinity, rising",
            one(
                exponential(0.2885, 0.4362, 1.139e-8),
                [13.53, 0.2384, 103_926.0, 520_294.0, 9.9e-3, 0.512, 323.5, 0.0, 0.01725, 1.725e-4, 0.0],
            ),
            periods(20.0, 20.0, 12),
        ),
        (
            "0 times infinity, level",
            one(
                exponential(0.4847, 0.4847, 6.5e-7),
                [1.292, 1.593, 469_210.0, 187_360.0, 0.15, 0.0129, 389.97, -8.3e-6, 0.09536, 0.0163, 0.0],
            ),
            periods(20.0, 20.0, 60),
        ),
        (
            "a pole that no position shows",
            one(
                FrictionLaw::Rational { mu_s: 0.8784, decay: 102_135.0 },
                [1.472, 0.2304, 150_994.0, 68161.0, 0.01824, 0.508, 2672.7, -0.03338, 0.1519, 1.866, 0.0],
            ),
            periods(5.0, 5.0, 4),
        ),
        (
            "the same of a single mass",
            one(
                FrictionLaw::Rational { mu_s: 0.2317, decay: 2824.8 },
                [2.111, 0.1303, 314_950.0, 71246.0, 0.0, 0.1309, 8318.0, 0.0, 0.0, -346.95, 0.10587],
            ),
            periods(5.0, 5.0, 12),
        ),
        (
            "a rising row beside stick",
            one(
                bilinear(0.5125, 1.1496, 8.8e-9),
                [18.44, 0.1657, 457_440.0, 295_970.0, 0.0177, 0.4535, 8755.5, -2.448e-3, 0.0, 0.0, 0.0],
            ),
            periods(5.0, 5.0, 60),
        ),
        (
            "friction beyond the ends of a narrow row",
            one(
                bilinear(1.9476, 1.4982, 2.31e-13),
                [2.931, 0.4156, 72149.0, 93739.0, 0.0486, 0.0331, 275.7, -6.894e-3, 0.0, 0.031, 0.0],
            ),
            periods(5.0, 5.0, 60),
        ),
        (
            "a start on a steep falling row",
            one(
                bilinear(1.1046, 0.8497, 3.9e-9),
                [2.474e-3, 2.222e-3, 7.613e6, 1.579e6, 0.0, 0.0, 13.58, 0.4995, 0.0, 0.0, -1.847e-4],
            ),
            periods(5.0, 5.0, 12),
        ),
        (
            "a knee beside which the search for roots goes on and on",
            one(
                bilinear(0.618_181_8, 0.25, 3e-8),
                [2.12, 0.18, 100_000.0, 101_000.0, 0.1, 0.1, 1000.0, 0.1, 1.0, 0.05, 0.0],
            ),
            periods(40.0, 20.0, 12),
        ),
        (
            "a release that rounding turns back",
            one(
                exponential(0.0799, 0.0615, 5.34e-12),
                [37.96, 0.4209, 1207.8, 1.357e6, 0.2486, 0.0, 9.545, 0.4111, 0.0, 0.0, -8.5e-4],
            ),
            periods(20.0, 20.0, 4),
        ),
    ]
}

#[test]
fn engines_agree_where_friction_changes_at_once() {
    for (name, instance, plan) in found() {
        let reference = run(Engine::Reference, &instance, &plan);
        assert_eq!(reference.status, Status::Ok, "{name}");
        // Where f32 is given up after millions of steps its twin takes minutes, and only f64 counts in the end.
        for engine in [Engine::CpuF64, Engine::CpuF32, Engine::KernelF64] {
            let made = run(engine, &instance, &plan);
            assert_eq!(made.status, Status::Ok, "{name}, {}", engine.name());
            // Chaotic motions are compared by nothing finer.
            let stick = |one: &Outcome| one.stick.expect("a share");
            near(&format!("{name}, {}: stick", engine.name()), stick(&made), stick(&reference), 0.05);
        }
    }
}

/// A law that falls at once is one with a limit of stick above its friction in slip, whose cycle has a closed form
/// (docs/physics.md, section 6). Nothing of a layer shows in the positions.
#[test]
fn a_thin_layer_is_a_jump() {
    let (mu_s, mu_d, belt) = (0.5, 0.3, 0.5);
    let (stiffness, mass, force) = (1e5, 2.3, 1e3);
    let omega = f64::sqrt(stiffness / mass);
    let gap = (mu_s - mu_d) * force;
    let alpha = gap * omega / (stiffness * belt);
    let cycle = 2.0 * gap / (stiffness * belt) + 2.0 / omega * (TAU / 2.0 - alpha.atan());
    let plan = periods(20.0, 40.0, 12);
    let values = [
        (Param::Theta, 0.0),
        (Param::C1, 0.0),
        (Param::C2, 0.0),
        (Param::BeltVelocity, belt),
        (Param::StartVelocity, belt),
    ];
    // What the layer adds to a cycle goes with its width: 3e-5 at 1e-4, 1e-4 of it at 1e-8.
    for (width, error) in [(1e-4, 2e-4), (1e-8, 2e-7)] {
        let law = FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: width * belt };
        for engine in [Engine::Reference, Engine::CpuF64, Engine::KernelF64] {
            let made = run(engine, &instance(law.clone(), &values), &plan);
            assert_eq!(made.status, Status::Ok, "{} at {width:e}", engine.name());
            let frequency = made.response_frequency.expect("a cycle");
            close(&format!("{} at {width:e}", engine.name()), frequency, 1.0 / cycle, error);
        }
    }
}

/// Where slip ends, friction has risen to `μ_s`, and the spring has as much less than `μ_d` as it had more where slip began: the
/// acceleration is twice the gap over the mass, and larger than anywhere else on the way. No position shows it.
#[test]
fn the_peak_of_the_acceleration_is_that_at_the_end_of_slip() {
    let (mu_s, mu_d, belt, mass, force) = (0.5, 0.3, 0.5, 2.3, 1e3);
    let values = [
        (Param::Theta, 0.0),
        (Param::C1, 0.0),
        (Param::C2, 0.0),
        (Param::FExt, force),
        (Param::BeltVelocity, belt),
        (Param::StartVelocity, belt),
    ];
    // The layer itself takes a part of the way that goes with its width.
    for (width, error) in [(1e-4, 1e-3), (1e-6, 2e-5)] {
        let law = FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: width * belt };
        let one = instance(law, &values);
        for engine in
            [Engine::Reference, Engine::CpuF64, Engine::CpuF32, Engine::KernelF64, Engine::KernelF32]
        {
            let made = run(engine, &one, &periods(20.0, 20.0, 12));
            let peak = made.ax_peak.expect("a peak");
            let name = format!("{} at {width:e}", engine.name());
            close(&name, peak, 2.0 * (mu_s - mu_d) * force / mass, error);
        }
    }
}

/// Friction that rises near rest, where the body leaves the belt: on a step beyond the pole of its motion f32 saw the normal force
/// fall to zero where it was twice that of the equilibrium, thousands of times a second, and accelerations were 10 to 50 % off,
/// those of the peaks in f64 and of the reference as well.
#[test]
fn friction_that_rises_near_rest_lets_nothing_fly() {
    let rising = |mu_s: f64, mu_d: f64, stribeck_velocity: f64, rest: [(Param, f64); 3]| {
        instance(FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity }, &rest)
    };
    let at = |theta: f64, belt: f64, start: f64| {
        [(Param::Theta, theta), (Param::BeltVelocity, belt), (Param::StartVelocity, start)]
    };
    let cases = [
        rising(0.0, 0.6, 5e-3, at(0.1, 2.0, 0.01)),
        rising(0.0, 0.6, 5e-2, at(0.1, 2.0, 0.01)),
        rising(0.2, 0.21, 2e-4, at(-0.2, 1e-3, 0.5)),
    ];
    for one in cases {
        let finest = run(Engine::Reference, &one, &periods(20.0, 10.0, 60));
        for engine in
            [Engine::Reference, Engine::CpuF64, Engine::CpuF32, Engine::KernelF64, Engine::KernelF32]
        {
            let made = run(engine, &one, &periods(20.0, 10.0, 12));
            let name = format!("{} of {:?}", engine.name(), one.law);
            near(
                &name,
                made.impacts_per_second.expect("a rate"),
                finest.impacts_per_second.expect("a rate"),
                1e-3,
            );
            close(&name, made.ax_rms.expect("one"), finest.ax_rms.expect("one"), 5e-4);
            close(&name, made.ax_peak.expect("one"), finest.ax_peak.expect("one"), 5e-3);
        }
    }
}

/// What holds between the closed forms: layers of a tenth to a thousandth of the velocities, the CPU engine's friction at rest
/// as the law's.
#[test]
fn a_layer_of_any_width_is_that_of_the_reference() {
    let values = [
        (Param::Theta, 0.0),
        (Param::C1, 0.0),
        (Param::C2, 0.0),
        (Param::BeltVelocity, 0.5),
        (Param::StartVelocity, 0.5),
    ];
    let plan = periods(20.0, 40.0, 12);
    for width in [5e-2, 5e-3, 5e-4] {
        let exponential = FrictionLaw::Exponential { mu_s: 0.5, mu_d: 0.3, stribeck_velocity: width };
        let rational = FrictionLaw::Rational { mu_s: 0.5, decay: 1.0 / width };
        for law in [exponential, rational] {
            let one = instance(law, &values);
            let expected = run(Engine::Reference, &one, &plan);
            for (engine, error) in [(Engine::CpuF64, 1e-5), (Engine::CpuF32, 1e-4), (Engine::KernelF64, 3e-3)]
            {
                let made = run(engine, &one, &plan);
                let name = format!("{} at {width:e}", engine.name());
                close(&name, made.x2_std.expect("one"), expected.x2_std.expect("one"), error);
            }
        }
    }
}

/// A motion that grows far above the layer until it reaches it: what is left of the fall at such speeds is nothing, and
/// rounding must not make more of it.
#[test]
fn what_is_left_of_a_fall_is_as_small_as_it_is() {
    let plan = Plan {
        settle: FIRST_SETTLE,
        settle_limit: Some(Duration::Periods(1000.0)),
        measure: AUTO_MEASURE,
        ..periods(1.0, 1.0, 12)
    };
    for ratio in [250.0, 1e3, 1e5] {
        let law = FrictionLaw::Exponential { mu_s: 0.4, mu_d: 0.2, stribeck_velocity: 10.0 / ratio };
        let values = [(Param::Theta, 0.05), (Param::BeltVelocity, 10.0), (Param::StartVelocity, 0.05)];
        let one = instance(law, &values);
        let expected = run(Engine::Reference, &one, &plan);
        for engine in [Engine::CpuF64, Engine::CpuF32, Engine::KernelF64, Engine::KernelF32] {
            let made = run(engine, &one, &plan);
            let name = format!("{} at V = {ratio:e} v0", engine.name());
            close(&name, made.x2_std.expect("one"), expected.x2_std.expect("one"), 1e-3);
        }
    }
}

/// Friction that rises within a layer so thin that steps there do not move a position in f32: it was told as settled, 2 % off,
/// after millions of steps.
#[test]
fn a_thin_rise_is_left_to_f64() {
    let laws: [fn(f64) -> FrictionLaw; 2] = [
        |knee_velocity| FrictionLaw::Bilinear { mu_s: 0.2, mu_d: 0.5, knee_velocity },
        |stribeck_velocity| FrictionLaw::Exponential { mu_s: 0.2, mu_d: 0.5, stribeck_velocity },
    ];
    let widths = [(1e-3, 4e-7), (1e-3, 1e-6), (1.0, 1e-4)];
    for (law, (velocity, knee)) in laws.into_iter().flat_map(|law| widths.map(|width| (law, width))) {
        let law = law(knee);
        let values = [(Param::Theta, 0.0), (Param::BeltVelocity, velocity), (Param::StartVelocity, velocity)];
        let one = instance(law, &values);
        let plan = periods(20.0, 10.0, 24);
        let expected = run(Engine::Reference, &one, &plan);
        for engine in [Engine::CpuF64, Engine::CpuF32, Engine::KernelF64, Engine::KernelF32] {
            let made = run(engine, &one, &plan);
            let name = format!("{} of {:?} at a knee of {knee:e}", engine.name(), one.law);
            assert_eq!(made.status, expected.status, "{name}");
            assert!(made.steps < 100_000, "{name}: {} steps", made.steps);
            close(&name, made.x2_std.expect("one"), expected.x2_std.expect("one"), 1e-3);
        }
    }
}

/// A layer in which friction rises keeps the motion from coming to rest: it is limited without any event, and its sums say nothing of
/// how it grew. As long as it is small they say what the eigenvalues say, 11.318 1/s.
#[test]
fn growth_that_a_law_ends_without_an_event_is_not_stated() {
    let grown = |start: f64| {
        instance(
            FrictionLaw::Exponential { mu_s: 0.48942, mu_d: 0.76689, stribeck_velocity: 6.3758e-5 },
            &[
                (Param::Theta, 0.068_153),
                (Param::BeltVelocity, 0.063_876),
                (Param::C1, 13.038),
                (Param::C2, 15.2334),
                (Param::K2, 120_594.0),
                (Param::M1, 4.55522),
                (Param::M2, 0.449_343),
                (Param::StartVelocity, start),
            ],
        )
    };
    for engine in [Engine::Reference, Engine::CpuF64] {
        let limited = run(engine, &grown(-9.4e-4), &periods(20.0, 30.0, 12));
        assert!(limited.status == Status::Ok && !limited.met_event, "{limited:?}");
        assert_eq!(limited.growth_rate_measured, None, "{}", engine.name());
        let small = run(engine, &grown(-1e-7), &periods(10.0, 10.0, 12));
        close(engine.name(), small.growth_rate_measured.expect("a rate"), 11.318, 1e-2);
    }
}

fn friction_of<T: Real>(instance: &Instance, speed: f64) -> f64 {
    let scene = Scene::new(instance, StartKind::Kick).expect("an equilibrium");
    let turns = Turns::new(13, 1e-6);
    let words: Words<T> = Words::new(instance.law.kind().form(), &scene, &turns);
    words.mu(T::from_f64(speed / scene.units.velocity)).to_f64()
}

/// However thin the layer: the friction of rare events is that of the law, at rest too.
#[test]
fn friction_at_rest_is_that_of_the_law() {
    for ratio in [0.1, 10.0, 79.0, 81.0, 200.0, 1e4, 1e8] {
        let (belt, layer) = (3.0, 3.0 / ratio);
        let law = FrictionLaw::Exponential { mu_s: 0.5, mu_d: 0.3, stribeck_velocity: layer };
        let one = instance(law.clone(), &[(Param::BeltVelocity, belt)]);
        for speed in [0.0, 0.3 * layer, layer, 5.0 * layer, 0.5 * belt, belt, 2.0 * belt] {
            let name = format!("V = {ratio} v0, |v| = {speed:e}");
            near(&name, friction_of::<f64>(&one, speed), law.mu(speed), 1e-13);
            near(&name, friction_of::<f32>(&one, speed), law.mu(speed), 3e-6);
        }
    }
}

/// A change far up an exponential is that of its values, where its foot is 0 and the ratio infinite.
#[test]
fn a_change_up_an_exponential_is_a_number() {
    let law = Piece::Exponential { floor: 0.3, height: 0.2, rate: 1e6 };
    close("all of it", law.change(3.0, -3.0), 0.2, 1e-15);
    close("e^-1", law.change(3.0, 1e-6 - 3.0), 0.2 * (-1.0_f64).exp(), 1e-9);
    // Small changes keep their digits.
    let gentle = Piece::Exponential { floor: 0.3, height: 0.2, rate: 1.0 };
    close("small", gentle.change(1.0, 1e-12), -2e-13 * (-1.0_f64).exp(), 1e-11);
}

/// Painlevé's is what the law can do, not what a row does beyond its ends.
#[test]
fn painleve_is_told_of_laws_that_can() {
    let steep = FrictionLaw::Bilinear { mu_s: 1.9, mu_d: 1.4, knee_velocity: 1e-12 };
    let told = |law: FrictionLaw, theta: f64| {
        let one = instance(law, &[(Param::Theta, theta), (Param::BeltVelocity, 1.0)]);
        Scene::new(&one, StartKind::Kick).expect("an equilibrium").model.told(Status::Painleve)
    };
    assert_eq!(told(steep.clone(), 0.01), Status::StepTooLarge);
    // The limit of μ is 1.17 at π/4.
    assert_eq!(told(steep, 0.25 * std::f64::consts::PI), Status::Painleve);
}

/// A run of the reference may have minutes of steps: a wish to stop is heard on the way.
#[test]
fn a_run_of_the_reference_hears_a_wish_to_stop() {
    let plan = periods(1e6, 1e5, 12);
    let one = instance(
        crate::common::constant(0.1),
        &[(Param::BeltVelocity, 3.0), (Param::C1, 0.0), (Param::C2, 0.0)],
    );
    let cancel = AtomicBool::new(false);
    let began = Instant::now();
    let outcome = std::thread::scope(|scope| {
        let run = scope.spawn(|| respond_until(&one, &plan, &cancel));
        std::thread::sleep(Time::from_millis(100));
        assert!(!run.is_finished(), "too short a run to be stopped");
        cancel.store(true, Ordering::Relaxed);
        run.join().expect("no panic")
    });
    assert_eq!((outcome.status, outcome.x2_std), (Status::NotComputed, None));
    assert!(began.elapsed() < Time::from_secs(5), "{:?}", began.elapsed());
}
