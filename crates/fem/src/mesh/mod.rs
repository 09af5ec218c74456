//! Nodes, elements and named sets.

mod block;
mod cylinder;
mod faces;
mod places;
mod sound;

pub use block::{Block, Grading};
pub use cylinder::{Cylinder, Ring};
pub use faces::{Face, FaceRef};
pub(crate) use places::Places;
pub use sound::check;

use std::collections::BTreeMap;

use crate::Error;
use crate::elements::Kind;

/// Elements of one kind and one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The kind of all its elements.
    pub kind: Kind,
    /// Index into the model's materials.
    pub material: usize,
    /// Nodes of each element, in the order of [`Kind`].
    pub elements: Vec<Vec<usize>>,
}

/// A mesh. Elements are counted through all groups, from 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Places of the nodes, m.
    pub nodes: Vec<[f64; 3]>,
    /// Elements by kind and material.
    pub groups: Vec<Group>,
    /// Named sets of nodes, each in rising order.
    pub node_sets: BTreeMap<String, Vec<usize>>,
    /// Named sets of element faces.
    pub face_sets: BTreeMap<String, Vec<FaceRef>>,
}

impl Mesh {
    /// Every element: number, kind, material, nodes.
    pub fn elements(&self) -> impl Iterator<Item = (usize, Kind, usize, &[usize])> {
        self.groups
            .iter()
            .flat_map(|g| g.elements.iter().map(|nodes| (g.kind, g.material, nodes.as_slice())))
            .enumerate()
            .map(|(i, (kind, material, nodes))| (i, kind, material, nodes))
    }

    /// The nodes of a set.
    ///
    /// # Errors
    /// Where there is no such set.
    pub fn node_set(&self, name: &str) -> Result<&[usize], Error> {
        self.node_sets.get(name).map(Vec::as_slice).ok_or_else(|| missing(name, self.node_sets.keys()))
    }

    /// The faces of a set.
    ///
    /// # Errors
    /// Where there is no such set.
    pub fn face_set(&self, name: &str) -> Result<&[FaceRef], Error> {
        self.face_sets.get(name).map(Vec::as_slice).ok_or_else(|| missing(name, self.face_sets.keys()))
    }

    /// Nodes for which a condition holds, in rising order.
    #[must_use]
    pub fn nodes_where(&self, condition: impl Fn([f64; 3]) -> bool) -> Vec<usize> {
        (0..self.nodes.len()).filter(|i| condition(self.nodes[*i])).collect()
    }

    /// Takes in another mesh. Its sets get `prefix` before their names, its materials are counted from `material`.
    pub fn add(&mut self, other: Self, prefix: &str, material: usize) {
        let (first_node, first_element) = (self.nodes.len(), self.elements().count());
        self.nodes.extend(other.nodes);
        for mut group in other.groups {
            group.material += material;
            for node in group.elements.iter_mut().flatten() {
                *node += first_node;
            }
            self.groups.push(group);
        }
        for (name, mut nodes) in other.node_sets {
            for node in &mut nodes {
                *node += first_node;
            }
            self.node_sets.insert(format!("{prefix}{name}"), nodes);
        }
        for (name, mut faces) in other.face_sets {
            for face in &mut faces {
                face.element += first_element;
            }
            self.face_sets.insert(format!("{prefix}{name}"), faces);
        }
    }

    /// The size of the box around all nodes, m.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for x in &self.nodes {
            for i in 0..3 {
                bounds[0][i] = bounds[0][i].min(x[i]);
                bounds[1][i] = bounds[1][i].max(x[i]);
            }
        }
        (0..3).map(|i| (bounds[1][i] - bounds[0][i]).max(0.0).powi(2)).sum::<f64>().sqrt()
    }
}

fn missing<'a>(name: &str, known: impl Iterator<Item = &'a String>) -> Error {
    let known: Vec<&str> = known.map(String::as_str).collect();
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    Error::MissingSet { name: name.to_owned(), known }
}
