//! The single mass with constant friction, which the engine follows in closed form from event to event: against the Taylor
//! series of the reference, for every damping it takes.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::AtomicBool;

use crate::common::{close, instance, plan};
use crate::engines::Engine;
use crate::instances::Uniform;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::method::Method;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::reference::respond::respond;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

const COUNT: usize = 300;

/// Single masses, undamped and damped (up to a decay rate of 0.28 of the angular frequency; what has more than 0.3 does not
/// swing), that begin slower and faster than their belts, some of which stand.
fn instances() -> Vec<Instance> {
    let mut u = Uniform(41);
    (0..COUNT)
        .map(|k| {
            let mu_d = 0.4 * u.next();
            // Without a damper the cycle of equal coefficients only touches the velocity of the belt.
            let mu_s = if k % 5 == 0 && k % 3 > 0 { mu_d } else { mu_d + 0.4 * u.next() };
            let velocity = if k % 11 == 0 { 0.0 } else { u.log(0.02, 4.0) };
            let mut one = instance(
                FrictionLaw::Constant { mu_s, mu_d },
                &[(Param::Theta, 0.0), (Param::BeltVelocity, velocity)],
            );
            one.params.set(Param::StartVelocity, 4.0 * u.next() - 2.0);
            one.params.set(Param::StartDisplacement, 4e-3 * (u.next() - 0.5));
            let damper = match k % 3 {
                0 => 0.0,
                1 => u.log(0.01, 10.0),
                _ => 260.0 * u.next(),
            };
            one.params.set(Param::C1, damper);
            one
        })
        .collect()
}

fn periods(settle: f64, measure: f64, steps_per_period: u32) -> Plan {
    Plan {
        settle: Duration::Periods(settle),
        measure: Duration::Periods(measure),
        ..plan(1.0, 1.0, steps_per_period)
    }
}

fn run<T: Lanes>(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    outcomes::<T>(instances, plan, &AtomicBool::new(false)).expect("nobody stops it")
}

fn reference(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    instances.iter().map(|instance| respond(instance, plan)).collect()
}

/// Each number of an outcome with the size that its error is relative to.
fn numbers(o: &Outcome) -> Vec<(&'static str, Option<f64>, f64)> {
    let size = |value: Option<f64>| value.unwrap_or(0.0).abs();
    let (x, a) = (size(o.x2_std).max(size(o.x2_mean)), size(o.ax_peak));
    vec![
        ("x2_mean", o.x2_mean, x),
        ("x2_std", o.x2_std, x),
        ("ax_rms", o.ax_rms, a),
        ("ax_peak", o.ax_peak, a),
        ("friction_mean", o.friction_mean, size(o.n_peak)),
        ("n_peak", o.n_peak, size(o.n_peak)),
        ("response_frequency", o.response_frequency, size(o.response_frequency)),
        ("frequency_measured", o.frequency_measured, size(o.frequency_measured)),
        ("growth_rate_measured", o.growth_rate_measured, size(o.frequency_measured)),
        ("stick", o.stick, 1.0),
        ("reverse", o.reverse, 1.0),
        ("speed_rms, first half", Some(o.speed_rms_halves[0]), o.speed_rms_halves[0]),
        ("speed_rms, second half", Some(o.speed_rms_halves[1]), o.speed_rms_halves[1]),
        ("x2_std, second half", Some(o.x2_std_halves[1]), x),
        ("simulated_time", Some(o.simulated_time), o.simulated_time),
    ]
}

/// The errors of all numbers, the largest last; what moves by less than `still` of a metre per second squared is at rest.
fn errors(made: &[Outcome], expected: &[Outcome], still: f64) -> Vec<(f64, usize, &'static str)> {
    let mut errors = Vec::new();
    for (index, (ours, theirs)) in made.iter().zip(expected).enumerate() {
        assert_eq!([ours.status, theirs.status], [Status::Ok; 2], "{index}");
        assert_eq!(ours.ay_peak, Some(0.0), "{index}");
        if theirs.ax_peak < Some(still) && ours.ax_peak < Some(still) {
            continue;
        }
        for ((name, made, _), (_, expected, size)) in numbers(ours).into_iter().zip(numbers(theirs)) {
            let error = match (made, expected) {
                (Some(made), Some(expected)) => (made - expected).abs() / size.max(f64::MIN_POSITIVE),
                (None, None) => continue,
                _ => f64::INFINITY,
            };
            errors.push((error, index, name));
        }
    }
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    errors
}

/// The steps per period of the reference: its largest acceleration, of a parabola between samples, is off by their cube.
const FINE: u32 = 200;

// What rests has a deviation of the root of the rounding of its distance: hence bounds that wide.

/// Runs of a beginning, in which some slip backwards, and behind it.
const RUNS: [[f64; 2]; 2] = [[0.3, 2.2], [12.0, 10.0]];

fn agrees<T: Lanes>(bound: f64, still: f64) {
    let instances = instances();
    let mut seen = [0; 2];
    for [settle, measure] in RUNS {
        let expected = reference(&instances, &periods(settle, measure, FINE));
        for steps_per_period in [3, 12] {
            let made = run::<T>(&instances, &periods(settle, measure, steps_per_period));
            let errors = errors(&made, &expected, still);
            assert!(errors.len() > 10 * COUNT / 2, "{}", errors.len());
            let worst = errors[errors.len() - 1];
            assert!(worst.0 < bound, "{worst:?}: {:?} {:?}", made[worst.1], expected[worst.1]);
        }
        let count = |what: fn(&Outcome) -> Option<f64>| {
            expected.iter().filter(|outcome| what(outcome) > Some(0.01)).count()
        };
        seen = [seen[0].max(count(|outcome| outcome.stick)), seen[1].max(count(|outcome| outcome.reverse))];
        // Planted fault: a little more of what friction, spring and damper are.
        for (param, by) in [(Param::FExt, 1.01), (Param::K1, 1.01), (Param::C1, 1.05)] {
            let mut planted = instances.clone();
            for instance in &mut planted {
                instance.params.set(param, instance.params.require(param) * by);
            }
            let made = run::<T>(&planted, &periods(settle, measure, 3));
            let errors = errors(&made, &expected, still);
            assert!(errors[errors.len() - 1].0 > 2.0 * bound, "{param:?}");
        }
    }
    assert!(seen[0] > COUNT / 10 && seen[1] > COUNT / 10, "{} stick, {} slip backwards", seen[0], seen[1]);
}

#[test]
fn f64_is_the_motion_of_the_reference() {
    agrees::<f64>(5e-6, 1e-6);
}

#[test]
fn f32_is_the_motion_of_the_reference() {
    agrees::<f32>(2e-3, 1e-1);
}

/// From `ẋ2 = −u` at the equilibrium the velocity is `u exp(−rθ)` at most, with `r = δ/ω` and `θ = π − 2 atan r`: a little more
/// than that of the belt.
#[test]
fn a_stop_at_the_largest_velocity_is_where_the_reference_has_it() {
    let mut u = Uniform(43);
    let grazing: Vec<Instance> = (0..60)
        .map(|k| {
            let velocity = u.log(0.1, 2.0);
            let values =
                [(Param::Theta, 0.0), (Param::BeltVelocity, velocity), (Param::C1, 250.0 * u.next())];
            let mut one = instance(FrictionLaw::Constant { mu_s: 0.6, mu_d: 0.2 }, &values);
            let p = |param| one.params.require(param);
            let mass = p(Param::M1) + p(Param::M2);
            let decay = 0.5 * p(Param::C1) / mass;
            let r = decay / (p(Param::K1) / mass - decay * decay).sqrt();
            let most = velocity * (r * (PI - 2.0 * r.atan())).exp();
            one.params.set(Param::StartVelocity, -most * (1.0 + [1e-5, 1e-4, 1e-3][k % 3]));
            one
        })
        .collect();
    let expected = reference(&grazing, &periods(0.0, 2.0, FINE));
    let made = run::<f64>(&grazing, &periods(0.0, 2.0, 3));
    assert!(expected.iter().all(|outcome| outcome.stick > Some(0.01)));
    let errors = errors(&made, &expected, 1e-6);
    let worst = errors[errors.len() - 1];
    assert!(worst.0 < 5e-6, "{worst:?}: {:?} {:?}", made[worst.1], expected[worst.1]);
}

/// The frequency of a damped single mass.
fn natural(instance: &Instance) -> f64 {
    let p = |param| instance.params.require(param);
    let mass = p(Param::M1) + p(Param::M2);
    let decay = 0.5 * p(Param::C1) / mass;
    (p(Param::K1) / mass - decay * decay).sqrt() / TAU
}

#[test]
fn on_a_belt_at_rest_every_half_swing_takes_the_same_time() {
    let all = |law: &FrictionLaw| {
        let mut instances = instances();
        instances.truncate(COUNT / 3);
        for instance in &mut instances {
            instance.params.set(Param::BeltVelocity, 0.0);
            instance.law = law.clone();
        }
        instances
    };
    let agree = |name: &str, instances: &[Instance], made: &[Outcome], bound: f64| {
        let mut seen = 0;
        for (instance, outcome) in instances.iter().zip(made) {
            if let Some(frequency) = outcome.response_frequency {
                close(name, frequency, natural(instance), bound);
                seen += 1;
            }
        }
        assert!(seen > COUNT / 6, "{name}: {seen}");
    };
    // The second has a kink without a bend: what the closed form leaves to the series.
    let laws = [
        FrictionLaw::Constant { mu_s: 0.02, mu_d: 0.01 },
        FrictionLaw::Bilinear { mu_s: 0.01, mu_d: 0.01, knee_velocity: 0.5 },
    ];
    for (engine, law) in Engine::ALL.into_iter().flat_map(|engine| laws.iter().map(move |law| (engine, law)))
    {
        let instances = all(law);
        let made = engine.run_all(&instances, &periods(0.0, 4.0, 12));
        // The kernel's series is of order 8.
        let bound = if matches!(engine, Engine::Reference | Engine::CpuF64) { 1e-9 } else { 1e-5 };
        agree(&format!("{}, {law:?}", engine.name()), &instances, &made, bound);
    }
    // Steps that end behind the stop, by a hundredth of a swing.
    let (instances, plan) = (all(&laws[0]), Plan { method: Method::FixedStep, ..periods(0.0, 4.0, 200) });
    agree("fixed step", &instances, &reference(&instances, &plan), 0.05);
}

/// A window whose second half begins next to a stop: the square of what little velocity is left rounds below zero.
#[test]
fn a_half_that_begins_next_to_a_stop_has_numbers() {
    let one = instance(
        FrictionLaw::Constant { mu_s: 0.3, mu_d: 2.027_626_322_999_487_7e-10 },
        &[
            (Param::M1, 37.802_801_642_159_93),
            (Param::M2, 8.486_820_933_774_95e-3),
            (Param::K1, 5.309_384_652_719_582e6),
            (Param::K2, 1.371_770_893_726_728_7e5),
            (Param::C1, 1.330_795_104_464_335_7e-2),
            (Param::C2, 0.1),
            (Param::FExt, 7.747_447_527_100_604e6),
            (Param::Theta, 0.0),
            (Param::BeltVelocity, 0.0),
            (Param::StartVelocity, 2.626_540_284_877_115_4e-2),
            (Param::StartDisplacement, 9.107_717_052_632_87e-5),
        ],
    );
    let plan = periods(0.082_468_501_714_644_55, 0.043_847_476_245_966_87, 23_417);
    let outcome = run::<f32>(&[one], &plan)[0];
    assert_eq!(outcome.status, Status::Ok);
    for (name, number, _) in numbers(&outcome) {
        assert!(number.is_none_or(f64::is_finite), "{name} of {outcome:?}");
    }
}

#[test]
fn whole_swings_are_few_steps() {
    let (mut few, mut many) = (0, 0);
    let mut straight = instances();
    straight.retain(|instance| instance.params.require(Param::C1) == 0.0);
    let mut bent = straight.clone();
    for instance in &mut bent {
        let FrictionLaw::Constant { mu_s, mu_d } = instance.law else { panic!("a constant law") };
        // The same but for the last of velocities.
        instance.law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 1e-6 };
    }
    for (ours, theirs) in run::<f64>(&straight, &periods(40.0, 40.0, 12))
        .iter()
        .zip(run::<f64>(&bent, &periods(40.0, 40.0, 12)))
    {
        few += ours.steps;
        many += theirs.steps;
    }
    assert!(2 * few < many, "{few} {many}");
}

/// Of a cycle that repeats itself one is followed: the steps of a window of three times as many cycles are as many, and what they sum
/// is three times as much.
#[test]
fn of_many_equal_cycles_one_is_followed() {
    let cycle = |one: &Instance| {
        let p = |param| one.params.require(param);
        let FrictionLaw::Constant { mu_s, mu_d } = one.law else { panic!("a constant law") };
        let frequency = (p(Param::K1) / (p(Param::M1) + p(Param::M2))).sqrt();
        let alpha = (mu_s - mu_d) * p(Param::FExt) * frequency / p(Param::K1) / p(Param::BeltVelocity);
        // Periods of the free swing, of the model: stick 2α, slip 2 (π − atan α).
        (2.0 * alpha + 2.0 * (PI - alpha.atan())) / TAU
    };
    let mut u = Uniform(47);
    for k in 0..200 {
        let mu_d = 0.05 + 0.3 * u.next();
        let mu_s = mu_d + 0.05 + 0.3 * u.next();
        let mut one = instance(
            FrictionLaw::Constant { mu_s, mu_d },
            &[(Param::Theta, 0.0), (Param::BeltVelocity, u.log(0.05, 2.0)), (Param::C1, 0.0)],
        );
        one.params.set(Param::StartVelocity, 1.2 * one.params.require(Param::BeltVelocity));
        let period = cycle(&one);
        let runs =
            [4.0, 12.0].map(|cycles| run::<f64>(&[one.clone()], &periods(10.0, cycles * period, 12))[0]);
        let [short, long] = runs;
        assert!(short.stick > Some(0.01), "instance {k} does not stick: {one:?}");
        // Half a window more or less of a cycle, which has a few steps.
        assert!(long.steps <= short.steps + 8, "{k}: {} and {} steps", short.steps, long.steps);
        for ((name, made, _), (_, expected, size)) in numbers(&long).into_iter().zip(numbers(&short)) {
            if name != "simulated_time" && !name.contains("measured") {
                let (made, expected) = (made.expect(name), expected.expect(name));
                assert!((made - expected).abs() <= 1e-11 * size, "{k}, {name}: {made} and {expected}");
            }
        }
        close("cycles", long.response_frequency.expect("it swings"), natural(&one) / period, 1e-10);
    }
}

#[test]
fn bits_do_not_depend_on_neighbours() {
    // Some swing, some have too strong a damper, a ramp or another law, and are stepped.
    let mut mixed = instances();
    for (k, instance) in mixed.iter_mut().enumerate() {
        let FrictionLaw::Constant { mu_s, mu_d } = instance.law else { panic!("a constant law") };
        match k % 4 {
            0 => instance.law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 1.0 },
            1 => instance.params.set(Param::C1, 4000.0),
            2 if k % 8 == 2 => {
                instance.params.set(Param::BeltVelocityEnd, 0.1);
                instance.params.set(Param::RampDuration, 0.2);
            }
            _ => {}
        }
    }
    let plan = periods(6.0, 6.0, 4);
    let together = run::<f32>(&mixed, &plan);
    for k in 0..mixed.len() {
        let alone = run::<f32>(&mixed[k..=k], &plan);
        assert_eq!(together[k], alone[0], "instance {k}");
    }
}
