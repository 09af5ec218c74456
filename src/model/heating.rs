//! How the temperature of a material goes over a run, and the friction law with it.
//!
//! Temperature is straight between corners. A run takes it in stairs, so that its law is one from stair to stair: engines then
//! solve the same problem to the last digit, whatever their steps.

use std::sync::Arc;

use crate::model::friction::{FrictionLaw, LawKind, MuTable};
use crate::model::material::Material;
use crate::model::motion::{Corners, straight};
use crate::model::{Param, Params};

/// Stairs of all rises and falls of a run together.
pub const STAIRS: u32 = 1024;

/// How the temperature of a material goes over a run.
#[derive(Clone, Debug)]
pub struct Heating {
    material: Arc<Material>,
    kind: LawKind,
    table: Option<Arc<MuTable>>,
    corners: Corners,
    /// The height of a stair, °C.
    height: f64,
}

impl Heating {
    /// The law `kind` of a material whose temperature (°C) has these corners over time (s), the first at 0; after the last it
    /// stays. `table` is read where the material has none.
    #[must_use]
    pub fn new(
        material: Arc<Material>,
        kind: LawKind,
        table: Option<Arc<MuTable>>,
        corners: Corners,
    ) -> Heating {
        let all: f64 = corners.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs()).sum();
        let height = (all / f64::from(STAIRS)).max(f64::MIN_POSITIVE);
        Heating { material, kind, table, corners, height }
    }

    /// The temperature at a time (s), °C.
    #[must_use]
    pub fn temperature(&self, time: f64) -> f64 {
        straight(&self.corners, time)
    }

    /// The temperature (°C) of the stair at a time (s), and when that stair ends: each lies half below and half above the
    /// temperature itself.
    #[must_use]
    pub fn stair(&self, time: f64) -> (f64, f64) {
        let ([begun, first], next) = self.leg(time);
        let Some([end, last]) = next else { return (first, f64::INFINITY) };
        let steps = ((last - first).abs() / self.height).ceil();
        if steps == 0.0 {
            return (first, end);
        }
        let change = |gone: f64| begun + (end - begun) * ((gone + 0.5) / steps);
        let mut gone = ((time - begun) / (end - begun) * steps + 0.5).floor().min(steps);
        if gone < steps && change(gone) <= time {
            // By a rounding.
            gone += 1.0;
        }
        let ends = if gone < steps { change(gone) } else { end };
        (first + (last - first) * (gone / steps), ends)
    }

    /// How fast the temperature changes from a time (s) on, °C/s.
    #[must_use]
    pub fn rate(&self, time: f64) -> f64 {
        let ([begun, first], next) = self.leg(time);
        next.map_or(0.0, |[end, last]| (last - first) / (end - begun))
    }

    /// The corner before a time (s), and the one after it, if any.
    fn leg(&self, time: f64) -> ([f64; 2], Option<[f64; 2]>) {
        let after = self.corners.partition_point(|corner| corner[0] <= time).max(1);
        (self.corners[after - 1], self.corners.get(after).copied())
    }

    /// A small part of all temperatures, for differences, °C.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.height
    }

    /// The law at a temperature (°C), whose parameters it puts into `params`.
    #[must_use]
    pub fn law_at(&self, temperature: f64, params: &mut Params) -> FrictionLaw {
        params.set(Param::Temperature, temperature);
        self.material.law_at(temperature, self.kind, params, self.table.as_ref())
    }

    /// The most pieces that the law has on the way, of one that has `now`.
    #[must_use]
    pub fn most_pieces(&self, now: usize) -> usize {
        if self.kind.reads_table() { self.material.most_rows().max(now) } else { now }
    }
}
