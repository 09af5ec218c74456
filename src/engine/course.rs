//! The model of a run whose material changes its temperature, stair by stair.

use std::sync::Arc;

use crate::engine::method::taylor::BeltMotion;
use crate::model::equilibrium::{Equilibrium, Units};
use crate::model::heating::Heating;
use crate::model::instance::Instance;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

/// A stair has begun this long (scaled) before it does: the end of a stretch may be a rounding off. So many roundings of the time,
/// where that is more.
const EARLY: f64 = 1e-9;
const ROUNDINGS: f64 = 8.0;

/// What the model of a stair is of. Positions count from an equilibrium that moves steadily as the temperature does, so that
/// what slides is not pushed from stair to stair, and velocities from its velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Warmth {
    /// Temperature, °C.
    temperature: f64,
    /// How fast it changes, °C/s.
    rate: f64,
    /// `x2` and `y1` of its equilibrium, scaled, from that of the start.
    pub base: [f64; 2],
    /// By how much of that they lag behind, as dampers hold back what moves steadily.
    pub lag: [f64; 2],
    /// Their velocities.
    pub drift: [f64; 2],
}

impl Warmth {
    /// The belt as it is seen from the equilibrium.
    #[must_use]
    pub fn seen(&self, belt: BeltMotion) -> BeltMotion {
        BeltMotion { velocity: belt.velocity - self.drift[0], ..belt }
    }

    /// A steady temperature.
    pub(crate) fn steady(temperature: f64) -> Warmth {
        Warmth { temperature, ..Warmth::default() }
    }
}

/// The model over scaled time.
#[derive(Debug)]
pub(crate) struct Course {
    instance: Instance,
    heating: Arc<Heating>,
    units: Units,
    start: Equilibrium,
}

impl Course {
    /// That of an instance, whose equilibrium is `start`; `None` where its temperature stays.
    pub(crate) fn of(instance: &Instance, units: &Units, start: &Equilibrium) -> Option<Arc<Course>> {
        let heating = Arc::clone(instance.heating.as_ref()?);
        Some(Arc::new(Course { instance: instance.clone(), heating, units: *units, start: *start }))
    }

    /// The temperature (°C) at the time `t`, and how long it goes on like that.
    pub(crate) fn at(&self, t: f64) -> (f64, f64) {
        let (temperature, ends) = self.heating.stair(self.early(t));
        (temperature, ends / self.units.time - t)
    }

    /// The most pieces of the law on the way.
    pub(crate) fn most_pieces(&self, now: usize) -> usize {
        self.heating.most_pieces(now)
    }

    /// The model at the time `t`, where it is another than the one of `now`.
    ///
    /// # Errors
    /// [`Status::InvalidLaw`] and [`Status::NoEquilibrium`], as at a start.
    pub(crate) fn model(&self, t: f64, now: &Warmth) -> Result<Option<(Scaled, Warmth)>, Status> {
        let time = self.early(t);
        let (temperature, rate) = (self.heating.stair(time).0, self.heating.rate(time));
        let same = |a: f64, b: f64| a.total_cmp(&b).is_eq();
        if same(temperature, now.temperature) && same(rate, now.rate) {
            return Ok(None);
        }
        let instance = self.instance.heated(temperature);
        let equilibrium = Equilibrium::new(&instance)?;
        let model = Scaled::new(&instance, &self.units, &equilibrium);
        let at_rest = self.place(&equilibrium);
        let (mut drift, mut lag) = ([0.0; 2], [0.0; 2]);
        if rate != 0.0 {
            let near = |apart: f64| Equilibrium::new(&self.instance.heated(temperature + apart));
            let half = 0.5 * self.heating.height();
            let (below, above) = (self.place(&near(-half)?), self.place(&near(half)?));
            let rate = rate * self.units.time / (2.0 * half);
            drift = [0, 1].map(|k| (above[k] - below[k]) * rate);
            // What a damper takes of a steady velocity its spring takes of a length.
            let [along, across] =
                [drift[0] * model.c1 / model.k1, (drift[0] * model.s - drift[1]) * model.c2 / model.k2];
            lag = [-along, across - along * model.s];
        }
        let base = [0, 1].map(|k| at_rest[k] + lag[k]);
        Ok(Some((model, Warmth { temperature, rate, base, lag, drift })))
    }

    /// `x2` and `y1` of an equilibrium from that of the start, scaled.
    fn place(&self, equilibrium: &Equilibrium) -> [f64; 2] {
        let apart = |value: f64, start: f64| (value - start) / self.units.length;
        [apart(equilibrium.x2, self.start.x2), apart(equilibrium.y1, self.start.y1)]
    }

    /// The time (s) at which stairs are asked for.
    fn early(&self, t: f64) -> f64 {
        (t + EARLY.max(ROUNDINGS * f64::EPSILON * t)) * self.units.time
    }
}
