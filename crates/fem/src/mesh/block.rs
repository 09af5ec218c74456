//! Rectangular blocks of a regular or graded mesh.

use std::collections::HashMap;

use super::{Group, Mesh};
use crate::Error;
use crate::elements::Kind;

/// The lengths of the elements along one edge of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grading {
    /// Number of elements.
    pub elements: usize,
    /// Length of the last element over that of the first; the lengths between form a geometric series.
    pub ratio: f64,
}

impl From<usize> for Grading {
    fn from(elements: usize) -> Self {
        Self { elements, ratio: 1.0 }
    }
}

impl Grading {
    /// Where elements begin and end on 0 to 1.
    fn places(self) -> Vec<f64> {
        let n = self.elements;
        let step = if n > 1 { self.ratio.powf(1.0 / (n - 1) as f64) } else { 1.0 };
        let mut places = vec![0.0];
        let mut length = 1.0;
        for i in 0..n {
            places.push(places[i] + length);
            length *= step;
        }
        let total = places[n];
        places.iter().map(|x| x / total).collect()
    }
}

/// A block along the axes. Its sides are the sets x0, x1, y0, y1, z0, z1 of nodes and of faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// The corner with the smallest coordinates, m.
    pub origin: [f64; 3],
    /// Lengths of the edges, m.
    pub size: [f64; 3],
    /// Elements along each edge. A cell of tetrahedra is cut into 6, one of wedges into 2.
    pub cells: [Grading; 3],
    /// Kind of element.
    pub kind: Kind,
}

/// The corners of a cell of which each of its elements is made, numbered as a brick's.
fn cut(kind: Kind) -> &'static [&'static [usize]] {
    match kind {
        Kind::Hex8 | Kind::Hex20 | Kind::Hex20Reduced => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
        Kind::Wedge15 => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
        // Six around the diagonal from corner 0 to corner 6: the cuts of neighbouring cells fit.
        Kind::Tet4 | Kind::Tet10 => {
            &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]]
        }
    }
}

impl Block {
    /// The mesh, of material 0.
    ///
    /// # Errors
    /// Lengths that are not positive, no elements along an edge, a ratio that is not positive.
    pub fn mesh(&self) -> Result<Mesh, Error> {
        /// Two million Hex20 are 25 million unknowns, some terabytes of a factor.
        const MOST: usize = 2_000_000;
        for axis in 0..3 {
            let (size, cells) = (self.size[axis], self.cells[axis]);
            let name = ["x", "y", "z"][axis];
            let what = if !(size > 0.0 && size.is_finite()) {
                format!("the block is {size} m long along {name}, it must be longer than 0")
            } else if cells.elements == 0 {
                format!("the block has no element along {name}, it needs at least 1")
            } else if !(cells.ratio > 0.0 && cells.ratio.is_finite()) {
                format!("the ratio of lengths along {name} is {}, it must be above 0", cells.ratio)
            } else {
                continue;
            };
            return Err(Error::Mesh { what });
        }
        let [x, y, z] = self.cells.map(|cells| cells.elements);
        if x.saturating_mul(y).saturating_mul(z) > MOST {
            let what =
                format!("the block has {x} x {y} x {z} elements, it may have {MOST}: take larger ones");
            return Err(Error::Mesh { what });
        }
        let places = self.cells.map(Grading::places);
        let at = |axis: usize, i: usize| self.origin[axis] + self.size[axis] * places[axis][i];
        let count = self.cells.map(|c| c.elements);
        let corner = |i: usize, j: usize, k: usize| (k * (count[1] + 1) + j) * (count[0] + 1) + i;
        let mut mesh = Mesh::default();
        for k in 0..=count[2] {
            for j in 0..=count[1] {
                mesh.nodes.extend((0..=count[0]).map(|i| [at(0, i), at(1, j), at(2, k)]));
            }
        }
        let mut elements = Vec::new();
        for k in 0..count[2] {
            for j in 0..count[1] {
                for i in 0..count[0] {
                    let bottom =
                        [corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)];
                    let up = corner(0, 0, 1);
                    let cell = [0, 1, 2, 3, 4, 5, 6, 7].map(|c| bottom[c % 4] + up * (c / 4));
                    elements.extend(
                        cut(self.kind).iter().map(|part| part.iter().map(|c| cell[*c]).collect::<Vec<_>>()),
                    );
                }
            }
        }
        if self.kind.quadratic() {
            add_middles(&mut mesh.nodes, &mut elements, self.kind);
        }
        mesh.groups.push(Group { kind: self.kind, material: 0, elements });
        self.name_sides(&mut mesh);
        Ok(mesh)
    }

    fn name_sides(&self, mesh: &mut Mesh) {
        let skin = mesh.skin();
        for axis in 0..3 {
            for end in 0..2 {
                let plane = self.origin[axis] + self.size[axis] * [0.0, 1.0][end];
                let near = self.size[axis] * 1e-9;
                let on = |node: &usize| (mesh.nodes[*node][axis] - plane).abs() < near;
                let name = format!("{}{end}", ["x", "y", "z"][axis]);
                let nodes = (0..mesh.nodes.len()).filter(|node| on(node)).collect();
                let faces =
                    skin.iter().filter(|face| face.nodes.iter().all(on)).map(|face| face.of).collect();
                mesh.node_sets.insert(name.clone(), nodes);
                mesh.face_sets.insert(name, faces);
            }
        }
    }
}

/// Appends the nodes in the middles of the edges, each once.
fn add_middles(nodes: &mut Vec<[f64; 3]>, elements: &mut [Vec<usize>], kind: Kind) {
    let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
    for element in elements {
        for [a, b] in kind.edges() {
            let (a, b) = (element[*a], element[*b]);
            let middle = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                let (x, y) = (nodes[a], nodes[b]);
                nodes.push([0, 1, 2].map(|i| f64::midpoint(x[i], y[i])));
                nodes.len() - 1
            });
            element.push(middle);
        }
    }
}
