//! From an outcome to the record of its instance, with its regime.

use crate::engine::instances::Instances;
use crate::engine::kinks;
use crate::engine::outcome::{Ending, Outcome};
use crate::engine::record::Record;
use crate::engine::regime::{self, Regime};
use crate::engine::scene::Scene;
use crate::model::equilibrium::Equilibrium;
use crate::model::instance::Instance;
use crate::model::kind::InstabilityType;
use crate::model::linear::{Linear, Preparation};
use crate::model::status::Status;
use crate::model::{Param, linear};

/// By what part the time of an engine may be short of that of a motion.
const ROUNDING: f64 = 1e-9;

/// The regime of a completed outcome, and whether it is settled; `kind` is the type of its equilibrium.
#[must_use]
pub fn regime(instance: &Instance, kind: Option<InstabilityType>, outcome: &Outcome) -> (Regime, bool) {
    let velocity = instance.params.require(Param::BeltVelocity);
    let at_end = at_the_end(instance, outcome.simulated_time);
    let (mut kind, mut known) = at_end.as_ref().map_or((kind, None), linear::analyse);
    // A small motion grows or decays by the slope that it sees, on a kink at every size; beside one it may grow where a smaller one decays.
    let moved = at_end.as_ref().unwrap_or(instance);
    let small = outcome.speed_rms_halves[1] < regime::small_speed(velocity);
    let is_stable = kind == Some(InstabilityType::Stable);
    let amplitude = if is_stable { kinks::amplitude(outcome) } else { 0.0 };
    if small && let Some(seen) = kinks::seen(moved, amplitude) {
        let (of_seen, linear) = linear::analyse(&seen);
        if kinks::is_on_one(moved) || of_seen.is_some_and(InstabilityType::is_unstable) {
            (kind, known) = (of_seen, linear);
        }
    }
    let (regime, settled) = regime::regime(outcome, velocity, kind == Some(InstabilityType::Stable));
    let found = match outcome.ending {
        None => (regime, settled),
        Some(Ending::Decays) => (Regime::Equilibrium, true),
        Some(ending) => (regime, ending == Ending::Settled && !regime::is_carried(regime, velocity)),
    };
    // What sticks, reverses or lifts off has shown what it does, whatever grew: it needs no eigenvalues.
    let is_open = matches!(found.0, Regime::Slip | Regime::Equilibrium);
    if outcome.floquet.is_some() {
        // A cycle is an oscillation, however small.
        return (if is_open { Regime::Slip } else { found.0 }, true);
    }
    if !is_open || !kind.is_some_and(InstabilityType::is_unstable) {
        return found;
    }
    // Only a growth that may have stopped needs its rate.
    let growth_rate = || known.or_else(|| linear::analyse(instance).1).map(|linear| linear.growth_rate);
    regime::about_unstable(outcome, velocity, growth_rate, found)
}

/// The instance on the belt and at the temperature as they are at the time `time` (s), where they change: what a motion then
/// decays to or grows from is the equilibrium of that velocity.
fn at_the_end(instance: &Instance, time: f64) -> Option<Instance> {
    // A belt that comes to rest at the end is at rest, whatever the last digits of that time are.
    let time = time * (1.0 + ROUNDING);
    if instance.motion.is_steady(&instance.params) {
        return None;
    }
    let heating = instance.heating.as_ref();
    let mut moved =
        heating.map_or_else(|| instance.clone(), |heating| instance.heated(heating.temperature(time)));
    moved.params.set(Param::BeltVelocity, instance.motion.velocity(&instance.params, time));
    Some(moved)
}

/// The record of an instance before any analysis: its status is `ok`, or says why there is no equilibrium, or none that is
/// finite. `prepared` are the polynomials of the instance.
#[must_use]
pub fn begun(instance: &Instance, prepared: &Preparation) -> Record {
    let status = match prepared {
        Ok(_) => Status::Ok,
        Err(kind) => match Equilibrium::new(instance) {
            Err(status) => status,
            Ok(_) if kind.is_none() => Status::NonFinite,
            Ok(_) => Status::Ok,
        },
    };
    Record { status, ..Record::default() }
}

/// A record before any response, and the type of the equilibrium.
pub type Examined = (Record, Option<InstabilityType>);

/// The record of an instance before any response, with the eigenvalue analysis if it is asked for, and the type of its
/// equilibrium: on the CPU, of any model.
#[must_use]
pub fn examined(instance: &Instance, asked: bool) -> Examined {
    with_eigenvalues(instance, asked, &linear::prepare(instance), linear::solve)
}

/// [`examined`] of an instance with these polynomials, which `solve` analyses.
#[must_use]
pub fn with_eigenvalues(
    instance: &Instance,
    asked: bool,
    prepared: &Preparation,
    solve: impl FnOnce(&Preparation) -> (Option<InstabilityType>, Option<Linear>),
) -> Examined {
    let (mut record, (kind, linear)) = if let Some(modal) = &instance.modal {
        let (kind, linear, status) = linear::of_modal(instance, modal);
        (Record { status, ..Record::default() }, (kind, linear))
    } else {
        (begun(instance, prepared), solve(prepared))
    };
    if asked {
        (record.kind, record.linear) = (kind, linear);
    }
    (record, kind)
}

/// Why an instance has no result, where that is known before anything is computed: from its law, its equilibrium, the size
/// of its numbers or the length of its run.
#[must_use]
pub fn refused(spec: &dyn Instances, instance: &Instance) -> Option<Status> {
    if spec.response() {
        return Scene::planned(instance, &spec.plan()).err();
    }
    if let Some(modal) = &instance.modal {
        let (kind, _, status) = linear::of_modal(instance, modal);
        return kind.is_none().then_some(status);
    }
    match linear::prepare(instance) {
        Err(None) => Some(begun(instance, &Err(None)).status),
        // A type is all that is asked for.
        _ => None,
    }
}

/// Puts a response into the record of its instance; `kind` is the type of its equilibrium.
pub fn take_response(
    record: &mut Record,
    instance: &Instance,
    kind: Option<InstabilityType>,
    outcome: &Outcome,
) {
    record.status = outcome.status;
    if outcome.status == Status::Ok {
        let (regime, settled) = regime(instance, kind, outcome);
        record.regime = Some(regime);
        record.settled = Some(settled);
    }
    record.outcome = Some(Box::new(*outcome));
}
