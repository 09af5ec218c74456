//! A parameter that rises and falls in steps: each value starts from the state in which the one before has ended.
//!
//! So a cycle is followed for as long as it exists, and the equilibrium for as long as it is stable. Where the two
//! branches differ, both exist. The start of the sweep (its kick, or its mode) is added at every value: without a small
//! disturbance nothing would ever leave an equilibrium that is not stable.

use crate::engine::judged::{examined, take_response};
use crate::engine::method::taylor::State;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::record::{Attractor, Record, apart, differ};
use crate::engine::reference::orbit::{cycle_near, measure};
use crate::engine::reference::respond::respond_in;
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::{Param, Section};
use crate::study::cycles::branch::Branch;
use crate::study::cycles::map::fine;
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};

/// A branch jumps from one cycle to another where its amplitude changes so many times as fast as beside it.
pub const SHARP: f64 = 4.0;

/// Whether a motion can be followed along a parameter: not where it says how the motion starts or ends.
#[must_use]
pub fn can_follow(param: Param) -> bool {
    param.info().section != Section::Start && ![Param::BeltVelocityEnd, Param::RampDuration].contains(&param)
}

/// A direction in which the parameter goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the first value to the last.
    Up,
    /// From the last value to the first.
    Down,
}

impl Direction {
    /// Both, in the order in which they are gone.
    pub const ALL: [Direction; 2] = [Direction::Up, Direction::Down];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Direction::Up => "up",
            Direction::Down => "down",
        }
    }

    /// The positions of so many values in the order in which the direction comes to them.
    pub fn order(self, count: usize) -> impl Iterator<Item = usize> {
        (0..count).map(move |at| if self == Direction::Up { at } else { count - 1 - at })
    }
}

/// Both branches of a parameter.
#[derive(Clone, Debug)]
pub struct Hysteresis {
    /// The parameter.
    pub param: Param,
    /// Its values, in the order of the way up.
    pub values: Vec<f64>,
    /// The records on the way up, one for each value.
    pub up: Vec<Record>,
    /// The records on the way down, one for each value, in the order of `values` too.
    pub down: Vec<Record>,
    /// The branches of the cycles that were met, with their unstable parts.
    pub cycles: Vec<Branch>,
}

impl Hysteresis {
    /// Follows a parameter over its values up and down again; `instance` gives the instance of a value.
    ///
    /// # Errors
    /// The first error of `instance`; how an instance ended stands in its record.
    pub fn follow<E>(
        param: Param,
        values: Vec<f64>,
        plan: &Plan,
        instance: impl Fn(f64) -> Result<Instance, E>,
    ) -> Result<Hysteresis, E> {
        let instances = values.iter().map(|value| instance(*value)).collect::<Result<Vec<_>, E>>()?;
        let (mut up, mut down, mut met) = (Vec::new(), Vec::new(), Vec::new());
        let mut motion = None;
        for direction in Direction::ALL {
            let branch = if direction == Direction::Up { &mut up } else { &mut down };
            for at in direction.order(values.len()) {
                let record;
                (record, motion) = step(&instances[at], plan, motion.take());
                let x2_std = record.outcome.as_ref().and_then(|outcome| outcome.x2_std);
                if Attractor::of(&record, record.kind) == Some(Attractor::Oscillation) {
                    met.extend(motion.zip(x2_std).map(|(motion, x2_std)| (at, motion, x2_std)));
                }
                branch.push(record);
            }
        }
        down.reverse();
        let mut cycles: Vec<Branch> = Vec::new();
        let range = [values[0], values[values.len() - 1]];
        let plan = &fine(plan);
        for (at, motion, x2_std) in met {
            if cycles.iter().any(|branch| branch.holds(values[at], x2_std)) {
                continue;
            }
            let Ok(scene) = Scene::planned(&instances[at], plan) else { continue };
            let Some((cycle, freedom)) = cycle_near(&scene, plan, motion.state(&scene)) else { continue };
            let size = measure(&scene, plan, &cycle).and_then(|outcome| outcome.x2_std);
            if size.is_some_and(|size| cycles.iter().any(|branch| branch.holds(values[at], size))) {
                continue;
            }
            let of_value = |value: f64| instance(value).ok();
            cycles.extend(Branch::about(&of_value, plan, range, values[at], (&cycle, freedom)));
        }
        Ok(Hysteresis { param, values, up, down, cycles })
    }

    /// The records of a direction, in the order of `values`.
    #[must_use]
    pub fn branch(&self, direction: Direction) -> &[Record] {
        match direction {
            Direction::Up => &self.up,
            Direction::Down => &self.down,
        }
    }

    /// The values between which a branch leaves the equilibrium for an oscillation or the other way round, in the order in
    /// which it comes to them. Values at which it has not settled are passed over.
    #[must_use]
    pub fn jumps(&self, direction: Direction) -> Vec<[f64; 2]> {
        let end = |at: usize| {
            let record = &self.branch(direction)[at];
            Attractor::of(record, record.kind).map(|end| (self.values[at], end))
        };
        let ends: Vec<(f64, Attractor)> = direction.order(self.values.len()).filter_map(end).collect();
        let jumps = ends.windows(2).filter(|pair| pair[0].1 != pair[1].1);
        jumps.map(|pair| [pair[0].0, pair[1].0]).collect()
    }

    /// The pairs of neighbouring values between which a branch jumps from one cycle to another, in the order of the branch.
    /// Both values are oscillations whose standard deviations of `x2` are too far apart for one cycle
    /// ([`crate::engine::regime::THRESHOLDS`]), and the change is several times as fast as beside it ([`SHARP`]). A rise
    /// that is steep over less than a step of the parameter looks like a jump.
    #[must_use]
    pub fn jumps_of_amplitude(&self, direction: Direction) -> Vec<[f64; 2]> {
        let end = |at: usize| {
            let record = &self.branch(direction)[at];
            let end = Attractor::of(record, record.kind)?;
            let size = record.outcome.as_ref().and_then(|outcome| outcome.x2_std);
            Some((self.values[at], size.filter(|_| end == Attractor::Oscillation)))
        };
        let ends: Vec<(f64, Option<f64>)> = direction.order(self.values.len()).filter_map(end).collect();
        // How fast the amplitude changes from each end to the next.
        let rate = |pair: &[(f64, Option<f64>)]| {
            let [(from, a), (to, b)] = [pair[0], pair[1]];
            a.zip(b).map(|(a, b)| (b - a).abs() / (to - from).abs())
        };
        let rates: Vec<Option<f64>> = ends.windows(2).map(rate).collect();
        let sharp = |step: usize| {
            let beside = [step.checked_sub(1), step.checked_add(1)];
            let beside: Vec<f64> =
                beside.into_iter().flatten().filter_map(|other| *rates.get(other)?).collect();
            !beside.is_empty()
                && rates[step].is_some_and(|rate| beside.iter().all(|other| rate > SHARP * other))
        };
        let differ = |step: usize| {
            let [a, b] = [ends[step].1, ends[step + 1].1];
            a.zip(b).is_some_and(|(a, b)| apart(a, b))
        };
        let jumps = (0..rates.len()).filter(|step| differ(*step) && sharp(*step));
        jumps.map(|step| [ends[step].0, ends[step + 1].0]).collect()
    }

    /// Whether the branches end differently at each value; `None` where one has not settled.
    #[must_use]
    pub fn bistable(&self) -> Vec<Option<bool>> {
        self.up.iter().zip(&self.down).map(|(up, down)| differ(up, down, up.kind)).collect()
    }

    /// The ranges of neighbouring values at which the branches end differently, from the first to the last value of each.
    #[must_use]
    pub fn apart(&self) -> Vec<[f64; 2]> {
        let mut ranges: Vec<[f64; 2]> = Vec::new();
        let mut before = false;
        for (value, differs) in self.values.iter().zip(self.bistable()) {
            let differs = differs == Some(true);
            match ranges.last_mut() {
                Some(range) if differs && before => range[1] = *value,
                _ if differs => ranges.push([*value; 2]),
                _ => {}
            }
            before = differs;
        }
        ranges
    }

    /// The values as a grid of one axis.
    #[must_use]
    pub fn grid(&self) -> Grid {
        let values = self.values.iter().map(|value| Value::Number(*value)).collect();
        Grid::Axes(vec![Axis { key: AxisKey::Param(self.param), values, log: false }])
    }
}

/// A motion in SI units, so that it can go on in the next instance, which has other scales.
#[derive(Clone, Copy, Debug)]
struct Motion {
    position: [f64; 3],
    velocity: [f64; 3],
}

impl Motion {
    fn new(scene: &Scene, state: State) -> Motion {
        let [x2, y2, y1] = state.position.map(|length| length * scene.units.length);
        let position = [x2 + scene.equilibrium.x2, y2, y1 + scene.equilibrium.y1];
        Motion { position, velocity: state.velocity.map(|speed| speed * scene.units.velocity) }
    }

    /// The state in the scales of an instance.
    fn state(self, scene: &Scene) -> State {
        let [x2, y2, y1] = self.position;
        let about = [x2 - scene.equilibrium.x2, y2, y1 - scene.equilibrium.y1];
        State {
            position: about.map(|length| length / scene.units.length),
            velocity: self.velocity.map(|speed| speed / scene.units.velocity),
        }
    }

    /// The same, the start of the instance added as a disturbance.
    fn disturbed(self, scene: &Scene) -> State {
        let (state, start) = (self.state(scene), scene.start());
        State {
            position: std::array::from_fn(|k| state.position[k] + start.position[k]),
            velocity: std::array::from_fn(|k| state.velocity[k] + start.velocity[k]),
        }
    }
}

/// Computes one value: its record, and the motion that the next value starts from. There is none after a failure, and none
/// after an equilibrium, where a run sees only the beginning of the decay: the next value starts afresh then.
fn step(instance: &Instance, plan: &Plan, from: Option<Motion>) -> (Record, Option<Motion>) {
    let (mut record, kind) = examined(instance, true);
    let scene = match Scene::planned(instance, plan) {
        Ok(scene) => scene,
        Err(status) => {
            take_response(&mut record, instance, kind, &Outcome { status, ..Outcome::default() });
            return (record, None);
        }
    };
    let start = from.map_or(scene.start(), |motion| motion.disturbed(&scene));
    let scene = scene.started(start);
    let (outcome, state) = respond_in(&scene, instance, plan);
    take_response(&mut record, instance, kind, &outcome);
    let rests = Attractor::of(&record, kind) == Some(Attractor::Equilibrium);
    let motion = state.filter(|_| !rests).map(|state| Motion::new(&scene, state));
    (record, motion)
}
