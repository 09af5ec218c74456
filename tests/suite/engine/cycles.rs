//! Limit cycles found by shooting: against closed forms, long runs, and each other.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use crate::common::{bilinear, close, instance, near, paper, plan};
use crate::engines::Engine;
use crate::instances::Uniform;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::{Ending, Outcome};
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::Param;
use squealmap::model::equilibrium::Units;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_HUNT};

/// The engines that look for cycles.
const HUNTERS: [Engine; 3] = [Engine::Reference, Engine::CpuF64, Engine::CpuF32];

fn hunting() -> Plan {
    Plan {
        settle: FIRST_HUNT,
        settle_limit: Some(Duration::Periods(1000.0)),
        hunts: true,
        measure: AUTO_MEASURE,
        ..plan(1.0, 1.0, 12)
    }
}

fn kicked(mut instance: Instance, kick: f64) -> Instance {
    instance.params.set(Param::StartVelocity, kick);
    instance
}

fn value(of: Option<f64>) -> f64 {
    of.expect("a value")
}

/// The single mass between rest and the knee of its law, where it neither sticks nor slips back: `m ẍ = −k x − c ẋ + μ(V − ẋ) N`
/// about its equilibrium, by steps of Runge and Kutta that have nothing to do with the program's.
struct Planar {
    mass: f64,
    stiffness: f64,
    damping: f64,
    normal: f64,
    belt: f64,
    law: [f64; 3],
}

impl Planar {
    const STEP: f64 = 1e-6;

    fn slope(&self, speed: f64) -> f64 {
        let [mu_s, mu_d, knee] = self.law;
        if speed < knee { (mu_d - mu_s) / knee } else { 0.0 }
    }

    fn acceleration(&self, [x, v]: [f64; 2]) -> f64 {
        let [mu_s, mu_d, knee] = self.law;
        let mu = |speed: f64| mu_s + (mu_d - mu_s) * (speed.min(knee) / knee);
        let force = (mu(self.belt - v) - mu(self.belt)) * self.normal;
        (force - self.stiffness * x - self.damping * v) / self.mass
    }

    /// From `x` on the section `ẋ = 0`, rising, to the next: where, how long it took, and the integral of the divergence.
    fn turn(&self, x: f64) -> [f64; 3] {
        let rate = |s: [f64; 2]| [s[1], self.acceleration(s)];
        let add = |s: [f64; 2], k: [f64; 2], h: f64| [s[0] + h * k[0], s[1] + h * k[1]];
        let divergence = |v: f64| -(self.damping + self.normal * self.slope(self.belt - v)) / self.mass;
        // Between two velocities, of which one may be beyond the knee.
        let mean = |v: f64, w: f64| {
            let knee = self.belt - self.law[2];
            let part = ((knee - v) / (w - v)).clamp(0.0, 1.0);
            let crosses = (v < knee) != (w < knee);
            let ends = [divergence(v), divergence(w)];
            if crosses { part * ends[0] + (1.0 - part) * ends[1] } else { ends[0] }
        };
        let step = |s: [f64; 2], h: f64| {
            let k1 = rate(s);
            let k2 = rate(add(s, k1, 0.5 * h));
            let k3 = rate(add(s, k2, 0.5 * h));
            let k4 = rate(add(s, k3, h));
            let sum = |i: usize| k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i];
            [s[0] + h / 6.0 * sum(0), s[1] + h / 6.0 * sum(1)]
        };
        let (mut state, mut time, mut integral) = ([x, 0.0], 0.0, 0.0);
        loop {
            let next = step(state, Self::STEP);
            if time > 0.0 && state[1] < 0.0 && next[1] >= 0.0 {
                let rest = Self::STEP * state[1] / (state[1] - next[1]);
                let end = step(state, rest);
                return [end[0], time + rest, integral + rest * divergence(state[1])];
            }
            integral += Self::STEP * mean(state[1], next[1]);
            (state, time) = (next, time + Self::STEP);
        }
    }

    /// The amplitude of its cycle, its period, and its multiplier by the formula of Abel and Liouville, `exp ∮ div f dt`.
    fn cycle(&self, guess: f64) -> [f64; 3] {
        let (mut before, mut here) = (guess, 1.01 * guess);
        let mut miss = self.turn(before)[0] - before;
        for _ in 0..12 {
            let now = self.turn(here)[0] - here;
            if (now - miss).abs() < 1e-300 || (here - before).abs() < 1e-13 * guess.abs() {
                break;
            }
            let next = here - now * (here - before) / (now - miss);
            (before, here, miss) = (here, next, now);
        }
        let [end, period, integral] = self.turn(here);
        assert!((end - here).abs() < 1e-10 * here.abs(), "no cycle: {here} to {end}");
        [here, period, integral.exp()]
    }
}

#[test]
fn the_multiplier_of_a_planar_cycle_is_that_of_liouville() {
    for (damping, belt) in [(12.0, 4.5), (13.0, 4.5), (11.0, 4.7)] {
        let law = FrictionLaw::Bilinear { mu_s: 0.2, mu_d: 0.1, knee_velocity: 5.0 };
        let one = kicked(
            instance(law, &[(Param::Theta, 0.0), (Param::C1, damping), (Param::BeltVelocity, belt)]),
            1.0,
        );
        let get = |param: Param| one.params.get(param).expect("a value");
        let planar = Planar {
            mass: get(Param::M1) + get(Param::M2),
            stiffness: get(Param::K1),
            damping,
            normal: get(Param::FExt),
            belt,
            law: [0.2, 0.1, 5.0],
        };
        let speed = 1.5 / (planar.stiffness / planar.mass).sqrt();
        let [_, period, multiplier] = planar.cycle(-speed);
        for engine in HUNTERS {
            let found = engine.run(&one, &hunting());
            let what = format!("{} at c1 = {damping}", engine.name());
            assert_eq!((found.status, found.cycle_returns), (Status::Ok, Some(1)), "{what}");
            close(&format!("period, {what}"), value(found.period), period, 1e-9);
            near(&format!("multiplier, {what}"), value(found.floquet), multiplier, 1e-6);
            assert_eq!(found.floquet_angle, Some(0.0), "{what}");
        }
    }
}

#[test]
fn what_sticks_forgets_all() {
    // Stick ends at one state whatever came before: the only multiplier of the single mass is 0.
    for (law, belt) in [(bilinear(0.3, 0.1), 1.0), (FrictionLaw::Constant { mu_s: 0.4, mu_d: 0.2 }, 0.7)] {
        let one = kicked(instance(law, &[(Param::Theta, 0.0), (Param::BeltVelocity, belt)]), 1.2 * belt);
        for engine in HUNTERS {
            let found = engine.run(&one, &hunting());
            near(engine.name(), value(found.floquet), 0.0, 1e-6);
            assert!(value(found.stick) > 0.1, "{}: {found:?}", engine.name());
        }
    }
}

/// Largest multipliers of the cycles of `benches/peers/multipliers.toml` by `benches/peers/multipliers.py`, which has its own
/// equations, events and steps: a spiral with stick, slip back, flight on the section and off it.
#[test]
fn multipliers_are_those_of_an_independent_code() {
    let known = [
        ([0.25, 0.05, 1.5], [0.986_654_319, 19.482_287, 0.030_452_694_376]),
        ([0.55, 0.05, 3.0], [0.986_874_960, 27.682_664, 0.031_076_032_229]),
        ([0.25, 0.35, 6.0], [0.612_883_830, 0.0, 0.032_240_947_175]),
        ([0.25, 0.5, 6.0], [0.409_745_905, 3.477_095, 0.032_471_952_505]),
        ([0.55, 0.5, 6.0], [0.174_597_256, 0.0, 0.032_629_666_972]),
        ([0.55, 0.5, 1.5], [0.551_204_214, 0.0, 0.029_123_574_520]),
    ];
    for ([mu_s, mu_d, belt], [modulus, angle, period]) in known {
        let one = kicked(paper(mu_s, mu_d, belt), belt);
        for engine in HUNTERS {
            let found = engine.run(&one, &hunting());
            let what = format!("{} at {mu_s}, {mu_d}, {belt}", engine.name());
            close(&format!("period, {what}"), value(found.period), period, 1e-10);
            near(&format!("multiplier, {what}"), value(found.floquet), modulus, 1e-6);
            near(&format!("angle, {what}"), value(found.floquet_angle), angle, 2e-4);
        }
    }
}

/// Cycles of every kind: stick, slip back, flight with and without stick, by a curved law too.
fn cases() -> Vec<(Instance, &'static str)> {
    let curved = FrictionLaw::Exponential { mu_s: 0.3, mu_d: 0.1, stribeck_velocity: 1.0 };
    vec![
        (kicked(paper(0.15, 0.05, 1.0), 0.3), "stick"),
        (kicked(paper(0.3, 0.05, 1.0), 0.3), "stick"),
        (kicked(paper(0.285, 0.54, 1.0), 0.9), "flight and stick"),
        (kicked(paper(0.4, 0.4, 3.0), 3.0), "flight and stick"),
        (kicked(paper(0.45, 0.2, 3.0), 2.0), "flight and stick"),
        (kicked(instance(curved, &[(Param::BeltVelocity, 0.5)]), 0.3), "a curved law"),
    ]
}

#[test]
fn engines_find_the_cycle_of_a_long_run() {
    for (one, kind) in cases() {
        let all = HUNTERS.map(|engine| (engine, engine.run(&one, &hunting())));
        let (_, judge) = all[0];
        assert!(judge.floquet.is_some() && judge.ending == Some(Ending::Settled), "{kind}: {judge:?}");
        for (engine, found) in &all[1..] {
            let what = format!("{kind}, {}", engine.name());
            close(&what, value(found.period), value(judge.period), 1e-10);
            near(&what, value(found.floquet), value(judge.floquet), 1e-5);
            near(&what, value(found.phase_cycle), value(judge.phase_cycle), 1e-4);
        }
        // A run of some thousand periods, measured over whole ones.
        let long = Plan {
            settle: Duration::Periods(4000.0),
            measure: Duration::Seconds(60.0 * value(judge.period)),
            ..plan(1.0, 1.0, 24)
        };
        let waited = Engine::CpuF64.run(&one, &long);
        for (engine, found) in all {
            for (name, of) in observables() {
                let what = format!("{name}, {kind}, {}", engine.name());
                close(&what, of(&found), of(&waited), 1e-6);
            }
        }
    }
}

/// A name, and how the value is had.
type Observable = (&'static str, fn(&Outcome) -> f64);

fn observables() -> [Observable; 4] {
    [
        ("x2_std", |outcome| value(outcome.x2_std)),
        ("ax_rms", |outcome| value(outcome.ax_rms)),
        ("ay_rms", |outcome| value(outcome.ay_rms)),
        ("frequency", |outcome| value(outcome.response_frequency)),
    ]
}

#[test]
fn a_transient_on_a_torus_finds_no_cycle() {
    // The cycle that it turns about has multipliers of modulus 1.0005.
    let one = kicked(paper(0.045, 0.03, 4.9), 4.0);
    for engine in [Engine::CpuF64, Engine::CpuF32] {
        let found = engine.run(&one, &hunting());
        assert_eq!(found.floquet, None, "{}: {found:?}", engine.name());
    }
}

/// Both come near a stable cycle, inside or on an unstable torus about it, and leave again: of 1e5 random instances the only ones.
#[test]
fn a_run_that_an_unstable_torus_turns_back_finds_no_cycle() {
    let values = |[c1, c2, theta, restitution, belt]: [f64; 5]| {
        [
            (Param::C1, c1),
            (Param::C2, c2),
            (Param::Theta, theta),
            (Param::Restitution, restitution),
            (Param::BeltVelocity, belt),
            (Param::StartVelocity, 0.02 * belt),
        ]
    };
    let first = [0.738_870_6, 0.124_390_22, 0.019_640_588, 0.569_061_83, 3.350_272_136_7];
    let second = [10.600_886_05, 0.281_652_45, 0.006_934_187_5, 0.486_931_58, 4.259_497_902_7];
    for (numbers, mu_s, mu_d) in
        [(first, 0.129_113_263_7, 0.119_903_274_9), (second, 0.338_025_346_4, 0.248_900_058_3)]
    {
        let instance = instance(bilinear(mu_s, mu_d), &values(numbers));
        let found = Engine::CpuF64.run(&instance, &hunting());
        assert_eq!((found.status, found.floquet), (Status::Ok, None));
    }
}

#[test]
fn what_decays_or_sticks_has_no_cycle() {
    let stuck = kicked(paper(0.5, 0.5, 1e-3), 0.0);
    let decays = kicked(paper(0.05, 0.05, 5.5), 0.5);
    for one in [stuck, decays] {
        for engine in HUNTERS {
            let found = engine.run(&one, &hunting());
            assert_eq!((found.status, found.floquet), (Status::Ok, None), "{}", engine.name());
        }
    }
}

/// Random instances of all kinds, from small and large starts.
fn drawn(count: usize) -> Vec<Instance> {
    let mut u = Uniform(29);
    (0..count)
        .map(|k| {
            let mut draw = |low: f64, high: f64| low + (high - low) * u.next();
            let (mu_s, mu_d, belt) = (draw(0.02, 0.6), draw(0.02, 0.6), draw(0.5, 6.0));
            let mut one = paper(mu_s, mu_d, belt);
            one.params.set(Param::Theta, if k % 6 == 5 { 0.0 } else { draw(-0.05, 0.05) });
            one.params.set(Param::Restitution, draw(-0.5, 0.8).max(0.0));
            kicked(one, if k % 2 == 0 { 0.05 * belt } else { belt * draw(0.8, 1.5) })
        })
        .collect()
}

#[test]
fn cycles_do_not_depend_on_their_neighbours() {
    let all = drawn(96);
    let never = AtomicBool::new(false);
    let together = outcomes::<f64>(&all, &hunting(), &never).expect("nobody stops it");
    let backwards: Vec<Instance> = all.iter().rev().cloned().collect();
    let backwards = outcomes::<f64>(&backwards, &hunting(), &never).expect("nobody stops it");
    let parts =
        all.chunks(5).flat_map(|some| outcomes::<f64>(some, &hunting(), &never).expect("nobody stops it"));
    assert!(together.iter().filter(|found| found.floquet.is_some()).count() > 48);
    assert!(together.iter().eq(backwards.iter().rev()));
    assert!(parts.eq(together));
}

#[test]
fn no_run_that_ends_elsewhere_is_called_found() {
    let all = drawn(400);
    let found = Engine::CpuF64.run_all(&all, &hunting());
    let long =
        Plan { settle: Duration::Periods(4000.0), measure: Duration::Periods(200.0), ..plan(1.0, 1.0, 12) };
    let waited = Engine::CpuF64.run_all(&all, &long);
    let mut count = 0;
    for (one, (found, waited)) in all.iter().zip(found.iter().zip(&waited)) {
        let Some(floquet) = found.floquet else { continue };
        count += 1;
        // What the long run has not forgotten yet says nothing.
        let periods = 4000.0 * TAU * Units::new(&one.params).time / value(found.period);
        if floquet.powf(periods) < 1e-3 {
            for (name, of) in observables() {
                close(&format!("{name} of {one:?}"), of(found), of(waited), 5e-3);
            }
        }
    }
    assert!(count > 200, "{count}");
}
