//! What holds a body: clamps, prescribed displacements, symmetry, nodes that move as one.

use std::collections::BTreeMap;

/// Supports and bonds of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Supports {
    /// Displacement (m) of a node along an axis (0, 1, 2).
    pub prescribed: BTreeMap<(usize, usize), f64>,
    /// Pairs of nodes that move as one: bonded surfaces with matching nodes, periodic boundaries.
    pub same: Vec<(usize, usize)>,
    /// Nodes that move as the weighted mean of others: bonded surfaces whose nodes do not match.
    pub tied: Vec<Tie>,
}

/// A node that moves as others do, in every direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// The node.
    pub slave: usize,
    /// The others with their weights, which sum to 1.
    pub masters: Vec<(usize, f64)>,
}

impl Supports {
    /// Holds nodes in every direction.
    pub fn clamp(&mut self, nodes: &[usize]) {
        (0..3).for_each(|axis| self.prescribe(nodes, axis, 0.0));
    }

    /// Moves nodes by a displacement (m) along an axis. Zero on a plane across that axis is a plane of symmetry.
    pub fn prescribe(&mut self, nodes: &[usize], axis: usize, displacement: f64) {
        self.prescribed.extend(nodes.iter().map(|node| ((*node, axis), displacement)));
    }

    /// Lets two nodes move as one.
    pub fn bond(&mut self, pairs: impl IntoIterator<Item = (usize, usize)>) {
        self.same.extend(pairs);
    }
}
