//! One period of a cycle, measured.

use crate::engine::cycle::candidate::Cycle;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reductions::End;
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::observe::{Growth, Window};
use crate::engine::reference::phase::phase;
use crate::engine::scene::Scene;
use crate::model::status::Status;

/// Measures one period of a cycle from its `start` on; `growth` is that of the run before it, and `spent` are the steps and the
/// scaled time that were spent on finding it. `None` where it does not close `within` this part of its size.
///
/// # Errors
/// The status that ends the integration.
pub(super) fn round(
    scene: &Scene,
    plan: &Plan,
    start: Integrator,
    cycle: &Cycle,
    growth: &Growth,
    spent: (u64, f64),
    within: f64,
) -> Result<Option<Outcome>, Status> {
    let (steps, time) = (start.steps(), start.time());
    let mut round = start.clone();
    let half = 0.5 * cycle.period;
    let mut window = Window::default();
    for part in 0..2 {
        window.half = part;
        scene.advance(&mut round, half, &mut window)?;
    }
    let state = round.state();
    if !cycle.closes(state.position, state.velocity, within) {
        return Ok(None);
    }
    let mut seen = window.reductions(growth);
    seen.close_period([time, round.time()]);
    if let Some(frequency) = seen.frequency() {
        seen.phase = phase(scene, start, frequency, &seen, half)?;
    }
    let end = End {
        status: Status::Ok,
        steps: steps + spent.0 + 2 * (round.steps() - steps),
        time: round.time() + cycle.period + spent.1,
        met_event: growth.met_event(),
    };
    let outcome = seen.outcome(scene, plan, &end);
    if outcome.status != Status::Ok {
        return Err(outcome.status);
    }
    Ok(Some(outcome.on_cycle(cycle, time, &scene.units)))
}
