//! Faces of elements: those of a set, those on the outside.

use std::collections::HashMap;

use super::Mesh;
use crate::elements::FaceKind;

/// One face of one element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FaceRef {
    /// Number of the element.
    pub element: usize,
    /// Number of the face, from 0, in Abaqus's order.
    pub face: usize,
}

/// A face with its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Whose face it is.
    pub of: FaceRef,
    /// Triangle or quadrilateral.
    pub kind: FaceKind,
    /// Nodes, corners first, counter-clockwise as seen from outside.
    pub nodes: Vec<usize>,
}

impl Face {
    /// The normal out of the body, as long as the area of a unit of both coordinates (m²), where the shape functions have this gradient.
    #[must_use]
    pub fn area(&self, gradient: &[[f64; 2]], nodes: &[[f64; 3]]) -> [f64; 3] {
        let mut tangents = [[0.0; 3]; 2];
        for (node, d) in self.nodes.iter().zip(gradient) {
            for i in 0..3 {
                tangents[0][i] += d[0] * nodes[*node][i];
                tangents[1][i] += d[1] * nodes[*node][i];
            }
        }
        let [a, b] = tangents;
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }
}

impl Mesh {
    /// The faces that belong to one element only.
    #[must_use]
    pub fn skin(&self) -> Vec<Face> {
        let mut seen: HashMap<Vec<usize>, (usize, Face)> = HashMap::new();
        for (element, kind, _, nodes) in self.elements() {
            for face in 0..kind.face_corners().len() {
                let (face_kind, local) = kind.face(face);
                let nodes: Vec<usize> = local.iter().map(|i| nodes[*i]).collect();
                let mut key = nodes[..face_kind.corners()].to_vec();
                key.sort_unstable();
                let face = Face { of: FaceRef { element, face }, kind: face_kind, nodes };
                seen.entry(key).or_insert((0, face)).0 += 1;
            }
        }
        let mut skin: Vec<Face> = seen.into_values().filter(|(n, _)| *n == 1).map(|(_, face)| face).collect();
        skin.sort_by_key(|face| face.of);
        skin
    }

    /// The outer faces all of whose nodes fulfil a condition.
    #[must_use]
    pub fn faces_where(&self, condition: impl Fn([f64; 3]) -> bool) -> Vec<FaceRef> {
        let inside = |face: &Face| face.nodes.iter().all(|node| condition(self.nodes[*node]));
        self.skin().into_iter().filter(inside).map(|face| face.of).collect()
    }

    /// Faces with their nodes.
    #[must_use]
    pub fn resolve(&self, faces: &[FaceRef]) -> Vec<Face> {
        let mut wanted: HashMap<usize, Vec<FaceRef>> = HashMap::new();
        for face in faces {
            wanted.entry(face.element).or_default().push(*face);
        }
        let mut resolved = Vec::with_capacity(faces.len());
        for (element, kind, _, nodes) in self.elements() {
            for of in wanted.get(&element).into_iter().flatten() {
                let (face_kind, local) = kind.face(of.face);
                let nodes = local.iter().map(|i| nodes[*i]).collect();
                resolved.push(Face { of: *of, kind: face_kind, nodes });
            }
        }
        resolved
    }

    /// The nodes of some faces, each once, in rising order.
    #[must_use]
    pub fn face_nodes(&self, faces: &[FaceRef]) -> Vec<usize> {
        let mut nodes: Vec<usize> = self.resolve(faces).into_iter().flat_map(|face| face.nodes).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}
