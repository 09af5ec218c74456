//! One instance from start to outcome: smooth steps between located events.
//!
//! Time always advances: a step ends at an event or at its full length, and events that do not advance
//! time are counted; too many end the instance with [`Status::EventLimit`].

use crate::engine::course::Warmth;
use crate::engine::method::pace::{Turns, stands_still};
use crate::engine::method::roots::Crossing;
use crate::engine::method::taylor::{
    BeltMotion, Expansion, MAX_ORDER, NORMAL, RELATIVE, Series, State, TANGENTIAL, X2,
};
use crate::engine::method::{Method, rk4};
use crate::engine::reference::bounds::{
    MAX_EVENTS_AT_ONCE, MAX_EVENTS_PER_PERIOD, MAX_HALVINGS, MAX_STEPS_PER_PERIOD, PAINLEVE_APPROACHED,
    RELEASED_AGAIN, ROUNDINGS, STEPS_BETWEEN_LOOKS,
};
use crate::engine::reference::observer::{Event, Observer, Step};
use crate::engine::reference::resolution::Resolution;
use crate::engine::reference::watched::{Disarmed, Watched};
use crate::engine::scene::MOST_STEPS;
use crate::model::contact::Contact;
use crate::model::scaled::Scaled;
use crate::model::status::Status;
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The running integration of one instance.
#[derive(Clone, Debug)]
pub struct Integrator<'a> {
    pub(super) model: Cow<'a, Scaled>,
    /// What the model is of.
    pub(super) warmth: Warmth,
    pub(super) resolution: Resolution,
    /// Set to stop early.
    cancel: Option<&'a AtomicBool>,
    turns: Turns,
    /// The longest step of each contact state.
    pub(super) longest: [f64; 4],
    pub(super) state: State,
    pub(super) contact: Contact,
    pub(super) disarmed: Disarmed,
    pub(super) time: f64,
    pub(super) steps: u64,
    events_at_once: u32,
    events_in_period: u32,
    steps_in_period: u32,
    period_end: f64,
}

impl<'a> Integrator<'a> {
    /// Starts at `state` (deviations from the equilibrium) on the belt `belt`: in flight where there is a gap.
    ///
    /// # Errors
    /// [`Status::Painleve`] when the first slip has `M11 ≤ 0`.
    pub fn new(
        model: &'a Scaled,
        resolution: Resolution,
        state: State,
        belt: BeltMotion,
    ) -> Result<Self, Status> {
        debug_assert!((4..=MAX_ORDER).contains(&resolution.order));
        let mut integrator = Integrator {
            longest: resolution.longest(model),
            model: Cow::Borrowed(model),
            warmth: Warmth::default(),
            resolution,
            cancel: None,
            turns: resolution.turns(),
            state,
            contact: Contact::Free,
            disarmed: Disarmed::Nothing,
            time: 0.0,
            steps: 0,
            events_at_once: 0,
            events_in_period: 0,
            steps_in_period: 0,
            period_end: std::f64::consts::TAU,
        };
        if integrator.state.position[1] <= 0.0 {
            integrator.enter_contact(belt)?;
        }
        Ok(integrator)
    }

    /// Lets it end with [`Status::NotComputed`] soon after `cancel` is set: a run may have minutes of steps.
    pub fn stop_at(&mut self, cancel: &'a AtomicBool) {
        self.cancel = Some(cancel);
    }

    /// The time simulated so far.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The steps taken so far.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The present state.
    #[must_use]
    pub fn state(&self) -> State {
        self.state
    }

    /// The present contact state.
    #[must_use]
    pub fn contact(&self) -> Contact {
        self.contact
    }

    /// Integrates for exactly `duration` with the belt moving as `belt` says at the start.
    ///
    /// # Errors
    /// The status that ends the instance before its time.
    pub fn advance(
        &mut self,
        duration: f64,
        belt: BeltMotion,
        observer: &mut impl Observer,
    ) -> Result<(), Status> {
        let began = self.time;
        let mut local = 0.0;
        while local < duration {
            let now = BeltMotion { velocity: belt.velocity + belt.acceleration * local, ..belt };
            if self.contact == Contact::Stick {
                self.state.velocity[0] = now.velocity;
            }
            let (taken, crossing) = self.one_step(duration - local, now, observer)?;
            local = if taken < duration - local { local + taken } else { duration };
            self.time = began + local;
            self.count(taken, crossing.is_some())?;
            if let Some(crossing) = crossing {
                let then = BeltMotion { velocity: belt.velocity + belt.acceleration * local, ..belt };
                let event = self.transition(crossing, then)?;
                observer.event(event);
            }
        }
        Ok(())
    }

    /// One step of at most `longest`; the time taken and the event that ended it.
    fn one_step(
        &mut self,
        longest: f64,
        belt: BeltMotion,
        observer: &mut impl Observer,
    ) -> Result<(f64, Option<Watched>), Status> {
        let allowed = self.longest[self.contact.state() as usize];
        let expansion = match self.resolution.method {
            Method::Taylor => {
                Expansion::new(&self.model, self.resolution.order, &self.state, self.contact, belt)
            }
            // Of a step in full: divided by the rest of a stretch, however short, its output would be rounding.
            Method::LocatedRk4 | Method::FixedStep => {
                rk4::expand(&self.model, &self.state, self.contact, belt, allowed)
            }
        };
        let (inertia, inertia_rate) = self.slip_inertia(&expansion);
        if inertia <= 0.0 {
            return Err(Status::Painleve);
        }
        if stands_still(allowed, f64::EPSILON) || self.is_unstable(allowed) {
            return Err(Status::StepTooLarge);
        }
        let full =
            self.resolution.nominal_step.min(allowed).min(self.longest_on_law(&expansion)).min(longest);
        let step = match self.resolution.method {
            Method::Taylor => expansion.step(full, self.resolution.tolerance, MAX_HALVINGS),
            Method::LocatedRk4 | Method::FixedStep => Some(full),
        };
        let step = step.ok_or_else(|| {
            let finest = self.resolution.nominal_step * 0.5_f64.powi(MAX_HALVINGS);
            if !self.state.is_finite() {
                Status::NonFinite
            } else if inertia < -inertia_rate * finest * PAINLEVE_APPROACHED {
                Status::Painleve
            } else {
                Status::StepTooLarge
            }
        })?;
        let (taken, crossing) = self.first_event(&expansion, step);
        self.steps += 1;
        let end = expansion.motion(taken);
        if !end.state.is_finite() {
            return Err(Status::NonFinite);
        }
        if taken > 0.0 {
            let warmth = self.warmth;
            observer.step(&Step {
                expansion: &expansion,
                start: self.time,
                duration: taken,
                belt,
                warmth,
                end,
            });
            self.state = end.state;
            self.disarmed = Disarmed::Nothing;
        }
        Ok((taken, crossing))
    }

    /// Whether a step of fixed length is too long for the fastest mode of the present contact state.
    fn is_unstable(&self, step: f64) -> bool {
        let fastest = self.model.fastest[self.contact.state() as usize];
        self.resolution.method != Method::Taylor && step * fastest > rk4::STABLE
    }

    /// The longest step that the law allows where the motion is on it.
    fn longest_on_law(&self, expansion: &Expansion) -> f64 {
        let Contact::Slip { sigma, piece } = self.contact else { return f64::INFINITY };
        let law = self.model.law.pieces[piece];
        if law.form().is_straight() {
            // What is left on a rising piece of a mode that holds the motion is no more than the tolerance, here next to
            // nothing. Halving finds no step for a falling one from far above.
            let falls = law.slope(0.0) < 0.0;
            return if falls { self.turns.longest_step_on(&self.model, piece) } else { f64::INFINITY };
        }
        if self.is_turned_back(expansion) {
            // What drives it through the layer is still to come.
            return f64::INFINITY;
        }
        let [v, acceleration, turning] = expansion.relative_motion();
        let speed = (sigma * v).max(0.0);
        let load = expansion.normal_force().max(self.model.n0);
        let share = law.fading(speed) * load / (1.0 + sigma * self.model.kappa * law.mu(speed));
        let relative = [sigma * acceleration, turning];
        1.0 / self.turns.layer().pace(&self.model.law, relative, share, speed)
    }

    /// `M11` at the start of a step in slip and its rate of change; 1 and 0 in the other contact states.
    fn slip_inertia(&self, expansion: &Expansion) -> (f64, f64) {
        match self.contact {
            Contact::Slip { sigma, piece } => {
                let law = self.model.law.pieces[piece];
                let [v, acceleration, _] = expansion.relative_motion();
                let q = sigma * law.mu(sigma * v);
                (self.model.slip_inertia(q), self.model.kappa * law.slope(sigma * v) * acceleration)
            }
            _ => (1.0, 0.0),
        }
    }

    /// The first event within `step`, or the whole step.
    fn first_event(&self, expansion: &Expansion, step: f64) -> (f64, Option<Watched>) {
        let mut taken = step;
        let mut found = None;
        let first_crossing = self.resolution.method.finder();
        self.watch(expansion, |watched, series, from_zero| {
            match first_crossing(series, taken, from_zero) {
                Crossing::Never => {}
                Crossing::Immediate => (taken, found) = (0.0, Some(watched)),
                Crossing::At(tau) => (taken, found) = (tau, Some(watched)),
            }
            taken > 0.0
        });
        (taken, found)
    }

    /// Hands every event function of the present contact state to `visit` until it returns false.
    fn watch(&self, expansion: &Expansion, mut visit: impl FnMut(Watched, &[f64], bool) -> bool) {
        let order = expansion.order;
        let forces = order - 1;
        match self.contact {
            Contact::Slip { sigma, piece } => {
                let law = &self.model.law;
                if !visit(Watched::LiftOff, &expansion.contact(NORMAL)[..forces], false) {
                    return;
                }
                let mut speed: Series = expansion.contact(RELATIVE).map(|v| sigma * v);
                let at_start = speed[0];
                let (lower, watched, disarmed) = if piece == 0 {
                    (0.0, Watched::Rest, Disarmed::Rest)
                } else {
                    (law.kinks[piece - 1], Watched::LowerKink, Disarmed::LowerKink)
                };
                speed[0] = at_start - lower;
                if self.is_turned_back(expansion) {
                    // Which way it goes is told by what follows.
                    speed[1] = 0.0;
                }
                if !visit(watched, &speed[..order], self.disarmed == disarmed) {
                    return;
                }
                if let Some(upper) = law.kinks.get(piece) {
                    speed = speed.map(|v| -v);
                    speed[0] = upper - at_start;
                    visit(Watched::UpperKink, &speed[..order], self.disarmed == Disarmed::UpperKink);
                }
            }
            Contact::Stick => {
                let mu = self.model.law.mu_stick;
                let (normal, tangential) = (expansion.contact(NORMAL), expansion.contact(TANGENTIAL));
                let springs = self.model.springs(self.state.position, self.state.velocity);
                let at_start = self.model.cone_margins(springs, expansion.acceleration(X2)[0]);
                for (sigma, at_start) in [1.0, -1.0].into_iter().zip(at_start) {
                    let mut margin: Series = std::array::from_fn(|k| mu * normal[k] - sigma * tangential[k]);
                    margin[0] = at_start;
                    if !visit(Watched::StickLimit { sigma }, &margin[..forces], false) {
                        return;
                    }
                }
                visit(Watched::LiftOff, &normal[..forces], false);
            }
            Contact::Free => {
                visit(Watched::Gap, &expansion.gap()[..=order], self.disarmed == Disarmed::Gap);
            }
        }
    }

    /// Whether it was released on the edge of the cone and turned back by a rounding.
    fn is_turned_back(&self, expansion: &Expansion) -> bool {
        let [_, acceleration, _] = expansion.relative_motion();
        let again = self.disarmed == Disarmed::Rest && self.events_at_once >= RELEASED_AGAIN;
        again && acceleration.abs() <= self.rounding(expansion)
    }

    /// The rounding error of the acceleration at rest, from the forces on the edge of the cone.
    fn rounding(&self, expansion: &Expansion) -> f64 {
        let (tangential, normal) = expansion.forces(0.0);
        let size = self.model.n0 * (1.0 + self.model.law.mu_stick) + tangential.abs() + normal.abs();
        ROUNDINGS * f64::EPSILON * size
    }

    /// Counts steps and events and stops an instance where either piles up.
    fn count(&mut self, taken: f64, event: bool) -> Result<(), Status> {
        if self.time >= self.period_end {
            self.period_end = self.time + std::f64::consts::TAU;
            self.events_in_period = 0;
            self.steps_in_period = 0;
        }
        self.steps_in_period += 1;
        let looks = self.steps.is_multiple_of(STEPS_BETWEEN_LOOKS);
        if looks && self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
            return Err(Status::NotComputed);
        }
        if self.steps_in_period > MAX_STEPS_PER_PERIOD || self.steps > u64::from(MOST_STEPS) {
            return Err(Status::StepTooLarge);
        }
        if event {
            // A stick that ends within a rounding of the time has not lasted.
            let lasts = taken > ROUNDINGS * f64::EPSILON * self.time;
            self.events_at_once = if lasts { 0 } else { self.events_at_once + 1 };
            self.events_in_period += 1;
        }
        if self.events_at_once > MAX_EVENTS_AT_ONCE || self.events_in_period > MAX_EVENTS_PER_PERIOD {
            return Err(Status::EventLimit);
        }
        Ok(())
    }

    /// Carries out the transition that belongs to an event at the present state.
    fn transition(&mut self, crossing: Watched, belt: BeltMotion) -> Result<Event, Status> {
        match (crossing, self.contact) {
            (Watched::LowerKink | Watched::UpperKink, Contact::Slip { sigma, piece }) => {
                let (piece, disarmed) = if crossing == Watched::LowerKink {
                    (piece - 1, Disarmed::UpperKink)
                } else {
                    (piece + 1, Disarmed::LowerKink)
                };
                self.contact = Contact::Slip { sigma, piece };
                self.disarmed = disarmed;
                Ok(Event::Kink)
            }
            (Watched::Rest, contact) => {
                // Slip at rest whose inertia is not positive has passed the place where that vanishes.
                if let Contact::Slip { sigma, .. } = contact
                    && self.model.slip_inertia(sigma * self.model.law.pieces[0].mu(0.0)) <= 0.0
                {
                    return Err(Status::Painleve);
                }
                self.rest(belt)?;
                Ok(Event::Rest)
            }
            (Watched::StickLimit { sigma }, _) => {
                let springs = self.model.springs(self.state.position, self.state.velocity);
                let contact = self.model.slip_or_free(springs, sigma, 0.0)?;
                self.enter(contact, true);
                Ok(Event::StickLimit)
            }
            (Watched::Gap, _) => {
                self.state.position[1] = 0.0;
                let [vx, vy, _] = self.state.velocity;
                let impact = self.model.impact(vx, vy.min(0.0), belt.velocity)?;
                self.state.velocity[0] = impact.vx;
                self.state.velocity[1] = impact.vy;
                if impact.vy > 0.0 {
                    self.enter(Contact::Free, false);
                } else {
                    self.enter_contact(belt)?;
                }
                Ok(Event::Impact { gained_energy: impact.gained_energy })
            }
            (Watched::LiftOff | Watched::LowerKink | Watched::UpperKink, _) => {
                self.enter(Contact::Free, false);
                Ok(Event::LiftOff)
            }
        }
    }

    /// Decides the contact state of a closed contact from the present velocities.
    fn enter_contact(&mut self, belt: BeltMotion) -> Result<(), Status> {
        let relative = belt.velocity - self.state.velocity[0];
        if relative == 0.0 {
            return self.rest(belt);
        }
        let springs = self.model.springs(self.state.position, self.state.velocity);
        let contact = self.model.slip_or_free(springs, relative.signum(), relative.abs())?;
        self.enter(contact, false);
        Ok(())
    }

    /// Decides the contact state at zero relative velocity.
    pub(super) fn rest(&mut self, belt: BeltMotion) -> Result<(), Status> {
        self.state.velocity[0] = belt.velocity;
        let springs = self.model.springs(self.state.position, self.state.velocity);
        let contact = self.model.contact_at_rest(springs, belt.acceleration)?;
        self.enter(contact, true);
        Ok(())
    }

    /// Enters a contact state; `at_rest` when the relative velocity is zero.
    fn enter(&mut self, contact: Contact, at_rest: bool) {
        self.contact = contact;
        self.disarmed = match contact {
            Contact::Slip { .. } if at_rest => Disarmed::Rest,
            Contact::Free => Disarmed::Gap,
            _ => Disarmed::Nothing,
        };
    }
}
