//! The reference on the section of the return map: where `ẋ2` rises through zero.

use std::f64::consts::TAU;

use crate::engine::cycle::point::{FORGETS, Point, Return};
use crate::engine::cycle::pursuit::LONGEST_RETURN;
use crate::engine::method::roots::upward_crossings;
use crate::engine::method::taylor::{State, X2};
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::observer::{Event, Observer, Step};
use crate::engine::reference::watched::Disarmed;
use crate::engine::scene::Scene;
use crate::model::contact::{Contact, ContactState};
use crate::model::status::Status;

/// The section is looked for in parts of this length.
const PART: f64 = TAU / 16.0;

/// Watches for the first rise of `ẋ2` through zero within a step, and for the events before.
#[derive(Clone, Copy, Debug, Default)]
struct Watch {
    rise: Option<f64>,
    order: f64,
}

impl Observer for Watch {
    fn step(&mut self, step: &Step) {
        let velocity = step.expansion.tangential_velocity();
        let signs = [velocity[0] < 0.0, step.end.state.velocity[X2] < 0.0];
        if self.rise.is_none() && signs == [true, false] {
            let rises = upward_crossings(&velocity[..step.expansion.order], step.duration, signs);
            self.rise = rises.first().map(|tau| step.start + tau);
        }
    }

    fn event(&mut self, event: Event) {
        let code = match event {
            Event::Rest => 1.0,
            Event::Kink => 2.0,
            Event::LiftOff => 3.0,
            Event::StickLimit => 4.0,
            Event::Impact { .. } => 5.0,
        };
        self.order = self.order.mul_add(FORGETS, code);
    }
}

/// Follows an integration for so many returns to the section; `observer` sees all of it.
///
/// # Errors
/// The status that ends it; [`Status::NotComputed`] where it does not come back in time, or is cancelled.
pub(super) fn returns(
    scene: &Scene,
    integrator: &mut Integrator,
    count: usize,
    observer: &mut (impl Observer + Clone),
) -> Result<Vec<Return>, Status> {
    let mut all = Vec::with_capacity(count);
    let (mut since, mut watch) = (integrator.time, Watch::default());
    while all.len() < count {
        if integrator.time - since > LONGEST_RETURN {
            return Err(Status::NotComputed);
        }
        let (before, seen, order) = (integrator.clone(), observer.clone(), watch.order);
        scene.advance(integrator, PART, &mut (&mut watch, &mut *observer))?;
        let Some(rise) = watch.rise else { continue };
        // Once more, and no farther.
        (*integrator, *observer) = (before, seen);
        watch = Watch { rise: None, order };
        scene.advance(integrator, rise - integrator.time, &mut (&mut watch, &mut *observer))?;
        integrator.state.velocity[X2] = 0.0;
        all.push(Return { point: integrator.point(), time: integrator.time - since, order: watch.order });
        (since, watch) = (integrator.time, Watch::default());
    }
    Ok(all)
}

impl Integrator<'_> {
    /// Where it is, on the section.
    fn point(&self) -> Point {
        let contact = self.contact.state() as u32;
        let piece = if let Contact::Slip { piece, .. } = self.contact { piece } else { 0 };
        let State { position, velocity } = self.state;
        let piece = u32::try_from(piece).unwrap_or(u32::MAX);
        Point { position, velocity, contact, piece }
    }

    /// The same integration from a point of the section on.
    pub(super) fn at(&self, point: &Point) -> Self {
        let mut there = self.clone();
        there.state = State { position: point.position, velocity: point.velocity };
        let state = ContactState::ALL.into_iter().find(|state| *state as u32 == point.contact);
        let slips = |sigma: f64| Contact::Slip { sigma, piece: point.piece as usize };
        there.contact = match state.unwrap_or(ContactState::Free) {
            ContactState::Slip => slips(1.0),
            ContactState::Reverse => slips(-1.0),
            ContactState::Stick => Contact::Stick,
            ContactState::Free => Contact::Free,
        };
        there.disarmed = Disarmed::Nothing;
        there
    }
}
