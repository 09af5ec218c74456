//! The `.inp` files of Abaqus and CalculiX: mesh, sets, surfaces, materials, ties and supports.

use super::cards::{Card, cards, flat};
use std::collections::HashSet;

use super::raw::{Built, Raw, RawElement, number};
use super::sets::{Flats, Sets, members, read_flat, unknown_of_set};
use super::unread::{check_new, check_parameters, check_parts, passed_over};
use crate::Error;
use crate::elements::Kind;
use crate::material::{Constants, Material, Orthotropic};
use crate::mesh::{FaceRef, Mesh};

/// What a file says.
#[derive(Debug, Clone, Default)]
pub struct Deck {
    /// Nodes, elements, sets of nodes and surfaces, with names in capitals. A surface made of nodes is a set of nodes.
    pub mesh: Mesh,
    /// Materials in the order of the file; elements without a section are of the first.
    pub materials: Vec<Material>,
    /// A sentence on an element of which no section says what it is made of, where there are several materials or sections of others.
    pub without_section: Option<String>,
    /// Pairs of surfaces that are tied: slave, master.
    pub ties: Vec<(String, String)>,
    /// Supports: node, axis, displacement (m).
    pub supports: Vec<(usize, usize, f64)>,
    /// Sentences on cards that may matter and were left out, with their lines.
    pub remarks: Vec<String>,
}

fn kind_of(name: &str, line: usize) -> Result<Kind, Error> {
    match name {
        "C3D8" => Ok(Kind::Hex8),
        "C3D20" => Ok(Kind::Hex20),
        "C3D20R" => Ok(Kind::Hex20Reduced),
        "C3D4" => Ok(Kind::Tet4),
        "C3D10" => Ok(Kind::Tet10),
        "C3D15" => Ok(Kind::Wedge15),
        _ => Err(Error::File {
            line,
            what: format!(
                "elements of TYPE={name} are not known here: C3D4, C3D8, C3D10, C3D15, C3D20 and C3D20R are; mesh with \
                 these, or delete the elements where they are no part of the body"
            ),
        }),
    }
}

/// Reads a file. Of constants for several temperatures those of the first line count.
///
/// # Errors
/// What is no number, unknown kinds of elements, sets and nodes that are not there, *INCLUDE, cards that change the model and are not read.
pub fn abaqus(text: &str) -> Result<Deck, Error> {
    read(text, f64::NEG_INFINITY)
}

/// Reads a file, with the constants of its materials at a temperature (°C) by their tables.
///
/// # Errors
/// As [`abaqus`], and temperatures of a table that do not rise.
pub fn abaqus_at(text: &str, celsius: f64) -> Result<Deck, Error> {
    read(text, celsius)
}

fn read(text: &str, celsius: f64) -> Result<Deck, Error> {
    let cards = cards(text);
    let mut deck = Deck::default();
    let (mut raw, mut node_sets, mut element_sets) = (Raw::default(), Sets::default(), Sets::default());
    let mut names: Vec<String> = Vec::new();
    let mut open: Option<(String, usize, Vec<f64>, bool, f64)> = None;
    let mut sections: Vec<Section> = Vec::new();
    let (mut in_step, mut steps, mut flats) = (false, 0, Flats::new());
    // The step of the last card with supports: 0 before all steps.
    let mut held: Option<usize> = None;
    check_parts(&cards)?;
    for card in &cards {
        check_parameters(card)?;
        let is_material = matches!(card.name.as_str(), "ELASTIC" | "DENSITY");
        if !is_material
            && !matches!(card.name.as_str(), "EXPANSION" | "CONDUCTIVITY" | "SPECIFIC HEAT" | "DAMPING")
        {
            close(&mut open, celsius, &mut deck.materials, &mut names)?;
        }
        match card.name.as_str() {
            "NODE" => read_nodes(card, &mut raw, &mut node_sets)?,
            "ELEMENT" if flat(card) => read_flat(card, &mut flats, &mut element_sets),
            "ELEMENT" => read_elements(card, &mut raw, &mut element_sets)?,
            "NSET" | "ELSET" => {
                let name = card.parameter(&card.name)?;
                let found = members(card, (&raw, &flats), [&node_sets, &element_sets])?;
                if found.is_empty() {
                    deck.remarks.push(format!("line {}: the set {name} is empty", card.line));
                }
                deck.remarks.extend(unknown_of_set(card));
                let sets = if card.name == "NSET" { &mut node_sets } else { &mut element_sets };
                sets.add(card.of_part, &name, found);
            }
            "MATERIAL" => open = Some((card.parameter("NAME")?, card.line, Vec::new(), false, 0.0)),
            "ELASTIC" => {
                if let Some((_, _, elastic, orthotropic, _)) = &mut open {
                    *orthotropic = is_orthotropic(card)?;
                    *elastic = card.values()?;
                }
            }
            "DENSITY" => {
                if let Some((.., density)) = &mut open {
                    *density = density_at(&card.values()?, celsius);
                }
            }
            "SOLID SECTION" => {
                let (set, material) = (card.parameter("ELSET")?, card.parameter("MATERIAL")?);
                sections.push(Section { set, material, of_part: card.of_part, line: card.line });
            }
            "TIE" => read_ties(card, &mut deck.ties)?,
            "INCLUDE" => {
                let what = "*INCLUDE is not followed: put the file's lines here".to_owned();
                return Err(Error::File { line: card.line, what });
            }
            "BOUNDARY" => {
                check_new(card, held.is_some_and(|at| at < steps))?;
                held = Some(steps);
            }
            "SURFACE" => {}
            _ => deck.remarks.extend(passed_over(card, in_step)?),
        }
        in_step = match card.name.as_str() {
            "STEP" => {
                steps += 1;
                true
            }
            "END STEP" => false,
            _ => in_step,
        };
    }
    close(&mut open, celsius, &mut deck.materials, &mut names)?;
    deck.without_section = assign(&mut raw, &sections, &names, (&element_sets, &flats))?;
    let mut built = raw.build()?;
    for (name, numbers) in node_sets.all() {
        let mut nodes: Vec<usize> = numbers.iter().filter_map(|n| built.node.get(n).copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        built.mesh.node_sets.insert(name.clone(), nodes);
    }
    for card in &cards {
        match card.name.as_str() {
            "SURFACE" => read_surface(card, &mut built, &node_sets, &element_sets)?,
            "BOUNDARY" => read_supports(card, &built, &node_sets, &mut deck.supports)?,
            _ => {}
        }
    }
    deck.mesh = built.mesh;
    Ok(deck)
}

/// A section: the elements of a set are of a material.
struct Section {
    set: String,
    material: String,
    of_part: bool,
    line: usize,
}

/// Gives the elements of each section their material. A sentence on one without a section, where others have some or there are several materials.
fn assign(
    raw: &mut Raw,
    sections: &[Section],
    names: &[String],
    (sets, flats): (&Sets, &Flats),
) -> Result<Option<String>, Error> {
    let mut covered: HashSet<u64> = HashSet::new();
    for Section { set, material, of_part, line } in sections {
        let index = names.iter().position(|n| n == material).ok_or_else(|| Error::File {
            line: *line,
            what: format!("the section names material {material}, but there are: {}", names.join(", ")),
        })?;
        let members: HashSet<u64> = sets.known(*of_part, set, *line)?.iter().copied().collect();
        if let Some(flat) = members.iter().find(|number| flats.contains_key(number)) {
            let what = format!(
                "the section is of {set}, in which element {flat} is a line or a surface: mesh its body with solids, or leave it out of the set"
            );
            return Err(Error::File { line: *line, what });
        }
        covered.extend(&members);
        let of_set: Vec<&mut RawElement> =
            raw.elements.iter_mut().filter(|e| members.contains(&e.number)).collect();
        if of_set.is_empty() {
            let what = format!(
                "the section is of {set}, which has no solid element: mesh its body with solids, or leave the section out"
            );
            return Err(Error::File { line: *line, what });
        }
        for element in of_set {
            element.material = index;
        }
    }
    let bare = raw.elements.iter().find(|element| !covered.contains(&element.number));
    Ok(bare
        .filter(|_| !sections.is_empty() || names.len() > 1)
        .map(|element| format!("line {}: element {} has no *SOLID SECTION", element.line, element.number)))
}

fn read_nodes(card: &Card<'_>, raw: &mut Raw, sets: &mut Sets) -> Result<(), Error> {
    for (line, words) in &card.data {
        let at = |i: usize| words.get(i).map_or(Ok(0.0), |w| number(w, *line, "coordinate"));
        let index: u64 = number(words[0], *line, "number of a node")?;
        raw.nodes.push((index, [at(1)?, at(2)?, at(3)?]));
        if let Some(set) = card.parameters.get("NSET") {
            sets.add(card.of_part, set, [index]);
        }
    }
    Ok(())
}

/// An element may go on over several lines: it ends with its last node.
fn read_elements(card: &Card<'_>, raw: &mut Raw, sets: &mut Sets) -> Result<(), Error> {
    let kind = kind_of(&card.parameter("TYPE")?, card.line)?;
    let mut words: Vec<u64> = Vec::new();
    for (line, data) in &card.data {
        for word in data.iter().filter(|w| !w.is_empty()) {
            words.push(number(word, *line, "number of a node")?);
        }
        if words.len() > kind.nodes() + 1 {
            let what = format!("an element of {} nodes ({}) has more", kind.nodes(), kind.name());
            return Err(Error::File { line: *line, what });
        }
        if words.len() == kind.nodes() + 1 {
            let nodes = words.split_off(1);
            let index = words[0];
            words.clear();
            raw.elements.push(RawElement { number: index, kind, nodes, material: 0, line: *line });
            if let Some(set) = card.parameters.get("ELSET") {
                sets.add(card.of_part, set, [index]);
            }
        }
    }
    if words.is_empty() {
        return Ok(());
    }
    let what =
        format!("the last element has {} nodes, {} needs {}", words.len() - 1, kind.name(), kind.nodes());
    Err(Error::File { line: card.data.last().map_or(card.line, |d| d.0), what })
}

fn read_ties(card: &Card<'_>, ties: &mut Vec<(String, String)>) -> Result<(), Error> {
    for (line, words) in &card.data {
        let [slave, master, ..] = words.as_slice() else {
            let what = "a tie needs two surfaces: the slave and its master".to_owned();
            return Err(Error::File { line: *line, what });
        };
        ties.push((slave.to_uppercase(), master.to_uppercase()));
    }
    Ok(())
}

fn read_surface(
    card: &Card<'_>,
    built: &mut Built,
    node_sets: &Sets,
    element_sets: &Sets,
) -> Result<(), Error> {
    let name = card.parameter("NAME")?;
    let of_nodes = card.parameters.get("TYPE").is_some_and(|t| t == "NODE");
    let (mut nodes, mut faces) = (Vec::new(), Vec::new());
    let faces_of: Vec<usize> = built.mesh.elements().map(|(_, kind, ..)| kind.face_corners().len()).collect();
    for (line, words) in &card.data {
        let sets = if of_nodes { node_sets } else { element_sets };
        let members = match words[0].parse() {
            Ok(member) => vec![member],
            Err(_) => sets.known(card.of_part, &words[0].to_uppercase(), *line)?.clone(),
        };
        if of_nodes {
            nodes.extend(members.iter().filter_map(|n| built.node.get(n).copied()));
            continue;
        }
        let label = words.get(1).copied().unwrap_or_default().to_uppercase();
        let face: usize = number(label.trim_start_matches('S'), *line, "face, which are S1 to S6")?;
        for member in members {
            let element = *built.element.get(&member).ok_or_else(|| Error::File {
                line: *line,
                what: format!("surface {name} names element {member}, which the file does not have"),
            })?;
            if face == 0 || face > faces_of[element] {
                let what =
                    format!("element {member} has no face {label}: it has S1 to S{}", faces_of[element]);
                return Err(Error::File { line: *line, what });
            }
            faces.push(FaceRef { element, face: face - 1 });
        }
    }
    if of_nodes {
        nodes.sort_unstable();
        nodes.dedup();
    } else {
        nodes = built.mesh.face_nodes(&faces);
        built.mesh.face_sets.insert(name.clone(), faces);
    }
    built.mesh.node_sets.insert(name, nodes);
    Ok(())
}

/// The nodes that a support names: by number or set, either with the name of the instance before it.
fn supported(word: &str, line: usize, built: &Built, sets: &Sets) -> Result<Vec<usize>, Error> {
    let name = word.to_uppercase();
    let number = if built.mesh.node_sets.contains_key(&name) {
        None
    } else if let Some(numbers) = sets.of_instance(&name) {
        return Ok(numbers.iter().filter_map(|number| built.node.get(number).copied()).collect());
    } else {
        word.rsplit('.').next().and_then(|number| number.parse::<u64>().ok())
    };
    let Some(number) = number else { return Ok(built.mesh.node_set(&name)?.to_vec()) };
    let node = built.node.get(&number).copied().ok_or_else(|| Error::File {
        line,
        what: format!("the support names node {number}, which the file does not have"),
    })?;
    Ok(vec![node])
}

/// What the named supports of Abaqus hold of a solid, whose nodes do not turn.
fn named_support(name: &str) -> Option<&'static [usize]> {
    match name.to_uppercase().as_str() {
        "XSYMM" => Some(&[0]),
        "YSYMM" => Some(&[1]),
        "ZSYMM" => Some(&[2]),
        "XASYMM" => Some(&[1, 2]),
        "YASYMM" => Some(&[0, 2]),
        "ZASYMM" => Some(&[0, 1]),
        "PINNED" | "ENCASTRE" => Some(&[0, 1, 2]),
        _ => None,
    }
}

fn read_supports(
    card: &Card<'_>,
    built: &Built,
    sets: &Sets,
    supports: &mut Vec<(usize, usize, f64)>,
) -> Result<(), Error> {
    for (line, words) in &card.data {
        let nodes = supported(words[0], *line, built, sets)?;
        let at = |i: usize| words.get(i).copied().filter(|w| !w.is_empty());
        let named = named_support(at(1).unwrap_or_default());
        if let Some(axes) = named {
            supports.extend(axes.iter().flat_map(|axis| nodes.iter().map(move |node| (*node, *axis, 0.0))));
            continue;
        }
        let first: usize = number(at(1).unwrap_or_default(), *line, "direction 1, 2 or 3")?;
        let last = at(2).map_or(Ok(first), |w| number::<usize>(w, *line, "direction 1, 2 or 3"))?;
        let value = at(3).map_or(Ok(0.0), |w| number(w, *line, "displacement"))?;
        for axis in first.max(1)..=last.min(3) {
            supports.extend(nodes.iter().map(|node| (*node, axis - 1, value)));
        }
    }
    Ok(())
}

/// The density at a temperature (°C), by pairs of both; that of the first pair without a temperature.
fn density_at(values: &[f64], celsius: f64) -> f64 {
    let rows: Vec<[f64; 2]> = values.chunks_exact(2).map(|row| [row[1], row[0]]).collect();
    let above = rows.partition_point(|row| row[0] < celsius);
    match (above.checked_sub(1).map(|below| rows[below]), rows.get(above)) {
        (Some([t0, low]), Some([t1, high])) => low + (high - low) * (celsius - t0) / (t1 - t0),
        (Some([_, last]), None) => last,
        (None, _) => values.first().copied().unwrap_or_default(),
    }
}

/// Whether an `*ELASTIC` has nine constants.
fn is_orthotropic(card: &Card<'_>) -> Result<bool, Error> {
    match card.parameters.get("TYPE").map(String::as_str) {
        None | Some("ISO" | "ISOTROPIC") => Ok(false),
        Some("ENGINEERING CONSTANTS") => Ok(true),
        Some(other) => {
            let what = format!("*ELASTIC, TYPE={other} is not known here: ISO and ENGINEERING CONSTANTS are");
            Err(Error::File { line: card.line, what })
        }
    }
}

/// Ends a material.
fn close(
    open: &mut Option<(String, usize, Vec<f64>, bool, f64)>,
    celsius: f64,
    materials: &mut Vec<Material>,
    names: &mut Vec<String>,
) -> Result<(), Error> {
    let Some((name, line, elastic, orthotropic, density)) = open.take() else { return Ok(()) };
    let needed = if orthotropic { 9 } else { 2 };
    if elastic.len() < needed {
        let what = format!("material {name} has {} elastic constants, it needs {needed}", elastic.len());
        return Err(Error::File { line, what });
    }
    if elastic.len() > needed && !elastic.len().is_multiple_of(needed + 1) {
        let what = format!(
            "the table of material {name} has {} numbers, but each of its rows needs {needed} and a temperature",
            elastic.len()
        );
        return Err(Error::File { line, what });
    }
    let row = |row: &[f64]| {
        let constants = match row {
            // E1, E2, E3, ν12, ν13, ν23, G12, G13, G23.
            [e1, e2, e3, n12, n13, n23, g12, g13, g23, ..] => Constants::Orthotropic(Orthotropic {
                young: [*e1, *e2, *e3],
                poisson: [*n12, *n23, *n13],
                shear: [*g12, *g23, *g13],
            }),
            _ => Constants::Isotropic(row[0], row[1]),
        };
        (row.get(needed).copied().unwrap_or_default(), constants)
    };
    let table: Vec<_> = elastic.chunks(needed + 1).map(row).collect();
    materials.push(Material::at(&name, celsius, &table, density)?);
    names.push(name);
    Ok(())
}
