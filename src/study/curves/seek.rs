//! Where curves begin: special points on lines across a plane.

use rayon::prelude::*;

use crate::engine::plan::Plan;
use crate::model::Param;
use crate::model::instance::Instance;
use crate::results::figure::panels::Panels;
use crate::study::cycles::branch::Spot;
use crate::study::cycles::curve::{Curve, Field};
use crate::study::cycles::map::fine;
use crate::study::cycles::special::Special;
use crate::study::error::{Error, Result};
use crate::study::hysteresis::follow::{Hysteresis, can_follow};
use crate::sweep::error;
use crate::sweep::grid::{AxisKey, Grid, Value, spaced};
use crate::sweep::spec::Spec;

/// Values of a line: so many cycles are settled on it, up and down.
const VALUES: usize = 41;

/// Values of a line at which the equilibrium is looked at.
const OF_EIGENVALUES: usize = 1201;

/// A curve that reaches less far, as a part of the range of either parameter, is none.
const SHORTEST: f64 = 0.01;

/// The curves of a plane.
#[derive(Clone, Debug)]
pub struct PlaneCurves {
    /// Both parameters: across and up.
    pub params: [Param; 2],
    /// The values of the other axes of the sweep.
    pub others: Vec<(AxisKey, Value)>,
    /// The curves.
    pub curves: Vec<Curve>,
    /// The special points that lie on none of them, by both parameters: what is near them is not followed.
    pub alone: Vec<(Special, [f64; 2])>,
}

/// A plane of a sweep.
struct Plane<'a> {
    spec: &'a Spec,
    params: [Param; 2],
    ranges: [[f64; 2]; 2],
    others: Vec<(AxisKey, Value)>,
    /// The others as the pairs of `--at`.
    at: Vec<String>,
}

impl Plane<'_> {
    fn instance(&self, values: [f64; 2]) -> error::Result<Instance> {
        let [x, y] = self.params.map(|param| param.info().name);
        let own = [format!("{x}={}", values[0]), format!("{y}={}", values[1])];
        self.spec.instance_at(&[self.at.as_slice(), &own].concat().join(","))
    }
}

/// Lines across the planes of a sweep, so many along each axis.
///
/// # Errors
/// As [`seek`].
pub fn count(spec: &Spec, lines: usize) -> Result<usize> {
    Ok(2 * lines * planes(spec)?.len())
}

/// The curves in all planes of a sweep, from so many `lines` along each axis; `passed` is called after each of them, from any thread.
///
/// # Errors
/// When the sweep has no plane of two parameters that can be followed.
pub fn seek(spec: &Spec, lines: usize, passed: &(dyn Fn() + Sync)) -> Result<Vec<PlaneCurves>> {
    let planes = planes(spec)?;
    let ways: Vec<(usize, usize, f64)> = (0..planes.len())
        .flat_map(|plane| [0, 1].map(|along| (plane, along)))
        .flat_map(|(plane, along)| {
            let across = planes[plane].ranges[1 - along];
            (0..lines).map(move |line| (plane, along, spaced(across, lines, false, line)))
        })
        .collect();
    let met = |(plane, along, at): &(usize, usize, f64)| {
        let spots = spots(&planes[*plane], *along, *at);
        passed();
        spots
    };
    let met: Vec<Vec<Spot>> = ways.par_iter().map(met).collect();
    let curves: Vec<Followed> = planes
        .par_iter()
        .enumerate()
        .map(|(number, plane)| {
            let of_plane = ways.iter().zip(&met).filter(|((of, ..), _)| *of == number);
            let spots =
                of_plane.flat_map(|((_, along, at), spots)| spots.iter().map(|spot| (*along, *at, spot)));
            followed(plane, spots)
        })
        .collect();
    let told = |(plane, (curves, alone)): (Plane<'_>, Followed)| PlaneCurves {
        params: plane.params,
        others: plane.others,
        curves,
        alone,
    };
    Ok(planes.into_iter().zip(curves).map(told).collect())
}

/// Curves, and the special points that lie on none.
type Followed = (Vec<Curve>, Vec<(Special, [f64; 2])>);

/// The curves through special points, each once, and the points that have none.
fn followed<'a>(plane: &Plane<'_>, spots: impl Iterator<Item = (usize, f64, &'a Spot)>) -> Followed {
    let plan = fine(&Plan::new(plane.spec));
    let instance = |values: [f64; 2]| plane.instance(values).ok();
    let field = Field { plane: &instance, plan: &plan, ranges: plane.ranges };
    let (mut curves, mut alone): Followed = (Vec::new(), Vec::new());
    for (along, at, spot) in spots {
        let mut values = [at; 2];
        values[along] = spot.cycle.value;
        if curves.iter().any(|curve| curve.holds(plane.ranges, spot.special, values, spot.cycle.x2_std())) {
            continue;
        }
        let part = |k: usize| (values[k] - plane.ranges[k][0]) / (plane.ranges[k][1] - plane.ranges[k][0]);
        let curve = Curve::through(field, spot, along, [part(0), part(1)]);
        match curve.filter(|curve| curve.reach(plane.ranges) >= SHORTEST) {
            Some(curve) if curves.iter().any(|other| other.covers(plane.ranges, &curve)) => {}
            Some(curve) => {
                // One that ended early may be a part of it.
                curves.retain(|other| !curve.covers(plane.ranges, other));
                curves.push(curve);
            }
            None => alone.push((spot.special, values)),
        }
    }
    (curves, alone)
}

/// What is special on a line `along` a parameter, the other one at a value.
fn spots(plane: &Plane<'_>, along: usize, at: f64) -> Vec<Spot> {
    let instance = |value: f64| {
        let mut values = [at; 2];
        values[along] = value;
        plane.instance(values)
    };
    let values = (0..VALUES).map(|k| spaced(plane.ranges[along], VALUES, false, k));
    // Where the line leaves what a law allows, what is left of it is gone.
    let values: Vec<f64> = values.filter(|value| instance(*value).is_ok()).collect();
    if values.len() < 2 {
        return Vec::new();
    }
    let of_value = |value: f64| instance(value).ok();
    let range = [values[0], values[values.len() - 1]];
    let closer: Vec<f64> = (0..OF_EIGENVALUES).map(|k| spaced(range, OF_EIGENVALUES, false, k)).collect();
    let mut spots = Spot::births(&of_value, &closer);
    let found = Hysteresis::follow(plane.params[along], values, &Plan::new(plane.spec), instance);
    let found = found.map_or_else(|_: error::Error| Vec::new(), |found| found.cycles);
    spots.extend(found.into_iter().flat_map(|branch| branch.spots));
    spots
}

/// The planes of a sweep: the panels of its figure.
fn planes(spec: &Spec) -> Result<Vec<Plane<'_>>> {
    let Grid::Axes(axes) = &spec.grid else { return Err(Error::NoCurvesOfTuples) };
    let panels = Panels::new(&spec.grid);
    let param = |key: Option<AxisKey>| match key {
        Some(AxisKey::Param(param)) if can_follow(param) => Ok(param),
        Some(key) => Err(Error::NoCurvesAlong { name: key.name() }),
        None => Err(Error::NoPlane),
    };
    let y = panels.y.as_ref().ok_or(Error::NoPlane)?;
    let params = [param(panels.x.key())?, param(y.key())?];
    let range = |param: Param| {
        let axis = axes.iter().find(|axis| axis.key == AxisKey::Param(param));
        let numbers = axis.into_iter().flat_map(|axis| &axis.values).filter_map(Value::number);
        numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let ranges = params.map(range);
    if ranges.iter().any(|[low, high]| low >= high) {
        return Err(Error::NoPlane);
    }
    let plane = |first: usize| {
        let coordinates = spec.grid.coordinates(first);
        let all = axes.iter().zip(coordinates).map(|(axis, value)| (axis.key, value.clone()));
        let others: Vec<(AxisKey, Value)> =
            all.filter(|(key, _)| !params.iter().any(|param| *key == AxisKey::Param(*param))).collect();
        let at = others.iter().map(|(key, value)| format!("{}={value}", key.name())).collect();
        Plane { spec, params, ranges, others, at }
    };
    Ok(panels.all.iter().map(|panel| plane(panels.instances[panel.cells.start])).collect())
}
