//! What both formats have: nodes and elements by number, from which a mesh is made.

use std::collections::{BTreeMap, HashMap};

use crate::Error;
use crate::elements::Kind;
use crate::mesh::{FaceRef, Group, Mesh};

/// An element as it stands in a file.
pub(super) struct RawElement {
    pub(super) number: u64,
    pub(super) kind: Kind,
    /// Numbers of its nodes, in our order.
    pub(super) nodes: Vec<u64>,
    pub(super) material: usize,
    /// Line of the file.
    pub(super) line: usize,
}

/// Nodes and elements as they stand in a file.
#[derive(Default)]
pub(super) struct Raw {
    pub(super) nodes: Vec<(u64, [f64; 3])>,
    pub(super) elements: Vec<RawElement>,
}

/// A mesh and where its parts come from.
pub(super) struct Built {
    pub(super) mesh: Mesh,
    /// Index of each node's number.
    pub(super) node: HashMap<u64, usize>,
    /// Index of each element's number.
    pub(super) element: HashMap<u64, usize>,
}

impl Raw {
    /// Groups the elements by kind and material, in the order in which each first appears.
    ///
    /// # Errors
    /// A node that is not there; a number, or the nodes of an element, a second time.
    pub(super) fn build(self) -> Result<Built, Error> {
        let mut mesh = Mesh::default();
        let mut node = HashMap::with_capacity(self.nodes.len());
        for (number, place) in self.nodes {
            // A node that is written twice is the last one, as in both programs.
            let index = *node.entry(number).or_insert(mesh.nodes.len());
            if index == mesh.nodes.len() {
                mesh.nodes.push(place);
            } else {
                mesh.nodes[index] = place;
            }
        }
        let mut numbers: Vec<Vec<u64>> = Vec::new();
        let (mut known, mut places) = (HashMap::new(), HashMap::new());
        for element in self.elements {
            let other = known.insert(element.number, element.line);
            let other = places.insert(sorted(&element.nodes), element.line).or(other);
            if let Some(other) = other {
                let what = format!(
                    "element {} stands here a second time, by its number or its nodes, after line {other}: it would be twice as stiff and \
                     heavy, leave one of both out",
                    element.number
                );
                return Err(Error::File { line: element.line, what });
            }
            let nodes: Result<Vec<usize>, u64> =
                element.nodes.iter().map(|n| node.get(n).copied().ok_or(*n)).collect();
            let nodes = nodes.map_err(|missing| Error::File {
                line: element.line,
                what: format!(
                    "element {} names node {missing}, which the file does not have",
                    element.number
                ),
            })?;
            let same = |g: &Group| g.kind == element.kind && g.material == element.material;
            let group = mesh.groups.iter().position(same).unwrap_or_else(|| {
                let (kind, material) = (element.kind, element.material);
                mesh.groups.push(Group { kind, material, elements: Vec::new() });
                numbers.push(Vec::new());
                mesh.groups.len() - 1
            });
            mesh.groups[group].elements.push(nodes);
            numbers[group].push(element.number);
        }
        let element = numbers.into_iter().flatten().enumerate().map(|(i, number)| (number, i)).collect();
        Ok(Built { mesh, node, element })
    }
}

/// Numbers of nodes in rising order.
pub(super) fn sorted(nodes: &[u64]) -> Vec<u64> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

/// The outer faces of a mesh by their corners, in rising order.
pub(super) fn faces_by_corners(mesh: &Mesh) -> BTreeMap<Vec<usize>, FaceRef> {
    mesh.skin()
        .into_iter()
        .map(|face| {
            let mut corners = face.nodes[..face.kind.corners()].to_vec();
            corners.sort_unstable();
            (corners, face.of)
        })
        .collect()
}

/// A number of a file.
pub(super) fn number<T: std::str::FromStr>(word: &str, line: usize, what: &str) -> Result<T, Error> {
    word.trim().parse().map_err(|_| Error::File { line, what: format!("\"{}\" is no {what}", word.trim()) })
}
