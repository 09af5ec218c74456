//! The reference looks for the cycle of one run.

use crate::engine::cycle::candidate::{CLOSES, Cycle};
use crate::engine::cycle::hunt::Hunt;
use crate::engine::cycle::point::{Freedom, Point, Return};
use crate::engine::cycle::pursuit::{GROWS, MANY, Pursuit};
use crate::engine::measuring::Measuring;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::observe::{EnergyGains, Growth};
use crate::engine::reference::round::round;
use crate::engine::reference::section::returns;
use crate::engine::scene::Scene;
use crate::model::contact::ContactState;
use crate::model::status::Status;

/// The hunts of one run.
pub(super) struct Chase<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    /// Whether the law is straight, so that a motion without events can only grow or decay.
    straight: bool,
    pursuit: Pursuit,
    /// Steps and scaled time of all flights.
    flown: (u64, f64),
}

impl<'a> Chase<'a> {
    /// The hunts of a run; `None` where the plan has none.
    pub(super) fn new(scene: &'a Scene, plan: &'a Plan) -> Option<Chase<'a>> {
        let straight = scene.model.law.pieces.iter().all(|piece| piece.form().is_straight());
        let chase = Chase { scene, plan, straight, pursuit: Pursuit::default(), flown: (0, 0.0) };
        plan.hunts.then_some(chase)
    }

    /// Goes on with a run until it has come to its cycle, which it measures; `None` when a window is next.
    ///
    /// # Errors
    /// The status that ends the run.
    pub(super) fn run(
        &mut self,
        integrator: &mut Integrator,
        seen: (&mut Growth, &mut EnergyGains),
        measuring: &mut Measuring,
    ) -> Result<Option<Outcome>, Status> {
        let (growth, gains) = seen;
        while self.pursuit.goes_on() {
            let wait = if !growth.met_event() && self.straight {
                GROWS - integrator.time()
            } else {
                if let Some(outcome) = self.look(integrator, growth, gains)? {
                    return Ok(Some(outcome));
                }
                self.pursuit.wait()
            };
            if wait <= 0.0 || !measuring.wait(integrator.time(), wait) {
                return Ok(None);
            }
            self.scene.advance(integrator, wait, &mut (&mut *growth, &mut *gains))?;
        }
        Ok(None)
    }

    /// Whether a run whose windows agree leaves an unstable cycle, about which it may turn for long.
    pub(super) fn leaves(&mut self, integrator: &Integrator, growth: &Growth) -> bool {
        if !growth.met_event() && self.straight {
            return false;
        }
        let Some(transient) = self.fly(integrator.clone(), MANY) else { return false };
        let Some(last) = transient.last() else { return false };
        let (freedom, belt) = (self.freedom(&last.point), self.scene.belt(0.0).velocity);
        if let Some(hunt) = self.pursuit.doubts(&transient, freedom, belt) {
            self.hunt_down(hunt, integrator);
        }
        self.pursuit.leaves(&transient)
    }

    /// One hunt.
    fn look(
        &mut self,
        integrator: &mut Integrator,
        growth: &mut Growth,
        gains: &mut EnergyGains,
    ) -> Result<Option<Outcome>, Status> {
        let transient = match self.transient(integrator, growth, gains) {
            Ok(transient) => transient,
            Err(Status::NotComputed) => return Ok(None),
            Err(status) => return Err(status),
        };
        let Some(cycle) = self.cycle(&transient, integrator) else { return Ok(None) };
        self.measure(&cycle, integrator, growth, *gains)
    }

    /// The next returns of the run.
    fn transient(
        &self,
        integrator: &mut Integrator,
        growth: &mut Growth,
        gains: &mut EnergyGains,
    ) -> Result<Vec<Return>, Status> {
        let mut seen = (*growth, *gains);
        let all = returns(self.scene, integrator, self.pursuit.looks_at(), &mut seen);
        (*growth, *gains) = seen;
        all
    }

    /// The cycle that a transient comes to.
    fn cycle(&mut self, transient: &[Return], integrator: &Integrator) -> Option<Cycle> {
        let here = transient.last()?.point;
        let (now, belt) = (integrator.time(), self.scene.belt(0.0).velocity);
        if let Some(hunt) = self.pursuit.begin(transient, self.freedom(&here), now, belt) {
            self.hunt_down(hunt, integrator);
        }
        let (points, count) = self.pursuit.way(transient, now)?;
        let flown: Vec<_> = points.iter().map(|point| self.fly(integrator.at(point), count)).collect();
        let flown: Vec<_> = flown.iter().map(Option::as_deref).collect();
        self.pursuit.arrives(&points, &flown)
    }

    fn hunt_down(&mut self, mut hunt: Hunt, integrator: &Integrator) {
        let mut next = hunt.request();
        while let Some((points, count)) = self.pursuit.take(next) {
            let flown: Option<Vec<_>> =
                points.iter().map(|point| self.fly(integrator.at(point), count)).collect();
            next = hunt.take(flown.as_deref());
        }
    }

    fn freedom(&self, point: &Point) -> Freedom {
        Freedom::of(point, self.scene.model.s == 0.0, ContactState::Free as u32)
    }

    fn fly(&mut self, mut integrator: Integrator, count: usize) -> Option<Vec<Return>> {
        let (steps, time) = (integrator.steps(), integrator.time());
        let flown = returns(self.scene, &mut integrator, count, &mut ());
        self.flown.0 += integrator.steps() - steps;
        self.flown.1 += integrator.time() - time;
        flown.ok()
    }

    /// Measures one period of a cycle; `None` where it does not close.
    fn measure(
        &self,
        cycle: &Cycle,
        integrator: &Integrator,
        growth: &Growth,
        gains: EnergyGains,
    ) -> Result<Option<Outcome>, Status> {
        let start = integrator.at(&cycle.start);
        let outcome = round(self.scene, self.plan, start, cycle, growth, self.flown, CLOSES)?;
        Ok(outcome.map(|outcome| Outcome { energy_gaining_impacts: Some(gains.0), ..outcome }))
    }
}
