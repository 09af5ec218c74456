//! Cycles and returns without a run around them, for what follows a cycle.

use crate::engine::cycle::candidate::Cycle;
use crate::engine::cycle::hunt::{Hunt, Next};
use crate::engine::cycle::point::{Freedom, Return};
use crate::engine::cycle::pursuit::MANY;
use crate::engine::method::taylor::State;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::observe::Growth;
use crate::engine::reference::round::round;
use crate::engine::reference::section::returns;
use crate::engine::scene::Scene;
use crate::model::contact::ContactState;

/// The first `count` returns to the section of a motion that starts at `state` (scaled, deviations from the equilibrium);
/// `None` where it does not come back.
#[must_use]
pub fn returns_of(scene: &Scene, plan: &Plan, state: State, count: usize) -> Option<Vec<Return>> {
    let scene = scene.clone().started(state);
    let mut integrator = scene.integrator(plan).ok()?;
    returns(&scene, &mut integrator, count, &mut ()).ok()
}

/// The stable cycle that a motion from `state` is close to, and the coordinates that its section is free in.
#[must_use]
pub fn cycle_near(scene: &Scene, plan: &Plan, state: State) -> Option<(Cycle, Freedom)> {
    let scene = scene.clone().started(state);
    let mut integrator = scene.integrator(plan).ok()?;
    let transient = returns(&scene, &mut integrator, MANY, &mut ()).ok()?;
    let here = transient.last()?.point;
    let freedom = Freedom::of(&here, scene.model.s == 0.0, ContactState::Free as u32);
    let mut hunt = Hunt::new(&transient, freedom, true, 0.0)?;
    let mut next = hunt.request();
    while let Next::Follow(points, count) = next {
        let follow = |point| returns(&scene, &mut integrator.at(point), count, &mut ()).ok();
        let flown: Option<Vec<_>> = points.iter().map(follow).collect();
        next = hunt.take(flown.as_deref());
    }
    let Next::Found(candidate) = next else { return None };
    Some((candidate.cycle, freedom))
}

/// An unstable cycle magnifies what its start is off by: it closes within this part of its size.
const CLOSES: f64 = 1e-5;

/// What one period of a cycle measures; `None` where it does not close.
#[must_use]
pub fn measure(scene: &Scene, plan: &Plan, cycle: &Cycle) -> Option<Outcome> {
    let start = State { position: cycle.start.position, velocity: cycle.start.velocity };
    let scene = scene.clone().started(start);
    let integrator = scene.integrator(plan).ok()?;
    round(&scene, plan, integrator, cycle, &Growth::default(), (0, 0.0), CLOSES).ok()?
}
