//! Parts: meshes from blocks and files, with their materials.

use std::collections::BTreeMap;

use super::document::{Constants, Directional, Part};
use crate::Error;
use crate::assembly::Supports;
use crate::elements::Kind;
use crate::material::{Material, Orthotropic};
use crate::mesh::{Block, Mesh, check};
use crate::read::{abaqus, gmsh};

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
}

/// Reads files through `file`, which gives the text behind a path or says why not.
pub(super) fn join(
    parts: &BTreeMap<String, Part>,
    constants: &BTreeMap<String, Constants>,
    file: &dyn Fn(&str) -> Result<String, String>,
) -> Result<Joined, Error> {
    if parts.is_empty() {
        return Err(Error::at("parts", "there is none: describe at least one, as [parts.pin]"));
    }
    let mut joined = Joined::default();
    for (name, constants) in constants {
        joined.materials.push(material(name, constants)?);
    }
    let names: Vec<&String> = constants.keys().collect();
    for (name, part) in parts {
        let key = format!("parts.{name}");
        let known = |key: String, material: &String| {
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
        let mesh = match part {
            Part::Block { element, origin, size, cells, material } => {
                let kind = kind(element).ok_or_else(|| {
                    let what = format!(
                        "\"{element}\" is no element, it must be hex8, hex20, hex20r, tet4, tet10 or wedge15"
                    );
                    Error::at(format!("{key}.element"), what)
                })?;
                if let Some(x) = origin.iter().find(|x| !x.is_finite()) {
                    return Err(Error::at(format!("{key}.origin"), format!("{x} m is no finite number")));
                }
                let block = Block { origin: *origin, size: *size, cells: cells.map(Into::into), kind };
                let mut mesh = block.mesh().map_err(|why| Error::at(&key, why))?;
                let index = known(format!("{key}.material"), material)?;
                mesh.groups.iter_mut().for_each(|group| group.material = index);
                mesh
            }
            Part::Mesh { file: path, scale, shift, materials } => {
                if !(*scale > 0.0 && scale.is_finite()) {
                    return Err(Error::at(
                        format!("{key}.scale"),
                        format!("{scale} is no scale, it must be above 0: 0.001 for a mesh in mm"),
                    ));
                }
                let at_file = |why: String| Error::at(format!("{key}.file"), format!("`{path}`: {why}"));
                let text = file(path).map_err(at_file)?;
                let (mut mesh, own) = if path.to_lowercase().ends_with(".inp") {
                    let deck = abaqus(&text).map_err(|why| at_file(why.to_string()))?;
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

/// Gives the groups of a mesh from a file their materials.
fn assign(
    mesh: &mut Mesh,
    key: &str,
    named: &[String],
    own: Vec<Material>,
    all: &mut Vec<Material>,
    known: &dyn Fn(String, &String) -> Result<usize, Error>,
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
    if indices.len() != 1 && indices.len() < volumes {
        let what = format!(
            "there are {} materials for {volumes} volumes: name one for each, in the order of their tags, or one for all",
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

fn material(name: &str, constants: &Constants) -> Result<Material, Error> {
    let key = format!("materials.{name}");
    let Constants { young, poisson, shear, density, rayleigh } = constants;
    let found = match (young, poisson, shear) {
        (Directional::Same(young), Directional::Same(poisson), None) => {
            Material::isotropic(name, *young, *poisson, *density)
        }
        (Directional::Each(young), Directional::Each(poisson), Some(shear)) => {
            let constants = Orthotropic { young: *young, poisson: *poisson, shear: *shear };
            Material::orthotropic(name, constants, *density)
        }
        _ => {
            let what = "young and poisson are one number each, or three each with three shear moduli in shear: give all or none of \
                        these as three";
            return Err(Error::at(key, what));
        }
    };
    if let Some(c) = rayleigh.iter().find(|c| !(**c >= 0.0 && c.is_finite())) {
        return Err(Error::at(format!("{key}.rayleigh"), format!("{c} must be 0 or more")));
    }
    Ok(found?.damped(rayleigh[0], rayleigh[1]))
}
