//! Unstructured grids of VTK as [`crate::output::vtu`] writes them, read back.

use std::collections::HashMap;
use std::str::FromStr;

use faer::c64;
use roxmltree::{Document, Node};

use crate::Error;
use crate::elements::Kind;
use crate::mesh::{Group, Mesh};
use crate::output::Field;

/// The kinds of elements by VTK's numbers of cells; Hex20 stands for both of its rules of integration.
const CELLS: [(u8, Kind); 5] =
    [(10, Kind::Tet4), (12, Kind::Hex8), (24, Kind::Tet10), (25, Kind::Hex20), (26, Kind::Wedge15)];

/// The mesh and the fields of its nodes, in their order. A complex one has the name that both of its parts have.
///
/// # Errors
/// What is no XML, lacks an array, or has arrays that do not fit together.
pub fn vtu(text: &str) -> Result<(Mesh, Vec<(String, Field)>), Error> {
    let wrong = |what: String| Error::Mesh { what };
    let document = Document::parse(text).map_err(|why| wrong(format!("it is no XML: {why}")))?;
    let arrays = |section: &str| {
        let inside = document.descendants().find(|node| node.has_tag_name(section));
        inside.into_iter().flat_map(|node| node.children()).filter(|node| node.has_tag_name("DataArray"))
    };
    let named = |section: &str, name: &str| {
        let found = arrays(section).find(|node| node.attribute("Name") == Some(name));
        found.ok_or_else(|| wrong(format!("it has no array \"{name}\" in <{section}>")))
    };
    let nodes = vectors(named("Points", "places")?)?;
    let connectivity: Vec<usize> = numbers(named("Cells", "connectivity")?)?;
    let offsets: Vec<usize> = numbers(named("Cells", "offsets")?)?;
    let types: Vec<u8> = numbers(named("Cells", "types")?)?;
    let materials: Vec<usize> = numbers(named("CellData", "material")?)?;
    let mut groups: Vec<Group> = Vec::new();
    let mut from = 0;
    for (i, ((to, cell), material)) in offsets.iter().zip(&types).zip(&materials).enumerate() {
        let known = CELLS.iter().find(|(number, _)| number == cell).map(|(_, kind)| *kind);
        let kind =
            known.ok_or_else(|| wrong(format!("its cell {i} is of type {cell}, which is not known")))?;
        let element = connectivity.get(from..*to).filter(|element| element.len() == kind.nodes());
        let element = element.filter(|element| element.iter().all(|node| *node < nodes.len()));
        let element = element.ok_or_else(|| wrong(format!("its cell {i} has no {} nodes", kind.nodes())))?;
        from = *to;
        match groups.last_mut().filter(|group| group.kind == kind && group.material == *material) {
            Some(group) => group.elements.push(element.to_vec()),
            None => groups.push(Group { kind, material: *material, elements: vec![element.to_vec()] }),
        }
    }
    if materials.len() != offsets.len() || types.len() != offsets.len() {
        return Err(wrong(format!("it has {} ends of cells and {} types", offsets.len(), types.len())));
    }
    let mut real: HashMap<&str, Vec<[f64; 3]>> = HashMap::new();
    let mut fields = Vec::new();
    for node in arrays("PointData") {
        let name = node.attribute("Name").unwrap_or_default();
        let values = vectors(node)?;
        if values.len() != nodes.len() {
            let (found, wanted) = (values.len(), nodes.len());
            return Err(wrong(format!("\"{name}\" has {found} vectors for {wanted} nodes")));
        }
        if let Some(of) = name.strip_suffix(" real") {
            real.insert(of, values);
        } else if let Some(of) = name.strip_suffix(" imaginary") {
            let parts = real.remove(of).ok_or_else(|| wrong(format!("\"{name}\" has no real part")))?;
            let both = parts.iter().zip(&values);
            let both = both.map(|(re, im)| [0, 1, 2].map(|i| c64::new(re[i], im[i]))).collect();
            fields.push((of.to_owned(), Field::Complex(both)));
        } else if !name.ends_with(" phase") {
            fields.push((name.to_owned(), Field::Real(values)));
        }
    }
    Ok((Mesh { nodes, groups, ..Mesh::default() }, fields))
}

/// The numbers of an array.
fn numbers<T: FromStr>(array: Node<'_, '_>) -> Result<Vec<T>, Error> {
    let name = array.attribute("Name").unwrap_or_default();
    let wrong = |word: &str| Error::Mesh { what: format!("\"{word}\" in its array \"{name}\" is no number") };
    let words = array.text().unwrap_or_default().split_whitespace();
    words.map(|word| word.parse().map_err(|_| wrong(word))).collect()
}

/// Those of vectors.
fn vectors(array: Node<'_, '_>) -> Result<Vec<[f64; 3]>, Error> {
    let all: Vec<f64> = numbers(array)?;
    let (vectors, []) = all.as_chunks::<3>() else {
        return Err(Error::Mesh { what: format!("it has {} numbers where vectors stand", all.len()) });
    };
    Ok(vectors.to_vec())
}
