//! From a description to a model.

use std::collections::{HashMap, HashSet};

use super::document::{Bond, By, Document, Load, Sliding, Support, Varied, Vary};
use super::parts::join;
use super::surfaces::flat;
use super::values::{check_friction, check_kn, check_modes, check_output, coefficients};
use super::varied::check_vary;
use crate::Error;
use crate::assembly::{Loads, Model, Partly, Penalty, Supports, nodal_forces};
use crate::contact::{
    Point, bonded, bonded_mortar, bonded_points, conforms, mortar, overhangs, rotating, sliding,
    sliding_on_rigid,
};
use crate::mesh::{FaceRef, Mesh};

/// A model and what is to be computed of it.
#[derive(Debug, Clone)]
pub struct Study {
    /// The description.
    pub document: Document,
    /// Mesh, materials, supports, contact.
    pub model: Model,
    /// Name of each part with its numbers of nodes and elements.
    pub parts: Vec<(String, usize, usize)>,
    /// Faces of the slaves of all sliding surfaces.
    pub faces: Vec<FaceRef>,
    /// Loads of the static step.
    pub loads: Loads,
    /// Coefficients of friction, rising.
    pub mus: Vec<f64>,
    /// Whether the sliding surfaces have nodes at the same places, one by one.
    pub matching: Vec<bool>,
    /// Sentences on what the files of meshes say and is left out.
    pub remarks: Vec<String>,
}

impl Study {
    /// Builds the model of a description; `file` gives the text behind a path of a mesh, or says why not.
    ///
    /// # Errors
    /// The first value that cannot be, by its key; meshes, sets and surfaces that do not fit.
    pub fn new(document: Document, file: &dyn Fn(&str) -> Result<String, String>) -> Result<Self, Error> {
        let mus = coefficients(&document.friction.mu)?;
        check_friction(&document.friction)?;
        check_modes(&document.modes)?;
        check_output(&document.output)?;
        check_kn(&document)?;
        check_vary(&document)?;
        if let Some(celsius) = document.temperature.filter(|celsius| !celsius.is_finite()) {
            return Err(Error::at("temperature", format!("{celsius} °C is no finite number")));
        }
        for (i, mu) in document.output.shapes_at.iter().enumerate() {
            if !mus.iter().any(|known| (known - mu).abs() <= 1e-12) {
                let what = format!("{mu} is not among the values of friction.mu: name one of them");
                return Err(Error::at(format!("output.shapes_at[{i}]"), what));
            }
        }
        let joined = join(&document.parts, &document.materials, document.temperature, file)?;
        let mut model = Model { mesh: joined.mesh, materials: joined.materials, ..Model::default() };
        model.supports = joined.supports;
        let from_files =
            joined.ties.into_iter().map(|(slaves, masters)| Bond { slaves, masters, by: By::default() });
        for (i, support) in document.supports.iter().enumerate() {
            hold(&mut model, &format!("supports[{i}]"), support)?;
        }
        check_displaced(&model, &document.supports)?;
        for (i, bond) in document.bonds.iter().cloned().chain(from_files).enumerate() {
            tie(&model.mesh, &mut model.supports, &format!("bonds[{i}]"), &bond)?;
        }
        if document.sliding.is_empty() {
            return Err(Error::at(
                "sliding",
                "there is none: describe the surfaces that slide, as [[sliding]]",
            ));
        }
        let (mut faces, mut matching) = (Vec::new(), Vec::new());
        let mut whole = HashSet::new();
        for (i, pair) in document.sliding.iter().enumerate() {
            let key = format!("sliding[{i}]");
            let slid = slide(&model.mesh, &key, pair)?;
            check_edges(&model.contact, &slid.points, &key)?;
            model.contact.extend(slid.points);
            whole.extend(slid.slaves.iter().filter(|face| !slid.partly.contains_key(face)).copied());
            // A face may lie on the masters of several pairs.
            for (face, places) in slid.partly {
                model.partly.entry(face).or_default().extend(places);
            }
            faces.extend(slid.slaves);
            matching.push(slid.matches);
        }
        model.partly.retain(|face, _| !whole.contains(face));
        let mut known = HashSet::new();
        faces.retain(|face| known.insert(*face));
        if let Some(stiffness) = document.friction.contact_stiffness {
            model.penalty = Some(Penalty { stiffness, faces: faces.clone() });
        }
        let mut loads = Loads::default();
        for (i, load) in document.loads.iter().enumerate() {
            let key = format!("loads[{i}]");
            let pressure = press(&model.mesh, &key, load)?;
            check_moves(&model, &key, &load.set, &pressure)?;
            loads.pressure.push(pressure);
        }
        let study = Self {
            document,
            model,
            parts: joined.sizes,
            faces,
            loads,
            mus,
            matching,
            remarks: joined.remarks,
        };
        if study.document.output.modal && !study.is_pressed() {
            let what = "maps need a load, which a slope of friction acts on, but nothing presses the surfaces: give a load, or leave modal out";
            return Err(Error::at("output.modal", what));
        }
        if study.document.friction.static_mu != 0.0 && !study.is_pressed() {
            let what = "it is the friction of the static step, but nothing presses the surfaces: give a load, or leave it out";
            return Err(Error::at("friction.static_mu", what));
        }
        if study.document.friction.slope != 0.0 && !study.is_pressed() {
            let what = "a slope acts on the pressure, but nothing presses the surfaces: give a load";
            return Err(Error::at("friction.slope", what));
        }
        let of_load = |vary: &Vary| matches!(vary.parameter, Varied::Load | Varied::Slope);
        if study.document.vary.as_ref().is_some_and(of_load) && !study.is_pressed() {
            let what = "it acts through the pressure, but nothing presses the surfaces: give a load";
            return Err(Error::at("vary.parameter", what));
        }
        if study.document.modes.stressed && !study.is_pressed() {
            let what =
                "the stress is that of a load, but nothing presses the bodies: give one, or leave it out";
            return Err(Error::at("modes.stressed", what));
        }
        Ok(study)
    }

    /// The key of what presses the surfaces, where that is one thing.
    pub(super) fn presser(&self) -> Option<String> {
        let loads = self.document.loads.iter().enumerate().map(|(i, load)| {
            let name = if load.force.is_some() { "force" } else { "pressure" };
            format!("loads[{i}].{name}")
        });
        let moved =
            self.document.supports.iter().enumerate().filter(|(_, support)| support.displacement != 0.0);
        let mut all = loads.chain(moved.map(|(i, _)| format!("supports[{i}].displacement")));
        all.next().filter(|_| all.next().is_none())
    }

    /// Whether there is a static step to solve.
    #[must_use]
    pub fn is_pressed(&self) -> bool {
        !self.loads.pressure.is_empty() || self.model.supports.prescribed.values().any(|u| *u != 0.0)
    }
}

fn faces_of<'a>(mesh: &'a Mesh, key: &str, set: &str) -> Result<&'a [FaceRef], Error> {
    mesh.face_set(set).map_err(|why| Error::at(key, why))
}

fn hold(model: &mut Model, key: &str, support: &Support) -> Result<(), Error> {
    let Support { set, axes, displacement } = support;
    let wrong = |key: String, what: String| Err(Error::at(key, what));
    let nodes = model.mesh.node_set(set).map_err(|why| Error::at(format!("{key}.set"), why))?.to_vec();
    if !displacement.is_finite() {
        return wrong(format!("{key}.displacement"), format!("{displacement} m is no finite number"));
    }
    let indices: Option<Vec<usize>> = axes.chars().map(|axis| "xyz".find(axis)).collect();
    let indices = indices.filter(|all| !all.is_empty());
    let Some(indices) = indices else {
        return wrong(
            format!("{key}.axes"),
            format!("\"{axes}\" names no axes, it must be of x, y and z, such as \"xy\""),
        );
    };
    for axis in indices {
        model.supports.prescribe(&nodes, axis, *displacement);
    }
    Ok(())
}

/// Refuses a displacement of which other supports hold all nodes: it would move nothing.
fn check_displaced(model: &Model, supports: &[Support]) -> Result<(), Error> {
    for (i, support) in supports.iter().enumerate().filter(|(_, support)| support.displacement != 0.0) {
        let nodes = model.mesh.node_set(&support.set)?;
        let axes = || support.axes.chars().filter_map(|axis| "xyz".find(axis));
        let moves = |node: &usize| {
            axes().any(|axis| {
                let held = model.supports.prescribed.get(&(*node, axis));
                held.is_some_and(|held| held.total_cmp(&support.displacement).is_eq())
            })
        };
        if !nodes.iter().any(moves) {
            let what = format!(
                "{} m is given to \"{}\", but supports after it hold all of its nodes elsewhere: leave one of them out",
                support.displacement, support.set
            );
            return Err(Error::at(format!("supports[{i}].displacement"), what));
        }
    }
    Ok(())
}

fn tie(mesh: &Mesh, supports: &mut Supports, key: &str, bond: &Bond) -> Result<(), Error> {
    let slaves = faces_of(mesh, &format!("{key}.slaves"), &bond.slaves)?;
    let masters = faces_of(mesh, &format!("{key}.masters"), &bond.masters)?;
    if let Ok(pairs) = bonded(mesh, &mesh.face_nodes(slaves), &mesh.face_nodes(masters))
        && conforms(mesh, slaves, masters, &pairs)
    {
        supports.bond(pairs);
        return Ok(());
    }
    let (_, normal) = flat(mesh, slaves).map_err(|why| Error::at(format!("{key}.slaves"), why))?;
    let ties = match bond.by {
        By::Mortar => bonded_mortar(mesh, slaves, masters, normal),
        By::Points => bonded_points(mesh, slaves, masters, normal),
    };
    supports.tied.extend(ties.map_err(|why| Error::at(key, why))?);
    Ok(())
}

/// One pair of surfaces that slide.
struct Slid {
    points: Vec<Point>,
    slaves: Vec<FaceRef>,
    /// How slave faces are integrated that hang over.
    partly: Partly,
    /// Whether the nodes of both match.
    matches: bool,
}

fn slide(mesh: &Mesh, key: &str, pair: &Sliding) -> Result<Slid, Error> {
    for (name, vector) in [("direction", pair.direction), ("axis", pair.axis), ("origin", pair.origin)] {
        if let Some(x) = vector.iter().flatten().find(|x| !x.is_finite()) {
            return Err(Error::at(format!("{key}.{name}"), format!("{x} is no finite number")));
        }
    }
    let slaves = faces_of(mesh, &format!("{key}.slaves"), &pair.slaves)?;
    let (_, outward) = flat(mesh, slaves).map_err(|why| Error::at(format!("{key}.slaves"), why))?;
    let normal = outward.map(|c| -c);
    // Where the axis says it, the direction of each point comes later.
    let (direction, turn) = match (pair.direction, pair.axis, pair.origin) {
        (Some(direction), None, None) => (direction, None),
        (None, Some(axis), Some(origin)) => {
            let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).unwrap_or(0);
            let mut any = [0.0; 3];
            any[least] = 1.0;
            (std::array::from_fn(|i| any[i] - normal[least] * normal[i]), Some((axis, origin)))
        }
        _ => {
            let what = "it needs either a direction, or an axis and its origin: give one of both";
            return Err(Error::at(key, what));
        }
    };
    let nodes = mesh.face_nodes(slaves);
    let (points, partly) = if pair.masters == "rigid" {
        (sliding_on_rigid(&nodes, normal, direction), None)
    } else {
        let masters = faces_of(mesh, &format!("{key}.masters"), &pair.masters)?;
        let below = mesh.face_nodes(masters);
        let known: HashSet<usize> = below.iter().copied().collect();
        if let Some(node) = nodes.iter().find(|node| known.contains(node)) {
            let what = format!(
                "\"{}\" and \"{}\" have node {node} in common, but a surface slides on that of another body: name two surfaces",
                pair.slaves, pair.masters
            );
            return Err(Error::at(key, what));
        }
        // Surfaces of the masters that go on beyond the contact need not be flat.
        if let Ok((_, other)) = flat(mesh, masters)
            && (0..3).map(|i| outward[i] * other[i]).sum::<f64>() > 0.5
        {
            let what = format!(
                "\"{}\" and \"{}\" face the same way, so that the bodies lie on one side of the contact and overlap: move one of them, or name its \
                 other side",
                pair.slaves, pair.masters
            );
            return Err(Error::at(key, what));
        }
        let pairs = bonded(mesh, &nodes, &below).ok();
        if pairs.is_some_and(|pairs| conforms(mesh, slaves, masters, &pairs)) {
            (sliding(mesh, &nodes, &below, normal, direction), None)
        } else {
            (mortar(mesh, slaves, masters, normal, direction), Some(overhangs(mesh, slaves, masters, normal)))
        }
    };
    let points = match turn {
        None => points,
        Some((axis, origin)) => points.and_then(|points| rotating(mesh, points, origin, axis)),
    };
    let at = |why| Error::at(key, why);
    let (points, matches) = (points.map_err(at)?, partly.is_none());
    Ok(Slid { points, slaves: slaves.to_vec(), partly: partly.unwrap_or_default(), matches })
}

/// Refuses surfaces with nodes in common that are not at right angles: what presses one would press the other, too.
fn check_edges(others: &[Point], points: &[Point], key: &str) -> Result<(), Error> {
    /// A cosine up to which an angle is a right one.
    const ACROSS: f64 = 1e-6;
    let mut normals: HashMap<usize, Vec<[f64; 3]>> = HashMap::new();
    for point in others {
        normals.entry(point.slave).or_default().push(point.normal);
    }
    for point in points {
        let cosine = |other: &[f64; 3]| (0..3).map(|i| point.normal[i] * other[i]).sum::<f64>();
        let mut cosines = normals.get(&point.slave).into_iter().flatten().map(cosine);
        if let Some(cosine) = cosines.find(|cosine| cosine.abs() > ACROSS) {
            let what = format!(
                "its slaves have node {} in common with another surface that is {:.1}° from it, and only surfaces at right angles may: make one \
                 surface of both, or leave a gap",
                point.slave,
                cosine.clamp(-1.0, 1.0).acos().to_degrees()
            );
            return Err(Error::at(format!("{key}.slaves"), what));
        }
    }
    Ok(())
}

/// Refuses a load of which supports take all: it would press nothing.
fn check_moves(model: &Model, key: &str, set: &str, load: &(Vec<FaceRef>, f64)) -> Result<(), Error> {
    /// Of the largest component of a force, what rounding makes of none.
    const NOTHING: f64 = 1e-9;
    let forces = nodal_forces(model, &Loads { pressure: vec![load.clone()], ..Loads::default() });
    let largest = forces.iter().flatten().fold(0.0_f64, |most, force| most.max(force.abs()));
    let held = |node: usize, axis: usize| model.supports.prescribed.contains_key(&(node, axis));
    let mut parts =
        forces.iter().enumerate().flat_map(|(node, force)| (0..3).map(move |axis| (node, axis, force[axis])));
    if largest == 0.0 || parts.any(|(node, axis, force)| force.abs() > NOTHING * largest && !held(node, axis))
    {
        return Ok(());
    }
    let what = format!(
        "supports hold all nodes of \"{set}\" along the load, so that it presses nothing: free that direction (axes = \"xy\" holds the other \
         two), or press by the displacement of a support"
    );
    Err(Error::at(format!("{key}.set"), what))
}

fn press(mesh: &Mesh, key: &str, load: &Load) -> Result<(Vec<FaceRef>, f64), Error> {
    let faces = faces_of(mesh, &format!("{key}.set"), &load.set)?;
    let nothing = |name: &str, unit: &str| {
        let what = format!("0 {unit} presses nothing, it must be another number: leave the load out instead");
        Err(Error::at(format!("{key}.{name}"), what))
    };
    let pressure = match (load.pressure, load.force) {
        (Some(0.0), None) => return nothing("pressure", "Pa"),
        (None, Some(0.0)) => return nothing("force", "N"),
        (Some(pressure), None) => pressure,
        (None, Some(force)) => {
            let (area, _) = flat(mesh, faces).map_err(|why| Error::at(format!("{key}.set"), why))?;
            force / area
        }
        _ => return Err(Error::at(key, "it needs either a pressure or a force: give one of both")),
    };
    if !pressure.is_finite() {
        return Err(Error::at(key, format!("{pressure} Pa is no finite number")));
    }
    Ok((faces.to_vec(), pressure))
}
