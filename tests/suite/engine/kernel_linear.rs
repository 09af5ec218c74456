//! The linear kernel's twin against the reference: how good are f32 and f64 in its formulation?

use pulp::Arch;

use crate::common::{close, instance};
use crate::engine::instructions::levels;
use crate::instances::random;
use squealmap::engine::kernel::linear::analyse as twin;
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::words::Words;
use squealmap::engine::lanes::linear::{Solved, solved_on};
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::{Linear, Preparation, analyse, prepare, solve};
use squealmap::sweep::spec::Spec;

/// Random instances, over wide ranges of every parameter.
const RANDOM: usize = 100_000;

/// Types may differ where a growth rate is within this fraction of `|λ|` of zero.
const UNDECIDED: f64 = 2e-5;

/// A relative difference in frequency that is another mode, not rounding.
const OTHER_MODE: f64 = 1e-3;

fn paper_map() -> Vec<Instance> {
    let spec = Spec::read("sweeps/paper_map.toml".as_ref()).expect("a valid sweep");
    (0..spec.grid.len()).map(|index| spec.instance(index)).collect()
}

/// What the twin says in one precision, and the units of its growth rates.
fn computed<R: Real>(instance: &Instance) -> (InstabilityType, Linear, [f64; 3]) {
    let words = Words::new(&prepare(instance).expect("polynomials"));
    let result = twin(&|word| R::from_f64(words.inputs[word]));
    assert_eq!(result.flags[0], 1, "a finite result of {instance:?}");
    let (kind, linear) = words.results(result.state.map(Real::to_f64), result.flags[2]).expect("a type");
    (kind, linear, words.scales)
}

/// How far the twin is from the reference.
#[derive(Debug, Default)]
struct Worst {
    compared: u32,
    /// Types that differ, and those of them that may not.
    types: u32,
    types_beyond: u32,
    /// Rates relative to `|λ|`, or to the geometric mean of all `|λ|` where that is larger.
    growth: f64,
    frequency: f64,
    /// Instances where another mode leads.
    other_modes: u32,
    /// Degrees, and how many are off by more than 0.1.
    phase: f64,
    phases_off: u32,
}

fn worst<R: Real>(instances: &[Instance]) -> Worst {
    let mut worst = Worst::default();
    for instance in instances {
        let (Some(kind), Some(expected)) = analyse(instance) else { continue };
        let (actual_kind, actual, scales) = computed::<R>(instance);
        let turns = |one: &Linear| std::f64::consts::TAU * one.frequency.unwrap_or(0.0);
        let size = expected.growth_rate.hypot(turns(&expected));
        assert_eq!(actual.frequency.is_some(), expected.frequency.is_some(), "{instance:?}");
        let rates = |one: &Linear| [one.growth_rate, one.growth_rate_flat, one.growth_rate_frozen];
        worst.compared += 1;
        if actual_kind != kind {
            worst.types += 1;
            worst.types_beyond +=
                u32::from(rates(&expected).iter().all(|rate| rate.abs() > UNDECIDED * size));
        }
        for ((a, b), scale) in rates(&actual).into_iter().zip(rates(&expected)).zip(scales) {
            worst.growth = worst.growth.max((a - b).abs() / scale.max(b.abs()));
        }
        let frequency = (turns(&actual) - turns(&expected)).abs();
        let frequency = frequency / scales[0].max(size);
        if frequency > OTHER_MODE {
            // The other of two modes whose growth rates are equal as far as the scalar can tell.
            worst.other_modes += 1;
            continue;
        }
        worst.frequency = worst.frequency.max(frequency);
        if let (Some(a), Some(b)) = (actual.phase, expected.phase) {
            let turn = (a - b).abs().min(360.0 - (a - b).abs());
            worst.phase = worst.phase.max(turn);
            worst.phases_off += u32::from(turn > 0.1);
        }
    }
    println!("{worst:?}");
    worst
}

#[test]
fn paper_map_in_f32_and_f64() {
    let instances = paper_map();
    let (narrow, wide) = (worst::<f32>(&instances), worst::<f64>(&instances));
    assert_eq!((narrow.types, wide.types, narrow.other_modes, wide.other_modes), (0, 0, 0, 0));
    assert!(narrow.growth < 5e-8 && narrow.frequency < 5e-7 && narrow.phase < 2e-3, "{narrow:?}");
    assert!(wide.growth < 5e-13 && wide.frequency < 5e-13 && wide.phase < 1e-9, "{wide:?}");
}

#[test]
fn random_instances_in_f32_and_f64() {
    let instances = random(RANDOM);
    let (narrow, wide) = (worst::<f32>(&instances), worst::<f64>(&instances));
    assert_eq!((narrow.types_beyond, wide.types, wide.other_modes), (0, 0, 0));
    // The extremes of f32 are strongly damped: there the two quadratics differ by orders of magnitude.
    assert!(
        narrow.growth < 1e-4 && narrow.frequency < 1e-5 && narrow.phases_off < 300 && narrow.other_modes < 5,
        "{narrow:?}"
    );
    assert!(wide.growth < 1e-12 && wide.frequency < 1e-12 && wide.phase < 1e-5, "{wide:?}");
}

/// What the lanes have to give: the bits of the twin, where there are polynomials.
fn of_twin(prepared: &Preparation) -> Solved {
    let Ok(polynomials) = prepared else { return solve(prepared) };
    let words = Words::new(polynomials);
    let result = twin(&|word| words.inputs[word]);
    let found =
        words.results(result.state, result.flags[2]).filter(|_| result.flags[0] == 1 && !words.is_far());
    found.map_or_else(|| solve(prepared), |(kind, linear)| (Some(kind), Some(linear)))
}

#[test]
fn lanes_have_the_bits_of_the_twin_whatever_the_instruction_set() {
    // The last lanes of a vector are in use, or not.
    let instances: Vec<Instance> = paper_map().into_iter().chain(random(RANDOM + 3)).collect();
    let mut prepared: Vec<Preparation> = instances.iter().map(prepare).collect();
    // Some have no polynomials.
    prepared.push(Err(Some(InstabilityType::Sticking)));
    prepared.insert(5, Err(None));
    let expected: Vec<Solved> = prepared.iter().map(of_twin).collect();
    for (level, arch) in levels() {
        let Some(arch) = arch else {
            eprintln!("NOT RUN: {level}, which this machine does not have");
            continue;
        };
        let bits = |all: &[Solved]| all.iter().map(|one| format!("{one:?}")).collect::<Vec<_>>();
        let made = solved_on(arch, &prepared);
        assert!(bits(&made) == bits(&expected), "{level}");
    }
}

/// A normal mode that is damped so strongly that its roots lie 1e12 apart, above a tangential one that is damped weakly. Without an
/// inclination the modes do not know of each other.
#[test]
fn roots_far_apart_have_their_digits() {
    for (stiffness, damping, is_far) in [(1e12, 1e12, true), (1e4, 1e3, false)] {
        let law = FrictionLaw::Constant { mu_s: 0.3, mu_d: 0.3 };
        let values = [
            (Param::M1, 1.0),
            (Param::M2, 1.0),
            (Param::K1, 1e4),
            (Param::K2, stiffness),
            (Param::C1, 1.0),
            (Param::C2, damping),
            (Param::Theta, 0.0),
            (Param::BeltVelocity, 1.0),
        ];
        let prepared = prepare(&instance(law, &values));
        let words = Words::new(prepared.as_ref().expect("polynomials"));
        assert_eq!(words.is_far(), is_far);
        // c1/2(m1 + m2) of the tangential mode; the roots of the other one lie left of it.
        let expected = -0.25;
        let [(_, Some(linear))] = solved_on(Arch::new(), &[prepared])[..] else { panic!() };
        close("growth", linear.growth_rate, expected, 1e-12);
        // The form of the kernel alone has lost digits.
        let alone = twin(&|word| words.inputs[word]).state[0] * words.scales[0];
        assert_eq!((alone - expected).abs() > 1e-9 * expected.abs(), is_far, "{alone} and {expected}");
    }
}
