//! The return map over the coordinates of the section and a parameter.

use nalgebra::DVector;

use crate::engine::cycle::candidate::Cycle;
use crate::engine::cycle::point::{FORGETS, Freedom, Point};
use crate::engine::cycle::pursuit::{STEPS_PER_PERIOD, TOLERANCE};
use crate::engine::method::Method;
use crate::engine::method::taylor::{REFERENCE_ORDER, State};
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reference::orbit::{measure, returns_of};
use crate::engine::scene::Scene;
use crate::model::contact::ContactState;
use crate::model::instance::Instance;

/// The instance of a value of the parameter; `None` where there is none.
pub(crate) type Instances<'a> = &'a dyn Fn(f64) -> Option<Instance>;

/// A plan whose steps are fine enough for differences of flights.
#[must_use]
pub(crate) fn fine(plan: &Plan) -> Plan {
    Plan {
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: TOLERANCE,
        steps_per_period: plan.steps_per_period.max(STEPS_PER_PERIOD),
        ..*plan
    }
}

/// The return map. A place is the free coordinates of the section, in lengths and times of the first cycle, as deviations from
/// its equilibrium, and then the parameter, 0 to 1 over its range.
#[derive(Clone, Copy)]
pub(super) struct ReturnMap<'a> {
    instances: Instances<'a>,
    plan: Plan,
    /// The range of the parameter.
    range: [f64; 2],
    pub(super) frame: Frame,
}

/// What the coordinates of a place are measured in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    freedom: Freedom,
    returns: usize,
    /// The equilibrium that places are deviations from: `x2` and `y1`, m.
    origin: [f64; 2],
    /// Length (m) and time (s) of one.
    length: f64,
    time: f64,
}

/// What a place comes to.
#[derive(Clone, Debug)]
pub(super) struct Flown {
    /// The coordinates after all returns.
    pub(super) end: DVector<f64>,
    /// Stands for the sequence of events on the way.
    pub(super) order: u64,
    /// The time that it took, s.
    pub(super) time: f64,
}

impl<'a> ReturnMap<'a> {
    /// The map about a cycle at a `value` of the parameter, by a [`fine`] plan, and the place of the cycle.
    pub(super) fn about(
        instances: Instances<'a>,
        plan: &Plan,
        range: [f64; 2],
        value: f64,
        (cycle, freedom): (&Cycle, Freedom),
    ) -> Option<(ReturnMap<'a>, DVector<f64>)> {
        let scene = Scene::planned(&instances(value)?, plan).ok()?;
        let size =
            cycle.start.coordinates(freedom).iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let frame = Frame {
            freedom,
            returns: cycle.returns,
            origin: [scene.equilibrium.x2, scene.equilibrium.y1],
            length: size * scene.units.length,
            time: scene.units.time,
        };
        let map = ReturnMap::along(instances, plan, range, frame);
        let place = map.place(&scene, &cycle.start, (value - range[0]) / (range[1] - range[0]));
        (size > 0.0).then_some((map, place))
    }

    /// The map over the range of a parameter, its places in the coordinates of another map.
    pub(super) fn along(
        instances: Instances<'a>,
        plan: &Plan,
        range: [f64; 2],
        frame: Frame,
    ) -> ReturnMap<'a> {
        ReturnMap { instances, plan: *plan, range, frame }
    }

    /// How many coordinates there are, without the parameter.
    pub(super) fn count(&self) -> usize {
        self.frame.freedom.count()
    }

    /// The value of the parameter at a place.
    pub(super) fn value(&self, place: &DVector<f64>) -> f64 {
        let part = place[self.count()];
        self.range[0] + part * (self.range[1] - self.range[0])
    }

    /// The instance and the scene at a place.
    pub(super) fn scene(&self, place: &DVector<f64>) -> Option<(Instance, Scene)> {
        let instance = (self.instances)(self.value(place))?;
        let scene = Scene::planned(&instance, &self.plan).ok()?;
        Some((instance, scene))
    }

    /// The offset (m), the unit (m) and the unit of time (s) of each coordinate, in the order of [`Point::coordinates`].
    fn axes(&self, scene: &Scene) -> [(f64, bool); 5] {
        let offset =
            [scene.equilibrium.x2 - self.frame.origin[0], scene.equilibrium.y1 - self.frame.origin[1]];
        [(offset[0], false), (offset[1], false), (0.0, true), (0.0, false), (0.0, true)]
    }

    fn place(&self, scene: &Scene, point: &Point, parameter: f64) -> DVector<f64> {
        let coordinates = point.coordinates(self.frame.freedom);
        let scaled = coordinates.iter().zip(self.axes(scene)).map(|(value, (offset, speed))| {
            if speed {
                value * scene.units.velocity * self.frame.time / self.frame.length
            } else {
                (value * scene.units.length + offset) / self.frame.length
            }
        });
        let parameter = std::iter::once(parameter);
        DVector::from_vec(scaled.chain(parameter).collect())
    }

    /// The point of the section at a place.
    fn point(&self, scene: &Scene, place: &DVector<f64>) -> Point {
        let coordinates: Vec<f64> = place
            .iter()
            .take(self.count())
            .zip(self.axes(scene))
            .map(|(value, (offset, speed))| {
                if speed {
                    value * self.frame.length / (self.frame.time * scene.units.velocity)
                } else {
                    (value * self.frame.length - offset) / scene.units.length
                }
            })
            .collect();
        let none = Point { position: [0.0; 3], velocity: [0.0; 3], contact: 0, piece: 0 };
        none.with(&coordinates)
    }

    /// The size of the motion on the section, in that of the first cycle: how far `x2` is from its equilibrium.
    pub(super) fn size(&self, place: &DVector<f64>) -> Option<f64> {
        let (_, scene) = self.scene(place)?;
        Some((self.point(&scene, place).position[0] * scene.units.length / self.frame.length).abs())
    }

    /// Follows a place for all returns of the cycle.
    pub(super) fn fly(&self, place: &DVector<f64>) -> Option<Flown> {
        let (_, scene) = self.scene(place)?;
        let point = self.point(&scene, place);
        if point.position[1] < 0.0 {
            return None;
        }
        let start = State { position: point.position, velocity: point.velocity };
        let all = returns_of(&scene, &self.plan, start, self.frame.returns)?;
        let last = all.last()?.point;
        // What flies there has coordinates that the place of a closed contact does not have, and the other way round.
        if (last.contact == ContactState::Free as u32) != (self.frame.freedom == Freedom::Open) {
            return None;
        }
        let end = self.place(&scene, &last, 0.0).rows(0, self.count()).into_owned();
        let order = all.iter().fold(0.0, |order: f64, at| order.mul_add(FORGETS, at.order));
        let time = all.iter().map(|at| at.time).sum::<f64>() * scene.units.time;
        Some(Flown { end, order: order.to_bits(), time })
    }

    /// The map of half the returns, of which this one's cycles are none.
    pub(super) fn halved(&self) -> Option<ReturnMap<'a>> {
        let returns = self.frame.returns;
        let frame = Frame { returns: returns / 2, ..self.frame };
        (returns > 1 && returns.is_multiple_of(2)).then_some(ReturnMap { frame, ..*self })
    }

    /// How far a place is from where it comes to.
    pub(super) fn gap(&self, place: &DVector<f64>) -> Option<f64> {
        Some((self.fly(place)?.end - place.rows(0, self.count())).amax())
    }

    /// What one period of the cycle at a place measures, with its multiplier of largest modulus.
    pub(super) fn measure(&self, place: &DVector<f64>, period: f64, multiplier: [f64; 2]) -> Option<Outcome> {
        let (_, scene) = self.scene(place)?;
        let start = self.point(&scene, place);
        let period = period / scene.units.time;
        measure(&scene, &self.plan, &Cycle { start, returns: self.frame.returns, period, multiplier })
    }
}
