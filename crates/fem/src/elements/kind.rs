//! The kinds of elements: nodes, edges, faces.

use super::FaceKind;

/// A kind of solid element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Brick of 8 nodes, full integration.
    Hex8,
    /// Brick of 20 nodes, 3 × 3 × 3 points.
    Hex20,
    /// Brick of 20 nodes, stiffness at 2 × 2 × 2 points.
    Hex20Reduced,
    /// Tetrahedron of 4 nodes.
    Tet4,
    /// Tetrahedron of 10 nodes.
    Tet10,
    /// Wedge of 15 nodes.
    Wedge15,
}

const HEX_FACES: [&[usize]; 6] =
    [&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
const TET_FACES: [&[usize]; 4] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]];
const WEDGE_FACES: [&[usize]; 5] = [&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];

const HEX_EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
const TET_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
const WEDGE_EDGES: [[usize; 2]; 9] = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];

impl Kind {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Hex8 => 8,
            Self::Hex20 | Self::Hex20Reduced => 20,
            Self::Tet4 => 4,
            Self::Tet10 => 10,
            Self::Wedge15 => 15,
        }
    }

    /// Name in messages and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hex8 => "Hex8",
            Self::Hex20 => "Hex20",
            Self::Hex20Reduced => "Hex20R",
            Self::Tet4 => "Tet4",
            Self::Tet10 => "Tet10",
            Self::Wedge15 => "Wedge15",
        }
    }

    /// Whether edges have a node in their middle.
    #[must_use]
    pub fn quadratic(self) -> bool {
        !matches!(self, Self::Hex8 | Self::Tet4)
    }

    /// The two corners of each edge; where the kind is quadratic, in the order of the nodes in the middle.
    #[must_use]
    pub fn edges(self) -> &'static [[usize; 2]] {
        match self {
            Self::Hex8 | Self::Hex20 | Self::Hex20Reduced => &HEX_EDGES,
            Self::Tet4 | Self::Tet10 => &TET_EDGES,
            Self::Wedge15 => &WEDGE_EDGES,
        }
    }

    /// Number of corners.
    #[must_use]
    pub fn corners(self) -> usize {
        if self.quadratic() { self.nodes() - self.edges().len() } else { self.nodes() }
    }

    /// The corners of each face, counter-clockwise as seen from outside, in the order S1, S2, … of Abaqus.
    #[must_use]
    pub fn face_corners(self) -> &'static [&'static [usize]] {
        match self {
            Self::Hex8 | Self::Hex20 | Self::Hex20Reduced => &HEX_FACES,
            Self::Tet4 | Self::Tet10 => &TET_FACES,
            Self::Wedge15 => &WEDGE_FACES,
        }
    }

    /// The local nodes of a face, corners first, then the middles of its edges; and its kind.
    ///
    /// # Panics
    /// Where the kind has no face of that number.
    #[must_use]
    pub fn face(self, number: usize) -> (FaceKind, Vec<usize>) {
        let corners = self.face_corners()[number];
        let mut nodes = corners.to_vec();
        if self.quadratic() {
            for (i, a) in corners.iter().enumerate() {
                let b = corners[(i + 1) % corners.len()];
                let edge = self.edges().iter().position(|e| *e == [*a, b] || *e == [b, *a]);
                nodes.push(self.corners() + edge.expect("two neighbouring corners of a face share an edge"));
            }
        }
        let kind = match (corners.len(), self.quadratic()) {
            (3, false) => FaceKind::Tri3,
            (3, true) => FaceKind::Tri6,
            (_, false) => FaceKind::Quad4,
            (_, true) => FaceKind::Quad8,
        };
        (kind, nodes)
    }

    /// Coordinates of the nodes in the reference element.
    #[must_use]
    pub fn reference(self) -> Vec<[f64; 3]> {
        let corners: &[[f64; 3]] = match self {
            Self::Hex8 | Self::Hex20 | Self::Hex20Reduced => &[
                [-1., -1., -1.],
                [1., -1., -1.],
                [1., 1., -1.],
                [-1., 1., -1.],
                [-1., -1., 1.],
                [1., -1., 1.],
                [1., 1., 1.],
                [-1., 1., 1.],
            ],
            Self::Tet4 | Self::Tet10 => &[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
            Self::Wedge15 => {
                &[[0., 0., -1.], [1., 0., -1.], [0., 1., -1.], [0., 0., 1.], [1., 0., 1.], [0., 1., 1.]]
            }
        };
        let mut nodes = corners.to_vec();
        if self.quadratic() {
            for [a, b] in self.edges() {
                nodes.push([0, 1, 2].map(|i| f64::midpoint(corners[*a][i], corners[*b][i])));
            }
        }
        nodes
    }
}
