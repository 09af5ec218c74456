//! Which node lies at a place.

use std::collections::HashMap;

use super::Mesh;

/// How far apart two nodes may lie that are one place, over the size of the mesh: what coordinates written with few digits lose.
const SAME_PLACE: f64 = 1e-6;

/// Nodes by where they lie.
#[derive(Debug)]
pub(crate) struct Places {
    /// How far a node may lie from its place, m.
    pub(crate) near: f64,
    cells: HashMap<[i64; 3], Vec<(usize, [f64; 3])>>,
}

impl Places {
    /// No nodes yet, of a mesh of this size (m).
    pub(crate) fn new(extent: f64) -> Self {
        Self { near: extent * SAME_PLACE, cells: HashMap::new() }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "places over a millionth of the size of the mesh fit easily"
    )]
    fn cell(&self, x: [f64; 3]) -> [i64; 3] {
        x.map(|c| (c / (4.0 * self.near)).round() as i64)
    }

    /// Puts a node at its place.
    pub(crate) fn insert(&mut self, node: usize, x: [f64; 3]) {
        self.cells.entry(self.cell(x)).or_default().push((node, x));
    }

    /// The node at a place.
    pub(crate) fn at(&self, x: [f64; 3]) -> Option<usize> {
        let [a, b, c] = self.cell(x);
        let around =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [a + i, b + j, c + k])));
        let mut known = around.filter_map(|key| self.cells.get(&key)).flatten();
        let close = |y: &[f64; 3]| (0..3).map(|i| (x[i] - y[i]).powi(2)).sum::<f64>().sqrt() <= self.near;
        known.find(|(_, y)| close(y)).map(|(node, _)| *node)
    }
}

impl Mesh {
    /// Makes one node of those that lie at one place.
    pub(super) fn weld(&mut self) {
        let mut places = Places::new(self.extent());
        let mut kept: Vec<[f64; 3]> = Vec::with_capacity(self.nodes.len());
        let mut becomes = Vec::with_capacity(self.nodes.len());
        for x in &self.nodes {
            becomes.push(places.at(*x).unwrap_or_else(|| {
                places.insert(kept.len(), *x);
                kept.push(*x);
                kept.len() - 1
            }));
        }
        self.nodes = kept;
        for node in self.groups.iter_mut().flat_map(|group| group.elements.iter_mut().flatten()) {
            *node = becomes[*node];
        }
        for nodes in self.node_sets.values_mut() {
            for node in nodes.iter_mut() {
                *node = becomes[*node];
            }
            nodes.sort_unstable();
            nodes.dedup();
        }
    }
}
