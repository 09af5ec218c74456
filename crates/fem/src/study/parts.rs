//! Parts: meshes from blocks and files, with their materials.

use std::collections::{BTreeMap, HashSet};

use super::document::Constants;
use super::materials::material;
use super::part::{Body, Part};
use crate::Error;
use crate::assembly::Supports;
use crate::elements::Kind;
use crate::material::Material;
use crate::mesh::{Block, Cylinder, Mesh, Ring, check};
use crate::read::{abaqus, abaqus_at, gmsh};

/// All parts as one mesh.
#[derive(Debug, Default)]
pub(super) struct Joined {
    pub(super) mesh: Mesh,
    pub(super) materials: Vec<Material>,
    /// Supports that stand in `.inp` files.
    pub(super) supports: Supports,
    /// Ties that stand there: slaves, masters.
    pub(super) ties: Vec<(String, String)>,
    /// Name of each part with the number of its nodes and elements.
    pub(super) sizes: Vec<(String, usize, usize)>,
    /// Sentences on what files say and is left out.
    pub(super) remarks: Vec<String>,
}

/// Reads files through `file`, which gives the text behind a path or says why not.
pub(super) fn join(
    parts: &BTreeMap<String, Part>,
    constants: &BTreeMap<String, Constants>,
    celsius: Option<f64>,
    file: &dyn Fn(&str) -> Result<String, String>,
) -> Result<Joined, Error> {
    if parts.is_empty() {
        return Err(Error::at("parts", "there is none: describe at least one, as [parts.pin]"));
    }
    let mut joined = Joined::default();
    for (name, constants) in constants {
        joined.materials.push(material(name, constants, celsius)?);
    }
    let names: Vec<&String> = constants.keys().collect();
    for (name, part) in parts {
        let key = format!("parts.{name}");
        let known = |key: String, material: &str| {
            names.iter().position(|n| *n == material).ok_or_else(|| {
                let all: Vec<&str> = names.iter().map(|n| n.as_str()).collect();
                let all = if all.is_empty() { "none is described".to_owned() } else { all.join(", ") };
                Error::at(
                    key,
                    format!(
                        "there is no material \"{material}\" ({all}): describe it as [materials.{material}]"
                    ),
                )
            })
        };
        let body = part.body(&key)?;
        let mesh = match body {
            Body::Block { material, .. } | Body::Cylinder { material, .. } | Body::Ring { material, .. } => {
                let mut mesh = built(&key, &body)?;
                let index = known(format!("{key}.material"), material)?;
                mesh.groups.iter_mut().for_each(|group| group.material = index);
                mesh
            }
            Body::Mesh { file: path, scale, shift, materials } => {
                if !(scale > 0.0 && scale.is_finite()) {
                    return Err(Error::at(
                        format!("{key}.scale"),
                        format!("{scale} is no scale, it must be above 0: 0.001 for a mesh in mm"),
                    ));
                }
                let at_file = |why: String| Error::at(format!("{key}.file"), format!("`{path}`: {why}"));
                let text = file(path).map_err(at_file)?;
                let (mut mesh, own) = if path.to_lowercase().ends_with(".inp") {
                    let deck = celsius.map_or_else(|| abaqus(&text), |celsius| abaqus_at(&text, celsius));
                    let deck = deck.map_err(|why| at_file(why.to_string()))?;
                    if let Some(what) = deck.without_section.filter(|_| materials.len() != 1) {
                        let what =
                            format!("{what}: give it one, or name one of `materials` for all of the part");
                        return Err(at_file(what));
                    }
                    let left_out = deck.remarks.iter().map(|what| format!("{key}.file: `{path}`: {what}"));
                    joined.remarks.extend(left_out);
                    let first = joined.mesh.nodes.len();
                    for (node, axis, displacement) in deck.supports {
                        joined.supports.prescribe(&[first + node], axis, scale * displacement);
                    }
                    let named = |set: &String| format!("{name}.{set}");
                    joined.ties.extend(deck.ties.iter().map(|(slave, master)| (named(slave), named(master))));
                    (deck.mesh, deck.materials)
                } else {
                    (gmsh(&text).map_err(|why| at_file(why.to_string()))?, Vec::new())
                };
                for node in &mut mesh.nodes {
                    (0..3).for_each(|i| node[i] = scale * node[i] + shift[i]);
                }
                // A face that two entries of a surface name is one.
                for faces in mesh.face_sets.values_mut() {
                    let mut known = HashSet::new();
                    faces.retain(|face| known.insert(*face));
                }
                assign(&mut mesh, &key, materials, own, &mut joined.materials, &known)?;
                mesh
            }
        };
        check(&mesh).map_err(|why| Error::at(&key, why))?;
        joined.sizes.push((name.clone(), mesh.nodes.len(), mesh.elements().count()));
        joined.mesh.add(mesh, &format!("{name}."), 0);
    }
    Ok(joined)
}

/// A mesh that is built in.
fn built(key: &str, body: &Body<'_>) -> Result<Mesh, Error> {
    let kind = |element: &str| {
        kind(element).ok_or_else(|| {
            let what = format!(
                "\"{element}\" is no element, it must be hex8, hex20, hex20r, tet4, tet10 or wedge15"
            );
            Error::at(format!("{key}.element"), what)
        })
    };
    let place = |name: &str, place: &[f64; 3]| match place.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(Error::at(format!("{key}.{name}"), format!("{x} m is no finite number"))),
        None => Ok(*place),
    };
    let round = |height: f64| {
        if !(height > 0.0 && height.is_finite()) {
            return Err(Error::at(
                format!("{key}.height"),
                format!("{height} m is no length, it must be above 0"),
            ));
        }
        Ok(())
    };
    let counts = |cells: &[i64; 3]| {
        // How many there may be in all is known to the meshes.
        if let [Ok(a @ 1..), Ok(b @ 1..), Ok(c @ 1..)] = cells.map(usize::try_from) {
            return Ok([a, b, c]);
        }
        let what = format!("{cells:?} elements, there must be at least 1 each way");
        Err(Error::at(format!("{key}.cells"), what))
    };
    let mesh = match body {
        Body::Block { element, origin, size, cells, .. } => {
            let (origin, kind) = (place("origin", origin)?, kind(element)?);
            Block { origin, size: *size, cells: counts(cells)?.map(Into::into), kind }.mesh()
        }
        Body::Cylinder { element, centre, radius, height, cells, .. } => {
            let (centre, kind) = (place("centre", centre)?, kind(element)?);
            round(*height)?;
            Cylinder { centre, radius: *radius, height: *height, cells: counts(cells)?, kind }.mesh()
        }
        Body::Ring { element, centre, radii, height, degrees, cells, .. } => {
            let (centre, kind) = (place("centre", centre)?, kind(element)?);
            round(*height)?;
            let [from, to] = *degrees;
            if !(to > from && to - from <= 360.0) {
                let what =
                    format!("a ring goes from {from} to {to} degrees, which must rise, by 360 at most");
                return Err(Error::at(format!("{key}.degrees"), what));
            }
            let (angles, cells) = (degrees.map(f64::to_radians), counts(cells)?.map(Into::into));
            Ring { centre, radii: *radii, angles, height: *height, cells, kind }.mesh()
        }
        Body::Mesh { .. } => Ok(Mesh::default()),
    };
    mesh.map_err(|why| Error::at(key, why))
}

/// Gives the groups of a mesh from a file their materials.
fn assign(
    mesh: &mut Mesh,
    key: &str,
    named: &[String],
    own: Vec<Material>,
    all: &mut Vec<Material>,
    known: &dyn Fn(String, &str) -> Result<usize, Error>,
) -> Result<(), Error> {
    let key = format!("{key}.materials");
    let volumes = mesh.groups.iter().map(|group| group.material + 1).max().unwrap_or(0);
    let indices: Vec<usize> = if named.is_empty() {
        let first = all.len();
        all.extend(own);
        (first..all.len()).collect()
    } else {
        named.iter().map(|material| known(key.clone(), material)).collect::<Result<_, _>>()?
    };
    if indices.len() != 1 && (indices.len() < volumes || !named.is_empty() && indices.len() > volumes) {
        let what = format!(
            "there are {} materials for {volumes} physical volume(s), or materials of an .inp: name one for each, in the order of their tags (the first of a \
             volume counts) or of the file, or one for all",
            indices.len()
        );
        return Err(Error::at(key, what));
    }
    for group in &mut mesh.groups {
        group.material = indices.get(group.material).copied().unwrap_or(indices[0]);
    }
    Ok(())
}

fn kind(name: &str) -> Option<Kind> {
    [Kind::Hex8, Kind::Hex20, Kind::Hex20Reduced, Kind::Tet4, Kind::Tet10, Kind::Wedge15]
        .into_iter()
        .find(|kind| kind.name().eq_ignore_ascii_case(name))
}
