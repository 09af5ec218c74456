//! The model of a run whose material changes its temperature, stair by stair.

use std::sync::Arc;

use crate::model::equilibrium::{Equilibrium, Units};
use crate::model::heating::Heating;
use crate::model::instance::Instance;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

/// A stair has begun this long (scaled) before it does: the end of a stretch may be a rounding off. So many roundings of the time,
/// where that is more.
const EARLY: f64 = 1e-9;
const ROUNDINGS: f64 = 8.0;

/// What the model of a stair is of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Warmth {
    /// Temperature, °C.
    pub temperature: f64,
    /// `x2` and `y1` of its equilibrium, scaled, from that of the start: positions count from there.
    pub base: [f64; 2],
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
        let early = EARLY.max(ROUNDINGS * f64::EPSILON * t);
        let (temperature, ends) = self.heating.stair((t + early) * self.units.time);
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
        let (temperature, _) = self.at(t);
        if temperature.total_cmp(&now.temperature).is_eq() {
            return Ok(None);
        }
        let instance = self.instance.heated(temperature);
        let equilibrium = Equilibrium::new(&instance)?;
        let apart = |value: f64, start: f64| (value - start) / self.units.length;
        let base = [apart(equilibrium.x2, self.start.x2), apart(equilibrium.y1, self.start.y1)];
        let model = Scaled::new(&instance, &self.units, &equilibrium);
        Ok(Some((model, Warmth { temperature, base })))
    }
}
