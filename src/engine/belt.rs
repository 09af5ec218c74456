//! The velocity of the belt over scaled time.

use crate::engine::method::taylor::BeltMotion;
use crate::model::equilibrium::Units;
use crate::model::instance::Instance;
use crate::model::motion::Corners;

/// The velocity of the belt over scaled time: straight between corners, then constant.
#[derive(Clone, Debug)]
pub(crate) struct Belt {
    corners: Corners,
    /// Of time (s) and velocity (m/s).
    units: [f64; 2],
}

impl Belt {
    /// The belt of an instance.
    pub(crate) fn new(instance: &Instance, units: &Units) -> Belt {
        Belt { corners: instance.motion.corners(&instance.params), units: [units.time, units.velocity] }
    }

    fn corner(&self, index: usize) -> [f64; 2] {
        let [time, velocity] = self.corners[index];
        [time / self.units[0], velocity / self.units[1]]
    }

    /// The belt at the time `t`, and how long it goes on like that.
    pub(crate) fn at(&self, t: f64) -> (BeltMotion, f64) {
        // The first corner is at 0.
        let after = self.corners.partition_point(|corner| corner[0] / self.units[0] <= t).max(1);
        let [begun, start] = self.corner(after - 1);
        if after == self.corners.len() {
            return (BeltMotion { velocity: start, acceleration: 0.0 }, f64::INFINITY);
        }
        let [ends, end] = self.corner(after);
        let acceleration = (end - start) / (ends - begun);
        (BeltMotion { velocity: start + acceleration * (t - begun), acceleration }, ends - t)
    }

    /// Whether it is of one velocity.
    pub(crate) fn is_steady(&self) -> bool {
        self.corners.len() == 1
    }

    /// When the last corner is.
    pub(crate) fn duration(&self) -> f64 {
        self.corner(self.corners.len() - 1)[0]
    }

    /// Every scaled velocity, and of every part of it between corners its length and acceleration.
    pub(crate) fn numbers(&self) -> (impl Iterator<Item = f64>, impl Iterator<Item = [f64; 2]>) {
        let velocities = (0..self.corners.len()).map(|index| self.corner(index)[1]);
        let parts = (1..self.corners.len()).map(|index| {
            let ([begun, start], [ends, end]) = (self.corner(index - 1), self.corner(index));
            [ends - begun, (end - start) / (ends - begun)]
        });
        (velocities, parts)
    }
}
